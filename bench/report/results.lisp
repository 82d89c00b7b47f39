;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Results of the report on their way from those who measure to those who write the pages, as Lisp prints them.

(in-package :maxima)

(core-require "numerics/native")

(defun $report_seconds () (/ (round (* 10 (numerics-working-seconds))) 10d0))

(defun $report_say (&rest words)
  (format *error-output* "~&dynarch: ~{~a~}~%" (mapcar #'$report_word words))
  (finish-output *error-output*)
  '$done)

(defun $report_word (e) (if (stringp e) e (mfuncall '$string e)))

(defun $report_write_result (file record)
  (with-open-file (out file :direction :output :if-exists :supersede)
    (with-standard-io-syntax
      (let ((*package* (find-package :maxima)) (*read-default-float-format* 'double-float))
        (prin1 record out))))
  '$done)

(defun $report_read_result (file)
  (with-open-file (in file :if-does-not-exist nil)
    (and in
         (with-standard-io-syntax
           (let ((*package* (find-package :maxima)) (*read-default-float-format* 'double-float)
                 (*read-eval* nil))
             (read in))))))
