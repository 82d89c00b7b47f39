;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A face is a package as the user loads it: a list of public functions. Each public
;;; function becomes a Lisp function that hands its arguments to the dispatcher, so kill(all)
;;; leaves it and a call is what loads the parts it needs.

(in-package :maxima)

(defvar *core-dispatcher* nil
  "What answers a call: a function of a public name and the arguments. The dispatcher's part sets
it.")
(defparameter *core-version* "0.3.0" "The version of the three packages.")
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

;;; Help: `? Lagrangian' answers from doc/dynarch.info by the index beside it, as for Maxima's
;;; share packages. The index is read when the first package is loaded, the text when somebody asks.

(defvar *core-help-installed* nil "Whether Maxima knows the index.")

(defun core-help-index () (concatenate 'string *core-root* "doc/dynarch-index.lisp"))

(defun core-help-install ()
  "Makes the manual's entries known to `?'. Without them a package works all the same."
  (unless *core-help-installed*
    (setq *core-help-installed* t)
    (let ((*read-base* 10) (*package* *package*))
      (core-attempt (lambda () (load (core-pathname (core-help-index))))))))

;;; A package

(defun $core_face (face &rest names)
  "States a package: its name and the names of its public functions."
  (core-load-registers)
  (unless *core-faces* (core-say-lost-functions))
  (dolist (name names) (core-install name))
  (core-help-install)
  (pushnew face *core-faces* :test #'string=)
  '$done)
