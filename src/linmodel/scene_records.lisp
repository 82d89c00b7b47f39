;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A system of bodies as it was read and checked. Expressions in it are Maxima's, with prescribed
;;; functions put in; a row [c_0, c_1, .., c_n] means the rate c_0 + sum c_i q_i'; the index of a
;;; link is its place in the list, 0 the fixed axes. Look at linmodel-scene first: it is what all
;;; functions of bodies take.

(in-package :maxima)

(defparameter *linmodel-none* '((mlist simp)))
(defparameter *linmodel-zero-vector* '((mlist simp) 0 0 0))

(core-record linmodel-scene
  "The links stand after their parents; GIVEN are keys of [system] as equations."
  (coordinates *linmodel-none*) ; with the angles of rotors that are not driven at a given speed
  (links *linmodel-none*)
  (bodies *linmodel-none*)
  (rotors *linmodel-none*)
  (field nil)                   ; nil where there is none
  (springs *linmodel-none*)
  (loads *linmodel-none*)       ; forces and torques
  (given *linmodel-none*))

(core-record linmodel-link
  "Axes of a body or a frame: its section, the index of its parent, its turns, the joint in axes of
the parent and the three rows of the joint's velocity there."
  section parent turns joint rows)

(core-record linmodel-turn
  "A simple rotation by an angle about one of the axes 1, 2, 3; 0 stands for an angle of which the
rate is all that matters."
  axis angle row)

(core-record linmodel-body
  "What moves with a link, in its axes; the inertia about O_k or about the mass centre and the
momentum of rotors inside are false where they are not given, and without both it is a point mass."
  link mass centre joint-inertia centre-inertia (momentum nil))

(core-record linmodel-rotor
  "A body whose angle is no coordinate; KIND is free, momentum or control, VALUE h or Q."
  section angle kind value)

(core-record linmodel-field
  "KIND is constant, with its gravity, or newton, with its centre."
  kind (gravity *linmodel-zero-vector*) (centre nil))

(core-record linmodel-centre
  "A Newtonian centre: its strength nu, the distance of O_1 from it, the unit vector chi from it to
O_1 and the index of the link of body 1."
  strength distance direction link)

(core-record linmodel-spring
  "A spring with an ANGLE, or between points of two links, ENDS; REST: its angle or length at rest."
  section stiffness damping rest (angle nil) (ends *linmodel-none*) (points *linmodel-none*))

(core-record linmodel-load
  "A force at a point of a link, or a torque, with their components in the AXES of another link."
  section link point force torque axes)

(core-record linmodel-twist
  "What q_i' (the time where i is 0) adds to the velocities of a link, in its axes: to its angular
velocity and to the velocity of O_k."
  index turning moving)

;;; A carrier, the body that carries all others (euler_poisson_carrier.mac)

(core-record linmodel-carrier
  "In the scene that is GIVEN: the links of the support and the rings beneath the carrier; those
that are KEPT, the carrier's and what it carries; the coordinates that are HIDDEN, since the
velocities of the carrier take their place; whether its origin is FREE; the SCENE in these."
  given support rings kept hidden free scene)

(core-record linmodel-support
  "The TURN A with x_0 = A*x_S, the SPIN Omega in axes S, the ORIGIN O of the carrier in axes 0,
false where the carrier is free. Axes S are axes 0 where the support does not turn."
  turn spin origin)

(core-record linmodel-felt-field
  "The field in axes S as the carrier feels it: gravity, the pull - O'', the centre, the vector
O_1 O. What has no moment about O is [0, 0, 0]."
  gravity pull (centre nil) (away *linmodel-zero-vector*))

(core-record linmodel-motion-names
  "Variables of the equations: omega, the directions, a list of vectors, the relative coordinates
and their velocities."
  omega directions relative speeds)

(defun $linmodel_given (scene key)
  "The KEY of [system] of the description that SCENE was read from."
  ($core_get (linmodel-scene-given scene) key))

(defun linmodel-gravity (scene)
  "The acceleration of a constant field, zero where there is another one or none."
  (let ((field (linmodel-scene-field scene)))
    (if field (linmodel-field-gravity field) *linmodel-zero-vector*)))

;;; The expressions of links and bodies

(defun linmodel-changed-link (function link)
  (flet ((turn (turn)
           (make-linmodel-turn :axis (linmodel-turn-axis turn)
                               :angle (funcall function (linmodel-turn-angle turn))
                               :row (funcall function (linmodel-turn-row turn)))))
    (make-linmodel-link :section (linmodel-link-section link)
                        :parent (linmodel-link-parent link)
                        :turns (cons '(mlist simp)
                                     (mapcar #'turn (cdr (linmodel-link-turns link))))
                        :joint (funcall function (linmodel-link-joint link))
                        :rows (funcall function (linmodel-link-rows link)))))

(defun linmodel-changed-body (function body)
  (make-linmodel-body :link (linmodel-body-link body)
                      :mass (funcall function (linmodel-body-mass body))
                      :centre (funcall function (linmodel-body-centre body))
                      :joint-inertia (funcall function (linmodel-body-joint-inertia body))
                      :centre-inertia (funcall function (linmodel-body-centre-inertia body))
                      :momentum (funcall function (linmodel-body-momentum body))))

(defun linmodel-changed-scene (function scene)
  (flet ((each (change records)
           (cons '(mlist simp)
                 (mapcar (lambda (record) (funcall change function record)) (cdr records)))))
    (let ((copy (copy-linmodel-scene scene)))
      (setf (linmodel-scene-links copy)
            (each #'linmodel-changed-link (linmodel-scene-links scene))
            (linmodel-scene-bodies copy)
            (each #'linmodel-changed-body (linmodel-scene-bodies scene)))
      copy)))

(defun $linmodel_changed_scene (function scene)
  "SCENE with FUNCTION of each expression in its links and bodies."
  (linmodel-changed-scene (lambda (e) (mfuncall function e)) scene))

(defun $linmodel_expressions_of (scene)
  "The expressions in the links and bodies of SCENE."
  (let ((found '()))
    (linmodel-changed-scene (lambda (e) (push e found) e) scene)
    (cons '(mlist simp) found)))
