;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of a system of bodies for a run: the accelerations of program_outputs.lisp, with guards.
;;; The pivot of a velocity is what is left of its inertia when the bodies beyond it yield, against
;;; its inertia when they are locked; the quotient of the two tells what the subtraction lost. See
;;; linmodel-rates first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/articulated_bodies" "linmodel/program_outputs"
                "forms/equations_as_program" "forms/program_judge" "forms/rates_of_motion"
                "linmodel/composite_bodies" "linmodel/motions" "linmodel/scene_records"
                "algebra/program_nodes" "forms/rates"))

(defun linmodel-rates (scene actions task)
  (let* ((tree (linmodel-program-tree scene task actions))
         (bonds (forms-task-bonds task))
         (solver (linmodel-solver tree))
         (outputs (linmodel-solved-outputs solver bonds)))
    (forms-check-program task outputs (linmodel-program-judge scene actions (forms-task-v task)))
    (forms-solved-motion task outputs bonds (linmodel-solver-solve solver)
                         (funcall (linmodel-solver-guards solver)))))

;;; For Maxima.

(defun $linmodel_tree_rates (scene actions task angles)
  "The rates; ACTIONS: [U, R, [Q_1, ..]] beside the field; ANGLES: coordinates that turn bodies."
  (with-algebra-program
    (let ((rates (linmodel-rates scene actions (forms-read-task task))))
      (setf (forms-rates-angles rates)
            (union (cdr angles) (forms-rates-angles rates) :test #'alike1))
      rates)))
