;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Program form of M q'' = f from Lagrange's function, by derivatives on programs:
;;;     p_i = dL/dq_i',   M_ij = dp_i/dq_j',
;;;     f_i = dL/dq_i - (sum dp_i/dq_j q_j' + dp_i/dt) - dR/dq_i' + Q_i,
;;; the left sides e_i = M q'' - f in one run forward, with q_j'' as the rate of q_j', and the
;;; accelerations by M = L D L^T. See forms-program-mass-form first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "forms/program_constraints" "forms/program_check"))

(defstruct forms-program-terms
  momenta slopes damping forces ; p_i, dL/dq_i, dR/dq_i', Q_i: lists of elements
  places velocities)            ; nodes

(defun forms-read-program-terms (function dissipation forces q v)
  "FUNCTION, DISSIPATION, FORCES, Q and V are expressions."
  (let ((places (mapcar #'algebra-program-input q))
        (velocities (mapcar #'algebra-program-input v))
        (function (algebra-program-element function)))
    (make-forms-program-terms
     :places places :velocities velocities
     :momenta (algebra-program-gradient function velocities)
     :slopes (algebra-program-gradient function places)
     :damping (algebra-program-gradient (algebra-program-element dissipation) velocities)
     :forces (mapcar #'algebra-program-element forces))))

(defun forms-program-left-sides (terms accelerations)
  "The list of e_i for ACCELERATIONS, elements."
  (let* ((velocities (forms-program-terms-velocities terms))
         (rates (append (mapcar #'cons (forms-program-terms-places terms) velocities)
                        (mapcar #'cons velocities accelerations)
                        (list (cons (algebra-program-input '$t) 1)))))
    (mapcar (lambda (rate slope damping force)
              (algebra-program-subtract
               (algebra-program-add (algebra-program-subtract rate slope) damping) force))
            (algebra-program-rates (forms-program-terms-momenta terms) rates)
            (forms-program-terms-slopes terms)
            (forms-program-terms-damping terms)
            (forms-program-terms-forces terms))))

(defun forms-program-mass-form (terms)
  "(M f): rows and list of elements."
  (let ((velocities (forms-program-terms-velocities terms)))
    (list (mapcar (lambda (momentum) (algebra-program-gradient momentum velocities))
                  (forms-program-terms-momenta terms))
          (mapcar #'algebra-program-negate
                  (forms-program-left-sides terms (mapcar (constantly 0) velocities))))))

(defun forms-program-outputs (result terms bonds accelerations multipliers)
  (if (eq result '$inverse)
      (forms-inverse-outputs (forms-program-left-sides terms accelerations) bonds multipliers)
      (destructuring-bind (rows right) (forms-program-mass-form terms)
        (if (eq result '$solved)
            (let ((factors (forms-program-factors rows *forms-singular-mass*)))
              (flet ((solve (forces) (forms-program-solution-by factors forces)))
                (forms-solved-outputs (solve right) #'solve bonds)))
            (forms-mass-outputs rows right bonds)))))

;;; For Maxima.

(defun forms-task-bonds (task)
  (flet ((elements (expressions) (mapcar #'algebra-program-element expressions))
         (inputs (names) (mapcar #'algebra-program-input names)))
    (forms-program-bonds (elements (forms-task-holonomic task))
                         (elements (forms-task-nonholonomic task))
                         (inputs (forms-task-q task)) (inputs (forms-task-v task)))))

(defun $forms_program_of (plain task)
  "The record of the program of the TASK; PLAIN is [L, R, [Q_1, ..]]."
  (destructuring-bind (function dissipation forces) (cdr plain)
    (let ((task (forms-read-task task)))
      (with-algebra-program
        (let ((terms (forms-read-program-terms function dissipation (cdr forces)
                                               (forms-task-q task) (forms-task-v task))))
          (flet ((inputs (names) (mapcar #'algebra-program-input names)))
            (forms-checked-program
             task
             (forms-program-outputs (forms-task-result task) terms (forms-task-bonds task)
                                    (inputs (forms-task-a task))
                                    (inputs (forms-task-multipliers task)))
             (forms-judge-of-expressions function dissipation (cdr forces)))))))))

(defun forms-checked-program (task outputs judge)
  "The record of OUTPUTS, shown to be right at a random point by the JUDGE."
  (forms-check-program task outputs judge)
  (forms-program-record task outputs))

(defun forms-program-record (task outputs)
  (algebra-rename-inputs (cons '(mlist) (forms-task-pairs task)))
  (algebra-program-record
   (append (forms-task-q task)
           (mapcar #'third (forms-task-pairs task))
           (and (eq (forms-task-result task) '$inverse) (forms-task-multipliers task)))
   outputs))

(defun forms-function-program (task name element expected how)
  "The record of one output, ELEMENT; EXPECTED, a function of points, is its value found otherwise."
  (let ((point (forms-new-point t)))
    (forms-verdict how
                   (catch 'forms-no-value (first (forms-program-values (list element) point)))
                   (catch 'forms-no-value (funcall expected point))
                   point))
  (forms-program-record task (list (cons name element))))

(defun $forms_function_program (e name task)
  "The record of NAME = E, an expression in names inside."
  (with-algebra-program
    (forms-function-program (forms-read-task task) name (algebra-program-element e)
                            (forms-values-of e)
                            "value of the program against that of the expression")))
