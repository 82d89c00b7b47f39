;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The graph of a circuit as a picture: branches of the tree thick, links thin and broken, arrows,
;;; labels where there is room for them, the loops in words. Branches between the same nodes are
;;; bent apart. See $numerics_draw_structure first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/pictures" "numerics/structure_places"))

(defun $numerics_draw_structure (picture graph)
  "Draws GRAPH = [nodes, branches, transformers, loops] and returns the name of the file, or done."
  (destructuring-bind (nodes branches transformers loops) (mapcar #'cdr (cdr graph))
    (let* ((ends (loop for (nil nil a b) in branches collect (list (1- a) (1- b))))
           (joined (loop for (nil a b) in transformers collect (list (1- a) (1- b))))
           (places (numerics-placed-nodes (length nodes) (append ends joined)))
           (lines (numerics-bent-lines ends places))
           (labels (numerics-label-places lines places)))
      (or (numerics-draw picture
                         (cons (format nil "~a~{~a~%~}" (numerics-structure-preamble loops joined)
                                       (append (numerics-branch-lines branches lines labels places)
                                               (numerics-transformer-lines joined places)
                                               (numerics-node-labels
                                                nodes lines (mapcar #'cdr labels) places)))
                               (numerics-node-items places)))
          '$done))))

(defun numerics-structure-preamble (loops transformers)
  (format nil "~a~%unset border~%unset xtics~%unset ytics~%unset key~%set size ratio -1~%~
               set style textbox opaque margins 0.4,0.2 fillcolor rgb 'white' noborder~%"
          (numerics-title-line
           (append (list "thick: tree;" "broken: links;")
                   (and transformers '("dotted: transformers;"))
                   (cons (if loops "loops:" "no loops")
                         (loop for (loop . more) on loops
                               collect (format nil "~a~:[~;,~]" (core-words (list loop)) more)))))))

;;; Lines of gnuplot. (GCL takes at most 64 objects of draw.)

(defparameter *numerics-bend* 0.2d0 "How far apart branches between the same nodes are.")

(defun numerics-bent-lines (ends places)
  "A list of points for each branch."
  (let ((met (make-hash-table :test #'equal)))
    (flet ((key (pair) (sort (copy-list pair) #'<)))
      (loop for pair in ends
            for count = (count (key pair) ends :test #'equal :key #'key)
            for place = (- (incf (gethash (key pair) met 0)) (/ (1+ count) 2))
            for bend = (* *numerics-bend* place (if (equal (key pair) pair) 1 -1))
            collect (numerics-bent-line places (first pair) (second pair) bend)))))

(defun numerics-bent-line (places a b bend)
  "Points from node A to node B, bent to the left by BEND; a circle where they are one node."
  (destructuring-bind (x y) (aref places a)
    (if (= a b)
        (loop for k from 0 to 16
              for angle = (* pi k 1/8)
              collect (list (+ x (* 0.15d0 (- 1 (cos angle)))) (+ y (* 0.15d0 (sin angle)))))
        (destructuring-bind (dx dy distance) (numerics-between-nodes places a b)
          (loop for k from 0 to 16
                for s = (/ k 16d0)
                for side = (* 4 bend s (- 1 s))
                collect (list (- (+ x (* s dx)) (* side (/ dy distance)))
                              (+ y (* s dy) (* side (/ dx distance)))))))))

(defun numerics-branch-lines (branches lines labels places)
  "Arrows along LINES, and the labels of BRANCHES, (k . place) each."
  (loop with size = (min 0.1d0 (* *numerics-head* (numerics-extent places)))
        for (nil label nil nil in-tree) in branches
        for points in lines
        for (k . place) in labels
        append (numerics-arrows points (if (>= k 8) 5 13) size in-tree)
        collect (format nil "set label ~a at ~,4f,~,4f center front boxed noenhanced"
                        (numerics-gnuplot-text (core-words (list label)))
                        (first place) (second place))))

(defparameter *numerics-head* 0.015d0 "The length of a head, in parts of the picture.")

(defun numerics-extent (places)
  (destructuring-bind ((a b) (c d)) (list (numerics-corner #'min places -0.4d0)
                                          (numerics-corner #'max places 0.4d0))
    (max (- c a) (* 1.3d0 (- d b)))))

(defun numerics-arrows (points head size in-tree)
  "Along POINTS, and a head of SIZE at the point HEAD, on a line long enough for it. Links have
their dashes drawn: gnuplot's begin anew with each of the short lines."
  (let ((style (if in-tree "lc rgb '#1f4e9a' lw 3" "lc rgb '#606060' lw 1.3")))
    (cons (numerics-arrow-line (nth (- head 2) points) (nth head points)
                               (format nil "head filled size first ~,4f,20 ~a" size style))
          (loop for (one other) on points
                while other
                collect (numerics-arrow-line one (if in-tree other (numerics-dash one other))
                                             (format nil "nohead ~a" style))))))

(defun numerics-dash (one other)
  (mapcar (lambda (x u) (+ x (* 0.62d0 (- u x)))) one other))

(defun numerics-arrow-line (one other style)
  (format nil "set arrow from ~,4f,~,4f to ~,4f,~,4f ~a" (first one) (second one) (first other)
          (second other) style))

(defun numerics-transformer-lines (joined places)
  (loop for (a b) in joined
        collect (numerics-arrow-line (aref places a) (aref places b)
                                     "nohead lc rgb '#b05010' lw 1.5 dt 3")))

;;; Labels of branches: on the line, in its middle where that is free

(defparameter *numerics-label-room* 0.17d0 "From a label to what is not to be near it.")

(defun numerics-label-places (lines places)
  "(k . place) for each of LINES: its point k, where the label stands."
  (let ((taken (coerce places 'list)))
    (loop for points in lines
          collect (let* ((others (append taken (loop for other in lines
                                                     unless (eq other points) append other)))
                         (k (numerics-freest-point points others)))
                    (push (nth k points) taken)
                    (cons k (nth k points))))))

(defun numerics-freest-point (points others)
  "The number of the point of POINTS, its middle or about it, that is free of OTHERS or freest."
  (let ((best 8) (most -1d0))
    (dolist (k '(8 7 9 6 10 5 11 4 12) best)
      (let ((room (numerics-room (nth k points) others)))
        (when (>= room *numerics-label-room*) (return k))
        (when (> room (+ most 1d-6)) (setq best k most room))))))

(defun numerics-room (place others)
  "How far the nearest of OTHERS is from PLACE."
  (loop for other in others minimize (numerics-gap-between place other)))

;;; Labels of nodes: round about, where they are farthest from lines and other labels

(defparameter *numerics-node-label-way* 0.17d0 "From a node to its label.")

(defun numerics-node-labels (nodes lines labels places)
  "LABELS are the places of those of branches."
  (let ((taken (append labels (apply #'append lines) (coerce places 'list))))
    (loop for node in nodes
          for place across places
          collect (numerics-node-label (core-words (list node)) place
                                       (numerics-freest-direction place taken)))))

(defun numerics-freest-direction (place taken)
  "The angle at which a label of the node at PLACE is farthest from what is TAKEN; of equal ones the
first from straight up."
  (let ((best (/ pi 2)) (most -1d0))
    (dotimes (k 16 best)
      (let* ((angle (+ (/ pi 2) (* k (/ pi 8))))
             (room (numerics-room
                    (list (+ (first place) (* *numerics-node-label-way* (cos angle)))
                          (+ (second place) (* *numerics-node-label-way* (sin angle))))
                    taken)))
        (when (> room (+ most 1d-6)) (setq best angle most room))))))

(defun numerics-node-label (text place angle)
  (let ((dx (cos angle)) (dy (sin angle)))
    (format nil "set label ~a at ~,4f,~,4f ~a offset character ~,2f,~,2f front noenhanced"
            (numerics-gnuplot-text text) (first place) (second place)
            (cond ((> dx 0.4d0) "left") ((< dx -0.4d0) "right") (t "center"))
            (* 1.1d0 dx) (* 0.9d0 dy))))

;;; Nodes

(defun numerics-node-items (places)
  "The nodes, and before them two corners that leave room for labels."
  (list (numerics-option '$point_type '$dot)
        (numerics-option '$color '$white)
        (numerics-points (list (numerics-corner #'min places -0.4d0)
                               (numerics-corner #'max places 0.4d0)))
        (numerics-option '$point_type '$filled_circle)
        (numerics-option '$point_size 1.2d0)
        (numerics-option '$color '$black)
        (numerics-points (coerce places 'list))))

(defun numerics-corner (choose places margin)
  (flet ((side (part) (+ margin (reduce choose (map 'vector part places)))))
    (list (side #'first) (side #'second))))
