;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a run can be asked for beside its rows: an estimate of their error, the distance to a
;;; second run at a finer tolerance or step, and the floor below which no run on double-float
;;; numbers comes but by luck (conditioning.lisp). See numerics-error-fields first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_record" "numerics/conditioning"
                "numerics/decimals" "numerics/native" "numerics/observers" "numerics/problem"
                "numerics/run" "numerics/run_course" "numerics/run_options"
                "numerics/step_control"))

(defun numerics-asked-fields (run)
  "The fields of the report that the wishes of RUN ask for; RUN has come to its end."
  (let ((wishes (numerics-simulation-wishes run)))
    (append (when (numerics-wishes-estimate wishes)
              (numerics-within-time '$error (lambda () (numerics-error-fields run))))
            (when (numerics-wishes-conditioning wishes)
              (numerics-within-time '$floor (lambda () (numerics-floor-fields run)))))))

(defun numerics-within-time (key function)
  "The fields that FUNCTION gives; KEY says so where the time is up."
  (multiple-value-bind (fields stop) (numerics-within-share function)
    (if stop (list (algebra-field key "its time was up")) fields)))

;;; The error

(defun numerics-error-fields (run)
  (multiple-value-bind (other how) (numerics-other-run run)
    (let ((stop (numerics-carry-out other)))
      (if (or stop (numerics-trouble other))
          (list (algebra-field '$error "the second run did not reach the end"))
          (list (algebra-field '$error (numerics-few-digits (numerics-rows-distance run other)))
                (algebra-field '$error_by how))))))

(defun numerics-other-run (run)
  "Two values: a run of the same, at a finer tolerance or step where there is one, and what it is."
  (multiple-value-bind (controls how) (numerics-other-controls run)
    (values (numerics-run-again run controls (numerics-simulation-wishes run)) how)))

(defun numerics-other-controls (run)
  "A step is halved: it may be the only one. The tolerance of a method with one step stays, since
the order follows from it."
  (let* ((controls (numerics-simulation-controls run))
         (relative (numerics-controls-relative controls))
         (finest (max *numerics-least-tolerance* (/ relative 100)))
         (fixed (eq (numerics-wishes-method (numerics-simulation-wishes run)) '$gauss))
         (step (if fixed
                   (numerics-outcome-step (numerics-simulation-outcome run))
                   (numerics-controls-first-step controls)))
         (factor (cond (fixed 1) ((< finest (/ relative 5)) (/ finest relative)) (t 10)))
         (copy (numerics-copied-controls controls (* factor relative)
                                         (numerics-controls-end controls))))
    (when step (setf (numerics-controls-first-step copy) (abs (/ step 2))))
    (values copy
            (if fixed
                "distance to the run with half the step"
                (format nil "~:[~;at most about the ~]distance to a run at a tolerance of ~a"
                        (> factor 1)
                        (numerics-short-number (* factor relative)))))))

(defun numerics-rows-distance (run other)
  "The largest distance of rows of RUN and OTHER at the same time, and of their ends."
  (let* ((rows (numerics-simulation-rows run)) (others (numerics-simulation-rows other))
         (scales (numerics-full-scales (numerics-simulation-controls run)
                                       (length (numerics-simulation-state run)))))
    (flet ((distance (j k)
             (numerics-distance (numerics-row-state rows j) (numerics-row-state others k) scales)))
      (max (loop for k below (min (1- (numerics-rows-count rows)) (1- (numerics-rows-count others)))
                 maximize (distance k k))
           (distance (1- (numerics-rows-count rows)) (1- (numerics-rows-count others)))))))

;;; The floor

(defun numerics-floor-fields (run)
  (let ((controls (numerics-copied-controls
                   (numerics-simulation-controls run)
                   (numerics-controls-relative (numerics-simulation-controls run))
                   (aref (numerics-outcome-moment (numerics-simulation-outcome run)) 0))))
    (multiple-value-bind (floor since)
        (numerics-with-masked-traps
          (numerics-conditioning (numerics-method run) (numerics-simulation-problem run) controls
                                 (numerics-simulation-moment run) (numerics-simulation-state run)))
      (if floor
          (list (algebra-field '$floor (numerics-few-digits floor))
                (algebra-field '$floor_since (numerics-few-digits since)))
          (list (algebra-field '$floor "a run with a perturbation did not reach the end"))))))
