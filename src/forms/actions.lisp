;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What acts on a system beside Lagrange's function, how its equations are wanted, what they are
;;; derived from, and what is left of it by Routh's reduction.
;;; `rayleigh' is R with the force -dR/dq', `forces' a list of Q_i or [] for none, `constraints'
;;; equations f(q,t) = 0, `nonholonomic' equations linear in the velocities.
;;; It begins with the values that names have by what is assumed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/facts" "forms/exchange"))

;;; Values of names by what is assumed: of equal(a,b), with a - b linear in a name whose coefficient
;;; is a number, that name follows. Names that move have no such value.

(defun forms-assumed-equation (difference moving)
  "name = value where DIFFERENCE is 0, or nil; neither holds one of the names MOVING."
  (let ((names (cdr ($listofvars difference))))
    (unless (intersection names moving)
      (loop for name in names
            for slope = (sdiff difference name)
            when (and (mnump slope) (not (zerop1 slope)))
              return (list '(mequal simp) name
                           ($expand (sub name (div difference slope))))))))

(defun forms-assumed-values (facts moving)
  "(name = value ..) that follow from FACTS; no value holds one of the names on the left."
  (let ((values '()))
    (dolist (fact facts values)
      (multiple-value-bind (difference sign) (core-fact-difference fact)
        (let ((equation (and (eq sign '$zero)
                             (forms-assumed-equation
                              (forms-exchange ($expand difference) (forms-read-pairs values))
                              moving))))
          (when equation
            (let ((pair (forms-read-pairs (list equation))))
              (setq values
                    (cons equation
                          (loop for (nil name value) in values
                                collect (list '(mequal simp) name
                                              ($expand (forms-exchange value pair)))))))))))))

(defun $forms_assumed_values (moving)
  (cons '(mlist simp) (forms-assumed-values (core-facts) (cdr moving))))

;;; ---- actions

(defparameter *forms-none* '((mlist simp)))

(core-record forms-actions
  "What acts beside L: forms_actions() is nothing."
  (rayleigh 0) (forces *forms-none*) (constraints *forms-none*) (nonholonomic *forms-none*))

(core-record forms-options
  "How equations are wanted: common factors divided out, written by Christoffel's symbols, without
multipliers; the form of expressions."
  (simplify nil) (expanded nil) (eliminate nil) (form '$auto))

(core-record forms-system
  "In plain symbols, see motion.mac: L or another function, Rayleigh's function, a force for each
coordinate."
  function dissipation forces)

(core-record forms-reduction
  "What Routh's reduction gives: the coordinates, the cyclic ones' momenta, the function R of the
others, the cyclic velocities as equations."
  cyclic remaining momenta function velocities)

(defun $forms_system_expressions (system)
  "[L, R, [Q_1, ..]]."
  (list '(mlist simp) (forms-system-function system) (forms-system-dissipation system)
        (forms-system-forces system)))

(defun $forms_all_constraints (actions)
  "Holonomic ones first."
  ($append (forms-actions-constraints actions) (forms-actions-nonholonomic actions)))

(defun $forms_canonical_actions (forces constraints nonholonomic)
  "What acts beside H: dissipation is among the forces."
  ($forms_actions 0 forces constraints nonholonomic))
