;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of numerics gives: programs of the right sides of all kinds of systems, their
;;; values put in. Data only.

(in-package :maxima)

(defparameter *numerics-values* '("values" ((mlist simp))))

(core-public "RateProgram"
  :forms '(("lagrangian" "Lagrangian" "coordinates") ("equations" "equations"))
  :options '("values" "rayleigh" "forces" "constraints" "nonholonomic" "laws" "solved" "function"
             "cyclic" "momenta" "variables")
  :kinds (core-kind-names) :numerical t)
(core-rule "RateProgram" :any "numerics/rate_program" "numerics_rate_program" "rates"
  *numerics-values* '("solved" nil))

;;; Runs

(core-option '("auto" "dop853" "radau" "gauss" "dlsode") "method")
(core-option :truth "stop" "estimate" "conditioning")
(core-argument :motion "start")
(core-argument :interval "time")

(core-rule "run" :any "numerics/run_options" "numerics_wishes" '("method" $auto) '("points" 101)
  '("tolerance" 1d-8) '("events" ((mlist simp))) '("stop" nil) '("digits" 0) '("first_step" 0)
  '("estimate" nil) '("conditioning" nil))

(core-public "Simulate"
  :forms '(("lagrangian" "Lagrangian" "coordinates" "start" "time")
           ("equations" "equations" "start" "time"))
  :trailing '("start" "time")
  :options '("values" "method" "points" "tolerance" "events" "stop" "digits" "first_step" "rayleigh"
             "forces" "constraints" "nonholonomic" "laws" "function" "cyclic" "momenta" "variables"
             "integrals" "estimate" "conditioning")
  :kinds (core-kind-names) :numerical t)
(core-rule "derivation_began" :any "numerics/native" "numerics_seconds")
(core-rule "Simulate" :any "numerics/simulate" "numerics_simulate" "derivation_began" "rates"
  *numerics-values* "start" "time" "run")
