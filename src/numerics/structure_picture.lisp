;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The graph of a circuit as a picture: branches of the tree thick, links thin and broken, arrows
;;; and labels, the loops in words. Nodes repel each other and branches draw them together
;;; (Fruchterman, Reingold, Graph drawing by force-directed placement, 1991), from a circle, so that
;;; the same circuit gives the same picture. Branches between the same nodes are bent apart.
;;; See $numerics_draw_structure first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/pictures"))

(defun $numerics_draw_structure (picture graph)
  "Draws GRAPH = [nodes, branches, transformers, loops] and returns the name of the file, or done."
  (destructuring-bind (nodes branches transformers loops) (mapcar #'cdr (cdr graph))
    (let* ((ends (loop for (nil nil a b) in branches collect (list (1- a) (1- b))))
           (places (numerics-placed-nodes (length nodes)
                                          (append ends
                                                  (loop for (nil a b) in transformers
                                                        collect (list (1- a) (1- b)))))))
      (or (numerics-draw picture
                         (cons (numerics-structure-preamble loops)
                               (append (numerics-branch-items branches ends places)
                                       (numerics-transformer-items transformers places)
                                       (numerics-node-items nodes places))))
          '$done))))

(defun numerics-structure-preamble (loops)
  (format nil "set title ~a noenhanced~%unset border~%unset xtics~%unset ytics~%set key outside ~
               top center horizontal~%set size ratio -1~%set offsets 0.1,0.1,0.1,0.1~%"
          (numerics-gnuplot-text
           (if loops
               (format nil "loops: ~{~a~^, ~}" (mapcar (lambda (e) (core-words (list e))) loops))
               "no loops"))))

;;; Places of the nodes

(defparameter *numerics-most-placed* 80
  "Nodes for which places are looked for; more form a circle.")

(defun numerics-placed-nodes (n ends)
  "A vector of (x y), all within the unit square or about it."
  (let ((places (make-array n)))
    (dotimes (k n)
      (let ((angle (/ (* 2 pi k) (max n 1))))
        (setf (aref places k) (list (* 1d0 (cos angle)) (* 1d0 (sin angle))))))
    (when (<= 3 n *numerics-most-placed*)
      (loop for step from 200 downto 1
            do (numerics-move-nodes places ends (/ 1d0 (sqrt n)) (* 1d-3 step))))
    places))

(defun numerics-move-nodes (places ends length largest)
  "Moves each node by the forces on it, at most by LARGEST."
  (let ((forces (map 'vector (lambda (place) (declare (ignore place)) (list 0d0 0d0)) places)))
    (flet ((pull (a b amount)
             (destructuring-bind (dx dy distance) (numerics-between-nodes places a b)
               (let ((f (funcall amount distance)))
                 (incf (first (aref forces a)) (* f (/ dx distance)))
                 (incf (second (aref forces a)) (* f (/ dy distance)))))))
      (dotimes (a (length places))
        (dotimes (b (length places))
          (unless (= a b) (pull a b (lambda (d) (- (/ (* length length) d)))))))
      (loop for (a b) in ends
            unless (= a b)
              do (pull a b (lambda (d) (/ (* d d) length 3)))
                 (pull b a (lambda (d) (/ (* d d) length 3)))))
    (loop for (fx fy) across forces
          for k from 0
          for size = (max 1d-9 (sqrt (+ (* fx fx) (* fy fy))))
          for step = (/ (min size largest) size)
          do (incf (first (aref places k)) (* step fx))
             (incf (second (aref places k)) (* step fy)))))

(defun numerics-between-nodes (places a b)
  "(dx dy distance) from node A to node B."
  (let* ((dx (- (first (aref places b)) (first (aref places a))))
         (dy (- (second (aref places b)) (second (aref places a)))))
    (list dx dy (max 1d-3 (sqrt (+ (* dx dx) (* dy dy)))))))

;;; Items

(defun numerics-branch-items (branches ends places)
  (let ((met (make-hash-table :test #'equal)) (named '()))
    (loop for (nil label nil nil in-tree) in branches
          for pair in ends
          for key = (sort (copy-list pair) #'<)
          for count = (count key ends :test #'equal
                                      :key (lambda (one) (sort (copy-list one) #'<)))
          for place = (- (incf (gethash key met 0)) (/ (1+ count) 2))
          for bend = (* 0.09d0 place (if (equal key pair) 1 -1))
          for first = (not (member in-tree named))
          do (when first (push in-tree named))
          append (numerics-branch-item places pair bend label in-tree first))))

(defun numerics-branch-item (places pair bend label in-tree named)
  (let* ((points (numerics-bent-line places (first pair) (second pair) bend))
         (middle (nth (floor (length points) 2) points))
         (before (nth (1- (floor (length points) 2)) points)))
    (list (numerics-option '$points_joined t)
          (numerics-option '$point_type '$none)
          (numerics-option '$color (if in-tree "#1f4e9a" "#808080"))
          (numerics-option '$line_width (if in-tree 3 1))
          (numerics-option '$line_type (if in-tree '$solid '$dashes))
          (numerics-option '$key (cond ((not named) "") (in-tree "tree") (t "links")))
          (numerics-points points)
          (numerics-option '$key "")
          (numerics-option '$line_type '$solid)
          (numerics-option '$head_length 0.03d0)
          (numerics-option '$head_angle 20)
          (list '($vector simp) (cons '(mlist simp) before)
                (list '(mlist simp) (- (first middle) (first before))
                      (- (second middle) (second before))))
          (numerics-option '$color '$black)
          (numerics-text-item (core-words (list label)) (first middle)
                              (+ 0.035d0 (second middle))))))

(defun numerics-text-item (text x y)
  (list '(%label simp) (list '(mlist simp) (substitute #\Space #\_ text) x y)))

(defun numerics-bent-line (places a b bend)
  "Points from node A to node B, bent to the left by BEND; a circle where they are one node."
  (destructuring-bind (x y) (aref places a)
    (if (= a b)
        (loop for k from 0 to 16
              for angle = (* pi k 1/8)
              collect (list (+ x (* 0.08d0 (- 1 (cos angle)))) (+ y (* 0.08d0 (sin angle)))))
        (destructuring-bind (dx dy distance) (numerics-between-nodes places a b)
          (loop for k from 0 to 16
                for s = (/ k 16d0)
                for side = (* 4 bend s (- 1 s))
                collect (list (- (+ x (* s dx)) (* side (/ dy distance)))
                              (+ y (* s dy) (* side (/ dx distance)))))))))

(defun numerics-transformer-items (transformers places)
  (loop for (nil a b) in transformers
        append (list (numerics-option '$points_joined t)
                     (numerics-option '$point_type '$none)
                     (numerics-option '$color "#b05010")
                     (numerics-option '$line_width 1)
                     (numerics-option '$line_type '$dots)
                     (numerics-points (list (aref places (1- a)) (aref places (1- b)))))))

(defun numerics-node-items (nodes places)
  (append (list (numerics-option '$points_joined nil)
                (numerics-option '$point_type '$filled_circle)
                (numerics-option '$point_size 1.2d0)
                (numerics-option '$color '$black)
                (numerics-points (coerce places 'list)))
          (loop for node in nodes
                for (x y) across places
                collect (numerics-text-item (core-words (list node)) (- x 0.03d0) (- y 0.04d0)))))
