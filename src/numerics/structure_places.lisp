;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Places for the nodes of a graph: their distances in the picture are those along its edges as
;;; nearly as can be (E. R. Gansner, Y. Koren, S. North, Graph drawing by stress majorization,
;;; 2004), from circles in several orders, always the same ones. If all have crossings one is
;;; mended, or cycles are drawn as faces. What has the fewest crossings is turned so that it lies.
;;; Look first at numerics-placed-nodes.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/watch" "numerics/structure_cycles"))

(defparameter *numerics-most-placed* 80
  "Nodes for which places are looked for; more form a circle.")
(defparameter *numerics-orders* 24 "Circles that are tried at most.")
(defparameter *numerics-most-in-faces* 20 "Nodes for which cycles are drawn as faces.")

(defun numerics-placed-nodes (n ends)
  "A vector of (x y) for N nodes joined by ENDS, pairs; an edge is about 1 long."
  (if (<= 3 n *numerics-most-placed*)
      (numerics-laid (numerics-best-drawing n (numerics-edges ends)
                                            (numerics-graph-distances n ends)))
      (numerics-on-circle (loop for k below n collect k))))

(defun numerics-best-drawing (n edges lengths)
  "Places without faults, if need be of the best of cycles as faces, else with the fewest."
  (flet ((best (drawings) (numerics-fewest-faults edges drawings))
         (mended (places) (lambda () (numerics-mended places edges lengths))))
    (let* ((relaxed (best (loop for order in (numerics-orders n)
                                collect (let ((order order))
                                          (lambda () (numerics-relaxed (numerics-on-circle order)
                                                                       lengths))))))
           (faces (unless (or (> n *numerics-most-in-faces*)
                              (zerop (numerics-drawing-faults relaxed edges)))
                    (best (mapcar #'constantly (numerics-places-in-cycles n edges))))))
      (best (append (list (mended relaxed)) (and faces (list (mended faces))))))))

(defun numerics-fewest-faults (edges drawings)
  "Of the places that the functions DRAWINGS give the first without faults, else those with the
fewest."
  (let ((best nil) (least nil))
    (loop for drawing in drawings
          for places = (progn (core-progress "arranging the nodes") (funcall drawing))
          for faults = (numerics-drawing-faults places edges)
          do (when (or (null least) (< faults least)) (setq best places least faults))
          until (zerop least))
    best))

(defun numerics-on-circle (order)
  "A vector of places, ORDER telling each node's place on a circle."
  (let ((n (length order)))
    (map 'vector (lambda (k)
                   (let ((angle (/ (* 2 pi k) (max n 1))) (radius (/ (max n 2) 6d0)))
                     (list (* radius (cos angle)) (* radius (sin angle)))))
         order)))

(defun numerics-orders (n)
  "Orders of N nodes, fewer of many: as they come, then shuffled."
  (let ((count (max 1 (min *numerics-orders* (floor 4000 (* n n))))) (seed 1))
    (flet ((draw (below) (floor (setq seed (mod (* 16807 seed) 2147483647)) (/ 2147483647 below))))
      (loop repeat count
            for order = (loop for k below n collect k)
              then (let ((left (copy-list order)))
                     (loop while left
                           collect (let ((k (nth (min (draw (length left)) (1- (length left)))
                                                 left)))
                                     (setq left (remove k left))
                                     k)))
            collect order))))

;;; Distances along edges. Where several branches join two nodes they get more room.

(defun numerics-edges (ends)
  "(a b count), a < b, for the pairs among ENDS, COUNT being how often each is there."
  (let ((pairs (loop for (a b) in ends
                     unless (= a b) collect (list (min a b) (max a b)))))
    (loop for (a b) in (remove-duplicates pairs :test #'equal)
          collect (list a b (count (list a b) pairs :test #'equal)))))

(defun numerics-graph-distances (n ends)
  "The array of the lengths of the shortest ways; parts that are not joined are sqrt(N) apart."
  (let ((lengths (make-array (list n n) :initial-element nil)))
    (loop for (a b count) in (numerics-edges ends)
          for length = (+ 1d0 (* 0.15d0 (1- count)))
          do (setf (aref lengths a b) length (aref lengths b a) length))
    (dotimes (k n)
      (dotimes (a n)
        (dotimes (b n)
          (let ((first (aref lengths a k)) (second (aref lengths k b)) (known (aref lengths a b)))
            (when (and first second (or (null known) (< (+ first second) known)))
              (setf (aref lengths a b) (+ first second)))))))
    (dotimes (a n lengths)
      (dotimes (b n)
        (unless (aref lengths a b) (setf (aref lengths a b) (max 2d0 (sqrt (* 1d0 n)))))))))

;;; Stress majorization: each node goes to the mean of the places at which the others want it

(defparameter *numerics-relaxations* 100)

(defun numerics-gap-between (one other)
  (destructuring-bind ((a b) (c d)) (list one other)
    (sqrt (+ (expt (- c a) 2) (expt (- d b) 2)))))

(defun numerics-between-nodes (places a b)
  "(dx dy distance) from node A to node B."
  (let* ((dx (- (first (aref places b)) (first (aref places a))))
         (dy (- (second (aref places b)) (second (aref places a)))))
    (list dx dy (max 1d-3 (sqrt (+ (* dx dx) (* dy dy)))))))

(defun numerics-relaxed (places lengths)
  (loop repeat *numerics-relaxations*
        do (dotimes (a (length places))
             (setf (aref places a) (numerics-wanted-place places lengths a))))
  places)

(defun numerics-wanted-place (places lengths a)
  (let ((x 0d0) (y 0d0) (weights 0d0))
    (dotimes (b (length places) (list (/ x weights) (/ y weights)))
      (unless (= a b)
        (let* ((length (aref lengths a b)) (weight (/ 1d0 (* length length))))
          (destructuring-bind (dx dy distance) (numerics-between-nodes places b a)
            (destructuring-bind (bx by) (aref places b)
              (incf x (* weight (+ bx (* length (/ dx distance)))))
              (incf y (* weight (+ by (* length (/ dy distance)))))
              (incf weights weight))))))))

;;; What a drawing is worth: crossings, and nodes that lie on edges which are not theirs

(defun numerics-node-room (edge)
  "How far nodes are to be from EDGE, whose branches are bent apart."
  (+ 0.25d0 (* 0.1d0 (1- (third edge)))))

(defun numerics-end-p (node edge) (or (= node (first edge)) (= node (second edge))))

(defun numerics-drawing-faults (places edges)
  (+ (loop for (edge . more) on edges
           sum (loop for other in more count (numerics-cross-p places edge other)))
     (loop for k below (length places) sum (numerics-edges-over places edges k))))

(defun numerics-edges-over (places edges node)
  (loop for edge in edges
        count (and (not (numerics-end-p node edge)) (numerics-on-edge-p places node edge))))

(defun numerics-faults-at (places edges node)
  "Those faults that a move of NODE can change."
  (+ (numerics-edges-over places edges node)
     (loop for edge in edges
           when (numerics-end-p node edge)
             sum (+ (loop for other in edges count (numerics-cross-p places edge other))
                    (loop for k below (length places)
                          count (and (not (numerics-end-p k edge))
                                     (numerics-on-edge-p places k edge)))))))

(defun numerics-turn-of-nodes (places a b c)
  "Twice the area of the triangle of the nodes A, B, C, with its sign."
  (destructuring-bind ((x y) (u v) (s z)) (list (aref places a) (aref places b) (aref places c))
    (- (* (- u x) (- z y)) (* (- v y) (- s x)))))

(defun numerics-cross-p (places edge other)
  (let ((a (first edge)) (b (second edge)) (c (first other)) (d (second other)))
    (and (not (numerics-end-p a other)) (not (numerics-end-p b other))
         (minusp (* (numerics-turn-of-nodes places a b c) (numerics-turn-of-nodes places a b d)))
         (minusp (* (numerics-turn-of-nodes places c d a) (numerics-turn-of-nodes places c d b))))))

(defun numerics-on-edge-p (places node edge)
  "Whether NODE is too near to EDGE."
  (destructuring-bind ((a b) (c d) (u v))
      (list (aref places (first edge)) (aref places (second edge)) (aref places node))
    (let* ((dx (- c a)) (dy (- d b)) (square (+ (* dx dx) (* dy dy) 1d-12))
           (share (max 0d0 (min 1d0 (/ (+ (* (- u a) dx) (* (- v b) dy)) square)))))
      (< (numerics-gap-between (list u v) (list (+ a (* share dx)) (+ b (* share dy))))
         (numerics-node-room edge)))))

;;; Where faults are left, single nodes go to places of a grid where they have fewer, and then as
;;; near as may be to where their distances want them

(defparameter *numerics-grid* 7)
(defparameter *numerics-sweeps* 4)
(defparameter *numerics-mendings* 60)

(defun numerics-mended (places edges lengths)
  (loop repeat *numerics-sweeps*
        until (zerop (numerics-drawing-faults places edges))
        do (dotimes (node (length places)) (numerics-move-to-fewest places edges lengths node)))
  (loop repeat *numerics-mendings*
        do (dotimes (node (length places))
             (numerics-move-unless-worse places edges node
                                         (numerics-wanted-place places lengths node))))
  places)

(defun numerics-move-unless-worse (places edges node place)
  (let ((before (aref places node)) (faults (numerics-faults-at places edges node)))
    (setf (aref places node) place)
    (when (> (numerics-faults-at places edges node) faults) (setf (aref places node) before))))

(defun numerics-move-to-fewest (places edges lengths node)
  "Moves NODE where it has the fewest faults, of such places to where its distances are best."
  (let* ((best (aref places node)) (least (numerics-faults-at places edges node)) (strain nil))
    (when (plusp least)
      (dolist (place (numerics-grid-places places))
        (setf (aref places node) place)
        (let ((faults (numerics-faults-at places edges node))
              (there (numerics-strain places lengths node)))
          (when (or (< faults least) (and strain (= faults least) (< there strain)))
            (setq best place least faults strain there))))
      (setf (aref places node) best))))

(defun numerics-strain (places lengths node)
  "How far the distances of NODE are from those that are wanted."
  (loop for k below (length places)
        for length = (aref lengths node k)
        unless (= k node)
          sum (expt (1- (/ (third (numerics-between-nodes places node k)) length)) 2)))

(defun numerics-grid-places (places)
  (flet ((ends (part)
           (let ((low (reduce #'min (map 'vector part places)))
                 (high (reduce #'max (map 'vector part places))))
             (loop for k below *numerics-grid*
                   collect (+ low (* (- high low) (/ (+ k 0.5d0) *numerics-grid*)))))))
    (loop for x in (ends #'first)
          append (loop for y in (ends #'second) collect (list x y)))))

;;; Lying: the longest extent goes across

(defun numerics-laid (places)
  (let* ((n (length places)) (x (/ (reduce #'+ (map 'vector #'first places)) n))
         (y (/ (reduce #'+ (map 'vector #'second places)) n)) (xx 0d0) (xy 0d0) (yy 0d0))
    (loop for (u v) across places
          do (incf xx (expt (- u x) 2)) (incf yy (expt (- v y) 2)) (incf xy (* (- u x) (- v y))))
    (let* ((angle (if (and (zerop xy) (= xx yy)) 0d0 (/ (atan (* 2 xy) (- xx yy)) 2)))
           (c (cos angle)) (s (sin angle)))
      (map 'vector (lambda (place)
                     (destructuring-bind (u v) place
                       (list (+ (* c (- u x)) (* s (- v y))) (- (* c (- v y)) (* s (- u x))))))
           places))))
