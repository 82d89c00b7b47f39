;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Simulate: the rows [t, x1, .., xn] of a run, the last one where it ended, and what is told of
;;; it: the method, its steps and evaluations, seconds. A run that does not reach its end is an
;;; error that says where and why; its rows so far are kept as a part. Look first at
;;; $numerics_simulate.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "forms/rates" "numerics/decimals"
                "numerics/event_samples" "numerics/events" "numerics/observers"
                "numerics/problem" "numerics/routine" "numerics/run" "numerics/run_course"
                "numerics/run_estimate" "numerics/run_integrals" "numerics/run_of_rates"
                "numerics/run_options" "numerics/run_report"))

;;; What is told

(defun numerics-place-text (run)
  "Where the RUN ended: time and state."
  (let ((outcome (numerics-simulation-outcome run)))
    (format nil "t = ~a (~{~a = ~a~^, ~})"
            (core-words (list (aref (numerics-outcome-moment outcome) 0)))
            (loop for name in (forms-rates-states (numerics-simulation-rates run))
                  for x across (numerics-outcome-state outcome)
                  append (list (numerics-name-text name) (numerics-short-number x))))))

(defun numerics-tell-end (run stop trouble)
  "A RUN that did not come to its end makes a result that is only a part."
  (cond (stop (core-partial "~a; the rows so far are kept as a part" stop))
        (trouble (core-partial "the run ended at ~a, before t = ~a: ~a~@[; ~a~]"
                               (numerics-place-text run)
                               (core-words (list (numerics-controls-end
                                                  (numerics-simulation-controls run))))
                               trouble
                               (numerics-outcome-about (numerics-simulation-outcome run))))))

(defun numerics-tell (run stop)
  "Says how RUN ended, and gives its report to the result; STOP: its time was up."
  (let* ((trouble (and (not stop) (numerics-trouble run)))
         (asked (unless (or stop trouble) (numerics-asked-fields run))))
    (numerics-tell-end run stop trouble)
    (numerics-warn-of-drifts run)
    (numerics-warn-of-events run)
    (core-report "run" (numerics-report
                        run
                        (numerics-course-fields run (numerics-status-words run stop trouble))
                        asked))))

(defun numerics-set-seconds (run began compiled)
  "The time that the derivation of RUN took since BEGAN, and the compilation of programs when the
clock of these showed COMPILED."
  (let ((compilation (- *numerics-compile-seconds* compiled)))
    (setf (numerics-simulation-compile-seconds run) compilation
          (numerics-simulation-derivation-seconds run)
          (- (numerics-simulation-began run) began
             (- compilation (numerics-simulation-compiled-on-the-way run))))))

(defun numerics-rows-of (rows)
  "ROWS as lists of numbers."
  (let ((numbers (numerics-rows-numbers rows)) (width (numerics-rows-width rows)))
    (loop for k below (numerics-rows-count rows)
          collect (loop for j below width collect (aref numbers (+ j (* k width)))))))

(defun numerics-event-rows (run)
  "The rows of the events of RUN in order of time."
  (let ((events (numerics-simulation-events run)))
    (when events
      (loop for event in (reverse (numerics-events-found events))
            collect (cons (aref (numerics-event-moment event) 0)
                          (coerce (numerics-event-state event) 'list))))))

(defun numerics-all-rows (run)
  "All rows of RUN as a Maxima list; those of events stand at their times."
  (let ((rows (merge 'list (numerics-rows-of (numerics-simulation-rows run))
                     (numerics-event-rows run) #'< :key #'first)))
    (cons '(mlist simp)
           (loop for (row next) on rows
                 unless (and next (= (first row) (first next)))
                   collect (cons '(mlist simp) row)))))

(defun numerics-long-p (wishes)
  "Whether rows of many digits are wanted, and can be had."
  (unless (eql (numerics-wishes-digits wishes) 0)
    (core-require "numerics/run_digits")
    (numerics-check-digits wishes)
    t))

(defun numerics-rows-of-run (run began compiled)
  "Makes RUN; its rows, as a Maxima list."
  (numerics-watch-integrals run)
  (let ((stop (numerics-carry-out run)))
    (numerics-set-seconds run began compiled)
    (numerics-tell run stop)
    (numerics-all-rows run)))

;;; For Maxima.

(defun $numerics_simulate (began rates values start span wishes)
  "The rows of RATES with VALUES, equations name = number, from START over SPAN as the WISHES say;
BEGAN is the time when their derivation began."
  (with-algebra-program
    (let ((compiled *numerics-compile-seconds*) (long (numerics-long-p wishes)))
      (multiple-value-bind (run exact)
          (numerics-settled-run rates values start span wishes)
        (if long
            (numerics-long-rows run exact span began)
            (numerics-rows-of-run run began compiled))))))
