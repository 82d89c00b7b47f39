;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Polynomials of whole numbers by lists of Maxima.

(in-package :maxima)

(core-require "algebra/whole_polynomials")

(defun $whole_common (f g)
  (cons '(mlist simp) (algebra-common-polynomial (cdr f) (cdr g))))

(defun $whole_parts (f)
  "[[part, multiplicity], ..]"
  (cons '(mlist simp)
        (loop for (part . multiplicity) in (algebra-square-free-parts (cdr f))
              collect (list '(mlist simp) (cons '(mlist simp) part) multiplicity))))
