;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the rates of a system of the second order are made of, however they came about: the
;;; accelerations without constraints, the solution of M a = Q for forces alone, and the derivatives
;;; of Lagrange's function, on programs. Rooms make such a record; rates_of_motion.lisp and what
;;; follows it take it.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions"
                "algebra/program_nodes" "forms/equations_as_program"
                "forms/program_judge"))

(defstruct forms-dynamics
  task    ; names: see program_judge.lisp
  bonds   ; of the constraints
  free    ; accelerations without constraints
  solve   ; a function of forces: the accelerations that these alone give
  mass    ; nil, or the rows of a constant M
  right   ; with M: the forces of M q'' = f
  inertia ; elements that depend on the coordinates or the time where M does
  terms   ; a function that gives the forms-program-terms, derivatives of L
  guards  ; a function that gives the list of (coordinate pivot . whole)
  judge)  ; a forms-program-judge

(defun forms-depends-p (elements names)
  "Whether one of ELEMENTS depends on one of NAMES."
  (let ((inputs (mapcar #'algebra-node-left
                        (remove-if-not #'algebra-input-p (algebra-live-nodes elements)))))
    (some (lambda (name) (member name inputs :test #'alike1)) names)))

(defun forms-constant-rows-p (rows task)
  (not (forms-depends-p (loop for row in rows append row) (cons '$t (forms-task-q task)))))

(defun forms-dynamics-of-function (system task)
  "Of the SYSTEM in plain symbols, by derivatives on programs."
  (let ((terms (forms-read-program-terms system (forms-task-q task) (forms-task-v task)))
        (bonds (forms-task-bonds task)))
    (destructuring-bind (rows right) (forms-program-mass-form terms)
      (let ((factors (forms-program-factors rows *forms-singular-mass*))
            (constant (and (null bonds) (forms-constant-rows-p rows task))))
        (flet ((solve (forces) (forms-program-solution-by factors forces)))
          (make-forms-dynamics
           :task task :bonds bonds :free (solve right) :solve #'solve
           :mass (and constant rows) :right right :inertia (loop for row in rows append row)
           :terms (constantly terms)
           :guards (lambda () (forms-pivot-guards (forms-task-q task) factors
                                                  (forms-diagonal rows)))
           :judge (forms-judge-of-expressions system)))))))

(defun forms-pivot-guards (names factors wholes)
  "Guards of the FACTORS, of forms-program-factors; WHOLES are the entries that they began as."
  (loop for name in names
        for whole in wholes
        for k from 0
        collect (list* name (aref factors k k) whole)))

(defun forms-diagonal (rows) (loop for row in rows for k from 0 collect (nth k row)))

(defun forms-dynamics-pivots (dynamics)
  "The guards of the mass matrix, and of that of the multipliers, lambda1, .."
  (append (funcall (forms-dynamics-guards dynamics)) (forms-multiplier-guards dynamics)))

(defun forms-multiplier-guards (dynamics)
  (let* ((bonds (forms-dynamics-bonds dynamics))
         (rows (forms-bond-matrix (mapcar (forms-dynamics-solve dynamics)
                                          (mapcar #'forms-bond-row bonds))
                                  bonds)))
    (forms-pivot-guards (loop for k from 1 to (length bonds)
                              collect (core-symbol (format nil "lambda~d" k)))
                        (forms-program-factors rows *forms-dependent-constraints*)
                        (forms-diagonal rows))))

;;; With constraints.

(defun forms-dynamics-outputs (dynamics)
  "The accelerations, and multipliers."
  (forms-solved-outputs (forms-dynamics-free dynamics) (forms-dynamics-solve dynamics)
                        (forms-dynamics-bonds dynamics)))

(defun forms-checked-outputs (dynamics)
  (let ((outputs (forms-dynamics-outputs dynamics)))
    (forms-check-program (forms-dynamics-task dynamics) outputs (forms-dynamics-judge dynamics))
    outputs))

(defun forms-output-list (name outputs) (cdr (cdr (assoc name outputs))))

;;; Names.

(defun forms-coordinate-place (x task) (position x (forms-task-q task) :test #'alike1))

(defun forms-velocity-name (x task) (nth (forms-coordinate-place x task) (forms-task-v task)))
