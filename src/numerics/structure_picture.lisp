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
    (let* ((ends (numerics-end-numbers branches))
           (joined (loop for (nil a b) in transformers collect (list (1- a) (1- b))))
           (places (numerics-placed-nodes (length nodes) (append ends joined))))
      (or (numerics-draw picture
                         (cons (format nil "~a~{~a~%~}" (numerics-structure-preamble loops)
                                       (append (numerics-branch-lines branches ends places)
                                               (numerics-transformer-lines joined places)
                                               (numerics-node-labels nodes places)))
                               (numerics-node-items places)))
          '$done))))

(defun numerics-end-numbers (branches)
  (loop for (nil nil a b) in branches collect (list (1- a) (1- b))))

(defun numerics-structure-preamble (loops)
  (format nil "set title ~a noenhanced~%unset border~%unset xtics~%unset ytics~%unset key~%~
               set size ratio -1~%set offsets graph 0.1,graph 0.1,graph 0.1,graph 0.1~%"
          (numerics-gnuplot-text
           (if loops
               (format nil "tree: thick; loops: ~{~a~^, ~}"
                       (mapcar (lambda (e) (core-words (list e))) loops))
               "tree: thick; no loops"))))

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

;;; Lines of gnuplot: arrows, with a head in the middle of a branch, and labels. (GCL takes at most
;;; 64 objects of draw.)

(defun numerics-branch-lines (branches ends places)
  (let ((met (make-hash-table :test #'equal)))
    (flet ((key (pair) (sort (copy-list pair) #'<)))
      (loop for (nil label nil nil in-tree) in branches
            for pair in ends
            for count = (count (key pair) ends :test #'equal :key #'key)
            for place = (- (incf (gethash (key pair) met 0)) (/ (1+ count) 2))
            for bend = (* 0.09d0 place (if (equal (key pair) pair) 1 -1))
            append (numerics-branch-line
                    (numerics-bent-line places (first pair) (second pair) bend)
                    label in-tree)))))

(defun numerics-branch-line (points label in-tree)
  (let ((middle (floor (length points) 2))
        (style (if in-tree "lc rgb '#1f4e9a' lw 3" "lc rgb '#808080' lw 1 dt 2")))
    (append (loop for (one other) on points
                  for k from 1
                  while other
                  collect (numerics-arrow-line
                           one other
                           (format nil "~:[nohead~;head filled size screen 0.015,20~] ~a"
                                   (= k middle) style)))
            (list (numerics-label-line (core-words (list label)) (nth middle points) 0.035d0)))))

(defun numerics-arrow-line (one other style)
  (format nil "set arrow from ~,4f,~,4f to ~,4f,~,4f ~a" (first one) (second one) (first other)
          (second other) style))

(defun numerics-label-line (text place above)
  (format nil "set label ~a at ~,4f,~,4f center front noenhanced" (numerics-gnuplot-text text)
          (first place) (+ above (second place))))

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

(defun numerics-transformer-lines (joined places)
  (loop for (a b) in joined
        collect (numerics-arrow-line (aref places a) (aref places b)
                                     "nohead lc rgb '#b05010' lw 1 dt 3")))

(defun numerics-node-labels (nodes places)
  (loop for node in nodes
        for place across places
        collect (numerics-label-line (core-words (list node)) place -0.045d0)))

(defun numerics-node-items (places)
  "The nodes, and before them two corners that leave room for labels."
  (list (numerics-option '$point_type '$dot)
        (numerics-option '$color '$white)
        (numerics-points (list (numerics-corner #'min places -0.12d0)
                               (numerics-corner #'max places 0.12d0)))
        (numerics-option '$point_type '$filled_circle)
        (numerics-option '$point_size 1.2d0)
        (numerics-option '$color '$black)
        (numerics-points (coerce places 'list))))

(defun numerics-corner (choose places margin)
  (flet ((side (part) (+ margin (reduce choose (map 'vector part places)))))
    (list (side #'first) (side #'second))))
