;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; What all of the algebra uses: exact numbers, the least of several forms, Maxima's functions
;;; asked without consequences, and the words for what lies outside.

(in-package :maxima)

(defun algebra-rational-number (e)
  (cond ((rationalp e) e)
        ((ratnump e) (/ (cadr e) (caddr e)))))

(defun algebra-maxima-rational (r)
  "The rational R as Maxima holds it."
  (if (integerp r) r (list '(rat simp) (numerator r) (denominator r))))

(defun algebra-without-fractions (numbers)
  "Rational NUMBERS of Lisp times their least common denominator."
  (let ((denominator (reduce #'lcm numbers :key #'denominator :initial-value 1)))
    (mapcar (lambda (x) (* x denominator)) numbers)))

(defun algebra-prime-factors (n)
  "(prime power prime power ..); a large N counts as one prime."
  (cond ((= n 1) nil)
        ((< n (expt 10 14)) (cfactorw n))
        (t (list n 1))))

(defun algebra-golden-ratio ()
  (mul '((rat simp) 1 2) (add 1 (power 5 '((rat simp) 1 2)))))

(defun algebra-least (items measure)
  (let ((least (car items)) (smallest (funcall measure (car items))))
    (dolist (item (cdr items) least)
      (let ((size (funcall measure item)))
        (when (< size smallest) (setq least item smallest size))))))

(defun algebra-quietly (function)
  "The value of FUNCTION, nil if Maxima signals an error; questions are errors, too."
  (let ((errcatch t) ($errormsg nil) (*mdebug* nil))
    (declare (special errcatch $errormsg *mdebug*))
    (car (errset (funcall function)))))

(defun algebra-outside (e)
  (core-error "a formula was expected, found ~A" (algebra-short-text e)))

(defun algebra-decimal (e)
  (core-error "the decimal ~A came into exact mathematics; type a fraction" (algebra-short-text e)))

(defun algebra-short-text (e)
  (core-cut (coerce (mstring e) 'string)))
