;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Back to the constraints after a step: with the coordinates q, the velocities v = q', the mass
;;; matrix M, constraints Phi(t, q) = 0 and G v + b(t, q) = 0 (the rates of Phi, then those that are
;;; linear in the velocities alone), the least change of q and then of v, measured by M, is
;;;     change = D f,   G D f = -residual,   D = M^-1 G^T,
;;; made twice, as Newton's method does (E. Hairer, G. Wanner, Solving Ordinary Differential
;;; Equations II, section VII.2). A constraint that follows from others is left out and named.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/small_systems"))

(defstruct numerics-constraints
  "The states are (q, v), of equal length. VALUES and RATES give (moment x out): Phi, and G v + b;
MATRIX gives G by rows, those of Phi first; DIRECTIONS, nil where they are these, D by columns."
  (size 0 :type fixnum)                                ; of q
  (holonomic 0 :type fixnum)                           ; how many bind coordinates
  (count 0 :type fixnum)                               ; all
  values rates matrix directions
  names                                                ; Maxima expressions
  kept                                                 ; places of those that are not redundant
  system                                               ; numerics-small-system
  (rows (numerics-zeros 0) :type numerics-vector)      ; G
  (columns (numerics-zeros 0) :type numerics-vector)   ; D
  (residuals (numerics-zeros 0) :type numerics-vector)
  (singular nil)                                       ; the moment at which a projection failed
  (largest 0d0 :type double-float))                    ; residual after projections so far

(defun numerics-new-constraints (names holonomic values rates matrix directions)
  "The constraints NAMES, of which the first HOLONOMIC bind coordinates."
  (let ((count (length names)))
    (make-numerics-constraints
     :count count :holonomic holonomic :names names
     :values values :rates rates :matrix matrix :directions directions
     :kept (loop for i below count collect i)
     :system (numerics-new-small-system count) :residuals (numerics-zeros count))))

(defun numerics-make-room (constraints x)
  "Vectors for the matrices of CONSTRAINTS of states such as X."
  (let ((size (floor (length x) 2)))
    (unless (= size (numerics-constraints-size constraints))
      (setf (numerics-constraints-size constraints) size
            (numerics-constraints-rows constraints)
            (numerics-zeros (* size (numerics-constraints-count constraints)))
            (numerics-constraints-columns constraints)
            (if (numerics-constraints-directions constraints)
                (numerics-zeros (* size (numerics-constraints-count constraints)))
                (numerics-constraints-rows constraints))))))

(defun numerics-redundant-constraints (constraints moment x)
  "The names of those that follow from the ones before them at X; they are left out from now on."
  (numerics-make-room constraints x)
  (let ((rows (numerics-constraints-rows constraints)))
    (funcall (numerics-constraints-matrix constraints) moment x rows)
    (setf (numerics-constraints-kept constraints)
          (numerics-independent-rows rows (numerics-constraints-count constraints)
                                     (numerics-constraints-size constraints)))
    (loop for name in (numerics-constraints-names constraints)
          for i from 0
          unless (member i (numerics-constraints-kept constraints)) collect name)))

;;; A step of Newton's method

(defun numerics-kept-coordinates (constraints)
  "Those kept of the constraints of coordinates."
  (remove-if (lambda (i) (>= i (numerics-constraints-holonomic constraints)))
             (numerics-constraints-kept constraints)))

(defun numerics-change-states (constraints moment x kept start)
  "Changes the states from the place START on so that the residuals KEPT vanish; nil where the
system is singular."
  (let* ((system (numerics-constraints-system constraints))
         (size (numerics-constraints-size constraints))
         (rows (numerics-constraints-rows constraints))
         (columns (numerics-constraints-columns constraints))
         (residuals (numerics-constraints-residuals constraints))
         (directions (numerics-constraints-directions constraints)))
    (funcall (numerics-constraints-matrix constraints) moment x rows)
    (when directions (funcall directions moment x columns))
    (numerics-set-products system rows columns size kept)
    (loop for i in kept
          for place from 0
          do (setf (aref (numerics-small-system-right system) place) (- (aref residuals i))))
    (let ((forces (numerics-solve-small-system system)))
      (when forces
        (loop for i in kept
              for place from 0
              do (numerics-move-states x start (aref forces place) columns (* i size) size))
        t))))

(defun numerics-move-states (x start factor columns from size)
  "Adds FACTOR times the column that begins at FROM to X from START on."
  (declare (type numerics-vector x columns) (double-float factor) (fixnum start from size))
  (dotimes (k size)
    (incf (aref x (+ start k)) (* factor (aref columns (+ from k))))))

(defun numerics-residuals (constraints function moment x kept)
  "The largest of the residuals KEPT, which FUNCTION gives."
  (let ((residuals (numerics-constraints-residuals constraints)))
    (funcall function moment x residuals)
    (loop for i in kept maximize (abs (aref residuals i)))))

(defun numerics-newton-twice (constraints function moment x kept start)
  "Two steps of Newton's method; the largest residual after them, or nil where they failed."
  (if (null kept)
      0d0
      (loop repeat 2
            do (numerics-residuals constraints function moment x kept)
            unless (numerics-change-states constraints moment x kept start)
              do (return nil)
            finally (return (numerics-residuals constraints function moment x kept)))))

(defun numerics-project (constraints moment x)
  "Brings the state X back to CONSTRAINTS, in place; the largest residual that is left, or nil where
they are dependent there."
  (numerics-make-room constraints x)
  (let* ((places (numerics-newton-twice
                  constraints (numerics-constraints-values constraints) moment x
                  (numerics-kept-coordinates constraints) 0))
         (speeds (and places
                      (numerics-newton-twice
                       constraints (numerics-constraints-rates constraints) moment x
                       (numerics-constraints-kept constraints)
                       (numerics-constraints-size constraints)))))
    (and speeds (max places speeds))))

(defun numerics-projection-part (constraints)
  "A part of an observer: projects the state after each step, keeps the largest residual, and stops
where the constraints are dependent."
  (lambda (step)
    (let ((left (numerics-project constraints (numerics-step-to step) (numerics-step-after step))))
      (cond (left (setf (numerics-constraints-largest constraints)
                        (max left (numerics-constraints-largest constraints)))
                  :changed)
            (t (setf (numerics-constraints-singular constraints)
                     (copy-seq (numerics-step-to step)))
               :stop)))))
