;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; References of the report, kept in bench/scenes/references, a file for each scene, a line for each field:
;;;     program sha256:..    the digest of the program, the start and the span that it belongs to
;;;     method ..            how it was made
;;;     digits d             on which two ways agree
;;;     errors e1 .. en      of the states, at most about
;;;     row t x1 .. xn       states at a time, numbers in double precision
;;; Look first at $report_reference.

(in-package :maxima)

(core-require "algebra/program_record" "numerics/reference" "numerics/trial_reference")

(defun $report_take_time (seconds)
  (setq *numerics-series-seconds* seconds *numerics-most-series-steps* 10000000)
  '$done)

;;; ErrorAgainstTime takes the one that is set, else it makes one. As an argument its decimals would be refused.

(defvar *report-reference* nil)

(defun $report_set_reference (record) (setq *report-reference* record) '$done)

(defun $report_reference (trial) (or *report-reference* ($numerics_reference_solution trial)))

(core-rule "ReferenceSolution" :any "numerics/trial_reference" "report_reference" "trial")

;;; Files

(defun report-number-text (x)
  "X so that it reads back the same."
  (let ((*read-default-float-format* 'double-float))
    (prin1-to-string (coerce ($float x) 'double-float))))

(defun $report_write_reference (file digest record)
  (with-open-file (out file :direction :output :if-exists :supersede)
    (flet ((numbers (word list) (format out "~a~{ ~a~}~%" word (mapcar #'report-number-text (cdr list)))))
      (format out "program ~a~%method ~a~%" digest ($core_get record '$method))
      (numbers "digits" (list nil ($core_get record '$digits)))
      (numbers "errors" ($core_get record '$errors))
      (dolist (row (cdr ($core_get record '$rows))) (numbers "row" row))))
  '$done)

(defun report-read-numbers (text)
  (let ((*read-default-float-format* 'double-float) (*read-eval* nil))
    (with-input-from-string (in text)
      (cons '(mlist simp) (loop for x = (read in nil) while x collect (coerce x 'double-float))))))

(defun $report_read_reference (file)
  "[digest, record], or false where there is no such file."
  (with-open-file (in file :if-does-not-exist nil)
    (when in
      (let ((fields '()) (rows '()))
        (loop for line = (read-line in nil)
              while line
              do (let* ((end (position #\Space line)) (word (subseq line 0 end)) (rest (subseq line (1+ end))))
                   (if (string= word "row")
                       (push (report-read-numbers rest) rows)
                       (push (cons word rest) fields))))
        (flet ((field (word) (cdr (assoc word fields :test #'string=))))
          (algebra-list
           (field "program")
           (algebra-list
            (algebra-field '$method (field "method"))
            (algebra-field '$digits (second (report-read-numbers (field "digits"))))
            (algebra-field '$errors (report-read-numbers (field "errors")))
            (algebra-field '$rows (cons '(mlist simp) (reverse rows))))))))))
