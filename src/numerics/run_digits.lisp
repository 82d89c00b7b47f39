;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Runs of many digits, by Taylor series (taylor.lisp): start, times and values are taken exactly,
;;; and rows stand where two runs of other orders and steps agree. There are no events and no
;;; projection: the start has to hold the constraints to all digits, then the motion does. See
;;; numerics-long-rows first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_record" "algebra/size" "core/bigfloats" "forms/rates"
                "numerics/big_values" "numerics/decimals" "numerics/native" "numerics/problem"
                "numerics/program" "numerics/run" "numerics/run_course"
                "numerics/run_integrals" "numerics/run_options" "numerics/run_report"
                "numerics/taylor"))

(defparameter *numerics-most-digits* 1000)

(defun numerics-check-digits (wishes)
  "An error where WISHES has what Taylor series do not serve."
  (let ((digits (numerics-wishes-digits wishes)))
    (unless (and (integerp digits) (<= 2 digits *numerics-most-digits*))
      (core-error "digits is a whole number from 2 to ~d, found ~a" *numerics-most-digits*
                  (core-words (list digits))))
    (loop for (option given default) in
          (list (list "method" (numerics-wishes-method wishes) '$auto)
                (list "tolerance" (numerics-wishes-tolerance wishes) 1d-8)
                (list "first_step" (numerics-wishes-step wishes) 0)
                (list "events" (numerics-wishes-events wishes) '((mlist simp)))
                (list "stop" (numerics-wishes-stop wishes) nil)
                (list "estimate" (numerics-wishes-estimate wishes) nil)
                (list "conditioning" (numerics-wishes-conditioning wishes) nil))
          do (unless (alike1 given default)
               (core-error "with digits = ~d the rows come from Taylor series, two runs of which ~
                            agree; ~a has no place there, leave it out" digits option)))))

(defun numerics-check-impulses (run)
  "An error where a run in double-float numbers ends at an impulse, which series do not see."
  (when (forms-rates-impulses (numerics-simulation-rates run))
    (let ((again (numerics-run-again
                  run (numerics-copied-controls (numerics-simulation-controls run) 1d-8
                                                (numerics-controls-end
                                                 (numerics-simulation-controls run)))
                  (numerics-simulation-wishes run))))
      (numerics-carry-out again)
      (when (numerics-simulation-fault again)
        (core-error "~a" (numerics-simulation-fault again))))))

(defun numerics-long-rows (run start span began)
  "The rows of RUN from START, exact values, over SPAN, as a Maxima list; the derivation of RUN
began at BEGAN."
  (numerics-check-impulses run)
  (let* ((wishes (numerics-simulation-wishes run)) (digits (numerics-wishes-digits wishes))
         (times (numerics-exact-times (numerics-wishes-points wishes) (numerics-read-span span))))
    (numerics-check-exact-start run start (first times) digits)
    (setf (numerics-simulation-constraints run) nil
          (numerics-simulation-began run) (numerics-working-seconds)
          (numerics-simulation-derivation-seconds run) (- (numerics-simulation-began run) began)
          (numerics-simulation-outcome run)
          (numerics-taylor (numerics-simulation-program run) start times digits)
          (numerics-simulation-seconds run) (- (numerics-working-seconds)
                                               (numerics-simulation-began run)))
    (let ((rows (numerics-bigfloat-rows (numerics-simulation-outcome run) times wishes)))
      (numerics-set-big-drifts run rows)
      (numerics-tell-long run rows)
      rows)))

(defun numerics-tell-long (run rows)
  "Says how RUN ended, and gives its report to the result."
  (let* ((outcome (numerics-simulation-outcome run))
         (trouble (numerics-trouble-of-series outcome)))
    (when trouble
      (core-partial "the run ended at t = ~a, before t = ~a: ~a"
                    (core-words (list (aref (numerics-outcome-moment outcome) 0)))
                    (core-words (list (numerics-controls-end (numerics-simulation-controls run))))
                    trouble))
    (numerics-warn-of-drifts run)
    (core-report "run" (numerics-report
                        run (numerics-long-fields run (or trouble "reached the end"))
                        (numerics-residual-fields run rows)))))

(defun numerics-long-fields (run status)
  (let ((agreement (numerics-taylor-outcome-agreement (numerics-simulation-outcome run))))
    (append (list (algebra-field '$method '$taylor)
                  (algebra-field '$digits (numerics-wishes-digits (numerics-simulation-wishes run)))
                  (algebra-field '$status status))
            (when agreement
              (list (algebra-field '$agreement (numerics-few-digits (float agreement 1d0))))))))

(defun numerics-exact-times (points ends)
  "The exact times of rows, the start before them and the end after them."
  (destructuring-bind (from to) ends
    (if (integerp points)
        (loop for k below points
              collect (add from (mul k (div (sub to from) (1- points)))))
        (let ((times (cons from (append (cdr points) (list to)))))
          (remove-duplicates times :test #'alike1)))))

(defun numerics-bigfloat-rows (outcome times wishes)
  "The rows of OUTCOME at those of TIMES that are wanted, and at the end; the numbers are decimals
of so many digits, as an archive keeps them."
  (let ((points (numerics-wishes-points wishes)) (digits (numerics-wishes-digits wishes)))
    (flet ((number (x) (core-decimal-bigfloat (core-bigfloat-rational x) digits)))
      (cons '(mlist simp)
            (loop for row in (numerics-taylor-outcome-rows outcome)
                  for (time . later) on times
                  when (or (integerp points) (null later)
                           (member time (cdr points) :test #'alike1))
                    collect (cons '(mlist simp) (mapcar #'number row)))))))

(defun numerics-trouble-of-series (outcome)
  (unless (eq (numerics-outcome-status outcome) :end)
    (or (numerics-outcome-about outcome) "the series do not reach the end")))

;;; Values in bigfloats

(defun numerics-big-start (start digits)
  "The numbers of START as bigfloats of DIGITS, or rational ones."
  (loop for e in start
        collect (or (algebra-rational-number e)
                    (let (($fpprec digits) (fpprec (core-bits-of-digits digits)))
                      (declare (special fpprec))
                      ($bfloat e)))))

(defun numerics-big-values (run elements digits)
  "The function of a row, (time . states), that gives the values of ELEMENTS."
  (let ((program (numerics-simulation-program run)))
    (numerics-big-routine elements (cons '$t (numerics-program-names program)) digits)))

(defun numerics-exact-residual (run rows digits)
  "The largest residual of a constraint in ROWS, lists (time . states), a rational number; nil
without constraints."
  (let ((elements (loop for key in '($positions $velocities)
                        for output = (cdr (assoc key (forms-rates-outputs
                                                      (numerics-simulation-rates run))))
                        when output append (algebra-output-elements output))))
    (when elements
      (let ((function (numerics-big-values run elements digits)))
        (loop for row in rows
              maximize (loop for value in (funcall function row)
                             maximize (abs (core-bigfloat-rational value))))))))

(defun numerics-start-residual (run start time digits)
  "What START, exact values, violates the constraints by, computed to more than DIGITS; nil without
any."
  (numerics-exact-residual run (list (numerics-big-start (cons time start) (+ digits 10)))
                           (+ digits 10)))

(defun numerics-check-exact-start (run start time digits)
  "An error where START violates the constraints beyond DIGITS."
  (let ((residual (numerics-start-residual run start time digits)))
    (when (and residual (> residual (expt 10 (- digits))))
      (core-error "the start is off the constraints by ~a; for ~d digits give it exactly, such as ~
                   acos(1/3)"
                  (numerics-short-number (numerics-small-double residual)) digits))))

(defun numerics-residual-fields (run rows)
  (let ((residual (and (cdr rows)
                       (numerics-exact-residual run (mapcar #'cdr (cdr rows))
                                                (+ 5 (numerics-wishes-digits
                                                      (numerics-simulation-wishes run)))))))
    (when residual
      (list (algebra-field '$residual (numerics-few-digits (numerics-small-double residual)))))))

;;; Drifts, at the rows

(defun numerics-set-big-drifts (run rows)
  "The relative drifts of integrals over ROWS, a Maxima list."
  (let* ((digits (numerics-wishes-digits (numerics-simulation-wishes run)))
         (integrals (numerics-told-integrals run)))
    (when (and integrals (cdr rows))
      (setf (numerics-simulation-drifting run) (mapcar #'forms-first-integral-name integrals)
            (numerics-simulation-drifts run)
            (let ((function (numerics-big-values
                             run (append (mapcar #'forms-first-integral-value integrals)
                                         (mapcar #'forms-first-integral-size integrals))
                             (+ digits 5))))
              (numerics-big-drifts (loop for row in (cdr rows)
                                         collect (mapcar #'core-bigfloat-rational
                                                         (funcall function (cdr row))))
                                   (length integrals)))))))

(defun numerics-big-drifts (table count)
  "Of COUNT values in each row of TABLE, and behind them their sizes."
  (loop for k below count
        for first = (nth k (first table))
        for drift = (loop for row in table maximize (abs (- (nth k row) first)))
        for size = (max (abs first) (loop for row in table maximize (abs (nth (+ k count) row))))
        collect (numerics-small-double (if (zerop size) drift (/ drift size)))))
