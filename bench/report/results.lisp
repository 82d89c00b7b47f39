;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Results of the report on their way from those who measure to those who write the pages, as Lisp prints them.

(in-package :maxima)

(core-require "core/watch" "numerics/native")

(defun $report_count_own_seconds ()
  "From now on seconds are those of CPU of this process, so that others on the machine do not count."
  (setf (symbol-function 'core-clock)
        (lambda () (/ (get-internal-run-time) (coerce internal-time-units-per-second 'double-float))))
  '$done)

(defun $report_seconds ()
  "By the clock on the wall, whole ones."
  (round (get-internal-real-time) internal-time-units-per-second))

(defun $report_say (&rest words)
  (format *error-output* "~&dynarch: ~{~a~}~%" (mapcar #'$report_word words))
  (finish-output *error-output*)
  '$done)

(defun $report_word (e) (if (stringp e) e (mfuncall '$string e)))

(defun $report_claim (file)
  "Whether this process is the first to ask for FILE, so that two share what is to be done."
  (with-open-file (out file :direction :output :if-exists nil :if-does-not-exist :create) (and out t)))

(defun report-told (function)
  "What a run reports of itself while FUNCTION is called, and the text of the error that ends it."
  (let ((own #'core-report) (told nil))
    (unwind-protect
         (progn
           (setf (symbol-function 'core-report)
                 (lambda (key value) (when (string= key "run") (setq told value)) (funcall own key value)))
           (multiple-value-bind (value text) (core-caught function)
             (declare (ignore value))
             (values told text)))
      (setf (symbol-function 'core-report) own))))

(defmspec $report_told (form)
  ;; report_told(call): [the key run of the call, the text of its error]
  (multiple-value-bind (told text) (report-told (lambda () (meval (second form))))
    (list '(mlist simp) told text)))

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
