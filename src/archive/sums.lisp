;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Sums and products as nouns, 'sum(x^k, k, 1, 3). Between whole numbers they are written out. One
;;; without a definite number of terms would be taken for an open function of its parts: it is
;;; refused in archive/contents.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/decimals"))

(defparameter *archive-most-terms* 10000 "The most terms of a sum that is written out.")

(defun archive-definite-sum-p (e)
  "Whether E is a sum or product over a name between whole numbers."
  (and (archive-head-p e '%sum '%product)
       (archive-symbol-p (third e))
       (integerp (fourth e))
       (integerp (fifth e))))

(defun archive-written-out (e)
  "E with its definite sums and products carried out, from the inside."
  (cond ((not (or (archive-contains-p e '%sum) (archive-contains-p e '%product))) e)
        ((archive-definite-sum-p e) (archive-sum-written-out e))
        (t (archive-with-parts e (mapcar #'archive-written-out (cdr e))))))

(defun archive-sum-written-out (e)
  (destructuring-bind (body index first last) (cdr e)
    (core-within-size (1+ (- last first)) *archive-most-terms* (core-words (list e)) "terms")
    (loop with body = (archive-written-out body)
          for k from first to last
          collect (archive-written-out (maxima-substitute k index body)) into terms
          finally (return (if (eq (caar e) '%sum) (addn terms nil) (muln terms nil))))))

(defun archive-sums-written-out (arguments)
  "ARGUMENTS of a call with their definite sums and products carried out."
  (archive-with-plain-simplifier (mapcar #'archive-written-out arguments)))
