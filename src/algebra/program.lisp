;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Straight-line programs, built while a formula is derived. An element is an exact constant (a
;;; rational number of Lisp) or a node: an operation on elements, or an input. Equal operations on
;;; equal elements are one node (hash consing), so that what is shared is computed once; a node is
;;; younger than its parts, so that the order of birth is an order of computation.
;;; The rules are x*0, x*1, x + 0, constants among themselves, signs and factors drawn outwards, one
;;; order of commutative parts. See algebra-program-add first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common"))

(defstruct algebra-node operation left right index)

(defstruct algebra-program
  (table (make-hash-table :test #'equal)) ; (operation part part) -> node
  (inputs (make-hash-table :test #'equal)) ; name of an input -> node
  (converted (make-hash-table :test #'eq)) ; expression -> element
  (count 0))

(defvar *algebra-program* nil "The program that is being built.")

(defmacro with-algebra-program (&body body)
  `(let ((*algebra-program* (make-algebra-program))) ,@body))

(defun algebra-part-key (element)
  (if (algebra-node-p element) (algebra-node-index element) (list element)))

(defun algebra-known-node (operation left right)
  (gethash (list operation (algebra-part-key left) (algebra-part-key right))
           (algebra-program-table *algebra-program*)))

(defun algebra-new-node (operation left right)
  (make-algebra-node :operation operation :left left :right right
                     :index (incf (algebra-program-count *algebra-program*))))

(defun algebra-make-node (operation left &optional (right 0))
  (or (algebra-known-node operation left right)
      (setf (gethash (list operation (algebra-part-key left) (algebra-part-key right))
                     (algebra-program-table *algebra-program*))
            (algebra-new-node operation left right))))

(defun algebra-operation-p (operation element)
  (and (algebra-node-p element) (eq (algebra-node-operation element) operation)))

(defun algebra-scaled-p (element)
  "Whether ELEMENT is a constant times something."
  (and (algebra-operation-p :multiply element) (numberp (algebra-node-left element))))

(defun algebra-in-order-p (x y)
  (< (algebra-node-index x) (algebra-node-index y)))

;;; Arithmetic.

(defun algebra-program-negate (x)
  (cond ((numberp x) (- x))
        ((algebra-operation-p :negate x) (algebra-node-left x))
        ((algebra-operation-p :subtract x)
         (algebra-program-subtract (algebra-node-right x) (algebra-node-left x)))
        ((algebra-scaled-p x)
         (algebra-program-multiply (- (algebra-node-left x)) (algebra-node-right x)))
        (t (algebra-make-node :negate x))))

(defun algebra-program-add (x y)
  (cond ((numberp y) (if (numberp x) (+ x y) (algebra-program-add y x)))
        ((eql x 0) y)
        ((algebra-operation-p :negate y) (algebra-program-subtract x (algebra-node-left y)))
        ((algebra-operation-p :negate x) (algebra-program-subtract y (algebra-node-left x)))
        ((eq x y) (algebra-program-multiply 2 x))
        ((or (numberp x) (algebra-in-order-p x y)) (algebra-make-node :add x y))
        (t (algebra-make-node :add y x))))

(defun algebra-program-subtract (x y)
  (cond ((and (numberp x) (numberp y)) (- x y))
        ((numberp y) (algebra-program-add (- y) x))
        ((eql x 0) (algebra-program-negate y))
        ((eq x y) 0)
        ((algebra-operation-p :negate y) (algebra-program-add x (algebra-node-left y)))
        ((algebra-operation-p :negate x)
         (algebra-program-negate (algebra-program-add (algebra-node-left x) y)))
        ((algebra-known-node :subtract y x)
         (algebra-make-node :negate (algebra-known-node :subtract y x)))
        (t (algebra-make-node :subtract x y))))

(defun algebra-program-multiply (x y)
  (cond ((numberp y) (if (numberp x) (* x y) (algebra-program-multiply y x)))
        ((eql x 0) 0)
        ((eql x 1) y)
        ((eql x -1) (if (algebra-scaled-p y)
                        (algebra-program-multiply (- (algebra-node-left y)) (algebra-node-right y))
                        (algebra-program-negate y)))
        ((algebra-operation-p :negate y)
         (algebra-program-negate (algebra-program-multiply x (algebra-node-left y))))
        ((algebra-operation-p :negate x)
         (algebra-program-negate (algebra-program-multiply (algebra-node-left x) y)))
        ((and (numberp x) (algebra-scaled-p y))
         (algebra-program-multiply (* x (algebra-node-left y)) (algebra-node-right y)))
        ((numberp x) (algebra-make-node :multiply x y))
        ((algebra-scaled-p y)
         (algebra-program-multiply (algebra-node-left y)
                                   (algebra-program-multiply x (algebra-node-right y))))
        ((algebra-scaled-p x)
         (algebra-program-multiply (algebra-node-left x)
                                   (algebra-program-multiply (algebra-node-right x) y)))
        ((algebra-in-order-p x y) (algebra-make-node :multiply x y))
        (t (algebra-make-node :multiply y x))))

(defun algebra-program-divide (x y)
  (cond ((eql y 0) (core-error "a program divides by zero"))
        ((numberp y) (algebra-program-multiply (/ y) x))
        ((eql x 0) 0)
        ((eq x y) 1)
        ((algebra-operation-p :negate y)
         (algebra-program-negate (algebra-program-divide x (algebra-node-left y))))
        ((algebra-operation-p :negate x)
         (algebra-program-negate (algebra-program-divide (algebra-node-left x) y)))
        (t (algebra-make-node :divide x y))))

(defun algebra-program-sine (x)
  (cond ((eql x 0) 0)
        ((algebra-operation-p :negate x)
         (algebra-program-negate (algebra-program-sine (algebra-node-left x))))
        (t (algebra-make-node :sine x))))

(defun algebra-program-cosine (x)
  (cond ((eql x 0) 1)
        ((algebra-operation-p :negate x) (algebra-program-cosine (algebra-node-left x)))
        (t (algebra-make-node :cosine x))))

(defun algebra-program-root (x)
  (if (or (eql x 0) (eql x 1)) x (algebra-make-node :root x)))

(defun algebra-program-power (x n)
  "X to the whole power N."
  (cond ((minusp n) (algebra-program-divide 1 (algebra-program-power x (- n))))
        ((= n 0) 1)
        ((= n 1) x)
        ((evenp n)
         (let ((half (algebra-program-power x (/ n 2))))
           (algebra-program-multiply half half)))
        (t (algebra-program-multiply x (algebra-program-power x (1- n))))))

(defun algebra-program-sum (elements)
  (reduce #'algebra-program-add elements :initial-value 0))

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
        ((atom e) (algebra-program-input e))
        (t (let ((converted (algebra-program-converted *algebra-program*)))
             (or (gethash e converted)
                 (setf (gethash e converted)
                       (algebra-converted-operation e #'algebra-program-element)))))))

(defun algebra-converted-operation (e element)
  "The element for E, ELEMENT giving those of its parts."
  (flet ((part () (funcall element (second e))))
    (case (caar e)
      (rat (/ (second e) (third e)))
      (mplus (algebra-program-sum (mapcar element (cdr e))))
      (mminus (algebra-program-negate (part)))
      (mtimes (algebra-converted-product (cdr e) element))
      (mquotient (algebra-program-divide (part) (funcall element (third e))))
      (mexpt (algebra-converted-power (part) (third e) e))
      (%sin (algebra-program-sine (part)))
      (%cos (algebra-program-cosine (part)))
      (%tan (algebra-sine-over-cosine (part)))
      (%cot (algebra-program-divide 1 (algebra-sine-over-cosine (part))))
      (%sec (algebra-program-divide 1 (algebra-program-cosine (part))))
      (%csc (algebra-program-divide 1 (algebra-program-sine (part))))
      (%sqrt (algebra-program-root (part)))
      (%derivative (algebra-derivative-input e))
      (t (algebra-refuse-program e)))))

(defun algebra-sine-over-cosine (x)
  (algebra-program-divide (algebra-program-sine x) (algebra-program-cosine x)))

(defun algebra-refuse-program (e)
  (core-error "~a has no place in a program, which adds, multiplies, divides and takes sine, cosine and square root"
              (mfuncall '$string e)))

(defun algebra-derivative-input (e)
  (if (symbolp (second e)) (algebra-program-input e) (algebra-refuse-program e)))

(defun algebra-converted-product (factors element)
  "Factors with negative exponents go below one line."
  (let ((above 1) (below 1))
    (dolist (factor factors)
      (if (algebra-below-line-p factor)
          (setq below (algebra-program-multiply
                       below (algebra-converted-power (funcall element (second factor))
                                                      (mul -1 (third factor)) factor)))
          (setq above (algebra-program-multiply above (funcall element factor)))))
    (algebra-program-divide above below)))

(defun algebra-below-line-p (e)
  (and (consp e) (eq (caar e) 'mexpt)
       (let ((exponent (algebra-rational-number (third e)))) (and exponent (minusp exponent)))))

(defun algebra-converted-power (base exponent e)
  (cond ((integerp exponent) (algebra-program-power base exponent))
        ((and (consp exponent) (eq (caar exponent) 'rat) (= (third exponent) 2))
         (algebra-program-power (algebra-program-root base) (second exponent)))
        (t (algebra-refuse-program e))))

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

(defun algebra-operation-count (elements)
  (count-if-not #'algebra-input-p (algebra-live-nodes elements)))

(defun algebra-rename-inputs (pairs)
  "Inputs are written with the right sides of PAIRS, equations, in place of their left sides."
  (loop for (nil inside outside) in (cdr pairs)
        do (setf (algebra-node-left (algebra-program-input inside)) outside)))
