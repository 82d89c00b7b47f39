;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions as Maxima simplifies them, for text that nobody vouches for: abs, signum, max, min by
;;; signs that the form of an expression shows, roots and exponentials as powers, all others by
;;; Maxima, where it finds a value. Look first at archive-function-value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/plain_simplifier" "archive/simplify"))

(defun archive-function-value (operator arguments)
  "The function of Maxima's name OPERATOR at simplified ARGUMENTS."
  (case operator
    (%sqrt (archive-power (car arguments) '((rat simp) 1 2)))
    (%exp (archive-power '$%e (car arguments)))
    (mabs (archive-absolute-value (car arguments)))
    (%signum (archive-signum (car arguments)))
    (($max $min) (archive-extremum operator arguments))
    ($atan2 (archive-atan2 arguments))
    (%log (archive-logarithm (car arguments)))
    (t (if (some #'floatp arguments)
           (archive-inert operator arguments)
           (archive-attempted (list* (list operator) arguments))))))

(defun archive-attempted (form)
  "FORM simplified; where Maxima finds no value (cot(0)) an error with its place."
  (let ((value (core-attempt (lambda () (archive-simplified form)))))
    (if value
        (car value)
        (archive-refuse "a function has no value here"))))

(defun archive-absolute-value (e)
  (case (archive-plain-sign e)
    (($pos $pz $zero) e)
    ($neg (archive-negative e))
    (t (archive-inert 'mabs (list (archive-without-sign e))))))

(defun archive-without-sign (e)
  "E or -E, the one that a person would write."
  (if (and (mtimesp e) (mnegp (cadr e))) (archive-negative e) e))

(defun archive-signum (e)
  (case (archive-plain-sign e)
    ($pos 1)
    ($neg -1)
    ($zero e)
    (t (archive-inert '%signum (list e)))))

(defun archive-extremum (operator arguments)
  (if (every #'mnump arguments)
      (reduce (lambda (a b)
                (if (eq (archive-number-sign (addk a (timesk -1 b)))
                        (if (eq operator '$max) '$neg '$pos)) b a))
              arguments)
      (archive-inert operator arguments)))

(defun archive-atan2 (arguments)
  (when (every #'zerop1 arguments) (archive-refuse "atan2(0, 0) has no value"))
  (if (and (every #'mnump arguments) (every #'archive-modest-p arguments)
           (notany #'floatp arguments))
      (archive-attempted (list* '($atan2) arguments))
      (archive-inert '$atan2 arguments)))

(defun archive-logarithm (e)
  (cond ((zerop1 e) (archive-refuse "log(0) has no value"))
        ((floatp e) (archive-inert '%log (list e)))
        (t (archive-attempted (list '(%log) e)))))
