;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Gauss-Legendre collocation with a fixed step, for conservative systems over long spans: of
;;; order 2s with s stages, symplectic and symmetric (Hairer, Lubich, Wanner, Geometric Numerical
;;; Integration, VIII.6; Hairer, McLachlan, Razakarivony, Achieving Brouwer's law with implicit
;;; Runge-Kutta methods, BIT 48, 2008). The step is that of the controls, else one that the
;;; tolerance allows along the first part of the run; the last one ends at the end of the controls.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals" "numerics/problem" "numerics/step_control"
                "numerics/gauss_stages" "numerics/gauss_first_step" "numerics/gauss_dense"))

(defun numerics-gauss (problem controls moment state observer &key order)
  "Integrates PROBLEM, x' = X(t, x), from STATE at MOMENT; an outcome. ORDER is an even number up to
12; where it is not given, the tolerance chooses."
  (let* ((moment (copy-seq moment)) (state (copy-seq state))
         (stages (/ (or order (numerics-gauss-order controls)) 2))
         (run (numerics-new-gauss-run problem stages controls)))
    (multiple-value-bind (step place)
        (numerics-gauss-fitting-step problem controls moment state stages)
      (cond (place
             (let ((outcome (numerics-gauss-outcome step moment state 0d0 stages)))
               (setf (numerics-outcome-about outcome)
                     (format nil "~a, near t = ~a where the length of the steps is chosen"
                             (numerics-outcome-about outcome) (numerics-short-number place)))
               outcome))
            (t (numerics-gauss-set-step run step)
               (let ((status (numerics-gauss-steps run controls moment state observer)))
                 (numerics-gauss-outcome status moment state step stages)))))))

(defun numerics-gauss-order (controls)
  "The order that reaches the tolerance with the fewest rates, as measured on the double pendulum."
  (let ((tolerance (numerics-controls-relative controls)))
    (cond ((>= tolerance 1d-4) 6)
          ((>= tolerance 1d-6) 8)
          ((>= tolerance 1d-9) 10)
          (t 12))))

(defun numerics-gauss-steps (run controls moment state observer)
  "Steps until the end, or until something goes wrong or somebody stops: the status."
  (declare (type numerics-vector moment state))
  (let ((seen (make-numerics-step :before (copy-seq state) :after state))
        (end (numerics-controls-end controls)))
    (setf (numerics-step-interpolate seen)
          (numerics-gauss-dense run seen controls))
    (when (> (abs (/ (numerics-time-left controls moment) (numerics-gauss-run-step run)))
             *numerics-hopeless-steps*)
      (return-from numerics-gauss-steps :too-slow))
    (loop (when (= (aref moment 0) end) (return :end))
          (let ((fault (numerics-gauss-one-step run controls moment seen)))
            (when fault (return fault)))
          (case (and observer (funcall (the function observer) seen))
            (:stop (replace moment (numerics-step-to seen))
                   (return :stopped))
            (:changed (fill (numerics-gauss-run-low run) 0d0))))))

(defun numerics-gauss-one-step (run controls moment seen)
  "A step of the state in SEEN, at most to the end; nil, or what went wrong."
  (declare (type numerics-vector moment) (optimize speed))
  (let* ((state (numerics-step-after seen)) (counts (numerics-controls-counts controls))
         (most (numerics-controls-most-steps controls)) (end (numerics-controls-end controls))
         (left (numerics-time-left controls moment))
         (last (<= (abs left) (* 1.000001d0 (abs (numerics-gauss-run-step run))))))
    (declare (double-float left) (type (or null fixnum) most))
    (when last (numerics-gauss-set-step run left))
    (replace (numerics-step-from seen) moment)
    (replace (numerics-step-before seen) state)
    (cond ((and most (>= (numerics-counts-steps counts) most)) :most-steps)
          ((numerics-gauss-solve run moment state))
          (t (numerics-gauss-advance run state)
             (incf (numerics-counts-steps counts))
             (cond (last (setf (aref moment 0) end
                               (aref moment 1) 0d0))
                   (t (numerics-advance moment (numerics-gauss-run-step run))))
             (replace (numerics-step-to seen) moment)
             nil))))

(defun numerics-gauss-outcome (status moment state step stages)
  (make-numerics-outcome
   :status status :moment moment :state state :step step
   :about (case status
            (:not-finite "the rates have no finite value in a step of Gauss' method")
            (:no-convergence
             "the stages of Gauss' method do not converge: too long a step, or a stiff system")
            (:too-slow (format nil "steps of ~a, all of one length, would be too many"
                               (numerics-short-number step)))
            (t (format nil "Gauss' method of order ~d, steps of ~a" (* 2 stages)
                       (numerics-short-number step))))))
