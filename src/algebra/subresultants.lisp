;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Signed subresultants of two polynomials with real constants as coefficients, and what follows
;;; from their signs: Cauchy's index of Q/P and the greatest common divisor (Basu, Pollack, Roy,
;;; Algorithms in Real Algebraic Geometry, 2006, algorithm 8.21 and theorem 4.32).  Rational
;;; coefficients are exact; others are intervals.  Each coefficient that comes is a determinant of
;;; known size: Hadamard's inequality bounds it in every embedding and, by its norm, from below; an
;;; interval under that bound is 0.  Where neither its sign nor 0 is proved, all is done again with
;;; more digits.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common" "algebra/constant_sign" "algebra/interval"
                "algebra/separation_bound"))

(defvar *algebra-field-degree* nil "degree of the field of all coefficients; nil: not algebraic")

;;; Numbers: rationals, or intervals.

(defun algebra-n-interval (a) (if (rationalp a) (algebra-i a) a))

(defun algebra-n- (a b)
  (cond ((and (rationalp a) (rationalp b)) (- a b))
        ((eql b 0) a)
        (t (algebra-i- (algebra-n-interval a) (algebra-n-interval b)))))

(defun algebra-n* (a b)
  (cond ((and (rationalp a) (rationalp b)) (* a b))
        ((or (eql a 0) (eql b 0)) 0)
        (t (algebra-i* (algebra-n-interval a) (algebra-n-interval b)))))

(defun algebra-n/ (a b)
  (cond ((and (rationalp a) (rationalp b)) (/ a b))
        ((eql a 0) 0)
        (t (algebra-i/ (algebra-n-interval a) (algebra-n-interval b)))))

(defun algebra-n-sign (a bits)
  "The sign of A, 0 or in size at least 2^-BITS; throws no-interval where it is not proved."
  (cond ((rationalp a) (signum a))
        ((plusp (car a)) 1)
        ((minusp (cdr a)) -1)
        ((and bits (algebra-i-below-p a bits)) 0)
        (t (throw 'no-interval nil))))

;;; A polynomial: its coefficients, highest first, by a function of the digits in force.

(defstruct (algebra-real (:conc-name algebra-real-) (:predicate nil))
  coefficients
  norm    ; S times the coefficients are algebraic integers; binary logarithm of their length
  scale   ; and of S, in every embedding
  known)  ; (digits . coefficients) found last

(defun algebra-real-at (p)
  (unless (eql (car (algebra-real-known p)) *algebra-interval-bits*)
    (setf (algebra-real-known p)
          (cons *algebra-interval-bits* (funcall (algebra-real-coefficients p)))))
  (cdr (algebra-real-known p)))

(defun algebra-real-map (function p &optional (growth 0))
  "P with FUNCTION applied to its list of coefficients, which grow by at most 2^GROWTH."
  (make-algebra-real :coefficients (lambda () (funcall function (algebra-real-at p)))
                     :norm (+ growth (algebra-real-norm p))
                     :scale (algebra-real-scale p)))

(defun algebra-real-derivative (p degree)
  (algebra-real-map (lambda (a)
                      (loop for c in (butlast a)
                            for k downfrom (1- (length a))
                            collect (algebra-n* k c)))
                    p (integer-length degree)))

;;; How small a coefficient of a determinant with rows of P and rows of Q can be.

(defun algebra-rows-norm (p q rows)
  (+ (* (car rows) (algebra-real-norm p)) (* (cdr rows) (algebra-real-norm q))))

(defun algebra-rows-scale (p q rows)
  (+ (* (car rows) (algebra-real-scale p)) (* (cdr rows) (algebra-real-scale q))))

(defun algebra-rows-bits (p q rows)
  (and *algebra-field-degree*
       (ceiling (+ (* (1- *algebra-field-degree*) (algebra-rows-norm p q rows))
                   (algebra-rows-scale p q rows)))))

;;; The sequence.

(defstruct (algebra-sequence (:conc-name algebra-sequence-))
  signs     ; ((degree . sign of the principal coefficient) ..), falling degrees
  divisor)  ; coefficients of the last that does not vanish

(defun algebra-subresultants (p q)
  "The sequence of P and Q, real polynomials, the degree of Q below that of P."
  (let* ((a (algebra-trimmed-real (algebra-real-at p) (algebra-rows-bits p q '(1 . 0))))
         (b (algebra-trimmed-real (algebra-real-at q) (algebra-rows-bits p q '(0 . 1)))))
    (if (minusp (algebra-n-sign (car a) nil))
        (algebra-subresultants-of (mapcar #'algebra-n-minus a) (mapcar #'algebra-n-minus b) p q)
        (algebra-subresultants-of a b p q))))

(defun algebra-n-minus (a) (algebra-n- 0 a))

(defun algebra-trimmed-real (coefficients bits)
  (member-if-not (lambda (c) (eql 0 (algebra-n-sign c bits))) coefficients))

(defun algebra-subresultants-of (a b p q)
  "A and B the coefficients of P and Q, that of the highest power of A positive."
  (let* ((top (1- (length a))) (bottom (1- (length b)))
         (signs (list (cons top 1)))
         (last-a 1) (principal 1) (j top))
    (loop until (null b)
          do (let* ((k (1- (length b)))
                    (next (algebra-principal (car b) principal (- j k)))
                    (rows (cons (- bottom (1- k)) (- top (1- k))))
                    (rest (algebra-next-subresultant a b (algebra-n* (car b) next)
                                                     (algebra-n* principal last-a))))
               (push (cons k (algebra-n-sign next nil)) signs)
               (psetq last-a (car b) principal next j k
                      a b b (algebra-trimmed-real rest (algebra-rows-bits p q rows)))))
    (make-algebra-sequence :signs (nreverse signs) :divisor a)))

(defun algebra-principal (leading principal gap)
  "s_k of a subresultant with the LEADING coefficient, GAP degrees below that of PRINCIPAL."
  (let ((value leading))
    (loop for step from 1 below gap
          for product = (algebra-n/ (algebra-n* leading value) principal)
          do (setq value (if (oddp step) (algebra-n-minus product) product)))
    value))

(defun algebra-next-subresultant (a b factor divisor)
  "-(the remainder of FACTOR*A by B)/DIVISOR"
  (loop for c in (algebra-real-remainder (loop for c in a collect (algebra-n* factor c)) b)
        collect (algebra-n/ (algebra-n-minus c) divisor)))

(defun algebra-real-remainder (a b)
  (loop while (>= (length a) (length b))
        do (let ((factor (algebra-n/ (car a) (car b))))
             (setq a (cdr a))
             (unless (eql factor 0)
               (setq a (append (loop for c in a
                                     for d in (cdr b)
                                     collect (algebra-n- c (algebra-n* factor d)))
                               (nthcdr (1- (length b)) a))))))
  a)

(defun algebra-sequence-index (sequence)
  "Cauchy's index of Q/P from -inf to inf."
  (loop for ((j . sign) (k . next)) on (algebra-sequence-signs sequence)
        while k
        when (oddp (- j k))
          sum (* sign next (if (member (mod (- j k) 4) '(0 1)) 1 -1))))

(defun algebra-common-divisor (p q sequence)
  "The greatest common divisor g of P and Q, from their SEQUENCE, monic.  With the leading
coefficient a of S*P the coefficients of a*g are algebraic integers (Gauss), in size at most
2^degree times the length of S*P (Landau, Mignotte)."
  (make-algebra-real
   :coefficients (lambda ()
                   (let ((g (algebra-sequence-divisor (algebra-subresultants p q))))
                     (cons 1 (loop for c in (cdr g) collect (algebra-n/ c (car g))))))
   :norm (+ (algebra-sequence-degree sequence) (algebra-real-norm p))
   :scale (algebra-real-norm p)))

(defun algebra-sequence-degree (sequence)
  "The degree of the greatest common divisor."
  (1- (length (algebra-sequence-divisor sequence))))

;;; Polynomials from expressions.

(defun algebra-real-of (coefficients)
  "The real polynomial of constants, highest power first, none of them 0 in disguise."
  (let ((bounds (mapcar (lambda (c) (catch 'not-algebraic (algebra-bound-of c))) coefficients)))
    (multiple-value-bind (norm scale)
        (if (member nil bounds) (values 0 0) (algebra-joint-bound bounds))
      (make-algebra-real
       :coefficients (lambda ()
                       (loop for c in coefficients
                             collect (or (algebra-rational-number c) (algebra-i-of c))))
       :norm norm :scale scale))))

(defun algebra-joint-bound (bounds)
  "Logarithms of the length of S*c and of S, S = lcm(m)*l_1*l_2*.."
  (let* ((whole (reduce #'lcm bounds :key #'algebra-bound-m))
         (below (loop for b in bounds sum (algebra-log-of-bound (algebra-bound-l b)))))
    (values (+ (loop for b in bounds
                     for factor = (floor whole (algebra-bound-m b))
                     maximize (+ (algebra-log-of-bound (* factor (algebra-bound-u b)))
                                 (- below (algebra-log-of-bound (algebra-bound-l b)))))
               (/ (integer-length (length bounds)) 2))
            (+ below (algebra-binary-logarithm whole)))))

(defun algebra-real-field (coefficients)
  "The degree of the field of constants, or nil."
  (if (every #'algebra-algebraic-p coefficients)
      (algebra-field-degree coefficients)))
