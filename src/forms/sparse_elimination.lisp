;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Symmetric linear equations with few entries on programs: L D L^T, the unknown with the fewest
;;; neighbours left eliminated next (minimum degree: W. Tinney, J. Walker, Proc. IEEE 55 (1967)), so
;;; that a tree of unknowns costs no more than its branches. Rows are lists ((j . element) ..), j
;;; from 0. See forms-sparse-factors first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes"))

(defstruct forms-sparse-step place pivot factors) ; factors: ((i . l_ik) ..)

(defstruct forms-arithmetic
  (subtract #'algebra-program-subtract) (multiply #'algebra-program-multiply)
  (divide #'algebra-program-divide))

(defun forms-row-tables (rows)
  (let ((tables (make-array (length rows))))
    (loop for row in rows
          for i from 0
          for table = (make-hash-table)
          do (loop for (j . element) in row
                   unless (forms-nothing-p element) do (setf (gethash j table) element))
             (setf (aref tables i) table))
    tables))

(defun forms-nothing-p (element) (and (numberp element) (zerop element)))

(defun forms-sparse-factors (rows fault &optional (arithmetic (make-forms-arithmetic)))
  "The steps of the elimination in their order; FAULT is a function of the place of a pivot 0 that
gives another one, or ends in an error."
  (let ((tables (forms-row-tables rows)) (open (loop for nil in rows for i from 0 collect i)))
    (loop while open
          collect (let ((k (forms-fewest-neighbours open tables)))
                    (setq open (delete k open))
                    (forms-eliminated-place k tables fault arithmetic)))))

(defun forms-fewest-neighbours (open tables)
  (let ((best (first open)))
    (dolist (k (rest open) best)
      (when (< (hash-table-count (aref tables k)) (hash-table-count (aref tables best)))
        (setq best k)))))

(defun forms-sorted-entries (table)
  (sort (loop for j being the hash-keys of table using (hash-value element)
              collect (cons j element))
        #'< :key #'car))

(defun forms-eliminated-place (k tables fault arithmetic)
  "The step for K, whose row and column are taken out of TABLES."
  (let* ((pivot (or (gethash k (aref tables k)) (funcall fault k)))
         (others (remove k (forms-sorted-entries (aref tables k)) :key #'car))
         (factors (loop for (i . element) in others
                        collect (cons i (funcall (forms-arithmetic-divide arithmetic)
                                                 element pivot)))))
    (loop for (i . factor) in factors
          for table = (aref tables i)
          do (remhash k table)
             (loop for (j . element) in others
                   do (forms-take-product table j factor element arithmetic)))
    (make-forms-sparse-step :place k :pivot pivot :factors factors)))

(defun forms-take-product (table j factor element arithmetic)
  (let ((left (funcall (forms-arithmetic-subtract arithmetic) (gethash j table 0)
                       (funcall (forms-arithmetic-multiply arithmetic) factor element))))
    (if (forms-nothing-p left) (remhash j table) (setf (gethash j table) left))))

(defun forms-sparse-solution (steps right)
  "x of L D L^T x = RIGHT, a list."
  (let ((x (coerce right 'vector)))
    (flet ((take (i factor j)
             (setf (aref x i)
                   (algebra-program-subtract (aref x i)
                                             (algebra-program-multiply factor (aref x j))))))
      (dolist (step steps)
        (loop for (i . factor) in (forms-sparse-step-factors step)
              do (take i factor (forms-sparse-step-place step))))
      (dolist (step (reverse steps))
        (let ((k (forms-sparse-step-place step)))
          (setf (aref x k) (algebra-program-divide (aref x k) (forms-sparse-step-pivot step)))
          (loop for (i . factor) in (forms-sparse-step-factors step) do (take k factor i)))))
    (coerce x 'list)))
