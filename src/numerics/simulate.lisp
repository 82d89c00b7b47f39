;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Simulate: the rows [t, x1, .., xn] of a run, the last one where it ended, and what is told of it:
;;; the method, its steps and evaluations, seconds. A run that does not reach its end is an error that
;;; says where and why; its rows so far are kept as a part. Look first at $numerics_simulate.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "algebra/program_record" "forms/rates" "numerics/events"
                "numerics/native" "numerics/observers" "numerics/problem" "numerics/rate_program"
                "numerics/run" "numerics/run_options"))

;;; Methods

(defparameter *numerics-methods*
  '(($auto "numerics/automatic" numerics-automatic)
    ($dop853 "numerics/dormand_prince" numerics-dopri)
    ($radau "numerics/radau" numerics-radau)
    ($gauss "numerics/gauss" numerics-gauss)
    ($dlsode "numerics/dlsode" numerics-dlsode))
  "Each row: the word for a method, its part and its function.")

(defparameter *numerics-implicit-methods* '($auto $radau $dlsode) "Those that take a jacobian.")

(defun numerics-method (run)
  (destructuring-bind (part function)
      (cdr (assoc (numerics-wishes-method (numerics-run-wishes run)) *numerics-methods*))
    (core-require part)
    function))

(defun numerics-prepare-method (run)
  "The function of the method, with what it needs of the problem."
  (let ((problem (numerics-run-problem run))
        (method (numerics-wishes-method (numerics-run-wishes run))))
    (cond ((member method *numerics-implicit-methods*) (numerics-add-jacobian problem))
          ((numerics-problem-mass problem)
           (core-error "the method ~a takes x' = .., and here M x' = .. with a matrix M that is not ~
                        divided out; take method = radau" (core-spelling method))))
    (numerics-method run)))

;;; What looks on

(defun numerics-guard-part (run)
  "A part of an observer that stops where a pivot is lost."
  (lambda (step)
    (let ((lost (numerics-lost-pivot run (numerics-step-to step) (numerics-step-after step))))
      (when lost
        (setf (numerics-run-lost run) lost)
        :stop))))

(defun numerics-run-observer (run)
  (numerics-observer
   (remove nil
           (list (and (numerics-run-guards run) (numerics-guard-part run))
                 (and (numerics-run-events run)
                      (lambda (step) (numerics-see-events (numerics-run-events run) step)))
                 (lambda (step) (numerics-see-rows (numerics-run-rows run) step))
                 (numerics-progress-part (numerics-run-controls run))))))

(defparameter *numerics-share-of-time* 98/100
  "Of the time that a call has left, so that the rows of a run that takes longer can be kept.")

(defun numerics-carry-out (run)
  "Makes the RUN; the sentence of the stop where its time was up."
  (let* ((method (numerics-prepare-method run)) (observer (numerics-run-observer run))
         (began (numerics-seconds)) (outcome nil))
    (multiple-value-bind (value stop)
        (core-within *numerics-share-of-time*
                     (lambda ()
                       (numerics-with-masked-traps
                         (setq outcome (funcall method (numerics-run-problem run)
                                                (numerics-run-controls run)
                                                (copy-seq (numerics-run-moment run))
                                                (copy-seq (numerics-run-state run)) observer)))))
      (declare (ignore value))
      (setf (numerics-run-seconds run) (- (numerics-seconds) began)
            (numerics-run-outcome run) outcome)
      (when outcome (numerics-finish-rows (numerics-run-rows run) outcome))
      stop)))

;;; What is told

(defun numerics-trouble (run)
  "Why the RUN did not come to its end, a phrase; nil where it did."
  (let ((outcome (numerics-run-outcome run)))
    (if (numerics-run-lost run)
        (format nil "the mass matrix becomes singular: of the inertia of ~a ~,2g of 1 is left when ~
                     the bodies beyond it yield"
                (first (numerics-run-lost run)) (second (numerics-run-lost run)))
        (ecase (numerics-outcome-status outcome)
          ((:end :stopped) nil)
          (:not-finite "the right-hand side has no finite value there")
          (:smallest-step "the step became as small as the last place of t: the solution or its ~
                           right-hand side is singular there")
          (:no-convergence "the equations of the implicit steps could not be solved")
          (:most-steps "the most steps that were allowed are made")
          (:singular "the matrix of the implicit steps is singular")))))

(defun numerics-place-text (run)
  "Where the RUN ended: time and state."
  (let ((outcome (numerics-run-outcome run)))
    (format nil "t = ~a (~{~a = ~,6g~^, ~})"
            (core-words (list (aref (numerics-outcome-moment outcome) 0)))
            (loop for name in (forms-rates-states (numerics-run-rates run))
                  for x across (numerics-outcome-state outcome)
                  append (list (numerics-name-text name) x)))))

(defun numerics-tell-end (run stop)
  "A RUN that did not come to its end makes a result that is only a part."
  (let ((trouble (or stop (numerics-trouble run))))
    (cond (stop (core-partial "~a; the rows so far are kept as a part" stop))
          (trouble (core-partial "the run ended at ~a, before t = ~a: ~a~@[; ~a~]"
                                 (numerics-place-text run)
                                 (core-words (list (numerics-controls-end
                                                    (numerics-run-controls run))))
                                 (format nil trouble)
                                 (numerics-outcome-about (numerics-run-outcome run)))))))

(defun numerics-report (run)
  "What stands beside the rows, as a Maxima list."
  (let ((counts (numerics-controls-counts (numerics-run-controls run)))
        (outcome (numerics-run-outcome run)))
    (apply #'algebra-list
           (append
            (list (algebra-field '$method (numerics-wishes-method (numerics-run-wishes run)))
                  (algebra-field '$tolerance (numerics-controls-relative
                                              (numerics-run-controls run)))
                  (algebra-field '$steps (numerics-counts-steps counts))
                  (algebra-field '$rejected (numerics-counts-rejected counts))
                  (algebra-field '$rates (numerics-counts-rates counts))
                  (algebra-field '$jacobians (numerics-counts-jacobians counts))
                  (algebra-field '$factorisations (numerics-counts-factorisations counts))
                  (algebra-field '$seconds (numerics-run-seconds run)))
            (when (and outcome (numerics-outcome-about outcome))
              (list (algebra-field '$about (numerics-outcome-about outcome))))))))

(defun numerics-rows-list (rows)
  "ROWS as a Maxima list of lists."
  (let ((numbers (numerics-rows-numbers rows)) (width (numerics-rows-width rows)))
    (apply #'algebra-list
           (loop for k below (numerics-rows-count rows)
                 collect (apply #'algebra-list
                                (loop for j below width
                                      collect (aref numbers (+ j (* k width)))))))))

;;; For Maxima.

(defun $numerics_simulate (rates values start span wishes)
  "The rows of RATES with VALUES, equations name = number, from START over SPAN as the WISHES say."
  (with-algebra-program
    (let* ((pairs (numerics-parameter-pairs (numerics-value-pairs values) rates))
           (run (numerics-new-run (numerics-run-rates rates pairs nil) pairs start span wishes))
           (stop (numerics-carry-out run)))
      (numerics-tell-end run stop)
      (core-report "run" (numerics-report run))
      (numerics-rows-list (numerics-run-rows run)))))
