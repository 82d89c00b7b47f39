;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a run says of itself beside its rows: how it ended, what it cost, how far its integrals
;;; drift and its constraints are off; and the warning where a drift is out of proportion. See
;;; numerics-report first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_record" "forms/rates" "numerics/back_to_constraints"
                "numerics/decimals" "numerics/drifts" "numerics/event_samples" "numerics/events"
                "numerics/problem" "numerics/run" "numerics/run_options"))

(defun numerics-rounded-seconds (seconds)
  "SECONDS to the microsecond."
  (numerics-rounded (/ (round (* 1000000 (rational (max 0d0 seconds)))) 1000000)))

(defun numerics-status-words (run stop trouble)
  "How RUN ended: the sentence STOP where it was stopped, the phrase TROUBLE where it failed."
  (cond (stop)
        (trouble)
        ((eq (numerics-outcome-status (numerics-simulation-outcome run)) :stopped)
         "stopped by an event")
        (t "reached the end")))

(defun numerics-report (run course asked)
  "What stands beside the rows, as a Maxima list, first the fields COURSE; ASKED: fields that were
asked for."
  (cons '(mlist simp)
        (append course
                (numerics-seconds-fields run)
                (numerics-drift-fields run)
                asked
                (numerics-remark-fields run))))

(defun numerics-course-fields (run status)
  (let* ((controls (numerics-simulation-controls run)) (counts (numerics-controls-counts controls)))
    (list (algebra-field '$method (numerics-wishes-method (numerics-simulation-wishes run)))
          (algebra-field '$tolerance (numerics-controls-relative controls))
          (algebra-field '$status status)
          (algebra-field '$steps (numerics-counts-steps counts))
          (algebra-field '$rejected (+ (numerics-counts-rejected counts)
                                       (numerics-counts-not-finite counts)))
          (algebra-field '$rates (numerics-counts-rates counts))
          (algebra-field '$jacobians (numerics-counts-jacobians counts))
          (algebra-field '$factorisations (numerics-counts-factorisations counts)))))

(defun numerics-seconds-fields (run)
  (flet ((seconds (key value) (algebra-field key (numerics-rounded-seconds value))))
    (list (seconds '$seconds (numerics-simulation-seconds run))
          (seconds '$derivation_seconds (numerics-simulation-derivation-seconds run))
          (seconds '$compile_seconds (numerics-simulation-compile-seconds run)))))

(defun numerics-named-drifts (run)
  "((name . relative drift) ..)"
  (let ((drifts (numerics-simulation-drifts run)))
    (mapcar #'cons (numerics-simulation-drifting run)
            (if (listp drifts) drifts (numerics-relative-drifts drifts)))))

(defun numerics-drift-fields (run)
  (append
   (list (algebra-field '$drifts
                        (cons '(mlist simp)
                               (loop for (name . drift) in (numerics-named-drifts run)
                                     collect (algebra-field name (numerics-few-digits drift))))))
   (when (numerics-simulation-untold run)
     (list (algebra-field '$untold (cons '(mlist simp) (numerics-simulation-untold run)))))
   (numerics-loss-fields run)
   (when (numerics-simulation-constraints run)
     (list (algebra-field '$residual (numerics-few-digits
                                      (numerics-constraints-largest
                                       (numerics-simulation-constraints run))))))))

(defparameter *numerics-notable-share* 1d-3 "Of a pivot: three digits are lost where it is less.")

(defun numerics-loss-fields (run)
  "loss = [name = what is left of 1 of its pivot at worst, ..], where that is little."
  (let ((losses (loop for (name) in (forms-rates-guards (numerics-simulation-rates run))
                      for share across (or (numerics-simulation-shares run) (vector))
                      when (< share *numerics-notable-share*)
                        collect (algebra-field name (numerics-few-digits share)))))
    (when losses (list (algebra-field '$loss (cons '(mlist simp) losses))))))

(defun numerics-remark-fields (run)
  (let* ((outcome (numerics-simulation-outcome run))
         (about (remove nil (list (and outcome (numerics-outcome-about outcome))
                                  (numerics-suggestion run)))))
    (append (numerics-event-fields run)
            (when about (list (algebra-field '$about (format nil "~{~a~^; ~}" about)))))))

(defparameter *numerics-long-run* 1000 "Steps of an explicit method.")

(defun numerics-suggestion (run)
  "A sentence where RUN is long and conservative and never stiff; nil elsewhere."
  (let ((counts (numerics-controls-counts (numerics-simulation-controls run))))
    (when (and (member (numerics-wishes-method (numerics-simulation-wishes run)) '($auto $dop853))
               (> (numerics-counts-steps counts) *numerics-long-run*)
               (= (numerics-counts-factorisations counts) 0)
               (intersection (numerics-simulation-drifting run) (mapcar #'core-symbol
                                                                        '("energy" "H"))))
      "the energy is constant and the run is long: method = gauss would keep it over any time")))

(defun numerics-event-fields (run)
  "events = [[t, number of the event, 1 upwards, -1 downwards, 0 where it touches 0], ..]"
  (let ((events (numerics-simulation-events run)))
    (when events
      (list (algebra-field
             '$events
             (cons '(mlist simp)
                    (loop for event in (reverse (numerics-events-found events))
                          collect (algebra-list (aref (numerics-event-moment event) 0)
                                                (1+ (numerics-event-place event))
                                                (numerics-event-direction event)))))))))

;;; A drift that is out of proportion

(defun numerics-accuracy (run)
  "The relative tolerance of RUN, or what its digits stand for."
  (let ((digits (numerics-wishes-digits (numerics-simulation-wishes run))))
    (if (plusp digits)
        (max 1d-300 (numerics-small-double (expt 10 (- digits))))
        (numerics-controls-relative (numerics-simulation-controls run)))))

(defparameter *numerics-worrying-drift* 1000 "So many times the tolerance a drift is worth a line.")

(defun numerics-warn-of-drifts (run)
  (let ((relative (numerics-accuracy run)))
    (loop for (name . drift) in (numerics-named-drifts run)
          do (when (> drift (* *numerics-worrying-drift* relative))
               (core-warn-later
                "~a, which is constant, drifts by ~a of its size, at a tolerance of ~a"
                (numerics-name-text name) (numerics-short-number drift)
                (numerics-short-number relative))))))

(defun numerics-warn-of-events (run)
  (let ((events (numerics-simulation-events run)))
    (when (and events (numerics-events-vague events))
      (core-warn-later "the events change too fast along the steps: some zeros may be missing"))))
