;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; M q'' = f by projection on the partial velocities, without a derivative of L: for the twists
;;; x_j = (w_j . v_j) of a body, its bias accelerations e, a (of O_k), a_C and its mass m
;;;     M_ij = sum over bodies of (x_i, x_j),
;;;     f_j = given_j - sum over bodies of (m u_j.a_C + w_j.(Theta e + w x (Theta w + h))),
;;; (x, y) as in kinetic.lisp, u_j = v_j + w_j x c with Theta about the centre of mass; for Theta
;;; about O_k u_j.a_C is v_j.a_C + (w_j x c).a. given_j are the forces that no constant field gives,
;;; dU/dq - dR/dq' + Q; a constant field enters as an acceleration of the fixed axes.
;;; It begins with the displacements of bodies and the momenta that belong to them.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/shortest_forms" "linmodel/arithmetic" "linmodel/kinetic"
                "linmodel/motions" "linmodel/scene_records" "linmodel/twists"))

;;; The momentum of all bodies along a small displacement of the whole system as one rigid body: a
;;; turn w and a shift v. With X = (w . v) of O_k carried into the axes of each body it is
;;;     sum over bodies of (X, x_i) q_i' + (X, x_0) + h.w,
;;; x_i the twists and ( , ) the product of kinetic.lisp: for w = e, v = 0 the moment K.e of the
;;; momenta about an axis through O_0, for w = 0, v = e the momentum along e.

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

;;; ---- projection

(defun linmodel-projected-loads (a twists bodies motions n)
  "The list of what the bodies take of the forces, j from 1 to N."
  (let ((found (make-array (1+ n) :initial-element 0)))
    (dolist (body bodies (cdr (coerce found 'list)))
      (let* ((motion (aref motions (linmodel-lifted-link body)))
             (centre (linmodel-centre-acceleration a body motion))
             (moment (linmodel-turning-moment a body motion)))
        (loop for (j . twist) in (nth (1- (linmodel-lifted-link body)) twists)
              do (setf (aref found j)
                       (linmodel-sum a (aref found j)
                                     (linmodel-times a (linmodel-lifted-mass body)
                                                     (linmodel-along-centre a body twist centre
                                                                            motion))
                                     (linmodel-dot a (car twist) moment))))))))

(defun linmodel-along-centre (a body twist centre motion)
  "u_j.a_C, CENTRE being a_C"
  (if (linmodel-lifted-joint-inertia body)
      (linmodel-plus a (linmodel-dot a (cdr twist) centre)
                     (linmodel-dot a (linmodel-cross a (car twist) (linmodel-lifted-centre body))
                                   (linmodel-motion-acceleration motion)))
      (linmodel-dot a (linmodel-centre-velocity a body twist) centre)))

(defun linmodel-projection (a scene given velocities)
  "Rows of M and list of f as elements."
  (let* ((q (cdr (linmodel-scene-coordinates scene)))
         (n (length q))
         (links (linmodel-scene-links scene))
         (bodies (linmodel-scene-bodies scene))
         (state (make-linmodel-state :names q
                                     :velocities (linmodel-lift-vector a velocities)
                                     :accelerations (loop repeat n collect 0)))
         (joints (linmodel-joints a links bodies state))
         (twists (linmodel-all-twists a (cdr links) n))
         (bodies (linmodel-lift-bodies a bodies))
         (form (linmodel-form-of-twists a twists bodies n))
         (gravity (linmodel-lift-vector a (linmodel-gravity scene)))
         (motions (linmodel-motions a joints state gravity)))
    (values (loop for i from 1 to n
                  collect (loop for j from 1 to n collect (aref form (min i j) (max i j))))
            (mapcar (lambda (given load) (linmodel-plus a given (linmodel-minus a load)))
                    (linmodel-lift-vector a given)
                    (linmodel-projected-loads a twists bodies motions n)))))

(defun linmodel-residuals (a rows right accelerations)
  "M q'' - f"
  (loop for row in rows
        for f in right
        collect (linmodel-plus a (linmodel-row-sum a row accelerations) (linmodel-minus a f))))

;;; For Maxima.

(defun $linmodel_projected_mass_form (scene given velocities form)
  "[M, f] in the names of the VELOCITIES."
  (linmodel-compute
   form
   (lambda (a)
     (multiple-value-bind (rows right) (linmodel-projection a scene given velocities)
       (list '(mlist simp)
             (cons '($matrix simp) (mapcar (lambda (row) (linmodel-lower-vector a row)) rows))
             (linmodel-lower-vector a right))))
   (linmodel-plane-p (linmodel-scene-links scene))))

(defun $linmodel_projected_equations (scene given velocities accelerations form)
  "[e_1, ..] of M q'' - f in the names of the VELOCITIES and ACCELERATIONS."
  (let ((*algebra-velocities* (append (cdr velocities) (cdr accelerations))))
    (linmodel-compute
     form
     (lambda (a)
       (multiple-value-bind (rows right) (linmodel-projection a scene given velocities)
         (linmodel-lower-vector
          a (linmodel-residuals a rows right (linmodel-lift-vector a accelerations)))))
     (linmodel-plane-p (linmodel-scene-links scene)))))
