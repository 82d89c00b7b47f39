;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The momentum of all bodies along a small displacement of the whole system as one rigid body: a
;;; turn w and a shift v. With X = (w . v) of O_k carried into the axes of each body it is
;;;     sum over bodies of (X, x_i) q_i' + (X, x_0) + h.w,
;;; x_i the twists and ( , ) the product of inertia.lisp: for w = e, v = 0 the moment K.e of the
;;; momenta about an axis through O_0, for w = 0, v = e the momentum along e.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/inertia"))

(defun linmodel-displaced (a link twist)
  "The displacement TWIST of the parent's point O, in the parent's axes, carried to LINK."
  (destructuring-bind (w . v) twist
    (let ((turns (linmodel-link-turns a link))
          (arm (linmodel-cross a w (linmodel-link-joint a link))))
      (cons (linmodel-turned-by-all a turns w)
            (linmodel-turned-by-all a turns (linmodel-vector-plus a v arm))))))

(defun linmodel-momentum-along (a body displacement twists velocities)
  "The part of BODY: VELOCITIES begin with that of x_0, which is 1."
  (let ((momentum (linmodel-body-momentum body)) (sum 0))
    (loop for (i . twist) in twists
          do (setq sum (linmodel-plus
                        a sum (linmodel-times a (linmodel-twist-product a body displacement twist)
                                              (nth i velocities)))))
    (if momentum (linmodel-plus a sum (linmodel-dot a momentum (car displacement))) sum)))

(defun linmodel-all-along (a links bodies twists velocities start)
  (let ((displacements
          (linmodel-over-links
           links (lambda (link parent) (linmodel-displaced a link (or parent start)))))
        (sum 0))
    (dolist (body bodies sum)
      (let ((k (1- (linmodel-body-link body))))
        (setq sum (linmodel-plus a sum (linmodel-momentum-along a body (nth k displacements)
                                                                (nth k twists) velocities)))))))

(defun $linmodel_rigid_momenta (links bodies velocities displacements form)
  "The momenta along DISPLACEMENTS [w, v] of O_0 in axes 0; VELOCITIES are [1, v_1, ..]."
  (linmodel-compute
   form
   (lambda (a)
     (let ((twists (linmodel-all-twists a (cdr links) (- (length velocities) 2)))
           (bodies (mapcar (lambda (body) (linmodel-read-body a body)) (cdr bodies)))
           (velocities (linmodel-lift-vector a velocities)))
       (linmodel-lower-vector
        a (loop for displacement in (cdr displacements)
                for (w v) = (mapcar (lambda (x) (linmodel-lift-vector a x)) (cdr displacement))
                for start = (cons w v)
                collect (linmodel-all-along a (cdr links) bodies twists velocities start)))))))
