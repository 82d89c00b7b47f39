;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Positions and velocities in fixed axes, in numbers, with nothing of the recursion in body axes:
;;; what T, U, the forces and the equations are judged by. A frame has the direction cosines A of
;;; its axes (three columns), their rates A', the radius vector r of its origin and r'. From the
;;; parent j to k
;;;     r_k = r_j + A_j joint,   A_k = A_j times the simple rotations,
;;; differentiated by the rule of products. See linmodel-frames-at first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/value" "linmodel/scene_records" "forms/fixed"))

(defstruct linmodel-frame cosines cosine-rates place velocity)

(defun linmodel-fixed-plus (u v) (mapcar #'+ u v))
(defun linmodel-fixed-scaled (x v) (mapcar (lambda (y) (forms-fixed-times x y)) v))

(defun linmodel-fixed-combination (columns coefficients)
  "The vector sum of the COLUMNS times the COEFFICIENTS."
  (let ((sum (list 0 0 0)))
    (mapc (lambda (column x)
            (unless (eql x 0)
              (setq sum (linmodel-fixed-plus sum (linmodel-fixed-scaled x column)))))
          columns coefficients)
    sum))

(defun linmodel-fixed-vector (vector point)
  (mapcar (lambda (e) (forms-fixed-value e point)) (cdr vector)))

(defun linmodel-fixed-frame ()
  (let ((unit (ash 1 forms-digits)))
    (make-linmodel-frame :cosines (list (list unit 0 0) (list 0 unit 0) (list 0 0 unit))
                         :cosine-rates (list (list 0 0 0) (list 0 0 0) (list 0 0 0))
                         :place (list 0 0 0) :velocity (list 0 0 0))))

(defun linmodel-frames-at (links rates point)
  "The frames of the LINKS at POINT, a vector with the fixed axes first; RATES are 1, q_1', .."
  (let ((frames (make-array (1+ (length links)))))
    (setf (aref frames 0) (linmodel-fixed-frame))
    (loop for link in links
          for k from 1
          do (setf (aref frames k)
                   (linmodel-next-frame link (aref frames (linmodel-link-parent link)) rates
                                        point)))
    frames))

(defun linmodel-next-frame (link parent rates point)
  (let* ((joint (linmodel-fixed-vector (linmodel-link-joint link) point))
         (a (linmodel-frame-cosines parent))
         (da (linmodel-frame-cosine-rates parent))
         (relative (mapcar (lambda (row) (linmodel-rate-at row rates point))
                           (cdr (linmodel-link-rows link))))
         (frame (make-linmodel-frame
                 :place (linmodel-fixed-plus (linmodel-frame-place parent)
                                             (linmodel-fixed-combination a joint))
                 :velocity (linmodel-fixed-plus
                            (linmodel-frame-velocity parent)
                            (linmodel-fixed-plus (linmodel-fixed-combination da joint)
                                                 (linmodel-fixed-combination a relative))))))
    (dolist (turn (cdr (linmodel-link-turns link)))
      (multiple-value-setq (a da) (linmodel-turned-columns a da turn rates point)))
    (setf (linmodel-frame-cosines frame) a
          (linmodel-frame-cosine-rates frame) da)
    frame))

(defun linmodel-rate-at (row rates point)
  (let ((sum 0))
    (mapc (lambda (c rate)
            (unless (eql c 0) (incf sum (* (forms-fixed-value c point) rate))))
          (cdr row) rates)
    (ash sum (- forms-digits))))

(defun linmodel-turned-columns (a da turn rates point)
  "Columns i and j become c i + s j and c j - s i; the derivatives of these by the angle are the new
column j and the new column i with the other sign."
  (let* ((axis (linmodel-turn-axis turn))
         (i (mod axis 3)) (j (mod (1+ axis) 3))
         (a (copy-list a)) (da (copy-list da))
         (angle (forms-fixed-value (linmodel-turn-angle turn) point))
         (s (forms-function-value '((%sin)) (list angle) point))
         (c (forms-function-value '((%cos)) (list angle) point))
         (rate (linmodel-rate-at (linmodel-turn-row turn) rates point)))
    (flet ((sum (x y u v) (linmodel-fixed-combination (list x y) (list u v))))
      (psetf (nth i a) (sum (nth i a) (nth j a) c s)
             (nth j a) (sum (nth i a) (nth j a) (- s) c)
             (nth i da) (sum (nth i da) (nth j da) c s)
             (nth j da) (sum (nth i da) (nth j da) (- s) c))
      (setf (nth i da) (sum (nth i da) (nth j a) (ash 1 forms-digits) rate)
            (nth j da) (sum (nth j da) (nth i a) (ash 1 forms-digits) (- rate))))
    (values a da)))

(defun linmodel-rates-at (v point)
  "1 and the values of the velocities V."
  (cons (ash 1 forms-digits) (mapcar (lambda (x) (forms-variable-value x point)) v)))
