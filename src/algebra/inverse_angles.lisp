;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Cosine and sine of whole and half multiples of inverse functions, which Maxima knows of the
;;; functions themselves alone: cos(2*acos(u)) = 2*u^2 - 1. From cos(acos(u)) = u, sin(acos(u)) =
;;; sqrt(1-u^2) and their like by the theorems of addition; half of each lies between -%pi/2 and
;;; %pi/2, where the cosine is not negative.

(in-package :maxima)

(defparameter *algebra-inverse-multiples* 12 "The largest multiple that is expanded.")

(defun algebra-inverse-pair (base)
  "(cosine . sine) of BASE, an inverse function; else nil."
  (and (consp base)
       (let ((u (cadr base)))
         (case (caar base)
           (%acos (cons u (algebra-leg u)))
           (%asin (cons (algebra-leg u) u))
           (%atan (let ((r (power (add 1 (power u 2)) '((rat simp) -1 2))))
                    (cons r (mul u r))))
           ($atan2 (let* ((x (caddr base))
                          (r (power (add (power x 2) (power u 2)) '((rat simp) -1 2))))
                     (cons (mul x r) (mul u r))))))))

(defun algebra-leg (u) (power (sub 1 (power u 2)) '((rat simp) 1 2)))

(defun algebra-inverse-half (base)
  "(cosine . sine) of half of BASE, an inverse function; else nil."
  (let ((pair (algebra-inverse-pair base)))
    (when pair
      (let ((c (power (div (add 1 (car pair)) 2) '((rat simp) 1 2))))
        (cons c (if (eq (caar base) '%acos)
                    (power (div (sub 1 (car pair)) 2) '((rat simp) 1 2))
                    (div (cdr pair) (mul 2 c))))))))

(defun algebra-inverse-angle (factor base)
  "(cosine . sine) of FACTOR*BASE, 2*FACTOR a whole number and BASE an inverse function; else nil."
  (let ((pair (cond ((> (abs (numerator factor)) *algebra-inverse-multiples*) nil)
                    ((zerop factor) nil)
                    ((= 1 (denominator factor)) (algebra-inverse-pair base))
                    ((= 2 (denominator factor)) (algebra-inverse-half base)))))
    (and pair (algebra-multiplied-angle (numerator factor) (car pair) (cdr pair)))))

(defun algebra-multiplied-angle (n c s)
  "(cosine . sine) of N times the angle of the cosine C and the sine S."
  (let ((cosine c) (sine s))
    (loop repeat (1- (abs n))
          do (psetq cosine (sub (mul c cosine) (mul s sine))
                    sine (add (mul s cosine) (mul c sine))))
    (cons cosine (if (minusp n) (mul -1 sine) sine))))
