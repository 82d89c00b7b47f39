;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A run under way: its method, what looks on at each step, and how it ended. Look first at
;;; numerics-carry-out.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/rates" "numerics/back_to_constraints" "numerics/dead_points"
                "numerics/decimals" "numerics/drifts" "numerics/element_words"
                "numerics/event_samples" "numerics/events" "numerics/jacobian"
                "numerics/lost_impulses" "numerics/native" "numerics/observers"
                "numerics/poles" "numerics/problem" "numerics/routine" "numerics/run"
                "numerics/run_options" "numerics/switches"))

;;; Methods

(defparameter *numerics-methods*
  '(($auto "numerics/automatic" numerics-automatic)
    ($dop853 "numerics/dormand_prince" numerics-dopri)
    ($radau "numerics/radau" numerics-radau)
    ($gauss "numerics/gauss" numerics-gauss)
    ($dlsode "numerics/dlsode" numerics-dlsode numerics-load-dlsode))
  "Each row: the word for a method, its part, its function, and one that loads what else it needs.")

(defparameter *numerics-implicit-methods* '($auto $radau $dlsode) "Those that take a jacobian.")

(defun numerics-method (run)
  (destructuring-bind (part function &optional loader)
      (cdr (assoc (numerics-wishes-method (numerics-simulation-wishes run)) *numerics-methods*))
    (core-require part)
    (when loader (funcall loader))
    function))

(defun numerics-prepare-method (run)
  "The function of the method, with what it needs of the problem."
  (let ((problem (numerics-simulation-problem run))
        (method (numerics-wishes-method (numerics-simulation-wishes run))))
    (when (eq method '$dop853)
      (setf (numerics-controls-looks-for (numerics-simulation-controls run)) :much-stiffness))
    (cond ((and (eq method '$dlsode) (numerics-simulation-constraints run))
           (core-error "the steps of dlsode build on each other, and constraints change the state ~
                        after each; take method = auto"))
          ((and (eq method '$dlsode)
                (numerics-jumps-of-states (numerics-simulation-program run)))
           (core-error "the steps of dlsode build on each other, and the right-hand side may jump ~
                        where ~a = 0, which the states decide; take method = auto"
                       (or (numerics-element-words
                            (first (numerics-jumps-of-states (numerics-simulation-program run))))
                           "the argument of a sign")))
          ((member method *numerics-implicit-methods*)
           (unless (numerics-problem-jacobian problem) (numerics-add-jacobian problem))
           (numerics-warn-of-start run))
          ((numerics-problem-mass problem)
           (core-error "the method ~a takes x' = .., and here M x' = .. with a matrix M that is ~
                        not divided out; take method = radau" (core-spelling method))))
    (numerics-method run)))

(defun numerics-warn-of-start (run)
  "A warning where a derivative of a rate has no finite value at the start, as that of sqrt(x) at 0:
more than one solution may begin there."
  (let* ((problem (numerics-simulation-problem run)) (pattern (numerics-problem-pattern problem))
         (values (numerics-zeros (length (numerics-pattern-rows pattern)))))
    (numerics-with-masked-traps
      (funcall (the function (numerics-problem-jacobian problem))
               (numerics-simulation-moment run) (numerics-simulation-state run) values)
      (let ((place (position-if-not #'numerics-finite-p values)))
        (when place
          (core-warn "at the start the rate of ~a has no finite derivative; more than one solution ~
                      may begin there"
                     (numerics-name-text (nth (aref (numerics-pattern-rows pattern) place)
                                              (numerics-problem-names problem)))))))))

;;; What looks on

(defun numerics-guard-part (run)
  "A part of an observer that stops where a pivot is lost."
  (lambda (step)
    (let ((lost (numerics-lost-pivot run (numerics-step-to step) (numerics-step-after step))))
      (when lost
        (setf (numerics-simulation-lost run) lost)
        :stop))))

(defun numerics-run-dead-point-part (run)
  (numerics-dead-point-part
   (numerics-new-dead-points (numerics-simulation-constraints run)
                             (numerics-controls-relative (numerics-simulation-controls run))
                             (numerics-simulation-moment run) (numerics-simulation-state run))
   (lambda (time)
     (setf (numerics-simulation-fault run)
           (format nil "the constraints depend on each other at about t = ~a: the motion beyond is ~
                        not determined" (numerics-short-number time))))))

(defun numerics-run-pole-part (run)
  "A part of an observer that stops before a pole, or nil."
  (let* ((rates (numerics-simulation-rates run))
         (poles (numerics-new-poles
                 (numerics-simulation-program run) (mapcar #'second (forms-rates-guards rates))
                 (numerics-problem-rates (numerics-simulation-problem run))
                 (numerics-controls-scales (numerics-simulation-controls run)))))
    (when poles
      (numerics-pole-part
       poles (lambda (words time)
               (setf (numerics-simulation-fault run)
                     (format nil "the right-hand side divides by zero at about t = ~a~@[: ~a ~
                                  vanishes~]" (numerics-short-number time) words)))))))

(defparameter *numerics-cutting-methods* '($auto $dop853 $radau) "Those that inspect a step.")

(defun numerics-run-switch-part (run)
  "Where the right-hand side of RUN has jumps or corners, a method that can looks at each of its
steps; for others a part of an observer, or nil."
  (let* ((controls (numerics-simulation-controls run)) (wishes (numerics-simulation-wishes run))
         (switches (numerics-new-switches
                    (numerics-simulation-program run) (numerics-simulation-problem run)
                    controls)))
    (cond ((null switches) nil)
          ((member (numerics-wishes-method wishes) *numerics-cutting-methods*)
           (setf (numerics-controls-inspect controls)
                 (lambda (step guessed) (numerics-inspect-switches switches step guessed)))
           nil)
          (t (numerics-switch-part
              switches (lambda (trouble) (setf (numerics-simulation-fault run) trouble)))))))

(defun numerics-allowed-jump (run)
  "A function (state place): the jump of a state, times M where RUN has one, that does not count."
  (let* ((mass (numerics-problem-mass (numerics-simulation-problem run)))
         (controls (numerics-simulation-controls run)) (scales (numerics-controls-scales controls))
         (share (* 10 (numerics-controls-relative controls))))
    (lambda (state i)
      (* share (aref (numerics-times-mass
                      mass (map 'numerics-vector (lambda (x scale) (+ (abs x) scale)) state scales)
                      t)
                     i)))))

(defun numerics-run-impulse-parts (run)
  "Two parts of an observer, or (nil nil)."
  (let ((impulses (numerics-new-impulses
                   (forms-rates-impulses (numerics-simulation-rates run))
                   (numerics-simulation-program run) (numerics-allowed-jump run))))
    (if impulses
        (numerics-impulse-parts
         impulses (numerics-controls-end (numerics-simulation-controls run))
         (lambda () (numerics-stopped-by-event-p run))
         (lambda (trouble) (setf (numerics-simulation-fault run) trouble)))
        '(nil nil))))

(defun numerics-stopped-by-event-p (run)
  "Whether the last event of RUN was one at which it was to stop."
  (let* ((events (numerics-simulation-events run))
         (last (and events (first (numerics-events-found events)))))
    (and last (nth (numerics-event-place last) (numerics-events-stops events)))))

(defun numerics-run-observer (run)
  (destructuring-bind (cut-at-impulse judge-impulse) (numerics-run-impulse-parts run)
    (numerics-observer
     (remove nil
             (list (and (numerics-simulation-constraints run)
                        (numerics-projection-part (numerics-simulation-constraints run)))
                   (and (numerics-simulation-constraints run) (numerics-run-dead-point-part run))
                   (and (numerics-simulation-guards run) (numerics-guard-part run))
                   (numerics-run-pole-part run)
                   (numerics-run-switch-part run)
                   cut-at-impulse
                   (and (numerics-simulation-events run)
                        (lambda (step) (numerics-see-events (numerics-simulation-events run) step)))
                   judge-impulse
                   (and (numerics-simulation-drifts run)
                        (lambda (step) (numerics-see-drifts (numerics-simulation-drifts run) step)))
                   (lambda (step) (numerics-see-rows (numerics-simulation-rows run) step))
                   (numerics-progress-part (numerics-simulation-controls run)))))))

(defparameter *numerics-share-of-time* 9/10
  "Of the time that a call has left, so that the rows of a run that takes longer can be kept.")

(defun numerics-within-share (function)
  (core-within-on-the-wall *numerics-share-of-time* function))

(defun numerics-carry-out (run &optional (within #'numerics-within-share))
  "Makes the RUN; two values: the sentence of the stop where its time was up or the person
interrupted it, and whether it was the latter. WITHIN calls a function within a time, as
core-within."
  (let* ((method (numerics-prepare-method run)) (observer (numerics-run-observer run))
         (compiled *numerics-compile-seconds*) (outcome nil))
    (setf (numerics-simulation-began run) (numerics-working-seconds))
    (multiple-value-bind (value stop)
        (funcall within
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
        (setf (numerics-simulation-seconds run)
              (- (numerics-working-seconds) (numerics-simulation-began run) compilation)
              (numerics-simulation-compiled-on-the-way run) compilation
              (numerics-simulation-outcome run) outcome))
      (when outcome (numerics-finish-rows (numerics-simulation-rows run) outcome))
      (values stop (eq value :interrupted)))))

;;; How it ended

(defun numerics-trouble (run)
  "Why the RUN did not come to its end, a phrase; nil where it did."
  (let ((outcome (numerics-simulation-outcome run)))
    (cond ((and (numerics-simulation-constraints run)
                (numerics-constraints-singular (numerics-simulation-constraints run)))
           "the constraints depend on each other there")
          ((numerics-simulation-fault run))
          ((or (numerics-simulation-lost run)
               (not (member (numerics-outcome-status outcome) '(:end :stopped))))
           (numerics-trouble-of-steps run outcome)))))

(defun numerics-trouble-of-steps (run outcome)
  (if (numerics-simulation-lost run)
      (format nil "~:[the mass matrix becomes singular: ~;~]~a"
              (numerics-multiplier-p (first (numerics-simulation-lost run)) run)
              (numerics-lost-words run (numerics-simulation-lost run)))
      (format nil (ecase (numerics-outcome-status outcome)
                    (:not-finite "the right-hand side has no finite value there")
                    (:smallest-step "the step became as small as the last place of t: the solution ~
                                     or its right-hand side is singular there")
                    (:no-convergence "the equations of the implicit steps could not be solved")
                    (:inconsistent "the algebraic equations do not hold there")
                    (:most-steps "the most steps that were allowed are made")
                    (:too-slow "the steps became too short")
                    (:singular "the matrix of the implicit steps is singular")
                    (:stiff "the motion is stiff there, and an explicit method would need more ~
                             than a million steps; take method = radau, or auto")
                    (:sliding "no solution in the ordinary sense goes on there")))))
