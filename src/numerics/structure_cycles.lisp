;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A cycle of a graph on a circle, every other node at the mean of its neighbours: where the cycle
;;; goes round a face of a graph that hangs together threefold, no edges cross (W. T. Tutte, How to
;;; draw a graph, 1963). Cycles are tried that one edge closes in a tree of shortest ways. Look
;;; first at numerics-places-in-cycles.

(in-package :maxima)

(defparameter *numerics-most-cycles* 40)
(defparameter *numerics-means* 200)

(defun numerics-places-in-cycles (n edges)
  "A list of vectors of places for N nodes."
  (let ((neighbours (numerics-nodes-beside n edges)))
    (loop for cycle in (numerics-cycles n edges neighbours)
          repeat *numerics-most-cycles*
          collect (numerics-means-in-cycle n cycle neighbours))))

(defun numerics-nodes-beside (n edges)
  "A vector of lists of nodes."
  (let ((found (make-array n :initial-element '())))
    (loop for (a b) in edges
          do (push b (aref found a))
             (push a (aref found b)))
    found))

(defun numerics-parents (n neighbours)
  "The vector of the nodes before each on shortest ways, nil for a first one."
  (let ((parents (make-array n :initial-element :open)))
    (dotimes (root n parents)
      (when (eq (aref parents root) :open)
        (setf (aref parents root) nil)
        (loop with waiting = (list root)
              while waiting
              do (let ((node (pop waiting)))
                   (dolist (other (aref neighbours node))
                     (when (eq (aref parents other) :open)
                       (setf (aref parents other) node
                             waiting (append waiting (list other)))))))))))

(defun numerics-way-back (node parents)
  (loop for place = node then (aref parents place)
        while place collect place))

(defun numerics-cycles (n edges neighbours)
  "Cycles, lists of nodes, each closed by one of EDGES."
  (let ((parents (numerics-parents n neighbours)))
    (loop for (a b) in edges
          unless (or (eql (aref parents a) b) (eql (aref parents b) a))
            collect (numerics-cycle-of (numerics-way-back a parents)
                                       (numerics-way-back b parents)))))

(defun numerics-cycle-of (one other)
  "The cycle of the two ways back ONE and OTHER to where they meet."
  (let ((meeting (find-if (lambda (node) (member node other)) one)))
    (append (subseq one 0 (1+ (position meeting one)))
            (reverse (subseq other 0 (position meeting other))))))

(defun numerics-means-in-cycle (n cycle neighbours)
  (let ((places (make-array n)) (radius (/ (max 3 (length cycle)) 5d0)))
    (dotimes (k n) (setf (aref places k) (list 0d0 0d0)))
    (loop for node in cycle
          for angle from 0d0 by (/ (* 2 pi) (length cycle))
          do (setf (aref places node) (list (* radius (cos angle)) (* radius (sin angle)))))
    (loop repeat *numerics-means*
          do (dotimes (k n)
               (unless (or (member k cycle) (null (aref neighbours k)))
                 (setf (aref places k) (numerics-mean-of places (aref neighbours k))))))
    places))

(defun numerics-mean-of (places nodes)
  (let ((count (length nodes)))
    (flet ((mean (part)
             (/ (loop for k in nodes sum (funcall part (aref places k))) count)))
      (list (mean #'first) (mean #'second)))))
