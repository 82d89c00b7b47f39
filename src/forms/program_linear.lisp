;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Symmetric linear equations on programs, by L D L^T. An element of the matrix that is 0 costs
;;; nothing.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions"))

(defun forms-program-factors (rows fault)
  "The array with L below the diagonal and D on it, ROWS = L D L^T; FAULT: what a zero in D means."
  (let* ((n (length rows)) (a (make-array (list n n) :initial-contents rows)))
    (dotimes (k n a)
      (when (eql (aref a k k) 0) (core-error "~a" fault))
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

(defun forms-program-solution-by (a right)
  "x of L D L^T x = RIGHT, A as of forms-program-factors."
  (let ((n (length right)) (x (coerce right 'vector)))
    (flet ((take (i factor j)
             (setf (aref x i)
                   (algebra-program-subtract (aref x i)
                                             (algebra-program-multiply factor (aref x j))))))
      (dotimes (i n) (dotimes (j i) (take i (aref a i j) j)))
      (dotimes (i n) (setf (aref x i) (algebra-program-divide (aref x i) (aref a i i))))
      (loop for i from (1- n) downto 0
            do (loop for j from (1+ i) below n do (take i (aref a j i) j))))
    (coerce x 'list)))

(defparameter *forms-singular-mass*
  "the mass matrix is singular: the accelerations do not follow from the equations")

(defun forms-program-solution (rows right &optional (fault *forms-singular-mass*))
  "x of ROWS x = RIGHT, the rows symmetric."
  (forms-program-solution-by (forms-program-factors rows fault) right))
