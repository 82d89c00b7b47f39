;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The dynamics of a system of bodies for a run: the accelerations of program_outputs.lisp, M where
;;; it is constant, guards. The pivot of a velocity is what is left of its inertia when the bodies
;;; beyond it yield, against its inertia when they are locked; the quotient of the two tells what
;;; the subtraction lost. See linmodel-dynamics first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/branch_slopes" "algebra/program_derivative"
                "algebra/program_from_expressions" "algebra/program_nodes"
                "forms/cyclic_momenta" "forms/dynamics" "forms/equations_as_program"
                "forms/rates_impulses" "forms/program_judge" "forms/rates"
                "linmodel/composite_bodies" "linmodel/program_outputs" "linmodel/rate_rows"
                "linmodel/scene_records"))

(defun linmodel-dynamics (scene actions task)
  "ACTIONS: [U, R, [Q_1, ..]] beside the field."
  (let* ((tree (linmodel-program-tree scene task actions))
         (solver (linmodel-solver tree))
         (bonds (forms-task-bonds task))
         (energy (linmodel-program-kinetic (linmodel-program-arithmetic) scene task))
         (constant (and (null bonds) (forms-constant-rows-p (list (list energy)) task))))
    (make-forms-dynamics
     :task task :bonds bonds :inertia (list energy)
     :free (linmodel-solver-free solver) :solve (linmodel-solver-solve solver)
     :guards (linmodel-solver-guards solver)
     :mass (and constant (linmodel-tree-rows tree))
     :right (and constant (linmodel-right-sides tree))
     :terms (lambda () (linmodel-program-terms scene actions task))
     :judge (linmodel-program-judge scene actions (forms-task-v task)))))

(defun linmodel-program-terms (scene actions task)
  (destructuring-bind (potential dissipation forces) (cdr actions)
    (let ((places (mapcar #'algebra-program-input (forms-task-q task)))
          (velocities (mapcar #'algebra-program-input (forms-task-v task)))
          (function (linmodel-function-element scene potential task '|$l|)))
      (make-forms-program-terms
       :function function :places places :velocities velocities
       :momenta (algebra-program-gradient function velocities)
       :slopes (algebra-program-gradient function places)
       :damping (algebra-program-gradient (algebra-program-element dissipation) velocities)
       :forces (mapcar #'algebra-program-element (cdr forces))))))

;;; Impulses: where a joint or an angle jumps the rows of its rate have traces of that.

(defun linmodel-with-impulses (scene)
  "SCENE with the rows of links derived anew where these have functions with branches."
  (let ((q (linmodel-scene-coordinates scene)) (new (copy-linmodel-scene scene)))
    (setf (linmodel-scene-links new)
          (cons '(mlist simp)
                (loop for link in (cdr (linmodel-scene-links scene))
                      collect (linmodel-link-with-impulses link q))))
    new))

(defun linmodel-link-with-impulses (link q)
  (let ((new (copy-linmodel-link link)))
    (flet ((row (e row) (if (algebra-branched-p e) ($linmodel_rate_row e q) row)))
      (setf (linmodel-link-rows new)
            (cons '(mlist simp) (mapcar #'row (cdr (linmodel-link-joint link))
                                        (cdr (linmodel-link-rows link))))
            (linmodel-link-turns new)
            (cons '(mlist simp)
                  (loop for turn in (cdr (linmodel-link-turns link))
                        for copy = (copy-linmodel-turn turn)
                        do (setf (linmodel-turn-row copy)
                                 (row (linmodel-turn-angle turn) (linmodel-turn-row turn)))
                        collect copy))))
    new))

;;; For Maxima.

(defun $linmodel_tree_rates (scene actions task angles wanted)
  "The rates in the form WANTED; ACTIONS: [U, R, [Q_1, ..]] beside the field; ANGLES: coordinates
that turn bodies."
  (with-algebra-program
    (linmodel-with-angles
     angles
     (forms-with-impulses
       (forms-rates-in-form
        (linmodel-dynamics (linmodel-with-impulses scene) actions (forms-read-task task))
        wanted)))))

(defun linmodel-with-angles (angles rates)
  (setf (forms-rates-angles rates)
        (remove-if-not (lambda (x) (or (member x (cdr angles) :test #'alike1)
                                       (member x (forms-rates-angles rates) :test #'alike1)))
                       (forms-rates-states rates)))
  rates)
