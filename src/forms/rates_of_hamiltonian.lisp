;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of Hamilton's function H(q, p, t) as it was given, for Maxima.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/impulses" "algebra/program_from_expressions" "algebra/program_nodes"
                "forms/rates_impulses" "forms/momenta_judge" "forms/program_judge"
                "forms/rates_of_momenta"))

(defun $forms_rates_of_hamiltonian (function forces names task)
  "FUNCTION is H, FORCES are [Q_1, ..], NAMES those of the momenta."
  (with-algebra-program
    (let ((task (forms-read-task task)) (names (cdr names)))
      (multiple-value-bind (rates motion)
          (let ((*algebra-impulses* t))
            (forms-rates-of-hamiltonian (algebra-program-element function)
                                        (mapcar #'algebra-program-element (cdr forces))
                                        names task))
        (forms-check-canonical function (cdr forces) names task motion)
        (forms-impulses-apart rates)))))
