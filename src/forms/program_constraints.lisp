;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Constraints on programs, f_j(q,t) = 0 or g_j = sum a_ji q_i' + a_j = 0. The rate of f_j is
;;; such a g_j; the rate of g_j must vanish, too:
;;;     M q'' = f + A^T lambda,   A q'' = b,   b_j = -(rate of g_j at q'' = 0).
;;; Where the accelerations are wanted, q'' = x + Y lambda with M x = f, M Y = A^T, and
;;; A Y lambda = b - A x. See forms-solved-outputs first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "forms/program_linear"))

(defstruct forms-bond row right value) ; the elements a_ji, b_j and f_j or g_j

(defun forms-program-bonds (holonomic nonholonomic places velocities)
  "The bonds of elements f_j and g_j; PLACES and VELOCITIES are nodes."
  (let ((rates (acons (algebra-program-input '$t) 1 (mapcar #'cons places velocities))))
    (append
     (loop for f in holonomic
           for g in (algebra-program-rates holonomic rates)
           collect (forms-program-bond f g (algebra-program-gradient f places) rates))
     (loop for g in nonholonomic
           collect (forms-program-bond g g (algebra-program-gradient g velocities) rates)))))

(defun forms-program-bond (value g row rates)
  (make-forms-bond :value value :row row
                   :right (algebra-program-negate (first (algebra-program-rates (list g) rates)))))

(defun forms-program-product (u v)
  (algebra-program-sum (mapcar #'algebra-program-multiply u v)))

;;; What the three kinds of programs give out.

(defun forms-mass-outputs (rows right bonds)
  (list* (cons '|$m| (cons :matrix rows))
         (cons '$f (cons :list right))
         (and bonds
              (list (cons '|$a| (cons :matrix (mapcar #'forms-bond-row bonds)))
                    (cons '$b (cons :list (mapcar #'forms-bond-right bonds)))))))

(defun forms-solved-outputs (free solve bonds)
  "FREE are the accelerations without bonds, SOLVE gives those of given forces alone."
  (if (null bonds)
      (list (cons '$accelerations (cons :list free)))
      (let* ((columns (mapcar solve (mapcar #'forms-bond-row bonds)))
             (multipliers (forms-program-multipliers free columns bonds)))
        (loop for column in columns
              for multiplier in multipliers
              do (setq free (forms-program-moved free multiplier column)))
        (list (cons '$accelerations (cons :list free))
              (cons '$multipliers (cons :list multipliers))))))

(defun forms-program-moved (vector factor direction)
  (mapcar (lambda (x y) (algebra-program-add x (algebra-program-multiply factor y)))
          vector direction))

(defun forms-program-multipliers (free columns bonds)
  (forms-program-solution
   (loop for bond in bonds
         collect (loop for column in columns
                       collect (forms-program-product (forms-bond-row bond) column)))
   (loop for bond in bonds
         collect (algebra-program-subtract
                  (forms-bond-right bond) (forms-program-product (forms-bond-row bond) free)))
   "the constraints depend on each other: their multipliers do not follow from the equations"))

(defun forms-inverse-outputs (forces bonds multipliers)
  "FORCES less the reactions, MULTIPLIERS being elements, and the constraints themselves."
  (loop for bond in bonds
        for multiplier in multipliers
        do (setq forces (forms-program-moved forces (algebra-program-negate multiplier)
                                             (forms-bond-row bond))))
  (cons (cons '$forces (cons :list forces))
        (and bonds
             (list (cons '$constraints (cons :list (mapcar #'forms-bond-value bonds)))))))
