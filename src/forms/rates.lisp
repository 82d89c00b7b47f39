;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Derivatives along a motion in numbers, without symbolic ones: of a function V(q, q', t)
;;;     dV/dt = sum dV/dq_k' q_k'' + (sum dV/dq_k q_k' + dV/dt),
;;; each derivative being a quotient of differences. With steps of 2^-170 and values of 512 digits
;;; both errors, of the formula and of rounding, are about 2^-340. See $forms_rate_rows.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/noun_value"))

(defconstant forms-rate-step-digits 170)

(defun forms-point-along (point direction sign)
  "POINT moved by SIGN steps along the DIRECTION, ((name . value) ..)."
  (let ((moved (forms-moved-point point)))
    (loop for (x . rate) in direction
          do (forms-set-place x (+ (forms-fixed-value x point)
                                   (* sign (ash rate (- forms-rate-step-digits))))
                              moved))
    moved))

(defun forms-rates-along (expressions point direction)
  "The derivatives of the EXPRESSIONS along the DIRECTION; nil where there is no number."
  (let ((after (forms-point-along point direction 1))
        (before (forms-point-along point direction -1)))
    (flet ((rate (e)
             (catch 'forms-no-value
               (ash (- (forms-fixed-value e after) (forms-fixed-value e before))
                    (1- forms-rate-step-digits)))))
      (mapcar #'rate expressions))))

(defun forms-number (value)
  (and value (div value (ash 1 forms-digits))))

(defun forms-numbers (numbers)
  (cons '(mlist simp) (mapcar #'forms-number numbers)))

;;; For Maxima.

(defun $forms_rate_rows (expressions q v point)
  "Numbers [dV/dv_1, .., dV/dv_n, dV/dt where v' = 0] of the EXPRESSIONS V at POINT, equations."
  (let* ((point (forms-given-point point))
         (one (ash 1 forms-digits))
         (motion (acons '$t one (mapcar (lambda (x v) (cons x (forms-fixed-value v point)))
                                        (cdr q) (cdr v))))
         (directions (append (mapcar (lambda (v) (list (cons v one))) (cdr v)) (list motion)))
         (columns (mapcar (lambda (direction)
                            (forms-rates-along (cdr expressions) point direction))
                          directions)))
    (cons '(mlist simp)
          (if (cdr expressions) (mapcar #'forms-numbers (apply #'mapcar #'list columns))))))

(defun $forms_slopes (e names point)
  "Numbers de/dx for the NAMES x at POINT, equations."
  (let ((point (forms-given-point point)) (one (ash 1 forms-digits)))
    (forms-numbers (mapcar (lambda (x)
                             (car (forms-rates-along (list e) point (list (cons x one)))))
                           (cdr names)))))
