;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Kinematics in body axes. The velocity of a link is a sum over the generalized velocities, sum x_i q_i' + x_0, of twists
;;; x = (w . v): w of the angular velocity, v of the velocity of O_k, both in the link's own axes (v_i, w_i are the partial
;;; velocities). From parent j to link k, r the joint and u its relative velocity, in axes j:
;;;     v := v + w x r + u,   then for each simple rotation about axis s by psi:  w, v := turned,  w_s := w_s + psi'.
;;; A link comes as the list [name, index of the parent, turns, joint, rows of u], a turn as [axis, angle, row of psi'];
;;; a row [c_0, c_1, .., c_n] means c_0 + sum c_i q_i'. See linmodel-link-twists first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/arithmetic"))

(defstruct linmodel-turn axis sine cosine row)

(defun linmodel-read-turn (a turn)
  (destructuring-bind (axis angle row) (cdr turn)
    (make-linmodel-turn :axis axis
                        :sine (funcall (linmodel-arithmetic-sine a) angle)
                        :cosine (funcall (linmodel-arithmetic-cosine a) angle)
                        :row (linmodel-lift-vector a row))))

(defun linmodel-link-parent (link) (third link))
(defun linmodel-link-turns (a link) (mapcar (lambda (turn) (linmodel-read-turn a turn)) (cdr (fourth link))))
(defun linmodel-link-joint (a link) (linmodel-lift-vector a (fifth link)))
(defun linmodel-link-rows (a link) (mapcar (lambda (row) (linmodel-lift-vector a row)) (cdr (sixth link))))

(defun linmodel-turned (a turn vector)
  "The components of VECTOR in axes turned right-handed about one of them: x := c*x + s*y, y := -s*x + c*y."
  (let* ((axis (linmodel-turn-axis turn)) (i (mod axis 3)) (j (mod (1+ axis) 3))
         (sine (linmodel-turn-sine turn)) (cosine (linmodel-turn-cosine turn))
         (x (nth i vector)) (y (nth j vector)) (components (copy-list vector)))
    (setf (nth i components) (linmodel-plus a (linmodel-times a cosine x) (linmodel-times a sine y))
          (nth j components) (linmodel-plus a (linmodel-minus a (linmodel-times a sine x)) (linmodel-times a cosine y)))
    components))

(defun linmodel-turned-by-all (a turns vector)
  (dolist (turn turns vector)
    (setq vector (linmodel-turned a turn vector))))

(defun linmodel-spinning (a turn i w)
  "W with the rate of TURN that belongs to the velocity I added about the axis of the turn."
  (let ((k (1- (linmodel-turn-axis turn))) (sum (copy-list w)))
    (setf (nth k sum) (linmodel-plus a (nth k sum) (nth i (linmodel-turn-row turn))))
    sum))

(defun linmodel-twist-of (i twists)
  (or (cdr (assoc i twists)) (cons (list 0 0 0) (list 0 0 0))))

(defun linmodel-twist-zero-p (twist)
  (and (every (lambda (x) (eql x 0)) (car twist)) (every (lambda (x) (eql x 0)) (cdr twist))))

(defun linmodel-link-twists (a link parent-twists n)
  "The twists of LINK that are not zero: a list of (i w . v), i from 0 to N."
  (let ((turns (linmodel-link-turns a link)) (joint (linmodel-link-joint a link)) (rows (linmodel-link-rows a link)))
    (loop for i from 0 to n
          for twist = (linmodel-carried-twist a i (linmodel-twist-of i parent-twists) turns joint rows)
          unless (linmodel-twist-zero-p twist)
            collect (cons i twist))))

(defun linmodel-carried-twist (a i twist turns joint rows)
  (destructuring-bind (w . v) twist
    (setq v (linmodel-vector-plus a v (linmodel-vector-plus a (linmodel-cross a w joint)
                                                            (mapcar (lambda (row) (nth i row)) rows))))
    (dolist (turn turns (cons w v))
      (setq w (linmodel-spinning a turn i (linmodel-turned a turn w))
            v (linmodel-turned a turn v)))))

(defun linmodel-over-links (links function)
  "A list, for each link the value of FUNCTION of the link and of its parent's value (nil for the fixed axes)."
  (let ((found (make-array (1+ (length links)) :initial-element nil)))
    (loop for link in links
          for k from 1
          do (setf (aref found k) (funcall function link (aref found (linmodel-link-parent link)))))
    (cdr (coerce found 'list))))

(defun linmodel-all-twists (a links n)
  (linmodel-over-links links (lambda (link parent-twists) (linmodel-link-twists a link parent-twists n))))

;;; For Maxima.

(defun $linmodel_twists (links n arithmetic)
  "For each link the list of its twists [i, w, v]."
  (let ((a (linmodel-arithmetic-named arithmetic)))
    (cons '(mlist simp)
          (mapcar (lambda (twists) (cons '(mlist simp) (mapcar (lambda (twist) (linmodel-lower-twist a twist)) twists)))
                  (linmodel-all-twists a (cdr links) n)))))

(defun linmodel-lower-twist (a twist)
  (destructuring-bind (i w . v) twist
    (list '(mlist simp) i (linmodel-lower-vector a w) (linmodel-lower-vector a v))))

(defun $linmodel_direction_cosines (link arithmetic)
  "alpha with x_parent = alpha*x_link: its rows are the parent's axes in axes of the link."
  (let* ((a (linmodel-arithmetic-named arithmetic)) (turns (linmodel-link-turns a link)))
    (cons '($matrix simp)
          (mapcar (lambda (axis) (linmodel-lower-vector a (linmodel-turned-by-all a turns axis)))
                  (mapcar (lambda (axis) (mapcar (linmodel-arithmetic-lift a) axis))
                          '((1 0 0) (0 1 0) (0 0 1)))))))

(defun $linmodel_carried (links vector arithmetic)
  "For each link the fixed VECTOR in its axes, and its product with the radius vector of O_k: [[..], product]."
  (let ((a (linmodel-arithmetic-named arithmetic)))
    (cons '(mlist simp)
          (mapcar (lambda (pair) (list '(mlist simp) (linmodel-lower-vector a (car pair))
                                       (funcall (linmodel-arithmetic-lower a) (cdr pair))))
                  (linmodel-over-links (cdr links)
                                       (lambda (link parent)
                                         (linmodel-carried-vector a link (or parent (cons (linmodel-lift-vector a vector) 0)))))))))

(defun linmodel-carried-vector (a link pair)
  (destructuring-bind (vector . product) pair
    (cons (linmodel-turned-by-all a (linmodel-link-turns a link) vector)
          (linmodel-plus a product (linmodel-dot a (linmodel-link-joint a link) vector)))))
