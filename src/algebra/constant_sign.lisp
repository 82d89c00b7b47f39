;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The sign of a real constant, zero included.  Intervals prove that it is not zero.  An algebraic
;;; number (nested roots, sines and cosines of parts of %pi) is zero if it is smaller than it could
;;; be otherwise (separation.lisp): one interval of that many digits decides.  What intervals do not
;;; separate and no bound covers, or would take too many digits, is not decided.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common" "algebra/interval" "algebra/separation_bound"))

(defparameter *algebra-most-bits* 30000 "binary digits that are spent on the sign of a constant")

(defparameter *algebra-kept-verdicts* 300 "for how many constants the verdict is kept")
(defvar *algebra-verdicts* (make-hash-table :test #'equal)
  "Constant -> verdict. What is not decided took the most digits, and is asked again and again.")

(defun algebra-constant-verdict (e)
  "1, -1 or 0, proved, for the real constant E; nil if it is not decided."
  (let ((number (algebra-rational-number e)))
    (if number
        (signum number)
        (multiple-value-bind (verdict kept) (gethash e *algebra-verdicts*)
          (if kept verdict (algebra-keep-verdict e (algebra-new-verdict e)))))))

(defun algebra-keep-verdict (e verdict)
  (when (>= (hash-table-count *algebra-verdicts*) *algebra-kept-verdicts*)
    (clrhash *algebra-verdicts*))
  (setf (gethash e *algebra-verdicts*) verdict))

(defun algebra-new-verdict (e)
  (or (algebra-interval-sign-among e '(64 256))
      (algebra-separated-sign e)))

(defun algebra-interval-sign (e)
  "1 or -1 if the constant E is proved positive or negative, else nil."
  (let ((sign (algebra-constant-verdict e)))
    (if (eql sign 0) nil sign)))

(defun algebra-separated-sign (e)
  (let* ((plain (catch 'algebra-undecided (algebra-plain-constant e)))
         (bits (and plain (algebra-separation-bits plain))))
    (cond ((null plain) nil)
          ((or (null bits) (> bits *algebra-most-bits*))
           (algebra-interval-sign-among plain '(1024 4096)))
          ((algebra-interval-sign-among plain (if (> bits 4096) '(1024))))
          (t (algebra-sign-or-zero plain bits)))))

(defun algebra-sign-or-zero (e bits)
  "The sign of E, which is 0 or in size at least 2^-BITS; more digits where E loses some."
  (loop for width in (list (+ bits 64) (* 2 (+ bits 64)))
        thereis (let* ((*algebra-interval-bits* width)
                       (interval (catch 'no-interval (algebra-i-of e))))
                  (cond ((null interval) nil)
                        ((plusp (car interval)) 1)
                        ((minusp (cdr interval)) -1)
                        ((algebra-i-below-p interval bits) 0)))))

(defun algebra-i-below-p (interval bits)
  "Whether all of INTERVAL is smaller than 2^-BITS."
  (< (max (abs (car interval)) (abs (cdr interval)))
     (ash 1 (max 0 (- *algebra-interval-bits* bits)))))

;;; A constant without absolute values, tangents and the like.  What stands under an even root or
;;; below the line is decided: a zero is written as 0.

(defun algebra-plain-constant (e)
  "E in sums, products, powers, sines and cosines; throws algebra-undecided."
  (cond ((eq e '$%phi) (algebra-golden-ratio))
        ((or (atom e) (algebra-rational-number e)) e)
        (t (case (caar e)
             ((mplus mtimes)
              (simplifya (cons (list (caar e)) (mapcar #'algebra-plain-constant (cdr e))) nil))
             (mexpt (algebra-plain-power (algebra-plain-constant (cadr e)) (caddr e)))
             (mabs (let ((inside (algebra-plain-constant (cadr e))))
                     (mul (algebra-decided-sign inside) inside)))
             (%tan (algebra-plain-ratio '%sin '%cos (cadr e)))
             (%cot (algebra-plain-ratio '%cos '%sin (cadr e)))
             (%sec (algebra-plain-ratio nil '%cos (cadr e)))
             (%csc (algebra-plain-ratio nil '%sin (cadr e)))
             (t e)))))

(defun algebra-plain-ratio (above below angle)
  (flet ((of (f) (if f (simplify (list (list f) angle)) 1)))
    (mul (of above) (algebra-plain-power (of below) -1))))

(defun algebra-plain-power (base exponent)
  (let ((number (algebra-rational-number exponent)))
    (if (or (null number) (algebra-rational-number base)
            (not (or (minusp number) (evenp (denominator number)))))
        (power base exponent)
        (let ((sign (algebra-decided-sign base)))
          (cond ((not (zerop sign)) (if (and (minusp sign) (evenp (denominator number)))
                                        (throw 'algebra-undecided nil)
                                        (power base exponent)))
                ((minusp number) (core-error "division by zero"))
                (t 0))))))

(defun algebra-decided-sign (e)
  (or (algebra-constant-verdict e) (throw 'algebra-undecided nil)))
