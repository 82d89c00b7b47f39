;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What methods with steps of their own choice share: the scales of the norm, the time that is
;;; left, the smallest step, whether the end can be reached, and the first step. It is Hairer's
;;; (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, section II.4),
;;; made independent of the unit of time, and guarded where a start at rest tells little: it grows
;;; from a short trial there, and its own estimate of the error decides whether it stands.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals" "numerics/problem"))

(declaim (inline numerics-scale numerics-time-left numerics-smallest-step))

(defun numerics-scale (before after scale)
  "What the error of a state is measured against; never 0."
  (declare (double-float before after scale))
  (+ (max (abs before) (abs after)) scale least-positive-normalized-double-float))

(defun numerics-time-left (controls moment)
  (declare (type numerics-vector moment))
  (- (- (numerics-controls-end controls) (aref moment 0)) (aref moment 1)))

(defun numerics-smallest-step (moment)
  "No step is shorter: the last places of the two parts of MOMENT."
  (declare (type numerics-vector moment))
  (max 1d-290 (* 1d-31 (abs (aref moment 0)))))

(defun numerics-largest-step (controls moment)
  "Of a run from MOMENT: what is given, or a tenth of the span, so that nothing is stepped over
where the motion begins at rest."
  (or (numerics-controls-largest-step controls)
      (* 0.1d0 (abs (numerics-time-left controls moment)))))

(defun numerics-full-scales (controls size)
  "The scales of all SIZE states; 1 where the controls have none."
  (let ((scales (numerics-controls-scales controls)))
    (if (= (length scales) size)
        scales
        (make-array size :element-type 'double-float :initial-element 1d0))))

(defun numerics-distance (a b scales)
  "max |a_i - b_i|/(|b_i| + s_i)"
  (loop for x across a
        for y across b
        for scale across scales
        maximize (/ (abs (- x y)) (numerics-scale y 0d0 scale))))

(defun numerics-finite-vector-p (vector)
  (declare (type numerics-vector vector) (optimize speed))
  (let ((sum 0d0))
    (declare (double-float sum))
    (dotimes (i (length vector)) (incf sum (* 0d0 (aref vector i))))
    (= sum 0d0)))

;;; Whether the end can be reached

(defstruct numerics-pace
  "Where a run was, its steps since then, and how often in turn the end was too far."
  (steps 0 :type fixnum) (far 0 :type fixnum)
  (moment (numerics-zeros 2) :type (simple-array double-float (*))))

(defparameter *numerics-pace-steps* 10000 "The pace is looked at after so many steps.")
(defparameter *numerics-hopeless-steps* 1d11 "More steps than this would take days.")
(defparameter *numerics-hopeless-looks* 10
  "So often in turn the end has to be too far: in a fast part steps are short for a while.")

(defun numerics-steps-left (pace controls moment)
  "The number of steps to the end at the pace of those since the last look."
  (let* ((left (numerics-time-left controls moment)) (before (numerics-pace-moment pace))
         (way (+ (- (aref moment 0) (aref before 0)) (- (aref moment 1) (aref before 1)))))
    (* (numerics-pace-steps pace) (abs (/ left (if (zerop way) (* 1d-99 left) way))))))

(defun numerics-hopeless (pace controls moment)
  "nil, or a sentence where the end is too many steps away; called once a step."
  (declare (type numerics-vector moment))
  (when (>= (incf (numerics-pace-steps pace)) *numerics-pace-steps*)
    (let ((steps (numerics-steps-left pace controls moment)))
      (setf (numerics-pace-steps pace) 0
            (numerics-pace-far pace) (if (> steps *numerics-hopeless-steps*)
                                         (1+ (numerics-pace-far pace))
                                         0))
      (replace (numerics-pace-moment pace) moment)
      (when (>= (numerics-pace-far pace) *numerics-hopeless-looks*)
        (format nil "at the pace of the last steps the end is ~a steps away"
                (numerics-short-number steps))))))

;;; The first step

(defun numerics-scaled-size (difference state scales)
  "max |d_i|/(|x_i| + s_i) over what has a scale; what begins at 0 and counts by its own size alone
has none."
  (declare (type numerics-vector difference state scales))
  (let ((largest 0d0))
    (dotimes (i (length state) largest)
      (unless (= 0d0 (aref state i) (aref scales i))
        (setq largest (max largest (/ (abs (aref difference i))
                                      (numerics-scale (aref state i) 0d0 (aref scales i)))))))))

(defun numerics-trial-slope (problem moment state slope step)
  "The slope after STEP along SLOPE, and that step: a shorter one where the slope is not finite."
  (let ((later (copy-seq moment)) (point (copy-seq state)) (out (numerics-zeros (length state))))
    (loop repeat 40
          do (replace later moment)
             (numerics-advance later step)
             (map-into point (lambda (x k) (+ x (* step k))) state slope)
             (funcall (numerics-problem-rates problem) later point out)
          until (numerics-finite-vector-p out)
          do (setq step (/ step 10)))
    (values out step)))

(defun numerics-trial-step (size speed span)
  "A step that moves the state by a hundredth of its SIZE, or of a thousandth of its scale."
  (let ((longest (* 1d-4 span)) (way (* 0.01d0 (max size 1d-3))))
    (if (> (* longest speed) way) (/ way speed) longest)))

(defun numerics-step-by-order (speed bend trial goal order)
  "The step whose error is GOAL for a method of ORDER, where SPEED and BEND are the sizes of x' and
x'': at most 100 times the TRIAL that found them."
  (let* ((longest (* 100 trial)) (root (expt goal (/ 1d0 order)))
         (turning (max speed (sqrt bend)))     ; 1/time in which the state moves by its scale
         (changing (min (/ trial) (/ bend (max speed least-positive-normalized-double-float)))))
    (flet ((limited (rate share)               ; goal = share*(rate*step)^order
             (if (> (* longest rate) (* root share))
                 (/ (* root share) rate)
                 longest)))
      (min (limited turning 1d0)
           (if (> speed 0)
               (limited changing (expt (/ changing speed) (/ 1d0 order)))
               longest)))))

(defun numerics-first-step (problem controls moment state slope order)
  "The first step, signed, for a method of ORDER whose error estimate then judges it."
  (let* ((left (numerics-time-left controls moment)) (span (abs left))
         (scales (numerics-full-scales controls (length state)))
         (speed (numerics-scaled-size slope state scales))
         (trial (numerics-trial-step (numerics-scaled-size state state scales) speed span)))
    (multiple-value-bind (later trial)
        (numerics-trial-slope problem moment state slope (* (signum left) trial))
      (incf (numerics-counts-rates (numerics-controls-counts controls)))
      (let ((bend (/ (numerics-scaled-size (map 'numerics-vector #'- later slope) state scales)
                     (abs trial))))
        (* (signum left)
           (min (numerics-largest-step controls moment)
                (if (numerics-finite-p bend)
                    (numerics-step-by-order speed bend (abs trial)
                                            (* 0.01d0 (numerics-controls-relative controls)) order)
                    (abs trial))))))))
