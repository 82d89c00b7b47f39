;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Events: zeros of functions g(t, x) along a run, between its steps by dense output. Each step
;;; is looked at in 17 places, and in parts where they do not show what is between them. Between
;;; two of them a change of sign is a crossing, found to the last place of t; where |g| falls at
;;; one and rises at the other, g may touch 0 or cross it twice, and its least value decides. A
;;; run that starts at a zero does not meet it there. Directions are those along the run. Look
;;; first at numerics-see-events.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/event_samples" "numerics/problem" "numerics/zeros_between"))

(defparameter *numerics-touch* 1d-14
  "A value is 0, as far as rounding tells, below this share of the largest one in the step.")

(defstruct numerics-event
  place                         ; of its function
  direction                     ; 1, -1; 0 where the zero is touched
  moment state)

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

(defparameter *numerics-most-halvings* 10)

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
