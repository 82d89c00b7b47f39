;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A transfer function on the axis s = i*w, its parameters given: numbers from exact polynomials,
;;; so that neither high powers of w nor close roots spoil them. Points lie denser where gain or
;;; phase turns. The range of w is that of the corners of both polynomials, the slopes of the upper
;;; hull of log|a_k| over k (Newton's polygon), unless it is given. See $numerics_frequency_curve
;;; first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "forms/fixed" "forms/value"
                "numerics/run_options"))

(defstruct numerics-frequency-curve
  function  ; the transfer function with the values, an expression
  points)   ; ((w re im decibel degrees) ..)

(defun $numerics_frequency_curve (response values frequencies)
  (let* ((point (forms-given-point values))
         (polynomials (mapcar (lambda (e) (numerics-coefficients-in-s e point))
                              (cdr ($algebra_ratio response))))
         (ends (or (numerics-given-ends frequencies) (numerics-corner-ends polynomials))))
    (make-numerics-frequency-curve
     :function (numerics-named-by-numbers values response)
     :points (numerics-with-phases
              (numerics-frequency-points
               (lambda (w) (numerics-response-at polynomials w)) ends)))))

(defun numerics-named-by-numbers (values e)
  (let ((pairs (loop for (nil name value) in (cdr values) collect (cons name value))))
    (resimplify (sublis pairs e :test #'eq))))

(defun numerics-coefficients-in-s (e point)
  "The coefficients of the polynomial E in s from the constant one on, rational numbers."
  (let ((e ($expand e)))
    (loop for k from 0 to ($hipow e '|$S|)
          collect (let ((value (catch 'forms-no-value
                                 (forms-fixed-value ($coeff e '|$S| k) point))))
                    (unless value
                      (core-error "the transfer function has no value with the values given; ~
                                   its coefficient ~a needs the values of all parameters"
                                  (core-words (list ($coeff e '|$S| k)))))
                    (/ value (ash 1 forms-digits))))))

;;; The range

(defun numerics-given-ends (frequencies)
  (when frequencies
    (let ((ends (mapcar #'numerics-rational-of (numerics-items frequencies))))
      (unless (and (= (length ends) 2) (every #'identity ends) (< 0 (first ends) (second ends)))
        (core-error "frequencies must be [w1, w2] with 0 < w1 < w2, found ~a"
                    (core-words (list frequencies))))
      (mapcar (lambda (w) (coerce w 'double-float)) ends))))

(defun numerics-rational-of (e)
  "The number E, a constant such as 200*%pi too, as a rational number, or nil."
  (let ((x (numerics-number-or-nil e))) (and x (rational x))))

(defun numerics-corner-ends (polynomials)
  "A hundredth of the least and a hundred times the largest corner."
  (let ((corners (mapcan #'numerics-corners polynomials)))
    (if corners
        (list (expt 10d0 (- (reduce #'min corners) 2)) (expt 10d0 (+ (reduce #'max corners) 2)))
        (list 1d-2 1d2))))

(defun numerics-log10 (x)
  "The decimal logarithm of the positive rational X."
  (flet ((of-integer (n)
           (let ((shift (max 0 (- (integer-length n) 60))))
             (+ (log (coerce (ash n (- shift)) 'double-float) 10d0) (* shift (log 2d0 10d0))))))
    (- (of-integer (numerator x)) (of-integer (denominator x)))))

(defun numerics-corners (coefficients)
  "Decimal logarithms of the corners: where two terms of the upper hull are of one size."
  (let ((places (loop for a in coefficients for k from 0
                      unless (zerop a) collect (cons k (numerics-log10 (abs a)))))
        (hull '()))
    (dolist (place places)
      (loop while (and (cdr hull) (numerics-below-p (first hull) (second hull) place))
            do (pop hull))
      (push place hull))
    (loop for (last before) on hull
          while before
          collect (/ (- (cdr before) (cdr last)) (- (car last) (car before))))))

(defun numerics-below-p (middle left right)
  "Whether MIDDLE lies on or below the line from LEFT to RIGHT."
  (<= (* (- (cdr middle) (cdr left)) (- (car right) (car left)))
      (* (- (cdr right) (cdr left)) (- (car middle) (car left)))))

;;; Values

(defun numerics-polynomial-at (coefficients w)
  "Two values, real and imaginary part at s = i*W, W rational."
  (let ((re 0) (im 0) (power 1))
    (loop for a in coefficients for k from 0
          do (let ((term (* a power)))
               (case (mod k 4)
                 (0 (incf re term))
                 (1 (incf im term))
                 (2 (decf re term))
                 (t (decf im term))))
             (setq power (* power w)))
    (values re im)))

(defun numerics-response-at (polynomials w)
  "(w re im decibel degrees); nil at a pole or where the value is 0 or beyond doubles."
  (let ((x (rational w)))
    (multiple-value-bind (a b) (numerics-polynomial-at (first polynomials) x)
      (multiple-value-bind (c d) (numerics-polynomial-at (second polynomials) x)
        (let ((above (+ (* a a) (* b b))) (below (+ (* c c) (* d d))))
          (unless (or (zerop below) (zerop above))
            (let* ((re (/ (+ (* a c) (* b d)) below)) (im (/ (- (* b c) (* a d)) below))
                   (decibel (* 10 (numerics-log10 (/ above below)))))
              (when (< -3000 decibel 3000)
                (list w (coerce re 'double-float) (coerce im 'double-float) decibel
                      (numerics-degrees re im))))))))))

(defun numerics-degrees (re im)
  (let ((largest (max (abs re) (abs im))))
    (* (/ 180 pi 1d0)
       (atan (coerce (/ im largest) 'double-float) (coerce (/ re largest) 'double-float)))))

(defparameter *numerics-frequency-steps* 240)

(defun numerics-frequency-points (function ends)
  "Points in the order of w, halved where two neighbours differ by more than 1 dB or 5 degrees."
  (let* ((low (log (first ends))) (high (log (second ends)))
         (points (loop for k from 0 to *numerics-frequency-steps*
                       collect (+ low (* (- high low) (/ k *numerics-frequency-steps*))))))
    (remove nil
            (loop for (x y) on points
                  for px = (funcall function (exp x))
                  collect px
                  when y append (numerics-points-between function x px y
                                                         (funcall function (exp y)) 8)))))

(defun numerics-points-between (function x px y py depth)
  (when (and px py (plusp depth) (numerics-far-apart-p px py))
    (let* ((middle (/ (+ x y) 2)) (pm (funcall function (exp middle))))
      (append (numerics-points-between function x px middle pm (1- depth))
              (list pm)
              (numerics-points-between function middle pm y py (1- depth))))))

(defun numerics-far-apart-p (p q)
  (or (> (abs (- (fourth p) (fourth q))) 1)
      (> (abs (numerics-without-whole-turns (- (fifth q) (fifth p)))) 5)))

(defun numerics-without-whole-turns (degrees)
  "DEGREES by whole turns between -180 and 180."
  (- degrees (* 360 (round degrees 360))))

(defun numerics-with-phases (points)
  "POINTS with phases that do not jump by whole turns."
  (let ((phase nil))
    (loop for (w re im decibel degrees) in points
          do (setq phase (if phase
                             (+ phase (numerics-without-whole-turns (- degrees phase)))
                             degrees))
          collect (list w re im decibel phase))))
