;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The accelerations of a tree in which every velocity belongs to one link, by articulated bodies,
;;; on programs: with the inertia I of composite_bodies.lisp, U = I s, D = s.U, u = Q - s.p, where p
;;; is the load without q'',
;;;     I := I - U D^-1 U^T,   p := p + U D^-1 u   go inwards,   q'' = D^-1 (u - U.x)  outwards,
;;; x the parent's acceleration beyond that without q''. R. Featherstone, The calculation of robot
;;; dynamics using articulated-body inertias, Int. J. Robotics Research 2 (1983). See
;;; linmodel-accelerations first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/composite_bodies" "forms/equations_as_program" "forms/program_judge"
                "linmodel/motions" "linmodel/arithmetic" "linmodel/twists"))

(defun linmodel-articulated-p (joints)
  "Whether every velocity belongs to one link."
  (let ((indices (loop for joint across joints
                       when joint append (mapcar #'car (linmodel-joint-twists joint)))))
    (= (length indices) (length (remove-duplicates indices)))))

(defstruct linmodel-articulation twists columns rows inverse drive) ; s, U, D, D^-1, u

(defun linmodel-accelerations (a joints loads forces n)
  "q'' under FORCES; LOADS are those of the motion without q'', which are spent."
  (linmodel-accelerations-outwards a joints (linmodel-articulations a joints loads forces) n))

(defun linmodel-articulations (a joints loads forces)
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
    articulations))

(defun linmodel-articulation (a joint inertia load forces)
  (let* ((twists (linmodel-joint-twists joint))
         (columns (loop for (nil . twist) in twists
                        collect (linmodel-matrix-times a inertia (linmodel-six twist))))
         (rows (loop for (nil . twist) in twists
                     collect (loop for column in columns
                                   collect (linmodel-dot a (linmodel-six twist) column)))))
    (make-linmodel-articulation
     :twists twists :columns columns :rows rows
     :inverse (and twists (linmodel-inverse-rows rows))
     :drive (loop for (i . twist) in twists
                  collect (linmodel-plus a (nth (1- i) forces)
                                         (linmodel-minus a (linmodel-load-along a twist load)))))))

;;; Pivots: those of each D, and beside them s.(I s) with I of all bodies beyond the joint locked.

(defun linmodel-articulated-pivots (a joints loads forces)
  "((i pivot . whole) ..) for the velocities i, from 1."
  (let ((articulations (linmodel-articulations a joints loads forces))
        (locked (linmodel-locked-inertias a joints)))
    (loop for k from 1 below (length joints)
          for articulation = (aref articulations k)
          append (linmodel-joint-pivots a articulation (aref locked k)))))

(defun linmodel-joint-pivots (a articulation locked)
  (let ((twists (linmodel-articulation-twists articulation)))
    (when twists
      (let ((factors (forms-program-factors (linmodel-articulation-rows articulation)
                                            *forms-singular-mass*)))
        (loop for (i . twist) in twists
              for j from 0
              for six = (linmodel-six twist)
              collect (list* i (aref factors j j)
                             (linmodel-dot a six (linmodel-matrix-times a locked six))))))))

(defun linmodel-locked-inertias (a joints)
  (let ((inertias (linmodel-own-inertias a joints)))
    (linmodel-inwards
     joints
     (lambda (k joint parent)
       (when (> parent 0)
         (setf (aref inertias parent)
               (linmodel-rows-plus a (aref inertias parent)
                                   (linmodel-carried-inertia a joint (aref inertias k)))))))
    inertias))

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
