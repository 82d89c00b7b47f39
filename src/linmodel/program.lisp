;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The recursion over bodies on programs. Outwards each link has its angular velocity w and its
;;; accelerations e and a (of O_k; -g at rest stands for the field), all in its own axes, inwards
;;; the loads (N . F) that give them, N about O_k:
;;;     F = m (a + e x c + w x (w x c)),   N = Theta e + w x (Theta w + h) + m c x a.
;;; Their products with the link's own twists s_i, what q_i' adds to it beside its parent's motion,
;;; are the forces: Newton and Euler's equations, a constant number of operations for each body.
;;; See linmodel-bias-forces first; M and the accelerations are in program_inertia.lisp.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/inertia" "algebra/program_derivative"))

(defun linmodel-program-arithmetic ()
  (make-linmodel-arithmetic
   :lift #'algebra-program-element
   :lower #'identity
   :add #'algebra-program-add
   :multiply #'algebra-program-multiply
   :sine (lambda (angle) (algebra-program-sine (algebra-program-element angle)))
   :cosine (lambda (angle) (algebra-program-cosine (algebra-program-element angle)))))

;;; A link with all that the recursion asks of it, read once.

(defstruct linmodel-joint parent turns back place rows twists bodies)

(defun linmodel-read-joint (a link k bodies n)
  (let ((turns (linmodel-link-turns a link)))
    (make-linmodel-joint
     :parent (linmodel-link-parent link)
     :turns turns
     :back (mapcar (lambda (turn) (linmodel-back-turn a turn)) (reverse turns))
     :place (linmodel-link-joint a link)
     :rows (linmodel-link-rows a link)
     :twists (linmodel-own-twists a link turns n)
     :bodies (remove k bodies :key #'linmodel-body-link :test-not #'eql))))

(defun linmodel-back-turn (a turn)
  (make-linmodel-turn :axis (linmodel-turn-axis turn)
                      :sine (linmodel-minus a (linmodel-turn-sine turn))
                      :cosine (linmodel-turn-cosine turn)))

(defun linmodel-own-twists (a link turns n)
  "The list of (i w . v), i from 1 to N, of LINK on a parent at rest."
  (let ((place (linmodel-link-joint a link)) (rows (linmodel-link-rows a link)))
    (loop for i from 1 to n
          when (some (lambda (row) (not (eql 0 (nth i row))))
                     (append rows (mapcar #'linmodel-turn-row turns)))
            collect (cons i (linmodel-carried-twist a i (linmodel-twist-of i '()) turns place rows)))))

(defun linmodel-read-joints (a links bodies n)
  "The vector of the joints, the first place left empty."
  (let ((bodies (mapcar (lambda (body) (linmodel-read-body a body)) (cdr bodies))))
    (coerce (cons nil (loop for link in (cdr links)
                            for k from 1
                            collect (linmodel-read-joint a link k bodies n)))
            'vector)))

;;; Outwards.

(defstruct linmodel-state velocities accelerations rates) ; rates of q and t, as of program rates

(defun linmodel-row-velocity (a row state)
  (linmodel-plus a (first row) (linmodel-row-sum a (rest row) (linmodel-state-velocities state))))

(defun linmodel-row-sum (a row factors)
  (let ((sum 0))
    (mapc (lambda (x y) (setq sum (linmodel-plus a sum (linmodel-times a x y)))) row factors)
    sum))

(defun linmodel-row-acceleration (a row state)
  (linmodel-plus a
                 (linmodel-row-sum a (rest row) (linmodel-state-accelerations state))
                 (linmodel-row-velocity
                  a (if (some #'algebra-node-p row)
                        (algebra-program-rates row (linmodel-state-rates state))
                        (mapcar (constantly 0) row))
                  state)))

(defun linmodel-joint-motion (a joint motion state)
  "From the parent's (w e a) that of JOINT's link."
  (destructuring-bind (w e acceleration) motion
    (flet ((plus (u v) (linmodel-vector-plus a u v)) (cross (u v) (linmodel-cross a u v)))
      (let* ((place (linmodel-joint-place joint))
             (rows (linmodel-joint-rows joint))
             (u (mapcar (lambda (row) (linmodel-row-velocity a row state)) rows))
             (du (mapcar (lambda (row) (linmodel-row-acceleration a row state)) rows))
             (inner (plus (cross w place) (plus u u))))
        (setq acceleration (plus (plus acceleration du) (plus (cross e place) (cross w inner))))
        (dolist (turn (linmodel-joint-turns joint) (list w e acceleration))
          (setq acceleration (linmodel-turned a turn acceleration)
                e (linmodel-turned a turn e)
                w (linmodel-turned a turn w))
          (let ((rate (linmodel-along turn (linmodel-row-velocity a (linmodel-turn-row turn) state)))
                (change (linmodel-along turn (linmodel-row-acceleration
                                              a (linmodel-turn-row turn) state))))
            (setq e (plus (plus e (cross w rate)) change)
                  w (plus w rate))))))))

(defun linmodel-along (turn x)
  "The vector X along the axis of TURN."
  (loop for axis from 1 to 3 collect (if (= axis (linmodel-turn-axis turn)) x 0)))

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

;;; Inwards. A load is (N . F).

(defun linmodel-body-load (a body motion)
  (destructuring-bind (w e acceleration) motion
    (flet ((plus (u v) (linmodel-vector-plus a u v)) (cross (u v) (linmodel-cross a u v))
           (tensor-times (tensor v) (if tensor (linmodel-matrix-times a tensor v) (list 0 0 0))))
      (let* ((m (linmodel-body-mass body)) (c (linmodel-body-centre body))
             (about-joint (linmodel-body-joint-inertia body))
             (tensor (or about-joint (linmodel-body-centre-inertia body)))
             (force (linmodel-vector-times
                     a m (plus acceleration (plus (cross e c) (cross w (cross w c))))))
             (spin (plus (tensor-times tensor w) (or (linmodel-body-momentum body) (list 0 0 0))))
             (arm (if about-joint
                      (linmodel-vector-times a m (cross c acceleration))
                      (cross c force))))
        (cons (plus (plus (tensor-times tensor e) (cross w spin)) arm) force)))))

(defun linmodel-vector-times (a x vector)
  (mapcar (lambda (component) (linmodel-times a x component)) vector))

(defun linmodel-load-plus (a x y)
  (cons (linmodel-vector-plus a (car x) (car y)) (linmodel-vector-plus a (cdr x) (cdr y))))

(defun linmodel-carried-load (a joint load)
  "LOAD on the link of JOINT in axes of its parent, about the parent's O."
  (let ((moment (linmodel-turned-by-all a (linmodel-joint-back joint) (car load)))
        (force (linmodel-turned-by-all a (linmodel-joint-back joint) (cdr load))))
    (cons (linmodel-vector-plus a moment (linmodel-cross a (linmodel-joint-place joint) force))
          force)))

(defun linmodel-load-along (a twist load)
  (linmodel-plus a (linmodel-dot a (car twist) (car load)) (linmodel-dot a (cdr twist) (cdr load))))

(defun linmodel-no-load () (cons (list 0 0 0) (list 0 0 0)))

(defun linmodel-own-load (a joint motion)
  (let ((load (linmodel-no-load)))
    (dolist (body (linmodel-joint-bodies joint) load)
      (setq load (linmodel-load-plus a load (linmodel-body-load a body motion))))))

(defun linmodel-bias-loads (a joints motions)
  (coerce (loop for joint across joints
                for motion across motions
                collect (and joint (linmodel-own-load a joint motion)))
          'vector))

(defun linmodel-forces-of-loads (a joints loads n)
  "The generalized forces that give the LOADS, which are spent."
  (let ((forces (make-array (1+ n) :initial-element 0)))
    (loop for k from (1- (length joints)) downto 1
          for joint = (aref joints k)
          for parent = (linmodel-joint-parent joint)
          do (loop for (i . twist) in (linmodel-joint-twists joint)
                   do (setf (aref forces i)
                            (linmodel-plus a (aref forces i)
                                           (linmodel-load-along a twist (aref loads k)))))
             (when (> parent 0)
               (setf (aref loads parent)
                     (linmodel-load-plus a (aref loads parent)
                                         (linmodel-carried-load a joint (aref loads k))))))
    (cdr (coerce forces 'list))))

(defun linmodel-bias-forces (a joints state gravity n)
  "The forces for the accelerations of STATE: M q'' minus those of the field and of inertia."
  (linmodel-forces-of-loads
   a joints (linmodel-bias-loads a joints (linmodel-motions a joints state gravity)) n))
