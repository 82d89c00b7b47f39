;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Straight-line programs from expressions: each operator of an expression by the operations of
;;; program_nodes.lisp; what is no input, number, or sum, product, power or function of such is
;;; refused. Which nodes an output needs, in which order. Branches are sums with factors 0 and 1:
;;; see program_branches.lisp.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/branch_slopes" "algebra/impulses" "algebra/size" "algebra/program_branches"
                "algebra/program_nodes"))

;;; From expressions.

(defun algebra-program-input (expression)
  "The input named EXPRESSION, a symbol or a derivative such as 'diff(q,t)."
  (let ((key (algebra-without-flags expression)))
    (or (gethash key (algebra-program-inputs *algebra-program*))
        (setf (gethash key (algebra-program-inputs *algebra-program*))
              (algebra-new-node :input expression nil)))))

(defun algebra-without-flags (e)
  (if (atom e) e (cons (list (caar e)) (mapcar #'algebra-without-flags (cdr e)))))

(defun algebra-program-element (e)
  "The element for the expression E."
  (cond ((integerp e) e)
        ((floatp e) (rational e))
        ((or (atom e) (algebra-subscripted-p e)) (algebra-program-input e))
        (t (let ((converted (algebra-program-converted *algebra-program*)))
             (or (gethash e converted)
                 (setf (gethash e converted)
                       (algebra-converted-operation e #'algebra-program-element)))))))

(defun algebra-subscripted-p (e) (and (consp e) (member 'array (car e)) t))

(defun algebra-converted-operation (e element)
  "The element for E, ELEMENT giving those of its parts."
  (flet ((part () (funcall element (second e))))
    (case (caar e)
      (rat (/ (second e) (third e)))
      (mplus (algebra-program-sum (mapcar element (cdr e))))
      (mminus (algebra-program-negate (part)))
      (mtimes (algebra-converted-product (cdr e) element))
      (mquotient (algebra-program-divide (part) (funcall element (third e))))
      (mexpt (algebra-converted-power (second e) (third e) element))
      (%sin (algebra-program-sine (part)))
      (%cos (algebra-program-cosine (part)))
      (%tan (algebra-sine-over-cosine (part)))
      (%cot (algebra-program-divide 1 (algebra-sine-over-cosine (part))))
      (%sec (algebra-program-divide 1 (algebra-program-cosine (part))))
      (%csc (algebra-program-divide 1 (algebra-program-sine (part))))
      (%sqrt (algebra-program-root (part)))
      (($atan2 %atan2) (algebra-program-polar-angle (part) (funcall element (third e))))
      ($max (algebra-converted-extreme (mapcar element (cdr e)) 1))
      ($min (algebra-converted-extreme (mapcar element (cdr e)) -1))
      ($unit_step (algebra-program-positive (part)))
      (algebra-impulse (algebra-program-function :impulse (part)))
      ($piecewise (algebra-converted-pieces e element))
      (%derivative (algebra-converted-derivative e element))
      (t (algebra-converted-function e element)))))

(defun algebra-converted-function (e element)
  (let ((row (algebra-function-named (caar e))))
    (if row
        (algebra-program-function (algebra-function-operation row) (funcall element (second e)))
        (algebra-refuse-program e))))

(defun algebra-sine-over-cosine (x)
  (algebra-program-divide (algebra-program-sine x) (algebra-program-cosine x)))

(defun algebra-converted-extreme (elements sign)
  (reduce (lambda (x y) (algebra-program-extreme x y sign)) elements))

(defun algebra-refuse-program (e)
  (core-error "~a has no place in a program, ~
               which adds, multiplies, divides, takes powers and elementary functions~a"
              (core-words (list e))
              (if (char= (char (string (caar e)) 0) #\$)
                  (format nil "; give ~a a formula in laws" (core-spelling (caar e)))
                  "")))

(defun algebra-converted-derivative (e element)
  "An input, or the derivative of a function with branches."
  (let ((carried (algebra-branches-carried e)))
    (if (eq carried e) (algebra-derivative-input e) (funcall element carried))))

(defun algebra-derivative-input (e)
  (if (or (symbolp (second e)) (algebra-subscripted-p (second e)))
      (algebra-program-input e)
      (algebra-refuse-program e)))

(defun algebra-converted-product (factors element)
  "Factors with negative exponents go below one line; u/|u| is the sign of u."
  (let ((above 1) (below 1))
    (dolist (factor (algebra-factors-with-signs factors))
      (if (algebra-below-line-p factor)
          (setq below (algebra-program-multiply
                       below (algebra-converted-power (second factor) (mul -1 (third factor))
                                                      element)))
          (setq above (algebra-program-multiply above (funcall element factor)))))
    (algebra-program-divide above below)))

(defun algebra-below-line-p (e)
  (and (consp e) (eq (caar e) 'mexpt)
       (let ((exponent (algebra-rational-number (third e)))) (and exponent (minusp exponent)))))

(defun algebra-converted-power (base exponent element)
  (if (eq base '$%e)
      (algebra-program-function :exponential (funcall element exponent))
      (algebra-program-general-power (funcall element base) (funcall element exponent))))

;;; Which nodes the outputs need.

(defun algebra-node-parts (node)
  (remove-if-not #'algebra-node-p
                 (if (eq (algebra-node-operation node) :input)
                     nil
                     (list (algebra-node-left node) (algebra-node-right node)))))

(defun algebra-live-nodes (elements)
  "The nodes that ELEMENTS depend on, in an order of computation."
  (let ((alive (make-hash-table)) (waiting (remove-if-not #'algebra-node-p elements)) (found '()))
    (loop while waiting
          do (let ((node (pop waiting)))
               (unless (gethash (algebra-node-index node) alive)
                 (setf (gethash (algebra-node-index node) alive) t)
                 (push node found)
                 (dolist (part (algebra-node-parts node)) (push part waiting)))))
    (sort found #'algebra-in-order-p)))

(defun algebra-input-p (node)
  (eq (algebra-node-operation node) :input))

(defun algebra-rename-inputs (pairs)
  "Inputs are written with the right sides of PAIRS, equations, in place of their left sides."
  (loop for (nil inside outside) in (cdr pairs)
        do (setf (algebra-node-left (algebra-program-input inside)) outside)))
