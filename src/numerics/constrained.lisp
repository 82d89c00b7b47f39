;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The constraints of a run, from its program: their values and rates, the rows of their
;;; multipliers and the directions in which a state is brought back. A start that is off a
;;; constraint is refused, and so are constraints that follow from others there: their multipliers
;;; have no values.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_record" "forms/rates" "numerics/decimals" "numerics/native"
                "numerics/problem" "numerics/program" "numerics/back_to_constraints"
                "numerics/routine" "numerics/small_systems"))

(defparameter *numerics-largest-start-residual* 1d-6
  "Off a constraint by more than this a start is refused, by less it is brought back.")

(defun numerics-constraints-of (rates program)
  "The constraints of RATES, whose program is PROGRAM; nil where there are none."
  (flet ((elements (key)
           (let ((output (cdr (assoc key (forms-rates-outputs rates)))))
             (and output (algebra-output-elements output))))
         (routine (elements) (numerics-routine program elements :how :machine)))
    (let ((places (elements '$positions)) (speeds (elements '$velocities)))
      (when speeds
        (with-numerics-program program
          (numerics-new-constraints
           (loop for k from 1 to (length speeds) collect (format nil "constraint ~d" k))
           (length places) (routine places) (routine speeds)
           (routine (elements '$rows)) (routine (elements '$directions))))))))

(defun numerics-check-residuals (constraints function moment state what)
  (let ((residuals (numerics-zeros (if (eq what :places)
                                       (numerics-constraints-holonomic constraints)
                                       (numerics-constraints-count constraints)))))
    (funcall function moment state residuals)
    (loop for residual across residuals
          for name in (numerics-constraints-names constraints)
          do (unless (<= (abs residual) *numerics-largest-start-residual*)
               (core-error "the ~:[velocities of the start violate~;start is off~] ~a: it is ~a ~
                            there in place of 0"
                           (eq what :places) name (numerics-short-number residual))))))

(defun numerics-check-constraints (constraints moment state)
  "An error where STATE violates the CONSTRAINTS or these depend on each other; else it is brought
back to them in place."
  (numerics-with-masked-traps
    (numerics-check-residuals constraints (numerics-constraints-values constraints) moment state
                              :places)
    (numerics-check-residuals constraints (numerics-constraints-rates constraints) moment state
                              :speeds)
    (let ((redundant (numerics-redundant-constraints constraints moment state)))
      (when (and redundant (numerics-dead-start-p constraints moment state))
        (core-error "the start is a dead point, where ~{~a~^, ~} depend~:[s~;~] on the constraints ~
                     before; start elsewhere" redundant (cdr redundant)))
      (when redundant
        (core-error "~{~a~^, ~} follow~:[s~;~] at the start from the constraints before; leave ~
                     ~:[it~;them~] out" redundant (cdr redundant) (cdr redundant))))
    (numerics-project constraints moment state)))

(defun numerics-dead-start-p (constraints moment state)
  "Whether no constraint follows from those before it near STATE, on those that do not at STATE."
  (let ((near (copy-seq state)) (size (numerics-constraints-size constraints))
        (rows (numerics-constraints-rows constraints)))
    (dotimes (i size)
      (incf (aref near i) (* 1d-2 (+ 1 (abs (aref near i))) (sin (+ 1d0 (* 3 i))))))
    (numerics-project constraints moment near)
    (funcall (numerics-constraints-matrix constraints) moment near rows)
    (= (length (numerics-independent-rows rows (numerics-constraints-count constraints) size))
       (numerics-constraints-count constraints))))
