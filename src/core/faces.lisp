;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A face is a package as the user loads it: a list of public functions. Each public
;;; function becomes a Lisp function that hands its arguments to the dispatcher, so kill(all)
;;; leaves it and a call is what loads the parts it needs.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/help"))

(defvar *core-dispatcher* nil
  "What answers a call: a function of a public name and the arguments. The dispatcher's part sets
it.")
(defparameter *core-version* "0.2.0" "The version of the three packages.")
(defvar *core-faces* '() "Names of the faces loaded.")

(defun core-load-registers ()
  (loop for (room) in *core-rooms* do
    (when (core-existing-file (format nil "~asrc/~a/register.lisp" *core-root* room))
      (core-require (concatenate 'string room "/register")))))

(defun core-install (public)
  "Makes the public function PUBLIC callable. (Maxima has declared `name' special: no closure may
capture it.)"
  (let ((symbol (core-symbol public)))
    (setf (symbol-function symbol)
          (lambda (&rest arguments)
            (core-require "archive/dispatch")
            (funcall *core-dispatcher* public arguments)))
    symbol))

(defun $core_face (face &rest names)
  "States a package: its name and the names of its public functions."
  (core-load-registers)
  (unless *core-faces* (core-say-lost-functions))
  (dolist (name names) (core-install name))
  (core-help-install)
  (pushnew face *core-faces* :test #'string=)
  '$done)
