;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; algebra_beautify(e): the form a person would write: common factors in front, sums inside,
;;; squares of sines kept; tangents and their kin left alone where the input has them.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal"))

(defun $algebra_beautify (e)
  (algebra-map-bags #'algebra-beautiful e))

(defun algebra-beautiful (e)
  (if (atom e)
      e
      (algebra-least (list e (algebra-normal-form e) (algebra-factored-form e)) #'algebra-size)))

(defun algebra-factored-form (e)
  (with-algebra-ring
    (let ((quotient (algebra-normal-quotient e)))
      (div (algebra-factored-polynomial (algebra-readable (car quotient)))
           (algebra-factored-polynomial (algebra-readable (cdr quotient)))))))

(defun algebra-factored-polynomial (p)
  (let (($factorflag nil))
    ($factor (algebra-general p))))
