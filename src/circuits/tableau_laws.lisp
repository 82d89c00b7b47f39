;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What open_laws.mac asks of a tableau: which laws depend on each other's values, what the sources
;;; that stand for such resistors carry or bear, and whether their rates were needed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/elements" "circuits/tableau" "circuits/tableau_equations"
                "circuits/tableau_reduction"))

(defun $circuits_tableau_circle (solution)
  "Numbers of the nonlinear resistors whose arguments depend on laws that depend on them."
  (let ((tableau (circuits-solution-tableau solution))
        (waiting (circuits-law-arguments solution)))
    (loop for ready = (find-if (lambda (item) (circuits-ready-p tableau item waiting)) waiting)
          while ready do (setq waiting (remove ready waiting)))
    (cons '(mlist simp)
          (sort (loop for (branch) in waiting collect (circuits-branch-number branch)) #'<))))

(defun $circuits_tableau_require_laws (solution)
  "An error where laws depend on each other in a circle."
  (circuits-laws-resolved solution)
  '$done)

(defun $circuits_tableau_answers (solution numbers)
  "[what flows in a source of voltage, what lies at a source of current, ..] for the branches
NUMBERS, the voltage in the direction of the law of a resistor."
  (when (circuits-solution-states solution) (circuits-find-rates solution))
  (let ((tableau (circuits-solution-tableau solution)))
    (cons '(mlist simp)
          (circuits-expressed
           solution
           (loop for k in (cdr numbers)
                 for branch = (circuits-branch-at tableau k)
                 collect (if (eq (circuits-branch-type branch) '|$e|)
                             (circuits-current-row solution branch)
                             (circuits-difference-row-of solution ($circuits_ends branch)
                                                         (circuits-tableau-sign tableau))))))))

(defun $circuits_tableau_moves (solution numbers)
  "Whether the rate of a source of NUMBERS was needed: a state would depend on it."
  (loop for (sort k n) across (circuits-tableau-descriptors (circuits-solution-tableau solution))
          thereis (and (eq sort :source) (member k (cdr numbers)) (plusp n))))
