;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The error of a step of Radau IIA, from an embedded formula of order 3 that is damped by the
;;; real system, and the next step: the predictive control of Gustafsson (Hairer & Wanner: Solving
;;; Ordinary Differential Equations II, section IV.8).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/sparse" "numerics/linear_solver"
                "numerics/radau_coefficients" "numerics/radau_run" "numerics/radau_newton"))

;;; The error.

(defun numerics-radau-estimate (run)
  "The share of the tolerance that the error of the step takes. The estimate of a first step and of
one after a rejected step is filtered once more: it is too large for stiff parts."
  (numerics-with-radau (run before after z3)
    (numerics-add before z3 after))
  (numerics-radau-weigh run t)
  (numerics-radau-solve-error run (numerics-radau-run-slope run))
  (when (and (>= (numerics-radau-run-largest-error run) 1d0)
             (or (numerics-radau-run-first run) (numerics-radau-run-rejected run)))
    (numerics-with-radau (run before error point moment r1)
      (numerics-add before error point)
      (when (numerics-radau-rates run moment point r1)
        (numerics-radau-solve-error run r1)))))

(defun numerics-radau-solve-error (run slope)
  "The solution of the real system for SLOPE and the combination of stages, and its size."
  (declare (type numerics-vector slope) (optimize speed))
  (numerics-with-radau (run step z1 z2 z3 r2 error single weights mass)
    (numerics-with-radau-numbers (e1 e2 e3)
      (dotimes (i (length error))
        (setf (aref r2 i) (/ (+ (* e1 (aref z1 i)) (* e2 (aref z2 i)) (* e3 (aref z3 i)))
                             step))))
    (if mass
        (numerics-multiply (numerics-matrix-pattern mass) (numerics-matrix-values mass) r2 error)
        (replace error r2))
    (dotimes (i (length error)) (incf (aref error i) (aref slope i)))
    (numerics-solve single error)
    (setf (numerics-radau-run-largest-error run) (numerics-weighted-size weights error))
    nil))

;;; The next step.

(declaim (inline numerics-radau-bounded numerics-radau-divisor))

(defmacro numerics-radau-root (x)
  "The fourth root of X, which is not negative."
  `(sqrt (sqrt (abs ,x))))

(defun numerics-radau-bounded (divisor)
  "A step becomes at most eight times as long, and at least a fifth, of the last."
  (declare (double-float divisor))
  (cond ((> divisor 5d0) 5d0)
        ((< divisor 0.125d0) 0.125d0)
        (t divisor)))

(defun numerics-radau-divisor (run)
  "By what the step is divided, for this error and number of iterations."
  (declare (optimize speed))
  (numerics-with-radau (run largest-error iterations)
    (let* ((most (the (integer 1 100) *numerics-radau-iterations*))
           (safety (min 0.9d0 (/ (* 0.9d0 (+ 1 (* 2 most)))
                                 (+ (the (integer 0 100) iterations) (* 2 most))))))
      (numerics-radau-bounded (/ (numerics-radau-root largest-error) safety)))))

(defun numerics-radau-predict (run)
  "Notes the step after the accepted one."
  (declare (optimize speed))
  (numerics-with-radau (run step largest-error accepted-step accepted-error)
    (let ((divisor (numerics-radau-divisor run)))
      (declare (double-float divisor))
      (unless (numerics-radau-run-first run)
        (let ((predicted (* (/ accepted-step step)
                            (numerics-radau-root (/ (* largest-error largest-error)
                                                    accepted-error))
                            (/ 0.9d0))))
          (setq divisor (max divisor (numerics-radau-bounded predicted)))))
      (setf (numerics-radau-run-accepted-step run) step
            (numerics-radau-run-accepted-error run) (max 0.01d0 largest-error)
            (numerics-radau-run-next-step run) (/ step divisor))
      nil)))

(defun numerics-radau-collocate (run)
  "The collocation polynomial of the accepted step, as differences by Newton."
  (declare (optimize speed))
  (numerics-with-radau (run z1 z2 z3 p1 p2 p3)
    (numerics-with-radau-numbers (c1 c2)
      (dotimes (i (length z1))
        (let* ((first (/ (- (aref z2 i) (aref z3 i)) (- c2 1d0)))
               (middle (/ (- (aref z1 i) (aref z2 i)) (- c1 c2)))
               (second (/ (- middle first) (- c1 1d0))))
          (setf (aref p1 i) first
                (aref p2 i) second
                (aref p3 i) (- second (/ (- middle (/ (aref z1 i) c1)) c2))))))))
