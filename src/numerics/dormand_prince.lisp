;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Integration by the explicit method of order 8 by Dormand and Prince with steps of its own
;;; choice: the control of steps and the test of stiffness of Hairer's code dop853.f (E. Hairer,
;;; S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, section II.5), in the norm
;;; of the controls. The slope at the new state is the first of the next step. A trial that is not
;;; finite is taken again with a shorter step. Look first at numerics-dopri.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/step_control" "numerics/dormand_prince_stages"))

(defun numerics-dopri (problem controls moment state observer)
  "Integrates PROBLEM, x' = X(t, x), from STATE at MOMENT; an outcome."
  (let ((run (numerics-new-dopri-run problem controls moment state)))
    (numerics-dopri-show run)
    (loop for status = (numerics-dopri-begin run)
            then (or (numerics-dopri-limit run) (numerics-dopri-step-on run observer))
          unless (member status '(nil :again)) return (numerics-dopri-outcome run status))))

(defun numerics-dopri-show (run)
  "What the observer will see of each step of RUN."
  (setf (numerics-step-interpolate (numerics-dopri-seen run))
        (lambda (share out) (numerics-dopri-between run share out))))

(defun numerics-dopri-outcome (run status)
  (make-numerics-outcome :status status :moment (numerics-dopri-moment run)
                         :state (numerics-dopri-state run) :step (numerics-dopri-step run)
                         :about (numerics-dopri-about run)))

(defun numerics-dopri-counts (run) (numerics-controls-counts (numerics-dopri-controls run)))

;;; Where a run begins and ends

(defun numerics-dopri-first-slope (run)
  "The slope at the state of RUN anew; :not-finite where it is not."
  (let ((slope (svref (numerics-dopri-slopes run) 1)))
    (funcall (numerics-dopri-rates run) (numerics-dopri-moment run) (numerics-dopri-state run)
             slope)
    (incf (numerics-counts-rates (numerics-dopri-counts run)))
    (if (numerics-finite-vector-p slope) nil :not-finite)))

(defun numerics-dopri-begin (run)
  "The first slope and step of RUN; the status in which it ends at its start, or nil."
  (let* ((controls (numerics-dopri-controls run)) (moment (numerics-dopri-moment run))
         (left (numerics-time-left controls moment))
         (given (numerics-controls-first-step controls)))
    (cond ((numerics-dopri-first-slope run))
          ((zerop left) :end)
          (t (setf (numerics-dopri-step run)
                   (if given
                       (* (signum left) (min (abs given) (numerics-dopri-largest-step run)))
                       (numerics-first-step (numerics-dopri-problem run) controls moment
                                            (numerics-dopri-state run)
                                            (svref (numerics-dopri-slopes run) 1) 8)))
             nil))))

(defun numerics-dopri-limit (run)
  "The status in which RUN ends before its next step, or nil; that step is made to meet the end."
  (let* ((controls (numerics-dopri-controls run)) (counts (numerics-controls-counts controls))
         (moment (numerics-dopri-moment run))
         (smallest (numerics-smallest-step
                    moment (numerics-problem-timed (numerics-dopri-problem run))))
         (left (numerics-time-left controls moment)) (step (numerics-dopri-step run))
         (most (numerics-controls-most-steps controls)))
    (cond ((< (abs left) (numerics-smallest-step moment nil)) :end)
          ((< (abs step) smallest)
           (if (numerics-dopri-finite-p run) :smallest-step :not-finite))
          ((and most
                (>= (+ (numerics-counts-steps counts) (numerics-counts-rejected counts)) most))
           :most-steps)
          ((setf (numerics-dopri-about run)
                 (numerics-hopeless (numerics-dopri-pace run) controls moment))
           :too-slow)
          (t (setf (numerics-dopri-full-step run) step
                   (numerics-dopri-last-p run) (<= (abs left) (* 1.01d0 (abs step))))
             (when (numerics-dopri-last-p run) (setf (numerics-dopri-step run) left))
             nil))))

;;; A step

(defun numerics-dopri-step-on (run observer)
  "Tries a step of RUN; the status in which the run ends with it, :again, or nil."
  (numerics-dopri-set-next-moment run)
  (cond ((not (numerics-dopri-trial-p run)) (numerics-dopri-reject run))
        ((numerics-dopri-inspect run))
        (t (let ((stiff (numerics-dopri-stiff-p run)))
             (or (numerics-dopri-accept run observer) stiff)))))

(defun numerics-dopri-set-next-moment (run)
  (let ((next (numerics-dopri-next-moment run)))
    (cond ((numerics-dopri-last-p run)
           (setf (aref next 0) (numerics-controls-end (numerics-dopri-controls run))
                 (aref next 1) 0d0))
          (t (replace next (numerics-dopri-moment run))
             (numerics-advance next (numerics-dopri-step run))))))

(defun numerics-dopri-trial-p (run)
  "Whether the trial step of RUN is good enough; if so its slope at the new state is there too."
  (let ((counts (numerics-dopri-counts run)) (slope (svref (numerics-dopri-slopes run) 13)))
    (numerics-dopri-stages run)
    (incf (numerics-counts-rates counts) 11)
    (when (and (numerics-dopri-sum run) (<= (numerics-dopri-error run) 1d0))
      (funcall (numerics-dopri-rates run) (numerics-dopri-next-moment run)
               (numerics-dopri-next run) slope)
      (incf (numerics-counts-rates counts))
      (setf (numerics-dopri-finite-p run) (numerics-finite-vector-p slope)))))

(declaim (inline numerics-dopri-factor))
(defun numerics-dopri-factor (error)
  "By what the next step differs: between 0.333 and 6."
  (declare (double-float error))
  (if (< error 1d-8)
      6d0
      (max 0.333d0 (min 6d0 (/ 0.9d0 (sqrt (sqrt (sqrt (abs error)))))))))

(defun numerics-dopri-reject (run)
  "A shorter step for RUN; nil."
  (let ((counts (numerics-dopri-counts run)))
    (cond ((numerics-dopri-finite-p run)
           (incf (numerics-counts-rejected counts))
           (setf (numerics-dopri-step run)
                 (* (numerics-dopri-step run) (numerics-dopri-factor (numerics-dopri-error run)))))
          (t (incf (numerics-counts-not-finite counts))
             (setf (numerics-dopri-step run) (* 0.25d0 (numerics-dopri-step run)))))
    (setf (numerics-dopri-rejected-p run) t)
    nil))

(defun numerics-dopri-choose-step (run)
  "The next step of RUN: not longer right after a trial that failed, and as long as it was before
the end made it shorter."
  (let* ((step (numerics-dopri-step run)) (full (abs (numerics-dopri-full-step run)))
         (factor (numerics-dopri-factor (numerics-dopri-error run)))
         (next (* (abs step) (if (numerics-dopri-rejected-p run) (min 1d0 factor) factor))))
    (declare (double-float step full factor next))
    (setq next (min (if (< (abs step) full) (max next full) next)
                    (numerics-dopri-largest-step run)))
    (setf (numerics-dopri-step run) (if (< step 0d0) (- next) next)
          (numerics-dopri-rejected-p run) nil)))

(defun numerics-dopri-see (run)
  "The trial step of RUN, as it is seen."
  (let ((seen (numerics-dopri-seen run)))
    (setf (numerics-step-from seen) (numerics-dopri-moment run)
          (numerics-step-to seen) (numerics-dopri-next-moment run)
          (numerics-step-before seen) (numerics-dopri-state run)
          (numerics-step-after seen) (numerics-dopri-next run)
          (numerics-dopri-dense-p run) nil)
    seen))

(defun numerics-dopri-inspect (run)
  "Where the controls look at the trial step before it stands: :again where it is cut, the status in
which RUN ends before it, or nil."
  (let ((inspect (numerics-controls-inspect (numerics-dopri-controls run))))
    (when inspect
      (multiple-value-bind (share over)
          (funcall (the function inspect) (numerics-dopri-see run) nil)
        (cond ((null share) nil)
              ((stringp share)
               (setf (numerics-dopri-about run) share)
               :sliding)
              (t (numerics-dopri-cut run share over)
                 :again))))))

(defun numerics-dopri-cut (run share over)
  "The next trial of RUN is SHARE of this one, and leads OVER a jump or to it."
  (declare (double-float share))
  (let ((step (numerics-dopri-step run)))
    (incf (numerics-counts-rejected (numerics-dopri-counts run)))
    (setf (numerics-dopri-resumed run) (max (numerics-dopri-resumed run) (abs step))
          (numerics-dopri-before-jump-p run) (not over)
          (numerics-dopri-step run) (* share step))))

(defun numerics-dopri-resume (run)
  "After a step that was cut, and the one over the jump, the next trial is as long as that before."
  (let ((resumed (numerics-dopri-resumed run)) (step (numerics-dopri-step run)))
    (when (> resumed (abs step))
      (setf (numerics-dopri-step run) (float-sign step resumed)))
    (unless (numerics-dopri-before-jump-p run) (setf (numerics-dopri-resumed run) 0d0))
    (setf (numerics-dopri-before-jump-p run) nil)))

(defun numerics-dopri-accept (run observer)
  "RUN goes on to the new state, which OBSERVER sees; the status in which it ends there, or nil."
  (let ((slopes (numerics-dopri-slopes run)))
    (incf (numerics-counts-steps (numerics-dopri-counts run)))
    (let ((answer (and observer (funcall observer (numerics-dopri-see run)))))
      (numerics-dopri-choose-step run)
      (numerics-dopri-resume run)
      (rotatef (numerics-dopri-moment run) (numerics-dopri-next-moment run))
      (rotatef (numerics-dopri-state run) (numerics-dopri-next run))
      (rotatef (numerics-dopri-low run) (numerics-dopri-next-low run))
      (rotatef (svref slopes 1) (svref slopes 13))
      (ecase answer
        ((nil) nil)
        (:stop :stopped)
        (:changed (fill (numerics-dopri-low run) 0d0)
                  (numerics-dopri-first-slope run))))))

(defparameter *numerics-most-stiff-steps* 1d6 "That an explicit method alone makes to the end.")

(defun numerics-dopri-stiff-p (run)
  "Whether 15 steps looked stiff with never 6 others in between, where the controls ask for it: by
:stiffness, or by :much-stiffness, 1000 steps, and if too many are left."
  (let* ((controls (numerics-dopri-controls run)) (asked (numerics-controls-looks-for controls)))
    (cond ((null asked) nil)
          ((numerics-dopri-unstable-p run)
           (setf (numerics-dopri-calm run) 0)
           (and (>= (incf (numerics-dopri-stiff run)) (if (eq asked :stiffness) 15 1000))
                (or (eq asked :stiffness)
                    (> (abs (/ (numerics-time-left controls (numerics-dopri-moment run))
                               (numerics-dopri-step run)))
                       *numerics-most-stiff-steps*))
                :stiff))
          ((>= (incf (numerics-dopri-calm run)) 6)
           (setf (numerics-dopri-stiff run) 0)
           nil))))
