;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Polynomials written as a person collects them: every function of the angles once, with what it is
;;; multiplied by,    l1*l2*(m2 + m3)*(sin(q1)*sin(q2) + cos(q1)*cos(q2)).
;;; The angles being the lowest variables, a polynomial is a sum of monomials of the others times
;;; polynomials in sines and cosines, its leaves; the monomials of leaves that are equal up to a
;;; number are collected. Taken only where it is shorter than the expanded form.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "algebra/contents"))

(defun $algebra_collected (e)
  "The canonical form of E, collected."
  (algebra-map-bags #'algebra-collected-form e))

(defun algebra-collected-form (e)
  (if (atom e)
      e
      (with-algebra-ring (algebra-collected-reduced (algebra-normal-quotient e)))))

(defun algebra-collected-reduced (quotient)
  "The collected expression of a QUOTIENT after reduction."
  (algebra-collected-quotient (algebra-readable (car quotient)) (algebra-readable (cdr quotient))))

(defun algebra-collected-quotient (n d)
  "N/D, N collected where D is a number and it is shorter so."
  (let ((groups (and (atom d) (mapcar #'algebra-group-factors (algebra-groups-of-leaves n)))))
    (if (and groups (< (algebra-size-of-groups groups) (algebra-expanded-size n)))
        (algebra-sum-of-products (mapcar (lambda (group) (algebra-group-expression group d)) groups))
        (algebra-general-quotient n d))))

(defun algebra-size-of-groups (groups)
  (loop for (nil . factors) in groups
        sum (loop for factor in factors
                  unless (eql factor 1) sum (algebra-expanded-size factor))))

;;; Leaves.

(defun algebra-map-leaves (function p)
  "FUNCTION of the monomial, a polynomial, and the leaf, for each leaf of P."
  (labels ((walk (p factors)
             (if (or (atom p) (algebra-angle-variable-p (car p)))
                 (funcall function factors p)
                 (loop for (exponent coefficient) on (cdr p) by #'cddr
                       do (walk coefficient (if (zerop exponent)
                                                factors
                                                (acons (car p) exponent factors)))))))
    (walk p '())))

(defun algebra-groups-of-leaves (p)
  "A list of (leaf . coefficient), the leaves without numbers in common."
  (let ((groups (make-hash-table :test #'equal)) (leaves '()))
    (algebra-map-leaves
     (lambda (monomial leaf)
       (let* ((number (algebra-signed-content leaf))
              (leaf (pquotient leaf number)))
         (unless (gethash leaf groups) (push leaf leaves))
         (push (ptimes number (algebra-monomial-polynomial monomial)) (gethash leaf groups))))
     p)
    (loop for leaf in (nreverse leaves)
          collect (cons leaf (algebra-polynomial-sum (gethash leaf groups))))))

(defun algebra-signed-content (p)
  (let ((content (algebra-number-content p)))
    (if (pminusp p) (- content) content)))

;;; Expressions.

(defun algebra-group-factors (group)
  "The number, the monomial, what is left of the coefficient, and the leaf."
  (destructuring-bind (leaf . coefficient) group
    (let* ((number (algebra-signed-content coefficient))
           (monomial (algebra-monomial-polynomial (algebra-monomial coefficient)))
           (rest (pquotient (pquotient coefficient number) monomial)))
      (if (and (minusp number) (algebra-mixed-signs-p rest))
          (list (- number) monomial (pminus rest) leaf)
          (list number monomial rest leaf)))))

(defun algebra-mixed-signs-p (p)
  "Whether P, whose first coefficient is positive, has a negative one."
  (if (atom p)
      (minusp p)
      (loop for (nil coefficient) on (cdr p) by #'cddr thereis (algebra-mixed-signs-p coefficient))))

(defun algebra-group-expression (factors d)
  "The list of expressions of the FACTORS that are not 1, the number over D."
  (remove 1 (cons (div (car factors) d) (mapcar #'algebra-general (cdr factors))) :test #'eql))

(defun algebra-sum-of-products (groups)
  (let ((terms (loop for factors in groups append (algebra-terms-of-product factors))))
    (cond ((null terms) 0)
          ((null (cdr terms)) (car terms))
          (t (cons '(mplus simp) (sort terms #'algebra-term-before-p))))))

(defun algebra-terms-of-product (factors)
  (let ((product (muln factors nil)))
    (if (mplusp product) (copy-list (cdr product)) (list product))))

(defun algebra-term-before-p (x y)
  "Maxima's order of the terms of a sum, which does not look at numbers in front."
  (great (algebra-without-number y) (algebra-without-number x)))

(defun algebra-without-number (term)
  (cond ((not (and (mtimesp term) (mnump (cadr term)))) term)
        ((cdddr term) (cons '(mtimes simp) (cddr term)))
        (t (caddr term))))
