;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The kinetic energy as one expression: by pairs of velocities, the sum of (x_i, x_j) q_i' q_j'/2
;;; of inertia.lisp, or by bodies, the sum of (x, x)/2, x = (w . v) the velocities of each as sums.
;;; In space the latter is shorter by far where nothing is multiplied out: n bodies with two angles
;;; each have some 3^n terms instead of 6^n. In the plane the former has one cosine for each pair
;;; of links.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/motions"))

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
                      (linmodel-along turn (rate (linmodel-turn-row turn)))))))))

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
         (reached (linmodel-velocities a (linmodel-read-joints a links bodies state) state))
         (sum 0))
    (dolist (body (linmodel-read-bodies a bodies) sum)
      (let ((velocity (aref reached (linmodel-body-link body)))
            (momentum (linmodel-body-momentum body)))
        (setq sum (linmodel-plus
                   a sum (linmodel-half a (linmodel-twist-product a body velocity velocity))))
        (when momentum
          (setq sum (linmodel-plus a sum (linmodel-dot a momentum (car velocity)))))))))

(defun linmodel-moves-by-itself-p (links bodies)
  "Whether T has terms of less than the second degree: something moves with the time or spins."
  (or (some (lambda (body) (seventh body)) (cdr bodies))
      (loop for link in (cdr links)
            thereis (notevery (lambda (row) (eql 0 (second row)))
                              (append (mapcar #'fourth (cdr (fourth link))) (cdr (sixth link)))))))

;;; For Maxima.

(defun $linmodel_energy (scene velocities form)
  "[T, true where it has terms of less than the second degree in the VELOCITIES]."
  (destructuring-bind (q links bodies) (cdr scene)
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
