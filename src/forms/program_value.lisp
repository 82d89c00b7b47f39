;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of programs to 512 binary digits, at the points of value.lisp: each node once.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "forms/noun_value"))

(defun forms-program-values (elements point)
  "The values of ELEMENTS; where one is divided by nothing, forms-no-value is thrown."
  (let ((values (make-hash-table)))
    (flet ((value (element)
             (if (algebra-node-p element)
                 (gethash (algebra-node-index element) values)
                 (forms-fixed element))))
      (dolist (node (algebra-live-nodes elements))
        (setf (gethash (algebra-node-index node) values) (forms-node-value node #'value point)))
      (mapcar #'value elements))))

(defun forms-node-value (node value point)
  (let ((left (algebra-node-left node)) (right (algebra-node-right node)))
    (flet ((x () (funcall value left)) (y () (funcall value right)))
      (case (algebra-node-operation node)
        (:input (forms-fixed-value left point))
        (:add (+ (x) (y)))
        (:subtract (- (x) (y)))
        (:negate (- (x)))
        (:multiply (if (integerp left) (* left (y)) (forms-fixed-times (x) (y))))
        (:divide (forms-fixed-quotient (x) (y)))
        (:sine (forms-function-value '((%sin)) (list (x)) point))
        (:cosine (forms-function-value '((%cos)) (list (x)) point))
        (:root (forms-fixed-root (x)))
        (t (forms-node-function node #'x #'y point))))))

(defun forms-fixed-quotient (x y)
  "X/Y, Y being more than what is left of 0 by rounding."
  (if (< (integer-length y) (floor forms-digits 4))
      (forms-no-value y)
      (floor (ash x forms-digits) y)))

(defun forms-fixed-root (x)
  (if (minusp x) (forms-no-value x) (isqrt (ash x forms-digits))))

(defun forms-node-function (node x y point)
  (let ((operation (algebra-node-operation node)))
    (flet ((value (operator &rest arguments)
             (forms-function-value (list (list operator)) arguments point)))
      (case operation
        (:exponential (value 'mexpt (forms-symbol-value '$%e point) (funcall x)))
        (:power (value 'mexpt (funcall x) (funcall y)))
        (:polar-angle (value '$atan2 (funcall x) (funcall y)))
        (:absolute (abs (funcall x)))
        (:sign (ash (signum (funcall x)) forms-digits))
        (t (value (algebra-function-operator (algebra-function-of operation)) (funcall x)))))))
