;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; An order of the unknowns that brings the entries of a sparse matrix near its diagonal: reverse
;;; Cuthill-McKee (George & Liu: Computer Solution of Large Sparse Positive Definite Systems,
;;; chapter 4). Unknowns that stand in one row or column with an entry are neighbours; each
;;; connected part is walked from one that lies far out, neighbours of few neighbours first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/linear_solver_matrix"))

(defun numerics-neighbours (pattern)
  "Vector of the lists of neighbours, those with fewer neighbours first."
  (let* ((n (numerics-pattern-size pattern)) (lists (make-array n :initial-element '()))
         (degrees (make-array n)))
    (dotimes (j n)
      (dolist (i (numerics-column-rows pattern j))
        (unless (= i j)
          (push i (aref lists j))
          (push j (aref lists i)))))
    (dotimes (i n)
      (setf (aref lists i) (numerics-without-repeats (sort (aref lists i) #'<))
            (aref degrees i) (length (aref lists i))))
    (dotimes (i n lists)
      (setf (aref lists i) (stable-sort (aref lists i) #'< :key (lambda (j) (aref degrees j)))))))

(defun numerics-layers (start neighbours seen mark)
  "The unknowns that are connected with START, layer by layer of distance; they get MARK in SEEN."
  (setf (aref seen start) mark)
  (loop for layer = (list start)
          then (let ((next '()))
                 (dolist (i layer (nreverse next))
                   (dolist (j (aref neighbours i))
                     (unless (eql (aref seen j) mark)
                       (setf (aref seen j) mark)
                       (push j next)))))
        while layer collect layer))

(defun numerics-far-unknown (start neighbours seen)
  "One from which the walk has many layers, by going to the far end as long as that gives more."
  (loop with layers = (numerics-layers start neighbours seen (list start))
        do (let* ((far (reduce (lambda (i j)
                                 (if (<= (length (aref neighbours i)) (length (aref neighbours j)))
                                     i
                                     j))
                               (car (last layers))))
                  (other (numerics-layers far neighbours seen (list far))))
             (when (<= (length other) (length layers)) (return start))
             (setq start far layers other))))

(defun numerics-band-order (pattern)
  "The unknowns in their new order."
  (let* ((n (numerics-pattern-size pattern)) (neighbours (numerics-neighbours pattern))
         (seen (make-array n :initial-element nil)) (order '()))
    (dolist (start (stable-sort (loop for i below n collect i) #'<
                                :key (lambda (i) (length (aref neighbours i)))))
      (unless (eq (aref seen start) t)
        (dolist (layer (numerics-layers (numerics-far-unknown start neighbours seen)
                                        neighbours seen t))
          (dolist (i layer) (push i order)))))
    (coerce order '(simple-array (unsigned-byte 32) (*)))))

(defun numerics-places-of (order)
  "Where each unknown stands in ORDER."
  (let ((places (numerics-index-zeros (length order))))
    (dotimes (k (length order) places) (setf (aref places (aref order k)) k))))

(defun numerics-band-widths (pattern order)
  "How far entries stand below and above the diagonal."
  (let ((places (numerics-places-of order)) (columns (numerics-column-numbers pattern))
        (lower 0) (upper 0))
    (loop for i across (numerics-pattern-rows pattern)
          for j across columns
          do (let ((distance (- (aref places i) (aref places j))))
               (setq lower (max lower distance) upper (max upper (- distance)))))
    (values lower upper)))
