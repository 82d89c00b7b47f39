;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Mass matrix and accelerations on programs. All bodies beyond a joint taken as one have a
;;; symmetric inertia I of six rows, (N, F) = I (w, v). The mass matrix by projection:
;;;     M_ij = s_i . (I_k s_j),   k the outer one of the two links, the load carried inwards.
;;; The accelerations of a tree in which every velocity belongs to one link, by articulated bodies:
;;; with U = I s, D = s.U, u = Q - s.p, where p is the load without q'',
;;;     I := I - U D^-1 U^T,   p := p + U D^-1 u   go inwards,   q'' = D^-1 (u - U.x)  outwards,
;;; x the parent's acceleration beyond that without q''. See linmodel-accelerations first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/program" "forms/equations_as_program"))

(defun linmodel-inertia-about-joint (a body)
  (let ((m (linmodel-body-mass body)) (c (linmodel-body-centre body))
        (tensor (linmodel-body-centre-inertia body)))
    (or (linmodel-body-joint-inertia body)
        (loop for i below 3
              collect (loop for j below 3
                            for arm = (linmodel-minus a (linmodel-times a (nth i c) (nth j c)))
                            for around = (if (= i j) (linmodel-plus a (linmodel-dot a c c) arm) arm)
                            collect (linmodel-plus a (if tensor (nth j (nth i tensor)) 0)
                                                   (linmodel-times a m around)))))))

(defun linmodel-six-rows (a body)
  "The inertia of BODY: N = Theta w + m c x v, F = m v - m c x w."
  (let* ((m (linmodel-body-mass body)) (zero (list 0 0 0))
         (moment (linmodel-vector-times a m (linmodel-body-centre body)))
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

;;; Articulated bodies.

(defun linmodel-articulated-p (joints)
  "Whether every velocity belongs to one link."
  (let ((indices (loop for joint across joints
                       when joint append (mapcar #'car (linmodel-joint-twists joint)))))
    (= (length indices) (length (remove-duplicates indices)))))

(defstruct linmodel-articulation twists columns inverse drive) ; s, U, D^-1, u

(defun linmodel-accelerations (a joints loads forces n)
  "q'' under FORCES; LOADS are those of the motion without q''."
  (let ((inertias (linmodel-own-inertias a joints))
        (articulations (make-array (length joints))))
    (linmodel-inwards
     joints
     (lambda (k joint parent)
       (let ((articulation (linmodel-articulation a joint (aref inertias k) (aref loads k) forces)))
         (setf (aref articulations k) articulation)
         (when (> parent 0)
           (setf (aref inertias parent)
                 (linmodel-rows-plus
                  a (aref inertias parent)
                  (linmodel-carried-inertia
                   a joint (linmodel-yielding-inertia a articulation (aref inertias k))))
                 (aref loads parent)
                 (linmodel-load-plus
                  a (aref loads parent)
                  (linmodel-carried-load
                   a joint (linmodel-yielding-load a articulation (aref loads k)))))))))
    (linmodel-accelerations-outwards a joints articulations n)))

(defun linmodel-articulation (a joint inertia load forces)
  (let* ((twists (linmodel-joint-twists joint))
         (columns (loop for (nil . twist) in twists
                        collect (linmodel-matrix-times a inertia (linmodel-six twist))))
         (rows (loop for (nil . twist) in twists
                     collect (loop for column in columns
                                   collect (linmodel-dot a (linmodel-six twist) column)))))
    (make-linmodel-articulation
     :twists twists :columns columns
     :inverse (and twists (linmodel-inverse-rows rows))
     :drive (loop for (i . twist) in twists
                  collect (linmodel-plus a (nth (1- i) forces)
                                         (linmodel-minus a (linmodel-load-along a twist load)))))))

(defun linmodel-inverse-rows (rows)
  (let ((n (length rows)))
    (loop for i below n
          collect (forms-program-solution rows (loop for j below n collect (if (= i j) 1 0))))))

(defun linmodel-combination (a columns factors)
  (let ((sum (list 0 0 0 0 0 0)))
    (mapc (lambda (column factor)
            (setq sum (linmodel-vector-plus a sum (linmodel-vector-times a factor column))))
          columns factors)
    sum))

(defun linmodel-yielding-inertia (a articulation inertia)
  "I - U D^-1 U^T."
  (let* ((columns (linmodel-articulation-columns articulation))
         (inverse (linmodel-articulation-inverse articulation))
         (weighted (loop for row in inverse collect (linmodel-combination a columns row))))
    (linmodel-mirrored
     (loop for row in inertia
           for i from 0
           collect (let ((taken (linmodel-combination
                                 a weighted (mapcar (lambda (column) (nth i column)) columns))))
                     (mapcar (lambda (x y) (linmodel-plus a x (linmodel-minus a y))) row taken))))))

(defun linmodel-yielding-load (a articulation load)
  "p + U D^-1 u."
  (let ((factors (linmodel-matrix-times a (linmodel-articulation-inverse articulation)
                                        (linmodel-articulation-drive articulation))))
    (linmodel-load-plus
     a load
     (linmodel-pair (linmodel-combination a (linmodel-articulation-columns articulation)
                                          factors)))))

(defun linmodel-carried-acceleration (a joint acceleration)
  (destructuring-bind (w . v) acceleration
    (let ((turns (linmodel-joint-turns joint)))
      (cons (linmodel-turned-by-all a turns w)
            (linmodel-turned-by-all
             a turns
             (linmodel-vector-plus a v (linmodel-cross a w (linmodel-joint-place joint))))))))

(defun linmodel-accelerations-outwards (a joints articulations n)
  (let ((found (make-array (1+ n) :initial-element 0))
        (reached (make-array (length joints) :initial-element (linmodel-no-load))))
    (loop for k from 1 below (length joints)
          for joint = (aref joints k)
          for articulation = (aref articulations k)
          for carried = (linmodel-six (linmodel-carried-acceleration
                                       a joint (aref reached (linmodel-joint-parent joint))))
          for twists = (linmodel-articulation-twists articulation)
          for second = (linmodel-joint-accelerations a articulation carried)
          do (loop for (i . nil) in twists
                   for acceleration in second
                   do (setf (aref found i) acceleration))
             (setf (aref reached k)
                   (linmodel-pair
                    (linmodel-vector-plus
                     a carried
                     (linmodel-combination
                      a (mapcar (lambda (twist) (linmodel-six (cdr twist))) twists) second)))))
    (cdr (coerce found 'list))))

(defun linmodel-joint-accelerations (a articulation carried)
  "D^-1 (u - U.x)."
  (linmodel-matrix-times
   a (linmodel-articulation-inverse articulation)
   (loop for drive in (linmodel-articulation-drive articulation)
         for column in (linmodel-articulation-columns articulation)
         collect (linmodel-plus a drive (linmodel-minus a (linmodel-dot a column carried))))))
