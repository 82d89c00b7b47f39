;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the pages of the report read out of a record of ErrorAgainstTime: its rows by the names of their columns, and in what
;;; time a method reaches an error, between two of its runs in log-log. Look first at report-time-to.

(in-package :maxima)

(defparameter *report-columns*
  '($method $tolerance $error $largest $digits $drifts $rhs $jacobians $factorisations $steps
    $rejected $seconds $derivation_seconds $compile_seconds $status))

(defun report-rows (result) (cdr ($core_get result '$rows)))

(defun report-entry (row column) (nth (position column *report-columns*) (cdr row)))

(defun report-relative (row)
  "Its tolerance, of a list the relative one."
  (let ((tolerance (report-entry row '$tolerance)))
    (if (consp tolerance) (second tolerance) tolerance)))

(defun report-reached-p (row) (numberp (report-entry row '$error)))

(defun report-methods (result)
  "In the order in which they were tried."
  (remove-duplicates (mapcar (lambda (row) (report-entry row '$method)) (report-rows result))
                     :from-end t))

(defun report-rows-of (result method)
  (remove method (report-rows result)
          :key (lambda (row) (report-entry row '$method)) :test-not #'eq))

(defun report-between (row next error)
  "Seconds at ERROR on the line from ROW to NEXT, nil where it is not between them."
  (let ((high (report-entry row '$error)) (low (report-entry next '$error)))
    (when (> high error low)
      (let ((share (/ (log (/ high error)) (log (/ high low)))))
        (exp (+ (* (- 1 share) (log (report-entry row '$seconds)))
                (* share (log (report-entry next '$seconds)))))))))

(defun report-time-to (error result method)
  "Seconds in which METHOD reaches ERROR, nil where it does not."
  (let* ((rows (remove-if-not #'report-reached-p (report-rows-of result method)))
         (enough (loop for row in rows
                       when (<= (report-entry row '$error) error) collect (report-entry row '$seconds)))
         (between (loop for (row next) on rows
                        while next
                        for seconds = (report-between row next error)
                        when seconds collect seconds)))
    (when enough (reduce #'min (append enough between)))))

(defun report-ranking (error result)
  "((seconds . method) ..), the quickest first, of those that reach ERROR."
  (sort (loop for method in (report-methods result)
              for seconds = (report-time-to error result method)
              when seconds collect (cons seconds method))
        #'< :key #'car))

(defparameter *report-alike* 1.15d0 "Quotient of times that are not told apart.")

(defun report-best (error result)
  "(seconds . method), the quickest to ERROR; not auto where a method that auto may have taken is as quick."
  (destructuring-bind (&optional first second &rest others) (report-ranking error result)
    (declare (ignore others))
    (if (and second (eq (cdr first) '$auto) (<= (car second) (* *report-alike* (car first))))
        second
        first)))

(defun report-worst-drift (row)
  "(name . drift), nil where nothing is known to be constant."
  (let ((worst nil))
    (dolist (item (cdr (report-entry row '$drifts)) worst)
      (when (or (null worst) (> (third item) (cdr worst)))
        (setq worst (cons (second item) (third item)))))))
