;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The recursion over bodies on programs: the loads (N . F) of motions.lisp are carried inwards.
;;; Their products with the link's own twists s_i, what q_i' adds to it beside its parent's motion,
;;; are the forces: Newton and Euler's equations, a constant number of operations for each body.
;;; All bodies beyond a joint taken as one have a symmetric inertia I of six rows,
;;; (N, F) = I (w, v), and by projection the mass matrix is
;;;     M_ij = s_i . (I_k s_j),   k the outer one of the two links, the load carried inwards.
;;; See linmodel-bias-forces and linmodel-mass-rows first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/motions" "linmodel/arithmetic" "linmodel/twists" "algebra/program_nodes"
                "algebra/program_from_expressions"))

(defun linmodel-program-arithmetic ()
  (make-linmodel-arithmetic
   :lift #'algebra-program-element
   :lower #'identity
   :add #'algebra-program-add
   :multiply #'algebra-program-multiply
   :sine (lambda (angle) (algebra-program-sine (algebra-program-element angle)))
   :cosine (lambda (angle) (algebra-program-cosine (algebra-program-element angle)))))

;;; Inwards. A load is (N . F).

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

(defun linmodel-bias-forces (a joints state gravity)
  "The forces for the accelerations of STATE: M q'' minus those of the field and of inertia."
  (linmodel-forces-of-loads
   a joints (linmodel-bias-loads a joints (linmodel-motions a joints state gravity))
   (length (linmodel-state-names state))))

;;; Inertias of six rows.

(defun linmodel-inertia-about-joint (a body)
  (let ((m (linmodel-lifted-mass body)) (c (linmodel-lifted-centre body))
        (tensor (linmodel-lifted-centre-inertia body)))
    (or (linmodel-lifted-joint-inertia body)
        (loop for i below 3
              collect (loop for j below 3
                            for arm = (linmodel-minus a (linmodel-times a (nth i c) (nth j c)))
                            for around = (if (= i j) (linmodel-plus a (linmodel-dot a c c) arm) arm)
                            collect (linmodel-plus a (if tensor (nth j (nth i tensor)) 0)
                                                   (linmodel-times a m around)))))))

(defun linmodel-six-rows (a body)
  "The inertia of BODY: N = Theta w + m c x v, F = m v - m c x w."
  (let* ((m (linmodel-lifted-mass body)) (zero (list 0 0 0))
         (moment (linmodel-vector-times a m (linmodel-lifted-centre body)))
         (tensor (linmodel-inertia-about-joint a body)))
    (flet ((unit (i x) (loop for j below 3 collect (if (= i j) x 0))))
      (append
       (loop for i below 3
             collect (append (nth i tensor) (linmodel-cross a (unit i 1) moment)))
       (loop for i below 3
             collect (append (linmodel-cross a moment (unit i 1)) (unit i m)))))))

(defun linmodel-six (pair) (append (car pair) (cdr pair)))
(defun linmodel-pair (six) (cons (subseq six 0 3) (subseq six 3)))

(defun linmodel-rows-plus (a x y)
  (mapcar (lambda (u v) (linmodel-vector-plus a u v)) x y))

(defun linmodel-no-inertia () (loop repeat 6 collect (list 0 0 0 0 0 0)))

(defun linmodel-own-inertia (a joint)
  (let ((rows (linmodel-no-inertia)))
    (dolist (body (linmodel-joint-bodies joint) rows)
      (setq rows (linmodel-rows-plus a rows (linmodel-six-rows a body))))))

(defun linmodel-own-inertias (a joints)
  (coerce (loop for joint across joints collect (and joint (linmodel-own-inertia a joint)))
          'vector))

(defun linmodel-transposed (rows) (apply #'mapcar #'list rows))

(defun linmodel-mirrored (rows)
  "ROWS with the upper half mirrored: the lower one is then never computed."
  (loop for i below 6
        collect (loop for j below 6 collect (nth (max i j) (nth (min i j) rows)))))

(defun linmodel-carried-inertia (a joint rows)
  (flet ((carried (rows)
           (mapcar (lambda (row) (linmodel-six (linmodel-carried-load a joint (linmodel-pair row))))
                   rows)))
    (linmodel-mirrored (carried (linmodel-transposed (carried rows))))))

(defun linmodel-inwards (joints function)
  "FUNCTION of k, the joint k and its parent's index, from the outermost on."
  (loop for k from (1- (length joints)) downto 1
        for joint = (aref joints k)
        do (funcall function k joint (linmodel-joint-parent joint))))

;;; The mass matrix.

(defun linmodel-mass-rows (a joints n)
  (let ((rows (make-array (list (1+ n) (1+ n)) :initial-element 0))
        (inertias (linmodel-own-inertias a joints))
        (beyond (make-array (length joints) :initial-element '())))
    (linmodel-inwards
     joints
     (lambda (k joint parent)
       (let ((own (linmodel-loads-of-twists a (aref inertias k) (linmodel-joint-twists joint))))
         (linmodel-add-products a rows joint own (aref beyond k))
         (when (> parent 0)
           (setf (aref inertias parent)
                 (linmodel-rows-plus a (aref inertias parent)
                                     (linmodel-carried-inertia a joint (aref inertias k)))
                 (aref beyond parent)
                 (linmodel-merged-loads
                  a (aref beyond parent)
                  (linmodel-carried-loads a joint
                                          (linmodel-merged-loads a (aref beyond k) own))))))))
    (loop for i from 1 to n
          collect (loop for j from 1 to n collect (aref rows (min i j) (max i j))))))

(defun linmodel-loads-of-twists (a inertia twists)
  (loop for (i . twist) in twists
        collect (cons i (linmodel-pair (linmodel-matrix-times a inertia (linmodel-six twist))))))

(defun linmodel-carried-loads (a joint loads)
  (loop for (i . load) in loads collect (cons i (linmodel-carried-load a joint load))))

(defun linmodel-merged-loads (a loads others)
  (let ((merged (copy-alist loads)))
    (loop for (i . load) in others
          for known = (assoc i merged)
          do (if known
                 (setf (cdr known) (linmodel-load-plus a (cdr known) load))
                 (push (cons i load) merged)))
    merged))

(defun linmodel-add-products (a rows joint own beyond)
  "Adds to the upper half of ROWS: a pair of one link once, of two links from both sides."
  (flet ((add-to (i j product)
           (setf (aref rows i j) (linmodel-plus a (aref rows i j) product))))
    (loop for (i . twist) in (linmodel-joint-twists joint)
          do (loop for (j . load) in own
                   when (<= i j) do (add-to i j (linmodel-load-along a twist load)))
             (loop for (j . load) in beyond
                   for product = (linmodel-load-along a twist load)
                   do (add-to (min i j) (max i j) product)
                      (when (= i j) (add-to i j product))))))
