;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The force function of a Newtonian centre to the second order in size over distance, formula (2)
;;; of the source paper. O_1 is at r*chi from the centre; for a body with beta, the direction
;;; cosines of chi, p = O_1 O_k, c = O_k C and Theta about O_k, all in its axes,
;;;     U = nu*m/r - nu*m/r^2*beta.(p + c) + nu/(2*r^3)*(trace(Theta) - 3*beta.Theta.beta
;;;         + m*(3*(beta.p)^2 - p.p + 6*(beta.p)*(beta.c) - 2*p.c)).
;;; beta and p are turned along the tree. See linmodel-attraction first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/inertia"))

(defun linmodel-attraction (a body beta place factors)
  "The force function of BODY, its tensor about O_k; FACTORS are nu/r, -nu/r^2 and nu/(2 r^3)."
  (destructuring-bind (zeroth first-order second-order) factors
    (let ((m (linmodel-body-mass body))
          (away (linmodel-vector-plus a place (linmodel-body-centre body))))
      (linmodel-sum a
                    (linmodel-times a zeroth m)
                    (linmodel-times a first-order (linmodel-times a m (linmodel-dot a beta away)))
                    (linmodel-times a second-order (linmodel-second-order a body beta place))))))

(defun linmodel-second-order (a body beta place)
  (flet ((times (n x y) (linmodel-times a (linmodel-lift a n) (linmodel-times a x y))))
    (let* ((tensor (linmodel-body-joint-inertia body))
           (c (linmodel-body-centre body))
           (height (linmodel-dot a beta place))
           (turning (linmodel-dot a beta (linmodel-matrix-times a tensor beta)))
           (of-mass (linmodel-sum a
                                  (times 3 height height)
                                  (linmodel-minus a (linmodel-dot a place place))
                                  (times 6 height (linmodel-dot a beta c))
                                  (linmodel-times a (linmodel-lift a -2)
                                                  (linmodel-dot a place c)))))
      (linmodel-sum a
                    (linmodel-trace a tensor)
                    (linmodel-times a (linmodel-lift a -3) turning)
                    (linmodel-times a (linmodel-body-mass body) of-mass)))))

(defun linmodel-trace (a tensor)
  (apply #'linmodel-sum a (loop for row in tensor for i from 0 collect (nth i row))))

(defun linmodel-carried-places (a links first-link distance direction)
  "For each link (beta . p), p being zero for FIRST-LINK, that of body 1."
  (let* ((chi (linmodel-lift-vector a direction))
         (back (linmodel-vector-times a (linmodel-minus a (linmodel-lift a distance)) chi))
         (start (cons chi back)))
    (linmodel-over-links
     links
     (lambda (link pair)
       (destructuring-bind (beta . place) (linmodel-carried-place a link (or pair start))
         (linmodel-guard-place a beta place)
         (cons beta (if (eq link first-link) (list 0 0 0) place)))))))

(defun linmodel-carried-place (a link pair)
  (destructuring-bind (beta . place) pair
    (let ((turns (linmodel-link-turns a link)))
      (cons (linmodel-turned-by-all a turns beta)
            (linmodel-turned-by-all a turns
                                    (linmodel-vector-plus a place (linmodel-link-joint a link)))))))

(defun linmodel-guard-place (a beta place)
  (let ((terms 0))
    (dolist (x (append beta place))
      (incf terms (funcall (linmodel-arithmetic-size a) x)))
    (algebra-guard (* terms terms) "the canonical form of the force function")))

;;; For Maxima.

(defun $linmodel_newtonian (links bodies centre first-link form)
  "U of the BODIES, tensors about O_k; CENTRE: [nu, distance, direction]; FIRST-LINK: of
body 1, 0 where it is none of the LINKS."
  (destructuring-bind (nu distance direction) (cdr centre)
    (linmodel-compute
     form
     (lambda (a)
       (let ((places (linmodel-carried-places a (cdr links) (nth first-link links)
                                              distance direction))
             (factors (linmodel-attraction-factors a nu distance))
             (sum 0))
         (dolist (entries (cdr bodies) (funcall (linmodel-arithmetic-lower a) sum))
           (let ((body (linmodel-read-body a entries)))
             (destructuring-bind (beta . place) (nth (1- (linmodel-body-link body)) places)
               (setq sum (linmodel-plus a sum
                                        (linmodel-attraction a body beta place factors)))))))))))

(defun linmodel-attraction-factors (a nu distance)
  (mapcar (lambda (factor) (linmodel-lift a factor))
          (list (div nu distance)
                (neg (div nu (power distance 2)))
                (div nu (mul 2 (power distance 3))))))
