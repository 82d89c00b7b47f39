;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The size of expressions, and the guard that stands before every expansion: running out of heap
;;; kills the Lisp, so a result that is predicted too large is refused with its figure.

(in-package :maxima)

(defvar *algebra-limit* 2000000 "largest number of nodes that an expansion may be predicted to give")

(defun algebra-size (e)
  (let ((nodes 0))
    (declare (fixnum nodes))
    (labels ((walk (e)
               (incf nodes)
               (unless (atom e) (mapc #'walk (cdr e)))))
      (walk e)
      nodes)))

(defun $algebra_size (e)
  (algebra-size e))

(defun algebra-guard (predicted what)
  (when (> predicted *algebra-limit*)
    (core-error "~A would have about ~A terms, more than the ~A that are safe; ~A"
                what (algebra-about predicted) *algebra-limit*
                "give numbers for some parameters or take form = factored or program")))

(defun algebra-about (n)
  "Two leading digits of a large number."
  (let ((digits (length (format nil "~D" (floor n)))))
    (if (< digits 7) (floor n) (format nil "10^~D" (1- digits)))))

(defun $algebra_guard (predicted what)
  (algebra-guard predicted (if (stringp what) what (coerce (mstring what) 'string)))
  '$done)

;;; Maxima's own functions, asked without consequences.

(defun algebra-quietly (function)
  "The value of FUNCTION, nil if Maxima signals an error; questions are errors, too."
  (let ((errcatch t) ($errormsg nil) (*mdebug* nil))
    (declare (special errcatch $errormsg *mdebug*))
    (car (errset (funcall function)))))
