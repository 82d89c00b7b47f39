;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The judge of a solved tableau, in numbers at a random point: its rows as they were typed vanish
;;; with the currents and potentials that were found, and each inductor and capacitor obeys its law
;;; with the rates that were found. A law left open gives a number of its own.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/coefficients" "circuits/elements"
                "circuits/tableau" "circuits/tableau_equations" "circuits/tableau_reduction"
                "forms/agreement" "forms/fixed" "forms/value"))

(defstruct circuits-hearing
  solution point
  (values (make-hash-table))) ; column -> number

(defun $circuits_check_tableau (solution)
  (let* ((hearing (make-circuits-hearing :solution solution :point (forms-new-point t)))
         (pairs (catch 'forms-no-value
                  (circuits-hear-states hearing)
                  (append (circuits-static-pairs hearing) (circuits-rate-pairs hearing)))))
    (forms-verdict-of "Kirchhoff's laws and the laws of the elements at a random point"
                      (or pairs '((nil))) (circuits-hearing-point hearing))
    '$done))

(defun circuits-value-of-row (hearing row)
  (let ((sum 0))
    (maphash (lambda (column x)
               (let ((value (circuits-value-of-column hearing column)))
                 (incf sum (if (integerp x)
                               (* x value)
                               (forms-fixed-times (circuits-value-of-coefficient hearing x)
                                                  value)))))
             row)
    sum))

(defun circuits-value-of-coefficient (hearing x)
  (forms-fixed-value (circuits-outside x) (circuits-hearing-point hearing)))

(defun circuits-value-of-column (hearing column)
  (let* ((values (circuits-hearing-values hearing)) (solution (circuits-hearing-solution hearing))
         (known (or (gethash column (circuits-solution-solved solution))
                    (gethash column (circuits-solution-others solution)))))
    (or (gethash column values)
        (setf (gethash column values)
              (if known
                  (circuits-value-of-row hearing known)
                  (circuits-value-given hearing column))))))

(defun circuits-value-given (hearing column)
  (forms-fixed-value (circuits-given (circuits-hearing-solution hearing) column)
                     (circuits-hearing-point hearing)))

(defun circuits-hear-states (hearing)
  "Values of dependent states stand in inductances and capacitances too."
  (let* ((solution (circuits-hearing-solution hearing))
         (tableau (circuits-solution-tableau solution)))
    (loop for (k . row) in (circuits-solution-dependents solution)
          do (let ((value (circuits-value-of-row hearing row)))
               (setf (gethash (circuits-column tableau :state k) (circuits-hearing-values hearing))
                     value)
               (forms-set-place (circuits-branch-state (circuits-branch-at tableau k)) value
                                (circuits-hearing-point hearing))))))

(defun circuits-static-pairs (hearing)
  (loop for row in (circuits-tableau-rows (circuits-solution-tableau
                                           (circuits-hearing-solution hearing)))
        collect (cons (circuits-value-of-row hearing row) 0)))

(defun circuits-rate-pairs (hearing)
  "The rates are those of the equations as they are returned; of dependent states, those of what
these are."
  (let* ((solution (circuits-hearing-solution hearing))
         (tableau (circuits-solution-tableau solution)))
    (if (circuits-solution-rated solution)
        (loop for k in (circuits-state-numbers tableau)
              collect (cons (circuits-value-of-row hearing (circuits-plain-rate-row solution k))
                            0))
        '())))

(defun circuits-plain-rate-row (solution k)
  "The law of an inductor or a capacitor in the rates of the independent states."
  (let ((row (circuits-new-row)))
    (loop for (j . x) in (circuits-stored (circuits-solution-tableau solution) k)
          do (circuits-add-multiple row x (circuits-rate-of-state solution j)))
    (circuits-add-multiple row -1 (circuits-force-row solution k))
    row))
