;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The momentum of all bodies along a small displacement of the whole system as one rigid body: a
;;; turn w and a shift v. With X = (w . v) of O_k carried into the axes of each body it is
;;;     sum over bodies of (X, x_i) q_i' + (X, x_0) + h.w,
;;; x_i the twists and ( , ) the product of kinetic.lisp: for w = e, v = 0 the moment K.e of the
;;; momenta about an axis through O_0, for w = 0, v = e the momentum along e.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/kinetic" "linmodel/arithmetic" "linmodel/scene_records"
                "linmodel/twists"))

(defun linmodel-displaced (a link twist)
  "The displacement TWIST of the parent's point O, in the parent's axes, carried to LINK."
  (destructuring-bind (w . v) twist
    (let ((turns (linmodel-lift-turns a link))
          (arm (linmodel-cross a w (linmodel-lift-place a link))))
      (cons (linmodel-turned-by-all a turns w)
            (linmodel-turned-by-all a turns (linmodel-vector-plus a v arm))))))

(defun linmodel-momentum-along (a body displacement twists velocities)
  "The part of BODY: VELOCITIES begin with that of x_0, which is 1."
  (let ((momentum (linmodel-lifted-momentum body)) (sum 0))
    (loop for (i . twist) in twists
          do (setq sum (linmodel-plus
                        a sum (linmodel-times a (linmodel-twist-product a body displacement twist)
                                              (nth i velocities)))))
    (if momentum (linmodel-plus a sum (linmodel-dot a momentum (car displacement))) sum)))

(defun linmodel-all-displaced (a scene start)
  "The displacement START of O_0, in axes 0, carried to each link."
  (linmodel-over-links (cdr (linmodel-scene-links scene))
                       (lambda (link parent) (linmodel-displaced a link (or parent start)))))

(defun linmodel-all-along (a displacements bodies twists velocities)
  (let ((sum 0))
    (dolist (body bodies sum)
      (let ((k (1- (linmodel-lifted-link body))))
        (setq sum (linmodel-plus a sum (linmodel-momentum-along a body (nth k displacements)
                                                                (nth k twists) velocities)))))))

(defun linmodel-computed-momenta (scene velocities form momenta)
  "MOMENTA of the arithmetic, the twists of each link, bodies, [1, v_1, ..], as a Maxima list."
  (linmodel-compute
   form
   (lambda (a)
     (linmodel-lower-vector
      a (funcall momenta a
                 (linmodel-all-twists a (cdr (linmodel-scene-links scene))
                                      (- (length velocities) 2))
                 (linmodel-lift-bodies a (linmodel-scene-bodies scene))
                 (linmodel-lift-vector a velocities))))))

(defun $linmodel_rigid_momenta (scene velocities displacements form)
  "The momenta along DISPLACEMENTS [w, v] of O_0 in axes 0; VELOCITIES are [1, v_1, ..]."
  (linmodel-computed-momenta
   scene velocities form
   (lambda (a twists bodies velocities)
     (loop for displacement in (cdr displacements)
           for (w v) = (mapcar (lambda (x) (linmodel-lift-vector a x)) (cdr displacement))
           collect (linmodel-all-along a (linmodel-all-displaced a scene (cons w v))
                                       bodies twists velocities)))))

;;; The momentum of what one link carries about an axis of its own through O_k, (Theta.w + m c x
;;; v).e + h.e: a displacement of this link alone.

(defun linmodel-about-own-axis (a k direction bodies twists velocities)
  (let ((turn (cons (linmodel-lift-vector a direction) (list 0 0 0))) (sum 0))
    (dolist (body bodies sum)
      (when (= (linmodel-lifted-link body) k)
        (setq sum (linmodel-plus a sum (linmodel-momentum-along a body turn (nth (1- k) twists)
                                                                velocities)))))))

(defun $linmodel_own_momenta (scene velocities axes form)
  "The momenta about the AXES [k, e], e in the axes of link k; VELOCITIES are [1, v_1, ..]."
  (linmodel-computed-momenta
   scene velocities form
   (lambda (a twists bodies velocities)
     (loop for (nil k direction) in (cdr axes)
           collect (linmodel-about-own-axis a k direction bodies twists velocities)))))
