;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a Lisp has beyond its standard, and what stands for it elsewhere; no other part of this
;;; room names it.
;;;     (numerics-with-masked-traps ..)   floats give infinity and NaN inside, never an error
;;;     (numerics-load-library '("libklu.so.1" "libklu.so.2")) -> the name that was found, or nil
;;;     (numerics-foreign-call "klu_solve" :int (:address symbolic) (:int n) (:vector b)) calls C
;;;     (numerics-interruptible ..)       the value, or :interrupted where the person does that
;;;     (numerics-working-seconds)        the clock on the wall without the time of loading
;;;     (numerics-infinity), (numerics-not-a-number)
;;; Numbers go through none of these as objects, so that nothing is allocated.
;;; A foreign call is for after its library was loaded, and inside masked traps. Types are :int,
;;; :long, :double, :address (a whole number, 0 for none), as a result :void too, and for arguments
;;; :vector, a simple array of numbers whose elements C reads and writes in place: it is held where
;;; it is during the call, and may also stand for a structure of C or a place of an address.

(in-package :maxima)

(defmacro numerics-with-masked-traps (&body body)
  #+sbcl `(sb-int:with-float-traps-masked (:invalid :divide-by-zero :overflow :inexact) ,@body)
  #-sbcl `(progn ,@body))

(declaim (inline numerics-infinity numerics-not-a-number))

#+sbcl
(defun numerics-infinity () sb-ext:double-float-positive-infinity)
#+sbcl
(defun numerics-not-a-number () (sb-kernel:make-double-float #x7ff80000 0))

#-sbcl
(defvar *numerics-infinity* (* most-positive-double-float 2d0))
#-sbcl
(defun numerics-infinity () *numerics-infinity*)
#-sbcl
(defun numerics-not-a-number () (- *numerics-infinity* *numerics-infinity*))

(defun numerics-working-seconds ()
  "A clock that rests while parts are loaded and files are written."
  (- (core-clock) *core-uncounted-seconds*))

(defun $numerics_working_seconds () (numerics-working-seconds))

;;; What the person interrupts (Ctrl-C) ends here.

(defmacro numerics-interruptible (&body body)
  "The value of BODY, or :interrupted."
  #+sbcl `(block nil
            (handler-bind ((sb-sys:interactive-interrupt
                             (lambda (condition)
                               (declare (ignore condition))
                               (return :interrupted))))
              ,@body))
  #-sbcl `(progn ,@body))

;;; Libraries of C. Names have no folder: the system looks where its libraries are.

(defun numerics-load-library (names)
  #+sbcl (find-if (lambda (name)
                    (handler-case
                        (handler-bind ((warning #'muffle-warning))
                          (sb-alien:load-shared-object name :dont-save t)
                          t)
                      (error () nil)))
                  names)
  #-sbcl (progn names nil))

#+sbcl
(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun numerics-alien-type (type)
    (ecase type
      (:int 'sb-alien:int)
      (:long 'sb-alien:long)
      (:double 'sb-alien:double)
      (:void 'sb-alien:void)
      ((:vector :address) 'sb-sys:system-area-pointer)))

  (defun numerics-alien-argument (type variable)
    (case type
      (:vector `(sb-sys:vector-sap ,variable))
      (:address `(sb-sys:int-sap ,variable))
      (t variable))))

(defmacro numerics-foreign-call (name result &rest arguments)
  "The RESULT, a type, of the function NAME of C; ARGUMENTS are (type form)."
  #+sbcl
  (let* ((variables (loop for nil in arguments collect (gensym)))
         (call `(sb-alien:alien-funcall
                 (sb-alien:extern-alien
                  ,name (function ,(numerics-alien-type result)
                                  ,@(loop for (type) in arguments
                                          collect (numerics-alien-type type))))
                 ,@(loop for (type) in arguments
                         for variable in variables
                         collect (numerics-alien-argument type variable)))))
    `(let ,(loop for (nil form) in arguments
                 for variable in variables
                 collect (list variable form))
       (sb-sys:with-pinned-objects ,(loop for (type) in arguments
                                          for variable in variables
                                          when (eq type :vector) collect variable)
         ,(if (eq result :address) `(sb-sys:sap-int ,call) call))))
  #-sbcl
  (declare (ignore result arguments))
  #-sbcl
  `(core-error "~a: this Lisp calls no functions of C" ,name))

;;; Elementary functions of double-float numbers, by the names of operations in programs: where
;;; they have no value they give NaN, and no error nor a complex number. The sign of NaN is NaN.

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defparameter *numerics-c-names*
    '((:sine . "sin") (:cosine . "cos") (:exponential . "exp") (:logarithm . "log")
      (:arcsine . "asin") (:arccosine . "acos") (:arctangent . "atan") (:hyperbolic-sine . "sinh")
      (:hyperbolic-cosine . "cosh") (:hyperbolic-tangent . "tanh") (:power . "pow")
      (:polar-angle . "atan2"))))

(defmacro numerics-element (vector place)
  "What (aref VECTOR PLACE) is; a compiler is done with it four times as fast."
  #+sbcl `(sb-kernel:data-vector-ref ,vector ,place)
  #-sbcl `(aref ,vector ,place))

(defmacro numerics-set-element (vector place value)
  #+sbcl `(sb-kernel:data-vector-set ,vector ,place ,value)
  #-sbcl `(setf (aref ,vector ,place) ,value))

(defmacro numerics-sign (x)
  #+sbcl `(let ((x ,x)) (cond ((> x 0d0) 1d0) ((< x 0d0) -1d0) (t x)))
  #-sbcl `(numerics-plain-sign ,x))

(defmacro numerics-square-root (x)
  #+sbcl `(sb-kernel::%sqrt ,x)
  #-sbcl `(numerics-plain-root ,x))

(defmacro numerics-quotient (x y)
  #+sbcl `(/ ,x ,y)
  #-sbcl `(numerics-plain-quotient ,x ,y))

;;; As functions: in a `let' one of these Lisps takes NaN to be greater than 0.

#-sbcl
(defun numerics-plain-sign (x)
  (declare (double-float x))
  (cond ((> x 0d0) 1d0) ((< x 0d0) -1d0) (t x)))

#-sbcl
(defun numerics-plain-root (x)
  (declare (double-float x))
  (if (>= x 0d0) (sqrt x) (numerics-not-a-number)))

#-sbcl
(defun numerics-plain-quotient (x y)
  (declare (double-float x y))
  (if (= y 0d0) (* x (numerics-infinity)) (/ x y)))

(defmacro numerics-elementary (operation &rest arguments)
  "The function OPERATION, a keyword, of one or two numbers."
  #+sbcl
  `(numerics-foreign-call ,(cdr (assoc operation *numerics-c-names*)) :double
                          ,@(loop for argument in arguments collect (list :double argument)))
  #-sbcl
  `(numerics-plain-elementary ,operation ,@arguments))

#-sbcl
(defun numerics-plain-elementary (operation x &optional (y 1d0))
  (flet ((finite-p (x) (<= (abs x) most-positive-double-float)))
    (let ((value (cond ((/= x x) x)
                       ((and (finite-p x) (finite-p y)) (numerics-plain-value operation x y))
                       ((finite-p y) (numerics-plain-limit operation x)))))
      (if (floatp value) value (numerics-not-a-number)))))

#-sbcl
(defun numerics-plain-limit (operation x)
  "The value at the infinite X, nil for none."
  (case operation
    (:exponential (if (> x 0d0) x 0d0))
    (:logarithm (and (> x 0d0) x))
    (:arctangent (cl:atan (if (> x 0d0) 1d300 -1d300)))
    (:hyperbolic-sine x)
    (:hyperbolic-cosine (abs x))
    (:hyperbolic-tangent (if (> x 0d0) 1d0 -1d0))))

#-sbcl
(defun numerics-plain-value (operation x y)
  "The value for finite X and Y; where there is none another thing than a float."
  (ecase operation
    (:sine (cl:sin x))
    (:cosine (cl:cos x))
    (:exponential (cl:exp x))
    (:logarithm (cond ((> x 0d0) (cl:log x)) ((= x 0d0) (- (numerics-infinity)))))
    (:arcsine (and (<= -1d0 x 1d0) (cl:asin x)))
    (:arccosine (and (<= -1d0 x 1d0) (cl:acos x)))
    (:arctangent (cl:atan x))
    (:hyperbolic-sine (cl:sinh x))
    (:hyperbolic-cosine (cl:cosh x))
    (:hyperbolic-tangent (cond ((> x 20d0) 1d0) ((< x -20d0) -1d0) (t (cl:tanh x))))
    (:polar-angle (if (and (= x 0d0) (= y 0d0)) 0d0 (cl:atan x y)))
    (:power (cond ((= y 0d0) 1d0)
                  ((= x 0d0) (if (> y 0d0) 0d0 (numerics-infinity)))
                  ((> x 0d0) (cl:expt x y))
                  ((= y (ffloor y)) (cl:expt x (floor y)))))))

(defmacro numerics-set-turn (vector place x)
  "Sine and cosine of X into VECTOR at PLACE and after it."
  #+(and sbcl linux)
  `(let ((vector ,vector) (place ,place))
     (sb-sys:with-pinned-objects (vector)
       (let ((sap (sb-sys:sap+ (sb-sys:vector-sap vector) (ash place 3))))
         (sb-alien:alien-funcall
          (sb-alien:extern-alien "sincos" (function sb-alien:void sb-alien:double
                                                    sb-sys:system-area-pointer
                                                    sb-sys:system-area-pointer))
          ,x sap (sb-sys:sap+ sap 8)))))
  #-(and sbcl linux)
  `(let ((x ,x))
     (numerics-set-element ,vector ,place (numerics-elementary :sine x))
     (numerics-set-element ,vector (1+ ,place) (numerics-elementary :cosine x))))

;;; The same as functions of places of one vector, for programs that are compiled: a call of these
;;; is compiled ten times as fast as a call of C.

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun numerics-put-name (operation)
    (intern (concatenate 'string "NUMERICS-PUT-" (symbol-name operation)) :maxima)))

#+sbcl
(defmacro numerics-define-puts ()
  `(progn
     ,@(loop for (operation) in *numerics-c-names*
             for two = (member operation '(:power :polar-angle))
             collect `(defun ,(numerics-put-name operation)
                          (vector place from ,@(and two '(other)))
                        (declare (type (simple-array double-float (*)) vector)
                                 (type (unsigned-byte 32) place from ,@(and two '(other)))
                                 (optimize speed (safety 0)))
                        (setf (aref vector place)
                              (numerics-elementary ,operation (aref vector from)
                                                   ,@(and two '((aref vector other)))))
                        nil))
     (defun numerics-put-turn (vector place from)
       (declare (type (simple-array double-float (*)) vector)
                (type (unsigned-byte 32) place from) (optimize speed (safety 0)))
       (numerics-set-turn vector place (aref vector from))
       nil)))

#+sbcl
(numerics-define-puts)
