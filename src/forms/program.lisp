;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Program form of M q'' = f from Lagrange's function, by derivatives on programs:
;;;     p_i = dL/dq_i',   M_ij = dp_i/dq_j',
;;;     f_i = dL/dq_i - (sum dp_i/dq_j q_j' + dp_i/dt) - dR/dq_i' + Q_i,
;;; and the accelerations by M = L D L^T. An element of a matrix of mass that is 0 costs nothing.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_record"))

(defun forms-program-mass-form (function dissipation forces q v)
  "(M f): rows and list of elements; Q and V are expressions, the others elements."
  (let* ((places (mapcar #'algebra-program-input q))
         (velocities (mapcar #'algebra-program-input v))
         (momenta (algebra-program-gradient function velocities))
         (slopes (algebra-program-gradient function places))
         (damping (algebra-program-gradient dissipation velocities))
         (rates (algebra-program-rates
                 momenta (acons (algebra-program-input '$t) 1 (mapcar #'cons places velocities)))))
    (list (mapcar (lambda (momentum) (algebra-program-gradient momentum velocities)) momenta)
          (mapcar (lambda (slope rate damped force)
                    (algebra-program-add
                     (algebra-program-subtract (algebra-program-subtract slope rate) damped) force))
                  slopes rates damping forces))))

;;; Symmetric linear equations.

(defun forms-program-factors (rows)
  "The array with L below the diagonal and D on it, ROWS = L D L^T."
  (let* ((n (length rows)) (a (make-array (list n n) :initial-contents rows)))
    (dotimes (k n a)
      (when (eql (aref a k k) 0)
        (core-error "the mass matrix is singular: the accelerations do not follow from the equations"))
      (loop for i from (1+ k) below n
            do (if (eql (aref a k i) 0)
                   (setf (aref a i k) 0)
                   (forms-take-row a i k n))))))

(defun forms-take-row (a i k n)
  "Takes row K out of row I from the diagonal on; the factor of L goes to A[i,k]."
  (let ((factor (algebra-program-divide (aref a k i) (aref a k k))))
    (loop for j from i below n
          do (setf (aref a i j)
                   (algebra-program-subtract (aref a i j)
                                             (algebra-program-multiply factor (aref a k j)))))
    (setf (aref a i k) factor)))

(defun forms-program-solution (rows right)
  "x of ROWS x = RIGHT, the rows symmetric."
  (let* ((n (length right)) (a (forms-program-factors rows)) (x (coerce right 'vector)))
    (flet ((take (i factor j)
             (setf (aref x i)
                   (algebra-program-subtract (aref x i) (algebra-program-multiply factor (aref x j))))))
      (dotimes (i n) (dotimes (j i) (take i (aref a i j) j)))
      (dotimes (i n) (setf (aref x i) (algebra-program-divide (aref x i) (aref a i i))))
      (loop for i from (1- n) downto 0
            do (loop for j from (1+ i) below n do (take i (aref a j i) j))))
    (coerce x 'list)))

(defun forms-program-outputs (rows right solved)
  (if solved
      (list (cons '$accelerations (cons :list (forms-program-solution rows right))))
      (list (cons '|$m| (cons :matrix rows)) (cons '$f (cons :list right)))))

;;; For Maxima.

(defun $forms_program_of (function dissipation forces q v pairs solved)
  "The record of M and f, or of the accelerations; PAIRS, v = 'diff(q,t), .., give the names outside."
  (with-algebra-program
    (destructuring-bind (rows right)
        (forms-program-mass-form (algebra-program-element function)
                                 (algebra-program-element dissipation)
                                 (mapcar #'algebra-program-element (cdr forces))
                                 (cdr q) (cdr v))
      (forms-program-record q pairs (forms-program-outputs rows right solved)))))

(defun forms-program-record (q pairs outputs)
  (algebra-rename-inputs pairs)
  (algebra-program-record (append (cdr q) (mapcar #'third (cdr pairs))) outputs))
