;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Lists of kinds and of arguments that the registers of analysis share, and what arguments are.

(in-package :maxima)


(defparameter *analysis-states* (core-kinds-giving "state_equations")
  "Kinds whose equations are of first order.")
(defparameter *analysis-motions*
  (remove-if (lambda (kind) (member kind *analysis-states* :test #'string=))
             (core-kinds-giving "Lagrangian"))
  "Kinds whose equations are of second order.")
(defparameter *analysis-bodiless* (remove "mechanical" *analysis-motions* :test #'string=)
  "Those without bodies.")
(defparameter *analysis-kinds* (append *analysis-motions* *analysis-states*))
(defparameter *analysis-none* '((mlist simp)))
(defparameter *analysis-lambda* (list "lambda" (core-symbol "lambda")))

(defparameter *analysis-linear-options* '("where" "unknowns" "function" "cyclic")
  "Options of the first approximation and of what is computed from it.")
(defparameter *analysis-where* (list "where" *analysis-none*))
(defparameter *analysis-laws* (list "laws" *analysis-none*))
(defparameter *analysis-unknowns* (list "unknowns" *analysis-none*))
(defparameter *analysis-variables* (list "variables" *analysis-none*))

(defparameter *analysis-integrals* (list "integrals" *analysis-none*))

(defparameter *analysis-functions* (list "functions_derived" *analysis-none*)
  "What equations are derivatives of.")

;;; Arguments. K is a function, and a matrix where forces are given by theirs.

(core-argument :formula "K" "polynomial" "V")
(core-argument :square "A" "B" "M" "S" "W" "D" "G" "P" '("K" "forces"))
(core-argument :variables "variables")
(core-argument :variable "lambda" "u")
(core-argument :solution "solution")
(core-argument :rates "equations")
(core-argument :integrals "integrals")
(core-argument :vanishing "within" "manifold")
(core-argument :conditions "conditions")

(core-abbreviator "analysis/abbreviate" "analysis_abbreviate")
