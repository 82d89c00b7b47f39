;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; One attempt, a line of a table of errors against run time: a bare run, repeated where it is
;;; short, whose end is compared with the reference; then one that looks at 100 points of its dense
;;; output and at the integrals. What fails or takes too long says why in words. See
;;; numerics-measured-attempt first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals" "numerics/observers" "numerics/problem"
                "numerics/program" "numerics/reference" "numerics/run" "numerics/run_course"
                "numerics/run_integrals" "numerics/run_report" "numerics/step_control"
                "numerics/trial"))

(defstruct numerics-contest
  trial methods tolerances     ; these from the loosest to the tightest
  seconds                      ; that an attempt may take
  scales                       ; of the norm in which errors are measured
  (reference nil) (floor nil)) ; what this may be off itself

(defstruct numerics-attempt
  method tolerance
  (run nil)                    ; the first bare run
  (seconds '())                ; of all, sorted
  (error nil) (largest nil) (drifts '())
  (untold '())                 ; integrals without a drift, and why
  (status nil)                 ; a sentence
  (reached nil)                ; whether it came to the end
  (interrupted nil))

(defun numerics-measured-attempt (contest method tolerance)
  "The attempt of METHOD at TOLERANCE."
  (let* ((attempt (make-numerics-attempt :method method :tolerance tolerance))
         (refusal (numerics-refusal
                   (lambda ()
                     (when (numerics-make-bare-run contest attempt)
                       (numerics-repeat-bare-run contest attempt)
                       (numerics-look-at-attempt contest attempt))))))
    (when refusal
      (setf (numerics-attempt-status attempt) refusal
            (numerics-attempt-reached attempt) nil))
    attempt))

(defun numerics-refusal (function)
  "Calls FUNCTION; the text of the error that ends it, without the name of what runs, or nil."
  (let ((text (nth-value 1 (core-caught function))))
    (and text (core-unnamed text))))

(defun numerics-limited (seconds)
  (lambda (function) (core-timed seconds function)))

;;; The bare run

(defun numerics-make-bare-run (contest attempt)
  "Whether the bare run of ATTEMPT comes to the end within its time."
  (let ((run (numerics-bare-run (numerics-contest-trial contest) (numerics-attempt-method attempt)
                                (numerics-attempt-tolerance attempt))))
    (setf (numerics-attempt-run attempt) run)
    (multiple-value-bind (stop interrupted)
        (numerics-carry-out run (numerics-limited (numerics-contest-seconds contest)))
      (setf (numerics-attempt-seconds attempt) (list (numerics-simulation-seconds run))
            (numerics-attempt-interrupted attempt) interrupted)
      (let ((trouble (cond (interrupted stop)
                           (stop (format nil "more than ~a s"
                                         (numerics-short-number
                                          (numerics-contest-seconds contest))))
                           (t (numerics-placed-trouble run)))))
        (setf (numerics-attempt-status attempt) (or trouble "reached the end")
              (numerics-attempt-reached attempt) (null trouble))))))

(defun numerics-placed-trouble (run)
  "When and why RUN ended too early; nil where it did not."
  (let ((trouble (numerics-trouble run)))
    (and trouble
         (format nil "ended at t = ~a: ~a"
                 (numerics-short-number (aref (numerics-outcome-moment
                                               (numerics-simulation-outcome run)) 0))
                 trouble))))

(defparameter *numerics-repeated-seconds* 0.2d0 "Shorter runs are repeated.")

(defun numerics-repetitions (seconds)
  "Two values: how many times are taken of a run of SECONDS, for about half a second, and of how
many runs each is the mean, since the clock ticks in microseconds."
  (if (< seconds *numerics-repeated-seconds*)
      (values (max 5 (min 11 (floor 0.5d0 (max seconds 1d-6))))
              (max 1 (min 10 (floor 1d-3 (max seconds 1d-6)))))
      (values 0 0)))

(defun numerics-repeat-bare-run (contest attempt)
  "The first of runs that are repeated counts for nothing: memory was still cold."
  (multiple-value-bind (times runs)
      (numerics-repetitions (first (numerics-attempt-seconds attempt)))
    (when (plusp times)
      (setf (numerics-attempt-seconds attempt)
            (sort (loop repeat times collect (numerics-mean-seconds contest attempt runs)) #'<)))))

(defun numerics-mean-seconds (contest attempt runs)
  (/ (loop repeat runs
           sum (let ((run (numerics-bare-run (numerics-contest-trial contest)
                                             (numerics-attempt-method attempt)
                                             (numerics-attempt-tolerance attempt))))
                 (numerics-carry-out-again attempt run #'numerics-within-share)
                 (numerics-simulation-seconds run)))
     runs))

(defun numerics-carry-out-again (attempt run within)
  "Makes RUN, of an ATTEMPT that came to the end before; whether it did so again."
  (multiple-value-bind (stop interrupted) (numerics-carry-out run within)
    (when interrupted (setf (numerics-attempt-interrupted attempt) t))
    (null stop)))

(defun numerics-quantile (sorted share)
  "Of the list SORTED, between its members by their distance."
  (let ((place (* share (1- (length sorted)))))
    (multiple-value-bind (k rest) (floor place)
      (let ((low (nth k sorted)) (high (or (nth (1+ k) sorted) (nth k sorted))))
        (+ low (* rest (- high low)))))))

;;; What the run was worth

(defparameter *numerics-patience* 10
  "Times what the bare run may take that which looks on may take.")

(defun numerics-look-at-attempt (contest attempt)
  "Compares with the reference at the end and at 100 points, and looks at the integrals."
  (let ((run (numerics-watched-run (numerics-contest-trial contest)
                                   (numerics-attempt-method attempt)
                                   (numerics-attempt-tolerance attempt))))
    (numerics-compare-end contest attempt)
    (with-numerics-program (numerics-simulation-program run)
      (numerics-watch-integrals run))
    (setf (numerics-attempt-untold attempt) (numerics-simulation-untold run))
    (when (numerics-carry-out-again attempt run
                                    (numerics-limited (* *numerics-patience*
                                                         (numerics-contest-seconds contest))))
      (setf (numerics-attempt-drifts attempt) (numerics-named-drifts run))
      (numerics-compare-points contest attempt (numerics-simulation-rows run)))))

(defun numerics-distance-to (row state contest)
  "Of STATE to ROW of the reference, in the norm of CONTEST."
  (numerics-distance state (coerce (rest row) 'numerics-vector) (numerics-contest-scales contest)))

(defun numerics-compare-end (contest attempt)
  (let ((rows (numerics-reference-rows (numerics-contest-reference contest))))
    (when rows
      (setf (numerics-attempt-error attempt)
            (numerics-distance-to (first (last rows))
                                  (numerics-outcome-state (numerics-simulation-outcome
                                                           (numerics-attempt-run attempt)))
                                  contest)))))

(defun numerics-compare-points (contest attempt found)
  "FOUND, numerics-rows, against the reference at the same times."
  (let ((rows (numerics-reference-rows (numerics-contest-reference contest))))
    (when rows
      (setf (numerics-attempt-largest attempt)
            (max (numerics-attempt-error attempt)
                 (loop for row in rows
                       for k = (numerics-number-of-row row rows)
                       when (< k (numerics-rows-count found))
                         maximize (numerics-distance-to row (numerics-row-state found k)
                                                        contest)))))))

(defun numerics-number-of-row (row rows)
  "The number of the row of a run at the time of ROW, one of those of a reference, ROWS, which may
have fewer."
  (let ((start (first (first rows))) (end (first (first (last rows)))))
    (round (* (1- *numerics-trial-points*) (/ (- (first row) start) (- end start))))))
