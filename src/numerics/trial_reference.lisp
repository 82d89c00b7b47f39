;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The reference of a trial at its 101 points, and how well double-float numbers can know its end.
;;; Constraints are held in the reference as they are in runs: series are taken only where the start
;;; holds them to all digits. Look first at $numerics_reference_solution.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_record" "forms/rates" "numerics/automatic"
                "numerics/back_to_constraints" "numerics/conditioning" "numerics/decimals"
                "numerics/native" "numerics/observers" "numerics/problem" "numerics/program"
                "numerics/reference" "numerics/run" "numerics/run_course" "numerics/run_digits"
                "numerics/trial"))

(defun numerics-series-begin-p (run start time)
  "Whether START holds the constraints of RUN to the digits of series."
  (let ((residual (numerics-start-residual run start time *numerics-series-digits*)))
    (or (null residual) (<= residual (expt 10 (- *numerics-series-digits*))))))

(defun numerics-reference-of-trial (trial)
  (let ((run (numerics-run-of-trial trial '$radau 1d-8 *numerics-trial-points*))
        (start (numerics-trial-start trial))
        (times (numerics-exact-times *numerics-trial-points* (numerics-trial-ends trial))))
    (with-numerics-program (numerics-simulation-program run)
      (numerics-run-switch-part run)
      (numerics-with-masked-traps
        (numerics-reference-of
         (numerics-simulation-problem run) (numerics-simulation-controls run) start times
         :most-steps (if (and (numerics-series-begin-p run start (first times))
                              (null (forms-rates-impulses (numerics-simulation-rates run))))
                         *numerics-most-series-steps*
                         0)
         :projection (numerics-reference-part run))))))

(defun numerics-reference-part (run)
  "The part of an observer that brings states of RUN back to constraints, and ends it where an
impulse is lost; nil where there is nothing to do."
  (let* ((impulse-parts (numerics-run-impulse-parts run))
         (parts (remove nil (list (and (numerics-simulation-constraints run)
                                      (numerics-projection-part
                                       (numerics-simulation-constraints run)))
                                 (first impulse-parts) (second impulse-parts)))))
    (and parts (numerics-observer parts))))

(defparameter *numerics-share-of-reference* 1/2 "Of the time that a call has left.")

(defun $numerics_reference_solution (trial)
  "Record: method, digits, errors of each state, rows [t, x1, ..]; one that its time did not suffice
for is a part."
  (core-progress "making a reference")
  (multiple-value-bind (reference stop)
      (core-within-on-the-wall *numerics-share-of-reference*
                               (lambda () (numerics-reference-of-trial trial)))
    (when stop (core-report "partial" t))
    (unless reference
      (setq reference (make-numerics-reference :method "no reference: its time was up")))
    (unless (numerics-reference-rows reference)
      (core-warn "~a" (numerics-reference-method reference)))
    (numerics-reference-record reference)))

(defun numerics-reference-record (reference)
  (let ((digits (numerics-reference-digits reference)))
    (flet ((list-of (items) (cons '(mlist simp) items)))
      (algebra-list
       (algebra-field '$method (numerics-reference-method reference))
       (algebra-field '$digits (and digits (numerics-few-digits (coerce digits 'double-float))))
       (algebra-field '$errors (list-of (map 'list #'numerics-few-digits
                                             (numerics-reference-errors reference))))
       (algebra-field '$rows (list-of (mapcar #'list-of (numerics-reference-rows reference))))))))

(defun numerics-read-reference (record)
  "The reference that RECORD describes."
  (flet ((items (key) (cdr ($core_get record key))))
    (make-numerics-reference
     :method ($core_get record '$method) :digits ($core_get record '$digits)
     :errors (map 'numerics-vector #'numerics-double-of-exact (items '$errors))
     :rows (mapcar (lambda (row) (mapcar #'numerics-double-of-exact (cdr row))) (items '$rows)))))

(defun numerics-trial-conditioning (trial)
  "The floor of double-float numbers at the end of TRIAL; nil where a perturbation does not reach
it."
  (let ((run (numerics-trial-run trial)))
    (core-progress "computing the conditioning")
    (numerics-with-masked-traps
      (values (numerics-conditioning #'numerics-automatic (numerics-simulation-problem run)
                                     (numerics-simulation-controls run)
                                     (numerics-simulation-moment run)
                                     (numerics-simulation-state run))))))

(defparameter *numerics-conditioning-seconds* 5 "It may take so long however short the runs were.")

(defun numerics-conditioning-within (seconds trial)
  "As numerics-trial-conditioning, in about the SECONDS of the runs beside it and in what the call
has left; where it is not known by then, nil, and why, which a warning says too."
  (let* ((left (core-seconds-left)) (most (max *numerics-conditioning-seconds* seconds))
         (time (if left (min most (* *numerics-share-of-time* left)) most)))
    (multiple-value-bind (floor stop)
        (core-timed time (lambda () (numerics-trial-conditioning trial)))
      (let ((why (cond (floor nil)
                       (stop (format nil "it was not known after ~,1f s, about the time of all ~
                                          runs or the time left"
                                     time))
                       (t "a run with a perturbation did not reach the end"))))
        (when why (core-warn "conditioning is left out: ~a" why))
        (values floor why)))))
