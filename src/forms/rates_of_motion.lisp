;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of coordinates and velocities: q' = v, v' the accelerations, or M v' = f where M is
;;; constant; with what a run needs of constraints f_j = 0 and g_j = 0 on the velocities: their
;;; values, the rows a_j of their multipliers, and M^-1 a_j^T, the displacements along which a state
;;; is brought back to them.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "forms/dynamics"
                "forms/equations_as_program" "forms/judge" "forms/momenta_judge"
                "forms/program_judge" "forms/rates" "forms/rates_integrals"))

(defun forms-task-names (task)
  "((inside . outside) ..) of the velocities."
  (loop for (nil inside outside) in (forms-task-pairs task) collect (cons inside outside)))

(defun forms-motion-states (task)
  (append (forms-task-q task) (mapcar #'cdr (forms-task-names task))))

(defun forms-rates-of-dynamics (dynamics names)
  "NAMES are those of the momenta, of which some may be constant."
  (if (forms-dynamics-mass dynamics)
      (forms-mass-motion dynamics names)
      (forms-solved-motion dynamics names)))

(defun forms-motion-rates (dynamics accelerations more)
  "The record with q' = v and ACCELERATIONS; MORE outputs follow."
  (let* ((task (forms-dynamics-task dynamics))
         (velocities (mapcar #'algebra-program-input (forms-task-v task)))
         (elements (append velocities accelerations)))
    (make-forms-rates
     :program *algebra-program*
     :states (forms-motion-states task) :pairs (forms-task-names task)
     :outputs (cons (cons '$rates (cons :list elements)) more)
     :split (length velocities) :inertia (forms-dynamics-inertia dynamics)
     :angles (forms-angles (forms-task-q task) elements))))

(defun forms-solved-motion (dynamics names)
  (let* ((outputs (forms-checked-outputs dynamics))
         (accelerations (forms-output-list '$accelerations outputs))
         (rates (forms-motion-rates dynamics accelerations (forms-bond-outputs dynamics outputs))))
    (setf (forms-rates-guards rates) (forms-dynamics-pivots dynamics)
          (forms-rates-integrals rates)
          (forms-integrals-of-solved-motion dynamics names accelerations
                                            (forms-output-list '$multipliers outputs)))
    rates))

(defun forms-integrals-of-solved-motion (dynamics names accelerations multipliers)
  (forms-integrals-of-motion
   dynamics names accelerations
   (forms-reactions multipliers (mapcar #'forms-bond-row (forms-dynamics-bonds dynamics))
                    (length accelerations))
   (forms-power-of-constraints dynamics multipliers)))

(defun forms-integrals-of-motion (dynamics names accelerations left pushed)
  "Those of coordinates and velocities; LEFT is what is left of M q'' - f with ACCELERATIONS, PUSHED
the power of constraints."
  (let ((task (forms-dynamics-task dynamics)))
    (forms-checked-integrals
     (forms-motion-integrals dynamics names)
     (append (mapcar #'cons (forms-task-q task)
                     (mapcar #'algebra-program-input (forms-task-v task)))
             (mapcar #'cons (forms-task-v task) accelerations))
     left pushed (forms-trial-point (forms-momentum-trial dynamics)))))

(defun forms-mass-motion (dynamics names)
  (let* ((rows (forms-dynamics-mass dynamics)) (right (forms-dynamics-right dynamics))
         (task (copy-forms-task (forms-dynamics-task dynamics)))
         (rates (forms-motion-rates dynamics right '())))
    (setf (forms-task-result task) '$mass)
    (forms-check-program task (forms-mass-outputs rows right '()) (forms-dynamics-judge dynamics))
    (setf (forms-rates-mass rates) (forms-mass-of-motion rows)
          (forms-rates-integrals rates)
          (let ((accelerations (mapcar #'algebra-program-input (forms-task-a task))))
            (forms-integrals-of-motion
             dynamics names accelerations
             (loop for row in rows
                   for f in right
                   collect (algebra-program-subtract (forms-program-product row accelerations)
                                                     f))
             0)))
    rates))

(defun forms-mass-of-motion (rows)
  "Sparse rows of the unit matrix beside ROWS."
  (let ((n (length rows)))
    (append (loop for i below n collect (list (cons i 1)))
            (loop for row in rows
                  collect (loop for element in row
                                for j from n
                                unless (eql element 0) collect (cons j element))))))

(defun forms-bond-outputs (dynamics outputs)
  (let ((bonds (forms-dynamics-bonds dynamics)) (task (forms-dynamics-task dynamics)))
    (when bonds
      (flet ((listed (key reader bonds) (cons key (cons :list (mapcar reader bonds)))))
        (list (assoc '$multipliers outputs)
              (listed '$positions #'forms-bond-value
                      (subseq bonds 0 (length (forms-task-holonomic task))))
              (listed '$velocities #'forms-bond-rate bonds)
              (cons '$rows (cons :matrix (mapcar #'forms-bond-row bonds)))
              (cons '$directions
                    (cons :matrix (mapcar (forms-dynamics-solve dynamics)
                                          (mapcar #'forms-bond-row bonds)))))))))
