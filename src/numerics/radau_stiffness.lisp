;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Whether a problem has ceased to be stiff: 20 accepted steps in turn with step*radius < 1,
;;; where radius estimates the spectral radius of M^-1 J. It grows out of a few power iterations
;;; at each new Jacobian, which begin where the last ones ended, and never exceeds a norm of the
;;; Jacobian.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/sparse" "numerics/radau_run"))

(defparameter *numerics-power-iterations* 6)
(defparameter *numerics-calm-steps* 20)

(defun numerics-radau-watch-stiffness (run)
  "Makes what the estimate needs, where the controls ask for it; not for a problem with a mass,
which explicit methods cannot take back."
  (numerics-with-radau (run controls mass before)
    (when (and (eq (numerics-controls-looks-for controls) :end-of-stiffness) (null mass))
      (let ((direction (numerics-zeros (length before))))
        (dotimes (i (length direction))
          (setf (aref direction i) (+ 1d0 (mod (* i 0.6180339887498949d0) 1d0))))
        (setf (numerics-radau-run-direction run) direction)))))

(defun numerics-radau-follow-radius (run)
  "The estimate of the spectral radius of a new Jacobian."
  (numerics-with-radau (run pattern direction entries r1)
    (when direction
      (let ((growth 0d0))
        (loop repeat *numerics-power-iterations*
              do (numerics-multiply pattern entries direction r1)
                 (incf growth (numerics-normalise r1 direction)))
        (setf (numerics-radau-run-radius run)
              (min (numerics-largest-row pattern entries r1)
                   (* 1.2d0 (exp (/ growth *numerics-power-iterations*)))))))))

(defun numerics-normalise (x out)
  "X over its length into OUT; the logarithm of the length, of almost nothing where it is 0."
  (declare (type numerics-vector x out))
  (let ((sum 0d0))
    (declare (double-float sum))
    (dotimes (i (length x)) (incf sum (* (aref x i) (aref x i))))
    (cond ((and (> sum 0d0) (numerics-finite-p sum))
           (let ((size (sqrt sum)))
             (dotimes (i (length x)) (setf (aref out i) (/ (aref x i) size)))
             (log size)))
          (t -700d0))))

(defun numerics-largest-row (pattern entries sums)
  "The largest of the sums of sizes in the rows; SUMS is room for them."
  (declare (type numerics-vector entries sums))
  (let ((rows (numerics-pattern-rows pattern)))
    (fill sums 0d0)
    (dotimes (k (length entries)) (incf (aref sums (aref rows k)) (abs (aref entries k))))
    (reduce #'max sums)))

(defun numerics-radau-calm-p (run)
  "Whether the accepted step is the last of so many with step*radius < 1."
  (numerics-with-radau (run direction accepted-step radius)
    (when direction
      (if (< (* (abs accepted-step) radius) 1d0)
          (incf (numerics-radau-run-calm run))
          (setf (numerics-radau-run-calm run) 0))
      (>= (numerics-radau-run-calm run) *numerics-calm-steps*))))
