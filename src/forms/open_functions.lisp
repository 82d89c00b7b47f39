;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Expressions made fit for numbers: every function that is left open becomes a polynomial of its
;;; own, the same wherever it occurs, and its derivatives that stand as nouns are carried out. What
;;; Maxima cannot carry out, and every integral, stays: value.lisp gives it a value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/random_numbers" "forms/exchange"))

(defun forms-open-function-p (operator)
  "True for a function of the user: nothing in Maxima says what it is."
  (and (symbolp operator)
       (char= (char (string operator) 0) #\$)
       (not (member operator '($matrix $piecewise $unit_step)))
       (not (or (get operator 'operators) (get operator 'grad)
                (mget operator 'mexpr) (fboundp operator)))))

(defun forms-open-coefficient (name k)
  "The K-th coefficient of the polynomial for the function NAME."
  (algebra-random-number (format nil "~a~d" name k)))

(defun forms-open-polynomial (name arguments)
  "sum c_k x_k + sum c_-k x_k x_(k+1), the last neighbour of x_n being x_1."
  (flet ((coefficient (k)
           (let ((c (forms-open-coefficient name k))) (div (numerator c) (denominator c)))))
    (addn (loop for k from 1
                for x in arguments
                for y in (append (cdr arguments) (list (car arguments)))
                collect (mul (coefficient k) x)
                collect (mul (coefficient (- k)) x y))
          nil)))

(defparameter *forms-order* 6 "The highest order of a derivative that is carried out for a check.")

(defun forms-low-order-p (parts)
  "Whether the derivative (f x n y m ..) is of an order at which it cannot grow much."
  (loop for (nil order) on (cdr parts) by #'cddr
        always (or (null order) (not (integerp order)) (<= order *forms-order*))))

(defun $forms_closed (e)
  "E with polynomials for its open functions."
  (if (or (atom e) (member 'array (car e)) (forms-derivative-p e))
      e
      (let ((parts (mapcar #'$forms_closed (cdr e))))
        (case (caar e)
          (%derivative (if (forms-low-order-p parts)
                           (apply #'$diff parts)
                           (cons '(%derivative simp) parts)))
          (%at (apply #'$at parts))
          (t (cond ((forms-open-function-p (caar e)) (forms-open-polynomial (caar e) parts))
                   ((every #'eq parts (cdr e)) e)
                   (t (simplifya (cons (remove 'simp (car e)) parts) nil))))))))
