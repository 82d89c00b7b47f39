;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The fixed step of Gauss' method that a tolerance allows: a pilot run with steps of any length
;;; compares each step with two of half its length, and the shortest that it would take is taken.
;;; It goes along the first part of the run only: a fixed step is a guess on the rest, so what is
;;; conserved has to be looked at.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/step_control" "numerics/gauss_stages"))

(defstruct (numerics-pilot (:conc-name numerics-pilot-))
  controls moment state ; where it is
  whole half            ; runs for a step, and for its halves
  after other           ; states at its end
  (step 0d0 :type double-float))

(defun numerics-gauss-fitting-step (problem controls moment state stages)
  "The step from the controls, else from a pilot run; or the keyword of what went wrong there, and
the time."
  (let* ((span (- (numerics-controls-end controls) (aref moment 0)))
         (given (numerics-controls-first-step controls)))
    (cond ((= span 0d0) span)
          (given (float-sign span (min (abs given) (abs span))))
          (t (let* ((pilot (numerics-new-pilot problem controls moment state stages))
                    (step (numerics-gauss-pilot pilot span)))
               (if (realp step)
                   (/ span (max 1 (ceiling (- (/ span step) 1d-9))))
                   (values step (aref (numerics-pilot-moment pilot) 0))))))))

(defun numerics-new-pilot (problem controls moment state stages)
  (make-numerics-pilot
   :controls controls :moment (copy-seq moment) :state (copy-seq state)
   :whole (numerics-new-gauss-run problem stages controls)
   :half (numerics-new-gauss-run problem stages controls)
   :after (copy-seq state) :other (copy-seq state)))

(defparameter *numerics-pilot-tries* 20
  "After so many a step that is too short stands: at a corner none may fit the tolerance.")

(defun numerics-gauss-pilot (pilot span)
  "The shortest step, with its sign, of a pilot run along a part of SPAN; or what went wrong. A step
that cannot be made bounds all others."
  (let* ((largest (numerics-controls-largest-step (numerics-pilot-controls pilot)))
         (longest (min (abs span) (or largest (abs span))))
         (shortest longest) (steps 0) (tries 0) (left (abs span)) (step (/ longest 100)))
    (loop
      (incf tries)
      (when (< step (* 1d-14 (abs span))) (return :no-convergence))
      (setf (numerics-pilot-step pilot) (float-sign span step))
      (let ((fit (numerics-pilot-fit pilot)))
        (unless fit (setq longest (/ step 2)))
        (let ((next (min longest (* step (or fit 0.5d0)))))
          (when (and fit (or (<= 0.8d0 fit 2d0)
                             (and (> fit 2d0)
                                  (or (= step longest) (> tries *numerics-pilot-tries*)))))
            (setq shortest (min shortest next)
                  tries 0)
            (incf steps)
            (decf left step)
            (when (or (<= left 0d0) (>= steps (numerics-pilot-length span step)))
              (return (float-sign span shortest)))
            (numerics-pilot-accept pilot))
          (setq step next))))))

(defun numerics-pilot-length (span step)
  "After how many steps a pilot run ends: one there costs as much as four of the run."
  (max 32 (min 1000 (/ (abs span) step 6))))

(defun numerics-pilot-fit (pilot)
  "The factor by which the step of PILOT may be longer, between 1/8 and 4; nil where it cannot be
made."
  (let* ((whole (numerics-pilot-whole pilot)) (step (numerics-pilot-step pilot))
         (moment (copy-seq (numerics-pilot-moment pilot))))
    (when (and (numerics-pilot-made whole pilot moment (numerics-pilot-after pilot) step)
               (numerics-pilot-halves pilot moment (/ step 2)))
      (let ((order (* 2 (numerics-gauss-run-stages whole))) (error (numerics-pilot-error pilot))
            (allowed (numerics-controls-relative (numerics-pilot-controls pilot))))
        (if (> error 0d0)
            (max 0.125d0 (min 4d0 (* 0.85d0 (expt (/ allowed error) (/ 1d0 (1+ order))))))
            4d0)))))

(defun numerics-pilot-made (run pilot moment state step)
  "Whether a step from the place of PILOT could be made; STATE is where it ends."
  (replace state (numerics-pilot-state pilot))
  (numerics-pilot-step-on run pilot moment state step))

(defun numerics-pilot-step-on (run pilot moment state step)
  (numerics-gauss-set-step run step)
  (fill (numerics-gauss-run-low run) 0d0)
  (unless (numerics-gauss-solve run moment state)
    (numerics-gauss-advance run state)
    t))

(defun numerics-pilot-halves (pilot moment half)
  (let ((other (numerics-pilot-other pilot)) (run (numerics-pilot-half pilot)))
    (and (numerics-pilot-made run pilot moment other half)
         (progn (numerics-advance moment half)
                (numerics-pilot-step-on run pilot moment other half)))))

(defun numerics-pilot-error (pilot)
  (loop for a across (numerics-pilot-after pilot)
        for b across (numerics-pilot-other pilot)
        for scale across (numerics-gauss-run-scales (numerics-pilot-whole pilot))
        maximize (/ (abs (- a b)) (numerics-scale a b scale))))

(defun numerics-pilot-accept (pilot)
  (replace (numerics-pilot-state pilot) (numerics-pilot-other pilot))
  (numerics-advance (numerics-pilot-moment pilot) (numerics-pilot-step pilot)))
