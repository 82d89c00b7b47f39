;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Accelerations and loads in any arithmetic. Outwards each link has its angular velocity w and its
;;; accelerations e and a (of O_k; -g at rest stands for a constant field), all in its own axes; the
;;; load (N . F) that gives a body these, N about O_k, is
;;;     F = m (a + e x c + w x (w x c)),   N = Theta e + w x (Theta w + h) + m c x a.
;;; With the accelerations q_i'' put to 0 these are the bias accelerations. See linmodel-motions
;;; first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/twists" "linmodel/rate_rows" "linmodel/arithmetic"
                "linmodel/scene_records"))

;;; The state of motion: the names of the coordinates, their velocities and accelerations as
;;; elements.

(defstruct linmodel-state names velocities accelerations)

(defun linmodel-row-sum (a row factors)
  (let ((sum 0))
    (mapc (lambda (x y) (setq sum (linmodel-plus a sum (linmodel-times a x y)))) row factors)
    sum))

(defun linmodel-row-velocity (a row state)
  (linmodel-plus a (first row) (linmodel-row-sum a (rest row) (linmodel-state-velocities state))))

(defun linmodel-drift (a e state)
  "The rate of the expression E in coordinates and time."
  (linmodel-row-velocity
   a
   (linmodel-lift-vector a ($linmodel_rate_row e (cons '(mlist) (linmodel-state-names state))))
   state))

(defun linmodel-row-drift (a row state)
  "The rate of c_0 + sum c_i q_i', ROWs being of expressions, without the accelerations."
  (let ((sum 0))
    (loop for c in (cdr row)
          for v in (cons (linmodel-lift a 1) (linmodel-state-velocities state))
          unless (mnump c)
            do (setq sum (linmodel-plus a sum (linmodel-times a (linmodel-drift a c state) v))))
    sum))

;;; A link with all that the recursion asks of it, read once.

(defstruct linmodel-joint parent turns drifts back place rows row-drifts twists bodies)

(defun linmodel-joint-of (a link k bodies state)
  (flet ((drifts (rows) (mapcar (lambda (row) (linmodel-row-drift a row state)) rows)))
    (let ((turns (linmodel-lift-turns a link)))
      (make-linmodel-joint
       :parent (linmodel-link-parent link)
       :turns turns
       :drifts (drifts (mapcar #'linmodel-turn-row (cdr (linmodel-link-turns link))))
       :back (linmodel-back-turns a turns)
       :place (linmodel-lift-place a link)
       :rows (linmodel-lift-rows a link)
       :row-drifts (drifts (cdr (linmodel-link-rows link)))
       :twists (linmodel-own-twists a link turns (length (linmodel-state-names state)))
       :bodies (remove k bodies :key #'linmodel-lifted-link :test-not #'eql)))))

(defun linmodel-own-twists (a link turns n)
  "The list of (i w . v), i from 1 to N, of LINK on a parent at rest."
  (let ((place (linmodel-lift-place a link)) (rows (linmodel-lift-rows a link)))
    (loop for i in (linmodel-moving-indices (append rows (mapcar #'linmodel-rotation-row turns)) n)
          collect (cons i (linmodel-carried-twist a i (linmodel-twist-of i '())
                                                  turns place rows)))))

(defun linmodel-moving-indices (rows n)
  "The indices, from 1 to N, at which one of ROWS is not 0."
  (let ((moving (make-array (1+ n) :initial-element nil)))
    (dolist (row rows)
      (loop for x in row
            for i from 0
            unless (eql x 0) do (setf (aref moving i) t)))
    (loop for i from 1 to n when (aref moving i) collect i)))

(defun linmodel-joints (a links bodies state)
  "The vector of the joints, the first place left empty."
  (let ((bodies (linmodel-lift-bodies a bodies)))
    (coerce (cons nil (loop for link in (cdr links)
                            for k from 1
                            collect (linmodel-joint-of a link k bodies state)))
            'vector)))

;;; Outwards.

(defun linmodel-motion-acceleration (motion)
  "That of O_k; a motion is (w e a)."
  (third motion))

(defun linmodel-row-acceleration (a row drift state)
  (linmodel-plus a (linmodel-row-sum a (rest row) (linmodel-state-accelerations state)) drift))

(defun linmodel-joint-motion (a joint motion state)
  "From the parent's (w e a) that of JOINT's link."
  (destructuring-bind (w e acceleration) motion
    (flet ((plus (u v) (linmodel-vector-plus a u v)) (cross (u v) (linmodel-cross a u v)))
      (let* ((place (linmodel-joint-place joint))
             (rows (linmodel-joint-rows joint))
             (u (mapcar (lambda (row) (linmodel-row-velocity a row state)) rows))
             (du (mapcar (lambda (row drift) (linmodel-row-acceleration a row drift state))
                         rows (linmodel-joint-row-drifts joint)))
             (inner (plus (cross w place) (plus u u))))
        (setq acceleration (plus (plus acceleration du) (plus (cross e place) (cross w inner))))
        (loop for turn in (linmodel-joint-turns joint)
              for drift in (linmodel-joint-drifts joint)
              do (setq acceleration (linmodel-turned a turn acceleration))
                 (multiple-value-setq (w e) (linmodel-turned-motion a turn drift w e state)))
        (list w e acceleration)))))

(defun linmodel-turned-motion (a turn drift w e state)
  "W and E in the axes of TURN, its own rate and acceleration added."
  (let* ((row (linmodel-rotation-row turn))
         (w (linmodel-turned a turn w))
         (rate (linmodel-along turn (linmodel-row-velocity a row state)))
         (change (linmodel-along turn (linmodel-row-acceleration a row drift state))))
    (values (linmodel-vector-plus a w rate)
            (linmodel-vector-plus
             a (linmodel-vector-plus a (linmodel-turned a turn e) (linmodel-cross a w rate))
             change))))

(defun linmodel-along (turn x)
  "The vector X along the axis of TURN."
  (loop for axis from 1 to 3 collect (if (= axis (linmodel-rotation-axis turn)) x 0)))

(defun linmodel-motions (a joints state gravity)
  (let ((motions (make-array (length joints))))
    (setf (aref motions 0)
          (list (list 0 0 0) (list 0 0 0) (mapcar (lambda (x) (linmodel-minus a x)) gravity)))
    (loop for k from 1 below (length joints)
          for joint = (aref joints k)
          do (setf (aref motions k)
                   (linmodel-joint-motion
                    a joint (aref motions (linmodel-joint-parent joint)) state)))
    motions))

;;; Loads.

(defun linmodel-centre-acceleration (a body motion)
  "a + e x c + w x (w x c)"
  (destructuring-bind (w e acceleration) motion
    (flet ((plus (u v) (linmodel-vector-plus a u v)) (cross (u v) (linmodel-cross a u v)))
      (let ((c (linmodel-lifted-centre body)))
        (plus acceleration (plus (cross e c) (cross w (cross w c))))))))

(defun linmodel-turning-moment (a body motion)
  "Theta e + w x (Theta w + h)"
  (destructuring-bind (w e acceleration) motion
    (declare (ignore acceleration))
    (let ((tensor (or (linmodel-lifted-joint-inertia body) (linmodel-lifted-centre-inertia body)))
          (momentum (linmodel-lifted-momentum body)))
      (flet ((tensor-times (v) (if tensor (linmodel-matrix-times a tensor v) (list 0 0 0))))
        (linmodel-vector-plus
         a (tensor-times e)
         (linmodel-cross a w
                         (linmodel-vector-plus a (tensor-times w) (or momentum (list 0 0 0)))))))))

(defun linmodel-body-load (a body motion)
  (let* ((m (linmodel-lifted-mass body)) (c (linmodel-lifted-centre body))
         (force (linmodel-vector-times a m (linmodel-centre-acceleration a body motion)))
         (arm (if (linmodel-lifted-joint-inertia body)
                  (linmodel-vector-times
                   a m (linmodel-cross a c (linmodel-motion-acceleration motion)))
                  (linmodel-cross a c force))))
    (cons (linmodel-vector-plus a (linmodel-turning-moment a body motion) arm) force)))
