;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Dead points of a mechanism: where gradients of its constraints depend on each other the motion
;;; may go on in several ways (a parallelogram may fold into an antiparallelogram), and a step goes
;;; over such a place as over any other. So how far each gradient stands off the span of those
;;; before it, over the greatest length that it had, is looked at after each step, and between its
;;; ends where gradients turn much in it or that distance is small. What lies nearer to a dead
;;; point than a few tolerances is not told from it. See numerics-dead-share first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/back_to_constraints"
                "numerics/problem" "numerics/small_systems" "numerics/zeros_between"))

(defstruct numerics-dead-points
  constraints least         ; what is less than LEAST is a dead point
  greatest                  ; list: the greatest lengths of the gradients
  (distance 1d0)            ; after the last step
  before                    ; the gradients then
  moment state)

(defun numerics-new-dead-points (constraints relative moment state)
  (numerics-make-room constraints state)
  (let ((dead (make-numerics-dead-points
               :constraints constraints :least (min 1d-3 (* 1d3 relative))
               :moment (copy-seq moment) :state (copy-seq state)
               :greatest (loop repeat (numerics-constraints-count constraints) collect 0d0))))
    (setf (numerics-dead-points-distance dead) (numerics-dead-distance dead moment state)
          (numerics-dead-points-before dead) (copy-seq (numerics-constraints-rows constraints)))
    dead))

(defun numerics-dead-distance (dead moment state)
  "The least distance of a gradient from the span of those before it."
  (let* ((constraints (numerics-dead-points-constraints dead))
         (rows (numerics-constraints-rows constraints)))
    (funcall (the function (numerics-constraints-matrix constraints)) moment state rows)
    (let ((rests (numerics-row-rests rows (numerics-constraints-count constraints)
                                     (numerics-constraints-size constraints))))
      (setf (numerics-dead-points-greatest dead)
            (loop for (nil . whole) in rests
                  for greatest in (numerics-dead-points-greatest dead)
                  collect (max whole greatest)))
      (loop for i in (numerics-constraints-kept constraints)
            minimize (/ (car (nth i rests))
                        (max (nth i (numerics-dead-points-greatest dead))
                             least-positive-normalized-double-float))))))

(defun numerics-dead-distance-at (dead step share)
  (let ((moment (numerics-dead-points-moment dead)) (state (numerics-dead-points-state dead)))
    (numerics-step-moment step share moment)
    (numerics-step-state step share state)
    (numerics-dead-distance dead moment state)))

(defparameter *numerics-dead-shares* '(0.015625d0 0.25d0 0.5d0 0.75d0 0.984375d0)
  "Where a step is looked at between its ends.")

(defun numerics-dead-share (dead step)
  "The share of STEP where a dead point is, or nil."
  (let* ((first (numerics-dead-points-distance dead))
         (last (numerics-dead-distance-at dead step 1d0))
         (quiet (and (> (min first last) 0.3d0) (numerics-hardly-turned-p dead))))
    (setf (numerics-dead-points-distance dead) last)
    (replace (numerics-dead-points-before dead)
             (numerics-constraints-rows (numerics-dead-points-constraints dead)))
    (or (and (not quiet) (numerics-dead-share-within dead step first last))
        (and (< last (numerics-dead-points-least dead)) 1d0))))

(defun numerics-hardly-turned-p (dead)
  "Whether each gradient has turned by 20 degrees at most since the last step."
  (let* ((constraints (numerics-dead-points-constraints dead))
         (rows (numerics-constraints-rows constraints)) (before (numerics-dead-points-before dead))
         (size (numerics-constraints-size constraints)))
    (flet ((product (a b from) (loop for k from from repeat size sum (* (aref a k) (aref b k)))))
      (loop for i below (numerics-constraints-count constraints)
            for from = (* i size)
            always (>= (product rows before from)
                       (* 0.94d0 (sqrt (* (product rows rows from)
                                          (product before before from)))))))))

(defun numerics-dead-share-within (dead step first last)
  "The same, FIRST and LAST being the distances at both ends: between looks where one is the least."
  (loop for (before here after)
          on (append (list (cons 0d0 first))
                     (loop for share in *numerics-dead-shares*
                           collect (cons share (numerics-dead-distance-at dead step share)))
                     (list (cons 1d0 last)))
        while after
        when (and (< (cdr here) (cdr before)) (<= (cdr here) (cdr after)))
          do (let ((share (numerics-dead-share-between dead step (car before) (car after))))
               (when share (return share)))))

(defun numerics-dead-share-between (dead step from to)
  (let* ((least (numerics-dead-points-least dead))
         (depth (lambda (share) (- (numerics-dead-distance-at dead step share) least)))
         (share (numerics-least depth from to)))
    (and (< (funcall depth share) 0) share)))

(defun numerics-dead-point-part (dead found)
  "A part of an observer that calls FOUND with the time and ends the run before a step to a dead
point or over one."
  (lambda (step)
    (let ((share (numerics-dead-share dead step)) (moment (numerics-dead-points-moment dead)))
      (when share
        (numerics-step-moment step share moment)
        (funcall found (aref moment 0))
        (numerics-undo-step step)
        :stop))))
