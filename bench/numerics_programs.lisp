;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For bench_numerics_programs.mac: a program of rates as this Lisp runs it, compiled and on the
;;; register machine, beside the C that ExportProgram writes, by gcc -O2. Both are called in turn, a
;;; few thousandths of a second each; the quotient of each pair counts, its median and quartiles.

(in-package :maxima)

(core-require "algebra/program_export" "numerics/rates_problem")

(defparameter *bench-pairs* 41)
(defparameter *bench-slice* 0.004 "Seconds of each call of a pair.")

(defun bench-quartiles (numbers)
  (let ((sorted (sort (copy-list numbers) #'<)) (n (length numbers)))
    (loop for share in '(1/4 1/2 3/4) collect (nth (floor (* share n)) sorted))))

(defun bench-seconds (function)
  (let ((start (core-clock))) (funcall function) (- (core-clock) start)))

;;; C: the exported routine, and a second file with a loop over it, so that no call is optimised away.

(defun bench-run-gcc (&rest arguments)
  (unless (zerop (sb-ext:process-exit-code
                  (sb-ext:run-program "/usr/bin/env" (cons "gcc" arguments))))
    (core-error "gcc does not compile")))

(defvar *bench-folder* (format nil "/tmp/dynarch-bench-~d/" (core-process-id)))

(defun bench-c-routine (record name)
  "The address of the loop (x y count), and the seconds that gcc takes for the routine."
  (ensure-directories-exist *bench-folder*)
  (flet ((file (type) (format nil "~a~a~a" *bench-folder* name type)))
    ($algebra_export (bench-rates-alone record) (file ".c") '$c t)
    (with-open-file (out (file "_loop.c") :direction :output :if-exists :supersede)
      (format out "void ~a(const double *x, double *y);~%void ~:*~a_loop(const double *x, double *y, ~
                   long n) { for (long i = 0; i < n; i++) ~:*~a(x, y); }~%" name))
    (let ((seconds (bench-seconds
                    (lambda () (bench-run-gcc "-O2" "-fPIC" "-c" "-o" (file ".o") (file ".c"))))))
      (bench-run-gcc "-O2" "-fPIC" "-shared" "-o" (file ".so") (file "_loop.c") (file ".o") "-lm")
      (sb-alien:load-shared-object (file ".so") :dont-save t)
      (values (sb-sys:find-foreign-symbol-address (format nil "~a_loop" name)) seconds))))

(defun bench-rates-alone (record)
  "RECORD without outputs other than the rates, and without what only those need."
  (with-algebra-program
    (destructuring-bind (inputs outputs) (algebra-read-program record)
      (algebra-program-record inputs (list (assoc '$rates outputs))))))

(defun bench-call-c (address state out count)
  (sb-sys:with-pinned-objects (state out)
    (sb-alien:alien-funcall
     (sb-alien:sap-alien (sb-sys:int-sap address)
                         (function sb-alien:void sb-sys:system-area-pointer
                                   sb-sys:system-area-pointer sb-alien:long))
     (sb-sys:vector-sap state) (sb-sys:vector-sap out) count)))

(defun bench-call-lisp (function time state out count)
  (declare (type function function) (fixnum count))
  (loop repeat count do (funcall function time state out)))

;;; A case.

(defun bench-count (function)
  "How many calls of FUNCTION, of a number of calls, take a slice of time."
  (loop for count = 1 then (* 2 count)
        for seconds = (bench-own-seconds (lambda () (funcall function count)))
        until (> seconds (/ *bench-slice* 4))
        finally (return (max 1 (round (* count (/ *bench-slice* seconds)))))))

(defun bench-own-seconds (function)
  "Of this process alone, whatever else the machine does."
  (let ((start (get-internal-run-time)))
    (funcall function)
    (/ (- (get-internal-run-time) start) (float internal-time-units-per-second 1d0))))

(defun bench-pairs (one other)
  "Seconds a call of both, the least of all, and the quartiles of the quotients of pairs."
  (let ((count-one (bench-count one)) (count-other (bench-count other)) (ones '()) (others '()))
    (loop repeat *bench-pairs*
          do (push (/ (bench-own-seconds (lambda () (funcall one count-one))) count-one) ones)
             (push (/ (bench-own-seconds (lambda () (funcall other count-other))) count-other)
                   others))
    (list (reduce #'min ones) (reduce #'min others)
          (bench-quartiles (mapcar #'/ ones others)))))

(defun bench-bytes (function)
  "That a call of FUNCTION, of a number of calls, takes from the heap, in the mean of many."
  (let* ((count (max 1000 (bench-count function))) (start (sb-ext:get-bytes-consed)))
    (funcall function count)
    (floor (- (sb-ext:get-bytes-consed) start) count)))

(defun bench-state (n)
  (let ((state (numerics-zeros n)))
    (dotimes (k n state) (setf (aref state k) (sin (* 1.7d0 (1+ k)))))))

(defun bench-values-agree-p (a b)
  (every (lambda (x y) (< (abs (- x y)) (* 1d-9 (+ 1 (abs x))))) a b))

(defun $bench_program (title record name)
  "One line for compiled code and one for the machine, with the times that it took to make them."
  (let* ((states (cdr (algebra-record-part record '$states))) (n (length states))
         (program (numerics-read-program record states)) (rates (numerics-program-rates program))
         (time (numerics-moment 0d0)) (state (bench-state n))
         (point (concatenate 'numerics-vector #(0d0) state))
         (out (numerics-zeros n)) (out-c (numerics-zeros n)))
    (multiple-value-bind (address seconds-c) (bench-c-routine record name)
      (flet ((call-c (count) (bench-call-c address point out-c count)))
        (numerics-with-masked-traps
          (dolist (how '(:compiled :machine))
            (let* ((function nil)
                   (seconds (bench-seconds
                             (lambda () (setq function (numerics-routine program rates :how how)))))
                   (call (lambda (count) (bench-call-lisp function time state out count)))
                   (bytes (bench-bytes call))
                   (result (bench-pairs call #'call-c)))
              (unless (bench-values-agree-p out out-c) (core-error "the values differ"))
              (destructuring-bind (one other (low middle high)) result
                (format t "~26a ~8a ~6d nodes: ~9,3f us, C ~9,3f us, quotient ~5,2f (~,2f .. ~,2f); ~
                           made in ~7,3f s, gcc ~7,3f s; ~d bytes a call~%"
                        title (string-downcase how) (numerics-count-operations rates)
                        (* 1d6 one) (* 1d6 other) middle low high seconds seconds-c bytes)))))))
    '$done))

(defun $bench_end ()
  (sb-ext:delete-directory *bench-folder* :recursive t)
  '$done)
