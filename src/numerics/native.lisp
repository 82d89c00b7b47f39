;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a Lisp has beyond its standard, and what stands for it elsewhere: nothing else here names it.
;;;     (numerics-with-masked-traps ..)   floats give infinity and NaN inside, never an error
;;;     (numerics-load-library '("libklu.so.1" "libklu.so.2")) -> the name that was found, or nil
;;;     (numerics-foreign-call "klu_solve" :int (:address symbolic) (:int n) (:vector b)) calls C
;;;     (numerics-seconds)                the clock on the wall, fine to a microsecond
;;;     (numerics-infinity), (numerics-not-a-number)
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

(defun numerics-seconds ()
  #+sbcl (multiple-value-bind (seconds microseconds) (sb-ext:get-time-of-day)
           (+ seconds (* 1d-6 microseconds)))
  #-sbcl (/ (get-internal-real-time) (coerce internal-time-units-per-second 'double-float)))

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
(defun numerics-alien-type (type)
  (ecase type
    (:int 'sb-alien:int)
    (:long 'sb-alien:long)
    (:double 'sb-alien:double)
    (:void 'sb-alien:void)
    ((:vector :address) 'sb-sys:system-area-pointer)))

#+sbcl
(defun numerics-alien-argument (type variable)
  (case type
    (:vector `(sb-sys:vector-sap ,variable))
    (:address `(sb-sys:int-sap ,variable))
    (t variable)))

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
