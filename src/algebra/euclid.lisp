;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Euclid's algorithm for polynomials in one unknown, given by their coefficients, highest power
;;; first, over constants of any kind: what is 0 must be known, and what is not decided is an error.
;;; (0) is the zero polynomial.  Sturm's chain f, g, -rem(f, g), .. counts by its changes of sign
;;; the real roots of f where g = f', and Cauchy's index of g/f (Gantmacher, XV, 2 and 3).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/normal" "algebra/zero" "algebra/sign"
                "algebra/sturm" "algebra/root_location"))

;;; Constants: rationals of Lisp, or expressions in normal form

(defun algebra-euclid-list (coefficients)
  (mapcar (lambda (c) (or (algebra-rational-number c) c)) (cdr coefficients)))

(defun algebra-euclid-expression (c) (if (rationalp c) (algebra-maxima-rational c) c))

(defun algebra-euclid-coefficients (a)
  "A as Maxima has it."
  (cons '(mlist simp) (mapcar #'algebra-euclid-expression a)))

(defun algebra-constant-zero-p (c)
  (if (rationalp c)
      (zerop c)
      (let ((zero ($algebra_zerop c)))
        (when (eq zero '$unknown)
          (core-undecided "it is not decided whether ~A is 0" (algebra-short-text c)))
        zero)))

(defun algebra-sign-of-constant (c)
  "1, 0 or -1."
  (if (rationalp c)
      (signum c)
      (case ($algebra_sign c)
        ($pos 1)
        ($neg -1)
        ($zero 0)
        (t (core-undecided "the sign of ~A is not decided" (algebra-short-text c))))))

(defun algebra-constant-operation (function operator &rest constants)
  "FUNCTION of rationals, of others that of Maxima, OPERATOR, in normal form."
  (if (every #'rationalp constants)
      (apply function constants)
      (let ((e ($algebra_normal
                (apply operator (mapcar #'algebra-euclid-expression constants)))))
        (or (algebra-rational-number e) e))))

(defun algebra-constant-quotient (a b) (algebra-constant-operation #'/ #'div a b))

(defun algebra-constant-less (c factor d)
  (algebra-constant-operation (lambda (c f d) (- c (* f d)))
                              (lambda (c f d) (sub c (mul f d)))
                              c factor d))

;;; Polynomials

(defun algebra-euclid-trimmed (a)
  "Leading zeros left out."
  (loop while (and (cdr a) (algebra-constant-zero-p (car a))) do (pop a))
  a)

(defun algebra-euclid-zero-p (a) (equal a '(0)))

(defun algebra-euclid-slope (a)
  "The derivative."
  (or (loop for c in (butlast a)
            for k downfrom (1- (length a))
            collect (algebra-constant-operation #'* #'mul k c))
      (list 0)))

(defun algebra-euclid-division (a b)
  "Two values: quotient and remainder."
  (let ((quotient '()))
    (loop while (>= (length a) (length b))
          do (let ((factor (algebra-constant-quotient (car a) (car b))))
               (push factor quotient)
               (setq a (append (loop for c in (cdr a)
                                     for d in (cdr b)
                                     collect (algebra-constant-less c factor d))
                               (nthcdr (length b) a)))))
    (values (or (nreverse quotient) (list 0))
            (if a (algebra-euclid-trimmed a) (list 0)))))

(defun algebra-euclid-primitive (a)
  "Rational coefficients as integers without a common factor; others as they are."
  (if (or (algebra-euclid-zero-p a) (notevery #'rationalp a))
      a
      (let ((factor (/ (reduce #'lcm (mapcar #'denominator a))
                       (reduce #'gcd (mapcar #'numerator a) :initial-value 0))))
        (mapcar (lambda (c) (* factor c)) a))))

(defun algebra-euclid-remainder (a b)
  (algebra-euclid-primitive (nth-value 1 (algebra-euclid-division a b))))

(defun algebra-euclid-divisor (a b)
  "The greatest common divisor, monic."
  (if (algebra-euclid-zero-p b)
      (mapcar (lambda (c) (algebra-constant-quotient c (car a))) a)
      (algebra-euclid-divisor b (algebra-euclid-remainder a b))))

(defun algebra-euclid-chain (f g)
  "f, g, -rem(f, g), .., each up to a positive factor."
  (if (algebra-euclid-zero-p g)
      (list f)
      (cons f (algebra-euclid-chain
               g (mapcar (lambda (c) (algebra-constant-operation #'- #'neg c))
                         (algebra-euclid-remainder f g))))))

(defun algebra-chain-changes (chain x)
  "Changes of sign in the CHAIN at X: 0, $minf or $inf."
  (algebra-sign-changes
   (loop for f in chain
         collect (case x
                   ($inf (algebra-sign-of-constant (car f)))
                   ($minf (* (if (oddp (length f)) 1 -1) (algebra-sign-of-constant (car f))))
                   (t (algebra-sign-of-constant (car (last f))))))))

;;; Real roots

(defun $algebra_real_root_count (coefficients)
  "How many real numbers are roots: by signs of subresultants, else by a chain of Sturm."
  (let ((a (algebra-euclid-list coefficients)))
    (cond ((null (cdr a)) 0)
          ((and (every #'rationalp a) ($algebra_distinct_real_roots coefficients)))
          (t (algebra-chain-index (algebra-euclid-chain a (algebra-euclid-slope a)))))))

(defun algebra-chain-index (chain)
  (- (algebra-chain-changes chain '$minf) (algebra-chain-changes chain '$inf)))

;;; For Maxima

(defun $algebra_trimmed (a)
  (algebra-euclid-coefficients (algebra-euclid-trimmed (algebra-euclid-list a))))

(defun $algebra_repeated_part (a)
  "The greatest common divisor of a polynomial and its derivative."
  (let ((a (algebra-euclid-list a)))
    (algebra-euclid-coefficients (algebra-euclid-divisor a (algebra-euclid-slope a)))))

(defun $algebra_polynomial_quotient (a b)
  (algebra-euclid-coefficients
   (values (algebra-euclid-division (algebra-euclid-list a) (algebra-euclid-list b)))))

(defun $algebra_polynomial_divisor (a b)
  (algebra-euclid-coefficients
   (algebra-euclid-divisor (algebra-euclid-list a) (algebra-euclid-list b))))

(defun $algebra_cauchy_index (f g)
  "Of g/f from minf to inf."
  (algebra-chain-index (algebra-euclid-chain (algebra-euclid-list f) (algebra-euclid-list g))))

(defun $algebra_negative_root_count (coefficients)
  "How many negative numbers are roots; 0 is none."
  (let* ((a (algebra-euclid-list coefficients))
         (chain (algebra-euclid-chain a (algebra-euclid-slope a))))
    (- (algebra-chain-changes chain '$minf) (algebra-chain-changes chain 0))))
