;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of forms can compute: from Lagrange's function to equations, for every kind that has one. Data only.

(in-package :maxima)

(defparameter *forms-kinds* '("mechanical" "lagrangian" "circuit"))

;;; Expressions with velocities

(core-public "TimeDerivative" :forms '(("expressions" "expression" "coordinates")))
(core-rule "TimeDerivative" :any "forms/motion" "forms_time_derivative" "expression" "coordinates")

(core-public "AtMotion" :forms '(("expressions" "expression" "motion")))
(core-rule "AtMotion" :any "forms/motion" "forms_at_motion" "expression" "motion")

;;; Lagrange

(core-rule-same-as "Lagrangian" '("lagrangian") "lagrangian")

(core-public "LagrangeEquations"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("rayleigh" "forces" "constraints" "nonholonomic" "simplify" "expanded" "eliminate")
  :kinds *forms-kinds*)
(core-rule "LagrangeEquations" :any "forms/lagrange" "forms_lagrange_equations"
  "Lagrangian" "coordinates" '("rayleigh" 0) '("forces" ((mlist simp))) '("constraints" ((mlist simp)))
  '("nonholonomic" ((mlist simp))) '("simplify" nil) '("expanded" nil) '("eliminate" nil))

(core-public "MassForm"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("rayleigh" "forces")
  :kinds *forms-kinds*)
(core-rule "MassForm" :any "forms/mass" "forms_mass_form"
  "Lagrangian" "coordinates" '("rayleigh" 0) '("forces" ((mlist simp))))

(core-public "Quadratics"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :kinds *forms-kinds*)
(core-rule "Quadratics" :any "forms/quadratics" "forms_quadratics" "Lagrangian" "coordinates" '("ForceFunction" nil))

;;; Routh

(core-public "RouthFunction"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("cyclic" "momenta" "rayleigh" "forces" "constraints" "nonholonomic")
  :kinds *forms-kinds*)
(core-rule "RouthFunction" :any "forms/routh" "forms_routh_function"
  "Lagrangian" "coordinates" '("cyclic" $auto) '("momenta" ((mlist simp))) '("rayleigh" 0) '("forces" ((mlist simp)))
  '("constraints" ((mlist simp))) '("nonholonomic" ((mlist simp))))

(core-public "RouthEquations"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("cyclic" "momenta" "rayleigh" "forces" "constraints" "nonholonomic" "simplify")
  :kinds *forms-kinds*)
(core-rule "RouthEquations" :any "forms/routh" "forms_routh_equations"
  "Lagrangian" "coordinates" '("cyclic" $auto) '("momenta" ((mlist simp))) '("rayleigh" 0) '("forces" ((mlist simp)))
  '("constraints" ((mlist simp))) '("nonholonomic" ((mlist simp))) '("simplify" nil))

(core-rule "routh_variables" :any "forms/routh" "forms_routh_variables"
  "Lagrangian" "coordinates" '("cyclic" $auto) '("momenta" ((mlist simp))) '("rayleigh" 0) '("forces" ((mlist simp)))
  '("constraints" ((mlist simp))) '("nonholonomic" ((mlist simp))))
(core-rule-field "remaining_coordinates" :any "routh_variables" 2)

;;; Hamilton

(core-public "Hamiltonian"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("momenta")
  :kinds *forms-kinds*)
(core-rule "Hamiltonian" :any "forms/hamilton" "forms_hamiltonian"
  "Lagrangian" "coordinates" '("momenta" ((mlist simp))))

(core-public "HamiltonEquations"
  :forms '(("lagrangian" "Lagrangian" "coordinates"))
  :options '("momenta" "rayleigh" "forces")
  :kinds *forms-kinds*)
(core-rule "HamiltonEquations" :any "forms/hamilton" "forms_hamilton_equations"
  "Lagrangian" "coordinates" '("momenta" ((mlist simp))) '("rayleigh" 0) '("forces" ((mlist simp))))
