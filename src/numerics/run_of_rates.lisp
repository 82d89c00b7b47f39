;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; From the rates of a system to its run: numbers put in, cyclic coordinates added where the start
;;; names them, M divided out as far as the method wants. Look first at numerics-settled-run.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/rate_program" "numerics/run" "numerics/run_options"))

(defun numerics-mass-wanted (wishes)
  "How far M is divided out: Radau's method takes it as it is."
  (if (eq (numerics-wishes-method wishes) '$radau) nil :regular))

(defun numerics-settled-run (rates values start span wishes &key (how :auto))
  "Two values: the run, ready to be made, of RATES with VALUES from START over SPAN, and the exact
start values of its states. HOW as of numerics-problem-of."
  (let* ((pairs (numerics-parameter-pairs values rates))
         (rates (numerics-with-quadratures
                 (numerics-run-rates rates pairs (numerics-mass-wanted wishes)) start))
         (exact (numerics-start-values rates start values)))
    (values (numerics-new-run rates pairs exact span wishes :how how) exact)))
