;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Integration of M x' = X(t, x), stiff or differential-algebraic of index 1, by the implicit
;;; method Radau IIA of order 5 (Hairer & Wanner: Solving Ordinary Differential Equations II,
;;; section IV.8, and their code radau5.f; the tolerance is taken as it is given, the norm is that
;;; of the controls). The Jacobian and the factors of the two systems are kept as long as they
;;; serve. Look first at numerics-radau, then at numerics-radau-step-on.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/step_control"
                "numerics/linear_solver"
                "numerics/radau_coefficients" "numerics/radau_run"
                "numerics/radau_start" "numerics/radau_newton" "numerics/radau_control"
                "numerics/radau_dense"
                "numerics/radau_stiffness"))

(defun numerics-radau (problem controls moment state observer)
  "Integrates PROBLEM from STATE at MOMENT; an outcome."
  (unless (numerics-problem-jacobian problem)
    (core-error "the method radau needs the Jacobian of the right sides"))
  (let ((run (numerics-new-radau problem controls moment state)))
    (unwind-protect
         (progn
           (numerics-radau-show run)
           (loop for status = (numerics-radau-begin run)
                   then (or (numerics-radau-limits run) (numerics-radau-step-on run observer))
                 unless (member status '(nil :again))
                   return (numerics-radau-outcome run status)))
      (numerics-release-radau run))))

(defun numerics-radau-show (run)
  "What the observer will see of each step of RUN."
  (setf (numerics-radau-run-seen run)
        (make-numerics-step :before (numerics-radau-run-before run)
                            :after (numerics-radau-run-after run)
                            :interpolate (numerics-radau-dense-function run)
                            :nodes (numerics-with-radau-numbers (c1 c2 b1 b2)
                                     (list (cons c1 b1) (cons c2 b2) (cons 1d0 (/ 9d0)))))))

(defun numerics-radau-outcome (run status)
  (make-numerics-outcome :status status :moment (numerics-radau-run-moment run)
                         :state (numerics-radau-run-before run)
                         :step (numerics-radau-run-next-step run)
                         :about (numerics-radau-run-about run)))

;;; Before a step.

(defun numerics-radau-limits (run)
  "The status in which RUN ends before its next step, or nil; that step is made to meet the end."
  (numerics-with-radau (run problem controls counts moment step)
    (let ((left (numerics-time-left controls moment))
          (smallest (numerics-smallest-step moment (numerics-problem-timed problem)))
          (most (numerics-controls-most-steps controls)))
      (setf (numerics-radau-run-last run) (<= (abs left) (* 1.01d0 (abs step))))
      (cond ((< (abs left) (numerics-smallest-step moment nil)) :end)
            ((< (abs step) smallest) (or (numerics-radau-run-failure run) :smallest-step))
            ((and most (>= (+ (numerics-counts-steps counts) (numerics-counts-rejected counts))
                           most))
             :most-steps)
            ((numerics-radau-hopeless run) :too-slow)
            ((numerics-radau-run-last run)
             (setf (numerics-radau-run-step run) left)
             nil)))))

(defun numerics-radau-hopeless (run)
  (numerics-with-radau (run pace controls moment)
    (let ((sentence (numerics-hopeless pace controls moment)))
      (when sentence (setf (numerics-radau-run-about run) sentence)))))

(defun numerics-radau-prepare (run)
  "Jacobian and factors for the step; a status, :again where the step had to be shortened, or nil."
  (numerics-with-radau (run jacobian step factored-step)
    (or (and (eq jacobian :none) (numerics-radau-differentiate run))
        (and (/= step (if (eq jacobian :none) 0d0 factored-step))
             (numerics-radau-factor run)))))

(defun numerics-radau-differentiate (run)
  (numerics-with-radau (run problem counts moment before entries)
    (incf (numerics-counts-jacobians counts))
    (funcall (the function (numerics-problem-jacobian problem)) moment before entries)
    (setf (numerics-radau-run-jacobian run) :fresh
          (numerics-radau-run-trust run) 0)
    (cond ((numerics-finite-vector-p entries)
           (numerics-radau-follow-radius run)
           nil)
          (t (setf (numerics-radau-run-about run) "an entry of the Jacobian is not finite")
             :not-finite))))

(defun numerics-radau-factor (run)
  (cond ((numerics-radau-set-factors run) (numerics-radau-singular run))
        ((numerics-radau-turned-p run) (numerics-radau-turned run))
        (t (setf (numerics-radau-run-factored-step run) (numerics-radau-run-step run)
                 (numerics-radau-run-singular run) 0)
           nil)))

(defun numerics-radau-singular (run)
  "Five singular matrices in turn end the run."
  (numerics-with-radau (run step)
    (cond ((< (incf (numerics-radau-run-singular run)) 5)
           (setf (numerics-radau-run-step run) (/ step 2)
                 (numerics-radau-run-factored-step run) 0d0)
           :again)
          (t (setf (numerics-radau-run-about run)
                   (numerics-singular-sentence (numerics-radau-run-single run)
                                               (numerics-radau-run-problem run)))
             :singular))))

;;; An estimate by the real system is blind where a real eigenvalue of the Jacobian exceeds that
;;; of the step: a solution that grows so fast, or a constraint past a singular point. Then the
;;; determinant has not the sign that it has for short steps.

(defun numerics-radau-turned-p (run)
  (numerics-with-radau (run single orientation)
    (and orientation (/= (numerics-orientation single) orientation))))

(defun numerics-radau-turned (run)
  (setf (numerics-radau-run-step run) (/ (numerics-radau-run-step run) 2)
        (numerics-radau-run-factored-step run) 0d0
        (numerics-radau-run-failure run) :smallest-step)
  :again)

;;; A step.

(defun numerics-radau-step-on (run observer)
  "Tries a step; the status in which RUN ends with it, or nil."
  (let ((status (numerics-radau-prepare run)))
    (cond ((eq status :again) nil)
          (status)
          (t (numerics-radau-weigh run nil)
             (numerics-radau-guess-stages run)
             (let ((factor (numerics-radau-find-stages run)))
               (if factor
                   (numerics-radau-without-stages run factor)
                   (numerics-radau-judge run observer)))))))

(defun numerics-radau-reject (run factor failure)
  "The step is tried again, FACTOR times as long; FAILURE: what it lacked, nil for accuracy."
  (declare (double-float factor))
  (incf (numerics-counts-rejected (numerics-radau-run-counts run)))
  (setf (numerics-radau-run-rejected run) t
        (numerics-radau-run-failure run) failure
        (numerics-radau-run-step run) (* factor (numerics-radau-run-step run)))
  nil)

(defun numerics-radau-without-stages (run factor)
  "An old Jacobian is made anew; with a fresh one the step shortens by FACTOR."
  (declare (double-float factor))
  (cond ((eq (numerics-radau-run-jacobian run) :old)
         (setf (numerics-radau-run-jacobian run) :none)
         nil)
        ((numerics-radau-inspect-guess run))
        (t (numerics-radau-reject run factor (if (= factor 0.25d0) :not-finite :no-convergence)))))

(defun numerics-radau-judge (run observer)
  (numerics-radau-estimate run)
  (numerics-with-radau (run largest-error first)
    (cond ((not (numerics-finite-p largest-error)) (numerics-radau-reject run 0.25d0 :not-finite))
          ((>= largest-error 1d0)
           (numerics-radau-reject run (if first 0.1d0 (/ (numerics-radau-divisor run))) nil))
          ((not (numerics-radau-look-ahead run))
           (incf (numerics-counts-not-finite (numerics-radau-run-counts run)))
           (numerics-radau-reject run 0.25d0 :not-finite))
          ((numerics-radau-inspect run nil))
          ((numerics-radau-deceived-p run)
           (incf (numerics-counts-rejected (numerics-radau-run-counts run)))
           (setf (numerics-radau-run-jacobian run) :none)
           nil)
          (t (numerics-radau-accept run observer)))))

(defun numerics-radau-look-ahead (run)
  "The slope at the end of the step, unless the run ends there with stages that were looked at
twice; whether it is finite."
  (numerics-with-radau (run moment later step after ahead last iterations)
    (or (and last (> iterations 1))
        (progn (replace later moment)
               (numerics-advance later step)
               (numerics-radau-rates run later after ahead)))))

(defun numerics-radau-accept (run observer)
  "The step stands; the status in which RUN ends with it, or nil."
  (incf (numerics-counts-steps (numerics-radau-run-counts run)))
  (numerics-radau-predict run)
  (numerics-radau-collocate run)
  (numerics-radau-see run)
  (setf (numerics-radau-run-first run) nil
        (numerics-radau-run-failure run) nil)
  (let ((said (funcall observer (numerics-radau-run-seen run))))
    (numerics-radau-remember run)
    (replace (numerics-radau-run-before run) (numerics-radau-run-after run))
    (replace (numerics-radau-run-moment run) (numerics-step-to (numerics-radau-run-seen run)))
    (cond ((eq said :stop) :stopped)
          ((numerics-radau-run-last run) :end)
          (t (numerics-radau-choose-next-step run)
             (numerics-radau-resume run)
             (cond ((numerics-radau-calm-p run) :not-stiff)
                   ((eq said :changed) (numerics-radau-first-slope run))
                   (t (replace (numerics-radau-run-slope run) (numerics-radau-run-ahead run))
                      nil))))))

(defun numerics-radau-see (run)
  "The moments of the step, as it is seen."
  (numerics-with-radau (run seen moment step controls last)
    (let ((to (numerics-step-to seen)))
      (replace (numerics-step-from seen) moment)
      (replace to moment)
      (if last
          (setf (aref to 0) (numerics-controls-end controls)
                (aref to 1) 0d0)
          (numerics-advance to step))
      seen)))

(defun numerics-radau-inspect-guess (run)
  "The same where stages were not found: a jump may be in the way. The step is what the last one is
continued to."
  (unless (or (null (numerics-controls-inspect (numerics-radau-run-controls run)))
              (numerics-radau-run-first run))
    (numerics-radau-guess-stages run)
    (numerics-with-radau (run before after z3)
      (numerics-add before z3 after))
    (numerics-radau-inspect run t)))

(defun numerics-radau-inspect (run guessed)
  "Where the controls look at the step before it stands: :again where it is cut, the status in which
RUN ends before it, or nil."
  (let ((inspect (numerics-controls-inspect (numerics-radau-run-controls run))))
    (when inspect
      (let ((last (numerics-radau-polynomial run)))
        (numerics-radau-collocate run)
        (multiple-value-bind (share over)
            (funcall (the function inspect) (numerics-radau-see run) guessed)
          (numerics-radau-set-polynomial run last)
          (cond ((null share) nil)
                ((stringp share)
                 (setf (numerics-radau-run-about run) share)
                 :sliding)
                (t (numerics-radau-cut run share over)
                   :again)))))))

(defun numerics-radau-polynomial (run)
  "A copy of the collocation polynomial of the last accepted step: stages are guessed from it."
  (numerics-with-radau (run p1 p2 p3) (mapcar #'copy-seq (list p1 p2 p3))))

(defun numerics-radau-set-polynomial (run polynomial)
  (numerics-with-radau (run p1 p2 p3) (mapc #'replace (list p1 p2 p3) polynomial)))

(defun numerics-radau-cut (run share over)
  "The next trial of RUN is SHARE of this one, and leads OVER a jump or to it."
  (numerics-with-radau (run resumed step)
    (setf (numerics-radau-run-resumed run) (max resumed (abs step))
          (numerics-radau-run-before-jump run) (not over))
    (numerics-radau-reject run share nil)))

(defun numerics-radau-resume (run)
  "After a step that was cut, and the one over the jump, the next trial is as long as that before."
  (numerics-with-radau (run resumed step next-step before-jump)
    (when (> resumed (abs next-step))
      (setf (numerics-radau-run-next-step run) (float-sign step resumed)
            (numerics-radau-run-step run) (float-sign step resumed)))
    (unless before-jump (setf (numerics-radau-run-resumed run) 0d0))
    (setf (numerics-radau-run-before-jump run) nil)))

(defun numerics-radau-choose-next-step (run)
  "And what is kept for it: the factors are, where it would become a little shorter or longer."
  (numerics-with-radau (run step next-step convergence rejected)
    (let ((next (numerics-radau-limit run (if (and rejected (> (abs next-step) (abs step)))
                                              step
                                              next-step)))
          (serves (<= convergence 1d-3)))
      (setf (numerics-radau-run-next-step run) next
            (numerics-radau-run-rejected run) nil
            (numerics-radau-run-jacobian run) (if serves :old :none))
      (unless (and serves (<= 0.9d0 (/ next step) 1.2d0))
        (setf (numerics-radau-run-step run) next)))))
