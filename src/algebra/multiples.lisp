;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Which multiples of an angle are expanded: sin(3*q) and sin(q) are polynomials in one pair, but
;;; sin(30*t) is no polynomial of degree 30 in sin(t), cos(t), long and in doubles worth nothing.
;;; A multiple of more than 8 steps is an angle of its own, as are the multiples of a function of t
;;; that have a common divisor.  Where a zero is decided all multiples are expanded.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels"))

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
