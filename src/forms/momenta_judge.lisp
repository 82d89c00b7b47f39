;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates with momenta tried at a random point of coordinates and velocities, to 512 binary digits.
;;; The momenta are there quotients of differences of L, p_i = dL/dq_i'; with these the program has
;;; to give back the velocities, and the virtual work of p' for a random displacement c,
;;;     sum c_i p_i' = D_q L - D_v R + c.Q + lambda.A c.
;;; See forms-check-hamilton first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "forms/agreement" "forms/dynamics"
                "forms/equations_as_program" "forms/fixed" "forms/judge" "forms/program_judge"
                "forms/value"))

(defun forms-momentum-trial (dynamics)
  (let ((task (forms-dynamics-task dynamics)))
    (forms-new-trial (forms-task-q task) (forms-task-v task) (forms-task-a task))))

(defun forms-judge-momenta (dynamics point)
  "The momenta of all coordinates at POINT."
  (let ((function (funcall (forms-program-judge-function (forms-dynamics-judge dynamics)) point)))
    (loop for v in (forms-task-v (forms-dynamics-task dynamics))
          collect (or (first (forms-slopes-along (list function) point
                                                 (list (cons v (forms-fixed 1)))))
                      (forms-no-value v)))))

(defun forms-check-hamilton (dynamics names velocities forces bonds multipliers)
  (let* ((trial (forms-momentum-trial dynamics)) (point (forms-trial-point trial)))
    (forms-verdict-of
     "velocities and virtual work against quotients of differences of L"
     (or (catch 'forms-no-value
           (forms-set-places names (forms-judge-momenta dynamics point) point)
           (append (forms-velocity-pairs dynamics velocities point)
                   (list (forms-push-pair dynamics trial forces multipliers point))
                   (forms-rate-pairs dynamics names velocities forces bonds point)))
         '((nil)))
     point)))

(defun forms-velocity-pairs (dynamics velocities point)
  (mapcar #'cons
          (forms-program-values velocities point)
          (forms-places-of (forms-task-v (forms-dynamics-task dynamics)) point)))

(defun forms-push-pair (dynamics trial forces multipliers point)
  "Both sides of the virtual work."
  (let ((judge (forms-dynamics-judge dynamics)) (task (forms-dynamics-task dynamics)))
    (flet ((dissipation (point) (forms-fixed-value (forms-program-judge-dissipation judge) point)))
      (cons
       (- (forms-fixed-dot (forms-trial-weights trial) (forms-program-values forces point))
          (forms-fixed-dot (forms-program-values multipliers point)
                           (forms-constraint-changes task trial point)))
       (+ (forms-slope trial (funcall (forms-program-judge-function judge) point) point
                       (forms-task-q task))
          (- (if (eql (forms-program-judge-dissipation judge) 0)
                 0
                 (forms-slope trial #'dissipation point (forms-task-v task))))
          (forms-weighted-sum trial (forms-program-judge-forces judge) point))))))

(defun forms-rate-pairs (dynamics names velocities forces bonds point)
  "The rates of the g_j along the motion, which vanish."
  (let* ((task (forms-dynamics-task dynamics))
         (motion (acons '$t (forms-fixed 1)
                        (mapcar #'cons (append (forms-task-q task) names)
                                (forms-program-values (append velocities forces) point)))))
    (loop for bond in bonds
          for g = (forms-bond-rate bond)
          collect (cons (first (forms-slopes-along
                                (list (lambda (point)
                                        (first (forms-program-values (list g) point))))
                                point motion))
                        0))))

;;; Routh's form: the cyclic velocities alone; the accelerations have been judged.

(defun forms-check-cyclic-velocities (dynamics constant velocities)
  "CONSTANT: ((coordinate . name of its momentum) ..)."
  (let* ((point (forms-trial-point (forms-momentum-trial dynamics)))
         (task (forms-dynamics-task dynamics)))
    (forms-verdict-of
     "velocities of the cyclic coordinates against p = dL/dq'"
     (or (catch 'forms-no-value
           (let ((momenta (forms-judge-momenta dynamics point)))
             (loop for (x . p) in constant
                   do (forms-set-place p (nth (forms-coordinate-place x task) momenta) point))
             (mapcar #'cons (forms-program-values velocities point)
                     (loop for (x) in constant
                           collect (forms-variable-value (forms-velocity-name x task) point)))))
         '((nil)))
     point)))
