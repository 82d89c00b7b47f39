;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Kinematics in body axes. The velocity of a link is a sum over the generalized velocities,
;;; sum x_i q_i' + x_0, of twists x = (w . v): w of the angular velocity, v of the velocity of O_k,
;;; both in the link's own axes (v_i, w_i are the partial velocities). From parent j to link k, r
;;; the joint and u its relative velocity, in axes j:
;;;     v := v + w x r + u,   then for each simple rotation about axis s by psi:
;;;     w, v := turned,   w_s := w_s + psi'.
;;; Links, turns and bodies are those of scene_records.lisp, lifted into an arithmetic where they
;;; are used. See linmodel-link-twists first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/arithmetic" "linmodel/scene_records" "algebra/size"))

;;; Turns, joints and bodies in elements of an arithmetic.

(defstruct linmodel-rotation axis angle sine cosine row) ; the angle as it stands

(defun linmodel-lift-turn (a turn)
  (let ((angle (linmodel-turn-angle turn)))
    (make-linmodel-rotation :axis (linmodel-turn-axis turn)
                            :angle angle
                            :sine (funcall (linmodel-arithmetic-sine a) angle)
                            :cosine (funcall (linmodel-arithmetic-cosine a) angle)
                            :row (linmodel-lift-vector a (linmodel-turn-row turn)))))

(defun linmodel-lift-turns (a link)
  (mapcar (lambda (turn) (linmodel-lift-turn a turn)) (cdr (linmodel-link-turns link))))

(defun linmodel-lift-place (a link) (linmodel-lift-vector a (linmodel-link-joint link)))

(defun linmodel-lift-rows (a link)
  (mapcar (lambda (row) (linmodel-lift-vector a row)) (cdr (linmodel-link-rows link))))

(defstruct (linmodel-lifted-body (:conc-name linmodel-lifted-))
  link mass centre joint-inertia centre-inertia momentum) ; vectors and rows of tensors as lists

(defun linmodel-lift-body (a body)
  (flet ((tensor (tensor)
           (and tensor (mapcar (lambda (row) (linmodel-lift-vector a row)) (cdr tensor)))))
    (let ((momentum (linmodel-body-momentum body)))
      (make-linmodel-lifted-body
       :link (linmodel-body-link body)
       :mass (linmodel-lift a (linmodel-body-mass body))
       :centre (linmodel-lift-vector a (linmodel-body-centre body))
       :joint-inertia (tensor (linmodel-body-joint-inertia body))
       :centre-inertia (tensor (linmodel-body-centre-inertia body))
       :momentum (and momentum (linmodel-lift-vector a momentum))))))

(defun linmodel-lift-bodies (a bodies)
  (mapcar (lambda (body) (linmodel-lift-body a body)) (cdr bodies)))

;;; Turned vectors.

(defun linmodel-plane-p (links)
  "Whether all LINKS turn about one axis."
  (let ((axes (loop for link in (cdr links)
                    append (mapcar #'linmodel-turn-axis (cdr (linmodel-link-turns link))))))
    (every (lambda (axis) (eql axis (first axes))) axes)))

(defun linmodel-turned (a turn vector)
  "The components of VECTOR in axes turned about one of them."
  (let* ((axis (linmodel-rotation-axis turn)) (i (mod axis 3)) (j (mod (1+ axis) 3))
         (x (nth i vector)) (y (nth j vector)) (components (copy-list vector)))
    (destructuring-bind (x y) (if (linmodel-arithmetic-turn a)
                                  (funcall (linmodel-arithmetic-turn a) x y
                                           (linmodel-rotation-angle turn))
                                  (linmodel-turned-pair a turn x y))
      (setf (nth i components) x (nth j components) y)
      components)))

(defun linmodel-turned-pair (a turn x y)
  "x := c*x + s*y, y := c*y - s*x."
  (flet ((times (u v) (linmodel-times a u v)))
    (let ((sine (linmodel-rotation-sine turn)) (cosine (linmodel-rotation-cosine turn)))
      (list (linmodel-plus a (times cosine x) (times sine y))
            (linmodel-plus a (times cosine y) (linmodel-minus a (times sine x)))))))

(defun linmodel-turned-by-all (a turns vector)
  (dolist (turn turns vector)
    (setq vector (linmodel-turned a turn vector))))

(defun linmodel-back-turns (a turns)
  "The TURNS that lead back."
  (mapcar (lambda (turn)
            (let ((back (copy-linmodel-rotation turn)))
              (setf (linmodel-rotation-sine back) (linmodel-minus a (linmodel-rotation-sine turn))
                    (linmodel-rotation-angle back) (neg (linmodel-rotation-angle turn)))
              back))
          (reverse turns)))

(defun linmodel-spinning (a turn i w)
  "W with the rate of TURN that belongs to the velocity I added about the axis of the turn."
  (let ((k (1- (linmodel-rotation-axis turn))) (sum (copy-list w)))
    (setf (nth k sum) (linmodel-plus a (nth k sum) (nth i (linmodel-rotation-row turn))))
    sum))

(defun linmodel-twist-of (i twists)
  (or (cdr (assoc i twists)) (cons (list 0 0 0) (list 0 0 0))))

(defun linmodel-twist-zero-p (twist)
  (and (every (lambda (x) (eql x 0)) (car twist)) (every (lambda (x) (eql x 0)) (cdr twist))))

(defun linmodel-link-twists (a link parent-twists n)
  "The twists of LINK that are not zero: a list of (i w . v), i from 0 to N."
  (let ((turns (linmodel-lift-turns a link))
        (joint (linmodel-lift-place a link))
        (rows (linmodel-lift-rows a link)))
    (linmodel-guarded-twists
     a
     (loop for i from 0 to n
           for carried = (linmodel-twist-of i parent-twists)
           for twist = (linmodel-carried-twist a i carried turns joint rows)
           unless (linmodel-twist-zero-p twist)
             collect (cons i twist)))))

(defun linmodel-guarded-twists (a twists)
  "TWISTS, unless their products would be too many: about a quarter of the products is left."
  (let ((terms 0))
    (loop for (nil w . v) in twists
          do (dolist (x (append w v)) (incf terms (funcall (linmodel-arithmetic-size a) x))))
    (algebra-guard (floor (* terms terms) 4) "the canonical form of the kinetic energy")
    twists))

(defun linmodel-carried-twist (a i twist turns joint rows)
  (destructuring-bind (w . v) twist
    (setq v (linmodel-vector-plus a v (linmodel-cross a w joint))
          v (linmodel-vector-plus a v (mapcar (lambda (row) (nth i row)) rows)))
    (dolist (turn turns (cons w v))
      (setq w (linmodel-spinning a turn i (linmodel-turned a turn w))
            v (linmodel-turned a turn v)))))

(defun linmodel-over-links (links function)
  "For each link the value of FUNCTION of the link and of its parent's value (nil: fixed axes)."
  (let ((found (make-array (1+ (length links)) :initial-element nil)))
    (loop for link in links
          for k from 1
          for parent = (aref found (linmodel-link-parent link))
          do (setf (aref found k) (funcall function link parent)))
    (cdr (coerce found 'list))))

(defun linmodel-all-twists (a links n)
  (linmodel-over-links links
                       (lambda (link parent) (linmodel-link-twists a link parent n))))

;;; For Maxima.

(defun $linmodel_twists (links n form)
  "For each link the list of its linmodel-twist."
  (linmodel-compute
   form
   (lambda (a)
     (flet ((lower (twist) (linmodel-lower-twist a twist)))
       (cons '(mlist simp)
             (mapcar (lambda (twists) (cons '(mlist simp) (mapcar #'lower twists)))
                     (linmodel-all-twists a (cdr links) n)))))
   (linmodel-plane-p links)))

(defun linmodel-lower-twist (a twist)
  (destructuring-bind (i w . v) twist
    (make-linmodel-twist :index i :turning (linmodel-lower-vector a w)
                         :moving (linmodel-lower-vector a v))))

(defun $linmodel_direction_cosines (link form)
  "alpha with x_parent = alpha*x_link: its rows are the parent's axes in axes of the link."
  (linmodel-compute
   form
   (lambda (a)
     (let ((turns (linmodel-lift-turns a link)))
       (cons '($matrix simp)
             (loop for axis in '((1 0 0) (0 1 0) (0 0 1))
                   for lifted = (mapcar (linmodel-arithmetic-lift a) axis)
                   collect (linmodel-lower-vector a (linmodel-turned-by-all a turns lifted))))))))

(defun $linmodel_weights (links bodies vector form)
  "The sum over the bodies of mass times VECTOR.r_C, VECTOR being given in fixed axes."
  (linmodel-compute
   form
   (lambda (a)
     (let ((carried (linmodel-carried-vectors a links vector)) (sum 0))
       (dolist (body (cdr bodies) (funcall (linmodel-arithmetic-lower a) sum))
         (setq sum (linmodel-plus a sum (linmodel-weight a body carried))))))
   (linmodel-plane-p links)))

(defun $linmodel_place (links k point form)
  "The components in fixed axes of a POINT of the link K, given in its axes."
  (if (eql k 0)
      point
      (let ((bodies (list '(mlist simp)
                          (make-linmodel-body :link k :mass 1 :centre point))))
        (cons '(mlist simp)
              (loop for axis in '((1 0 0) (0 1 0) (0 0 1))
                    collect ($linmodel_weights links bodies (cons '(mlist simp) axis) form))))))

(defun linmodel-carried-vectors (a links vector)
  (let ((start (cons (linmodel-lift-vector a vector) 0)))
    (linmodel-over-links (cdr links)
                         (lambda (link pair) (linmodel-carried-vector a link (or pair start))))))

(defun linmodel-carried-vector (a link pair)
  "From (vector . vector.r_O) of the parent the same of LINK, the vector in its axes."
  (destructuring-bind (vector . product) pair
    (cons (linmodel-turned-by-all a (linmodel-lift-turns a link) vector)
          (linmodel-plus a product (linmodel-dot a (linmodel-lift-place a link) vector)))))

(defun linmodel-weight (a body carried)
  "The mass of BODY times vector.r_C, CARRIED being (vector . vector.r_O) for each link."
  (destructuring-bind (vector . product) (nth (1- (linmodel-body-link body)) carried)
    (let ((centre (linmodel-lift-vector a (linmodel-body-centre body))))
      (linmodel-times a (linmodel-lift a (linmodel-body-mass body))
                      (linmodel-plus a product (linmodel-dot a vector centre))))))
