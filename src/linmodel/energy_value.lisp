;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; T and U in numbers, from the frames in fixed axes:
;;;     T_k = m r_C'.r_C'/2 + trace(A' J A'^T)/2 + h.w,   J = trace(Theta_C)/2 - Theta_C,
;;;     U_k = m g.r_C,
;;; h the momentum of rotors inside, w the angular velocity, A^T A' its skew matrix.
;;; They judge the expressions for T and U, and as functions of a point the mass form.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/frames" "forms/judge" "forms/agreement" "linmodel/scene_records"
                "forms/fixed" "forms/value"))

(defstruct linmodel-solid link mass centre moments momentum) ; numbers; moments: rows of J, or nil

(defun linmodel-fixed-rows (tensor point)
  (mapcar (lambda (row) (linmodel-fixed-vector row point)) (cdr tensor)))

(defun linmodel-solid-at (body point)
  (let ((mass (forms-fixed-value (linmodel-body-mass body) point))
        (centre (linmodel-fixed-vector (linmodel-body-centre body) point))
        (about-joint (linmodel-fixed-rows (linmodel-body-joint-inertia body) point))
        (about-centre (linmodel-fixed-rows (linmodel-body-centre-inertia body) point))
        (momentum (linmodel-body-momentum body)))
    (make-linmodel-solid
     :link (linmodel-body-link body) :mass mass :centre centre
     :moments (linmodel-moments (if about-joint
                                    (linmodel-fixed-about-centre about-joint mass centre)
                                    about-centre))
     :momentum (and momentum (linmodel-fixed-vector momentum point)))))

(defun linmodel-diagonal-minus (x rows)
  "X on the diagonal minus ROWS."
  (loop for row in rows
        for i from 0
        collect (loop for y in row
                      for j from 0
                      collect (- (if (= i j) x 0) y))))

(defun linmodel-fixed-about-centre (tensor mass centre)
  "Theta_O - m (c.c E - c c^T)"
  (let ((shift (linmodel-diagonal-minus
                (forms-fixed-dot centre centre)
                (mapcar (lambda (x) (linmodel-fixed-scaled x centre)) centre))))
    (mapcar (lambda (row moved) (mapcar #'- row (linmodel-fixed-scaled mass moved))) tensor shift)))

(defun linmodel-moments (tensor)
  (and tensor
       (linmodel-diagonal-minus
        (ash (loop for row in tensor for i from 0 sum (nth i row)) -1) tensor)))

(defun linmodel-kinetic-value (solid frame)
  (let* ((da (linmodel-frame-cosine-rates frame))
         (velocity (linmodel-fixed-plus
                    (linmodel-frame-velocity frame)
                    (linmodel-fixed-combination da (linmodel-solid-centre solid)))))
    (+ (ash (forms-fixed-times (linmodel-solid-mass solid) (forms-fixed-dot velocity velocity))
            -1)
       (ash (linmodel-trace-value (linmodel-solid-moments solid) da) -1)
       (if (linmodel-solid-momentum solid)
           (linmodel-along-turning (linmodel-solid-momentum solid) frame)
           0))))

(defun linmodel-trace-value (moments columns)
  "trace(A' J A'^T), A' of the COLUMNS."
  (loop for row in moments
        for u in columns
        sum (forms-fixed-dot u (linmodel-fixed-combination columns row))))

(defun linmodel-along-turning (vector frame)
  "VECTOR.w, both in axes of the FRAME."
  (let ((a (linmodel-frame-cosines frame)) (da (linmodel-frame-cosine-rates frame)))
    (flet ((skew (i j) (forms-fixed-dot (nth i a) (nth j da))))
      (forms-fixed-dot vector (list (skew 2 1) (skew 0 2) (skew 1 0))))))

(defun linmodel-weight-value (solid frame gravity)
  (forms-fixed-times
   (linmodel-solid-mass solid)
   (forms-fixed-dot gravity
                    (linmodel-fixed-plus
                     (linmodel-frame-place frame)
                     (linmodel-fixed-combination (linmodel-frame-cosines frame)
                                                 (linmodel-solid-centre solid))))))

(defun linmodel-value-of (scene v base what)
  "The function of points whose value is T, U or L, as WHAT says, U being the weight's; masses and
tensors are those at the point BASE."
  (let ((solids (mapcar (lambda (body) (linmodel-solid-at body base))
                        (cdr (linmodel-scene-bodies scene))))
        (links (cdr (linmodel-scene-links scene)))
        (gravity (linmodel-fixed-vector (linmodel-gravity scene) base))
        (kinetic (not (eq what '|$u|)))
        (weight (not (eq what '|$t|))))
    (lambda (point)
      (let ((frames (linmodel-frames-at links (linmodel-rates-at v point) point)))
        (loop for solid in solids
              for frame = (aref frames (linmodel-solid-link solid))
              sum (if kinetic (linmodel-kinetic-value solid frame) 0)
              sum (if weight (linmodel-weight-value solid frame gravity) 0))))))

;;; For Maxima; V are the plain symbols of the velocities.

(defun $linmodel_check_value (how found scene v what)
  "FOUND against T or the weight's U, as WHAT says, in fixed axes."
  (let ((point (forms-new-point t)))
    (forms-verdict how
                   (catch 'forms-no-value (forms-fixed-value found point))
                   (catch 'forms-no-value
                     (funcall (linmodel-value-of scene (cdr v) point what) point))
                   point)))

(defun $linmodel_check_mass_form (residuals scene actions v a)
  "The RESIDUALS of M a = f against T and U in fixed axes; ACTIONS: [U, R, [Q_1, ..]] beside these."
  (destructuring-bind (potential dissipation forces) (cdr actions)
    (let* ((trial (forms-new-trial (cdr (linmodel-scene-coordinates scene)) (cdr v) (cdr a)))
           (point (forms-trial-point trial))
           (function (catch 'forms-no-value (linmodel-value-of scene (cdr v) point '|$l|))))
      (multiple-value-bind (found expected)
          (and function
               (forms-both-sides trial (cdr residuals)
                                 (lambda (point) (+ (funcall function point)
                                                    (forms-fixed-value potential point)))
                                 dissipation (cdr forces) point))
        (forms-verdict "d/dt dL/dq' - dL/dq as quotients of differences of L in fixed axes"
                       found expected point)))))

(defun $linmodel_is_lagrangian (function scene v potential)
  "Whether FUNCTION is T + U at a random point, U the weight's and POTENTIAL."
  (let* ((point (forms-new-point t))
         (found (catch 'forms-no-value (forms-fixed-value function point)))
         (expected (catch 'forms-no-value
                     (+ (funcall (linmodel-value-of scene (cdr v) point '|$l|) point)
                        (forms-fixed-value potential point)))))
    (and found expected (not (forms-differ-p found expected)))))
