;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a person sees of a graph: crossings of its edges and nodes on edges that are not theirs, in
;;; the places that DrawStructure takes; and whether labels stand apart.

(in-package :maxima)

(core-require "numerics/structure_picture" "numerics/structure_places")

(defun graph-ends (ends)
  "Lists of two numbers from 0, of Maxima's from 1."
  (loop for (nil a b) in (cdr ends) collect (list (1- a) (1- b))))

(defun $graph_faults (n ends)
  "How many faults the places of N nodes have."
  (numerics-drawing-faults (numerics-placed-nodes n (graph-ends ends))
                           (numerics-edges (graph-ends ends))))

(defun $graph_shortest_way (n ends)
  "The least distance of two nodes, an edge being about 1 long."
  (let ((places (coerce (numerics-placed-nodes n (graph-ends ends)) 'list)))
    (loop for (place . others) on places
          when others minimize (numerics-room place others))))

(defun $graph_label_room (n ends)
  "The least distance of the labels of branches from each other and from nodes."
  (let* ((pairs (graph-ends ends)) (places (numerics-placed-nodes n pairs))
         (labels (mapcar #'cdr (numerics-label-places (numerics-bent-lines pairs places) places))))
    (loop for (label . others) on labels
          minimize (numerics-room label (append others (coerce places 'list))))))

(defun $graph_same_twice (n ends)
  (equalp (numerics-placed-nodes n (graph-ends ends)) (numerics-placed-nodes n (graph-ends ends))))
