;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What kind of thing an expression is, number-like, relation, list, matrix, and the errors where
;;; another kind was expected. Used while an expression is put together from its parts.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/tokens" "archive/simplify"))

(defvar *archive-nesting* #-gcl 200 #+gcl 100
  "The most levels of nesting. GCL has room for two thousand calls in each other, of Maxima's
simplifier too.")

;; What an expression is

(defun archive-form-kind (e)
  "What E is: :number-like, :relation, :list, :matrix, :string or :truth-value."
  (cond ((stringp e) :string)
        ((member e '(t nil)) :truth-value)
        ((atom e) :scalar)
        (t (case (caar e)
             ((mequal mlessp mleqp mgreaterp mgeqp mand mor mnot $notequal mnotequal) :relation)
             (mlist :list)
             ($matrix :matrix)
             (t :scalar)))))

(defun archive-kind-shown (kind)
  (ecase kind
    (:scalar "an expression") (:relation "an equation or comparison") (:list "a list")
    (:matrix "a matrix")
    (:string "a string") (:truth-value "true or false")))

(defun archive-expect-kind (reader position e expected &rest kinds)
  "E if it is of one of KINDS, else an error at POSITION that names what was EXPECTED."
  (let ((kind (archive-form-kind e)))
    (unless (member kind kinds)
      (archive-fault reader position "found ~a, expected ~a~a" (archive-kind-shown kind) expected
                     (if (eq kind :relation) "; = and comparisons stand in lists" "")))
    e))

;; `every' and its like take time in squares in GCL: long lists go through `loop'.

(defun archive-all-scalar-p (list)
  (loop for e in list always (eq (archive-form-kind e) :scalar)))

(defun archive-expect-scalar (reader position e)
  (archive-expect-kind reader position e "an expression" :scalar))

(defmacro archive-computed ((reader position) &body body)
  "BODY, with POSITION as the place of an error in a simplification."
  `(let ((*archive-position* ,position) (*archive-reader* ,reader)) ,@body))
