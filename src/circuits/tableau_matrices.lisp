;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The matrices of a linear circuit, x' = A x + B s + B1 s', s the values of the sources in the
;;; order of the branches (T. Bashkow, IRE Transactions on Circuit Theory 4 (1957)). The rate of a
;;; constant source is 0.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/factoring" "circuits/coefficients" "circuits/elements" "circuits/tableau"
                "circuits/tableau_equations" "circuits/tableau_reduction"))

(defun circuits-source-numbers (tableau)
  "Branches of the type E or I; those that stand for windings are none."
  (loop for branch across (circuits-tableau-branches tableau)
        when (and (circuits-type-in-p branch '|$e| '|$i|) (not (circuits-branch-state branch)))
          collect (circuits-branch-number branch)))

(defun $circuits_tableau_matrices (solution)
  "[A = .., B = .., B1 = .., inputs = ..]"
  (let* ((tableau (circuits-solution-tableau solution)) (rows (circuits-rate-rows solution))
         (sources (circuits-source-numbers tableau)))
    (dolist (row rows)
      (circuits-refuse-higher-rates solution row 1)
      (circuits-refuse-nonlinear solution row))
    (flet ((block-of (name columns)
             (list '(mequal simp) name (circuits-matrix-of rows columns)))
           (columns (sort numbers &rest more)
             (loop for k in numbers collect (apply #'circuits-column tableau sort k more))))
      (list '(mlist simp)
            (block-of '|$a| (columns :state (circuits-solution-states solution)))
            (block-of '|$b| (columns :source sources 0))
            (block-of '|$b1| (columns :source sources 1))
            (list '(mequal simp) '$inputs
                  (cons '(mlist simp)
                        (loop for k in sources
                              collect (circuits-branch-value (circuits-branch-at tableau k)))))))))

(defun circuits-matrix-of (rows columns)
  "A matrix without columns is matrix()."
  (cons '($matrix simp)
        (when columns
          (loop for row in rows
                collect (cons '(mlist simp)
                              (loop for column in columns
                                    collect (circuits-factored-entry
                                             (gethash column row 0))))))))

(defun circuits-factored-entry (x)
  (if (rationalp x) (circuits-outside x) (algebra-in-factors x 2000)))

(defun circuits-refuse-nonlinear (solution row)
  (let* ((tableau (circuits-solution-tableau solution))
         (states (loop for k in (circuits-state-numbers tableau)
                       collect (circuits-branch-state (circuits-branch-at tableau k)))))
    (maphash (lambda (column x)
               (when (or (eq :law (car (circuits-descriptor tableau column)))
                         (and (consp x) (notevery (lambda (name) (freeof name x)) states)))
                 (core-error "matrices = true is for linear circuits; this one has nonlinear ~
                              elements")))
             row)))
