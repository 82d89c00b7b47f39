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

(defstruct forms-canonical-motion velocities forces bonds multipliers) ; q', p', constraints

(defun forms-check-hamilton (dynamics names motion)
  (let* ((trial (forms-momentum-trial dynamics)) (point (forms-trial-point trial))
         (task (forms-dynamics-task dynamics)) (judge (forms-dynamics-judge dynamics)))
    (forms-verdict-of
     "velocities and virtual work against quotients of differences of L"
     (or (catch 'forms-no-value
           (forms-set-places names (forms-judge-momenta dynamics point) point)
           (append (mapcar #'cons
                           (forms-program-values (forms-canonical-motion-velocities motion) point)
                           (forms-places-of (forms-task-v task) point))
                   (list (cons (forms-work-of-forces task trial motion point)
                               (forms-work-of-function judge task trial point)))
                   (forms-rate-pairs task names motion point)))
         '((nil)))
     point)))

(defun forms-work-of-forces (task trial motion point)
  "c.p' - lambda.A c"
  (- (forms-fixed-dot (forms-trial-weights trial)
                      (forms-program-values (forms-canonical-motion-forces motion) point))
     (forms-fixed-dot (forms-program-values (forms-canonical-motion-multipliers motion) point)
                      (forms-constraint-changes task trial point))))

(defun forms-work-of-function (judge task trial point)
  "D_q L - D_v R + c.Q"
  (flet ((dissipation (point) (forms-fixed-value (forms-program-judge-dissipation judge) point)))
    (+ (forms-slope trial (funcall (forms-program-judge-function judge) point) point
                    (forms-task-q task))
       (- (if (eql (forms-program-judge-dissipation judge) 0)
              0
              (forms-slope trial #'dissipation point (forms-task-v task))))
       (forms-weighted-sum trial (forms-program-judge-forces judge) point))))

(defun forms-rate-pairs (task names motion point)
  "The rates of the g_j along the motion, which vanish."
  (let ((direction (acons '$t (forms-fixed 1)
                          (mapcar #'cons (append (forms-task-q task) names)
                                  (forms-program-values
                                   (append (forms-canonical-motion-velocities motion)
                                           (forms-canonical-motion-forces motion))
                                   point)))))
    (loop for bond in (forms-canonical-motion-bonds motion)
          for g = (forms-bond-rate bond)
          collect (cons (first (forms-slopes-along
                                (list (lambda (point)
                                        (first (forms-program-values (list g) point))))
                                point direction))
                        0))))

;;; Of a function H: the velocities are its slopes by the momenta, and for a random displacement
;;; sum c_i p_i' = -D_q H + c.Q + lambda.A c.

(defun forms-check-canonical (function forces names task motion)
  "FUNCTION is H, FORCES are Q, expressions."
  (let* ((trial (forms-new-trial (forms-task-q task) names (forms-task-a task)))
         (point (forms-new-point t)) (value (forms-values-of function)))
    (forms-verdict-of
     "velocities and virtual work against quotients of differences of H"
     (or (catch 'forms-no-value
           (let ((velocities (forms-program-values (forms-canonical-motion-velocities motion)
                                                   point)))
             (forms-set-places (forms-task-v task) velocities point)
             (append
              (loop for p in names
                    for velocity in velocities
                    collect (cons velocity
                                  (first (forms-slopes-along (list value) point
                                                             (list (cons p (forms-fixed 1)))))))
              (list (cons (forms-work-of-forces task trial motion point)
                          (- (forms-weighted-sum trial forces point)
                             (forms-slope trial value point (forms-task-q task)))))
              (forms-rate-pairs task names motion point))))
         '((nil)))
     point)))

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
