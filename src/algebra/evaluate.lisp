;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; A skeleton becomes a quotient (numerator . denominator) of Maxima's polynomials.  First all
;;; kernels get their places in the order of variables, then roots get their radicands.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/multiples" "algebra/quotient"
                "algebra/reduction"))

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
