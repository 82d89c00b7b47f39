;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Whether a function of one variable has no zero between two numbers: its interval over each of
;;; parts, halved where it holds 0, does not. See algebra_no_zero_within.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/interval" "algebra/size"))

(defparameter *algebra-most-halvings* 12)

(defun $algebra_no_zero_within (e name low high)
  "Whether it is proved that E, numbers but for NAME, has no zero for NAME from LOW to HIGH."
  (flet ((exact (x) (algebra-rational-number ($rationalize x))))
    (let ((low (exact low)) (high (exact high)))
      (and low high
           (algebra-without-zero-p ($rationalize e) name low high *algebra-most-halvings*)
           t))))

(defun algebra-without-zero-p (e name low high halvings)
  (or (algebra-over-sign e name low high)
      (and (plusp halvings)
           (let ((middle (/ (+ low high) 2)))
             (and (algebra-over-sign e name middle middle)
                  (algebra-without-zero-p e name low middle (1- halvings))
                  (algebra-without-zero-p e name middle high (1- halvings)))))))

(defun algebra-over-sign (e name low high)
  "1 or -1 where E has that sign for NAME from LOW to HIGH; else nil."
  (let ((*algebra-coordinate* nil) (*algebra-interval-bits* 64))
    (let ((*algebra-dummies* (acons name (cons (car (algebra-i low)) (cdr (algebra-i high)))
                                    *algebra-dummies*)))
      (algebra-interval-sign-at e 64))))
