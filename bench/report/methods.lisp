;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The page doc/methods.md: which method serves which scene, in words that are computed from the results of the
;;; report. Look first at $report_methods.

(in-package :maxima)

(defparameter *report-errors* '(1d-3 1d-6 1d-9 1d-11))

(defun report-name (method) (string-downcase (report-word method)))

(defun report-spoken-time (seconds)
  (if (< seconds 1) (format nil "~a ms" (report-milliseconds seconds)) (format nil "~,1f s" seconds)))

(defun report-spoken-list (words)
  (if (cdr words) (format nil "~{~a~^, ~} and ~a" (butlast words) (car (last words))) (format nil "~a" (car words))))

;;; The table: the quickest at each error

(defun report-quickest-text (error result)
  (let ((best (report-best error result)))
    (if best (format nil "~a ~a" (report-name (cdr best)) (report-spoken-time (car best))) "none")))

(defun report-quickest (out results)
  (report-table out (cons "scene" (mapcar (lambda (error) (format nil "error ~a" (report-short error))) *report-errors*))
                (loop for result in results
                      collect (cons ($core_get result '$title)
                                    (mapcar (lambda (error) (report-quickest-text error result)) *report-errors*)))))

;;; How far a method is behind the quickest, over all scenes and errors

(defun report-quotients (method results)
  "Seconds of METHOD over those of the quickest, wherever somebody reaches the error; nil where METHOD does not."
  (loop for result in results
        append (loop for error in *report-errors*
                     for ranking = (report-ranking error result)
                     for own = (rassoc method ranking)
                     when ranking collect (and own (/ (car own) (caar ranking))))))

(defun report-standing-row (method results)
  (let* ((all (report-quotients method results)) (there (sort (remove nil all) #'<)) (count (length all)))
    (flet ((share (test) (format nil "~d" (count-if test there))))
      (list (report-name method) (format nil "~d" count) (format nil "~d" (length there))
            (share (lambda (q) (<= q 1))) (share (lambda (q) (<= q 3/2))) (share (lambda (q) (<= q 5)))
            (if there (report-quotient (nth (floor (length there) 2) there)) "")
            (if there (report-quotient (car (last there))) "")))))

(defun report-standings (out results)
  (report-table out '("method" " asked" " reached" " quickest" " within 1.5" " within 5" " middle" " worst")
                (mapcar (lambda (method) (report-standing-row method results))
                        (remove-duplicates (loop for result in results append (report-methods result)) :from-end t))))

;;; Stiff scenes and others in words

(defun report-fails-p (method result)
  (notany #'report-reached-p (report-rows-of result method)))

(defun report-stiff-p (result)
  "Whether the explicit method takes more than three times as long as the implicit one, at the first of the errors which that one
reaches; or fails, where the implicit one does not."
  (let* ((error (find-if (lambda (error) (report-time-to error result '$radau)) *report-errors*))
         (explicit (and error (report-time-to error result '$dop853))))
    (cond ((report-fails-p '$dop853 result) (not (report-fails-p '$radau result)))
          (error (or (null explicit) (> explicit (* 3 (report-time-to error result '$radau))))))))

(defun report-middle (numbers)
  (let ((sorted (sort (remove nil numbers) #'<)))
    (and sorted (nth (floor (length sorted) 2) sorted))))

(defun report-class-words (method results)
  "What METHOD does on RESULTS: a text."
  (let ((failing (count-if (lambda (result) (report-fails-p method result)) results))
        (middle (report-middle (report-quotients method results))))
    (format nil "~a~@[ comes to the end in ~d of them~]~:[~; and~]~@[ takes ~a times as long as the quickest~]"
            (report-name method) (and (plusp failing) (- (length results) failing))
            (and (plusp failing) middle) (and middle (report-quotient middle)))))

(defun report-quotient (x) (format nil (if (< x 10) "~,1f" "~d") (if (< x 10) x (round x))))

(defun report-class (out title results)
  (when results
    (format out "* **~a** (~d: ~{~a~^; ~}): ~{~a~^; ~}.~%" title (length results)
            (mapcar (lambda (result) ($core_get result '$title)) results)
            (mapcar (lambda (method) (report-class-words method results))
                    (remove-duplicates (loop for result in results append (report-methods result)) :from-end t)))))

(defun report-classes (out results)
  (format out "~%## Stiff or not~%~%The middle of the quotients of times, over the errors that a method reaches.~%~%")
  (report-class out "Stiff" (remove-if-not #'report-stiff-p results))
  (report-class out "Not stiff" (remove-if #'report-stiff-p results)))

;;; A scene in words

(defun report-runs-of-errors (result)
  "((method error ..) ..): the quickest and the errors, one after the other, for which it is."
  (let ((runs '()))
    (dolist (error *report-errors* (reverse (mapcar (lambda (run) (cons (car run) (reverse (cdr run)))) runs)))
      (let ((method (cdr (report-best error result))))
        (cond ((null method))
              ((eq method (caar runs)) (push error (cdar runs)))
              (t (push (list method error) runs)))))))

(defun report-quickest-words (result)
  (loop for (method . errors) in (report-runs-of-errors result)
        collect (format nil "~a for ~a" (report-name method)
                        (report-spoken-list (mapcar #'report-short errors)))))

(defun report-auto-words (result)
  (let ((quotients (remove nil (report-quotients '$auto (list result)))))
    (when quotients
      (let ((worst (reduce #'max quotients)))
        (if (<= worst *report-alike*) "auto as quick" (format nil "auto up to ~,1f times slower" worst))))))

(defun report-failing-words (result)
  (let ((failing (remove-if (lambda (method) (some #'report-reached-p (report-rows-of result method)))
                            (report-methods result))))
    (when failing (format nil "~a do~:[~;es~] not come to the end" (report-spoken-list (mapcar #'report-name failing))
                          (null (cdr failing))))))

(defun report-least-drift-words (result)
  (let ((rows (remove-if-not (lambda (row) (and (report-reached-p row) (report-worst-drift row))) (report-rows result))))
    (when rows
      (let* ((least (reduce (lambda (a b) (if (<= (cdr (report-worst-drift a)) (cdr (report-worst-drift b))) a b)) rows))
             (drift (report-worst-drift least)))
        (format nil "what is constant drifts least with ~a, ~a (~a)" (report-name (report-entry least '$method))
                (report-short (cdr drift)) (report-word (car drift)))))))

(defun report-scene-words (result)
  (let ((quickest (report-quickest-words result)))
    (format nil "**~a** (~:[not ~;~]stiff): ~:[nothing reaches 1e-3~;~:*~{~a~^, ~}~]~@[; ~a~]~@[; ~a~]~@[; ~a~]."
            ($core_get result '$title) (report-stiff-p result) quickest (report-auto-words result)
            (report-failing-words result) (report-least-drift-words result))))

(defun $report_methods (file head machine results long)
  "Writes FILE from the file HEAD, the text MACHINE and the lists RESULTS and, of long runs, LONG."
  (with-open-file (out file :direction :output :if-exists :supersede)
    (report-copy-head out head machine)
    (report-quickest out (cdr results))
    (report-classes out (cdr results))
    (format out "~%## How far each is behind the quickest~%~%Over all scenes and the errors above: how many times it was asked ~
                 for an error that some method reaches, and reached it; was quickest, within 1.5 and 5 times the quickest; ~
                 the middle and the worst quotient.~%")
    (report-standings out (cdr results))
    (format out "~%## Scene by scene~%~%Which method reaches errors first; how auto compares; what fails.~%~%")
    (dolist (result (cdr results)) (format out "* ~a~%" (report-scene-words result)))
    (report-long-words out (cdr long)))
  '$done)
