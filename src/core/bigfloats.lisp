;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Maxima's bigfloats as decimals: those of N digits that are nearest to a decimal of N digits, so
;;; that the decimal says all of them, and back, whatever fpprec is. In Maxima a precision of N
;;; digits are 2 + integer-length(10^N) binary digits; ((bigfloat simp BITS) m x) is m*2^(x - BITS).

(in-package :maxima)

(defun core-bits-of-digits (digits) (+ 2 (integer-length (expt 10 digits))))

(defun core-bigfloat-digits (e)
  "How many digits the bigfloat E has."
  (let ((bits (car (last (car e)))))
    (loop for digits from (max 1 (floor (- bits 3) 7/2))
          when (>= (core-bits-of-digits digits) bits) return digits)))

(defun core-bigfloat-rational (e)
  "The bigfloat E exactly."
  (* (second e) (expt 2 (- (third e) (car (last (car e)))))))

(defun core-bigfloat-negative (e) (list (first e) (- (second e)) (third e)))

(defun core-bigfloat (number digits)
  "The bigfloat of DIGITS next to the rational NUMBER."
  (let* ((bits (core-bits-of-digits digits)) (head (list 'bigfloat 'simp bits)))
    (if (zerop number)
        (list head 0 0)
        (multiple-value-bind (mantissa exponent) (core-rounded-to number 2 bits)
          (list head mantissa (+ exponent bits))))))

(defun core-rounded-to (number base places)
  "Two values m and x: m*BASE^x is next to NUMBER, which is not 0, and |m| has PLACES places."
  (let* ((size (- (integer-length (numerator number)) (integer-length (denominator number))))
         (exponent (- (floor (* (1- size) (log 2d0 base))) places)) ; too small rather than too large
         (most (expt base places)))
    (loop
      (let ((mantissa (round (* number (expt base (- exponent))))))
        (if (< (abs mantissa) most)
            (return (values mantissa exponent))
            (incf exponent))))))

(defun core-decimal-bigfloat (number digits)
  "The bigfloat next to the decimal of DIGITS that is next to the rational NUMBER."
  (if (zerop number)
      (core-bigfloat 0 digits)
      (multiple-value-bind (mantissa exponent) (core-rounded-to number 10 digits)
        (core-bigfloat (* mantissa (expt 10 exponent)) digits))))

(defun core-bigfloat-text (e)
  "The bigfloat E, not negative, as a decimal of all its digits, 1.50b0; or nil where that is another
number."
  (let* ((digits (core-bigfloat-digits e)) (number (core-bigfloat-rational e)))
    (if (zerop number)
        (format nil "0.~v,,,'0ab0" (1- digits) "")
        (multiple-value-bind (mantissa exponent) (core-rounded-to number 10 digits)
          (let ((text (format nil "~d" mantissa)))
            (and (equal (core-bigfloat (* mantissa (expt 10 exponent)) digits) e)
                 (format nil "~a.~ab~d" (subseq text 0 1) (subseq text 1)
                         (+ exponent digits -1))))))))
