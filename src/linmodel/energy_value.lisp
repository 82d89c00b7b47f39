;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; T and U in numbers, from the frames in fixed axes:
;;;     T_k = m r_C'.r_C'/2 + trace(A' J A'^T)/2 + h.w,   J = trace(Theta_C)/2 - Theta_C,
;;;     U_k = m g.r_C,
;;; h the momentum of rotors inside, w the angular velocity, A^T A' its skew matrix.
;;; They judge the expressions for T and U, and as functions of a point the mass form.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/frames" "forms/judge"))

(defstruct linmodel-solid link mass centre moments momentum) ; numbers; moments: rows of J, or nil

(defun linmodel-solid-at (body point)
  (destructuring-bind (link mass centre joint-inertia centre-inertia &optional momentum) (cdr body)
    (flet ((rows (tensor)
             (and tensor (mapcar (lambda (row) (linmodel-fixed-vector row point)) (cdr tensor)))))
      (let ((mass (forms-fixed-value mass point))
            (centre (linmodel-fixed-vector centre point)))
        (make-linmodel-solid
         :link link :mass mass :centre centre
         :moments (linmodel-moments
                   (if joint-inertia
                       (linmodel-fixed-about-centre (rows joint-inertia) mass centre)
                       (rows centre-inertia)))
         :momentum (and momentum (linmodel-fixed-vector momentum point)))))))

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
       (linmodel-gyrostat-value (linmodel-solid-momentum solid) frame))))

(defun linmodel-trace-value (moments columns)
  "trace(A' J A'^T), A' of the COLUMNS."
  (loop for row in moments
        for u in columns
        sum (forms-fixed-dot u (linmodel-fixed-combination columns row))))

(defun linmodel-gyrostat-value (momentum frame)
  (if (null momentum)
      0
      (let ((a (linmodel-frame-cosines frame)) (da (linmodel-frame-cosine-rates frame)))
        (flet ((skew (i j) (forms-fixed-dot (nth i a) (nth j da))))
          (forms-fixed-dot momentum (list (skew 2 1) (skew 0 2) (skew 1 0)))))))

(defun linmodel-weight-value (solid frame gravity)
  (forms-fixed-times
   (linmodel-solid-mass solid)
   (forms-fixed-dot gravity
                    (linmodel-fixed-plus
                     (linmodel-frame-place frame)
                     (linmodel-fixed-combination (linmodel-frame-cosines frame)
                                                 (linmodel-solid-centre solid))))))

(defun linmodel-value-of (scene v gravity base kinetic)
  "The function of points whose value is T (where KINETIC is not nil) plus the weight's U; masses
and tensors are those at the point BASE."
  (destructuring-bind (links bodies) (cddr scene)
    (let ((solids (mapcar (lambda (body) (linmodel-solid-at body base)) (cdr bodies)))
          (gravity (linmodel-fixed-vector gravity base)))
      (lambda (point)
        (let ((frames (linmodel-frames-at (cdr links) (linmodel-rates-at v point) point)))
          (loop for solid in solids
                for frame = (aref frames (linmodel-solid-link solid))
                sum (if kinetic (linmodel-kinetic-value solid frame) 0)
                sum (linmodel-weight-value solid frame gravity)))))))

(defun linmodel-rates-at (v point)
  (cons (ash 1 forms-digits) (mapcar (lambda (x) (forms-variable-value x point)) v)))

;;; For Maxima.

(defun $linmodel_check_value (how found scene v gravity kinetic)
  "FOUND against T, where KINETIC is true, and the weight's U in fixed axes."
  (let ((point (forms-new-point t)))
    (forms-verdict how
                   (catch 'forms-no-value (forms-fixed-value found point))
                   (catch 'forms-no-value
                     (funcall (linmodel-value-of scene (cdr v) gravity point kinetic) point))
                   point)))

(defun $linmodel_check_mass_form (residuals scene gravity actions v a)
  "The RESIDUALS of M a = f against T and U in fixed axes; ACTIONS: [U, R, [Q_1, ..]] beside these."
  (destructuring-bind (potential dissipation forces) (cdr actions)
    (let* ((trial (forms-new-trial (cdr (second scene)) (cdr v) (cdr a)))
           (point (forms-trial-point trial))
           (function (catch 'forms-no-value
                       (linmodel-value-of scene (cdr v) gravity point t))))
      (multiple-value-bind (found expected)
          (and function
               (forms-both-sides trial (cdr residuals)
                                 (lambda (point) (+ (funcall function point)
                                                    (forms-fixed-value potential point)))
                                 dissipation (cdr forces) point))
        (forms-verdict "d/dt dL/dq' - dL/dq as quotients of differences of L in fixed axes"
                       found expected point)))))

(defun $linmodel_is_lagrangian (function scene v gravity potential)
  "Whether FUNCTION is T + U at a random point, U the weight's and POTENTIAL."
  (let* ((point (forms-new-point t))
         (found (catch 'forms-no-value (forms-fixed-value function point)))
         (expected (catch 'forms-no-value
                     (+ (funcall (linmodel-value-of scene (cdr v) gravity point t) point)
                        (forms-fixed-value potential point)))))
    (and found expected (not (forms-differ-p found expected)))))
