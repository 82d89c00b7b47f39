;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The page doc/numbers.md from the results of the report: what was left out of each scene, a table and a picture for each,
;;; failures in words. Look first at $report_numbers.

(in-package :maxima)

;;; Numbers and words

(defun report-short (x)
  "An error: 1.2e-9."
  (cond ((not (numberp x)) "")
        ((zerop x) "0")
        (t (multiple-value-bind (mantissa exponent) (report-mantissa x)
             (if (< (abs (- mantissa (round mantissa))) 1d-6)
                 (format nil "~de~d" (round mantissa) exponent)
                 (format nil "~,1fe~d" mantissa exponent))))))

(defun report-mantissa (x)
  (let* ((exponent (floor (log (abs x) 10))) (mantissa (/ x (expt 10d0 exponent))))
    (if (>= (abs mantissa) 9.95d0) (values (/ mantissa 10) (1+ exponent)) (values mantissa exponent))))

(defun report-milliseconds (seconds)
  (cond ((not (numberp seconds)) "")
        ((< seconds 1d-2) (format nil "~,2f" (* 1000 seconds)))
        ((< seconds 1) (format nil "~,1f" (* 1000 seconds)))
        (t (format nil "~d" (round (* 1000 seconds))))))

(defun report-word (e)
  (cond ((null e) "") ((stringp e) e) (t (substitute #\Space #\Newline (mfuncall '$string e)))))

(defun report-table (out columns rows)
  "COLUMNS: names, those that begin with a blank to the right."
  (format out "~%|~{ ~a |~}~%|~{~a|~}~%" (mapcar (lambda (name) (string-trim " " name)) columns)
          (mapcar (lambda (name) (if (char= (char name 0) #\Space) "--:" "---")) columns))
  (dolist (row rows) (format out "|~{ ~a |~}~%" row)))

;;; What was left out

(defun report-left-out-row (result)
  (flet ((part (key) ($core_get result key)))
    (append (list (part '$title) (part '$states) (part '$before) (part '$after)
                  (format nil "~{~a~^, ~}" (mapcar #'report-word (cdr (part '$zero))))
                  (if (part '$mass_constant) "yes" "no"))
            (cdr (part '$entries)))))

(defun report-left-out (out results)
  (format out "~%## What was left out of each scene~%~%Operations of the right side without numbers for the parameters and ~
               with those of the archive; values that are 0; whether M of M q'' = f is constant; entries of the matrix of ~
               derivatives dX_i/dx_j that are constant and made once, that move and are computed, that are zero and left out.~%")
  (report-table out '("scene" " states" " before" " after" "zero" "M constant" " constant" " moving" " zero")
                (mapcar #'report-left-out-row results)))

;;; A scene

(defun report-row-texts (row)
  (flet ((part (column) (report-entry row column)))
    (let ((drift (report-worst-drift row)))
      (list (report-word (part '$method)) (report-short (report-relative row)) (report-short (part '$error))
            (report-short (part '$largest)) (format nil "~a" (or (part '$digits) ""))
            (if drift (format nil "~a (~a)" (report-short (cdr drift)) (report-word (car drift))) "")
            (part '$rhs) (part '$jacobians) (part '$factorisations) (part '$steps) (part '$rejected)
            (report-milliseconds (part '$seconds))))))

(defun report-failures (out result)
  (let ((failed (remove-if #'report-reached-p (report-rows result))))
    (when failed (terpri out))
    (dolist (method (report-methods result))
      (let ((row (find method failed :key (lambda (row) (report-entry row '$method)))))
        (when row
          (format out "* ~a from ~a on: ~a~%" (report-word method) (report-short (report-relative row))
                  (report-entry row '$status)))))))

(defun report-conditioning (floor) (if floor (report-short floor) "left out"))

(defun report-scene (out result)
  (flet ((part (key) ($core_get result key)))
    (let ((reference (part '$reference)) (first (first (report-rows result))))
      (format out "~%### ~a~%~%Span ~a, ~d states. Reference: ~a; floor ~a. Conditioning: ~a. ~
                   Derived in ~a ms, compiled in ~a ms. Program ~a.~%~%![~a](numbers/~a.svg)~%"
              (part '$title) (report-word (part '$span)) (part '$states) ($core_get reference '$method)
              (report-short ($core_get reference '$floor)) (report-conditioning (part '$conditioning))
              (report-milliseconds (report-entry first '$derivation_seconds))
              (report-milliseconds (report-entry first '$compile_seconds))
              (subseq (part '$digest) 0 23) (part '$title) (part '$name)))
    (report-table out '("method" " tolerance" " error" " largest" " digits" " worst drift" " f" " J" " LU" " steps"
                        " rejected" " ms")
                  (mapcar #'report-row-texts (remove-if-not #'report-reached-p (report-rows result))))
    (report-failures out result)))

(defun report-copy-head (out head machine)
  "The lines of the file HEAD, its title first, the lines MACHINE under it."
  (with-open-file (in head)
    (loop for line = (read-line in nil)
          for first = t then nil
          while line
          do (format out "~a~%" line)
             (when first (format out "~%~a~%" machine)))))

(defun $report_numbers (file head machine results long)
  "Writes FILE from the file HEAD, the text MACHINE and the lists RESULTS and, of long runs, LONG."
  (with-open-file (out file :direction :output :if-exists :supersede)
    (report-copy-head out head machine)
    (report-peers out ($core_path "doc/bench.md"))
    (report-left-out out (cdr results))
    (format out "~%## Errors against time~%")
    (dolist (result (cdr results)) (report-scene out result))
    (report-long-runs out (cdr long)))
  '$done)
