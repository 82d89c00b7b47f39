;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Generalized forces by partial velocities: a force F at the point p of a link and a torque M,
;;; both turned into the axes of the link, give
;;;     Q_i = F.(v_i + w_i x p) + M.w_i.
;;; The way between two axes goes through the tree, up to the nearest common axes and down again,
;;; so that a force that follows its body is not turned at all. See linmodel-add-load first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/twists" "linmodel/energy_value" "forms/value" "forms/fixed"
                "forms/agreement" "linmodel/arithmetic" "linmodel/scene_records"
                "linmodel/frames"))

(defun linmodel-ancestors (links k)
  "The links from the fixed axes down to the link number K."
  (let ((line '()))
    (loop until (eql k 0)
          do (push (nth (1- k) links) line)
             (setq k (linmodel-link-parent (first line))))
    line))

(defun linmodel-carried-over (a links from to vector)
  "VECTOR, given in the axes of link FROM, in those of link TO; 0 is the fixed axes."
  (let ((up (linmodel-ancestors links from)) (down (linmodel-ancestors links to)))
    (loop while (and up down (eq (car up) (car down)))
          do (pop up) (pop down))
    (dolist (link (reverse up))
      (setq vector (linmodel-turned-by-all
                    a (linmodel-back-turns a (linmodel-lift-turns a link)) vector)))
    (dolist (link down vector)
      (setq vector (linmodel-turned-by-all a (linmodel-lift-turns a link) vector)))))

(defun linmodel-add-load (a links all-twists load forces)
  "Adds to the array FORCES those of LOAD."
  (let ((link (linmodel-load-link load)) (axes (linmodel-load-axes load)))
    (flet ((here (vector)
             (linmodel-carried-over a links axes link (linmodel-lift-vector a vector))))
      (let ((force (here (linmodel-load-force load)))
            (torque (here (linmodel-load-torque load)))
            (point (linmodel-lift-vector a (linmodel-load-point load))))
        (loop for (i w . v) in (nth (1- link) all-twists)
              for partial = (linmodel-vector-plus a v (linmodel-cross a w point))
              do (setf (aref forces i)
                       (linmodel-plus a (aref forces i)
                                      (linmodel-plus a (linmodel-dot a force partial)
                                                     (linmodel-dot a torque w)))))))))

;;; The judge: the power sum Q_i q_i' in fixed axes, in numbers.

(defun linmodel-power-value (load frames point)
  (let* ((frame (aref frames (linmodel-load-link load)))
         (axes (linmodel-frame-cosines (aref frames (linmodel-load-axes load)))))
    (flet ((fixed (vector)
             (linmodel-fixed-combination axes (linmodel-fixed-vector vector point))))
      (let ((torque (fixed (linmodel-load-torque load)))
            (velocity (linmodel-fixed-plus
                       (linmodel-frame-velocity frame)
                       (linmodel-fixed-combination
                        (linmodel-frame-cosine-rates frame)
                        (linmodel-fixed-vector (linmodel-load-point load) point)))))
        (+ (forms-fixed-dot (fixed (linmodel-load-force load)) velocity)
           (linmodel-along-turning (mapcar (lambda (column) (forms-fixed-dot column torque))
                                           (linmodel-frame-cosines frame))
                                   frame))))))

(defun linmodel-power-of-all (scene loads v point)
  "Without that of the motion that is given: the rate of the time is 0."
  (let ((frames (linmodel-frames-at (cdr (linmodel-scene-links scene))
                                    (cons 0 (cdr (linmodel-rates-at v point))) point)))
    (loop for load in loads sum (linmodel-power-value load frames point))))

;;; For Maxima; velocities in LOADS are plain symbols.

(defun $linmodel_generalized_forces (scene loads form)
  "[Q_1, .., Q_n] of the LOADS."
  (linmodel-compute
   form
   (lambda (a)
     (let* ((links (cdr (linmodel-scene-links scene)))
            (n (length (cdr (linmodel-scene-coordinates scene))))
            (all-twists (linmodel-all-twists a links n))
            (forces (make-array (1+ n) :initial-element 0)))
       (dolist (load (cdr loads))
         (linmodel-add-load a links all-twists load forces))
       (linmodel-lower-vector a (cdr (coerce forces 'list)))))))

(defun $linmodel_check_power (forces scene loads v)
  "The generalized FORCES against the power of the LOADS; V are the symbols of the velocities."
  (let ((point (forms-new-point t)))
    (forms-verdict "Q against the power of the forces in fixed axes"
                   (catch 'forms-no-value
                     (loop for force in (cdr forces)
                           for rate in (cdr v)
                           sum (forms-fixed-times (forms-fixed-value force point)
                                                  (forms-variable-value rate point))))
                   (catch 'forms-no-value
                     (linmodel-power-of-all scene (cdr loads) (cdr v) point))
                   point)))
