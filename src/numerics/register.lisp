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

(core-rule-same-as "run_start" :any "start")
(core-rule "run" :any "numerics/run_options" "numerics_wishes" '("method" $auto) '("points" 101)
  '("tolerance" 1d-8) '("events" ((mlist simp))) '("stop" nil) '("digits" 0) '("first_step" 0)
  '("estimate" nil) '("conditioning" nil))

(core-public "Simulate"
  :forms '(("lagrangian" "Lagrangian" "coordinates" "start" "time")
           ("equations" "equations" "start" "time"))
  :trailing '("start" "time")
  :options '("values" "method" "points" "tolerance" "events" "stop" "digits" "first_step"
             "integrals" "estimate" "conditioning" "plot" "file" "replace" "rayleigh" "forces"
             "constraints" "nonholonomic" "laws" "function" "cyclic" "momenta" "variables")
  :kinds (core-kind-names) :numerical t)
(core-rule-same-as "run_start" :any "start")
(core-rule "derivation_began" :any "numerics/native" "numerics_working_seconds")
(core-rule "Simulate" :any "numerics/simulate" "numerics_simulate" "derivation_began" "rates"
  *numerics-values* "run_start" "time" "run")

;;; What methods reach, and what it costs

(core-rule "trial" :any "numerics/trial" "numerics_trial" "derivation_began" "rates"
  *numerics-values* "run_start" "time")

(core-public "ReferenceSolution"
  :forms '(("lagrangian" "Lagrangian" "coordinates" "start" "time")
           ("equations" "equations" "start" "time"))
  :trailing '("start" "time")
  :options '("values" "integrals" "rayleigh" "forces" "constraints" "nonholonomic" "laws" "function"
             "cyclic" "momenta" "variables")
  :kinds (core-kind-names) :numerical t)
(core-rule "ReferenceSolution" :any "numerics/trial_reference" "numerics_reference_solution"
  "trial")

(core-public "ErrorAgainstTime"
  :forms '(("lagrangian" "Lagrangian" "coordinates" "start" "time")
           ("equations" "equations" "start" "time"))
  :trailing '("start" "time")
  :options '("values" "methods" "tolerances" "cell" "file" "replace" "integrals" "rayleigh" "forces"
             "constraints" "nonholonomic" "laws" "function" "cyclic" "momenta" "variables")
  :kinds (core-kind-names) :numerical t)
(core-rule "contest" :any "numerics/error_against_time" "numerics_contest" "trial"
  '("methods" ((mlist simp) $auto $dop853 $radau $gauss $dlsode))
  '("tolerances" ((mlist simp) 1d-4 1d-6 1d-8 1d-10 1d-12)) '("cell" 2))
(core-rule "ErrorAgainstTime" :any "numerics/error_against_time" "numerics_error_against_time"
  "contest" "ReferenceSolution")
(core-act "ErrorAgainstTime" nil :any "numerics/error_plot" "numerics_error_plot" "picture"
  "ErrorAgainstTime")

;;; Pictures

(core-option :file "file")
(core-option :truth "replace")
(core-argument :window "horizontal" "vertical")

(core-rule "picture" :any "numerics/pictures" "numerics_picture" '("file" nil) '("replace" nil))
(core-rule "curves" :any "numerics/time_plot" "numerics_curves" "plot" "rates" *numerics-values*
  "run_start")
(core-act "Simulate" "plot" :any "numerics/time_plot" "numerics_time_plot" "picture" "curves"
  "Simulate")

(core-rule "window" :any "numerics/plane_axes" "numerics_window" "horizontal" "vertical"
  '("start" ((mlist simp))))
(core-rule-tried "rest_points_or_why" :any "rest_points")
(core-rule "plane" :any "numerics/plane" "numerics_plane" "rates" *numerics-values* "window")
(core-rule "portrait" :any "numerics/phase_portrait" "numerics_portrait" "plane"
  "rest_points_or_why")

(core-public "PhasePortrait"
  :forms '(("lagrangian" "Lagrangian" "coordinates" "horizontal" "vertical")
           ("equations" "equations" "horizontal" "vertical"))
  :trailing '("horizontal" "vertical")
  :options '("values" "start" "file" "replace" "rayleigh" "forces" "constraints" "nonholonomic"
             "laws" "function" "cyclic" "momenta" "variables")
  :numerical t)
(core-act "PhasePortrait" nil :any "numerics/phase_portrait" "numerics_phase_portrait" "picture"
  "portrait")
(core-act "StabilityMap" nil :any "numerics/stability_map_plot" "numerics_stability_map" "picture"
  "StabilityMap" "map_strips")

;;; Transfer functions on the axis s = i*w

(core-rule "frequency_curve" '("circuit") "numerics/frequency" "numerics_frequency_curve"
  "response" *numerics-values* '("frequencies" nil))
(loop for (name function) in '(("BodePlot" "numerics_bode_plot")
                               ("NyquistPlot" "numerics_nyquist_plot"))
      do (core-public name :trailing '("output" "input")
           :options '("values" "frequencies" "file" "replace") :kinds '("circuit") :numerical t)
         (core-act name nil '("circuit") "numerics/frequency_plots" function "picture"
           "frequency_curve"))

(core-public "DrawStructure"
  :options '("file" "replace") :kinds (core-kinds-giving "structure_graph"))
(core-act "DrawStructure" nil (core-kinds-giving "structure_graph") "numerics/structure_picture"
  "numerics_draw_structure" "picture" "structure_graph")
