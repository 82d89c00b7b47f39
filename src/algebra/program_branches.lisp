;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions with branches in programs, which have no jumps: piecewise([c_1, v_1], ..) is
;;;     (s_1 v_1 + (1 - s_1)(s_2 v_2 + ..)) / s,
;;; s_k being 1 where the condition c_k holds and else 0, s 1 where one of them does: the quotient
;;; has no value where none does; or as algebra/piece_relations.lisp has it. Every branch is
;;; computed everywhere, so what may have no finite value where another branch holds has no place
;;; here. See algebra-converted-pieces first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/piece_relations" "algebra/program_nodes"))

(defun algebra-program-positive (x)
  "1 where X is greater than 0, else 0."
  (let ((sign (algebra-program-function :sign x)))
    (algebra-program-multiply
     1/2 (algebra-program-add sign (algebra-program-function :absolute sign)))))

(defun algebra-program-not (x) (algebra-program-subtract 1 x))

(defun algebra-converted-condition (e element)
  "1 where the condition E holds, else 0; ELEMENT gives the elements of expressions."
  (flet ((difference (x y) (algebra-program-subtract (funcall element x) (funcall element y)))
         (part (e) (algebra-converted-condition e element)))
    (cond ((member e '(t $otherwise)) 1)
          ((null e) 0)
          ((atom e) (core-error "~a is no condition" (core-words (list e))))
          (t (destructuring-bind (x &optional y) (if (cdddr e) (list (second e)) (cdr e))
               (case (caar e)
                 (mgreaterp (algebra-program-positive (difference x y)))
                 (mlessp (algebra-program-positive (difference y x)))
                 (mgeqp (algebra-program-not (algebra-program-positive (difference y x))))
                 (mleqp (algebra-program-not (algebra-program-positive (difference x y))))
                 (mand (reduce #'algebra-program-multiply (mapcar #'part (cdr e))))
                 (mor (algebra-program-not
                       (reduce #'algebra-program-multiply
                               (mapcar (lambda (e) (algebra-program-not (part e))) (cdr e)))))
                 (mnot (algebra-program-not (part x)))
                 (t (core-error "~a has no place in a program" (core-words (list e))))))))))

(defun algebra-converted-pieces (e element)
  (or (algebra-pieces-expanded (cdr e)
                               (lambda (value)
                                 (let ((branch (funcall element value)))
                                   (algebra-check-branch branch e)
                                   branch))
                               (lambda (d above below)
                                 (algebra-program-choice (funcall element d) above below)))
      (algebra-converted-in-turn e element)))

(defun algebra-program-choice (d above below)
  "ABOVE where D is greater than 0, else BELOW."
  (let ((holds (algebra-program-positive d)))
    (if (eql above below)
        above
        (algebra-program-add
         (algebra-program-multiply holds above)
         (algebra-program-multiply (algebra-program-not holds) below)))))

(defun algebra-converted-in-turn (e element)
  (let ((sum 0) (none 1))
    (loop for (nil condition value) in (cdr e)
          for holds = (algebra-converted-condition condition element)
          for branch = (funcall element value)
          do (algebra-check-branch branch e)
             (setq sum (algebra-program-add
                        sum (algebra-program-multiply (algebra-program-multiply none holds) branch))
                   none (algebra-program-multiply none (algebra-program-not holds))))
    (if (eql none 0) sum (algebra-program-divide sum (algebra-program-not none)))))

(defparameter *algebra-partial-operations*
  '(:divide :root :logarithm :arcsine :arccosine :power :exponential :hyperbolic-sine
    :hyperbolic-cosine)
  "Operations whose values are not finite everywhere.")

(defun algebra-check-branch (branch e)
  "An error where BRANCH of E may have no finite value where another one holds."
  (let ((waiting (list branch)) (seen (make-hash-table :test #'eq)))
    (loop while waiting
          do (let ((node (pop waiting)))
               (when (and (algebra-node-p node) (not (gethash node seen)))
                 (setf (gethash node seen) t)
                 (when (member (algebra-node-operation node) *algebra-partial-operations*)
                   (core-error "~a has no place in a program: each of its branches is computed ~
                                everywhere, and one may have no finite value where another holds"
                               (core-words (list e))))
                 (unless (eq (algebra-node-operation node) :input)
                   (push (algebra-node-left node) waiting)
                   (push (algebra-node-right node) waiting)))))))
