;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Monomials common to a row or a column of a matrix of polynomials: M = diag(r) . M' . diag(c).
;;; Then det M = prod(r)*prod(c)*det M', adj(M)_ij = prod(c without i)*prod(r without j)*adj(M')_ij.
;;; Mass matrices of chains lose all their lengths this way before the minors are formed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels"))

(defun algebra-monomial (p)
  "The monomial that divides P: a list of (variable . exponent)."
  (if (atom p)
      nil
      (let ((common 'none))
        (loop for (exponent coefficient) on (cdr p) by #'cddr
              for inner = (algebra-monomial coefficient)
              for here = (if (zerop exponent) inner (acons (car p) exponent inner))
              do (setq common (algebra-common-monomial common here))
              while common)
        common)))

(defun algebra-common-monomial (a b)
  (if (eq a 'none)
      b
      (loop for (variable . exponent) in a
            for other = (cdr (assoc variable b :test #'eq))
            when other collect (cons variable (min exponent other)))))

(defun algebra-common-monomial-of (polynomials)
  "The common monomial of POLYNOMIALS, zeros left aside, as a polynomial."
  (let ((common 'none))
    (dolist (p polynomials)
      (unless (pzerop p)
        (setq common (algebra-common-monomial common (algebra-monomial p)))))
    (algebra-monomial-polynomial (if (eq common 'none) nil common))))

(defun algebra-monomial-polynomial (monomial)
  (let ((product 1))
    (loop for (variable . exponent) in monomial
          do (setq product (ptimes product (list variable exponent 1))))
    product))

(defun algebra-row-contents (matrix)
  "Divide MATRIX in place by the contents of its rows; these are returned."
  (let ((n (array-dimension matrix 0)))
    (loop for i below n
          collect (let ((content (algebra-common-monomial-of
                                  (loop for j below n collect (aref matrix i j)))))
                    (dotimes (j n content)
                      (setf (aref matrix i j) (algebra-divided (aref matrix i j) content)))))))

(defun algebra-column-contents (matrix)
  (let ((n (array-dimension matrix 0)))
    (loop for j below n
          collect (let ((content (algebra-common-monomial-of
                                  (loop for i below n collect (aref matrix i j)))))
                    (dotimes (i n content)
                      (setf (aref matrix i j) (algebra-divided (aref matrix i j) content)))))))

(defun algebra-divided (p content)
  (if (or (eql content 1) (pzerop p)) p (pquotient p content)))

(defun algebra-symmetric-p (matrix)
  (let ((n (array-dimension matrix 0)))
    (dotimes (i n t)
      (dotimes (j i)
        (unless (equal (aref matrix i j) (aref matrix j i))
          (return-from algebra-symmetric-p nil))))))

(defun algebra-poly-product (polynomials)
  (let ((product 1))
    (dolist (p polynomials product)
      (setq product (ptimes product p)))))

(defun algebra-product-without (polynomials place)
  (algebra-poly-product (loop for p in polynomials
                              for k from 0
                              unless (= k place) collect p)))
