;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Numbers as they are written: coefficients, whose source has decimals, as rational numbers; the
;;; double-float numbers nearest to these, to the last place in every Lisp (the coerce of some is
;;; not); and numbers of messages.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/bigfloats"))

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

(defun numerics-small-double (x)
  "The same for a rational number X that may be too small for them: then 0, or too large: then the
largest."
  (cond ((< (abs x) (expt 10 -300)) 0d0)
        ((< (abs x) (expt 10 300)) (numerics-rounded x))
        (t (* (signum x) (min (rational most-positive-double-float) (abs x)) 1d0))))

(defun numerics-short-number (x)
  "X to six digits, as a person writes it."
  (flet ((trimmed (text) (string-right-trim "." (string-right-trim "0" text))))
    (cond ((or (= x 0d0) (<= 1d-3 (abs x) 1d6)) (trimmed (format nil "~,6f" x)))
          ((<= (abs x) most-positive-double-float)
           (multiple-value-bind (mantissa exponent) (core-rounded-to (rational (abs x)) 10 6)
             (let ((digits (format nil "~d" mantissa)))
               (format nil "~:[~;-~]~ae~d" (minusp x)
                       (trimmed (format nil "~a.~a" (subseq digits 0 1) (subseq digits 1)))
                       (+ exponent 5)))))
          (t (string-downcase (format nil "~a" x))))))

(defun numerics-few-digits (x)
  "The double-float number next to X to four digits, as is fit for an error."
  (if (and (/= x 0d0) (<= (abs x) most-positive-double-float))
      (multiple-value-bind (mantissa exponent) (core-rounded-to (rational x) 10 4)
        (numerics-rounded (* mantissa (expt 10 exponent))))
      x))
