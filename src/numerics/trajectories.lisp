;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Trajectories that fill a window, inside masked traps: from seeds far from all others, forwards
;;; and backwards in time, to where they leave the window, close, come to rest or wind on
;;; themselves. Places are in units of the window, from 0 to 1 along each axis; a curve is a list of
;;; places (u v), close enough to look smooth. Look first at numerics-fill-window.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/automatic" "numerics/followed_branch" "numerics/plane"
                "numerics/plane_axes" "numerics/problem"))

(defparameter *numerics-curve-length* 30d0
  "Windows that a trajectory winds through in one direction.")
(defparameter *numerics-curve-spacing* 0.006d0 "Of the points of a curve.")
(defparameter *numerics-curve-margin* 0.02d0 "How far beyond the window a curve goes.")
(defparameter *numerics-curve-steps* 20000)
(defparameter *numerics-near* 2d-4 "Curves that come closer to their start are closed.")
(defparameter *numerics-crowded* 8d-3 "Curves that wind closer on themselves end there.")
(defparameter *numerics-at-rest* 8d-3 "Curves that come closer to an equilibrium end there.")

(defstruct numerics-curve
  points              ; ((u v) ..) in the direction of time
  arrows)             ; ((u v du dv) ..): places and directions

;;; One direction. A trace looks on while a method steps.

(defstruct numerics-trace
  axes rests branch
  visits                    ; cell -> (sense length du dv) of the curve where it came there
  (sense 1d0)               ; -1 backwards in time
  start                     ; (u v)
  last                      ; the last place that was seen
  (points '())              ; those that are kept, newest first
  (length 0d0)
  looked                    ; the place at the last look whether it still moves
  (steps 0)
  end)                      ; why it ended, a keyword

(defun numerics-apart (place other)
  (destructuring-bind ((u v) (s z)) (list place other)
    (sqrt (+ (expt (- u s) 2) (expt (- v z) 2)))))

(defun numerics-inside-p (place &optional (margin 0d0))
  (every (lambda (u) (<= (- margin) u (+ 1d0 margin))) place))

(defun numerics-passes-p (point from to)
  "Whether the way FROM TO passes POINT, in the units of *numerics-near*."
  (destructuring-bind ((u v) (a b) (c d)) (list point from to)
    (let* ((du (- c a)) (dv (- d b)) (square (+ (* du du) (* dv dv)))
           (share (if (zerop square) 0d0 (/ (+ (* (- u a) du) (* (- v b) dv)) square))))
      (and (<= 0 share 1)
           (< (numerics-apart point (list (+ a (* share du)) (+ b (* share dv))))
              *numerics-near*)))))

(defun numerics-keep-point (trace place)
  (push place (numerics-trace-points trace)))

(defun numerics-end-of-trace (trace from to)
  "Why TRACE, which has come FROM TO, ends there, or nil."
  (cond ((not (numerics-inside-p to *numerics-curve-margin*)) :left)
        ((and (> (numerics-trace-length trace) 0.02d0)
              (numerics-passes-p (numerics-trace-start trace) from to))
         :closed)
        ((and (> (numerics-trace-length trace) (* 2 *numerics-at-rest*))
              (some (lambda (rest) (< (numerics-apart rest to) *numerics-at-rest*))
                    (numerics-trace-rests trace)))
         :rest)
        ((numerics-crowded-p trace from to) :crowded)
        ((> (numerics-trace-length trace) *numerics-curve-length*) :long)))

(defun numerics-crowded-p (trace from to)
  "Whether the curve of TRACE has been near TO before, in the same direction; notes that it is
there."
  (when (> (numerics-trace-length trace) (* 3 *numerics-crowded*))
    (let* ((cell (mapcar (lambda (u) (floor u *numerics-crowded*)) to))
           (du (* (numerics-trace-sense trace) (- (first to) (first from))))
           (dv (* (numerics-trace-sense trace) (- (second to) (second from))))
           (before (gethash cell (numerics-trace-visits trace))))
      (if before
          (destructuring-bind (sense length eu ev) before
            (and (or (/= sense (numerics-trace-sense trace))
                     (> (- (numerics-trace-length trace) length) (* 6 *numerics-crowded*)))
                 (> (+ (* du eu) (* dv ev)) 0d0)))
          (progn (setf (gethash cell (numerics-trace-visits trace))
                       (list (numerics-trace-sense trace) (numerics-trace-length trace) du dv))
                 nil)))))

(defun numerics-see-place (trace place)
  "TRACE has come to PLACE; why it ends there, or nil."
  (let ((from (numerics-trace-last trace)))
    (incf (numerics-trace-length trace) (numerics-apart from place))
    (setf (numerics-trace-last trace) place
          (numerics-trace-end trace) (numerics-end-of-trace trace from place))
    (cond ((eq (numerics-trace-end trace) :closed)
           (numerics-keep-point trace (numerics-trace-start trace)))
          ((or (numerics-trace-end trace)
               (> (numerics-apart place (or (first (numerics-trace-points trace))
                                               (numerics-trace-start trace)))
                  (* 0.5d0 *numerics-curve-spacing*)))
           (numerics-keep-point trace place)))
    (numerics-trace-end trace)))

(defun numerics-place-of (trace state)
  (mapcar #'numerics-place (numerics-trace-axes trace) (coerce state 'list)))

(defun numerics-stands-p (trace)
  "Whether TRACE has hardly moved in the last hundred steps."
  (when (zerop (mod (incf (numerics-trace-steps trace)) 100))
    (let ((before (numerics-trace-looked trace)) (now (numerics-trace-last trace)))
      (setf (numerics-trace-looked trace) now)
      (< (numerics-apart before now) *numerics-near*))))

(defun numerics-pieces (trace step state)
  "In how many pieces STEP is looked at; STATE is changed."
  (funcall (numerics-step-interpolate step) 0.5d0 state)
  (let* ((middle (numerics-place-of trace state))
         (way (+ (numerics-apart (numerics-trace-last trace) middle)
                 (numerics-apart middle (numerics-place-of trace (numerics-step-after step))))))
    (if (< way 1d2) (max 4 (ceiling way *numerics-curve-spacing*)) 4)))

(defun numerics-off-branch-p (trace step)
  (let ((branch (numerics-trace-branch trace)))
    (and branch (not (numerics-on-branch-p branch (numerics-step-after step))))))

(defun numerics-see-trace (trace step state)
  "An observer's answer to STEP; STATE is changed."
  (when (numerics-off-branch-p trace step) (return-from numerics-see-trace :stop))
  (loop with pieces = (numerics-pieces trace step state)
        for k from 1 to pieces
        do (funcall (numerics-step-interpolate step) (/ (coerce k 'double-float) pieces) state)
           (when (numerics-see-place trace (numerics-place-of trace state))
             (return-from numerics-see-trace :stop)))
  (when (numerics-stands-p trace) :stop))

(defun numerics-curve-controls (plane speed)
  "Controls of a trajectory that begins with SPEED, in windows per unit of time."
  (make-numerics-controls
   :end (/ 1d6 speed) :most-steps *numerics-curve-steps*
   :scales (coerce (append (mapcar #'numerics-axis-width (numerics-plane-axes plane))
                           (and (numerics-plane-branch plane)
                                (numerics-branch-scales (numerics-plane-branch plane))))
                   'numerics-vector)))

(defun numerics-trace-from (plane sense place rests visits)
  "The trace in PLANE from PLACE, forwards in time or, where SENSE is -1, backwards; nil where that
stands still."
  (let* ((axes (numerics-plane-axes plane)) (speed (numerics-speed plane place))
         (trace (make-numerics-trace :axes axes :rests rests :start place :last place :looked place
                                     :visits visits :sense sense
                                     :branch (numerics-plane-branch plane)))
         (state (apply #'numerics-state-over plane (mapcar #'numerics-at-place axes place)))
         (scratch (and state (copy-seq state))))
    (when (and (numerics-finite-p speed) (> speed 0d0) (numerics-finite-p (/ 1d6 speed)))
      (numerics-automatic (if (plusp sense)
                              (numerics-plane-forwards plane)
                              (numerics-plane-backwards plane))
                          (numerics-curve-controls plane speed) (numerics-moment 0d0)
                          state
                          (lambda (step) (numerics-see-trace trace step scratch)))
      trace)))

(defun numerics-speed (plane place)
  (multiple-value-bind (du dv) (numerics-slope-at-place plane place)
    (sqrt (+ (* du du) (* dv dv)))))

(defun numerics-slope-at-place (plane place)
  (multiple-value-call #'numerics-slope-at plane
    (values-list (mapcar #'numerics-at-place (numerics-plane-axes plane) place))))

;;; Both directions

(defun numerics-new-visits () (make-hash-table :test #'equal))

(defun numerics-curve-through (plane place rests)
  "The curve through PLACE, or nil."
  (let* ((visits (numerics-new-visits))
         (forwards (numerics-trace-from plane 1d0 place rests visits)))
    (when forwards
      (let ((backwards (unless (eq (numerics-trace-end forwards) :closed)
                         (numerics-trace-from plane -1d0 place rests visits))))
        (make-numerics-curve
         :points (append (and backwards (numerics-trace-points backwards)) (list place)
                         (reverse (numerics-trace-points forwards)))
         :arrows (list (numerics-arrow-at plane place)))))))

(defun numerics-arrow-at (plane place)
  "(u v du dv): PLACE, and the direction of the trajectory there, of length 1."
  (multiple-value-bind (du dv) (numerics-slope-at-place plane place)
    (let ((speed (sqrt (+ (* du du) (* dv dv)))))
      (append place (if (> speed 0d0) (list (/ du speed) (/ dv speed)) (list 0d0 0d0))))))

;;; The net: where no curve is near, a seed is put where the nearest one is farthest (A. Mebarki,
;;; P. Alliez, O. Devillers, Farthest point seeding for efficient placement of streamlines, IEEE
;;; Visualization 2005). Distances are those of a king with dear diagonals, in cells.

(defparameter *numerics-cells* 40 "Cells of the net along an axis.")
(defparameter *numerics-separation* 0.065d0 "A seed is that far from all curves, in windows.")

(defun numerics-new-net ()
  (make-array (list *numerics-cells* *numerics-cells*) :initial-element nil))

(defun numerics-mark-cells (net places)
  "Marks the cells of NET in which PLACES lie."
  (dolist (place places)
    (when (numerics-inside-p place)
      (destructuring-bind (i j)
          (mapcar (lambda (u) (min (1- *numerics-cells*) (floor (* u *numerics-cells*)))) place)
        (setf (aref net i j) t)))))

(defun numerics-near-cells (forwards)
  "((i j distance) ..) of the neighbours that a pass FORWARDS over the net has been to."
  (let ((sign (if forwards 1 -1)))
    (loop for (i j distance) in '((-1 -1 1.4d0) (-1 0 1d0) (-1 1 1.4d0) (0 -1 1d0))
          collect (list (* sign i) (* sign j) distance))))

(defun numerics-pass-over (distances forwards)
  "Each cell of DISTANCES is no farther than its neighbours before it say."
  (let ((last (1- *numerics-cells*)) (near (numerics-near-cells forwards)))
    (flet ((order (k) (if forwards k (- last k))))
      (loop for p to last
            for i = (order p)
            do (loop for q to last
                     for j = (order q)
                     do (loop for (di dj distance) in near
                              for a = (+ i di)
                              for b = (+ j dj)
                              when (and (<= 0 a last) (<= 0 b last))
                                do (setf (aref distances i j)
                                         (min (aref distances i j)
                                              (+ distance (aref distances a b))))))))))

(defun numerics-edge-distance (i j)
  (* 2d0 (+ 0.5d0 (min i j (- *numerics-cells* 1 i) (- *numerics-cells* 1 j)))))

(defun numerics-farthest-cell (net)
  "The cell that is farthest from those marked in NET and from the edge, (i j), and its distance."
  (let ((distances (make-array (array-dimensions net))) (best nil) (farthest 0d0))
    (dotimes (i *numerics-cells*)
      (dotimes (j *numerics-cells*)
        (setf (aref distances i j) (if (aref net i j) 0d0 (numerics-edge-distance i j)))))
    (numerics-pass-over distances t)
    (numerics-pass-over distances nil)
    (dotimes (i *numerics-cells* (values best farthest))
      (dotimes (j *numerics-cells*)
        (when (> (aref distances i j) farthest)
          (setq best (list i j) farthest (aref distances i j)))))))

(defun numerics-cell-middle (cell)
  (mapcar (lambda (k) (/ (+ k 0.5d0) *numerics-cells*)) cell))

(defun numerics-fill-window (plane curves rests)
  "Curves of PLANE that fill the window beside CURVES; RESTS are places of equilibria."
  (let ((net (numerics-new-net)))
    (numerics-mark-cells net rests)
    (dolist (curve curves) (numerics-mark-cells net (numerics-curve-points curve)))
    (loop with found = '()
          for (cell distance) = (multiple-value-list (numerics-farthest-cell net))
          while (and cell (>= distance (* *numerics-separation* *numerics-cells*)))
          do (let ((curve (numerics-curve-through plane (numerics-cell-middle cell) rests)))
               (core-progress "~d trajector~:@p" (length found))
               (setf (aref net (first cell) (second cell)) t)
               (when curve
                 (numerics-mark-cells net (numerics-curve-points curve))
                 (push curve found)))
          finally (return (reverse found)))))
