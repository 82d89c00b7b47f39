;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What methods are tried on: a system with its start and span, derived and compiled once. An
;;; attempt is one method at one tolerance; its bare run only steps to the end, another one looks at
;;; rows and integrals on the way. Look first at $numerics_trial.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes"
                "numerics/jacobian" "numerics/native" "numerics/problem"
                "numerics/routine" "numerics/run" "numerics/run_of_rates" "numerics/run_options"))

(defstruct numerics-trial
  run                  ; ready to be made, by auto, of which all others are made
  start                ; exact values of the states
  ends                 ; exact ends of the span
  derivation-seconds compile-seconds)

(defparameter *numerics-trial-points* 101 "Rows of a run, the start and 100 points.")

(defun numerics-trial-wishes (method tolerance points)
  (make-numerics-wishes :method method :points points :tolerance tolerance
                        :events '((mlist simp)) :digits 0 :step 0))

(defun $numerics_trial (began rates values start span)
  "The trial of RATES with VALUES from START over SPAN; their derivation began at BEGAN."
  (with-algebra-program
    (let ((compiled *numerics-compile-seconds*))
      (multiple-value-bind (run exact)
          (numerics-settled-run rates values start span
                                (numerics-trial-wishes '$auto 1d-8 *numerics-trial-points*)
                                :how :compiled)
        (numerics-add-jacobian (numerics-simulation-problem run) :how :compiled)
        (let ((compilation (- *numerics-compile-seconds* compiled)))
          (make-numerics-trial
           :run run :start exact :ends (numerics-read-span span)
           :derivation-seconds (- (numerics-working-seconds) began compilation)
           :compile-seconds compilation))))))

(defun numerics-trial-end (trial)
  (numerics-controls-end (numerics-simulation-controls (numerics-trial-run trial))))

(defun numerics-trial-scales (trial tolerance)
  "The s_i of the norm of TOLERANCE."
  (numerics-controls-scales
   (numerics-controls-of (numerics-simulation-rates (numerics-trial-run trial))
                         (numerics-trial-wishes '$auto tolerance 2) (numerics-trial-end trial))))

(defun numerics-run-of-trial (trial method tolerance points)
  "A run of TRIAL by METHOD at TOLERANCE with POINTS, which is still to be made."
  (let ((run (numerics-trial-run trial))
        (wishes (numerics-trial-wishes method tolerance points)))
    (numerics-run-again run
                        (numerics-controls-of (numerics-simulation-rates run) wishes
                                              (numerics-trial-end trial))
                        wishes)))

(defun numerics-bare-run (trial method tolerance)
  "One that only steps to the end."
  (numerics-run-of-trial trial method tolerance
                         (list '(mlist simp) (second (numerics-trial-ends trial)))))

(defun numerics-watched-run (trial method tolerance)
  "One with 100 points."
  (numerics-run-of-trial trial method tolerance *numerics-trial-points*))
