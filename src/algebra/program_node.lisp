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
