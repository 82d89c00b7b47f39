;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Programs of a system of bodies put together: M and f, the left sides M q'' - f for given q'', or
;;; q'' itself, by articulated bodies where every velocity belongs to one link, else by
;;; M = L D L^T; constraints as in equations_as_program.lisp. What comes out is judged by L from the
;;; positions in fixed axes. See linmodel-program-outputs first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/program_inertia" "linmodel/energy_value" "forms/equations_as_program"))

(defun linmodel-given-forces (potential dissipation forces q v)
  "dU/dq - dR/dq' + Q, U what the field does not give."
  (mapcar (lambda (slope damping force)
            (algebra-program-add (algebra-program-subtract slope damping) force))
          (algebra-program-gradient (algebra-program-element potential) q)
          (algebra-program-gradient (algebra-program-element dissipation) v)
          (mapcar #'algebra-program-element (cdr forces))))

(defun linmodel-right-sides (a joints state gravity given n)
  (mapcar #'algebra-program-subtract given (linmodel-bias-forces a joints state gravity n)))

(defun linmodel-no-loads (joints)
  (make-array (length joints) :initial-element (linmodel-no-load)))

(defun linmodel-solved-outputs (a joints state gravity given bonds n)
  (if (linmodel-articulated-p joints)
      (flet ((solve (forces &optional (loads (linmodel-no-loads joints)))
               (linmodel-accelerations a joints loads forces n)))
        (forms-solved-outputs
         (solve given (linmodel-bias-loads a joints (linmodel-motions a joints state gravity)))
         #'solve bonds))
      (let ((factors (forms-program-factors (linmodel-mass-rows a joints n)
                                            *forms-singular-mass*)))
        (flet ((solve (forces) (forms-program-solution-by factors forces)))
          (forms-solved-outputs (solve (linmodel-right-sides a joints state gravity given n))
                                #'solve bonds)))))

(defun linmodel-program-outputs (a task joints state gravity given n)
  (let ((bonds (forms-task-bonds task)))
    (ecase (forms-task-result task)
      ($inverse
       (forms-inverse-outputs
        (mapcar #'algebra-program-subtract (linmodel-bias-forces a joints state gravity n) given)
        bonds (mapcar #'algebra-program-input (forms-task-multipliers task))))
      ($solved (linmodel-solved-outputs a joints state gravity given bonds n))
      ($mass (forms-mass-outputs (linmodel-mass-rows a joints n)
                                 (linmodel-right-sides a joints state gravity given n) bonds)))))

;;; For Maxima.

(defun linmodel-program-judge (scene gravity actions v)
  (destructuring-bind (potential dissipation forces) (cdr actions)
    (make-forms-program-judge
     :function (lambda (base)
                 (let ((bodies (linmodel-value-of scene v gravity base t)))
                   (lambda (point) (+ (funcall bodies point) (forms-fixed-value potential point)))))
     :dissipation dissipation :forces (cdr forces)
     :how "d/dt dL/dq' - dL/dq as quotients of differences of L in fixed axes")))

(defun linmodel-program-state (task)
  (flet ((inputs (names) (mapcar #'algebra-program-input names)))
    (make-linmodel-state
     :names (forms-task-q task)
     :velocities (inputs (forms-task-v task))
     :accelerations (if (eq (forms-task-result task) '$inverse)
                        (inputs (forms-task-a task))
                        (mapcar (constantly 0) (forms-task-q task))))))

(defun $linmodel_program (scene gravity actions task)
  "The record of the program of the TASK; ACTIONS: [U, R, [Q_1, ..]]."
  (destructuring-bind (links bodies) (cddr scene)
    (let ((task (forms-read-task task)))
      (with-algebra-program
        (let* ((a (linmodel-program-arithmetic))
               (state (linmodel-program-state task))
               (joints (linmodel-read-joints a links bodies state))
               (given (linmodel-given-forces
                       (second actions) (third actions) (fourth actions)
                       (mapcar #'algebra-program-input (forms-task-q task))
                       (linmodel-state-velocities state))))
          (forms-checked-program
           task
           (linmodel-program-outputs a task joints state (linmodel-lift-vector a gravity) given
                                     (length (forms-task-q task)))
           (linmodel-program-judge scene gravity actions (forms-task-v task))))))))
