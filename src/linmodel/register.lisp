;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of rigid bodies can compute from a mechanical archive. Data only.

(in-package :maxima)

(core-public "Kinematics" :kinds '("mechanical"))
(core-rule "Kinematics" '("mechanical") "linmodel/lagrangian" "linmodel_kinematics" "description"
  '("form" $auto))

(core-public "KineticEnergy" :kinds '("mechanical"))
(core-rule "KineticEnergy" '("mechanical") "linmodel/lagrangian" "linmodel_kinetic_energy"
  "description" '("form" $auto))

(core-public "ForceFunction" :kinds '("mechanical"))
(core-rule "ForceFunction" '("mechanical") "linmodel/lagrangian" "linmodel_force_function"
  "description" '("form" $auto))

(core-public "Lagrangian" :kinds '("mechanical"))
(core-rule "Lagrangian" '("mechanical") "linmodel/lagrangian" "linmodel_lagrangian" "description"
  '("form" $auto))

(core-rule-given '("form" $program) "KineticEnergy" '("mechanical")
  "linmodel/energy_program" "linmodel_kinetic_program" "description" '("laws" ((mlist simp))))
(core-rule-given '("form" $program) "ForceFunction" '("mechanical")
  "linmodel/energy_program" "linmodel_force_program" "description" '("laws" ((mlist simp))))
(core-rule-given '("form" $program) "Lagrangian" '("mechanical")
  "linmodel/energy_program" "linmodel_lagrangian_program" "description" '("laws" ((mlist simp))))

(defparameter *linmodel-program-inputs* '("description" "actions" ("laws" ((mlist simp)))))

(dolist (option '(nil ("form" $program)))
  (apply #'core-rule-given option "EquationProgram" '("mechanical") "linmodel/equation_program"
         "linmodel_equation_program"
         (append *linmodel-program-inputs* '(("solved" nil) ("inverse" nil)))))
(apply #'core-rule-given '(:edited "Lagrangian") "EquationProgram" '("mechanical")
       "forms/equation_program" "forms_equation_program" "Lagrangian" "coordinates"
       (append (rest *linmodel-program-inputs*) '(("solved" nil) ("inverse" nil))))
(apply #'core-rule-given '("form" $program) "MassForm" '("mechanical")
       "linmodel/equation_program" "linmodel_mass_program" *linmodel-program-inputs*)
(apply #'core-rule-given '("form" $program) "LagrangeEquations" '("mechanical")
       "linmodel/equation_program" "linmodel_lagrange_program"
       (append *linmodel-program-inputs* '("equation_options")))

;;; Equations by projection; a file has Lagrange's function as a step, which may be edited

(loop for (target function options) in '(("MassForm" "linmodel_mass_form" ("form" $auto))
                                         ("LagrangeEquations" "linmodel_lagrange_equations"
                                          "equation_options"))
      for inputs = (list "description" "actions" options)
      do (apply #'core-rule target '("mechanical") "linmodel/mass_form" function inputs)
         (apply #'core-rule-given :file target '("mechanical") "linmodel/mass_form"
                (concatenate 'string function "_with") "Lagrangian" inputs))

;;; Equations in quasi-velocities

(core-public "EulerPoisson" :kinds '("mechanical"))
(core-rule "EulerPoisson" '("mechanical") "linmodel/euler_poisson" "linmodel_euler_poisson"
  "description" '("form" $auto))

;;; What the forms take beside L: the keys of [system] and what springs, forces, torques and rotors
;;; add to them

(core-rule "coordinates" '("mechanical") "linmodel/loads" "linmodel_coordinates" "description")
(core-rule "rayleigh" '("mechanical") "linmodel/loads" "linmodel_rayleigh"
  "description" '("form" $auto))
(core-rule "forces" '("mechanical") "linmodel/loads" "linmodel_forces"
  "description" '("form" $auto))
(core-rule "constraints" '("mechanical") "linmodel/loads" "linmodel_constraints" "description")
(core-rule "nonholonomic" '("mechanical") "linmodel/loads" "linmodel_nonholonomic" "description")
(core-rule "momenta" '("mechanical") "linmodel/loads" "linmodel_momenta" "description")

;;; What may be constant by symmetry of the whole system

(core-rule "axis_momenta" '("mechanical") "linmodel/axes" "linmodel_axis_momenta"
  "description" '("form" $auto))
