;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Cramer's rule on general expressions, nothing multiplied out: for linear equations whose
;;; solution is too long in the canonical form,
;;;     x_j = sum over i of (-1)^(i+j) b_i M_ij/det M,
;;; M_ij the minor without row i and column j. A minor is made once, from those of its later rows,
;;; so that the expressions share their parts. Sets of rows and of columns are bits of integers.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/linear" "algebra/size"))

(defun $algebra_short_inverse_times (m b terms)
  "x with M x = b in the canonical form; an error where a product would have more than TERMS."
  (let ((*algebra-limit* terms) (*algebra-advice* "take form = factored"))
    ($algebra_inverse_times m b)))

(defun $algebra_unexpanded_inverse_times (m b)
  "x with M x = b, b a list: sums of products of the elements."
  (algebra-check-square m "the matrix of linear equations")
  (let ((matrix (algebra-rectangle-of m)) (right (cdr b)))
    (algebra-guard (algebra-unexpanded-size matrix right)
                   "the equations solved for the accelerations"
                   "take EquationProgram with solved = true")
    (algebra-unexpanded-solution matrix right)))

(defun algebra-rectangle-of (m)
  (make-array (list (length (cdr m)) (length (cdadr m)))
              :initial-contents (mapcar #'cdr (cdr m))))

(defun algebra-unexpanded-solution (matrix right)
  (let* ((n (length right))
         (minor (algebra-minors matrix 1
                                (lambda (sign entry minor) (mul sign entry minor))
                                (lambda (terms) (addn terms nil))))
         (determinant (funcall minor (1- (ash 1 n)) (1- (ash 1 n)))))
    (when (eql determinant 0) (core-error "the matrix of linear equations is singular"))
    (flet ((numerator (j)
             (addn (loop for b in right
                         for i from 0
                         collect (mul (if (evenp (+ i j)) 1 -1) b
                                      (funcall minor (algebra-all-but i n) (algebra-all-but j n))))
                   nil)))
      (cons '(mlist simp)
            (loop for j below n collect (div (numerator j) determinant))))))

(defun algebra-all-but (k n) (logxor (ash 1 k) (1- (ash 1 n))))

(defun algebra-minors (matrix one term sum)
  "The function of a set of rows and a set of columns that gives their minor: SUM of the TERMs of
sign, element and smaller minor, ONE where the sets are empty, 0 where it has no terms."
  (let ((known (make-hash-table :test #'equal)))
    (labels ((minor (rows columns)
               (if (zerop rows)
                   one
                   (let ((key (cons rows columns)))
                     (multiple-value-bind (value found) (gethash key known)
                       (if found value (setf (gethash key known) (expansion rows columns)))))))
             (expansion (rows columns)
               (let* ((i (1- (integer-length (logand rows (- rows)))))
                      (terms (terms i (logxor rows (ash 1 i)) columns)))
                 (if terms (funcall sum terms) 0)))
             (terms (i rows columns)
               (loop with sign = 1
                     for j below (array-dimension matrix 1)
                     for entry = (aref matrix i j)
                     for smaller = (and (logbitp j columns) (not (eql entry 0))
                                        (minor rows (logxor columns (ash 1 j))))
                     unless (member smaller '(nil 0))
                       collect (funcall term sign entry smaller)
                     do (when (logbitp j columns) (setq sign (- sign))))))
      #'minor)))

(defun algebra-unexpanded-size (matrix right)
  "How many nodes the solution would have, written out."
  (let* ((n (length right))
         (all (1- (ash 1 n)))
         (size (algebra-minors matrix 1
                               (lambda (sign entry size)
                                 (declare (ignore sign))
                                 (+ 1 (algebra-size entry) size))
                               (lambda (sizes) (reduce #'+ sizes)))))
    (loop for j below n
          sum (+ (funcall size all all)
                 (loop for b in right
                       for i from 0
                       sum (+ (algebra-size b)
                              (funcall size (algebra-all-but i n) (algebra-all-but j n))))))))
