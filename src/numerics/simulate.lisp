;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Simulate: a run of M x' = X(t, x) from start to end, as rows [t, x1, .., xn]. The program of the
;;; rates with its values put in becomes a problem; the method steps; rows, events, drifts and the
;;; constraints look on. A run that does not reach its end is an error that says where and why, and
;;; its rows so far are kept as a part. Look first at numerics-run-wished.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "forms/rates"
                "numerics/dormand_prince" "numerics/events" "numerics/functions" "numerics/native"
                "numerics/observers" "numerics/problem" "numerics/program" "numerics/rate_program"
                "numerics/run_options"))

(defstruct numerics-run
  rates wishes                ; forms-rates with numbers only, numerics-wishes
  problem controls            ; what the method takes
  (moment (numerics-zeros 2) :type numerics-vector) ; the start
  (state (numerics-zeros 0) :type numerics-vector)
  rows events drifts          ; what looks on
  method outcome
  (seconds 0d0))              ; of the method alone

;;; From rates and wishes to a run. A name without a number cannot be run.

(defun numerics-check-closed (rates)
  (let ((open (remove-if (lambda (name)
                           (or (member name '($t $%pi $%e))
                               (member name (forms-rates-states rates) :test #'alike1)))
                         (algebra-inputs-of (forms-rates-elements rates)))))
    (when open
      (core-error "~{~a~^, ~} ha~:[s~;ve~] no value; give parameters = [~a = .., ..] or the key ~
                   values"
                  (mapcar (lambda (name) (core-words (list name))) open) (cdr open)
                  (core-words (list (first open)))))))

(defun numerics-new-run (rates start span wishes)
  "The run of RATES from START over SPAN, everything checked."
  (numerics-check-closed rates)
  (destructuring-bind (from to)
      (mapcar (lambda (e) (numerics-double e "an end of the span")) (numerics-read-span span))
    (let* ((names (forms-rates-states rates))
           (state (map 'numerics-vector
                       (lambda (value name)
                         (numerics-double value (format nil "the start value of ~a"
                                                        (core-words (list name)))))
                       (numerics-read-start start names (numerics-required-names rates)) names))
           (run (make-numerics-run :rates rates :wishes wishes :state state
                                   :moment (numerics-moment from)
                                   :problem (numerics-problem-of-rates rates))))
      (setf (numerics-run-controls run) (numerics-controls-of rates wishes to))
      (numerics-check-start run)
      run)))

(defun numerics-required-names (rates)
  "States whose start must be given: velocities that are not named are 0."
  (remove-if #'numerics-velocity-p (forms-rates-states rates)))

(defun numerics-controls-of (rates wishes end)
  (multiple-value-bind (relative scales)
      (numerics-read-tolerance (numerics-wishes-tolerance wishes) (forms-rates-states rates))
    (make-numerics-controls :end end :relative relative
                            :scales (numerics-scales-with-angles scales rates))))

(defun numerics-scales-with-angles (scales rates)
  "SCALES; that of an angle is 1."
  (loop for name in (forms-rates-states rates)
        for k from 0
        do (when (member name (forms-rates-angles rates) :test #'alike1)
             (setf (aref scales k) 1d0)))
  scales)
