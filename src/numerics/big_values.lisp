;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of elements in bigfloats of any precision, by Maxima's arithmetic on mantissas and
;;; exponents, with guard digits. A constant of the program is rounded once for a precision. Where
;;; a function has no value there is an error that says so.
;;;     sinh = (D + D/(1 + D))/2, D = exp - 1;  asin x = atan2(x, sqrt((1 - x)(1 + x)))

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "algebra/program_record" "core/bigfloats"))

(defconstant numerics-guard-bits 40)
(defconstant numerics-largest-exponent 100
  "Sines of numbers with more binary digits before the point, and exponentials, take too long.")

(defmacro with-numerics-bits (bits &body body)
  "Bigfloats have BITS binary digits in BODY."
  `(let ((fpprec ,bits) (*m 1) (*cancelled 0))
     (declare (special fpprec *m *cancelled))
     ,@body))

(defun numerics-big-number (x)
  "The mantissa and exponent of X, a rational number or a bigfloat."
  (cond ((integerp x) (if (zerop x) (list 0 0) (intofp x)))
        ((rationalp x) (fpquotient (intofp (numerator x)) (intofp (denominator x))))
        (t (cdr (bigfloatp x)))))

(defun numerics-big-routine (elements names digits)
  "A function of the list of the values of NAMES, rational numbers or bigfloats: the list of the
values of ELEMENTS, bigfloats of DIGITS."
  (let* ((bits (core-bits-of-digits digits)) (inner (+ bits numerics-guard-bits))
         (constants (make-hash-table)) (values (make-hash-table)) (point '()))
    (labels ((value (element)
               (if (algebra-node-p element)
                   (gethash (algebra-node-index element) values)
                   (or (gethash element constants)
                       (setf (gethash element constants) (numerics-big-number element)))))
             (compute (node)
               (setf (gethash (algebra-node-index node) values)
                     (numerics-big-node-value node #'value names point))))
      (multiple-value-bind (fixed moving) (numerics-fixed-nodes (algebra-live-nodes elements))
        (lambda (numbers)
          (setq point numbers)
          (with-numerics-bits inner
            (loop while fixed do (compute (pop fixed)))
            (mapc #'compute moving)
            (loop for element in elements
                  collect (numerics-big-rounded (value element) bits))))))))

(defun numerics-fixed-nodes (nodes)
  "Those of NODES that no input moves, and the others."
  (let ((moving (make-hash-table)))
    (flet ((moving-p (node)
             (if (algebra-input-p node)
                 (not (algebra-constant-input-p node))
                 (some (lambda (part) (gethash (algebra-node-index part) moving))
                       (algebra-node-parts node)))))
      (dolist (node nodes)
        (when (moving-p node) (setf (gethash (algebra-node-index node) moving) t)))
      (flet ((moves-p (node) (gethash (algebra-node-index node) moving)))
        (values (remove-if #'moves-p nodes) (remove-if-not #'moves-p nodes))))))

(defun numerics-big-rounded (number bits)
  "The bigfloat of BITS for the mantissa and exponent NUMBER."
  (let ((x (bcons number)))
    (with-numerics-bits bits (bigfloatp x))))

(defun numerics-big-node-value (node value names point)
  (let ((left (algebra-node-left node)) (right (algebra-node-right node)))
    (flet ((x () (funcall value left)) (y () (funcall value right)))
      (case (algebra-node-operation node)
        (:input (numerics-big-input left names point))
        (:add (fpplus (x) (y)))
        (:subtract (fpdifference (x) (y)))
        (:negate (fpminus (x)))
        (:multiply (fptimes* (x) (y)))
        (:divide (numerics-big-quotient (x) (y)))
        (:power (numerics-big-power (x) (y)))
        (:polar-angle (numerics-big-polar-angle (x) (y)))
        (t (numerics-big-function (algebra-node-operation node) (x)))))))

(defun numerics-big-input (name names point)
  (let ((place (position name names :test #'alike1)))
    (cond (place (numerics-big-number (nth place point)))
          ((eq name '$%pi) (fppi))
          ((eq name '$%e) (fpe))
          (t (core-error "the point has no value for ~a" (mfuncall '$string name))))))

;;; Functions of mantissas and exponents.

(defun numerics-big-fault (operation)
  (core-error "a program takes the ~(~a~) of a number for which it has no value" operation))

(defun numerics-big-sign (x) (signum (first x)))

(defun numerics-big-quotient (x y)
  (if (zerop (first y)) (core-error "a program divides by zero at this point") (fpquotient x y)))

(defun numerics-big-function (operation x)
  (case operation
    (:absolute (if (minusp (numerics-big-sign x)) (fpminus x) x))
    (:sign (numerics-big-number (numerics-big-sign x)))
    (:root (numerics-big-root x))
    (:sine (fpsin (numerics-not-too-large operation x) t))
    (:cosine (fpsin (numerics-not-too-large operation x) nil))
    (:logarithm (if (plusp (numerics-big-sign x)) (fplog x) (numerics-big-fault operation)))
    (:arctangent (fpatan x))
    (:arcsine (numerics-big-polar-angle x (numerics-big-leg operation x)))
    (:arccosine (numerics-big-polar-angle (numerics-big-leg operation x) x))
    (t (numerics-big-exponential operation (numerics-not-too-large operation x)))))

(defun numerics-not-too-large (operation x)
  (if (and (plusp (abs (first x))) (> (second x) numerics-largest-exponent))
      (numerics-big-fault operation)
      x))

(defun numerics-big-root (x)
  (case (numerics-big-sign x)
    (0 x)
    (1 (fproot (bcons x) 2))
    (t (numerics-big-fault :root))))

(defun numerics-big-leg (operation x)
  "The square root of 1 - X^2."
  (let ((product (fptimes* (fpdifference (fpone) x) (fpplus (fpone) x))))
    (if (minusp (numerics-big-sign product))
        (numerics-big-fault operation)
        (numerics-big-root product))))

(defun numerics-big-polar-angle (y x)
  (if (zerop (first y))
      (if (minusp (numerics-big-sign x)) (fppi) y)
      (fpatan2 y x)))

(defun numerics-big-exponential (operation x)
  "The exponential or a hyperbolic function of X."
  (flet ((half (x) (fpquotient x (intofp 2))))
    (when (> (second x) 40) (numerics-big-fault operation))
    (ecase operation
      (:exponential (if (zerop (first x)) (fpone) (fpexp x)))
      (:hyperbolic-cosine
       (let ((exponential (numerics-big-exponential :exponential x)))
         (half (fpplus exponential (fpquotient (fpone) exponential)))))
      (:hyperbolic-sine (cdr (fpsinh (bcons x))))
      (:hyperbolic-tangent (if (zerop (first x)) x (cdr (fptanh (bcons x))))))))

(defun numerics-big-power (x y)
  "X to the power Y; a negative X has powers with whole exponents."
  (let ((whole (numerics-big-whole y)))
    (cond ((and whole (or (plusp whole) (not (zerop (first x)))))
           (if (zerop (first x)) x (fpexpt x whole)))
          ((eql whole 0) (fpone))
          ((plusp (numerics-big-sign x))
           (numerics-big-exponential :exponential
                                     (numerics-not-too-large :power (fptimes* y (fplog x)))))
          ((and (zerop (first x)) (plusp (numerics-big-sign y))) x)
          (t (numerics-big-fault :power)))))

(defun numerics-big-whole (x)
  "X as a whole number, where it is one and not a large one."
  (let ((value (numerics-big-rational x)))
    (and (integerp value) (< (abs value) 10000) value)))

(defun numerics-big-rational (x)
  (if (> (abs (second x)) 10000) 1/2 (* (first x) (expt 2 (- (second x) fpprec)))))
