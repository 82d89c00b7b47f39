;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of analysis can compute, for archives, for equations and for functions typed in
;;; the session. Data only. The kinds "function", "matrices", "pencil" and "polynomial" stand for
;;; calls on expressions.

(in-package :maxima)

(core-require "analysis/register_words" "analysis/register_integrals")

;;; Stationary sets

(loop for (reduced other function)
        in '(("reduced_function" "RouthFunction" "analysis_reduced_function")
             ("reduced_coordinates" "remaining_coordinates" "analysis_reduced_coordinates")
             ("reduced_integrals" "cyclic_integrals" "analysis_reduced_integrals"))
      for asked = (concatenate 'string "routh_" other "_asked")
      do (core-rule-later asked *analysis-motions* other)
         (core-rule reduced *analysis-motions* "analysis/reduced_function" function
           "Lagrangian" "coordinates" '("cyclic" $auto) "actions" asked))

(core-public "StationaryEquations" :forms '(("function" "K" "variables"))
  :options '("where" "multipliers" "function") :kinds *analysis-motions*)
(core-rule "StationaryEquations" '("function") "analysis/stationary"
  "analysis_stationary_equations" "K" "variables")
(core-rule "routh_stationary_equations" *analysis-motions* "analysis/stationary"
  "analysis_stationary_system" "reduced_function" "reduced_coordinates" "actions")
(core-rule-same-as "StationaryEquations" *analysis-bodiless* "routh_stationary_equations")
(core-rule-same-as "StationaryEquations" '("mechanical") "routh_stationary_equations"
  :given '("function" $routh))
(core-rule "StationaryEquations" '("mechanical") "analysis/stationary_bodies"
  "analysis_stationary_equations_of_bodies"
  "carried_system" "routh_stationary_equations_asked" "special_cases_sought"
  (list "multipliers" *analysis-none*))

(core-public "StationarySolutions"
  :forms '(("function" "K" "variables")) :options '("unknowns" "where" "multipliers" "function")
  :kinds *analysis-motions*)
(core-rule "StationarySolutions" '("function") "analysis/stationary" "analysis_stationary_solutions"
  "K" "variables" *analysis-unknowns* *analysis-where*)
(core-rule "routh_stationary_solutions" *analysis-motions* "analysis/stationary"
  "analysis_system_motions" "reduced_function" "reduced_coordinates" "actions" *analysis-unknowns*
  *analysis-where*)
(core-rule-same-as "StationarySolutions" *analysis-bodiless* "routh_stationary_solutions")
(core-rule-same-as "StationarySolutions" '("mechanical") "routh_stationary_solutions"
  :given '("function" $routh))
(core-rule "StationarySolutions" '("mechanical") "analysis/stationary_bodies"
  "analysis_stationary_solutions_of_bodies"
  "carried_system" "routh_stationary_solutions_asked" "special_cases_sought"
  (list "multipliers" *analysis-none*))

(core-public "InvariantManifolds"
  :forms '(("function" "K" "variables") ("equations" "equations" "integrals" "variables"))
  :options '("extend" "within" "unknowns" "cyclic" "where" "multipliers" "K")
  :kinds (append *analysis-motions* (core-kinds-giving "known_integrals")))
(core-rule-given "extend" "InvariantManifolds" *analysis-motions* "analysis/manifolds"
  "analysis_extended_motion" "reduced_function" "reduced_coordinates" "extend" "reduced_integrals"
  "actions")
(core-rule-given "extend" "InvariantManifolds" '("function") "analysis/manifolds"
  "analysis_extended_function" "K" "variables" "extend")
(core-rule "InvariantManifolds" '("function") "analysis/stationary"
  "analysis_invariant_manifolds"
  "K" "variables" *analysis-unknowns* (list "within" *analysis-none*))

(core-public "Equilibria"
  :forms '(("equations" "equations" "variables")) :options '("unknowns" "where")
  :kinds *analysis-kinds*)
(core-rule "Equilibria" '("equations") "analysis/jumps" "analysis_smooth_equilibria"
  "equations" *analysis-variables* *analysis-unknowns* *analysis-where*
  *analysis-laws* *analysis-functions*)
(core-rule "Equilibria" *analysis-states* "analysis/jumps" "analysis_smooth_equilibria"
  "state_equations" *analysis-variables* *analysis-unknowns* *analysis-where*
  *analysis-laws* *analysis-functions*)
(core-rule "Equilibria" *analysis-motions* "analysis/jumps" "analysis_smooth_equilibria_motion"
  "LagrangeEquations" "coordinates" *analysis-unknowns* *analysis-where*
  *analysis-laws* *analysis-functions*)

;;; The motion that is asked about

(core-rule "special_cases" :any "analysis/motion_records" "analysis_special_cases"
  *analysis-where* *analysis-laws*)
(core-rule "special_cases_sought" :any "analysis/motion_records" "analysis_special_cases"
  *analysis-where* *analysis-laws* *analysis-unknowns*)
(core-rule "undisturbed_motion" '("equations") "analysis/second_order" "analysis_equations_motion"
  "equations" *analysis-variables* "solution" "special_cases_sought")
(core-rule "undisturbed_motion" (remove "circuit" *analysis-states* :test #'string=)
  "analysis/given_solution" "analysis_state_motion"
  "state_equations" *analysis-variables* "solution" "special_cases_sought")
(core-rule "undisturbed_motion" '("circuit") "analysis/forced_motion" "analysis_circuit_motion"
  "state_equations" *analysis-variables* (list "solution" *analysis-none*) "special_cases_sought"
  "assumptions")
(core-rule "undisturbed_motion" *analysis-motions* "analysis/given_solution"
  "analysis_lagrange_motion" "LagrangeEquations" "coordinates" "solution" "special_cases")
(core-rule "charge_motion" '("circuit") "analysis/second_order" "analysis_charge_motion"
  "LagrangeEquations" "coordinates" (list "solution" *analysis-none*) "special_cases"
  "assumptions")
(core-rule "undisturbed_routh_motion" :any "analysis/first_approximation" "analysis_routh_motion"
  "RouthEquations" "remaining_coordinates" "coordinates" "cyclic_integrals" "solution"
  "special_cases")
(core-rule "undisturbed_hamilton_motion" :any "analysis/first_approximation"
  "analysis_hamilton_motion"
  "HamiltonEquations" "coordinates" "solution" "special_cases")
(core-rule "motion" *analysis-kinds* "analysis/jumps" "analysis_smooth_motion"
  "undisturbed_motion" *analysis-functions* *analysis-laws*)
(loop for motion in '("routh_motion" "hamilton_motion")
      for undisturbed = (concatenate 'string "undisturbed_" motion)
      do (core-rule motion *analysis-motions* "analysis/jumps" "analysis_smooth_motion"
           undisturbed *analysis-functions* *analysis-laws*)
         (core-rule-same-as motion *analysis-states* undisturbed))

(dolist (given '(nil :file))
  (core-rule-given given "functions_derived" (if given *analysis-motions* '("lagrangian"))
    "analysis/jumps" "analysis_functions_of_motion" "Lagrangian" "actions"))
(core-rule-given "hamiltonian" "functions_derived" '("lagrangian") "analysis/jumps"
  "analysis_function_alone" "hamiltonian")
(core-rule "functions_derived" '("poisson") "analysis/jumps" "analysis_function_alone"
  "hamiltonian")
(loop for given in '("potential" (:edited "MixedPotential"))
      do (core-rule-given given "functions_derived" '("circuit") "analysis/jumps"
           "analysis_function_alone" "MixedPotential"))

;;; First approximation and criteria

(core-option '("lagrange" "routh" "hamilton") "function")
(core-public "FirstApproximation"
  :forms '(("lagrangian" "Lagrangian" "coordinates" "solution")
           ("equations" "equations" "solution"))
  :trailing '("solution") :options *analysis-linear-options* :kinds *analysis-kinds*)
(core-rule "FirstApproximation" '("equations") "analysis/second_order" "analysis_approximation"
  "motion")
(core-rule "FirstApproximation" *analysis-states* "analysis/first_approximation"
  "analysis_state_approximation" "motion")
(core-rule-given '("function" $lagrange) "FirstApproximation" '("circuit")
  "analysis/first_approximation" "analysis_second_order_approximation" "charge_motion")
(core-rule "FirstApproximation" *analysis-motions* "analysis/first_approximation"
  "analysis_second_order_approximation" "motion")
(core-rule-given '("function" $routh) "FirstApproximation" *analysis-kinds*
  "analysis/first_approximation" "analysis_second_order_approximation" "routh_motion")
(loop for (given kinds) in `((("function" $hamilton) ,*analysis-kinds*)
                             ("hamiltonian" ("lagrangian")))
      do (core-rule-given given "FirstApproximation" kinds "analysis/first_approximation"
           "analysis_state_approximation" "hamilton_motion"))

(core-rule-same-as "second_order_approximation" *analysis-kinds* "FirstApproximation"
  :given '("function" $routh))
(core-rule "second_order_approximation" '("circuit") "analysis/first_approximation"
  "analysis_second_order_approximation" "charge_motion")
(core-rule "second_order_approximation" '("equations") "analysis/second_order"
  "analysis_second_order_only" "motion")
(core-rule-same-as "second_order_approximation" *analysis-kinds* "FirstApproximation")

(core-rule-field "A" *analysis-kinds* "FirstApproximation" "A")
(loop for part in '("M" "S" "W")
      do (core-rule-field part *analysis-kinds* "second_order_approximation" part)
         (core-rule-given '("function" $hamilton) part *analysis-kinds*
           "analysis/first_approximation" "analysis_no_second_order"))

(core-public "CharacteristicPolynomial"
  :forms '(("matrices" "A" "lambda") ("pencil" "M" "S" "W" "lambda"))
  :trailing '("solution") :options (cons "lambda" *analysis-linear-options*)
  :kinds *analysis-kinds*)
(core-rule "CharacteristicPolynomial" (cons "matrices" *analysis-states*) "analysis/characteristic"
  "analysis_characteristic_polynomial" "A" *analysis-lambda*)
(core-rule "CharacteristicPolynomial" (cons "pencil" *analysis-motions*) "analysis/characteristic"
  "analysis_pencil_polynomial" "M" "S" "W" *analysis-lambda*)
(loop for given in '(("function" $hamilton) "hamiltonian")
      do (core-rule-given given "CharacteristicPolynomial" *analysis-motions*
           "analysis/characteristic"
           "analysis_characteristic_polynomial" "A" *analysis-lambda*))
(dolist (function '($lagrange $routh))
  (core-rule-given (list "function" function) "CharacteristicPolynomial" *analysis-states*
    "analysis/characteristic"
    "analysis_pencil_polynomial" "M" "S" "W" *analysis-lambda*))

(core-rule-same-as "polynomial" *analysis-kinds* "CharacteristicPolynomial")

(loop for (name part function)
        in '(("HurwitzMinors" "criteria" "analysis_hurwitz_minors")
             ("RouthHurwitz" "criteria_where_real" "analysis_routh_hurwitz_where_real")
             ("LienardChipart" "criteria_where_real" "analysis_lienard_chipart_where_real"))
      do (core-public name :forms '(("polynomial" "polynomial" "lambda")) :trailing '("solution")
                           :options (cons "lambda" *analysis-linear-options*)
                           :kinds *analysis-kinds*)
         (core-rule name :any (concatenate 'string "analysis/" part) function
           "polynomial" *analysis-lambda*))

(core-public "Stability"
  :forms '(("equations" "equations" "solution"))
  :trailing '("solution") :options *analysis-linear-options* :kinds *analysis-kinds*)
(core-rule "Stability"
  (set-difference *analysis-states* (core-kinds-giving "known_integrals") :test #'string=)
  "analysis/stability" "analysis_stability_state" "motion")
(core-rule "Stability" '("equations") "analysis/stability_by_form"
  "analysis_stability_equations"
  "motion" *analysis-integrals* (list "level" *analysis-none*) *analysis-laws*)
(core-rule "Stability" '("poisson") "analysis/stability_by_integrals"
  "analysis_stability_poisson"
  "motion" "hamiltonian" *analysis-integrals* "structure_matrix" *analysis-laws*)
(core-rule "Stability" '("mechanical") "analysis/stability_of_bodies"
  "analysis_stability_of_bodies"
  "coordinates" "solution" "special_cases_sought" "stability_in_coordinates_asked"
  "reduced_system_asked")
(core-rule "stability_in_coordinates" *analysis-motions* "analysis/stability_by_energy"
  "analysis_stability_lagrangian"
  "motion" "Lagrangian" "actions" *analysis-laws*)
(core-rule-same-as "Stability" *analysis-bodiless* "stability_in_coordinates")
(core-rule-given '("function" $lagrange) "Stability" '("circuit") "analysis/stability_by_form"
  "analysis_stability_charges" "charge_motion")
(core-rule-given '("function" $routh) "Stability" *analysis-kinds* "analysis/stability_by_energy"
  "analysis_stability_lagrangian"
  "routh_motion" "RouthFunction" "actions" *analysis-laws*)
(loop for (given kinds) in `((("function" $hamilton) ,*analysis-kinds*)
                             ("hamiltonian" ("lagrangian")))
      do (core-rule-given given "Stability" kinds "analysis/stability_by_form"
           "analysis_stability_hamilton" "hamilton_motion" "Hamiltonian" "actions"
           *analysis-laws*))
(core-rule-given "integrals" "Stability" '("lagrangian") "analysis/phase_flow"
  "analysis_stability_lagrangian_known"
  "motion" "Lagrangian" "actions" *analysis-laws* "integrals")

;;; What is drawn: equilibria with verdicts, numbers put in for parameters

(defparameter *analysis-values* (list "values" *analysis-none*))
(core-rule "rest_points" '("equations") "analysis/rest_points" "analysis_rest_points_state"
  "equations" *analysis-variables* *analysis-values* *analysis-laws*)
(core-rule "rest_points" *analysis-states* "analysis/rest_points" "analysis_rest_points_state"
  "state_equations" *analysis-variables* *analysis-values* *analysis-laws*)
(core-rule "rest_points" *analysis-motions* "analysis/rest_points" "analysis_rest_points_lagrange"
  "LagrangeEquations" "coordinates" "Lagrangian" "actions" *analysis-values* *analysis-laws*)
(core-rule-given '("function" $routh) "rest_points" *analysis-kinds* "analysis/rest_points"
  "analysis_rest_points_lagrange"
  "RouthEquations" "remaining_coordinates" "RouthFunction" "actions" *analysis-values*
  *analysis-laws*)
(loop for (given kinds) in `((("function" $hamilton) ,*analysis-kinds*)
                             ("hamiltonian" ("lagrangian")))
      do (core-rule-given given "rest_points" kinds "analysis/rest_points"
           "analysis_rest_points_hamilton"
           "HamiltonEquations" "Hamiltonian" "actions" *analysis-values* *analysis-laws*))

;;; A map of stability over two parameters

(core-public "StabilityMap"
  :forms '(("polynomial" "polynomial" "horizontal" "vertical"))
  :trailing '("horizontal" "vertical")
  :options (append '("values" "solution" "lambda" "file" "replace") *analysis-linear-options*)
  :kinds *analysis-kinds*)
(core-rule "stability_map" '("polynomial") "analysis/stability_map" "analysis_polynomial_map"
  "polynomial" "horizontal" "vertical")
(core-rule "stability_map" (remove "circuit" *analysis-states* :test #'string=)
  "analysis/stability_map" "analysis_state_map" "CharacteristicPolynomial" *analysis-lambda*
  "motion" *analysis-values* "horizontal" "vertical")
(core-rule "stability_map" '("circuit") "analysis/stability_map" "analysis_circuit_map"
  "CharacteristicPolynomial" *analysis-lambda* "motion" *analysis-values* "map_axes" "assumptions")
(core-rule "map_axes" :any "analysis/stability_map" "analysis_map_axes" "horizontal" "vertical")
(core-rule "map_theorems" :any "analysis/stability_map" "analysis_map_theorems" "Lagrangian"
  "actions" *analysis-laws*)
(core-rule "stability_map" *analysis-motions* "analysis/stability_map" "analysis_second_order_map"
  "CharacteristicPolynomial" *analysis-lambda* "motion" *analysis-values* "map_axes"
  "map_theorems")
(core-rule "StabilityMap" :any "analysis/stability_map" "analysis_map_record" "stability_map")
(core-rule "map_strips" :any "analysis/map_strips" "analysis_map_strips" "stability_map")

;;; Matrices and forms

(core-public "RootCount" :forms '(("polynomial" "polynomial" "lambda")) :trailing '("solution")
                         :options (cons "lambda" *analysis-linear-options*) :kinds *analysis-kinds*)
(core-rule "RootCount" :any "analysis/characteristic" "analysis_root_count" "polynomial"
  *analysis-lambda*)

(core-public "RealNegativeRoots" :forms '(("polynomial" "polynomial" "u")))
(core-rule "RealNegativeRoots" :any "analysis/criteria_where_real"
  "analysis_real_negative_roots_where_real" "polynomial" "u")

(loop for (name function) in '(("LeadingMinors" "analysis_leading_minors")
                               ("Signature" "analysis_signature"))
      do (core-public name :forms '(("matrices" "A")))
         (core-rule name :any "analysis/definite" function "A"))

(defparameter *analysis-part* (list "part" *analysis-none*))
(core-option :truth "squares")
(core-public "Definite" :forms '(("matrices" "A") ("function" "K" "variables"))
                        :options '("part" "squares"))
(core-rule "Definite" '("matrices") "analysis/semidefinite" "analysis_definite_or_undecided"
  "A" *analysis-part*)
(core-rule "Definite" '("function") "analysis/definite_function" "analysis_definite_function"
  "K" "variables" *analysis-part* '("squares" nil))

(core-public "ReduceForms" :forms '(("matrices" "A" "B")))
(core-rule "ReduceForms" '("matrices") "analysis/reduce_forms" "analysis_reduce_forms" "A" "B")

(defparameter *analysis-pencils* (append *analysis-motions* '("circuit"))
  "Kinds whose first approximation has matrices M, S, W, circuits in charges.")

(core-public "ForceStructure"
  :forms '(("pencil" "M" "S" "W") ("equations" "equations" "solution"))
  :trailing '("solution") :options '("where" "function" "cyclic") :kinds *analysis-pencils*)
(core-rule "ForceStructure" :any "analysis/kelvin_chetaev" "analysis_force_structure" "M" "S" "W")

(core-public "KelvinChetaev"
  :forms '(("forces" "M" "D" "G" "K" "P") ("equations" "equations" "solution"))
  :trailing '("solution") :options '("where" "function" "cyclic") :kinds *analysis-pencils*)
(core-rule "KelvinChetaev" '("forces") "analysis/kelvin_chetaev" "analysis_kelvin_chetaev"
  "M" "D" "G" "K" "P")
(loop for (motion kinds) in `(("motion" ,(cons "equations" *analysis-motions*))
                              ("charge_motion" ("circuit")))
      do (core-rule "KelvinChetaev" kinds "analysis/kelvin_chetaev"
           "analysis_kelvin_chetaev_system" "M" "D" "G" "potential_part" "P" motion))
(core-rule-given '("function" $routh) "KelvinChetaev" *analysis-pencils* "analysis/kelvin_chetaev"
  "analysis_kelvin_chetaev_system"
  "M" "D" "G" "potential_part" "P" "routh_motion")
(loop for (name part) in '(("D" "D") ("G" "G") ("potential_part" "K") ("P" "P"))
      do (core-rule-field name (cons "equations" *analysis-pencils*) "ForceStructure" part))

;;; Integrals of linear systems

(loop for (name function) in '(("LinearIntegrals" "linear_integrals")
                               ("QuadraticIntegrals" "quadratic_integrals"))
      do (core-public name :forms '(("matrices" "A" "variables") ("pencil" "M" "S" "W" "variables"))
                           :trailing '("solution") :options *analysis-linear-options*
                           :kinds *analysis-kinds*)
         (flet ((rule (kinds before after &rest inputs)
                  (apply #'core-rule name kinds "analysis/linear_system"
                         (concatenate 'string "analysis_" before function after) inputs)))
           (rule '("matrices") "" "" "A" "variables")
           (rule '("pencil") "pencil_" "" "M" "S" "W" "variables")
           (rule *analysis-kinds* "" "_near" "FirstApproximation")))
