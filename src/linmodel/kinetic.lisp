;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The kinetic energy as a quadratic form in the generalized velocities, and as one expression.
;;; Formula (1) of the source paper for a body, all in its axes, Theta about O_k, c from O_k to the
;;; centre of mass,
;;;     T = m v.v/2 + w.Theta.w/2 + m (v x w).c
;;; belongs to the product of two twists
;;;     (x, y) = m v_x.v_y + w_x.Theta.w_y + m ((v_x x w_y) + (v_y x w_x)).c,   T = (x, x)/2,
;;; so that M_ij = sum over bodies of (x_i, x_j): the mass matrix by projection, without a
;;; derivative of T. A body whose tensor is given about its centre of mass, and a point mass:
;;;     (x, y) = m u_x.u_y + w_x.Theta.w_y,   u = v + w x c.
;;; Rotors inside of constant relative momentum h add h.w to T: h.w_i to (x_0, x_i).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/motions" "linmodel/twists" "linmodel/arithmetic"
                "linmodel/scene_records" "linmodel/rate_rows"))

(defun linmodel-twist-product (a body x y)
  (if (linmodel-lifted-joint-inertia body)
      (linmodel-product-about-joint a body x y)
      (linmodel-product-about-centre a body x y)))

(defun linmodel-product-about-joint (a body x y)
  (destructuring-bind ((wx . vx) (wy . vy)) (list x y)
    (let* ((mixed (linmodel-vector-plus a (linmodel-cross a vx wy) (linmodel-cross a vy wx)))
           (translation (linmodel-plus a (linmodel-dot a vx vy)
                                       (linmodel-dot a mixed (linmodel-lifted-centre body)))))
      (linmodel-plus a (linmodel-times a (linmodel-lifted-mass body) translation)
                     (linmodel-rotation-product a (linmodel-lifted-joint-inertia body) wx wy)))))

(defun linmodel-product-about-centre (a body x y)
  (let ((translation (linmodel-dot a (linmodel-centre-velocity a body x)
                                   (linmodel-centre-velocity a body y)))
        (tensor (linmodel-lifted-centre-inertia body)))
    (linmodel-plus a (linmodel-times a (linmodel-lifted-mass body) translation)
                   (linmodel-rotation-product a tensor (car x) (car y)))))

(defun linmodel-rotation-product (a tensor wx wy)
  (if tensor (linmodel-dot a wx (linmodel-matrix-times a tensor wy)) 0))

(defun linmodel-centre-velocity (a body x)
  (linmodel-vector-plus a (cdr x) (linmodel-cross a (car x) (linmodel-lifted-centre body))))

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
                           (linmodel-lift-bodies a bodies)
                           n))

(defun linmodel-form-of-twists (a twists bodies n)
  "The same for the TWISTS of each link."
  (let ((form (make-array (list (1+ n) (1+ n)) :initial-element 0)))
    (dolist (body bodies form)
      (let ((momentum (linmodel-lifted-momentum body))
            (body-twists (nth (1- (linmodel-lifted-link body)) twists)))
        (linmodel-add-body a form body body-twists)
        (when momentum (linmodel-add-momentum a form momentum body-twists))))))

;;; T as one expression: by pairs of velocities, the sum of (x_i, x_j) q_i' q_j'/2, or by bodies,
;;; the sum of (x, x)/2, x = (w . v) the velocities of each as sums. In space the latter is shorter
;;; by far where nothing is multiplied out: n bodies with two angles each have some 3^n terms
;;; instead of 6^n. In the plane the former has one cosine for each pair of links.

(defun linmodel-half (a x)
  (linmodel-times a (linmodel-lift a '((rat simp) 1 2)) x))

;;; By pairs of velocities.

(defun linmodel-energy-of-pairs (a links bodies velocities)
  "sum of (x_i, x_j) v_i v_j/2 over all i and j."
  (let ((form (linmodel-inertia-form a links bodies (1- (length velocities)))) (sum 0))
    (loop for i below (length velocities)
          for v in velocities
          do (loop for j from i below (length velocities)
                   for w in (nthcdr i velocities)
                   for product = (linmodel-times a (aref form i j) (linmodel-times a v w))
                   do (setq sum (linmodel-plus a sum
                                               (if (= i j) (linmodel-half a product) product)))))
    sum))

;;; By bodies.

(defun linmodel-joint-velocity (a joint velocity state)
  "From the parent's (w . v) that of JOINT's link."
  (destructuring-bind (w . v) velocity
    (flet ((rate (row) (linmodel-row-velocity a row state))
           (plus (x y) (linmodel-vector-plus a x y)))
      (setq v (plus (plus v (mapcar #'rate (linmodel-joint-rows joint)))
                    (linmodel-cross a w (linmodel-joint-place joint))))
      (dolist (turn (linmodel-joint-turns joint) (cons w v))
        (setq v (linmodel-turned a turn v)
              w (plus (linmodel-turned a turn w)
                      (linmodel-along turn (rate (linmodel-rotation-row turn)))))))))

(defun linmodel-velocities (a joints state)
  "The (w . v) of the links, in a vector with the fixed axes first."
  (let ((velocities (make-array (length joints) :initial-element (cons (list 0 0 0) (list 0 0 0)))))
    (loop for k from 1 below (length joints)
          for joint = (aref joints k)
          do (setf (aref velocities k)
                   (linmodel-joint-velocity
                    a joint (aref velocities (linmodel-joint-parent joint)) state)))
    velocities))

(defun linmodel-energy-of-bodies (a links bodies names velocities)
  (let* ((state (make-linmodel-state :names names :velocities (cdr velocities)
                                     :accelerations (mapcar (constantly 0) (cdr velocities))))
         (reached (linmodel-velocities a (linmodel-joints a links bodies state) state))
         (sum 0))
    (dolist (body (linmodel-lift-bodies a bodies) sum)
      (let ((velocity (aref reached (linmodel-lifted-link body)))
            (momentum (linmodel-lifted-momentum body)))
        (setq sum (linmodel-plus
                   a sum (linmodel-half a (linmodel-twist-product a body velocity velocity))))
        (when momentum
          (setq sum (linmodel-plus a sum (linmodel-dot a momentum (car velocity)))))))))

(defun linmodel-moves-by-itself-p (links bodies)
  "Whether T has terms of less than the second degree: something moves with the time or spins."
  (or (some #'linmodel-body-momentum (cdr bodies))
      (loop for link in (cdr links)
            thereis (notevery (lambda (row) (eql 0 (second row)))
                              (linmodel-rows-of-link link)))))

;;; For Maxima.

(defun $linmodel_energy (scene velocities form)
  "[T, true where it has terms of less than the second degree in the VELOCITIES]."
  (let ((q (linmodel-scene-coordinates scene))
        (links (linmodel-scene-links scene))
        (bodies (linmodel-scene-bodies scene)))
    (list '(mlist simp)
          (linmodel-compute
           form
           (lambda (a)
             (let ((velocities (linmodel-lift-vector a (cons '(mlist) (cons 1 (cdr velocities))))))
               (funcall (linmodel-arithmetic-lower a)
                        (if (or (linmodel-arithmetic-multiplies-out a) (linmodel-plane-p links))
                            (linmodel-energy-of-pairs a links bodies velocities)
                            (linmodel-energy-of-bodies a links bodies (cdr q) velocities)))))
           (linmodel-plane-p links))
          (linmodel-moves-by-itself-p links bodies))))
