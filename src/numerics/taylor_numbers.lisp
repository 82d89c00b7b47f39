;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Fixed-point numbers: a whole number of Lisp stands for itself times 2^-bits. What a Taylor
;;; series needs of them: from exact numbers and constants of Maxima, to bigfloats, and the values
;;; of functions, by Maxima's bigfloats with as many bits more as the result has before its point.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "numerics/big_values" "numerics/decimals"))

(defun numerics-shifted (x shift)
  "X times 2^SHIFT, rounded."
  (if (minusp shift)
      (ash (+ x (ash 1 (- -1 shift))) shift)
      (ash x shift)))

(defun numerics-fixed-of-big (number bits)
  "From a mantissa and exponent of the present precision."
  (numerics-shifted (first number) (+ bits (- (second number) fpprec))))

(defun numerics-big-of-fixed (x bits)
  "The mantissa and exponent in the present precision."
  (if (zerop x)
      (list 0 0)
      (let ((whole (intofp x))) (list (first whole) (- (second whole) bits)))))

(defun numerics-fixed (e bits)
  "From a rational number of Lisp or a constant expression of Maxima, such as 3/2*%pi."
  (let ((number (cond ((floatp e) (rational e))
                      ((rationalp e) e)
                      (t (algebra-rational-number e)))))
    (if number
        (round (* number (ash 1 bits)))
        (numerics-fixed-constant e bits))))

(defun numerics-fixed-constant (e bits)
  (with-numerics-bits (+ bits 40)
    (let ((big (let (($fpprec (floor (+ bits 40) 3.3))) ($bfloat e))))
      (unless ($bfloatp big) (core-error "~a is no number" (mfuncall '$string e)))
      (numerics-fixed-of-big (cdr (bigfloatp big)) bits))))

(defun numerics-bigfloat-of-fixed (x bits digits)
  (core-bigfloat (/ x (ash 1 bits)) digits))

(defun numerics-double-of-fixed (x bits)
  (numerics-small-double (/ x (ash 1 bits))))

;;; Functions. A fault ends the step; it is a text that completes "at t = .. there is".

(defun numerics-series-fault (text) (throw 'numerics-series-fault text))

(defun numerics-whole-bits (x bits)
  "How many bits X has before its point."
  (max 0 (- (integer-length x) bits)))

(defparameter *numerics-most-whole-bits* 12
  "Of exponents: exp(2^12) has 1779 digits before its point.")

(defun numerics-extra-bits (operation bits x y)
  "How many more bits than BITS the value of OPERATION takes."
  (flet ((whole (x)
           (if (> (numerics-whole-bits x bits) *numerics-most-whole-bits*)
               (numerics-series-fault (format nil "a number too large for ~(~a~)" operation))
               (1+ (ash (abs x) (- bits))))))
    (case operation
      (:exponential (if (minusp x) 0 (* 2 (whole x))))
      ((:hyperbolic-sine :hyperbolic-cosine) (* 2 (whole x)))
      ((:arcsine :arccosine) bits)
      (:power (* (whole y) (+ 2 (abs (- (integer-length x) bits)))))
      (t (numerics-whole-bits x bits)))))

(defun numerics-fixed-function (operation bits x &optional (y 0))
  (if (and (eq operation :exponential) (< x (- (ash bits bits))))
      0                                   ; less than 2^-bits
      (numerics-big-fixed-function operation bits x y)))

(defun numerics-big-fixed-function (operation bits x y)
  (with-numerics-bits (+ bits 32 (numerics-extra-bits operation bits x y))
    (let ((x (numerics-big-of-fixed x bits)) (y (numerics-big-of-fixed y bits)))
      (numerics-fixed-of-big
       (case operation
         (:power (numerics-big-power x y))
         (:polar-angle (numerics-big-polar-angle x y))
         (t (numerics-big-function operation x)))
       bits))))
