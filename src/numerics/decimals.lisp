;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Coefficients as their source writes them: decimals as rational numbers, and the double-float
;;; numbers nearest to these, to the last place in every Lisp (the coerce of some is not).

(in-package :maxima)

(defun numerics-decimal (digits)
  "The rational number that the text DIGITS writes."
  (let* ((point (or (position #\. digits) (length digits)))
         (places (max 0 (- (length digits) point 1))))
    (/ (parse-integer (remove #\. digits)) (expt 10 places))))

(defun numerics-rounded (x)
  "The double-float number nearest to the rational number X, which lies well within their range."
  (if (zerop x)
      0d0
      (let* ((bits (- (integer-length (numerator x)) (integer-length (denominator x))))
             (shift (- 53 bits))
             (shift (if (>= (abs (* x (expt 2 shift))) (expt 2 53)) (1- shift) shift)))
        (scale-float (coerce (round (* x (expt 2 shift))) 'double-float) (- shift)))))
