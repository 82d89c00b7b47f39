;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the recursion over bodies computes with. An arithmetic says how numbers and parameters are taken in (lift), added,
;;; multiplied and given back (lower), and what sine and cosine of an angle are; the recursion is written once over it.
;;; Here: general expressions, left as products and sums of short factors; and counts of terms, which foretell their size.

(in-package :maxima)

(defstruct linmodel-arithmetic lift lower add multiply sine cosine)

(defun linmodel-general-arithmetic ()
  "Maxima's general expressions, nothing multiplied out."
  (make-linmodel-arithmetic
   :lift #'identity
   :lower #'identity
   :add (lambda (x y) (add x y))
   :multiply (lambda (x y) (mul x y))
   :sine (lambda (angle) (simplify (list '(%sin) angle)))
   :cosine (lambda (angle) (simplify (list '(%cos) angle)))))

(defun linmodel-terms-of (e)
  (cond ((eql e 0) 0)
        ((atom e) 1)
        ((eq (caar e) 'mplus) (reduce #'+ (mapcar #'linmodel-terms-of (cdr e))))
        ((eq (caar e) 'mtimes) (reduce #'* (mapcar #'linmodel-terms-of (cdr e))))
        (t 1)))

(defun linmodel-angle-terms (angle)
  "sin(a+b) has two terms when written in the angles a and b."
  (expt 2 (max 0 (1- (linmodel-terms-of angle)))))

(defun linmodel-counting-arithmetic ()
  "Upper bounds for the number of terms of the multiplied-out expression."
  (make-linmodel-arithmetic
   :lift #'linmodel-terms-of
   :lower #'identity
   :add #'+
   :multiply #'*
   :sine #'linmodel-angle-terms
   :cosine #'linmodel-angle-terms))

(defun linmodel-arithmetic-named (name)
  (ecase name
    ($general (linmodel-general-arithmetic))
    ($terms (linmodel-counting-arithmetic))))

;;; Vectors are lists of three elements.

(defun linmodel-lift-vector (a vector)
  (mapcar (linmodel-arithmetic-lift a) (cdr vector)))

(defun linmodel-lower-vector (a vector)
  (cons '(mlist simp) (mapcar (linmodel-arithmetic-lower a) vector)))

(defun linmodel-plus (a x y)
  (cond ((eql x 0) y)
        ((eql y 0) x)
        (t (funcall (linmodel-arithmetic-add a) x y))))

(defun linmodel-times (a x y)
  (if (or (eql x 0) (eql y 0)) 0 (funcall (linmodel-arithmetic-multiply a) x y)))

(defun linmodel-minus (a x)
  (linmodel-times a (funcall (linmodel-arithmetic-lift a) -1) x))

(defun linmodel-vector-plus (a u v)
  (mapcar (lambda (x y) (linmodel-plus a x y)) u v))

(defun linmodel-scaled (a factor v)
  (mapcar (lambda (x) (linmodel-times a factor x)) v))

(defun linmodel-dot (a u v)
  (let ((sum 0))
    (mapc (lambda (x y) (setq sum (linmodel-plus a sum (linmodel-times a x y)))) u v)
    sum))

(defun linmodel-cross (a u v)
  (destructuring-bind (u1 u2 u3) u
    (destructuring-bind (v1 v2 v3) v
      (flet ((minor (x y z w)
               (linmodel-plus a (linmodel-times a x w) (linmodel-minus a (linmodel-times a y z)))))
        (list (minor u2 u3 v2 v3) (minor u3 u1 v3 v1) (minor u1 u2 v1 v2))))))

(defun linmodel-matrix-times (a rows v)
  (mapcar (lambda (row) (linmodel-dot a row v)) rows))
