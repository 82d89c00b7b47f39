;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Help: `? Lagrangian' answers from doc/dynarch.info by the index beside it, in the way of
;;; Maxima's share packages. The index is read when the first package is loaded, the text when
;;; somebody asks.

(in-package :maxima)

(defvar *core-help-installed* nil "Whether Maxima knows the index.")

(defun core-help-index () (concatenate 'string *core-root* "doc/dynarch-index.lisp"))

(defun core-help-install ()
  "Makes the manual's entries known to `?'. Without them a package works all the same."
  (unless *core-help-installed*
    (setq *core-help-installed* t)
    (let ((*read-base* 10) (*package* *package*))
      (core-attempt (lambda () (load (core-pathname (core-help-index))))))))
