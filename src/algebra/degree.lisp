;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; A bound of the degree of an expression in one name, from its exponents alone: nothing is
;;; expanded.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common"))

(defun $algebra_degree_bound (e x)
  "Not less than the degree of E in X, if it is a polynomial."
  (cond ((eq e x) 1)
        ((atom e) 0)
        ((mplusp e) (reduce #'max (cdr e) :key (lambda (part) ($algebra_degree_bound part x))))
        ((mexptp e) (let ((n (caddr e)))
                      (* (if (typep n '(integer 0)) n 1) ($algebra_degree_bound (cadr e) x))))
        (t (loop for part in (cdr e) sum ($algebra_degree_bound part x)))))
