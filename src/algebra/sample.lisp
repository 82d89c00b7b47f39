;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Expressions at random points modulo a prime, nothing expanded: rational points of the circle
;;; for the angles, any numbers for independent kernels.  A value that is not zero proves that
;;; the expression is not zero; values that vanish at two points make a check, not a proof.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/scan" "algebra/evaluate" "algebra/modular"))

(defun $algebra_vanishes (e)
  "true: at two random points; false: surely not zero; unknown: roots or other bound kernels."
  (cond ((mequalp e) (algebra-vanishing-sample (sub (cadr e) (caddr e))))
        ((mbagp e) (algebra-worst-answer (mapcar #'$algebra_vanishes (cdr e))))
        (t (algebra-vanishing-sample e))))

(defun algebra-worst-answer (answers)
  (cond ((member nil answers) nil)
        ((member '$unknown answers) '$unknown)
        (t t)))

(defun algebra-vanishing-sample (e)
  (with-algebra-ring
    (let* ((*algebra-exponential-form* t)
           (*algebra-roots-apart* t)
           (*algebra-every-multiple* t)
           (skeleton (algebra-scan e)))
      (algebra-number-kernels)
      (algebra-sampled-zero skeleton))))

(defun algebra-sampled-zero (skeleton)
  "The answer for a skeleton in the ring at hand."
  (let ((samples (loop for seed in '(20011 70001)
                       collect (algebra-sample skeleton (algebra-modular-point seed)))))
    (cond ((member nil samples) '$unknown)
          ((some #'plusp samples) nil)
          (t t))))

(defun algebra-sample (skeleton point)
  "The value modulo the prime; nil if a kernel is not independent or a denominator vanishes."
  (if (every #'algebra-kernel-sure (algebra-ring-kernels *algebra-ring*))
      (catch 'no-sample (algebra-sampled skeleton point))))

(defun algebra-sampled (skeleton point)
  (cond ((integerp skeleton) (mod skeleton (algebra-prime)))
        ((rationalp skeleton)
         (algebra-modulo (* (mod (numerator skeleton) (algebra-prime))
                            (algebra-sampled-inverse (denominator skeleton)))))
        ((algebra-kernel-p skeleton) (gethash (algebra-kernel-variable skeleton) point))
        (t (ecase (car skeleton)
             (+ (algebra-sampled-sum (cdr skeleton) point))
             (* (algebra-sampled-product (cdr skeleton) point))
             (^ (algebra-sampled-power (algebra-sampled (cadr skeleton) point) (caddr skeleton)))
             (cosine (car (algebra-sampled-angle (cadr skeleton) point)))
             (sine (cdr (algebra-sampled-angle (cadr skeleton) point)))
             (power (algebra-sampled-exponential (cadr skeleton) point))))))

(defun algebra-sampled-sum (parts point)
  (let ((sum 0))
    (declare (fixnum sum))
    (dolist (part parts sum)
      (setq sum (algebra-modulo (+ sum (the fixnum (algebra-sampled part point))))))))

(defun algebra-sampled-product (parts point)
  (let ((product 1))
    (declare (fixnum product))
    (dolist (part parts product)
      (setq product (algebra-modulo (* product (the fixnum (algebra-sampled part point))))))))

(defun algebra-sampled-inverse (a)
  (if (zerop (mod a (algebra-prime)))
      (throw 'no-sample nil)
      (algebra-modular-inverse a)))

(defun algebra-sampled-power (base n)
  (if (minusp n)
      (algebra-sampled-power (algebra-sampled-inverse base) (- n))
      (algebra-modular-power base n)))

(defun algebra-sampled-angle (terms point)
  "(cosine . sine) of a sum of angles."
  (let ((first (algebra-sampled-term (car terms) point)))
    (if (null (cdr terms))
        first
        (algebra-sampled-turn first (algebra-sampled-angle (cdr terms) point)
                              (algebra-angle-sign (car terms))))))

(defun algebra-sampled-turn (a b sign)
  (cons (algebra-modulo (+ (algebra-modulo (* (car a) (car b)))
                           (* sign (algebra-modulo (* (cdr a) (cdr b))))))
        (algebra-modulo (+ (algebra-modulo (* (cdr a) (car b)))
                           (algebra-modulo (* (car a) (cdr b)))))))

(defun algebra-sampled-term (term point)
  (if (eq (car term) 'known)
      (cons (algebra-sampled (cadr term) point) (algebra-sampled (caddr term) point))
      (let* ((unit (cdr term))
             (n (* (car term) (algebra-unit-denominator unit)))
             (c (gethash (algebra-kernel-variable (algebra-unit-cosine unit)) point))
             (s (gethash (algebra-kernel-variable (algebra-unit-sine unit)) point))
             (step (cons c (if (minusp n) (mod (- s) (algebra-prime)) s)))
             (angle (cons 1 0)))
        (loop repeat (abs n)
              do (setq angle (algebra-sampled-turn angle step (algebra-angle-sign term))))
        angle)))

(defun algebra-sampled-exponential (terms point)
  (let ((product 1))
    (loop for (factor . unit) in terms
          for value = (gethash (algebra-kernel-variable (algebra-unit-cosine unit)) point)
          do (setq product
                   (algebra-modulo
                    (* product (algebra-sampled-power
                                value (* factor (algebra-unit-denominator unit)))))))
    product))
