;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; A skeleton becomes a quotient (numerator . denominator) of Maxima's polynomials.  First all
;;; kernels get their places in the order of variables, then roots get their radicands. Angles are
;;; sums of multiples of units: which multiples are expanded, and how.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/quotient" "algebra/relations"))

(defun algebra-order-kernels ()
  (algebra-collect-multiples)
  (algebra-number-kernels)
  (dolist (kernel (algebra-ring-kernels *algebra-ring*))
    (when (algebra-kernel-degree kernel)
      (setf (algebra-kernel-radicand kernel)
            (algebra-evaluate (algebra-kernel-radicand kernel))))))

(defun algebra-evaluate (skeleton)
  (cond ((rationalp skeleton) (cons (numerator skeleton) (denominator skeleton)))
        ((algebra-kernel-p skeleton) (cons (algebra-variable skeleton) 1))
        (t (ecase (car skeleton)
             (+ (algebra-sum (mapcar #'algebra-evaluate (cdr skeleton))))
             (* (algebra-product (mapcar #'algebra-evaluate (cdr skeleton))))
             (^ (algebra-power (algebra-evaluate (cadr skeleton)) (caddr skeleton)))
             (cosine (car (algebra-angle (cadr skeleton))))
             (sine (cdr (algebra-angle (cadr skeleton))))
             (power (algebra-exponential (cadr skeleton)))))))

(defun algebra-product (factors)
  (let ((product (cons 1 1)))
    (dolist (factor factors product)
      (algebra-guard-product (car product) (car factor))
      (setq product (algebra-times product factor)))))

(defun algebra-power (base n)
  (when (and (minusp n) (algebra-zero-polynomial-p (car base)))
    (core-error "division by zero"))
  (algebra-guard-power (car base) n)
  (algebra-guard-power (cdr base) n)
  (algebra-to-power base n))

(defun algebra-exponential (terms)
  (algebra-product
   (loop for (factor . unit) in terms
         collect (algebra-to-power (cons (algebra-variable (algebra-unit-cosine unit)) 1)
                                   (* factor (algebra-unit-denominator unit))))))

;;; Which multiples of an angle are expanded: sin(3*q) and sin(q) are polynomials in one pair, but
;;; sin(30*t) is no polynomial of degree 30 in sin(t), cos(t), long and in doubles worth nothing.
;;; A multiple of more than 8 steps is an angle of its own, as are the multiples of a function of t
;;; that have a common divisor.  Where a zero is decided all multiples are expanded.

(defvar *algebra-every-multiple* nil "true: multiples are expanded whatever their length")

(defconstant +algebra-most-steps+ 8)

(defun algebra-least-step (unit)
  "The step from which it stays an angle: sin(2*q) is often met beside sin(q), sin(2*t) is not, nor
sin(2*sin(q))."
  (let ((base (algebra-unit-base unit)))
    (if (and (symbolp base) (not (eq base '$t)))
        (1+ +algebra-most-steps+)
        2)))

(defun algebra-collect-multiples ()
  "Gives each unit of the ring, once all expressions are scanned, its step."
  (unless *algebra-every-multiple*
    (dolist (unit (copy-list (algebra-ring-units *algebra-ring*)))
      (when (algebra-collectable-p unit)
        (algebra-set-apart unit)
        (algebra-set-step unit)))))

(defun algebra-collectable-p (unit)
  "An angle that moves and was not collected before."
  (and (algebra-pair-p unit)
       (algebra-unit-terms unit)
       (null (algebra-unit-cosine unit))
       (not ($constantp (algebra-unit-base unit)))))

(defun algebra-factors (unit)
  (remove-duplicates (mapcar (lambda (term) (abs (car term))) (algebra-unit-terms unit))))

(defun algebra-common-step (factors)
  (let ((d (reduce #'lcm factors :key #'denominator)))
    (/ (reduce #'gcd (mapcar (lambda (f) (* f d)) factors)) d)))

(defun algebra-set-step (unit)
  (let ((step (algebra-common-step (algebra-factors unit))))
    (when (>= (numerator step) (algebra-least-step unit))
      (setf (algebra-unit-denominator unit) (/ step)))))

(defun algebra-set-apart (unit)
  "The largest multiple becomes a unit as long as it has too many steps."
  (loop for factors = (algebra-factors unit)
        for largest = (reduce #'max factors)
        while (> (/ largest (algebra-common-step factors)) +algebra-most-steps+)
        do (algebra-set-multiple-apart unit largest)))

(defun algebra-set-multiple-apart (unit factor)
  (let ((own (algebra-find-unit (mul (numerator factor) (div (algebra-unit-base unit)
                                                             (denominator factor)))
                                (algebra-unit-kind unit))))
    (push (cons factor own) (algebra-unit-apart unit))
    (flet ((apart-p (term) (= factor (abs (car term)))))
      (dolist (term (remove-if-not #'apart-p (algebra-unit-terms unit)))
        (setf (car term) (signum (car term))
              (cdr term) own)
        (push term (algebra-unit-terms own)))
      (setf (algebra-unit-terms unit) (remove own (algebra-unit-terms unit) :key #'cdr)))))

;;; Sums of angles by the theorem of addition, multiples by Chebyshev's polynomials.

(defun algebra-angle (terms)
  "The quotients (cosine . sine) of a sum of angles, by the theorem of addition."
  (let ((first (algebra-term-angle (car terms))))
    (if (null (cdr terms))
        first
        (algebra-add-angles first (algebra-angle (cdr terms)) (algebra-angle-sign (car terms))))))

(defun algebra-angle-sign (term)
  "cos(a+b) = cos(a)*cos(b) + sign*sin(a)*sin(b), hyperbolic or not."
  (if (and (not (eq (car term) 'known)) (eq (algebra-unit-kind (cdr term)) 'hyperbolic)) 1 -1))

(defun algebra-term-angle (term)
  (if (eq (car term) 'known)
      (cons (algebra-evaluate (cadr term)) (algebra-evaluate (caddr term)))
      (algebra-multiple-angle (cdr term)
                              (* (car term) (algebra-unit-denominator (cdr term))))))

(defun algebra-add-angles (a b sign)
  (cons (algebra-plus (algebra-times (car a) (car b))
                      (algebra-times (cons sign 1) (algebra-times (cdr a) (cdr b))))
        (algebra-plus (algebra-times (cdr a) (car b)) (algebra-times (car a) (cdr b)))))

(defparameter *algebra-most-multiple* 500 "The largest multiple of an angle that is expanded.")

(defun algebra-multiple-angle (unit n)
  (let ((cosine (algebra-variable (algebra-unit-cosine unit)))
        (sine (algebra-variable (algebra-unit-sine unit))))
    (cond ((minusp n)
           (let ((positive (algebra-multiple-angle unit (- n))))
             (cons (car positive) (cons (pminus (cadr positive)) (cddr positive)))))
          ((> n (core-sized *algebra-most-multiple*))
           (core-error "sin(~A*u) and sin(u) in one formula: multiples of an angle are expanded ~
                        up to ~A; ~A" n (core-sized *algebra-most-multiple*)
                       (core-size-advice n *algebra-most-multiple*)))
          (t (algebra-chebyshev cosine sine n)))))

(defun algebra-chebyshev (cosine sine n)
  "cos(n u) = T_n(c) and sin(n u) = s U_(n-1)(c); the same recurrence serves cosh and sinh."
  (let ((t0 1) (t1 cosine) (u0 0) (u1 1) (twice (ptimes 2 cosine)))
    (if (zerop n)
        (cons (cons 1 1) (cons 0 1))
        (loop repeat (1- n)
              do (psetq t0 t1
                        t1 (pdifference (ptimes twice t1) t0)
                        u0 u1
                        u1 (pdifference (ptimes twice u1) u0))
              finally (return (cons (cons t1 1) (cons (ptimes sine u1) 1)))))))
