;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Arguments and options of calls on expressions: in general form, of the shape that their names
;;; ask for. A function computes with what it is given; what it cannot mean is refused here, in one
;;; sentence that says which argument, what was found, and what to type.
;;; Look first at archive-general-arguments and archive-check-argument.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/keys" "archive/types" "archive/speller"))

(defun archive-general-arguments (arguments)
  "ARGUMENTS with what `rat' and `taylor' made of them in general form."
  (mapcar (lambda (argument)
            (if (archive-contains-p argument 'mrat) ($totaldisrep argument) argument))
          arguments))

(defun archive-argument-type (name)
  "The type of the argument or option NAME, that of the key of [system], or nil."
  (let ((key (find-if (lambda (key) (and (string= (archive-key-name key) name)
                                         (string= (archive-key-section key) "system")))
                      *archive-keys*)))
    (and key (archive-key-type key))))

(defparameter *archive-argument-phrases*
  '((:motion "a list such as [theta = 0, 'diff(theta,t) = w]")
    (:rates "a list of equations such as ['diff(x,t) = y, 'diff(y,t) = -x]"))
  "What an argument is, where the session spells it otherwise than an archive.")

(defun archive-argument-phrase (type)
  (or (second (assoc type *archive-argument-phrases*)) (archive-type-phrase type)))

(defun archive-check-argument (name value)
  "An error unless VALUE can be the argument or option NAME."
  (let* ((type (archive-argument-type name))
         (trouble (and type (nth-value 1 (archive-typed type value)))))
    (when trouble
      (core-error "~a must be ~a, found ~a~:[; ~a~;~]" name (archive-argument-phrase type)
                  (core-words (list value)) (string= trouble "") trouble))))
