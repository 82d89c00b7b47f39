;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The force function of a Newtonian centre to the second order in size over distance, formula (2)
;;; of the source paper. O_1 is at r*chi from the centre; for a body with beta, the direction
;;; cosines of chi, p = O_1 O_k, c = O_k C and Theta about O_k, all in its axes,
;;;     U = nu*m/r - nu*m/r^2*beta.(p + c) + nu/(2*r^3)*(trace(Theta) - 3*beta.Theta.beta
;;;         + m*(3*(beta.p)^2 - p.p + 6*(beta.p)*(beta.c) - 2*p.c)).
;;; beta and p are turned along the tree. See linmodel-attraction first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/energy_value" "forms/fixed" "forms/agreement" "forms/value"
                "linmodel/arithmetic" "linmodel/twists" "linmodel/scene_records" "linmodel/frames"
                "algebra/size"))

(defun linmodel-attraction (a body beta place factors)
  "The force function of BODY, its tensor about O_k; FACTORS are nu/r, -nu/r^2 and nu/(2 r^3)."
  (destructuring-bind (zeroth first-order second-order) factors
    (let ((m (linmodel-lifted-mass body))
          (away (linmodel-vector-plus a place (linmodel-lifted-centre body))))
      (linmodel-sum a
                    (linmodel-times a zeroth m)
                    (linmodel-times a first-order (linmodel-times a m (linmodel-dot a beta away)))
                    (linmodel-times a second-order (linmodel-second-order a body beta place))))))

(defun linmodel-second-order (a body beta place)
  (flet ((times (n x y) (linmodel-times a (linmodel-lift a n) (linmodel-times a x y))))
    (let* ((tensor (linmodel-lifted-joint-inertia body))
           (c (linmodel-lifted-centre body))
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
                    (linmodel-times a (linmodel-lifted-mass body) of-mass)))))

(defun linmodel-trace (a tensor)
  (apply #'linmodel-sum a (loop for row in tensor for i from 0 collect (nth i row))))

(defun linmodel-carried-places (a links centre)
  "For each of the LINKS (beta . p), p being zero for that of body 1."
  (let* ((k (linmodel-centre-link centre))
         (first-link (and (plusp k) (nth (1- k) links)))
         (chi (linmodel-lift-vector a (linmodel-centre-direction centre)))
         (distance (linmodel-lift a (linmodel-centre-distance centre)))
         (start (cons chi (linmodel-vector-times a (linmodel-minus a distance) chi))))
    (linmodel-over-links
     links
     (lambda (link pair)
       (destructuring-bind (beta . place) (linmodel-carried-place a link (or pair start))
         (linmodel-guard-place a beta place)
         (cons beta (if (eq link first-link) (list 0 0 0) place)))))))

(defun linmodel-carried-place (a link pair)
  (destructuring-bind (beta . place) pair
    (let ((turns (linmodel-lift-turns a link)))
      (cons (linmodel-turned-by-all a turns beta)
            (linmodel-turned-by-all a turns
                                    (linmodel-vector-plus a place (linmodel-lift-place a link)))))))

(defun linmodel-guard-place (a beta place)
  (let ((terms 0))
    (dolist (x (append beta place))
      (incf terms (funcall (linmodel-arithmetic-size a) x)))
    (algebra-guard (* terms terms) "the canonical form of the force function")))

(defun linmodel-attraction-factors (a centre)
  (let ((nu (linmodel-centre-strength centre)) (distance (linmodel-centre-distance centre)))
    (mapcar (lambda (factor) (linmodel-lift a factor))
            (list (div nu distance)
                  (neg (div nu (power distance 2)))
                  (div nu (mul 2 (power distance 3)))))))

;;; The judge: formula (2) in fixed axes, in numbers.

(defun linmodel-attraction-value (body frame centre point)
  "CENTRE: nu, 1/r, chi and r chi in numbers."
  (destructuring-bind (nu over-r chi start) centre
    (flet ((times (&rest factors) (reduce #'forms-fixed-times factors))
           (fixed (e) (forms-fixed-value e point)))
      (let* ((a (linmodel-frame-cosines frame))
             (m (fixed (linmodel-body-mass body)))
             (c (linmodel-fixed-combination
                 a (linmodel-fixed-vector (linmodel-body-centre body) point)))
             (p (mapcar #'- (linmodel-frame-place frame) start))
             (tensor (linmodel-fixed-rows (linmodel-body-joint-inertia body) point))
             (beta (mapcar (lambda (column) (forms-fixed-dot column chi)) a))
             (turning (forms-fixed-dot beta (mapcar (lambda (row) (forms-fixed-dot row beta))
                                                    tensor)))
             (height (forms-fixed-dot chi p))
             (depth (forms-fixed-dot chi c)))
        (+ (times nu over-r m)
           (- (times nu over-r over-r m (+ height depth)))
           (ash (times nu over-r over-r over-r
                       (+ (loop for row in tensor for i from 0 sum (nth i row))
                          (* -3 turning)
                          (times m (+ (* 3 (times height height)) (- (forms-fixed-dot p p))
                                      (* 6 (times height depth))
                                      (* -2 (forms-fixed-dot p c))))))
                -1))))))

(defun linmodel-attraction-of-all (scene v point)
  (let* ((centre (linmodel-field-centre (linmodel-scene-field scene)))
         (r (forms-fixed-value (linmodel-centre-distance centre) point))
         (chi (linmodel-fixed-vector (linmodel-centre-direction centre) point))
         (numbers (list (forms-fixed-value (linmodel-centre-strength centre) point)
                        (forms-fixed-inverse r) chi (linmodel-fixed-scaled r chi)))
         (frames (linmodel-frames-at (cdr (linmodel-scene-links scene))
                                     (linmodel-rates-at v point) point)))
    (loop for body in (cdr (linmodel-scene-bodies scene))
          sum (linmodel-attraction-value body (aref frames (linmodel-body-link body)) numbers
                                         point))))

;;; For Maxima; the bodies of the SCENE have their tensors about O_k.

(defun $linmodel_newtonian (scene form)
  "U in the field of the scene's centre."
  (let ((links (cdr (linmodel-scene-links scene)))
        (centre (linmodel-field-centre (linmodel-scene-field scene))))
    (linmodel-compute
     form
     (lambda (a)
       (let ((places (linmodel-carried-places a links centre))
             (factors (linmodel-attraction-factors a centre))
             (sum 0))
         (dolist (body (linmodel-lift-bodies a (linmodel-scene-bodies scene))
                       (funcall (linmodel-arithmetic-lower a) sum))
           (destructuring-bind (beta . place) (nth (1- (linmodel-lifted-link body)) places)
             (setq sum (linmodel-plus a sum
                                      (linmodel-attraction a body beta place factors))))))))))

(defun $linmodel_check_attraction (found scene v)
  "FOUND against U in fixed axes; V are the plain symbols of the velocities."
  (let ((point (forms-new-point t)))
    (forms-verdict "U against the field in fixed axes"
                   (catch 'forms-no-value (forms-fixed-value found point))
                   (catch 'forms-no-value (linmodel-attraction-of-all scene (cdr v) point))
                   point)))
