;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The kinetic energy as a quadratic form in the generalized velocities. Formula (1) of the source
;;; paper for a body, all in its axes, Theta about O_k, c from O_k to the centre of mass,
;;;     T = m v.v/2 + w.Theta.w/2 + m (v x w).c
;;; belongs to the product of two twists
;;;     (x, y) = m v_x.v_y + w_x.Theta.w_y + m ((v_x x w_y) + (v_y x w_x)).c,   T = (x, x)/2,
;;; so that M_ij = sum over bodies of (x_i, x_j): the mass matrix by projection, without a
;;; derivative of T. A body whose tensor is given about its centre of mass, and a point mass:
;;;     (x, y) = m u_x.u_y + w_x.Theta.w_y,   u = v + w x c.
;;; Rotors inside of constant relative momentum h add h.w to T: h.w_i to (x_0, x_i).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/twists"))

(defstruct linmodel-body link mass centre joint-inertia centre-inertia momentum)

(defun linmodel-read-body (a body)
  "BODY: [index of its link, mass, centre, inertia about O_k, about the centre, momentum]."
  (destructuring-bind (link mass centre joint-inertia centre-inertia &optional momentum) (cdr body)
    (make-linmodel-body :link link
                        :mass (funcall (linmodel-arithmetic-lift a) mass)
                        :centre (linmodel-lift-vector a centre)
                        :joint-inertia (linmodel-lift-tensor a joint-inertia)
                        :centre-inertia (linmodel-lift-tensor a centre-inertia)
                        :momentum (and momentum (linmodel-lift-vector a momentum)))))

(defun linmodel-lift-tensor (a tensor)
  (and tensor (mapcar (lambda (row) (linmodel-lift-vector a row)) (cdr tensor))))

(defun linmodel-twist-product (a body x y)
  (if (linmodel-body-joint-inertia body)
      (linmodel-product-about-joint a body x y)
      (linmodel-product-about-centre a body x y)))

(defun linmodel-product-about-joint (a body x y)
  (destructuring-bind ((wx . vx) (wy . vy)) (list x y)
    (let* ((mixed (linmodel-vector-plus a (linmodel-cross a vx wy) (linmodel-cross a vy wx)))
           (translation (linmodel-plus a (linmodel-dot a vx vy)
                                       (linmodel-dot a mixed (linmodel-body-centre body)))))
      (linmodel-plus a (linmodel-times a (linmodel-body-mass body) translation)
                     (linmodel-rotation-product a (linmodel-body-joint-inertia body) wx wy)))))

(defun linmodel-product-about-centre (a body x y)
  (let ((translation (linmodel-dot a (linmodel-centre-velocity a body x)
                                   (linmodel-centre-velocity a body y)))
        (tensor (linmodel-body-centre-inertia body)))
    (linmodel-plus a (linmodel-times a (linmodel-body-mass body) translation)
                   (linmodel-rotation-product a tensor (car x) (car y)))))

(defun linmodel-rotation-product (a tensor wx wy)
  (if tensor (linmodel-dot a wx (linmodel-matrix-times a tensor wy)) 0))

(defun linmodel-centre-velocity (a body x)
  (linmodel-vector-plus a (cdr x) (linmodel-cross a (car x) (linmodel-body-centre body))))

(defun linmodel-add-body (a form body twists)
  "Adds the products of the TWISTS of BODY to the upper half of FORM."
  (loop for ((i . x) . others) on twists
        do (loop for (j . y) in (cons (cons i x) others)
                 do (setf (aref form i j)
                          (linmodel-plus a (aref form i j) (linmodel-twist-product a body x y))))))

(defun linmodel-add-momentum (a form momentum twists)
  "Adds h.w to the FORM, h being the MOMENTUM of the rotors inside."
  (loop for (i w . nil) in twists
        for product = (linmodel-dot a momentum w)
        do (setf (aref form 0 i)
                 (linmodel-plus a (aref form 0 i)
                                (if (= i 0) (linmodel-plus a product product) product)))))

(defun linmodel-inertia-form (a links bodies n)
  "The array of (x_i, x_j), i <= j, i and j from 0 to N."
  (linmodel-form-of-twists a (linmodel-all-twists a (cdr links) n)
                           (mapcar (lambda (body) (linmodel-read-body a body)) (cdr bodies))
                           n))

(defun linmodel-form-of-twists (a twists bodies n)
  "The same for the TWISTS of each link."
  (let ((form (make-array (list (1+ n) (1+ n)) :initial-element 0)))
    (dolist (body bodies form)
      (let ((momentum (linmodel-body-momentum body))
            (body-twists (nth (1- (linmodel-body-link body)) twists)))
        (linmodel-add-body a form body body-twists)
        (when momentum (linmodel-add-momentum a form momentum body-twists))))))
