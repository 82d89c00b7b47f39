;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Where the roots of p = a_0 x^n + .. + a_n with real constants lie, with multiplicity.  With
;;; P = a_0 w^n - a_2 w^(n-2) + .., Q = a_1 w^(n-1) - a_3 w^(n-3) + .. the index of Q/P is
;;; left - right (Gantmacher, The Theory of Matrices, XV, 3; common factors cancel).  As
;;; p(iw) = i^n*(P - i*Q), the roots on the axis are the real roots of g = gcd(P, Q), counted by the
;;; index of g'/g, those of gcd(g, g') once more, and so on.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common" "algebra/subresultants" "algebra/constant_sign"
                "algebra/interval" "algebra/separation_bound"))

(defun $algebra_located (coefficients)
  "[left, axis, right]; false where a coefficient is not algebraic and intervals do not decide."
  (algebra-with-digits (cdr coefficients)
                       (lambda (p degree) (cons '(mlist simp) (algebra-located p degree)))))

(defun $algebra_simple_symmetric (coefficients)
  "yes or no: are the roots that lie symmetric about 0 simple; false as above."
  (algebra-with-digits (cdr coefficients)
                       (lambda (p degree)
                         (declare (ignore degree))
                         (if (algebra-simple-p (algebra-axis-divisor p)) '$yes '$no))))

(defun $algebra_distinct_real_roots (coefficients)
  "How many real numbers are roots of the polynomial, of degree 1 at least; false as above."
  (algebra-with-digits (cdr coefficients)
                       (lambda (p degree)
                         (algebra-sequence-index
                          (algebra-subresultants p (algebra-real-derivative p degree))))))

(defun algebra-located (p n)
  (let* ((index (algebra-sequence-index (algebra-subresultants (algebra-part p 0)
                                                               (algebra-part p 1))))
         (axis (algebra-real-root-count (algebra-axis-divisor p)))
         (places (list (/ (+ n (- axis) index) 2) axis (/ (- n axis index) 2))))
    (unless (every (lambda (k) (typep k '(integer 0))) places)
      (core-error "the roots counted, ~{~A~^, ~}, are no whole numbers with the sum ~A; ~
                   please report this with the input"
                  places n))
    places))

(defun algebra-part (p start)
  "P for START 0, Q for 1."
  (algebra-real-map (lambda (a)
                      (loop for c in (nthcdr start a)
                            for k from 0
                            collect (case (mod k 4)
                                      (0 c)
                                      (2 (algebra-n-minus c))
                                      (t 0))))
                    p))

(defun algebra-axis-divisor (p)
  (algebra-divisor-of (algebra-part p 0) (algebra-part p 1)))

(defun algebra-divisor-of (p q)
  (algebra-common-divisor p q (algebra-subresultants p q)))

(defun algebra-real-degree (p) (1- (length (algebra-real-at p))))

(defun algebra-real-root-count (g)
  "The number of real roots of G, with multiplicity."
  (let ((degree (algebra-real-degree g)))
    (if (< degree 1)
        0
        (let* ((slope (algebra-real-derivative g degree))
               (sequence (algebra-subresultants g slope)))
          (+ (algebra-sequence-index sequence)
             (algebra-real-root-count (algebra-common-divisor g slope sequence)))))))

(defun algebra-simple-p (g)
  "Whether G has no multiple root."
  (let ((degree (algebra-real-degree g)))
    (or (< degree 1)
        (zerop (algebra-sequence-degree
                (algebra-subresultants g (algebra-real-derivative g degree)))))))

;;; Digits.

(defun algebra-with-digits (coefficients function)
  "FUNCTION of the real polynomial and its degree, with as many digits as it needs."
  (let ((a (catch 'not-algebraic
             (member 0 (mapcar #'algebra-plain-coefficient coefficients) :test-not #'eql))))
    (and a
         (let ((*algebra-field-degree* (algebra-real-field a)))
           (algebra-first-decided a (lambda (p) (funcall function p (1- (length a)))))))))

(defun algebra-plain-coefficient (c)
  "C, or 0 where it is 0 in disguise; throws not-algebraic where this leaves it undecided."
  (or (algebra-rational-number c)
      (let ((sign (algebra-constant-verdict c))
            (plain (catch 'algebra-undecided (algebra-plain-constant c))))
        (cond ((eql sign 0) 0)
              ((and sign plain))
              (t (algebra-bound-of (or plain c))
                 (core-undecided "it is not decided whether ~A is 0" (algebra-short-text c)))))))

(defun algebra-first-decided (coefficients function)
  (let ((p (algebra-real-of coefficients)))
    (loop for bits in (if *algebra-field-degree*
                          (list 64 256 1024 4096 12288 *algebra-most-bits*)
                          '(64 256 1024))
          for answer = (let ((*algebra-interval-bits* bits))
                         (catch 'no-interval (list (funcall function p))))
          when answer return (car answer)
          finally (when *algebra-field-degree* (algebra-digits-missing coefficients)))))

(defun algebra-digits-missing (coefficients)
  (core-undecided "~A binary digits do not decide where the roots lie that are so close to each ~
                   other or to the axis; the coefficients are made of ~{~A~^, ~}"
                  *algebra-most-bits*
                  (mapcar #'algebra-short-text
                          (remove-if #'algebra-rational-number coefficients))))
