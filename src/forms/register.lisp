;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of forms can compute: from Lagrange's function to equations, for every kind that
;;; has one. Data only.

(in-package :maxima)

(defparameter *forms-kinds* (core-kinds-giving "Lagrangian"))

(core-option :truth "simplify" "expanded" "eliminate" "solved")

(core-argument :formula "Lagrangian" "lagrangian" "hamiltonian")
(core-argument :shape "expression" "f" "g")
(core-argument :variables "coordinates")
(core-argument :motion "motion")

(core-fact-judge "algebra/known_signs" 'algebra-name-signs)
(core-divisor-judge "algebra/divisors" 'algebra-require-divisors)
(core-root-judge "algebra/real_roots" 'algebra-require-root)

;;; What acts beside L, and how equations are wanted

(core-rule "actions" :any "forms/actions" "forms_actions" '("rayleigh" 0) '("forces" ((mlist simp)))
  '("constraints" ((mlist simp))) '("nonholonomic" ((mlist simp))))
(core-rule "canonical_actions" :any "forms/actions" "forms_canonical_actions"
  '("forces" ((mlist simp))) '("constraints" ((mlist simp))) '("nonholonomic" ((mlist simp))))
(core-rule "equation_options" :any "forms/actions" "forms_options" '("simplify" nil)
  '("expanded" nil) '("eliminate" nil) '("form" $auto))

;;; Expressions with velocities

(core-public "TimeDerivative" :forms '(("expressions" "expression" "coordinates")))
(core-rule "TimeDerivative" :any "forms/motion" "forms_time_derivative" "expression" "coordinates")

(core-public "AtMotion" :forms '(("expressions" "expression" "motion")))
(core-rule "AtMotion" :any "forms/motion" "forms_at_motion" "expression" "motion")

;;; Lagrange

(core-public "LagrangeEquations"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("rayleigh" "forces" "constraints" "nonholonomic" "simplify" "expanded" "eliminate")
  :kinds *forms-kinds*)
(core-rule "LagrangeEquations" :any "forms/lagrange" "forms_lagrange_equations"
  "Lagrangian" "coordinates" "actions" "equation_options")

(core-public "MassForm"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("rayleigh" "forces")
  :kinds *forms-kinds*)
(core-rule "MassForm" :any "forms/lagrange" "forms_mass_form"
  "Lagrangian" "coordinates" "actions" '("form" $auto))

(core-public "Quadratics"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :kinds *forms-kinds*)
(core-rule "Quadratics" :any "forms/quadratics" "forms_quadratics" "Lagrangian" "coordinates"
  '("ForceFunction" nil) '("form" $auto))

;;; Routh

(defparameter *forms-routh-inputs*
  '("Lagrangian" "coordinates" ("cyclic" $auto) ("momenta" ((mlist simp))) "actions"))

(core-public "RouthFunction"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("cyclic" "momenta" "rayleigh" "forces" "constraints" "nonholonomic")
  :kinds *forms-kinds*)
(apply #'core-rule "RouthFunction" :any "forms/routh" "forms_routh_function"
       (append *forms-routh-inputs* '(("form" $auto))))

(core-public "RouthEquations"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("cyclic" "momenta" "rayleigh" "forces" "constraints" "nonholonomic" "simplify")
  :kinds *forms-kinds*)
(apply #'core-rule "RouthEquations" :any "forms/routh" "forms_routh_equations"
       (append *forms-routh-inputs* '("equation_options")))

(apply #'core-rule "remaining_coordinates" :any "forms/routh" "forms_remaining_coordinates"
  *forms-routh-inputs*)
(apply #'core-rule "cyclic_integrals" :any "forms/routh" "forms_cyclic_integrals"
  *forms-routh-inputs*)

;;; Hamilton

(core-public "Hamiltonian"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("momenta")
  :kinds *forms-kinds*)
(core-rule "Hamiltonian" :any "forms/hamilton" "forms_hamiltonian"
  "Lagrangian" "coordinates" '("momenta" ((mlist simp))) '("form" $auto))
(core-rule-same-as "Hamiltonian" '("lagrangian") "hamiltonian" :given "hamiltonian")

(core-rule-given "hamiltonian" "Lagrangian" '("lagrangian") "forms/lagrangian_of_hamilton"
  "forms_lagrangian_of_hamilton" "hamiltonian" "coordinates" '("momenta" ((mlist simp))))

(core-public "HamiltonEquations"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("momenta" "rayleigh" "forces" "constraints" "nonholonomic")
  :kinds *forms-kinds*)
(core-rule "HamiltonEquations" :any "forms/hamilton" "forms_hamilton_equations"
  "Lagrangian" "coordinates" '("momenta" ((mlist simp))) "actions" '("form" $auto))
(core-rule-given "hamiltonian" "HamiltonEquations" '("lagrangian") "forms/hamilton"
  "forms_hamilton_equations_of"
  "hamiltonian" "coordinates" '("momenta" ((mlist simp))) "canonical_actions" '("form" $auto))

;;; Port-Hamiltonian form

(core-public "PortHamiltonian"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("momenta" "rayleigh" "forces") :kinds *forms-kinds*)
(core-rule "PortHamiltonian" :any "forms/port_hamiltonian" "forms_port_hamiltonian"
  "Hamiltonian" "HamiltonEquations" "coordinates" "actions")

;;; Dirac

(defparameter *forms-dirac-inputs* '(("momenta" ((mlist simp))) "actions"))

(core-public "DiracScheme"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("momenta" "constraints")
  :kinds *forms-kinds*)
(apply #'core-rule "DiracScheme" :any "forms/dirac" "forms_dirac_scheme" "Lagrangian" "coordinates"
  *forms-dirac-inputs*)

(core-public "DiracBracket"
  :forms '(("lagrangian" "Lagrangian" "coordinates" "f" "g"))
  :trailing '("f" "g")
  :options '("momenta" "constraints")
  :kinds *forms-kinds*)
(apply #'core-rule "DiracBracket" :any "forms/dirac" "forms_dirac_bracket" "Lagrangian"
  "coordinates" "f" "g" *forms-dirac-inputs*)

;;; First integrals

(core-public "FirstIntegrals"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("rayleigh" "forces" "constraints" "nonholonomic")
  :kinds *forms-kinds*)
(core-rule "FirstIntegrals" :any "forms/integrals" "forms_first_integrals"
  "Lagrangian" "coordinates" "actions" '("axis_momenta" ((mlist simp))) '("form" $auto))

;;; Programs

(core-public "EquationProgram"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("rayleigh" "forces" "solved" "inverse")
  :kinds *forms-kinds*)
(dolist (option '(nil ("form" $program)))
  (apply #'core-rule-given option "EquationProgram" :any "forms/equation_program"
         "forms_equation_program" "Lagrangian" "coordinates"
         '("actions" ("laws" ((mlist simp))) ("solved" nil) ("inverse" nil))))
(apply #'core-rule-given '("form" $program) "MassForm" :any "forms/equation_program"
  "forms_mass_program"
       "Lagrangian" "coordinates" '("actions" ("laws" ((mlist simp)))))
(apply #'core-rule-given '("form" $program) "LagrangeEquations" :any "forms/equation_program"
  "forms_lagrange_program"
       "Lagrangian" "coordinates"
       '("actions" ("laws" ((mlist simp))) "equation_options"))

(core-public "ExportProgram"
  :forms '(("expressions" "program" "file"))
  :options '("language" "replace"))
(core-rule "ExportProgram" :any "forms/equation_program" "forms_export_program" "program" "file"
  '("language" $c) '("replace" nil))

;;; Rates of a run; with other numbers they are the same

(defparameter *forms-rates-inputs* '("Lagrangian" "coordinates" "actions" ("laws" ((mlist simp)))))

(defparameter *forms-given-integrals* '("integrals" ((mlist simp))))

(apply #'core-middle "rates" :any "forms/rates_of_systems" "forms_lagrange_rates"
       (append *forms-rates-inputs* (list *forms-given-integrals*)))
(apply #'core-middle "routh_rates" :any "forms/rates_of_systems" "forms_routh_rates"
       (append *forms-rates-inputs* '(("cyclic" $auto) ("momenta" ((mlist simp))))))
(apply #'core-middle "hamilton_rates" :any "forms/rates_of_systems" "forms_hamilton_rates"
       (append *forms-rates-inputs* '(("momenta" ((mlist simp))))))
(core-rule-given "hamiltonian" "hamilton_rates" '("lagrangian") "forms/rates_of_systems"
  "forms_hamiltonian_rates"
  "hamiltonian" "coordinates" '("momenta" ((mlist simp))) "canonical_actions"
  '("laws" ((mlist simp))) *forms-given-integrals*)
(core-rule-same-as "rates" '("lagrangian") "routh_rates" :given '("function" $routh))
(core-rule-same-as "rates" '("lagrangian") "hamilton_rates" :given '("function" $hamilton))
(core-rule-same-as "rates" '("lagrangian") "hamilton_rates" :given "hamiltonian")
(core-rule "rated_equations" '("equations") "forms/constraints" "forms_rated_equations" "equations")
(core-middle "rates" '("equations") "forms/rates_of_systems" "forms_equation_rates"
  "equations" '("laws" ((mlist simp))) '("variables" ((mlist simp))) *forms-given-integrals*
  '("level" ((mlist simp))))
(core-middle "rates_beside_impulses" '("poisson") "forms/rates_of_systems" "forms_equation_rates"
  "state_equations" '("laws" ((mlist simp))) '("variables" ((mlist simp))) "poisson_integrals"
  '("level" ((mlist simp))))
(core-rule "rates" '("poisson") "forms/rates_of_systems" "forms_poisson_rates"
  "rates_beside_impulses" "hamiltonian" "structure_matrix" '("laws" ((mlist simp)))
  '("variables" ((mlist simp))))

;;; Poisson

(core-rule "poisson_equations" '("poisson") "forms/poisson" "forms_poisson_equations"
  "variables" '("bracket" ((mlist simp))) '("algebra" ((mlist simp))) "hamiltonian")
(core-rule "structure_matrix" '("poisson") "forms/poisson" "forms_structure_matrix"
  "variables" '("bracket" ((mlist simp))) '("algebra" ((mlist simp))))
(core-rule "poisson_integrals" '("poisson") "forms/poisson" "forms_poisson_integrals"
  "hamiltonian" '("integrals" ((mlist simp)))
  "variables" '("bracket" ((mlist simp))) '("algebra" ((mlist simp))))
