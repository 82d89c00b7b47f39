;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Divisors that are 0 by what is assumed, equal(m, 0) or equal(a*b, 1): what a derivation takes
;;; and what it gives is looked at where an equality is assumed, and refused by name. Of a program
;;; each assignment z2 = 1/z1 is looked at with the values of the names before it.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/nouns" "algebra/sign"
                "algebra/sign_by_bounds"))

(defparameter *algebra-divisor-size* 200 "Longer divisors are not looked at.")

(defun algebra-require-divisors (e)
  "An error where a power with a negative exponent in E has a base that is 0 by what is assumed."
  (cond ((not (algebra-call-p e)))
        ((and (mequalp e) (eq (cadr e) '$assignments) ($listp (caddr e)))
         (algebra-require-assignments (cdr (caddr e))))
        ((and (mexptp e) (algebra-negative-number-p (caddr e)))
         (algebra-require-divisor (cadr e))
         (algebra-require-divisors (cadr e)))
        (t (mapc #'algebra-require-divisors (cdr e)))))

(defun algebra-negative-number-p (e)
  (let ((number (algebra-rational-number e)))
    (and number (minusp number))))

(defun algebra-require-divisor (base)
  (when (and (< (algebra-size base) *algebra-divisor-size*)
             (some (lambda (name) (among name base))
                   (algebra-names-of (cons '(mlist) (core-zeros))))
             (eq ($algebra_sign base) '$zero))
    (core-error "~A has no value where ~A, which is assumed"
                (algebra-short-text (power base -1))
                (algebra-short-text (list '(mequal) base 0)))))

(defun algebra-require-assignments (assignments)
  "The same for [name = value, ..], values by names before them; a long value stays a name."
  (let ((known '()))
    (dolist (assignment assignments)
      (let ((value (algebra-in-known-names (caddr assignment) known)))
        (algebra-require-divisors value)
        (when (< (algebra-size value) *algebra-divisor-size*)
          (push (cons (cadr assignment) value) known))))))

(defun algebra-in-known-names (e known)
  (cond ((symbolp e) (or (cdr (assoc e known)) e))
        ((algebra-call-p e)
         (algebra-with-parts e (loop for part in (cdr e)
                                     collect (algebra-in-known-names part known))))
        (t e)))
