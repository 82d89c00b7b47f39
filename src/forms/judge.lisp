;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The judge of Lagrange's equations e_i = d/dt dL/dq_i' - dL/dq_i + dR/dq_i' - Q_i and of first
;;; integrals, by quotients of differences: no symbolic derivative. For random numbers c_i the sum
;;; of c_i e_i is compared with one along a random motion q + v*s + a*s^2/2: with D the derivative
;;; in the direction c,
;;;     sum c_i e_i = d/ds D_v L - D_q L + D_v R - c.Q,
;;; six values of L whatever the number of equations. See forms-judged-sum first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/actions" "forms/agreement" "forms/fixed" "forms/value"))

;;; Quotients of differences. Steps of 2^-100 serve second differences, with an error of about
;;; 2^-200; first ones have steps of 2^-170, where both errors, of the formula and of rounding, are
;;; about 2^-340.

(defconstant forms-step-digits 100)
(defconstant forms-slope-digits 170)

(defun forms-step (digits) (ash 1 (- forms-digits digits)))

(defun forms-quotient-of-differences (after before digits)
  (ash (- after before) (1- digits)))

(defun forms-point-along (point direction step)
  "POINT moved by STEP along the DIRECTION, ((name . rate) ..)."
  (let ((moved (forms-moved-point point)))
    (loop for (x . rate) in direction
          do (forms-set-place x (+ (forms-fixed-value x point) (forms-fixed-times step rate))
                              moved))
    moved))

(defun forms-slopes-along (functions point direction &optional (digits forms-slope-digits))
  "The derivatives of FUNCTIONS of points along the DIRECTION; nil where there is no number."
  (let ((after (forms-point-along point direction (forms-step digits)))
        (before (forms-point-along point direction (- (forms-step digits)))))
    (loop for function in functions
          collect (catch 'forms-no-value
                    (forms-quotient-of-differences (funcall function after)
                                                   (funcall function before) digits)))))

(defun forms-values-of (e) (lambda (point) (forms-fixed-value e point)))

;;; A trial: names of coordinates, velocities and accelerations, the numbers c_i.

(defstruct forms-trial q v a weights)

(defun forms-new-trial (q v a)
  (make-forms-trial :q q :v v :a a
                    :weights (loop for x in q for k from 1
                                   collect (forms-random-value (list '(mtimes) k x)))))

(defun forms-trial-point (trial)
  "A random point; velocities and accelerations have their values under both of their names."
  (let ((point (forms-new-point t)))
    (loop for x in (forms-trial-q trial)
          for v in (forms-trial-v trial)
          for a in (forms-trial-a trial)
          do (loop for plain in (list v a)
                   for order from 1
                   do (forms-set-place (list '(%derivative simp) x '$t order)
                                       (forms-variable-value plain point) point)))
    point))

(defun forms-moved (trial point step)
  "POINT after the time STEP."
  (let ((moved (forms-moved-point point))
        (half-square (floor (forms-fixed-times step step) 2)))
    (flet ((value (e) (forms-variable-value e point)))
      (forms-set-place '$t (+ (value '$t) step) moved)
      (loop for x in (forms-trial-q trial)
            for v in (forms-trial-v trial)
            for a in (forms-trial-a trial)
            do (forms-set-place x (+ (value x) (forms-fixed-times (value v) step)
                                     (forms-fixed-times (value a) half-square))
                                moved)
               (forms-set-place v (+ (value v) (forms-fixed-times (value a) step)) moved)))
    moved))

(defun forms-slope (trial function point names)
  "The derivative of FUNCTION, of points, in the direction of the weights of NAMES."
  (or (car (forms-slopes-along (list function) point
                               (mapcar #'cons names (forms-trial-weights trial))
                               forms-step-digits))
      (forms-no-value function)))

;;; Lagrange's equations.

(defun forms-judged-sum (trial function dissipation forces point)
  "sum c_i e_i from the FUNCTION of points, L, from the expressions R and [Q_1, ..]."
  (let ((v (forms-trial-v trial)) (step (forms-step forms-step-digits)))
    (flet ((momentum (step) (forms-slope trial function (forms-moved trial point step) v))
           (dissipation (point) (forms-fixed-value dissipation point)))
      (- (+ (forms-quotient-of-differences (momentum step) (momentum (- step))
                                           forms-step-digits)
            (if (eql dissipation 0) 0 (forms-slope trial #'dissipation point v)))
         (forms-slope trial function point (forms-trial-q trial))
         (forms-weighted-sum trial forces point)))))

(defun forms-weighted-sum (trial expressions point)
  (loop for e in expressions
        for weight in (forms-trial-weights trial)
        sum (forms-fixed-times weight (forms-fixed-value e point))))

(defun forms-both-sides (trial expressions function dissipation forces point)
  "The sum of c_i e_i found in EXPRESSIONS and the one expected; nil where there is no number."
  (values (catch 'forms-no-value (forms-weighted-sum trial expressions point))
          (catch 'forms-no-value (forms-judged-sum trial function dissipation forces point))))

(defparameter *forms-judged-how*
  "d/dt dL/dq' - dL/dq as quotients of differences along a random motion")

(defun $forms_check_lagrange (expressions system q v a)
  "The EXPRESSIONS e_i against those of the SYSTEM in plain symbols."
  (let* ((trial (forms-new-trial (cdr q) (cdr v) (cdr a)))
         (point (forms-trial-point trial)))
    (multiple-value-bind (found expected)
        (forms-both-sides trial (cdr expressions) (forms-values-of (forms-system-function system))
                          (forms-system-dissipation system) (cdr (forms-system-forces system))
                          point)
      (forms-verdict *forms-judged-how* found expected point))))

;;; First integrals: dV/dt = sum xi_i e_i at any coordinates, velocities and accelerations; for
;;; V = sum c_k V_k with random c_k both sides are quotients of differences of V and of L.

(defun forms-mixing-weights (items)
  (loop for nil in items for k from 1
        collect (forms-random-value (list '(mtimes) k '$t))))

(defun forms-mixed (weights values)
  (reduce #'+ (mapcar #'forms-fixed-times weights values)))

(defun forms-rate-of-integrals (integrals weights trial point)
  (let ((motion (acons '$t (ash 1 forms-digits) nil)))
    (flet ((move (x rate) (push (cons x (forms-variable-value rate point)) motion)))
      (mapc #'move (forms-trial-q trial) (forms-trial-v trial))
      (mapc #'move (forms-trial-v trial) (forms-trial-a trial)))
    (let ((rates (forms-slopes-along (mapcar #'forms-values-of integrals) point motion)))
      (and (notany #'null rates) (forms-mixed weights rates)))))

(defun forms-set-displacement (trial displacements weights point)
  "The weights of TRIAL: sum c_k xi_i of the DISPLACEMENTS xi."
  (setf (forms-trial-weights trial)
        (apply #'mapcar
               (lambda (&rest components)
                 (forms-mixed weights
                              (mapcar (lambda (e) (forms-fixed-value e point)) components)))
               displacements)))

(defun $forms_check_integral_rates (how pairs system q v a)
  "PAIRS [[xi_1, .., xi_n], V] against the SYSTEM in plain symbols."
  (let* ((trial (forms-new-trial (cdr q) (cdr v) (cdr a)))
         (point (forms-trial-point trial))
         (weights (forms-mixing-weights (cdr pairs)))
         (displacements (mapcar (lambda (pair) (cdr (second pair))) (cdr pairs))))
    (forms-verdict
     how
     (catch 'forms-no-value
       (forms-rate-of-integrals (mapcar #'third (cdr pairs)) weights trial point))
     (catch 'forms-no-value
       (forms-set-displacement trial displacements weights point)
       (forms-judged-sum trial (forms-values-of (forms-system-function system))
                         (forms-system-dissipation system) (cdr (forms-system-forces system))
                         point))
     point)))

;;; Derivatives in numbers, for Maxima.

(defun forms-number (value)
  (and value (div value (ash 1 forms-digits))))

(defun forms-numbers (numbers)
  (cons '(mlist simp) (mapcar #'forms-number numbers)))

(defun $forms_rate_rows (expressions q v point)
  "Numbers [dV/dv_1, .., dV/dv_n, dV/dt where v' = 0] of the EXPRESSIONS V at POINT, equations."
  (let* ((point (forms-given-point point))
         (one (ash 1 forms-digits))
         (motion (acons '$t one (mapcar (lambda (x v) (cons x (forms-fixed-value v point)))
                                        (cdr q) (cdr v))))
         (directions (append (mapcar (lambda (v) (list (cons v one))) (cdr v)) (list motion)))
         (columns (mapcar (lambda (direction)
                            (forms-slopes-along (mapcar #'forms-values-of (cdr expressions))
                                                point direction))
                          directions)))
    (cons '(mlist simp)
          (if (cdr expressions) (mapcar #'forms-numbers (apply #'mapcar #'list columns))))))

(defun $forms_slopes (e names point)
  "Numbers de/dx for the NAMES x at POINT, equations."
  (let ((point (forms-given-point point)) (one (ash 1 forms-digits)))
    (forms-numbers (loop for x in (cdr names)
                         append (forms-slopes-along (list (forms-values-of e)) point
                                                    (list (cons x one)))))))
