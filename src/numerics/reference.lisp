;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a run is measured against: states at given times. By Taylor series of 20 digits, two runs
;;; of which agree, where they reach the end in so many steps (a stiff system is beyond them); else
;;; by Radau at a tolerance of 1e-13, whose distance to its run at 1e-12 is the floor below which no
;;; error can be judged, and whose end dlsode, another method, has to confirm. Radau's steps end at
;;; each of the times, since between its steps a state is known to fewer digits.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/conditioning" "numerics/decimals" "numerics/dlsode"
                "numerics/dormand_prince" "numerics/observers" "numerics/problem"
                "numerics/radau" "numerics/step_control" "numerics/taylor"))

(defstruct numerics-reference
  method ; a sentence
  digits ; to which two runs agree, about, at all times
  errors ; of each state, at most about, a vector
  rows)  ; lists (time . states) of double-float numbers; nil where nothing could be had

(defparameter *numerics-most-series-steps* 5000)

(defun numerics-reference-of (problem controls start times
                              &key (most-steps *numerics-most-series-steps*) projection)
  "The reference for PROBLEM at the end of CONTROLS, from START, exact states at the first of the
exact TIMES; the last of these is the end. With no steps no series are tried. PROJECTION is the part
of an observer that brings states back to constraints, or nil."
  (or (and (plusp most-steps)
           (numerics-series-reference problem controls start times most-steps))
      (numerics-implicit-reference
       problem controls projection (map 'list #'numerics-double-of-exact times)
       (map 'numerics-vector #'numerics-double-of-exact start))))

(defun numerics-double-of-exact (e) (coerce ($float e) 'double-float))

(defun numerics-reference-floor (reference scales)
  "The error that REFERENCE may have itself, in the norm with SCALES."
  (loop for (nil . state) in (numerics-reference-rows reference)
        maximize (loop for x in state
                       for error across (numerics-reference-errors reference)
                       for scale across scales
                       maximize (/ error (numerics-scale x 0d0 scale)))
          into largest
        finally (return (max numerics-unit-roundoff largest))))

;;; Taylor series

(defparameter *numerics-series-digits* 20)
(defparameter *numerics-series-seconds* 20 "No longer series are tried.")

(defun numerics-series-reference (problem controls start times most-steps)
  "The reference by Taylor series, nil where they do not reach the end in this time, or cannot
begin."
  (let ((outcome (numerics-series-outcome problem controls start times most-steps)))
    (when (and outcome (eq (numerics-outcome-status outcome) :end))
      (make-numerics-reference
       :method (numerics-outcome-about outcome)
       :digits (numerics-taylor-outcome-agreement outcome)
       :errors (numerics-errors-of-series outcome (numerics-full-scales controls (length start)))
       :rows (mapcar (lambda (row) (mapcar #'numerics-double-of-exact row))
                     (numerics-taylor-outcome-rows outcome))))))

(defun numerics-series-outcome (problem controls start times most-steps)
  (let ((program (numerics-problem-program problem))
        (scales (map 'list #'rational (numerics-full-scales controls (length start)))))
    (when program
      (first (core-attempt
              (lambda ()
                (core-within *numerics-series-seconds*
                             (lambda ()
                               (numerics-taylor program start times *numerics-series-digits*
                                                :scales scales :most-steps most-steps)))))))))

(defun numerics-errors-of-series (outcome scales)
  "What lies beyond the digits on which two runs agree."
  (let ((share (expt 10d0 (- (numerics-taylor-outcome-agreement outcome))))
        (errors (numerics-zeros (length scales))))
    (dolist (row (numerics-taylor-outcome-rows outcome) errors)
      (loop for x in (rest row)
            for k from 0
            do (setf (aref errors k)
                     (max (aref errors k)
                          (* share (+ (aref scales k) (abs (numerics-double-of-exact x))))))))))

;;; Implicit steps

(defun numerics-implicit-reference (problem controls projection times start)
  (let ((observer (numerics-observer
                   (append (and projection (list projection))
                           (list (numerics-progress-part controls))))))
    (flet ((rows (relative)
             (numerics-rows-by-radau problem (numerics-copied-controls controls relative 0d0)
                                     observer times start)))
      (let* ((fine (rows 1d-13)) (coarse (and fine (rows 1d-12))))
        (if coarse
            (numerics-judged-reference
             fine (numerics-largest-differences fine coarse)
             (numerics-confirmation problem controls observer fine
                                    (if projection 'numerics-dopri 'numerics-dlsode))
             (numerics-full-scales controls (length start)))
            (make-numerics-reference
             :method "no reference: Radau at a tolerance of 1e-13 does not reach the end"))))))

(defun numerics-rows-by-radau (problem controls observer times start)
  "Lists (time . states) at TIMES; nil where one of them is not reached. CONTROLS are used up."
  (let ((state start) (rows (list (cons (first times) (coerce start 'list)))))
    (loop for (from to) on times
          while to
          do (setf (numerics-controls-end controls) to)
             (let ((outcome (numerics-radau problem controls (numerics-moment from) state
                                            observer)))
               (unless (eq (numerics-outcome-status outcome) :end) (return nil))
               (setf (numerics-controls-first-step controls)
                     (and (plusp (abs (numerics-outcome-step outcome)))
                          (abs (numerics-outcome-step outcome))))
               (setq state (numerics-outcome-state outcome))
               (push (cons to (coerce state 'list)) rows))
          finally (return (reverse rows)))))

(defun numerics-largest-differences (rows others)
  "Of each state."
  (let ((largest (numerics-zeros (length (rest (first rows))))))
    (loop for (nil . state) in rows
          for (nil . other) in others
          do (map-into largest (lambda (so-far x y) (max so-far (abs (- x y))))
                       largest state other))
    largest))

(defparameter *numerics-confirming-seconds* 20 "No longer another method is waited for.")

(defun numerics-confirmation (problem controls observer rows other)
  "(name . distance): the method OTHER and how far from the last of ROWS it ends at a tolerance of
1e-11; no distance where it does not come there. It knows no mass matrix."
  (cons (if (eq other 'numerics-dlsode) "dlsode" "DOP853")
        (unless (numerics-problem-mass problem)
          (let* ((end (first (last rows))) (start (first rows))
                 (controls (numerics-copied-controls controls 1d-11 (first end)))
                 (outcome (core-within *numerics-confirming-seconds*
                                       (lambda ()
                                         (funcall other problem controls
                                                  (numerics-moment (first start))
                                                  (coerce (rest start) 'numerics-vector)
                                                  observer)))))
            (when (and outcome (eq (numerics-outcome-status outcome) :end))
              (numerics-distance (numerics-outcome-state outcome)
                                 (coerce (rest end) 'numerics-vector)
                                 (numerics-full-scales controls (length (rest end)))))))))

(defparameter *numerics-most-distance* 1d-4 "Of another method of less accuracy to the reference.")

(defun numerics-judged-reference (rows errors confirmation scales)
  (destructuring-bind (name . distance) confirmation
    (if (and distance (> distance *numerics-most-distance*))
        (make-numerics-reference
         :method (format nil "no reference: Radau at 1e-13 and ~a at 1e-11 end ~a apart" name
                         (numerics-short-number distance)))
        (let* ((reference (make-numerics-reference :errors errors :rows rows))
               (floor (numerics-reference-floor reference scales)))
          (setf (numerics-reference-digits reference) (- (log floor 10))
                (numerics-reference-method reference)
                (format nil "Radau at a tolerance of 1e-13, ~a from that at 1e-12~:[; no other ~
                             method confirms it~;, ~:*~a from ~a at 1e-11~]"
                        (numerics-short-number floor)
                        (and distance (numerics-short-number distance)) name))
          reference))))
