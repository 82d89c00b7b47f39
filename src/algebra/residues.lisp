;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The value of a polynomial expression, and of a determinant of such, at a point modulo a prime:
;;; a check of long results that takes less time than they.  The point is decided by the names, as
;;; that of forms/agreement; two different polynomials of degree d agree there with the
;;; probability d/2^30 (Schwartz, 1980).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/modular" "algebra/random_numbers"))

(defun $algebra_residue (e)
  "The value of E; false where E is not made of whole powers of names and rational numbers."
  (catch 'no-residue (algebra-expression-residue e (make-hash-table :test #'eq))))

(defun $algebra_determinant_residue (matrix)
  "The same of the determinant."
  (let ((values (make-hash-table :test #'eq)))
    (flet ((value (e) (algebra-expression-residue e values)))
      (catch 'no-residue
        (algebra-residues-determinant
         (loop for (nil . row) in (cdr matrix) collect (map 'simple-vector #'value row)))))))

(defun algebra-expression-residue (e values)
  (cond ((integerp e) (algebra-residue e))
        ((symbolp e) (or (gethash e values)
                         (setf (gethash e values) (algebra-name-residue e))))
        ((atom e) (throw 'no-residue nil))
        (t (case (caar e)
             (mplus (algebra-residue-sum (cdr e) values))
             (mtimes (algebra-residue-product (cdr e) values))
             (rat (algebra-rational-residue (/ (cadr e) (caddr e))))
             (mexpt (or (gethash e values) ; one power stands in many terms
                        (setf (gethash e values)
                              (algebra-power-residue
                               (algebra-expression-residue (cadr e) values) (caddr e)))))
             (t (throw 'no-residue nil))))))

(defun algebra-residue-sum (parts values)
  (let ((sum 0))
    (declare (fixnum sum))
    (dolist (part parts sum)
      (setq sum (algebra-modulo
                 (+ sum (the fixnum (algebra-expression-residue part values))))))))

(defun algebra-residue-product (parts values)
  (let ((product 1))
    (declare (fixnum product))
    (dolist (part parts product)
      (setq product (algebra-modulo
                     (* product (the fixnum (algebra-expression-residue part values))))))))

(defun algebra-name-residue (name)
  (if ($constantp name)
      (throw 'no-residue nil)
      (algebra-rational-residue (algebra-random-number name))))

(defun algebra-rational-residue (r)
  (algebra-modulo (* (the fixnum (algebra-residue (numerator r)))
                     (the fixnum (algebra-inverse-residue (algebra-residue (denominator r)))))))

(defun algebra-inverse-residue (a)
  (if (zerop a) (throw 'no-residue nil) (algebra-modular-inverse a)))

(defun algebra-power-residue (base n)
  (cond ((not (integerp n)) (throw 'no-residue nil))
        ((minusp n) (algebra-modular-power (algebra-inverse-residue base) (- n)))
        (t (algebra-modular-power base n))))

(defun algebra-residues-determinant (rows)
  "By elimination; ROWS are changed."
  (let ((determinant 1))
    (loop for column from 0 below (length rows)
          for pivot = (find-if (lambda (row) (plusp (svref row column))) rows)
          unless pivot return 0
            do (setq determinant (mod (* determinant (svref pivot column)
                                         (if (oddp (position pivot rows :test #'eq)) -1 1))
                                      (algebra-prime))
                     rows (remove pivot rows :test #'eq))
               (let ((inverse (algebra-modular-inverse (svref pivot column))))
                 (dolist (row rows)
                   (algebra-subtract-row row (mod (* inverse (svref row column)) (algebra-prime))
                                         pivot column (algebra-prime))))
          finally (return determinant))))
