;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of coordinates and velocities: q' = v, v' the accelerations, or M v' = f where M is
;;; constant; with what a run needs of constraints f_j = 0 and g_j = 0 on the velocities: their
;;; values, the rows a_j of their multipliers, and M^-1 a_j^T, the displacements along which a state
;;; is brought back to them.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "forms/dynamics"
                "forms/equations_as_program" "forms/program_judge" "forms/rates"))

(defun forms-task-names (task)
  "((inside . outside) ..) of the velocities."
  (loop for (nil inside outside) in (forms-task-pairs task) collect (cons inside outside)))

(defun forms-motion-states (task)
  (append (forms-task-q task) (mapcar #'cdr (forms-task-names task))))

(defun forms-rates-of-dynamics (dynamics)
  (if (forms-dynamics-mass dynamics)
      (forms-mass-motion dynamics)
      (forms-solved-motion dynamics)))

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

(defun forms-solved-motion (dynamics)
  (let* ((outputs (forms-checked-outputs dynamics))
         (rates (forms-motion-rates dynamics (forms-output-list '$accelerations outputs)
                                    (forms-bond-outputs dynamics outputs))))
    (setf (forms-rates-guards rates) (funcall (forms-dynamics-guards dynamics)))
    rates))

(defun forms-mass-motion (dynamics)
  (let* ((rows (forms-dynamics-mass dynamics)) (right (forms-dynamics-right dynamics))
         (task (copy-forms-task (forms-dynamics-task dynamics)))
         (rates (forms-motion-rates dynamics right '())))
    (setf (forms-task-result task) '$mass)
    (forms-check-program task (forms-mass-outputs rows right '()) (forms-dynamics-judge dynamics))
    (setf (forms-rates-mass rates) (forms-mass-of-motion rows))
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
