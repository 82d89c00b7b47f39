;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the derivative of a sign is where its argument vanishes: an impulse. Formulas leave it out;
;;; who must know what is lost binds *algebra-impulses*, and each derivative of a sign has a trace
;;; of it then, an operation of the value 0, in programs and in expressions.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/nouns" "algebra/piece_relations"))

(defvar *algebra-impulses* nil
  "Whether impulses leave a trace: the operation :impulse of programs, algebra-impulse of
expressions.")

(defvar *algebra-sides* nil
  "nil, or a function (operation u): the element of a program for the :impulse, the :sign or the
:absolute value of u, nil for what it is by itself. So elements are taken to a side of a jump.")

(setf (get 'algebra-impulse 'grad) '((x) ((algebra-impulse) x)))

(defun algebra-impulse-at (u)
  "The impulse of a unit step at U, an expression."
  (if *algebra-impulses* (list '(algebra-impulse simp) u) 0))

(defun algebra-with-signs (e)
  "E with signum(u) for u/abs(u), as Maxima differentiates abs(u), and abs(u)/u; and for pieces."
  (cond ((not (algebra-call-p e)) e)
        ((eq (caar e) '$piecewise) (algebra-pieces-with-signs (cdr e)))
        ((eq (caar e) 'mtimes)
         (muln (algebra-factors-with-signs (mapcar #'algebra-with-signs (cdr e))) nil))
        ((member 'array (car e)) e)
        (t (algebra-with-parts e (mapcar #'algebra-with-signs (cdr e))))))

(defun algebra-factors-with-signs (factors)
  "FACTORS with signum(u) for u and 1/abs(u), or for abs(u) and 1/u."
  (dolist (factor factors factors)
    (let* ((below (and (consp factor) (eq (caar factor) 'mexpt) (eql (third factor) -1)
                       (second factor)))
           (absolute (and (consp below) (eq (caar below) 'mabs)))
           (u (if absolute (second below) below))
           (other (and u (find (if absolute u (list '(mabs simp) u)) factors :test #'alike1))))
      (when other
        (return (cons (list '(%signum simp) u)
                      (algebra-factors-with-signs
                       (remove other (remove factor factors :count 1)
                               :test #'alike1 :count 1))))))))

(defun algebra-pieces-with-signs (pieces)
  (or (algebra-pieces-expanded pieces #'algebra-with-signs
                               (lambda (d above below)
                                 (let ((holds (algebra-step-with-sign d)))
                                   (add (mul holds above) (mul (sub 1 holds) below)))))
      (algebra-pieces-in-turn pieces)))

(defun algebra-step-with-sign (d) (div (add 1 (take '(%signum) d)) 2))

(defun algebra-pieces-in-turn (pieces)
  "The sum of the values of PIECES, [condition, value], .., each times 1 where it holds."
  (destructuring-bind ((operator condition value) &rest others) pieces
    (declare (ignore operator))
    (let ((value (algebra-with-signs value)))
      (if (null others)
          value
          (let ((holds (algebra-condition-with-signs condition)))
            (add (mul holds value)
                 (mul (sub 1 holds) (algebra-pieces-in-turn others))))))))

(defun algebra-condition-with-signs (condition)
  "1 where CONDITION holds, else 0, beside jumps."
  (flet ((jump (x y) (algebra-step-with-sign (sub x y)))
         (parts () (mapcar #'algebra-condition-with-signs (cdr condition))))
    (cond ((member condition '(t $otherwise)) 1)
          ((atom condition) 0)
          (t (case (caar condition)
               ((mgreaterp mgeqp) (jump (second condition) (third condition)))
               ((mlessp mleqp) (jump (third condition) (second condition)))
               (mand (muln (parts) nil))
               (mor (sub 1 (muln (mapcar (lambda (part) (sub 1 part)) (parts)) nil)))
               (mnot (sub 1 (car (parts))))
               (t (core-error "~a is no condition" (core-words (list condition)))))))))
