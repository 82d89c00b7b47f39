;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_rates.mac: rates that are wrong by one operation, given to the check of each kind.

(in-package :maxima)

(defun test-wrong-list (elements)
  "ELEMENTS with the last one times 1 + 10^-20."
  (append (butlast elements)
          (list (algebra-program-multiply (1+ (expt 10 -20)) (car (last elements))))))

(defun test-wrong-motion (motion)
  (let ((copy (copy-forms-canonical-motion motion)))
    (setf (forms-canonical-motion-forces copy) (test-wrong-list (forms-canonical-motion-forces motion)))
    copy))

(defun test-wrong-mass (rows)
  (append (butlast rows)
          (list (loop for (j . element) in (car (last rows)) collect (cons j (car (test-wrong-list (list element))))))))

(defparameter *test-wrong-checks*
  `((circuits-check-rates ,(lambda (run mass right balance) (list run mass (test-wrong-list right) balance)))
    (forms-check-elements ,(lambda (elements expressions) (list (test-wrong-list elements) expressions)))
    (forms-check-hamilton ,(lambda (dynamics names motion) (list dynamics names (test-wrong-motion motion))))
    (forms-check-canonical ,(lambda (function forces names task motion)
                              (list function forces names task (test-wrong-motion motion))))
    (forms-check-cyclic-velocities ,(lambda (dynamics constant velocities)
                                      (list dynamics constant (test-wrong-list velocities))))
    (numerics-check-exchange ,(lambda (rates new values)
                                (let ((wrong (copy-forms-rates new)))
                                  (forms-set-right-sides wrong (test-wrong-list (forms-right-sides new)))
                                  (list rates wrong values)))))
  "Checks, and what makes their arguments wrong.")

(defun test-with-wrong (check change function)
  (let ((own (symbol-function check)))
    (setf (symbol-function check) (lambda (&rest arguments) (apply own (apply change arguments))))
    (unwind-protect (funcall function) (setf (symbol-function check) own))))

(defmspec $test_wrong (form)
  ;; test_wrong("name of a check", e): the value of e while what that check is given is wrong
  (destructuring-bind (name e) (cdr form)
    (let ((row (if (string= name "mass")
                   (list 'circuits-check-rates (lambda (run mass right balance) (list run (test-wrong-mass mass) right balance)))
                   (find name *test-wrong-checks* :test #'string-equal :key (lambda (row) (symbol-name (car row)))))))
      (test-with-wrong (first row) (second row) (lambda () (meval e))))))
