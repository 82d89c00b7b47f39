;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Numbers with 512 binary digits behind the point: whole numbers that count units of 2^-512. Sums
;;; are exact, products off by one unit; sine and cosine of x come from their series at x/2^20 by
;;; twenty doublings of 1 - cos,   1 - cos 2x = 2 v (2 - v),  sin 2x = 2 sin x (1 - v),  
;;; v = 1 - cos x,  which cost some forty digits.

(in-package :maxima)

(defconstant forms-digits 512)
(defconstant forms-doublings 20)

(defun forms-fixed (rational)
  (round (* rational (ash 1 forms-digits))))

(defconstant forms-most-digits 40000
  "Binary digits that a value may have: exp(10^7) has none that is of use.")

(defun forms-no-value (e)
  (declare (ignore e))
  (throw 'forms-no-value nil))

(defun forms-fixed-times (x y)
  (let ((product (ash (* x y) (- forms-digits))))
    (if (< (integer-length product) forms-most-digits) product (forms-no-value product))))

(defun forms-fixed-dot (u v)
  (let ((sum 0))
    (mapc (lambda (x y) (incf sum (* x y))) u v)
    (ash sum (- forms-digits))))

(defun forms-fixed-power (base n)
  "By squaring; in no more steps than N has binary digits."
  (let ((power (ash 1 forms-digits)))
    (loop until (zerop n)
          do (when (oddp n) (setq power (forms-fixed-times power base)))
             (setq n (ash n -1))
             (unless (zerop n) (setq base (forms-fixed-times base base))))
    power))

(defun forms-fixed-inverse (x)
  (round (ash 1 (* 2 forms-digits)) x))

(defun forms-fixed-sine-cosine (x)
  "Sine and cosine of X, which is no angle of millions of turns."
  (when (> (integer-length x) (+ forms-digits forms-doublings 6)) (forms-no-value x))
  (multiple-value-bind (sine versine) (forms-fixed-series (ash x (- forms-doublings)))
    (loop repeat forms-doublings
          do (psetq sine (* 2 (forms-fixed-times sine (- (ash 1 forms-digits) versine)))
                    versine (* 2 (forms-fixed-times versine (- (ash 2 forms-digits) versine)))))
    (values sine (- (ash 1 forms-digits) versine))))

(defun forms-fixed-series (x)
  "Sine and 1 - cosine of a small X: the terms of both are x^n/n!."
  (let ((sine x) (versine 0) (term x) (n 1))
    (loop until (member term '(0 -1))
          do (incf n)
             (setq term (floor (forms-fixed-times term x) n))
             (case (mod n 4)
               (2 (incf versine term))
               (3 (decf sine term))
               (0 (decf versine term))
               (1 (incf sine term))))
    (values sine versine)))
