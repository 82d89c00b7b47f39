;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Simulate: the rows [t, x1, .., xn] of a run, the last one where it ended, and what is told of it:
;;; the method, its steps and evaluations, seconds. A run that does not reach its end is an error that
;;; says where and why; its rows so far are kept as a part. Look first at $numerics_simulate.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "algebra/program_record" "forms/rates"
                "numerics/decimals" "numerics/drifts" "numerics/events" "numerics/jacobian"
                "numerics/native" "numerics/observers" "numerics/problem"
                "numerics/back_to_constraints" "numerics/rate_program" "numerics/routine"
                "numerics/run" "numerics/run_integrals" "numerics/run_options"
                "numerics/run_report"))

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
      (cdr (assoc (numerics-wishes-method (numerics-simulation-wishes run)) *numerics-methods*))
    (core-require part)
    function))

(defun numerics-prepare-method (run)
  "The function of the method, with what it needs of the problem."
  (let ((problem (numerics-simulation-problem run))
        (method (numerics-wishes-method (numerics-simulation-wishes run))))
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
        (setf (numerics-simulation-lost run) lost)
        :stop))))

(defun numerics-run-observer (run)
  (numerics-observer
   (remove nil
           (list (and (numerics-simulation-constraints run)
                      (numerics-projection-part (numerics-simulation-constraints run)))
                 (and (numerics-simulation-guards run) (numerics-guard-part run))
                 (and (numerics-simulation-events run)
                      (lambda (step) (numerics-see-events (numerics-simulation-events run) step)))
                 (and (numerics-simulation-drifts run)
                      (lambda (step) (numerics-see-drifts (numerics-simulation-drifts run) step)))
                 (lambda (step) (numerics-see-rows (numerics-simulation-rows run) step))
                 (numerics-progress-part (numerics-simulation-controls run))))))

(defparameter *numerics-share-of-time* 9/10
  "Of the time that a call has left, so that the rows of a run that takes longer can be kept.")

(defun numerics-carry-out (run)
  "Makes the RUN; the sentence of the stop where its time was up or the person interrupted it."
  (let* ((method (numerics-prepare-method run)) (observer (numerics-run-observer run))
         (began (numerics-seconds)) (compiled *numerics-compile-seconds*) (outcome nil))
    (setf (numerics-simulation-began run) began)
    (multiple-value-bind (value stop)
        (core-within *numerics-share-of-time*
                     (lambda ()
                       (numerics-interruptible
                         (numerics-with-masked-traps
                           (setq outcome (funcall method (numerics-simulation-problem run)
                                                  (numerics-simulation-controls run)
                                                  (copy-seq (numerics-simulation-moment run))
                                                  (copy-seq (numerics-simulation-state run))
                                                  observer))))))
      (when (eq value :interrupted)
        (setq stop (format nil "interrupted~@[ at ~a~]" *core-doing*)))
      (let ((compilation (- *numerics-compile-seconds* compiled)))
        (setf (numerics-simulation-seconds run) (- (numerics-seconds) began compilation)
              (numerics-simulation-compiled-on-the-way run) compilation
              (numerics-simulation-outcome run) outcome))
      (when outcome (numerics-finish-rows (numerics-simulation-rows run) outcome))
      stop)))

;;; What is told

(defun numerics-trouble (run)
  "Why the RUN did not come to its end, a phrase; nil where it did."
  (let ((outcome (numerics-simulation-outcome run)))
    (if (and (numerics-simulation-constraints run)
             (numerics-constraints-singular (numerics-simulation-constraints run)))
        "the constraints depend on each other there"
        (and (or (numerics-simulation-lost run)
                 (not (member (numerics-outcome-status outcome) '(:end :stopped))))
             (numerics-trouble-of-steps run outcome)))))

(defun numerics-trouble-of-steps (run outcome)
  (if (numerics-simulation-lost run)
      (format nil "the mass matrix becomes singular: of the inertia of ~a ~,2g of 1 is left when ~
                   the bodies beyond it yield"
              (first (numerics-simulation-lost run)) (second (numerics-simulation-lost run)))
      (format nil (ecase (numerics-outcome-status outcome)
                    (:not-finite "the right-hand side has no finite value there")
                    (:smallest-step "the step became as small as the last place of t: the solution ~
                                     or its right-hand side is singular there")
                    (:no-convergence "the equations of the implicit steps could not be solved")
                    (:inconsistent "the algebraic equations do not hold there")
                    (:most-steps "the most steps that were allowed are made")
                    (:singular "the matrix of the implicit steps is singular")))))

(defun numerics-place-text (run)
  "Where the RUN ended: time and state."
  (let ((outcome (numerics-simulation-outcome run)))
    (format nil "t = ~a (~{~a = ~a~^, ~})"
            (core-words (list (aref (numerics-outcome-moment outcome) 0)))
            (loop for name in (forms-rates-states (numerics-simulation-rates run))
                  for x across (numerics-outcome-state outcome)
                  append (list (numerics-name-text name) (numerics-short-number x))))))

(defun numerics-tell-end (run stop)
  "A RUN that did not come to its end makes a result that is only a part."
  (let ((trouble (or stop (numerics-trouble run))))
    (cond (stop (core-partial "~a; the rows so far are kept as a part" stop))
          (trouble (core-partial "the run ended at ~a, before t = ~a: ~a~@[; ~a~]"
                                 (numerics-place-text run)
                                 (core-words (list (numerics-controls-end
                                                    (numerics-simulation-controls run))))
                                 trouble
                                 (numerics-outcome-about (numerics-simulation-outcome run)))))))

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
    (apply #'algebra-list
           (loop for (row next) on rows
                 unless (and next (= (first row) (first next)))
                   collect (apply #'algebra-list row)))))

(defun numerics-mass-wanted (wishes)
  "How far M is divided out: Radau's method takes it as it is."
  (if (eq (numerics-wishes-method wishes) '$radau) nil :regular))

;;; For Maxima.

(defun $numerics_simulate (began rates values start span wishes)
  "The rows of RATES with VALUES, equations name = number, from START over SPAN as the WISHES say;
BEGAN is the time when their derivation began."
  (with-algebra-program
    (let* ((compiled *numerics-compile-seconds*)
           (pairs (numerics-parameter-pairs (numerics-value-pairs values) rates))
           (rates (numerics-with-quadratures
                   (numerics-run-rates rates pairs (numerics-mass-wanted wishes)) start))
           (run (numerics-new-run rates pairs (numerics-start-values rates start values) span
                                  wishes))
           (stop (progn (numerics-watch-integrals run) (numerics-carry-out run))))
      (numerics-set-seconds run began compiled)
      (numerics-tell-end run stop)
      (numerics-warn-of-drifts run)
      (core-report "run" (numerics-report run (numerics-status-words run stop
                                                                     (numerics-trouble run))))
      (numerics-all-rows run))))
