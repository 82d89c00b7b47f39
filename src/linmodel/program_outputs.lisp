;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Programs of a system of bodies put together: M and f, the left sides M q'' - f for given q'', or
;;; q'' itself, by articulated bodies where every velocity belongs to one link, else by
;;; M = L D L^T, with constraints; and T, U and L, T by bodies as in kinetic.lisp, heights as in
;;; twists.lisp, each link's from its parent's. What comes out is judged from the positions in fixed
;;; axes. See linmodel-equation-outputs first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/articulated_bodies" "linmodel/kinetic" "linmodel/energy_value"
                "forms/dynamics" "forms/equations_as_program" "forms/program_judge"
                "algebra/program_nodes" "linmodel/twists" "linmodel/arithmetic" "forms/value"
                "linmodel/composite_bodies" "linmodel/motions" "algebra/program_from_expressions"
                "algebra/program_derivative" "linmodel/scene_records"))

;;; What the recursion runs on: an arithmetic, the joints, the state of motion, gravity as an
;;; acceleration, and the forces that the field does not give.

(defstruct linmodel-tree arithmetic joints state gravity given)

(defun linmodel-program-tree (scene task actions)
  "ACTIONS: [U, R, [Q_1, ..]] beside the field."
  (let* ((a (linmodel-program-arithmetic))
         (state (linmodel-program-state task)))
    (make-linmodel-tree
     :arithmetic a :state state
     :joints (linmodel-joints a (linmodel-scene-links scene) (linmodel-scene-bodies scene) state)
     :given (destructuring-bind (potential dissipation forces) (cdr actions)
              (linmodel-given-forces potential dissipation forces
                                     (mapcar #'algebra-program-input (forms-task-q task))
                                     (linmodel-state-velocities state)))
     :gravity (linmodel-lift-vector a (linmodel-gravity scene)))))

(defun linmodel-program-state (task)
  (flet ((inputs (names) (mapcar #'algebra-program-input names)))
    (make-linmodel-state
     :names (forms-task-q task)
     :velocities (inputs (forms-task-v task))
     :accelerations (if (eq (forms-task-result task) '$inverse)
                        (inputs (forms-task-a task))
                        (mapcar (constantly 0) (forms-task-q task))))))

(defun linmodel-given-forces (potential dissipation forces q v)
  "dU/dq - dR/dq' + Q, U what the field does not give."
  (mapcar (lambda (slope damping force)
            (algebra-program-add (algebra-program-subtract slope damping) force))
          (algebra-program-gradient (algebra-program-element potential) q)
          (algebra-program-gradient (algebra-program-element dissipation) v)
          (mapcar #'algebra-program-element (cdr forces))))

(defun linmodel-tree-size (tree) (length (linmodel-state-names (linmodel-tree-state tree))))

(defun linmodel-tree-bias (tree)
  "The forces for the accelerations of the state."
  (linmodel-bias-forces (linmodel-tree-arithmetic tree) (linmodel-tree-joints tree)
                        (linmodel-tree-state tree) (linmodel-tree-gravity tree)))

(defun linmodel-tree-rows (tree)
  (linmodel-mass-rows (linmodel-tree-arithmetic tree) (linmodel-tree-joints tree)
                      (linmodel-tree-size tree)))

(defun linmodel-right-sides (tree)
  (mapcar #'algebra-program-subtract (linmodel-tree-given tree) (linmodel-tree-bias tree)))

;;; Equations

(defun linmodel-equation-outputs (tree task)
  (let ((bonds (forms-task-bonds task)))
    (ecase (forms-task-result task)
      ($inverse
       (forms-inverse-outputs
        (mapcar #'algebra-program-subtract (linmodel-tree-bias tree) (linmodel-tree-given tree))
        bonds (mapcar #'algebra-program-input (forms-task-multipliers task))))
      ($solved (linmodel-solved-outputs (linmodel-solver tree) bonds))
      ($mass (forms-mass-outputs (linmodel-tree-rows tree) (linmodel-right-sides tree) bonds)))))

;;; M q'' = f solved.

(defstruct linmodel-solver
  free    ; the accelerations without constraints
  solve   ; a function of forces: the accelerations that these alone give
  guards) ; a function that gives the list of (coordinate pivot . whole): see forms-rates

(defun linmodel-solver (tree)
  (if (linmodel-articulated-p (linmodel-tree-joints tree))
      (linmodel-articulated-solver tree)
      (linmodel-factored-solver tree)))

(defun linmodel-solved-outputs (solver bonds)
  (forms-solved-outputs (linmodel-solver-free solver) (linmodel-solver-solve solver) bonds))

(defun linmodel-articulated-solver (tree)
  (let ((a (linmodel-tree-arithmetic tree)) (joints (linmodel-tree-joints tree)))
    (flet ((solve (forces loads)
             (linmodel-accelerations a joints loads forces (linmodel-tree-size tree))))
      (make-linmodel-solver
       :free (solve (linmodel-tree-given tree)
                    (linmodel-bias-loads
                     a joints (linmodel-motions a joints (linmodel-tree-state tree)
                                                (linmodel-tree-gravity tree))))
       :solve (lambda (forces) (solve forces (linmodel-no-loads joints)))
       :guards (lambda () (linmodel-articulated-guards tree))))))

(defun linmodel-articulated-guards (tree)
  (let ((joints (linmodel-tree-joints tree))
        (names (linmodel-state-names (linmodel-tree-state tree))))
    (loop for (i . guard) in (linmodel-articulated-pivots
                              (linmodel-tree-arithmetic tree) joints
                              (linmodel-no-loads joints) (mapcar (constantly 0) names))
          collect (cons (nth (1- i) names) guard))))

(defun linmodel-no-loads (joints)
  (make-array (length joints) :initial-element (linmodel-no-load)))

(defun linmodel-factored-solver (tree)
  (let* ((rows (linmodel-tree-rows tree))
         (factors (forms-program-factors rows *forms-singular-mass*)))
    (flet ((solve (forces) (forms-program-solution-by factors forces)))
      (make-linmodel-solver
       :free (solve (linmodel-right-sides tree)) :solve #'solve
       :guards (lambda ()
                 (forms-pivot-guards (linmodel-state-names (linmodel-tree-state tree)) factors
                                     (forms-diagonal rows)))))))

(defun linmodel-program-judge (scene actions v)
  (destructuring-bind (potential dissipation forces) (cdr actions)
    (make-forms-program-judge
     :function (lambda (base)
                 (let ((bodies (linmodel-value-of scene v base '|$l|)))
                   (lambda (point) (+ (funcall bodies point) (forms-fixed-value potential point)))))
     :dissipation dissipation :forces (cdr forces)
     :how "d/dt dL/dq' - dL/dq as quotients of differences of L in fixed axes")))

;;; Functions

(defun linmodel-program-kinetic (a scene task)
  "T."
  (linmodel-energy-of-bodies a (linmodel-scene-links scene) (linmodel-scene-bodies scene)
                             (forms-task-q task)
                             (cons 1 (mapcar #'algebra-program-input (forms-task-v task)))))

(defun linmodel-program-weight (a scene)
  "sum m g.r_C."
  (let ((carried (linmodel-carried-vectors a (linmodel-scene-links scene)
                                           (linmodel-gravity scene)))
        (sum 0))
    (dolist (body (cdr (linmodel-scene-bodies scene)) sum)
      (setq sum (linmodel-plus a sum (linmodel-weight a body carried))))))

(defun linmodel-function-element (scene potential task name)
  "NAME, which is T, U or L, with the POTENTIAL beside the field."
  (let ((a (linmodel-program-arithmetic)))
    (algebra-program-sum
     (append (unless (eq name '|$u|) (list (linmodel-program-kinetic a scene task)))
             (unless (eq name '|$t|) (list (linmodel-program-weight a scene)
                                           (algebra-program-element potential)))))))

;;; For Maxima.

(defun $linmodel_program (scene actions task)
  "The record of the program of the TASK; ACTIONS: [U, R, [Q_1, ..]] beside the field."
  (let ((task (forms-read-task task)))
    (with-algebra-program
      (forms-checked-program
       task
       (linmodel-equation-outputs (linmodel-program-tree scene task actions) task)
       (linmodel-program-judge scene actions (forms-task-v task))))))

(defun $linmodel_function_program (scene potential task name)
  "The record of NAME, which is T, U or L, with the POTENTIAL beside the field; U has no
velocities."
  (let ((task (forms-read-task task)))
    (when (eq name '|$u|)
      (setf (forms-task-v task) '() (forms-task-pairs task) '()))
    (with-algebra-program
      (forms-function-program
       task name
       (linmodel-function-element scene potential task name)
       (let ((v (forms-task-v task)))
         (lambda (point)
           (+ (funcall (linmodel-value-of scene v point name) point)
              (forms-fixed-value potential point))))
       "value of the program against that in fixed axes"))))
