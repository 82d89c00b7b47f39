;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Events: zeros of functions g(t, x) along a run, between its steps by dense output. Each step
;;; is looked at in 17 places, and in parts where they do not show what is between them. Between
;;; two of them a change of sign is a crossing, found to the last place of t; where |g| falls at
;;; one and rises at the other, g may touch 0 or cross it twice, and its least value decides. A
;;; run that starts at a zero does not meet it there. Directions are those along the run. Look
;;; first at numerics-see-events.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/zeros_between"))

(defparameter *numerics-touch* 1d-14
  "A value is 0, as far as rounding tells, below this share of the largest one in the step.")

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

(defstruct numerics-event
  place                         ; of its function
  direction                     ; 1, -1; 0 where the zero is touched
  moment state)

(defun numerics-new-events (functions size directions stops project)
  "What looks for zeros of FUNCTIONS, as many as there are DIRECTIONS, along states of SIZE."
  (let ((count (length directions)))
    (make-numerics-events
     :functions functions :count count :directions directions :stops stops :project project
     :samples (numerics-zeros (* 17 count)) :values (numerics-zeros count)
     :state (numerics-zeros size))))

;;; Values along a step

(declaim (inline numerics-step-moment))
(defun numerics-step-moment (step share out)
  "The moment at SHARE of STEP, into OUT."
  (declare (double-float share) (type numerics-vector out))
  (let ((from (numerics-step-from step)) (to (numerics-step-to step)))
    (setf (aref out 0) (aref from 0) (aref out 1) (aref from 1))
    (numerics-advance out (* share (+ (- (aref to 0) (aref from 0))
                                      (- (aref to 1) (aref from 1)))))))

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

(defun numerics-quiet-p (events place side)
  "Whether all samples of the function PLACE are on its SIDE, and farther from 0 than they vary."
  (declare (fixnum place side) (optimize speed))
  (let* ((last (numerics-sample events place 0)) (least (* side last)) (way 0d0))
    (declare (double-float last least way))
    (loop for k of-type fixnum from 1 to 16
          do (let ((value (numerics-sample events place k)))
               (incf way (abs (- value last)))
               (setq last value
                     least (min least (* side value)))))
    (> least way)))

(defun numerics-side-after (events step place share)
  "The sign of the function PLACE shortly after SHARE of STEP, where it is 0."
  (numerics-side (aref (numerics-events-at events step (+ share (/ 1024d0))) place)))

(defun numerics-begin-events (events step)
  "The sides at the start of a run: where a value is 0 there, as far as rounding tells, the side to
which it goes."
  (setf (numerics-events-sides events)
        (coerce (loop for place below (numerics-events-count events)
                      for first = (numerics-sample events place 0)
                      collect (if (<= (abs first)
                                      (* *numerics-touch* (numerics-largest-sample events place)))
                                  (numerics-side-after events step place 0d0)
                                  (numerics-side first)))
                'vector)))

;;; Where |g| may touch 0 or cross it twice between two samples

(defun numerics-sample-slope (events place k)
  "By how much the function PLACE rises at the sample K, in 1/16 of the step: five-point formulas."
  (declare (fixnum place k) (optimize speed))
  (let ((middle (max 2 (min 14 k))))
    (flet ((sum (a b c d e)
             (declare (double-float a b c d e))
             (/ (+ (* a (numerics-sample events place (- middle 2)))
                   (* b (numerics-sample events place (- middle 1)))
                   (* c (numerics-sample events place middle))
                   (* d (numerics-sample events place (+ middle 1)))
                   (* e (numerics-sample events place (+ middle 2))))
                12d0)))
      (declare (inline sum))
      (case (- k middle)
        (-2 (sum -25d0 48d0 -36d0 16d0 -3d0))
        (-1 (sum -3d0 -10d0 18d0 -6d0 1d0))
        (0 (sum 1d0 -8d0 0d0 8d0 -1d0))
        (1 (sum -1d0 6d0 -18d0 10d0 3d0))
        (t (sum 3d0 -16d0 36d0 -48d0 25d0))))))

(defun numerics-may-turn-p (events place side k)
  "Whether |g| falls before the sample K and rises after the next, both so fast that it may come to
0 at a corner between them."
  (flet ((rise (k)
           (* side (- (numerics-sample events place (1+ k)) (numerics-sample events place k)))))
    (let* ((falls (if (> k 0) (- (rise (1- k))) (rise 1)))
           (rises (if (< k 15) (rise (1+ k)) falls)))
      (and (> falls 0) (> rises 0)
           (> (* side (numerics-sample events place k))
              (* *numerics-touch* (numerics-largest-sample events place)))
           (<= (* side (numerics-sample events place k)) (* 2 (max falls rises)))
           (<= (* side (numerics-sample events place (1+ k))) (* 2 (max falls rises)))))))

(defun numerics-may-dip-p (events place side k)
  "Whether |g| falls at the sample K, rises at the next, and its tangents there meet below 0. (A
zero at the sample K itself was met before it.)"
  (let ((left (* side (numerics-sample events place k)))
        (right (* side (numerics-sample events place (1+ k))))
        (falls (- (* side (numerics-sample-slope events place k))))
        (rises (* side (numerics-sample-slope events place (1+ k)))))
    (and (>= falls 0) (>= rises 0) (> (+ falls rises) 0)
         (> left (* *numerics-touch* (numerics-largest-sample events place)))
         (<= (- left (* falls (/ (+ (- left right) rises) (+ falls rises)))) 0))))

;;; Zeros, as (share place direction)

(defun numerics-share-tolerance (step)
  "The share of STEP that the last place of the time is, at least 1e-16 and at most 1e-4."
  (let* ((begin (aref (numerics-step-from step) 0)) (end (aref (numerics-step-to step) 0))
         (last-place (* double-float-epsilon (max (abs begin) (abs end)))))
    (max 1d-16 (/ last-place (max (abs (- end begin)) (* 1d4 last-place)
                                  least-positive-normalized-double-float)))))

(defun numerics-crossing (events step place from to)
  "The share of STEP at which the function PLACE leaves its side at FROM, not after TO."
  (let ((function (numerics-event-function events step place)))
    (numerics-zero-between function
                           (if (zerop (funcall function from)) (+ from (/ 1024d0)) from)
                           to (numerics-share-tolerance step))))

(defun numerics-dip (events step place side k)
  "Two crossings after the sample K, or a touch, or nothing."
  (let* ((from (/ k 16d0)) (to (/ (1+ k) 16d0))
         (value (numerics-event-function events step place))
         (least (numerics-least (lambda (share) (* side (funcall value share))) from to))
         (depth (* side (funcall value least))))
    (cond ((<= (abs depth) (* *numerics-touch* (numerics-largest-sample events place)))
           (list (list least place 0)))
          ((< depth 0)
           (list (list (numerics-crossing events step place from least) place (- side))
                 (list (numerics-crossing events step place least to) place side))))))

(defun numerics-zero-at (events step place side k)
  "The zero of the function PLACE at the sample K itself; its new side is noted."
  (let* ((share (/ k 16d0)) (after (numerics-side-after events step place share)))
    (setf (svref (numerics-events-sides events) place) after)
    (unless (zerop side)
      (list (list share place (if (= after side) 0 (- side)))))))

(defun numerics-crossing-after (events step place k direction)
  "The crossing between the sample K and the next; none where the function has a pole."
  (let* ((share (numerics-crossing events step place (/ k 16d0) (/ (1+ k) 16d0)))
         (value (aref (numerics-events-at events step share) place)))
    (when (<= (abs value) (max (abs (numerics-sample events place k))
                               (abs (numerics-sample events place (1+ k)))))
      (list (list share place direction)))))

(defun numerics-zeros-after (events step place k)
  "Zeros of the function PLACE after the sample K up to the next; its new side is noted. Where it
has no value there is no zero, and it begins anew after that."
  (let* ((sides (numerics-events-sides events)) (side (svref sides place))
         (here (numerics-sample events place k)) (there (numerics-sample events place (1+ k)))
         (new (numerics-side there)))
    (cond ((not (and (numerics-finite-p here) (numerics-finite-p there)))
           (setf (svref sides place) (if (numerics-finite-p there) new 0))
           nil)
          ((zerop new) (numerics-zero-at events step place side (1+ k)))
          ((= new side)
           (when (or (numerics-may-dip-p events place side k)
                     (numerics-may-turn-p events place side k))
             (numerics-dip events step place side k)))
          (t (setf (svref sides place) new)
             (unless (zerop side)
               (numerics-crossing-after events step place k new))))))

(defun numerics-wanted-zeros (events step)
  "Zeros in STEP in the order of time, of the wanted directions."
  (sort (loop for place below (numerics-events-count events)
              for wanted in (numerics-events-directions events)
              for side = (svref (numerics-events-sides events) place)
              unless (numerics-quiet-p events place side)
                append (loop for k below 16
                             append (remove-if-not
                                     (lambda (zero) (or (zerop wanted) (= wanted (third zero))))
                                     (numerics-zeros-after events step place k))))
        #'< :key #'first))

;;; Parts of a step. Between samples the cubic through four of them is compared with g; where it is
;;; far off, the halves of the step are sampled. What changes as much within a billionth of the step
;;; is rounding, or a jump.

(defparameter *numerics-most-halvings* 10)
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

(defun numerics-zeros-in-step (events step halvings)
  "Zeros in STEP, which may be halved so often, in the order of time."
  (numerics-sample-events events step)
  (unless (numerics-events-sides events) (numerics-begin-events events step))
  (let ((seen (numerics-seen-p events step)))
    (unless (or seen (plusp halvings)) (incf (numerics-events-unseen events)))
    (if (or seen (zerop halvings))
        (numerics-wanted-zeros events step)
        (loop for from in '(0d0 0.5d0)
              append (loop for (share . zero) in (numerics-zeros-in-step
                                                  events (numerics-half-of-step step from)
                                                  (1- halvings))
                           collect (cons (+ from (* 0.5d0 share)) zero))))))

;;; What the observer does

(defun numerics-event-of (events step share place direction)
  (let ((moment (numerics-zeros 2)) (state (copy-seq (numerics-events-state events))))
    (numerics-step-moment step share moment)
    (funcall (numerics-step-interpolate step) share state)
    (when (numerics-events-project events)
      (funcall (numerics-events-project events) moment state))
    (make-numerics-event :place place :direction direction :moment moment :state state)))

(defun numerics-end-step (step share event)
  "STEP ends at EVENT, at SHARE of it."
  (let ((between (numerics-step-interpolate step)))
    (setf (numerics-step-interpolate step)
          (lambda (part out) (funcall between (* part share) out))
          (numerics-step-nodes step) nil)
    (replace (numerics-step-to step) (numerics-event-moment event))
    (replace (numerics-step-after step) (numerics-event-state event))))

(defun numerics-undo-step (step)
  "STEP ends where it begins."
  (let ((before (copy-seq (numerics-step-before step))))
    (setf (numerics-step-interpolate step) (lambda (share out) share (replace out before)))
    (replace (numerics-step-to step) (numerics-step-from step))
    (replace (numerics-step-after step) before)))

(defun numerics-zeros-of-step (events step)
  "Zeros in STEP, of which more parts are looked at until this proves useless."
  (setf (numerics-events-unseen events) 0)
  (prog1 (numerics-zeros-in-step events step
                                 (if (numerics-events-vague events) 2 *numerics-most-halvings*))
    (when (> (numerics-events-unseen events) 16) (setf (numerics-events-vague events) t))))

(defun numerics-see-events (events step)
  "Notes the zeros in STEP; :stop where one of them ends the run, and STEP ends there."
  (loop for (share place direction) in (numerics-zeros-of-step events step)
        for event = (numerics-event-of events step share place direction)
        do (push event (numerics-events-found events))
           (when (nth place (numerics-events-stops events))
             (numerics-end-step step share event)
             (return :stop))))
