;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a run is measured against. A reference value of the end: by Taylor series of 20 digits, two
;;; runs of which agree, where they reach the end in so many steps (a stiff system is beyond them);
;;; else by Radau at a tolerance of 1e-13, whose distance to its run at 1e-12 is the floor below
;;; which no error can be judged, and which dlsode, another method, has to confirm.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/conditioning" "numerics/decimals" "numerics/dlsode" "numerics/problem"
                "numerics/radau" "numerics/step_control" "numerics/taylor"))

(defstruct numerics-reference
  state  ; the end, double-float numbers; nil where nothing could be had
  method ; a sentence
  floor  ; error of the state, at most about
  rows)  ; bigfloats, of Taylor series only

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
