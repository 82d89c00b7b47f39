;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Generalized forces by partial velocities: a force F at the point p of a link and a torque M,
;;; both turned into the axes of the link, give
;;;     Q_i = F.(v_i + w_i x p) + M.w_i.
;;; The way between two axes goes through the tree, up to the nearest common axes and down again,
;;; so that a force that follows its body is not turned at all. See linmodel-add-load first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/twists"))

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
                    a (linmodel-back-turns a (linmodel-link-turns a link)) vector)))
    (dolist (link down vector)
      (setq vector (linmodel-turned-by-all a (linmodel-link-turns a link) vector)))))

(defun linmodel-add-load (a links all-twists load forces)
  "Adds to the array FORCES those of LOAD: [link, point, force, torque, link of their axes]."
  (destructuring-bind (link point force torque axes) (cdr load)
    (flet ((here (vector)
             (linmodel-carried-over a links axes link (linmodel-lift-vector a vector))))
      (let ((force (here force)) (torque (here torque)) (point (linmodel-lift-vector a point)))
        (loop for (i w . v) in (nth (1- link) all-twists)
              for partial = (linmodel-vector-plus a v (linmodel-cross a w point))
              do (setf (aref forces i)
                       (linmodel-plus a (aref forces i)
                                      (linmodel-plus a (linmodel-dot a force partial)
                                                     (linmodel-dot a torque w)))))))))

;;; For Maxima.

(defun $linmodel_generalized_forces (links loads n form)
  "[Q_1, .., Q_N] of the LOADS."
  (linmodel-compute
   form
   (lambda (a)
     (let* ((links (cdr links))
            (all-twists (linmodel-all-twists a links n))
            (forces (make-array (1+ n) :initial-element 0)))
       (dolist (load (cdr loads))
         (linmodel-add-load a links all-twists load forces))
       (linmodel-lower-vector a (cdr (coerce forces 'list)))))))
