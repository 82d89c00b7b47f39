;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What acts on a system beside Lagrange's function, and how its equations are wanted. `rayleigh'
;;; is R with the force -dR/dq', `forces' a list of Q_i or [] for none, `constraints' equations
;;; f(q,t) = 0, `nonholonomic' equations linear in the velocities.

(in-package :maxima)

(defparameter *forms-none* '((mlist simp)))

(core-record forms-actions
  "What acts beside L: forms_actions() is nothing."
  (rayleigh 0) (forces *forms-none*) (constraints *forms-none*) (nonholonomic *forms-none*))

(core-record forms-options
  "How equations are wanted: common factors divided out, written by Christoffel's symbols, without
multipliers; the form of expressions."
  (simplify nil) (expanded nil) (eliminate nil) (form '$auto))

(defun $forms_all_constraints (actions)
  "Holonomic ones first."
  ($append (forms-actions-constraints actions) (forms-actions-nonholonomic actions)))

(defun $forms_canonical_actions (forces constraints nonholonomic)
  "What acts beside H: dissipation is among the forces."
  ($forms_actions 0 forces constraints nonholonomic))
