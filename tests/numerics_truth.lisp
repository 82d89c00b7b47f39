;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_truth.mac: what a call reports beside its value; integrals that are wrong.

(in-package :maxima)

(defun test-with-function (name function body)
  "Calls BODY while NAME is FUNCTION of its own function."
  (let ((own (symbol-function name)))
    (setf (symbol-function name) (funcall function own))
    (unwind-protect (funcall body) (setf (symbol-function name) own))))

(defun test-told (body)
  (let ((told nil))
    (let ((value (test-with-function
                  'core-report
                  (lambda (own)
                    (lambda (key value)
                      (when (string= key "run") (setq told value))
                      (funcall own key value)))
                  body)))
      (list '(mlist simp) value told))))

(defmspec $test_told (form)
  ;; test_told(call): [value of the call, what it reports under the key run]
  (test-told (lambda () (meval (second form)))))

(defmspec $test_told_at_steps (form)
  ;; the same with a row at the end of each step
  (core-require "numerics/run_options")
  (test-with-function 'numerics-read-points (constantly (constantly nil))
                      (lambda () (test-told (lambda () (meval (second form)))))))

(defun test-wrong-integral (integral place)
  "INTEGRAL, as forms-rates has it, with the element at PLACE times 1 + 10^-20."
  (let ((copy (copy-list integral)))
    (setf (nth place copy) (algebra-program-multiply (1+ (expt 10 -20)) (nth place copy)))
    copy))

(defparameter *test-wrong-integrals*
  `(("motion" forms-checked-integrals
              ,(lambda (integrals direction left pushed point)
                 (list integrals
                       (append (butlast direction)
                               (list (cons (car (car (last direction)))
                                           (algebra-program-multiply (1+ (expt 10 -20))
                                                                     (cdr (car (last direction)))))))
                       left pushed point)))
    ("circuit" circuits-check-balance
               ,(lambda (run mass right integral) (list run mass right (test-wrong-integral integral 3))))
    ("values" numerics-check-exchange
              ,(lambda (rates new values)
                 (let ((wrong (copy-forms-rates new)))
                   (setf (forms-rates-integrals wrong)
                         (mapcar (lambda (integral) (test-wrong-integral integral 1))
                                 (forms-rates-integrals new)))
                   (list rates wrong values)))))
  "Checks, and what makes their arguments wrong.")

(defmspec $test_wrong_integral (form)
  ;; test_wrong_integral(name, e): the value of e while the check of that name is given what is wrong
  (destructuring-bind (name e) (cdr form)
    (destructuring-bind (check change) (cdr (assoc name *test-wrong-integrals* :test #'string=))
      (test-with-function check
                          (lambda (own) (lambda (&rest arguments) (apply own (apply change arguments))))
                          (lambda () (meval e))))))

(defun $test_long_decimals (count)
  "Those of COUNT random bigfloats, decimals of all their digits, that an archive does not keep."
  (core-require "archive/speller" "archive/parser" "core/bigfloats")
  (let ((state (make-random-state nil)))
    (flet ((whole () (1+ (random (expt 10 (1+ (random 40 state))) state))))
      (cons '(mlist simp)
            (loop repeat count
                  for digits = (+ 2 (random 60 state))
                  for number = (* (- 1 (* 2 (random 2 state))) (/ (whole) (whole)))
                  for e = (core-decimal-bigfloat number digits)
                  for text = (archive-settled-text (list '(mlist simp) e '$x) :doubles t)
                  for again = (second (archive-parse-value text :doubles t))
                  unless (and (equal again e) (= digits (core-bigfloat-digits again))
                              (<= (* 2 (abs (- (core-bigfloat-rational e) number)) (expt 10 (1- digits)))
                                  (* (abs number) 1001/1000)))
                    collect text)))))
