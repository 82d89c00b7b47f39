;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of coordinates and velocities: q' = v, v' the accelerations, with what a run needs of
;;; constraints f_j = 0 and g_j = 0 on the velocities: their values, the rows a_j of their
;;; multipliers, and M^-1 a_j^T, the displacements along which a state is brought back to them.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "forms/equations_as_program"
                "forms/program_judge" "forms/rates"))

(defun forms-task-names (task)
  "((inside . outside) ..) of the velocities."
  (loop for (nil inside outside) in (forms-task-pairs task) collect (cons inside outside)))

(defun forms-motion-states (task)
  (append (forms-task-q task) (mapcar #'cdr (forms-task-names task))))

(defun forms-solved-motion (task outputs bonds solve guards)
  "The rates from the OUTPUTS of a solved program; SOLVE gives the accelerations of forces alone."
  (let* ((velocities (mapcar #'algebra-program-input (forms-task-v task)))
         (accelerations (cdr (forms-output '$accelerations outputs)))
         (elements (append velocities accelerations)))
    (make-forms-rates
     :program *algebra-program*
     :states (forms-motion-states task) :pairs (forms-task-names task)
     :outputs (cons (cons '$rates (cons :list elements))
                    (forms-bond-outputs task outputs bonds solve))
     :guards guards :split (length velocities)
     :angles (forms-angles (forms-task-q task) elements))))

(defun forms-bond-outputs (task outputs bonds solve)
  (when bonds
    (flet ((bond-list (key reader bonds) (cons key (cons :list (mapcar reader bonds)))))
      (list (assoc '$multipliers outputs)
            (bond-list '$positions #'forms-bond-value
                       (subseq bonds 0 (length (forms-task-holonomic task))))
            (bond-list '$velocities #'forms-bond-rate bonds)
            (cons '$rows (cons :matrix (mapcar #'forms-bond-row bonds)))
            (cons '$directions
                  (cons :matrix (mapcar solve (mapcar #'forms-bond-row bonds))))))))

(defun forms-pivot-guards (names factors wholes)
  "Guards of the FACTORS, of forms-program-factors; WHOLES are the entries that they began as."
  (loop for name in names
        for whole in wholes
        for k from 0
        collect (list* name (aref factors k k) whole)))

(defun forms-diagonal (rows) (loop for row in rows for k from 0 collect (nth k row)))

(defun forms-rates-of-function (system task)
  "The rates of the SYSTEM in plain symbols, by derivatives on programs."
  (let* ((terms (forms-read-program-terms system (forms-task-q task) (forms-task-v task)))
         (bonds (forms-task-bonds task)))
    (destructuring-bind (rows right) (forms-program-mass-form terms)
      (let ((factors (forms-program-factors rows *forms-singular-mass*)))
        (flet ((solve (forces) (forms-program-solution-by factors forces)))
          (let ((outputs (forms-solved-outputs (solve right) #'solve bonds)))
            (forms-check-program task outputs (forms-judge-of-expressions system))
            (forms-solved-motion task outputs bonds #'solve
                                 (forms-pivot-guards (forms-task-q task) factors
                                                     (forms-diagonal rows)))))))))

;;; For Maxima.

(defun $forms_rates_of_task (system task)
  (with-algebra-program (forms-rates-of-function system (forms-read-task task))))
