;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Straight-line programs, built while a formula is derived. An element is an exact constant (a
;;; rational number of Lisp) or a node: an operation on elements, or an input. Equal operations on
;;; equal elements are one node (hash consing), so that what is shared is computed once; a node is
;;; younger than its parts, so that the order of birth is an order of computation.
;;; The rules are x*0, x*1, x + 0, constants among themselves, signs and factors drawn outwards, one
;;; order of commutative parts. See algebra-program-add first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/impulses"))

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

(defvar *algebra-longest-constant* nil
  "Binary digits of the longest constant that is worked out; nil where there is no limit.")

(defun algebra-short-p (number)
  (or (null *algebra-longest-constant*)
      (<= (max (integer-length (numerator number)) (integer-length (denominator number)))
          *algebra-longest-constant*)))

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
        ((and (numberp x) (algebra-scaled-p y) (algebra-short-p (* x (algebra-node-left y))))
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

;;; Functions beside sine, cosine and square root, each an operation of its own. One row says all
;;; that a program knows of a function: its value in double-float numbers, its value at 0, whether
;;; it is odd or even, and its derivative,
;;;     exp' = exp, log' = 1/x, asin' = 1/sqrt(1 - x^2), atan' = 1/(1 + x^2), tanh' = 1 - tanh^2,
;;; powers with other than whole exponents, atan2(y,x)' = (x y' - y x')/(x^2 + y^2), |x|' = sign x.

(defstruct algebra-function
  operation operator ; the keyword in nodes, and Maxima's operator
  doubles            ; function of double-float numbers
  at-zero            ; exact value at 0, or nil
  parity             ; :odd, :even or nil
  slopes)            ; function of the node and its parts: the derivatives by the parts

(defvar *algebra-functions* '() "The rows of all functions, filled below.")

(defun algebra-function-of (operation)
  (find operation *algebra-functions* :key #'algebra-function-operation))

(defun algebra-function-named (operator)
  (and operator (find operator *algebra-functions* :key #'algebra-function-operator)))

(defun algebra-program-function (operation x)
  "The function OPERATION of one argument X, a sign drawn outwards where it is odd or even."
  (let ((row (algebra-function-of operation)))
    (cond ((and *algebra-sides* (member operation '(:impulse :sign :absolute))
                (funcall *algebra-sides* operation x)))
          ((and (eql x 0) (algebra-function-at-zero row)))
          ((and (algebra-function-parity row) (algebra-opposite x))
           (let ((node (algebra-program-function operation (algebra-opposite x))))
             (if (eq (algebra-function-parity row) :odd) (algebra-program-negate node) node)))
          (t (algebra-make-node operation x)))))

(defun algebra-opposite (x)
  "-X where that is the simpler of the two, or nil."
  (cond ((numberp x) (and (minusp x) (- x)))
        ((algebra-operation-p :negate x) (algebra-node-left x))))

(defun algebra-program-general-power (x y)
  "X to the power Y, any elements."
  (cond ((integerp y) (algebra-program-power x y))
        ((and (rationalp y) (= (denominator y) 2))
         (algebra-program-power (algebra-program-root x) (numerator y)))
        ((and (rationalp y) (minusp y))
         (algebra-program-divide 1 (algebra-program-general-power x (- y))))
        (t (algebra-make-node :power x y))))

(defun algebra-program-polar-angle (y x) (algebra-make-node :polar-angle y x))

(defun algebra-program-extreme (x y sign)
  "(x + y + SIGN |x - y|)/2: the greater of X and Y for 1, the lesser for -1."
  (let ((distance (algebra-program-function :absolute (algebra-program-subtract x y))))
    (algebra-program-multiply
     1/2 (algebra-program-add (algebra-program-add x y)
                              (algebra-program-multiply sign distance)))))

;;; Derivatives.

(defun algebra-one-minus-square (x)
  (algebra-program-subtract 1 (algebra-program-multiply x x)))

(defun algebra-inverse-root (x)
  (algebra-program-divide 1 (algebra-program-root x)))

(defun algebra-twice-impulse (x)
  (if *algebra-impulses* (algebra-program-multiply 2 (algebra-program-function :impulse x)) 0))

(defun algebra-power-slopes (node x y)
  (list (algebra-program-multiply
         y (algebra-program-general-power x (algebra-program-subtract y 1)))
        (if (numberp y)
            0
            (algebra-program-multiply node (algebra-program-function :logarithm x)))))

(defun algebra-polar-slopes (node y x)
  (declare (ignore node))
  (let ((square (algebra-program-add (algebra-program-multiply x x)
                                     (algebra-program-multiply y y))))
    (list (algebra-program-divide x square)
          (algebra-program-negate (algebra-program-divide y square)))))

(defun algebra-row (operation operator doubles at-zero parity slopes)
  (make-algebra-function :operation operation :operator operator :doubles doubles :at-zero at-zero
                         :parity parity :slopes slopes))

(defmacro algebra-slope (expression)
  "The derivative of a function of one argument X, NODE being its value."
  `(lambda (node x y) (declare (ignorable node x y)) (list ,expression)))

(setq
 *algebra-functions*
 (list
  (algebra-row :exponential nil #'cl:exp 1 nil (algebra-slope node))
  (algebra-row :logarithm '%log #'cl:log nil nil (algebra-slope (algebra-program-divide 1 x)))
  (algebra-row :arcsine '%asin #'cl:asin 0 :odd
               (algebra-slope (algebra-inverse-root (algebra-one-minus-square x))))
  (algebra-row :arccosine '%acos #'cl:acos nil nil
               (algebra-slope (algebra-program-negate
                                (algebra-inverse-root (algebra-one-minus-square x)))))
  (algebra-row :arctangent '%atan #'cl:atan 0 :odd
               (algebra-slope (algebra-program-divide
                                1 (algebra-program-add 1 (algebra-program-multiply x x)))))
  (algebra-row :hyperbolic-sine '%sinh #'cl:sinh 0 :odd
               (algebra-slope (algebra-program-function :hyperbolic-cosine x)))
  (algebra-row :hyperbolic-cosine '%cosh #'cl:cosh 1 :even
               (algebra-slope (algebra-program-function :hyperbolic-sine x)))
  (algebra-row :hyperbolic-tangent '%tanh #'cl:tanh 0 :odd
               (algebra-slope (algebra-one-minus-square node)))
  (algebra-row :absolute 'mabs #'cl:abs 0 :even    ; the square of a sign is 1 beside its jump
               (algebra-slope (if (algebra-operation-p :sign x)
                                  0
                                  (algebra-program-function :sign x))))
  (algebra-row :sign '%signum #'cl:signum 0 :odd (algebra-slope (algebra-twice-impulse x)))
  (algebra-row :impulse nil (constantly 0d0) nil :even
               (algebra-slope (algebra-program-function :impulse x)))
  (algebra-row :power nil #'cl:expt nil nil #'algebra-power-slopes)
  (algebra-row :polar-angle nil #'cl:atan nil nil #'algebra-polar-slopes)))

;;; Values in double-float numbers.

(defun algebra-function-of-doubles (operation &rest arguments)
  (let ((value (apply (algebra-function-doubles (algebra-function-of operation)) arguments)))
    (if (floatp value)
        value
        (core-error "a program takes the ~(~a~) of ~{~a~^ and ~}" operation arguments))))
