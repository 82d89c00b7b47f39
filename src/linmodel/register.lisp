;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of rigid bodies can compute from a mechanical archive. Data only.

(in-package :maxima)

;;; The scene is what everything is computed from; `values' are no part of it, since no result
;;; depends on them, but remarks about results do

(core-middle "scene" '("mechanical") "linmodel/scene" "linmodel_read_scene" "description")
(core-rule "remark_values" '("mechanical") "linmodel/scene" "linmodel_remark_values" "description")

;;; What the forms take beside L: the keys of [system] and what springs, forces, torques and rotors
;;; add to them

(core-rule "coordinates" '("mechanical") "linmodel/rotors" "linmodel_coordinates" "scene")
(core-rule "rayleigh" '("mechanical") "linmodel/loads" "linmodel_rayleigh" "scene"
           '("form" $auto))
(core-rule "forces" '("mechanical") "linmodel/loads" "linmodel_forces" "scene"
           '("form" $auto))
(core-rule "functions_derived" '("mechanical") "linmodel/scene" "linmodel_formulas" "scene")
(core-rule "momenta" '("mechanical") "linmodel/rotors" "linmodel_momenta" "scene")
(core-rule "given_keys" '("mechanical") "linmodel/scene_records" "linmodel_scene_given" "scene")
(core-rule-field "constraints" '("mechanical") "given_keys" "constraints")
(core-rule-field "nonholonomic" '("mechanical") "given_keys" "nonholonomic")

;;; What may be constant by symmetry of the whole system

(core-rule "axis_momenta" '("mechanical") "linmodel/axis_momenta" "linmodel_axis_momenta" "scene"
           '("form" $auto))

;;; Functions

(defparameter *linmodel-field-inputs* '("scene" "remark_values"))

(core-public "Kinematics" :kinds '("mechanical"))
(core-rule "Kinematics" '("mechanical") "linmodel/functions" "linmodel_kinematics" "scene"
           '("form" $auto))

(core-public "KineticEnergy" :kinds '("mechanical"))
(core-rule "KineticEnergy" '("mechanical") "linmodel/functions" "linmodel_kinetic_energy" "scene"
           '("form" $auto))

(core-public "ForceFunction" :kinds '("mechanical"))
(core-rule "ForceFunction" '("mechanical") "linmodel/functions" "linmodel_force_function"
           "scene" "remark_values" '("form" $auto))

(core-public "Lagrangian" :kinds '("mechanical"))
(core-rule "Lagrangian" '("mechanical") "linmodel/functions" "linmodel_lagrangian"
           "scene" "remark_values" '("form" $auto))

;;; Equations by projection; a file has Lagrange's function as a step, which may be edited

(loop for (target function options) in '(("MassForm" "linmodel_mass_form" ("form" $auto))
                                         ("LagrangeEquations" "linmodel_lagrange_equations"
                                          "equation_options"))
      for inputs = (append *linmodel-field-inputs* (list "actions" options))
      do (apply #'core-rule target '("mechanical") "linmodel/mass_form" function inputs)
         (apply #'core-rule-given :file target '("mechanical") "linmodel/mass_form"
                (concatenate 'string function "_with") "Lagrangian" inputs))

;;; Programs

(core-rule-given '("form" $program) "KineticEnergy" '("mechanical") "linmodel/programs"
                 "linmodel_kinetic_program" "scene" '("laws" ((mlist simp))))
(core-rule-given '("form" $program) "ForceFunction" '("mechanical") "linmodel/programs"
                 "linmodel_force_program" "scene" "remark_values" '("laws" ((mlist simp))))
(core-rule-given '("form" $program) "Lagrangian" '("mechanical") "linmodel/programs"
                 "linmodel_lagrangian_program" "scene" "remark_values" '("laws" ((mlist simp))))

(defparameter *linmodel-program-inputs*
  (append *linmodel-field-inputs* '("actions" ("laws" ((mlist simp))))))

(dolist (option '(nil ("form" $program)))
  (apply #'core-rule-given option "EquationProgram" '("mechanical") "linmodel/programs"
         "linmodel_equation_program"
         (append *linmodel-program-inputs* '(("solved" nil) ("inverse" nil)))))
(core-rule-given '(:edited "Lagrangian") "EquationProgram" '("mechanical")
                 "forms/equation_program" "forms_equation_program" "Lagrangian" "coordinates"
                 "actions" '("laws" ((mlist simp))) '("solved" nil) '("inverse" nil))
(apply #'core-rule-given '("form" $program) "MassForm" '("mechanical") "linmodel/programs"
       "linmodel_mass_program" *linmodel-program-inputs*)
(apply #'core-rule-given '("form" $program) "LagrangeEquations" '("mechanical")
       "linmodel/programs" "linmodel_lagrange_program"
       (append *linmodel-program-inputs* '("equation_options")))

;;; Rates of a run; not kept, since remarks go with them

(apply #'core-rule "rates" '("mechanical") "linmodel/rates_of_scenes" "linmodel_scene_rates"
       *linmodel-program-inputs*)
(apply #'core-rule "routh_rates" '("mechanical") "linmodel/rates_of_scenes"
       "linmodel_routh_rates"
       (append *linmodel-program-inputs* '(("cyclic" $auto))))
(apply #'core-rule "hamilton_rates" '("mechanical") "linmodel/rates_of_scenes"
       "linmodel_hamilton_rates" *linmodel-program-inputs*)
(core-rule-same-as "rates" '("mechanical") "routh_rates" :given '("function" $routh))
(core-rule-same-as "rates" '("mechanical") "hamilton_rates" :given '("function" $hamilton))
(loop for (name function . more) in '(("rates" "forms_lagrange_rates" ("integrals" ((mlist simp))))
                                      ("routh_rates" "forms_routh_rates" ("cyclic" $auto) "momenta")
                                      ("hamilton_rates" "forms_hamilton_rates" "momenta"))
      do (apply #'core-rule-given '(:edited "Lagrangian") name '("mechanical")
                "forms/rates_of_systems" function "Lagrangian" "coordinates" "actions"
                '("laws" ((mlist simp))) more))

;;; Equations in quasi-velocities

(core-public "EulerPoisson" :kinds '("mechanical"))
(core-rule "EulerPoisson" '("mechanical") "linmodel/euler_poisson" "linmodel_euler_poisson"
           "scene" "remark_values" '("form" $auto))
(core-rule "variables_in_coordinates" '("mechanical") "linmodel/euler_poisson"
  "linmodel_variables_in_coordinates" "scene" "remark_values" '("form" $auto))
(core-rule "integral_candidates" '("mechanical") "linmodel/euler_poisson"
  "linmodel_integral_candidates" "scene" "remark_values" '("form" $auto))
