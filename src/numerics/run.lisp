;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A run of M x' = X(t, x): the problem made from the rates with numbers put in, the start, what
;;; looks on, and the method. What cannot be run is refused before the first step: a name without a
;;; value, a start off a constraint or where the equations have no value or divide by a pivot that
;;; is lost. Look first at numerics-new-run.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "forms/dynamics" "forms/rates"
                "numerics/back_to_constraints" "numerics/constrained" "numerics/decimals"
                "numerics/event_samples" "numerics/native"
                "numerics/observers" "numerics/problem" "numerics/program"
                "numerics/rates_problem" "numerics/routine" "numerics/run_options"))

(defstruct numerics-simulation
  rates values wishes program problem controls      ; VALUES: ((name . element) ..)
  (moment (numerics-zeros 2) :type numerics-vector) ; the start
  (state (numerics-zeros 0) :type numerics-vector)
  rows events guards constraints outcome
  drifts drifting                                   ; those of integrals, and their names
  untold                                            ; sentences on integrals that are not given
  lost                                              ; (name share) of a pivot that was lost
  shares                                            ; vector: what is left of each pivot at worst
  fault                                             ; why an observer ended it, a phrase
  (began 0d0)                                       ; when the method began
  (seconds 0d0)                                     ; of the method alone, without compilations
  (compiled-on-the-way 0d0)                         ; seconds of these
  (compile-seconds 0d0) (derivation-seconds 0d0))

(defun numerics-name-text (name) (core-words (list name)))

;;; From rates and wishes

(defun numerics-open-names (rates elements)
  "What has no value in ELEMENTS, as texts."
  (mapcar #'numerics-name-text
          (remove-if (lambda (name)
                       (or (eq name '$t)
                           (member name (forms-rates-states rates) :test #'alike1)))
                     (algebra-open-inputs-of elements))))

(defun numerics-check-names (rates elements)
  "An error where ELEMENTS hold a name without a number."
  (let ((open (numerics-open-names rates elements)))
    (when open
      (core-error "~{~a~^, ~} ha~:[s~;ve~] no value; give parameters = [~a = .., ..] or the key ~
                   values"
                  open (cdr open) (first open)))))

(defun numerics-run-elements (rates)
  "What a run computes of RATES."
  (let ((copy (copy-forms-rates rates)))
    (setf (forms-rates-inertia copy) '())
    (forms-rates-elements copy)))

(defun numerics-with-quadratures (rates start)
  "RATES, among whose states are those cyclic coordinates that the equations START name."
  (let ((copy (copy-forms-rates rates))
        (wanted (loop for name in (forms-rates-cyclic rates)
                      for slope in (forms-output-list '$quadratures (forms-rates-outputs rates))
                      when (member name (numerics-items start) :key #'second :test #'alike1)
                        collect (cons name slope))))
    (setf (forms-rates-states copy) (append (forms-rates-states rates) (mapcar #'car wanted)))
    (forms-set-right-sides copy (append (forms-right-sides rates) (mapcar #'cdr wanted)))
    (if wanted copy rates)))

(defun numerics-new-run (rates values start span wishes &key (how :auto))
  "The run of RATES from START, exact values of the states, over SPAN, everything checked; VALUES
were put in, pairs (name . element). HOW as of numerics-problem-of."
  (numerics-check-names rates (numerics-run-elements rates))
  (destructuring-bind (from to)
      (mapcar (lambda (e) (numerics-double e "an end of the span")) (numerics-read-span span))
    (let* ((program (numerics-program-of rates))
           (run (make-numerics-simulation
                 :rates rates :values values :wishes wishes :program program
                 :moment (numerics-moment from)
                 :state (numerics-start-vector rates start)
                 :problem (numerics-problem-of program :jacobian nil :how how))))
      (setf (numerics-simulation-controls run) (numerics-controls-of rates wishes to)
            (numerics-simulation-guards run) (numerics-guard-routine program)
            (numerics-simulation-constraints run) (numerics-constraints-of rates program))
      (numerics-check-start run)
      (setf (numerics-simulation-rows run) (numerics-wished-rows run from to)
            (numerics-simulation-events run) (numerics-wished-events run))
      run)))

(defun numerics-run-again (run controls wishes)
  "A run of the same from the start, with CONTROLS and WISHES of its own, as if nothing had run
yet."
  (let ((again (copy-numerics-simulation run)))
    (setf (numerics-simulation-controls again) controls
          (numerics-simulation-wishes again) wishes
          (numerics-simulation-drifts again) nil
          (numerics-simulation-drifting again) nil
          (numerics-simulation-outcome again) nil
          (numerics-simulation-lost again) nil
          (numerics-simulation-shares again) (copy-seq (numerics-simulation-shares run))
          (numerics-simulation-fault again) nil
          (numerics-simulation-constraints again)
          (numerics-fresh-constraints (numerics-simulation-constraints run))
          (numerics-simulation-rows again)
          (numerics-wished-rows again (aref (numerics-simulation-moment run) 0)
                                (numerics-controls-end controls))
          (numerics-simulation-events again) (numerics-wished-events again))
    again))

(defun numerics-fresh-constraints (constraints)
  "CONSTRAINTS as they were before a run, with the same places to work in."
  (when constraints
    (let ((copy (copy-numerics-constraints constraints)))
      (setf (numerics-constraints-singular copy) nil (numerics-constraints-largest copy) 0d0)
      copy)))

(defun numerics-start-values (rates start values)
  "The exact start values of the states of RATES; velocities and momenta that are not named are 0,
momenta that have one of VALUES, equations, begin with it."
  (let ((names (forms-rates-states rates)))
    (numerics-check-start-names start names
                                (mapcar (lambda (name) (list '(%derivative simp) name '$t 1))
                                        (forms-rates-cyclic rates)))
    (numerics-read-start
     start names
     (lambda (name)
       (let ((value (find name (numerics-items values) :key #'second :test #'alike1)))
         (cond ((numerics-velocity-p name) 0)
               ((member name (forms-rates-momenta rates) :test #'alike1)
                (if value (third value) 0))
               (t (core-error "the start value of ~a is missing; add ~:*~a = .. to the start"
                              (numerics-name-text name)))))))))

(defun numerics-start-vector (rates values)
  (map 'numerics-vector
       (lambda (value name)
         (numerics-double value (format nil "the start value of ~a" (numerics-name-text name))))
       values (forms-rates-states rates)))

(defun numerics-angle-places (rates)
  (loop for name in (forms-rates-states rates)
        for k from 0
        when (member name (forms-rates-angles rates) :test #'alike1) collect k))

(defun numerics-controls-of (rates wishes end)
  (multiple-value-bind (relative scales)
      (numerics-read-tolerance (numerics-wishes-tolerance wishes) (forms-rates-states rates))
    (dolist (place (numerics-angle-places rates)) (setf (aref scales place) 1d0))
    (make-numerics-controls
     :end end :relative relative :scales scales
     :first-step (numerics-read-first-step (numerics-wishes-step wishes)))))

(defun numerics-guard-routine (program)
  (when (numerics-program-guards program)
    (with-numerics-program program
      (numerics-routine program (numerics-program-guards program) :how :machine))))

;;; What looks on

(defun numerics-wished-rows (run from to)
  (let ((points (numerics-wishes-points (numerics-simulation-wishes run))))
    (numerics-new-rows (numerics-read-points points from to)
                       (numerics-simulation-moment run) (numerics-simulation-state run)
                       (numerics-back-to-constraints run))))

(defun numerics-back-to-constraints (run)
  "The function (moment x) that brings a state between two steps back to the constraints, or nil."
  (let ((constraints (numerics-simulation-constraints run)))
    (and constraints (lambda (moment x) (numerics-project constraints moment x)))))

(defun numerics-wished-events (run)
  "What looks for the events, each an expression or an equation; nil for none."
  (let* ((wishes (numerics-simulation-wishes run)) (expressions (numerics-event-expressions wishes))
         (stop (and (numerics-wishes-stop wishes) t)))
    (when expressions
      (numerics-new-events
       (numerics-expression-routine run expressions)
       (length (numerics-simulation-state run))
       (mapcar (constantly 0) expressions) (mapcar (constantly stop) expressions)
       (numerics-back-to-constraints run)))))

(defun numerics-event-expressions (wishes)
  (let ((events (numerics-wishes-events wishes)))
    (unless (and (consp events) (eq (caar events) 'mlist))
      (core-error "events is a list of expressions whose zeros are looked for, found ~a"
                  (core-words (list events))))
    (when (and (numerics-wishes-stop wishes) (null (cdr events)))
      (core-error "stop = true ends a run at the first of the events; give events = [..]"))
    (mapcar (lambda (e)
              (if (and (consp e) (eq (caar e) 'mequal)) (sub (second e) (third e)) e))
            (cdr events))))

(defun numerics-expression-routine (run expressions)
  "The routine of the values of EXPRESSIONS in t, the states and what has a value."
  (let ((program (numerics-simulation-program run)))
    (with-numerics-program program
      (let ((elements (algebra-exchanged (mapcar #'algebra-program-element expressions)
                                         (algebra-exchange-by (numerics-simulation-values run)))))
        (numerics-check-names (numerics-simulation-rates run) elements)
        (numerics-routine program elements)))))

;;; The start

(defparameter *numerics-least-pivot* 1d-13
  "Share of itself that a pivot may lose by subtraction: below nothing is left of 16 digits.")

(defun numerics-check-start (run)
  (when (numerics-simulation-constraints run)
    (numerics-check-constraints (numerics-simulation-constraints run)
                                (numerics-simulation-moment run) (numerics-simulation-state run)))
  (numerics-check-pivots run (numerics-simulation-moment run) (numerics-simulation-state run))
  (let ((rates (numerics-zeros (length (numerics-simulation-state run)))))
    (numerics-with-masked-traps
      (funcall (numerics-problem-rates (numerics-simulation-problem run))
               (numerics-simulation-moment run) (numerics-simulation-state run) rates)
      (loop for rate across rates
            for name in (forms-rates-states (numerics-simulation-rates run))
            do (unless (numerics-finite-p rate)
                 (core-error "at the start the rate of ~a has no finite value; the equations are ~
                              singular there: start elsewhere" (numerics-name-text name)))))))

(defun numerics-lost-pivot (run moment state)
  "The name whose pivot is lost at STATE, and what is left of it; nil where there is none. What is
left of each at worst is noted."
  (when (numerics-simulation-guards run)
    (let* ((guards (forms-rates-guards (numerics-simulation-rates run)))
           (shares (numerics-zeros (length guards))))
      (numerics-with-masked-traps
        (funcall (numerics-simulation-guards run) moment state shares)
        (numerics-note-shares run shares)
        (loop for share across shares
              for (name) in guards
              unless (> (abs share) *numerics-least-pivot*)
                do (return (list name share)))))))

(defun numerics-note-shares (run shares)
  (let ((least (numerics-simulation-shares run)))
    (if least
        (map-into least (lambda (a b) (if (< (abs b) a) (abs b) a)) least shares)
        (setf (numerics-simulation-shares run) (map 'numerics-vector #'abs shares)))))

(defun numerics-multiplier-p (name run)
  "Whether NAME, of a guard, is that of a multiplier, and of no coordinate."
  (not (member name (append (forms-rates-states (numerics-simulation-rates run))
                            (forms-rates-cyclic (numerics-simulation-rates run)))
               :test #'alike1)))

(defun numerics-lost-words (run lost)
  "What is said of a pivot that is LOST in RUN: (name share); where M_kk is 0 too the share is no
number."
  (destructuring-bind (name share) lost
    (let ((left (and (numerics-with-masked-traps (= share share)) (numerics-short-number share)))
          (word (numerics-name-text name)))
      (cond ((numerics-multiplier-p name run)
             (format nil "the constraints nearly depend on each other: of what determines ~a ~
                          ~:[nothing~;~:*~a of 1~] is left" word left))
            (left (format nil "of the inertia of ~a ~a of 1 is left when the bodies beyond it yield"
                          word left))
            (t (format nil "the inertia of ~a vanishes" word))))))

(defun numerics-check-pivots (run moment state)
  (let ((lost (numerics-lost-pivot run moment state)))
    (when lost
      (core-error "~:[the mass matrix is singular at the start: ~;at the start ~]~a"
                  (numerics-multiplier-p (first lost) run) (numerics-lost-words run lost)))))
