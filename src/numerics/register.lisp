;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of numerics gives: programs of the right sides of all kinds of systems, their
;;; values put in. Data only.

(in-package :maxima)

(defparameter *numerics-values* '("values" ((mlist simp))))

(core-public "RateProgram"
  :forms '(("lagrangian" "Lagrangian" "coordinates") ("equations" "equations"))
  :options '("values" "rayleigh" "forces" "constraints" "nonholonomic" "laws" "solved" "function" "cyclic"
             "momenta" "variables")
  :kinds (core-kind-names) :numerical t)
(core-rule "RateProgram" :any "numerics/rate_program" "numerics_rate_program" "rates"
  *numerics-values* '("solved" nil))
