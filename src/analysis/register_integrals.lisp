;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of analysis can compute with integrals and with Lyapunov's functions. Data only.

(in-package :maxima)

(core-require "analysis/register_words")

;;; The method of Routh and Lyapunov

(core-public "SecondVariation"
  :forms '(("function" "K" "variables" "solution" "&optional" "integrals")) :options '("manifold"))
(core-rule "SecondVariation" '("function") "analysis/variation" "analysis_second_variation_named"
  "K" "variables" "solution" (list "integrals" *analysis-none*) (list "manifold" *analysis-none*))

(core-public "RouthLyapunov"
  :forms '(("equations" "equations" "integrals" "variables"))
  :options '("where" "unknowns" "multipliers" "within" "K" "function")
  :kinds (append *analysis-motions* (core-kinds-giving "known_integrals")))
(core-emptied "RouthLyapunov" "solution")
(core-rule "RouthLyapunov" (core-kinds-giving "known_integrals") "analysis/routh_lyapunov"
  "analysis_routh_lyapunov"
  "state_equations" "integrals_on_level" "variables" "special_cases_sought"
  (list "multipliers" *analysis-none*) (list "solution" *analysis-none*))
(core-rule "integrals_on_level" (core-kinds-giving "known_integrals") "analysis/routh_lyapunov"
  "analysis_integrals_on_level" "known_integrals" (list "level" *analysis-none*)
  (list "within" *analysis-none*))
(core-rule-given "K" "integrals_on_level" (core-kinds-giving "known_integrals")
  "analysis/routh_lyapunov" "analysis_integrals_with_combination" "known_integrals"
  (list "level" *analysis-none*) (list "within" *analysis-none*) "K"
  (list "parameters" *analysis-none*) *analysis-integrals*)

;;; Invariant manifolds of equations with integrals; the other rules are in register.lisp

(core-rule "InvariantManifolds" (core-kinds-giving "known_integrals")
  "analysis/manifolds_of_integrals" "analysis_manifolds_of_integrals"
  "state_equations" "integrals_on_level" "variables" "special_cases_sought"
  (list "multipliers" *analysis-none*))

;;; Mechanical systems as equations of the first order with integrals

(core-rule "routh_system_itself" *analysis-motions* "analysis/reduced_system"
  "analysis_routh_system"
  "Lagrangian" "coordinates" '("cyclic" $auto) '("momenta" ((mlist simp))) "actions"
  *analysis-laws*)
(core-rule "routh_system" *analysis-motions* "analysis/reduced_system"
  "analysis_smooth_routh_system"
  "routh_system_itself" *analysis-functions* *analysis-laws* "coordinates")
(core-rule-later "routh_system_asked" *analysis-motions* "routh_system")
(loop for name in '("routh_stationary_equations" "routh_stationary_solutions")
      do (core-rule-later (concatenate 'string name "_asked") *analysis-motions* name))
(core-rule-later "stability_in_coordinates_asked" '("mechanical") "stability_in_coordinates")
(core-rule-later "reduced_system_asked" *analysis-motions* "reduced_system")
(core-rule-tried "euler_poisson_or_why" '("mechanical") "EulerPoisson")
(core-rule-later "euler_poisson_asked" '("mechanical") "euler_poisson_or_why")
(core-rule-later "candidates_asked" '("mechanical") "integral_candidates")
(core-rule-later "variables_asked" '("mechanical") "variables_in_coordinates")
(core-rule-same-as "reduced_system" *analysis-bodiless* "routh_system")
(core-rule-same-as "reduced_system" '("mechanical") "routh_system" :given '("function" $routh))
(core-rule "carried_system" '("mechanical") "analysis/reduced_system" "analysis_carried_system"
  "euler_poisson_asked" "variables_asked" "candidates_asked" *analysis-functions*
  *analysis-laws* "coordinates")
(core-rule "reduced_system" '("mechanical") "analysis/reduced_system" "analysis_reduced_system"
  "carried_system" "routh_system_asked")

(core-rule "RouthLyapunov" *analysis-motions* "analysis/routh_lyapunov"
  "analysis_routh_lyapunov_motion"
  "reduced_system" "coordinates" "special_cases_sought" (list "multipliers" *analysis-none*)
  (list "solution" *analysis-none*))

;;; Multipliers

(core-public "EliminateMultipliers" :forms '(("conditions" "conditions" "multipliers")))
(core-rule "EliminateMultipliers" :any "analysis/multipliers" "analysis_eliminate_multipliers"
  "conditions" "multipliers")

;;; Lyapunov's second method

(core-public "LyapunovTest"
  :forms '(("equations" "equations" "V" "solution"))
  :trailing '("V" "solution") :options '("where" "unknowns") :kinds *analysis-kinds*)
(core-rule "LyapunovTest" *analysis-kinds* "analysis/lyapunov_test" "analysis_lyapunov_test"
  "motion" "V" *analysis-laws*)

;;; A mixed potential as Lyapunov's function

(core-public "BraytonMoser" :options '("where" "solution") :kinds '("circuit"))
(core-rule "BraytonMoser" '("circuit") "analysis/brayton_moser" "analysis_brayton_moser"
  "MixedPotential" "potential_stores" *analysis-where*)
(core-rule-given "solution" "BraytonMoser" '("circuit") "analysis/brayton_moser_verdict"
  "analysis_brayton_moser_judged" "MixedPotential" "potential_stores" *analysis-where* "motion")

;;; First integrals

(core-public "PolynomialIntegrals"
  :forms '(("equations" "equations" "degree"))
  :trailing '("degree") :options '("where" "integrals") :kinds *analysis-states*)
(loop for (kinds integrals) in `((,(remove "poisson" *analysis-states* :test #'string=)
                                  ,*analysis-integrals*)
                                 (("poisson") "poisson_integrals"))
      do (core-rule "PolynomialIntegrals" kinds "analysis/polynomial_integrals"
           "analysis_polynomial_integrals"
           "state_equations" *analysis-variables* "degree" integrals
           (list "level" *analysis-none*) "special_cases"))
