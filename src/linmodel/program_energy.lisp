;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; T, U and L as programs: velocities outwards, each link's (w . v) in its own axes from its
;;; parent's, T = sum of (x, x)/2 + h.w as in inertia.lisp; heights as in twists.lisp. The number of
;;; operations is linear in the number of bodies. See linmodel-program-kinetic first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/program_equations"))

(defun linmodel-link-velocity (a joint velocity state)
  "From the parent's (w . v) that of JOINT's link."
  (destructuring-bind (w . v) velocity
    (flet ((rate (row) (linmodel-row-velocity a row state)))
      (setq v (linmodel-vector-plus
               a (linmodel-vector-plus a v (linmodel-cross a w (linmodel-joint-place joint)))
               (mapcar #'rate (linmodel-joint-rows joint))))
      (dolist (turn (linmodel-joint-turns joint) (cons w v))
        (setq v (linmodel-turned a turn v)
              w (linmodel-vector-plus
                 a (linmodel-turned a turn w)
                 (linmodel-along turn (rate (linmodel-turn-row turn)))))))))

(defun linmodel-link-velocities (a joints state)
  (let ((velocities (make-array (length joints) :initial-element (linmodel-no-load))))
    (loop for k from 1 below (length joints)
          for joint = (aref joints k)
          for parent = (aref velocities (linmodel-joint-parent joint))
          do (setf (aref velocities k) (linmodel-link-velocity a joint parent state)))
    velocities))

(defun linmodel-program-kinetic (a joints state)
  "T."
  (let ((velocities (linmodel-link-velocities a joints state)) (sum 0))
    (loop for k from 1 below (length joints)
          for x = (aref velocities k)
          do (dolist (body (linmodel-joint-bodies (aref joints k)))
               (setq sum (linmodel-plus a sum (linmodel-program-kinetic-of a body x)))))
    sum))

(defun linmodel-program-kinetic-of (a body x)
  (let ((momentum (linmodel-body-momentum body)))
    (linmodel-plus a
                   (linmodel-times a 1/2 (linmodel-twist-product a body x x))
                   (if momentum (linmodel-dot a momentum (car x)) 0))))

(defun linmodel-program-weight (a links bodies gravity)
  "sum m g.r_C."
  (let ((carried (linmodel-carried-vectors a links gravity)) (sum 0))
    (dolist (body (cdr bodies) sum)
      (setq sum (linmodel-plus
                 a sum (linmodel-weight a body (nth (1- (second body)) carried)))))))

;;; For Maxima.

(defun $linmodel_function_program (scene gravity potential task name kinetic)
  "The record of NAME: T where KINETIC is true, the weight's U, and the POTENTIAL beside it."
  (destructuring-bind (links bodies) (cddr scene)
    (let ((task (forms-read-task task)))
      (with-algebra-program
        (let* ((a (linmodel-program-arithmetic))
               (state (linmodel-program-state task)))
          (forms-function-program
           task name
           (algebra-program-sum
            (list (if kinetic
                      (linmodel-program-kinetic
                       a (linmodel-read-joints a links bodies state) state)
                      0)
                  (linmodel-program-weight a links bodies gravity)
                  (algebra-program-element potential)))
           (lambda (point)
             (+ (funcall (linmodel-value-of scene (forms-task-v task) gravity point kinetic) point)
                (forms-fixed-value potential point)))
           "value of the program against that in fixed axes"))))))
