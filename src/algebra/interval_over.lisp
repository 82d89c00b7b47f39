;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Whether a function of one variable has one sign between two numbers: its interval over each of
;;; parts, halved where it holds 0, does not. See algebra_one_sign_within.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/interval" "algebra/size"))

(defparameter *algebra-most-halvings* 12)

(defun $algebra_one_sign_within (e name low high)
  "Whether it is proved that E, numbers but for NAME, has one sign, not 0, from LOW to HIGH."
  (flet ((exact (x) (algebra-rational-number ($rationalize x))))
    (let ((low (exact low)) (high (exact high)))
      (and low high
           (algebra-sign-within ($rationalize e) name low high *algebra-most-halvings*)
           t))))

(defun algebra-sign-within (e name low high halvings)
  "1, -1, or nil where none is proved."
  (or (algebra-sign-over e name low high)
      (and (plusp halvings)
           (let* ((middle (/ (+ low high) 2))
                  (sign (algebra-sign-over e name middle middle)))
             (and sign
                  (eql sign (algebra-sign-within e name low middle (1- halvings)))
                  (eql sign (algebra-sign-within e name middle high (1- halvings)))
                  sign)))))

(defun algebra-sign-over (e name low high)
  "1 or -1 where the interval of E for NAME from LOW to HIGH has that sign; else nil."
  (let ((*algebra-coordinate* nil) (*algebra-interval-bits* 64))
    (let ((*algebra-dummies* (acons name (cons (car (algebra-i low)) (cdr (algebra-i high)))
                                    *algebra-dummies*)))
      (algebra-interval-sign-at e 64))))
