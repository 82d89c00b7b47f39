;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The judge of first integrals: dV/dt = sum xi_i e_i, e_i the left sides of Lagrange's
;;; equations, at any coordinates, velocities and accelerations. For V = sum c_k V_k with random
;;; c_k both sides are quotients of differences of V and of L, as in judge.lisp: no symbolic
;;; derivative.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/judge" "forms/rates"))

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
    (let ((rates (forms-rates-along integrals point motion)))
      (and (notany #'null rates) (forms-mixed weights rates)))))

(defun forms-set-displacement (trial displacements weights point)
  "The weights of TRIAL: sum c_k xi_i of the DISPLACEMENTS xi."
  (setf (forms-trial-weights trial)
        (apply #'mapcar
               (lambda (&rest components)
                 (forms-mixed weights
                              (mapcar (lambda (e) (forms-fixed-value e point)) components)))
               displacements)))

(defun $forms_check_integral_rates (how pairs plain q v a)
  "PAIRS [[xi_1, .., xi_n], V] against [L, R, [Q_1, ..]] in PLAIN symbols."
  (destructuring-bind (function dissipation forces) (cdr plain)
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
         (forms-judged-sum trial (lambda (point) (forms-fixed-value function point))
                           dissipation (cdr forces) point))
       point))))
