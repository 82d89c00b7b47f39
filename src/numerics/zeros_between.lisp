;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A zero between two places where a function has different signs, and the least value between two
;;; places: T. R. Chandrupatla, Advances in Engineering Software 28 (1997) 145 (inverse quadratic
;;; interpolation where it is safe, else halves), and the golden section.

(in-package :maxima)

(declaim (inline numerics-same-side-p numerics-quadratic-share))

(defun numerics-same-side-p (x y)
  (declare (double-float x y))
  (or (and (> x 0d0) (> y 0d0)) (and (< x 0d0) (< y 0d0))))

(defun numerics-quadratic-share (a b c fa fb fc)
  "The share of the way from A to B to try next, by a parabola through all where that is safe."
  (declare (double-float a b c fa fb fc))
  (let ((place (/ (- a b) (- c b))) (value (/ (- fa fb) (- fc fb))))
    (if (and (< (* value value) place) (< (* (- 1 value) (- 1 value)) (- 1 place)))
        (+ (* (/ fa (- fb fa)) (/ fc (- fb fc)))
           (* (/ (- c a) (- b a)) (/ fa (- fc fa)) (/ fb (- fc fb))))
        0.5d0)))

(defun numerics-zero-between (function from to tolerance)
  "The end nearer to TO of a piece, no longer than TOLERANCE, of the way FROM .. TO on which
FUNCTION leaves the sign that it has at FROM."
  (declare (double-float from to tolerance) (type function function))
  (let* ((a to) (b from) (c from) (first (funcall function from))
         (fa (funcall function to)) (fb first) (fc first) (share 0.5d0))
    (declare (double-float a b c fa fb fc first share))
    (loop repeat 200
          until (<= (abs (- b a)) tolerance)
          do (let* ((x (+ a (* share (- b a)))) (fx (funcall function x)))
               (declare (double-float x fx))
               (if (eq (numerics-same-side-p fx first) (numerics-same-side-p fa first))
                   (setq c a fc fa)
                   (setq c b fc fb b a fb fa))
               (setq a x fa fx)
               (let ((least (min 0.5d0 (/ tolerance (max (abs (- b a)) tolerance) 2))))
                 (setq share (max least
                                  (min (- 1 least)
                                       (numerics-quadratic-share a b c fa fb fc)))))))
    (if (numerics-same-side-p fa first) b a)))

(defun numerics-least (function from to)
  "The place between FROM and TO where FUNCTION is least, or one where it is not positive."
  (declare (double-float from to) (type function function))
  (let* ((golden (/ (- (sqrt 5d0) 1) 2))
         (x (- to (* golden (- to from)))) (y (+ from (* golden (- to from))))
         (fx (funcall function x)) (fy (funcall function y)))
    (loop repeat 75
          until (<= (min fx fy) 0)
          do (if (< fx fy)
                 (setq to y y x fy fx
                       x (- to (* golden (- to from))) fx (funcall function x))
                 (setq from x x y fx fy
                       y (+ from (* golden (- to from))) fy (funcall function y))))
    (if (< fx fy) x y)))
