;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Sums, products and powers of quotients (numerator . denominator), always reduced.  Common
;;; factors are sought where they can be: monomials and numbers are taken out by sight, long
;;; polynomials are first tried modulo a prime, and only what has a common factor goes to
;;; Maxima's greatest common divisor.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/modular"))

(defun algebra-gcd (p q)
  (cond ((or (eql p 1) (eql q 1)) 1)
        ((or (atom p) (atom q)) (pgcd p q))
        ((equal p q) p)
        ((< (* (algebra-monomials p) (algebra-monomials q)) 60) (pgcd p q))
        (t (algebra-long-gcd p q))))

(defun algebra-long-gcd (p q)
  "Contents apart, the rest only if it is not coprime modulo a prime."
  (let* ((content-p (algebra-content p))
         (content-q (algebra-content q))
         (content (pgcd content-p content-q))
         (rest-p (pquotient p content-p))
         (rest-q (pquotient q content-q)))
    (if (or (atom rest-p) (atom rest-q) (algebra-surely-coprime-p rest-p rest-q))
        content
        (ptimes content (pgcd rest-p rest-q)))))

(defun algebra-content (p)
  "The number and the monomial that divide all terms of P."
  (ptimes (algebra-number-content p) (algebra-monomial-polynomial (algebra-monomial p))))

(defun algebra-number-content (p)
  (if (atom p)
      (abs p)
      (let ((content 0))
        (loop for (nil coefficient) on (cdr p) by #'cddr
              do (setq content (gcd content (algebra-number-content coefficient)))
              until (= content 1))
        content)))

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

(defun algebra-monomial-polynomial (monomial)
  (let ((product 1))
    (loop for (variable . exponent) in monomial
          do (setq product (ptimes product (list variable exponent 1))))
    product))

(defun algebra-divided (p content)
  (if (or (eql content 1) (pzerop p)) p (pquotient p content)))

(defun algebra-quotient-of (n d)
  "N/D reduced, the denominator's first coefficient positive."
  (cond ((pzerop n) (cons 0 1))
        ((eql d 1) (cons n 1))
        (t (let ((g (algebra-gcd n d)))
             (algebra-with-positive-denominator (algebra-divided n g) (algebra-divided d g))))))

(defun algebra-with-positive-denominator (n d)
  (if (pminusp d) (cons (pminus n) (pminus d)) (cons n d)))

(defun algebra-plus (x y)
  "Over the least common denominator; only its common part can cancel."
  (destructuring-bind (n . d) x
    (destructuring-bind (m . e) y
      (cond ((pzerop n) y)
            ((pzerop m) x)
            ((and (eql d 1) (eql e 1)) (cons (pplus n m) 1))
            (t (let* ((g (algebra-gcd d e))
                      (d-rest (algebra-divided d g))
                      (sum (pplus (ptimes n (algebra-divided e g)) (ptimes m d-rest)))
                      (cancelled (algebra-quotient-of sum g)))
                 (algebra-with-positive-denominator
                  (car cancelled)
                  (ptimes (cdr cancelled) (ptimes d-rest (algebra-divided e g))))))))))

(defun algebra-times (x y)
  (let ((across (algebra-quotient-of (car x) (cdr y)))
        (back (algebra-quotient-of (car y) (cdr x))))
    (algebra-with-positive-denominator (ptimes (car across) (car back))
                                       (ptimes (cdr across) (cdr back)))))

(defun algebra-over-quotient (x y)
  (algebra-times x (algebra-inverted y)))

(defun algebra-inverted (x)
  (when (pzerop (car x)) (core-error "division by zero"))
  (algebra-with-positive-denominator (cdr x) (car x)))

(defun algebra-to-power (x n)
  (if (minusp n)
      (algebra-to-power (algebra-inverted x) (- n))
      (cons (pexpt (car x) n) (pexpt (cdr x) n))))

(defun algebra-sum (terms)
  "Terms over one denominator first, then halves to halves: intermediate sums stay short."
  (algebra-sum-of-halves (if (cddr terms) (algebra-joined-terms terms) terms)))

(defun algebra-sum-of-halves (terms)
  (cond ((null terms) (cons 0 1))
        ((null (cdr terms)) (car terms))
        (t (let ((half (floor (length terms) 2)))
             (algebra-plus (algebra-sum-of-halves (subseq terms 0 half))
                           (algebra-sum-of-halves (nthcdr half terms)))))))

(defun algebra-joined-terms (terms)
  (let ((groups nil))
    (loop for (n . d) in terms
          do (let ((group (assoc d groups :test #'equal)))
               (if group
                   (push n (cdr group))
                   (push (list d n) groups))))
    (loop for (d . numerators) in groups
          collect (algebra-quotient-of (algebra-polynomial-sum numerators) d))))

(defun algebra-polynomial-sum (polynomials)
  (if (null (cdr polynomials))
      (car polynomials)
      (let ((half (floor (length polynomials) 2)))
        (pplus (algebra-polynomial-sum (subseq polynomials 0 half))
               (algebra-polynomial-sum (nthcdr half polynomials))))))
