;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Expressions made fit for numbers: every function that is left open becomes a polynomial of its
;;; own, the same wherever it occurs, and its derivatives that stand as nouns are carried out. What
;;; Maxima cannot carry out, and every integral, stays: noun_value.lisp gives it a value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/exchange"))

(defun forms-open-function-p (operator)
  "True for a function of the user: nothing in Maxima says what it is."
  (and (symbolp operator)
       (char= (char (string operator) 0) #\$)
       (not (member operator '($matrix $piecewise)))
       (not (or (get operator 'operators) (get operator 'grad)
                (mget operator 'mexpr) (fboundp operator)))))

(defun forms-sample-coefficient (name k)
  "A rational number between 1/4 and 5/4 that the NAME of a function and K decide."
  (let ((state (+ 17 k)))
    (loop for character across (string name)
          do (setq state (mod (+ (* 31 state) (char-code character)) 997)))
    (div (+ 250 state) 1000)))

(defun forms-sample-polynomial (name arguments)
  "sum c_k x_k + sum d_k x_k x_(k+1), the last neighbour of x_n being x_1."
  (let ((sum 0))
    (loop for k from 1
          for x in arguments
          for y in (append (cdr arguments) (list (car arguments)))
          do (setq sum (add sum
                            (mul (forms-sample-coefficient name k) x)
                            (mul (forms-sample-coefficient name (- k)) x y))))
    sum))

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
          (t (cond ((forms-open-function-p (caar e)) (forms-sample-polynomial (caar e) parts))
                   ((every #'eq parts (cdr e)) e)
                   (t (simplifya (cons (remove 'simp (car e)) parts) nil))))))))
