;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Powers of sines as polynomials in cosines and at most one sine: products of functions of angles
;;; that differ are independent then.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/exchange"))

(defun forms-sine-power-p (e)
  (and (mexptp e) (integerp (third e)) (> (third e) 1)
       (consp (second e)) (eq (caar (second e)) '%sin)))

(defun forms-sine-powers (e found)
  "The different sin(u)^k, k > 1, in E and in FOUND."
  (cond ((atom e) found)
        ((forms-sine-power-p e) (if (member e found :test #'alike1) found (cons e found)))
        (t (dolist (part (cdr e) found)
             (setq found (forms-sine-powers part found))))))

(defun forms-in-cosines (power)
  "sin(u)^k = (1 - cos(u)^2)^(k/2), times sin(u) for an odd k."
  (destructuring-bind (sine k) (cdr power)
    (mul (power (sub 1 (power (take '(%cos) (second sine)) 2)) (floor k 2))
         (if (oddp k) sine 1))))

(defun $forms_without_sine_powers (e)
  (let ((powers (forms-sine-powers e '())))
    (if powers
        ($forms_exchange e (cons '(mlist simp)
                                 (loop for power in powers
                                       collect (list '(mequal simp) power
                                                     (forms-in-cosines power)))))
        e)))
