;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Jumps and corners of a right-hand side X: where the argument of a sign or of an absolute value
;;; vanishes. The error of a step that goes over one is not what its estimate says: a short pulse
;;; may lie between all stages. So where an argument vanishes within a step, what the step adds to
;;; the state is compared with the integral of X along it, from zero to zero; where they differ by
;;; more than the tolerance, the step is cut to end shortly before the first zero, and one so short
;;; that nothing in it counts leads to the other side. A motion that comes back again and again has
;;; no solution in the ordinary sense. See numerics-inspect-switches first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "numerics/element_words" "numerics/event_samples"
                "numerics/events" "numerics/problem" "numerics/program" "numerics/quadrature"
                "numerics/routine" "numerics/sparse" "numerics/step_control"))

(defun numerics-switch-elements (elements)
  "The arguments of signs and absolute values in ELEMENTS, and the ordinates of angles."
  (let ((found '()))
    (dolist (node (algebra-live-nodes elements) (nreverse found))
      (when (member (algebra-node-operation node) '(:sign :absolute :polar-angle))
        (let ((argument (algebra-node-left node)))
          (unless (or (not (algebra-node-p argument))
                      (member (algebra-node-operation argument) '(:sign :absolute)))
            (pushnew argument found)))))))

(defun numerics-jumps-of-states (program)
  "The arguments of signs in PROGRAM's rates that depend on states: where they vanish X may jump."
  (with-numerics-program program
    (loop for node in (algebra-live-nodes (numerics-program-rates program))
          when (and (eq (algebra-node-operation node) :sign)
                    (intersection (algebra-inputs-of (list (algebra-node-left node)))
                                  (numerics-program-names program) :test #'algebra-same-name-p))
            collect (algebra-node-left node))))

(defstruct numerics-switches
  elements events rates mass timed                    ; the last three of the problem
  scales relative end                                 ; those of the controls
  (passed '())                                        ; times of steps over a zero, the last first
  (moment (numerics-zeros 2) :type numerics-vector)
  (state (numerics-zeros 0) :type numerics-vector)
  (slope (numerics-zeros 0) :type numerics-vector)
  (sum (numerics-zeros 0) :type numerics-vector))

(defun numerics-new-switches (program problem controls)
  "What looks for jumps and corners of the right-hand side of PROBLEM, which PROGRAM poses; nil
where there are none."
  (with-numerics-program program
    (let ((elements (numerics-switch-elements (numerics-program-rates program)))
          (n (length (numerics-program-names program))))
      (when elements
        (make-numerics-switches
         :elements elements :rates (numerics-problem-rates problem)
         :mass (numerics-problem-mass problem) :timed (numerics-problem-timed problem)
         :events (numerics-new-events (numerics-routine program elements) n
                                      (mapcar (constantly 0) elements)
                                      (mapcar (constantly nil) elements) nil)
         :scales (numerics-controls-scales controls)
         :relative (numerics-controls-relative controls) :end (numerics-controls-end controls)
         :state (numerics-zeros n) :slope (numerics-zeros n) :sum (numerics-zeros n))))))

;;; What a step misses

(defun numerics-switch-zeros (switches step)
  "Where arguments vanish within STEP, (share place) in order."
  (let* ((events (numerics-switches-events switches))
         (zeros (progn (setf (numerics-events-sides events) nil)
                       (loop for (share place) in (numerics-zeros-of-step events step)
                             unless (= share 0d0) collect (list share place)))))
    (numerics-sample-events events step)
    (sort (append zeros (loop for (share) in zeros
                              append (numerics-zeros-about events step share)))
          #'< :key #'first)))

(defun numerics-zeros-about (events step share)
  "Zeros on both sides of SHARE, where one argument vanishes, of others whose sign there is neither
that of the sample before nor of the one after: one may be a function of the absolute value of
another."
  (let* ((k (min 15 (floor (* 16 share))))
         (values (copy-seq (numerics-events-at events step share))))
    (loop for place below (numerics-events-count events)
          for side = (numerics-side (aref values place))
          for before = (numerics-side (numerics-sample events place k))
          when (and (/= side 0) (= before (- side))
                    (= before (numerics-side (numerics-sample events place (1+ k)))))
            append (loop for (from to) in (list (list (/ k 16d0) share)
                                                (list share (/ (1+ k) 16d0)))
                         collect (list (numerics-crossing events step place from to) place)))))

(defun numerics-integral (switches step from to)
  "That of X along STEP between two shares of it."
  (let ((sum (numerics-switches-sum switches)) (slope (numerics-switches-slope switches))
        (moment (numerics-switches-moment switches)) (state (numerics-switches-state switches))
        (length (* (- to from) (numerics-step-length step))))
    (fill sum 0d0)
    (loop for (node . weight) in *numerics-quadrature*
          for share = (+ from (* node (- to from)))
          do (numerics-step-moment step share moment)
             (funcall (the function (numerics-switches-rates switches)) moment
                      (numerics-step-state step share state) slope)
             (map-into sum (lambda (s x) (+ s (* weight length x))) sum slope))
    sum))

(defun numerics-missed (switches step from to)
  "What STEP adds between two shares, less the integral of X there, over the tolerance."
  (let* ((integral (numerics-integral switches step from to))
         (mass (numerics-switches-mass switches))
         (n (length integral))
         (before (numerics-step-state step from (numerics-zeros n)))
         (after (numerics-step-state step to (numerics-zeros n)))
         (scales (map 'numerics-vector (lambda (x scale) (+ (abs x) scale)) after
                      (numerics-switches-scales switches)))
         (largest 0d0))
    (loop for s across integral
          for x across (numerics-times-mass mass (map 'numerics-vector #'- after before) nil)
          for scale across (numerics-times-mass mass scales t)
          do (unless (= scale 0d0)
               (setq largest (max largest (/ (abs (- x s)) scale)))))
    (/ largest (numerics-switches-relative switches))))

(defun numerics-times-mass (mass vector absolute)
  "MASS VECTOR, or with the absolute values of MASS, nil for 1; an equation without rates gives 0."
  (if mass
      (let ((values (numerics-matrix-values mass)) (out (numerics-zeros (length vector))))
        (numerics-multiply (numerics-matrix-pattern mass)
                           (if absolute (map 'numerics-vector #'abs values) values) vector out)
        out)
      vector))

(defun numerics-missed-in-all (switches step zeros)
  (loop for (from to) on (append '(0d0) (mapcar #'first zeros) '(1d0))
        while to
        when (< from to) sum (numerics-missed switches step from to)))

;;; Where it is cut

(defparameter *numerics-most-missed* 2d0 "Of the tolerance, in a step over a jump or a corner.")

(defun numerics-inspect-switches (switches step guessed)
  "nil where STEP may stand; else the share of it that may, and whether that goes over a zero; or a
sentence where no solution goes on. Of a step that was only GUESSED all this counts where X follows
it to the first zero."
  (let ((zeros (numerics-switch-zeros switches step)))
    (when (and zeros (or (not guessed)
                         (< (numerics-missed switches step 0d0 (first (first zeros))) 1d0)))
      (let ((missed (numerics-missed-in-all switches step zeros)))
        (destructuring-bind (share place) (first zeros)
          (if (> missed *numerics-most-missed*)
              (let ((short (max (/ 0.1d0 missed) (numerics-shortest-share switches step))))
                (if (and guessed (> share short))
                    (values (- share (* 0.5d0 short)) nil)
                    (numerics-cut-share switches step (first zeros) short)))
              (and (not guessed) (numerics-turned-back switches step share place))))))))

(defun numerics-shortest-share (switches step)
  "Of STEP, that a method makes."
  (/ (* 4 (numerics-smallest-step (numerics-step-from step) (numerics-switches-timed switches)))
     (abs (numerics-step-length step))))

(defun numerics-cut-share (switches step zero short)
  "To half of SHORT before the ZERO, or over it by a step so short that what it misses is no
matter."
  (destructuring-bind (share place) zero
    (cond ((numerics-turned-back switches step share place))
          ((> share short) (values (- share (* 0.5d0 short)) nil))
          ((numerics-to-and-fro switches step place short))
          ((> (+ share short) 0.9d0) nil)
          (t (values (+ share short) t)))))

;;; Where no solution goes on

(defun numerics-switch-words (switches place)
  (or (numerics-element-words (nth place (numerics-switches-elements switches)))
      "the argument of a sign"))

(defun numerics-turned-back (switches step share place)
  "A sentence where X points back to the zero at SHARE on its other side: from shortly before it, a
little more than the way there along X is made, and the next bit along X there. (Where M is not
divided out nothing is said.)"
  (let* ((moment (copy-seq (numerics-switches-moment switches)))
         (small (numerics-small-share switches step)) (from (max 0d0 (- share small)))
         (state (numerics-step-state step from (copy-seq (numerics-switches-state switches))))
         (short (* small (numerics-step-length step))))
    (numerics-step-moment step from moment)
    (let* ((before (numerics-argument-at switches place moment state))
           (beyond (progn (numerics-go-on switches moment state (* 2 short))
                          (numerics-argument-at switches place moment state)))
           (after (progn (numerics-go-on switches moment state short)
                         (numerics-argument-at switches place moment state))))
      (when (and (null (numerics-switches-mass switches))
                 (= (numerics-side beyond) (- (numerics-side before)))
                 (< (* (- after beyond) (numerics-side (- beyond before)))
                    (* -1d-3 (abs (- beyond before)))))
        (format nil "on both sides of ~a = 0 it leads back to it"
                (numerics-switch-words switches place))))))

(defun numerics-small-share (switches step)
  "Of STEP, but enough to move a state by more than rounding does."
  (let ((left (- (numerics-switches-end switches) (aref (numerics-step-from step) 0))))
    (min 0.5d0 (max 1d-7 (abs (/ (* 1d-11 left) (numerics-step-length step)))))))

(defun numerics-argument-at (switches place moment state)
  (let ((values (numerics-events-values (numerics-switches-events switches))))
    (funcall (the function (numerics-events-functions (numerics-switches-events switches)))
             moment state values)
    (aref values place)))

(defun numerics-go-on (switches moment state length)
  "MOMENT and STATE move by LENGTH along X."
  (let ((slope (numerics-switches-slope switches)))
    (funcall (the function (numerics-switches-rates switches)) moment state slope)
    (map-into state (lambda (x s) (+ x (* length s))) state slope)
    (numerics-advance moment length)))

(defparameter *numerics-most-switches* 100)

(defun numerics-to-and-fro (switches step place short)
  "Notes a step over a zero; a sentence where the last hundred were not far apart."
  (let* ((time (aref (numerics-step-from step) 0)) (passed (numerics-switches-passed switches))
         (before (nth (1- *numerics-most-switches*) passed)))
    (unless (eql time (first passed))
      (setf (numerics-switches-passed switches)
            (cons time (if before (subseq passed 0 (1- *numerics-most-switches*)) passed))))
    (when (and before (< (abs (- time before))
                         (* 10 *numerics-most-switches* short (abs (numerics-step-length step)))))
      (format nil "~a changes its sign to and fro" (numerics-switch-words switches place)))))

;;; Methods that cannot cut their steps

(defparameter *numerics-worst-missed* 100d0 "Of the tolerance, in a step that stands.")

(defun numerics-switch-part (switches found)
  "A part of an observer that calls FOUND with a phrase and ends the run before a step that misses
far more than the tolerance, or beyond which no solution goes on."
  (lambda (step)
    (let* ((zeros (numerics-switch-zeros switches step))
           (trouble (and zeros (numerics-switch-trouble switches step zeros))))
      (when trouble
        (funcall found trouble)
        (numerics-undo-step step)
        :stop))))

(defun numerics-switch-trouble (switches step zeros)
  (destructuring-bind (share place) (first zeros)
    (let ((back (numerics-turned-back switches step share place)))
      (cond (back (format nil "no solution in the ordinary sense goes on there; ~a" back))
            ((> (numerics-missed-in-all switches step zeros) *numerics-worst-missed*)
             (format nil "the next step would go over a jump or corner of the right-hand side, ~
                          where ~a = 0; take method = auto"
                     (numerics-switch-words switches place)))))))
