;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions g(t, x) along a step of a run, by dense output: what looks for their zeros, values
;;; at any share of a step, samples at its sixteenths, and whether these show what is between them.
;;; The zeros are found in events.lisp. Look first at numerics-sample-events and numerics-seen-p.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"))

(defstruct numerics-events
  functions                     ; (moment x out): g_1, .. into OUT
  (count 0 :type fixnum)
  directions                    ; list: 1 for crossings upwards, -1 downwards, 0 for all zeros
  stops                         ; list: whether the run ends there
  project                       ; nil, or (moment x): brings a state back to the constraints
  (found '())                   ; the last one first
  (unseen 0 :type fixnum)       ; shortest parts of the last step in which zeros may be missed
  (vague nil)                   ; whether these were many in some step
  (sides nil)                   ; vector: signs of g_1, .. before the step; nil before the run
  (samples (numerics-zeros 0) :type numerics-vector) ; of each, k/16 of the step
  (values (numerics-zeros 0) :type numerics-vector)
  (moment (numerics-zeros 2) :type numerics-vector)
  (state (numerics-zeros 0) :type numerics-vector))

(defun numerics-new-events (functions size directions stops project)
  "What looks for zeros of FUNCTIONS, as many as there are DIRECTIONS, along states of SIZE."
  (let ((count (length directions)))
    (make-numerics-events
     :functions functions :count count :directions directions :stops stops :project project
     :samples (numerics-zeros (* 17 count)) :values (numerics-zeros count)
     :state (numerics-zeros size))))

;;; Values along a step

(defun numerics-events-at (events step share)
  "The values of all functions at SHARE of STEP."
  (declare (double-float share))
  (let ((moment (numerics-events-moment events)) (state (numerics-events-state events))
        (values (numerics-events-values events)))
    (numerics-step-moment step share moment)
    (funcall (the function (numerics-step-interpolate step)) share state)
    (funcall (the function (numerics-events-functions events)) moment state values)
    values))

(defun numerics-event-function (events step place)
  "The function PLACE as one of the share of STEP."
  (lambda (share) (aref (the numerics-vector (numerics-events-at events step share)) place)))

(defparameter *numerics-sixteenths* (loop for k to 16 collect (/ k 16d0)))

(defun numerics-sample-events (events step)
  (declare (optimize speed))
  (let ((samples (numerics-events-samples events)) (count (numerics-events-count events)))
    (loop for share in *numerics-sixteenths*
          for k of-type fixnum from 0
          do (let ((values (numerics-events-at events step share)))
               (declare (type numerics-vector values))
               (dotimes (place count)
                 (setf (aref samples (+ k (the fixnum (* 17 place)))) (aref values place)))))))

(declaim (inline numerics-sample numerics-side))

(defun numerics-sample (events place k)
  (declare (fixnum place k))
  (aref (numerics-events-samples events) (+ k (the fixnum (* 17 place)))))

(defun numerics-side (x)
  (declare (double-float x))
  (cond ((> x 0d0) 1) ((< x 0d0) -1) (t 0)))

(defun numerics-largest-sample (events place)
  (loop with largest = 0d0
        for k to 16
        for size = (abs (numerics-sample events place k))
        do (when (and (numerics-finite-p size) (> size largest)) (setq largest size))
        finally (return largest)))

;;; Parts of a step. Between samples the cubic through four of them is compared with g; where it is
;;; far off, the halves of the step are sampled. What changes as much within a billionth of the step
;;; is rounding, or a jump.

(defparameter *numerics-share-unseen* 0.02d0
  "Of the range of the samples, that a cubic may be off.")

(defun numerics-cubic-between (events place k)
  "The cubic through the samples K - 1, .. K + 2 of the function PLACE, 0.41 of the way from K on."
  (flet ((g (j) (numerics-sample events place (+ k j))))
    (+ (* -0.0641035d0 (g -1)) (* 0.6613605d0 (g 0)) (* 0.4595895d0 (g 1)) (* -0.0568465d0 (g 2)))))

(defun numerics-range-of-samples (events place)
  (loop for k to 16
        for value = (numerics-sample events place k)
        minimize value into low
        maximize value into high
        finally (return (- high low))))

(defun numerics-seen-p (events step)
  "Whether the samples of all functions show what is between them."
  (loop for k in '(1 4 8 11 14)
        for share = (/ (+ k 0.41d0) 16)
        for values = (copy-seq (numerics-events-at events step share))
        for unseen = (loop for place below (numerics-events-count events)
                           when (> (abs (- (aref values place)
                                           (numerics-cubic-between events place k)))
                                   (* *numerics-share-unseen*
                                      (numerics-range-of-samples events place)))
                             collect place)
        never (and unseen
                   (let ((near (numerics-events-at events step (+ share 1d-9))))
                     (loop for place in unseen
                             thereis (< (abs (- (aref near place) (aref values place)))
                                        (* *numerics-share-unseen*
                                           (numerics-range-of-samples events place))))))))

(defun numerics-half-of-step (step from)
  "The half of STEP that begins at the share FROM, as a step."
  (let ((half (copy-numerics-step step)) (to (+ from 0.5d0)))
    (setf (numerics-step-from half) (numerics-zeros 2)
          (numerics-step-to half) (numerics-zeros 2)
          (numerics-step-interpolate half)
          (lambda (share out)
            (funcall (the function (numerics-step-interpolate step)) (+ from (* 0.5d0 share)) out)))
    (numerics-step-moment step from (numerics-step-from half))
    (numerics-step-moment step to (numerics-step-to half))
    half))
