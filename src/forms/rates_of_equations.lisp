;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of equations x' = X(t, x): the program of the right sides, shown to have their values at a
;;; random point.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "forms/agreement"
                "forms/fixed" "forms/program_judge" "forms/rates" "forms/rates_impulses"
                "forms/value"))

(defun forms-check-elements (elements expressions)
  "The values of ELEMENTS against those of the EXPRESSIONS that they were made from."
  (let* ((point (forms-new-point t))
         (found (catch 'forms-no-value (forms-program-values elements point))))
    (forms-verdict-of
     "values of the program against those of the right sides"
     (loop for e in expressions
           for value in (or found (mapcar (constantly nil) elements))
           collect (cons value (catch 'forms-no-value (forms-fixed-value e point))))
     point)))

(defun forms-sparse-elements (rows)
  "Sparse rows of elements for the ROWS of expressions."
  (loop for row in rows
        collect (loop for e in (cdr row)
                      for j from 0
                      unless (eql e 0) collect (cons j (algebra-program-element e)))))

(defun $forms_rates_of_equations (variables expressions matrix)
  "M x' = X: MATRIX is a list of rows, or false for the identity."
  (with-algebra-program
    (forms-with-impulses
      (let ((elements (mapcar #'algebra-program-element (cdr expressions))))
        (forms-check-elements elements (cdr expressions))
        (make-forms-rates
         :program *algebra-program* :states (cdr variables) :pairs '()
         :outputs (list (cons '$rates (cons :list elements)))
         :mass (and matrix (forms-sparse-elements (cdr matrix)))
         :angles (forms-angles (cdr variables) elements))))))
