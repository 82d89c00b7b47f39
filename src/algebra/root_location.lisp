;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Where the roots of p = a_0 x^n + .. + a_n with real constants lie, with multiplicity.  With
;;; P = a_0 w^n - a_2 w^(n-2) + .., Q = a_1 w^(n-1) - a_3 w^(n-3) + .. the index of Q/P is
;;; left - right (Gantmacher, The Theory of Matrices, XV, 3; common factors cancel).  As
;;; p(iw) = i^n*(P - i*Q), the roots on the axis are the real roots of g = gcd(P, Q), counted by the
;;; index of g'/g, those of gcd(g, g') once more, and so on.
;;; It begins with the chain of subresultants by which the index is counted.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/constant_sign" "algebra/interval" "algebra/routh_array"
                "algebra/sturm"))

;;; Signed subresultants of two polynomials with real constants as coefficients, and what follows
;;; from their signs: Cauchy's index of Q/P and the greatest common divisor (Basu, Pollack, Roy,
;;; Algorithms in Real Algebraic Geometry, 2006, algorithm 8.21 and theorem 4.32).  Rational
;;; coefficients are exact; others are intervals.  Each coefficient that comes is a determinant of
;;; known size: Hadamard's inequality bounds it in every embedding and, by its norm, from below; an
;;; interval under that bound is 0.  Where neither its sign nor 0 is proved, all is done again with
;;; more digits.  Of rational polynomials Sturm's chain of whole, primitive remainders serves: its
;;; numbers are half as long.

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
  index     ; Cauchy's, of Q/P from -inf to inf
  divisor)  ; coefficients of the last that does not vanish

(defun algebra-subresultants (p q)
  "The sequence of P and Q, real polynomials, the degree of Q below that of P."
  (let* ((a (algebra-trimmed-real (algebra-real-at p) (algebra-rows-bits p q '(1 . 0))))
         (b (algebra-trimmed-real (algebra-real-at q) (algebra-rows-bits p q '(0 . 1)))))
    (cond ((every #'rationalp (append a b)) (algebra-rational-sequence a b))
          ((plusp (algebra-n-sign (car a) nil)) (algebra-subresultants-of a b p q))
          (t (algebra-subresultants-of (mapcar #'algebra-n-minus a) (mapcar #'algebra-n-minus b)
                                       p q)))))

(defun algebra-rational-sequence (a b)
  (let ((chain (algebra-remainders (algebra-primitive a) (algebra-primitive b))))
    (make-algebra-sequence
     :index (loop for (f g) on chain
                  when (and g (oddp (- (length f) (length g))))
                    sum (* (signum (car f)) (signum (car g))))
     :divisor (car (last chain)))))

(defun algebra-n-minus (a) (algebra-n- 0 a))

(defun algebra-trimmed-real (coefficients bits)
  (member-if-not (lambda (c) (eql 0 (algebra-n-sign c bits))) coefficients))

(defun algebra-subresultants-of (a b p q)
  "A and B the coefficients of P and Q, that of the highest power of A positive."
  (let* ((top (1- (length a))) (bottom (1- (length b)))
         (signs (list (cons top 1))) ; of the principal coefficients, with their degrees
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
    (make-algebra-sequence :index (algebra-signs-index (nreverse signs)) :divisor a)))

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

(defun algebra-signs-index (signs)
  (loop for ((j . sign) (k . next)) on signs
        while k
        when (oddp (- j k))
          sum (* sign next (if (member (mod (- j k) 4) '(0 1)) 1 -1))))

(defun algebra-common-divisor (p q sequence)
  "The greatest common divisor g of P and Q, from their SEQUENCE, monic.  With the leading
coefficient a of S*P the coefficients of a*g are algebraic integers (Gauss), in size at most
2^degree times the length of S*P (Landau, Mignotte)."
  (make-algebra-real
   :coefficients (lambda ()
                   (algebra-monic (algebra-sequence-divisor (algebra-subresultants p q))))
   :norm (+ (algebra-sequence-degree sequence) (algebra-real-norm p))
   :scale (algebra-real-norm p)))

(defun algebra-monic (g)
  "G over its leading coefficient; whole where rational, which has the same roots."
  (if (every #'rationalp g)
      (algebra-primitive g)
      (cons 1 (loop for c in (cdr g) collect (algebra-n/ c (car g))))))

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
       :coefficients (lambda () (algebra-real-numbers coefficients))
       :norm norm :scale scale))))

(defun algebra-real-numbers (coefficients)
  (let ((numbers (loop for c in coefficients
                       collect (or (algebra-rational-number c) (algebra-i-of c)))))
    (if (every #'rationalp numbers) (algebra-primitive numbers) numbers)))

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

;;; ---- root location

(defun $algebra_located (coefficients)
  "[left, axis, right]; false where a coefficient is not algebraic and intervals do not decide."
  (let* ((whole (algebra-whole-coefficients (cdr coefficients)))
         (places (if whole
                     (algebra-located-whole whole #'algebra-located-by-index)
                     (algebra-located-by-index (cdr coefficients)))))
    (and places (cons '(mlist simp) places))))

(defun algebra-whole-coefficients (coefficients)
  "Rational ones without fractions and leading zeros; nil where there are others."
  (let ((numbers (mapcar #'algebra-rational-number coefficients)))
    (and (notany #'null numbers) (algebra-primitive numbers))))

(defun algebra-located-by-index (coefficients)
  (algebra-with-digits coefficients #'algebra-located))

(defun $algebra_simple_symmetric (coefficients)
  "yes or no: are the roots that lie symmetric about 0 simple; false as above."
  (let ((whole (algebra-whole-coefficients (cdr coefficients))))
    (if whole
        (if (algebra-simple-whole-p whole) '$yes '$no)
        (algebra-with-digits (cdr coefficients)
                             (lambda (p degree)
                               (declare (ignore degree))
                               (if (algebra-simple-p (algebra-axis-divisor p)) '$yes '$no))))))

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
