;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a run is measured against. A reference value of the end: by Taylor series of 20 digits, two
;;; runs of which agree, where they reach the end in so many steps (a stiff system is beyond them);
;;; else by Radau at a tolerance of 1e-13, whose distance to its run at 1e-12 is the floor below
;;; which no error can be judged, and which dlsode, another method, has to confirm.
;;; And an estimate of the error of one run: its distance to another at a finer tolerance or step.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/conditioning" "numerics/decimals" "numerics/dlsode" "numerics/problem"
                "numerics/radau" "numerics/step_control" "numerics/taylor"
                "numerics/trajectories"))

(defstruct numerics-reference
  state  ; the end, double-float numbers; nil where nothing could be had
  method ; a sentence
  floor  ; error of the state, at most about
  rows)  ; bigfloats, of Taylor series only

(defun numerics-distance (a b scales)
  "max |a_i - b_i|/(|b_i| + s_i)"
  (loop for x across a
        for y across b
        for scale across scales
        maximize (/ (abs (- x y)) (numerics-scale y 0d0 scale))))

(defun numerics-reference-of (problem controls start times &key (digits 20) (most-steps 5000))
  "The reference for PROBLEM at the end of CONTROLS, from START, exact states at the first of the
exact TIMES; the last of these is the end."
  (let ((outcome (and (numerics-problem-program problem)
                      (numerics-taylor (numerics-problem-program problem) start times digits
                                       :scales (map 'list #'rational
                                                    (numerics-full-scales controls (length start)))
                                       :most-steps most-steps))))
    (if (and outcome (eq (numerics-outcome-status outcome) :end))
        (make-numerics-reference
         :state (numerics-outcome-state outcome) :method (numerics-outcome-about outcome)
         :floor numerics-unit-roundoff :rows (numerics-taylor-outcome-rows outcome))
        (numerics-implicit-reference
         problem controls (numerics-moment (coerce ($float (first times)) 'double-float))
         (map 'numerics-vector (lambda (e) (coerce ($float e) 'double-float)) start)))))

(defun numerics-implicit-reference (problem controls moment state)
  (flet ((run (method relative)
           (let ((outcome (funcall method problem
                                   (numerics-copied-controls controls relative
                                                             (numerics-controls-end controls))
                                   moment state (constantly nil))))
             (and (eq (numerics-outcome-status outcome) :end) (numerics-outcome-state outcome)))))
    (let* ((fine (run #'numerics-radau 1d-13)) (coarse (run #'numerics-radau 1d-12))
           (other (and fine coarse (null (numerics-problem-mass problem))
                       (run #'numerics-dlsode 1d-11)))
           (scales (numerics-full-scales controls (length state))))
      (if (and fine coarse)
          (numerics-judged-reference fine (numerics-distance coarse fine scales)
                                     (and other (numerics-distance other fine scales)))
          (make-numerics-reference
           :method "no reference: Radau at a tolerance of 1e-13 does not reach the end")))))

(defparameter *numerics-most-distance* 1d-4 "Of another method of less accuracy to the reference.")

(defun numerics-judged-reference (state floor distance)
  (if (and distance (> distance *numerics-most-distance*))
      (make-numerics-reference
       :method (format nil "no reference: Radau at 1e-13 and dlsode at 1e-11 end ~a apart"
                       (numerics-short-number distance)))
      (make-numerics-reference
       :state state :floor (max numerics-unit-roundoff floor)
       :method (format nil "Radau at a tolerance of 1e-13, ~a from that at 1e-12~@[, ~a from ~
                            dlsode at 1e-11~]"
                       (numerics-short-number floor)
                       (and distance (numerics-short-number distance))))))

;;; The error of a run.

(defun numerics-global-error (method problem controls moment state outcome)
  "Two values: an estimate of the error of OUTCOME, that METHOD gave from STATE at MOMENT, and a
sentence how it was had. Nil where the other run does not reach the end. A first step that was given
is halved: it may be the only one."
  (let* ((relative (numerics-controls-relative controls))
         (other (max 1d-13 (/ relative 50))) (finer (< other (* 0.2d0 relative)))
         (step (numerics-controls-first-step controls))
         (copy (numerics-copied-controls controls (if finer other (* 10 relative))
                                         (aref (numerics-outcome-moment outcome) 0))))
    (when step (setf (numerics-controls-first-step copy) (/ step 2)))
    (let ((second (funcall method problem copy moment state (constantly nil))))
      (when (eq (numerics-outcome-status second) :end)
        (values (numerics-distance (numerics-outcome-state outcome) (numerics-outcome-state second)
                                   (numerics-full-scales controls (length state)))
                (format nil "~:[at most about the distance to a run at ten times the~;distance to ~
                             a run at a finer~] tolerance~:[~; and half the step~]"
                        finer step))))))
