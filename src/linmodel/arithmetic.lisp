;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the recursion over bodies computes with. An arithmetic says how expressions are taken in
;;; (lift) and given back (lower), how its elements are added and multiplied, what sine and cosine
;;; of an angle are, and how long an element is (size, 0 where nothing is multiplied out); zero is
;;; 0 in each of them. The recursion is written once and runs on general expressions, left as sums
;;; of products of short factors (factored), on the canonical form, and, before that, on an
;;; arithmetic that only meets the kernels. See linmodel-compute first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "algebra/shortest_forms" "linmodel/general_expressions"
                "algebra/size" "algebra/evaluate" "algebra/scan" "algebra/kernels"))

(defstruct linmodel-arithmetic
  lift lower add multiply sine cosine
  multiplies-out ; whether products of sums become sums
  (size (constantly 0))
  turn      ; of (x y angle): the components in axes turned by an angle, where sums are not enough
  product)  ; of (x y v w): x*v + y*w, or nil

(defparameter *linmodel-moderate* 20000
  "Where more terms than this are foretold, the canonical form is taken only if it is asked for.")

(defun linmodel-compute (form function &optional plane)
  "FUNCTION of the arithmetic for FORM; auto is canonical where that is short. PLANE: all turns are
about one axis, so that general expressions stay short."
  (ecase form
    ($factored (linmodel-compute-factored function plane))
    ($canonical (let ((*algebra-advice* "take form = factored"))
                  (linmodel-compute-canonical function)))
    ($auto (let ((found (core-attempt (lambda ()
                                        (let ((*algebra-limit* *linmodel-moderate*))
                                          (linmodel-compute-canonical function))))))
             (cond (found (car found))
                   (t (core-factored) (linmodel-compute-factored function plane)))))))

(defparameter *linmodel-advice* "take form = program"
  "What helps against too long a factored form.")

(defun linmodel-compute-factored (function plane)
  "The length is foretold, where turns about one axis do not become one, then measured."
  (unless plane
    (linmodel-guard-foretold (funcall function (linmodel-measuring-arithmetic))))
  (algebra-guard-written (funcall function (linmodel-general-arithmetic))
                         "the factored form" *linmodel-advice*))

(defun linmodel-guard-foretold (sizes)
  (let ((foretold (linmodel-foretold sizes)))
    (when (> foretold (* 500 *algebra-limit*))
      (algebra-guard (floor foretold 5) "the factored form" *linmodel-advice*))))

(defun linmodel-foretold (sizes)
  (cond ((integerp sizes) (abs sizes))
        ((consp sizes) (loop for part in (cdr sizes) sum (linmodel-foretold part)))
        (t 0)))

(defun linmodel-measuring-arithmetic ()
  "Elements are the numbers of nodes of general expressions; computes nothing else."
  (flet ((size (e) (if (eql e 0) 0 (algebra-size e))))
    (make-linmodel-arithmetic
     :lift #'size
     :lower #'identity
     :add #'+
     :multiply (lambda (x y) (+ x y 1))
     :sine (lambda (angle) (size (linmodel-sine angle)))
     :cosine (lambda (angle) (size (linmodel-cosine angle))))))

(defun linmodel-compute-canonical (function)
  (with-algebra-ring
    (funcall function (linmodel-scanning-arithmetic))
    (algebra-order-kernels)
    (funcall function (linmodel-canonical-arithmetic))))

(defun linmodel-general-arithmetic ()
  "Maxima's general expressions, nothing multiplied out."
  (make-linmodel-arithmetic
   :lift #'identity
   :lower #'identity
   :add (lambda (x y) (add x y))
   :multiply #'linmodel-general-product
   :sine #'linmodel-sine
   :cosine #'linmodel-cosine
   :turn #'linmodel-turned-plane
   :product #'linmodel-plane-product))

(defun linmodel-scanning-arithmetic ()
  "Meets every kernel, so that the ring of the canonical form knows them all; computes nothing."
  (flet ((scan (e) (if (eql e 0) 0 (progn (algebra-scan e) 1))))
    (make-linmodel-arithmetic
     :lift #'scan
     :multiplies-out t
     :lower #'identity
     :add (lambda (x y) (declare (ignore x y)) 1)
     :multiply (lambda (x y) (declare (ignore x y)) 1)
     :sine (lambda (angle) (scan (linmodel-sine angle)))
     :cosine (lambda (angle) (scan (linmodel-cosine angle))))))

(defun linmodel-canonical-arithmetic ()
  "Quotients of polynomials in the kernels, reduced by s^2 + c^2 = 1 after every product."
  (flet ((lift (e) (linmodel-element (algebra-cancel (algebra-evaluate (algebra-scan e))))))
    (make-linmodel-arithmetic
     :lift #'lift
     :multiplies-out t
     :lower #'linmodel-lowered-quotient
     :add (lambda (x y) (linmodel-element (ratplus x y)))
     :multiply (lambda (x y) (linmodel-element (algebra-cancel (algebra-product (list x y)))))
     :sine (lambda (angle) (lift (linmodel-sine angle)))
     :cosine (lambda (angle) (lift (linmodel-cosine angle)))
     :size (lambda (x) (if (eql x 0) 0 (algebra-monomials (car x)))))))

(defun linmodel-element (quotient)
  (if (pzerop (car quotient)) 0 quotient))

(defun linmodel-lowered-quotient (x)
  (if (eql x 0)
      0
      (algebra-collected-reduced x)))

;;; Vectors are lists of three elements.

(defun linmodel-lift (a e)
  (funcall (linmodel-arithmetic-lift a) e))

(defun linmodel-lift-vector (a vector)
  (mapcar (linmodel-arithmetic-lift a) (cdr vector)))

(defun linmodel-lower-vector (a vector)
  (cons '(mlist simp) (mapcar (linmodel-arithmetic-lower a) vector)))

(defun linmodel-plus (a x y)
  (cond ((eql x 0) y)
        ((eql y 0) x)
        (t (funcall (linmodel-arithmetic-add a) x y))))

(defun linmodel-sum (a &rest terms)
  (reduce (lambda (x y) (linmodel-plus a x y)) terms :initial-value 0))

(defun linmodel-times (a x y)
  (if (or (eql x 0) (eql y 0)) 0 (funcall (linmodel-arithmetic-multiply a) x y)))

(defun linmodel-minus (a x)
  (linmodel-times a (linmodel-lift a -1) x))

(defun linmodel-vector-plus (a u v)
  (mapcar (lambda (x y) (linmodel-plus a x y)) u v))

(defun linmodel-vector-times (a x vector)
  (mapcar (lambda (component) (linmodel-times a x component)) vector))

(defun linmodel-dot (a u v)
  (or (linmodel-plane-dot a u v)
      (linmodel-sum-of-products a u v)))

(defun linmodel-plane-dot (a u v)
  "For an arithmetic that knows polar angles, where one component of U or V is 0; else nil."
  (let ((product (linmodel-arithmetic-product a)))
    (when product
      (loop for k in '(0 1 2)
            for i = (mod (+ k 1) 3)
            for j = (mod (+ k 2) 3)
            when (or (eql 0 (nth k u)) (eql 0 (nth k v)))
              return (funcall product (nth i u) (nth j u) (nth i v) (nth j v))))))

(defun linmodel-sum-of-products (a u v)
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
