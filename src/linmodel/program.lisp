;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The recursion over bodies on programs: the loads (N . F) of motions.lisp are carried inwards.
;;; Their products with the link's own twists s_i, what q_i' adds to it beside its parent's motion,
;;; are the forces: Newton and Euler's equations, a constant number of operations for each body.
;;; See linmodel-bias-forces first; M and the accelerations are in program_inertia.lisp.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/motions" "algebra/program_derivative"))

(defun linmodel-program-arithmetic ()
  (make-linmodel-arithmetic
   :lift #'algebra-program-element
   :lower #'identity
   :add #'algebra-program-add
   :multiply #'algebra-program-multiply
   :sine (lambda (angle) (algebra-program-sine (algebra-program-element angle)))
   :cosine (lambda (angle) (algebra-program-cosine (algebra-program-element angle)))))

;;; Inwards. A load is (N . F).

(defun linmodel-load-plus (a x y)
  (cons (linmodel-vector-plus a (car x) (car y)) (linmodel-vector-plus a (cdr x) (cdr y))))

(defun linmodel-carried-load (a joint load)
  "LOAD on the link of JOINT in axes of its parent, about the parent's O."
  (let ((moment (linmodel-turned-by-all a (linmodel-joint-back joint) (car load)))
        (force (linmodel-turned-by-all a (linmodel-joint-back joint) (cdr load))))
    (cons (linmodel-vector-plus a moment (linmodel-cross a (linmodel-joint-place joint) force))
          force)))

(defun linmodel-load-along (a twist load)
  (linmodel-plus a (linmodel-dot a (car twist) (car load)) (linmodel-dot a (cdr twist) (cdr load))))

(defun linmodel-no-load () (cons (list 0 0 0) (list 0 0 0)))

(defun linmodel-own-load (a joint motion)
  (let ((load (linmodel-no-load)))
    (dolist (body (linmodel-joint-bodies joint) load)
      (setq load (linmodel-load-plus a load (linmodel-body-load a body motion))))))

(defun linmodel-bias-loads (a joints motions)
  (coerce (loop for joint across joints
                for motion across motions
                collect (and joint (linmodel-own-load a joint motion)))
          'vector))

(defun linmodel-forces-of-loads (a joints loads n)
  "The generalized forces that give the LOADS, which are spent."
  (let ((forces (make-array (1+ n) :initial-element 0)))
    (loop for k from (1- (length joints)) downto 1
          for joint = (aref joints k)
          for parent = (linmodel-joint-parent joint)
          do (loop for (i . twist) in (linmodel-joint-twists joint)
                   do (setf (aref forces i)
                            (linmodel-plus a (aref forces i)
                                           (linmodel-load-along a twist (aref loads k)))))
             (when (> parent 0)
               (setf (aref loads parent)
                     (linmodel-load-plus a (aref loads parent)
                                         (linmodel-carried-load a joint (aref loads k))))))
    (cdr (coerce forces 'list))))

(defun linmodel-bias-forces (a joints state gravity n)
  "The forces for the accelerations of STATE: M q'' minus those of the field and of inertia."
  (linmodel-forces-of-loads
   a joints (linmodel-bias-loads a joints (linmodel-motions a joints state gravity)) n))
