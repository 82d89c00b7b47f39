;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Numbers as they are written: coefficients, whose source has decimals, as rational numbers; the
;;; double-float numbers nearest to these, to the last place in every Lisp (the coerce of some is
;;; not); and numbers of messages.

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

(defun numerics-short-number (x)
  "X to six digits, as a person writes it."
  (flet ((trimmed (text) (string-right-trim "." (string-right-trim "0" text))))
    (if (or (= x 0d0) (<= 1d-3 (abs x) 1d6))
        (trimmed (format nil "~,6f" x))
        (let* ((text (string-downcase (format nil "~,5e" x)))
               (place (position-if #'alpha-char-p text)))
          (concatenate 'string (trimmed (subseq text 0 place)) "e"
                       (string-left-trim "+" (subseq text (1+ place))))))))
