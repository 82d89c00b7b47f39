;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Systems (s*M - J) x = b of implicit methods. By size and pattern: KLU above 200 unknowns where
;;; it is installed; else elimination in the band that reverse Cuthill-McKee leaves, where that is
;;; cheaper; else in the full matrix.
;;;     (numerics-make-solver n pattern mass :complex nil) -> solver
;;;     (numerics-factor solver entries-of-J)   with the slots shift, shift-imaginary set before;
;;;             true where singular: singular-column follows from the others, so does singular-row
;;;     (numerics-solve solver x [y])           in place, y the imaginary parts
;;;     (numerics-release-solver solver)        at the end

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/linear_solver_matrix" "numerics/linear_solver_order"
                "numerics/linear_solver_scales" "numerics/linear_solver_elimination"
                "numerics/linear_solver_klu"
                "numerics/sparse"))

(defparameter *numerics-most-without-klu* 200
  "Unknowns of a sparse system that KLU is not asked for.")
(defparameter *numerics-most-entries* 25000000 "Of a matrix in our own storage.")

(defun numerics-band-pays-p (n lower upper)
  "Whether the elimination within the band costs less than half of the full one."
  (< (* 2 n (1+ lower) (+ 1 lower upper)) (/ (expt n 3) 6)))

(defun numerics-large-and-sparse-p (pattern)
  (let ((n (numerics-pattern-size pattern)) (entries (length (numerics-pattern-rows pattern))))
    (and (> n *numerics-most-without-klu*) (< entries (/ (* n n) 10)))))

(defun numerics-solver-kind-for (pattern order)
  (multiple-value-bind (lower upper) (numerics-band-widths pattern order)
    (cond ((and (numerics-large-and-sparse-p pattern) (numerics-find-klu)) :klu)
          ((numerics-band-pays-p (numerics-pattern-size pattern) lower upper) :banded)
          (t :dense))))

(defun numerics-solver-remark (solver)
  "A sentence where KLU, which is not there, would take less; or nil."
  (let ((width (+ 1 (numerics-solver-lower solver) (numerics-solver-upper solver))))
    (when (and (numerics-large-and-sparse-p (numerics-solver-pattern solver)) (> width 20)
               (null (numerics-find-klu)))
      (format nil "the systems of ~d equations are solved ~:[by full~;within a band of ~d, by~] ~
                   elimination; SBCL with the library KLU (package libklu1 or libklu2) is faster"
              (numerics-solver-size solver) (eq (numerics-solver-kind solver) :banded) width))))

(defun numerics-make-solver (n pattern mass &key complex kind)
  "PATTERN of the Jacobian, nil for a full one; MASS a numerics-matrix, nil for the identity; KIND
nil where it is chosen here."
  (let* ((pattern (or pattern (numerics-full-pattern n)))
         (mass (or mass (numerics-identity n)))
         (whole (numerics-united-pattern pattern (numerics-matrix-pattern mass)))
         (order (numerics-band-order whole))
         (solver (make-numerics-solver :kind (or kind (numerics-solver-kind-for whole order))
                                       :size n :complex complex :pattern whole)))
    (ecase (numerics-solver-kind solver)
      (:klu (numerics-make-sparse solver pattern mass))
      (:banded (multiple-value-bind (lower upper) (numerics-band-widths whole order)
                 (numerics-make-banded solver order lower upper)
                 (numerics-make-own solver pattern mass)))
      (:dense (numerics-make-banded solver (numerics-natural-order n) (1- n) 0)
       (numerics-make-own solver pattern mass)))))

(defun numerics-natural-order (n)
  (let ((order (numerics-index-zeros n)))
    (dotimes (i n order) (setf (aref order i) i))))

(defun numerics-make-banded (solver order lower upper)
  (let* ((n (numerics-solver-size solver)) (full (= lower (1- n))))
    (setf (numerics-solver-order solver) order
          (numerics-solver-lower solver) lower
          (numerics-solver-upper solver) upper
          (numerics-solver-stride solver) (if full n (+ (* 2 lower) upper))
          (numerics-solver-offset solver) (if full 0 (+ lower upper)))))

(defun numerics-make-own (solver pattern mass)
  "The storage of our own elimination."
  (let* ((n (numerics-solver-size solver)) (stride (numerics-solver-stride solver))
         (offset (numerics-solver-offset solver))
         (entries (+ (* n stride) n offset 1))
         (unknown-places (numerics-places-of (numerics-solver-order solver)))
         (whole (numerics-solver-pattern solver)))
    (when (> entries *numerics-most-entries*)
      (core-error "a matrix of ~d rows, with entries far from its diagonal, needs sparse ~
                   elimination; install the library KLU (package libklu1 or libklu2)"
                  n))
    (flet ((vector-of (count) (numerics-zeros count))
           (moved (numbers)
             (map '(simple-array (unsigned-byte 32) (*)) (lambda (i) (aref unknown-places i))
                  numbers)))
      (setf (numerics-solver-real solver) (vector-of entries)
            (numerics-solver-imaginary solver)
            (vector-of (if (numerics-solver-complex solver) entries 0))
            (numerics-solver-rows solver) (moved (numerics-pattern-rows whole))
            (numerics-solver-columns solver) (moved (numerics-column-numbers whole))
            (numerics-solver-row-scales solver) (vector-of n)
            (numerics-solver-column-scales solver) (vector-of n)
            (numerics-solver-pivots solver) (numerics-index-zeros n)
            (numerics-solver-work solver) (vector-of n)
            (numerics-solver-work-imaginary solver) (vector-of n)))
    (numerics-place-entries solver pattern mass
                            (lambda (i j k)
                              (declare (ignore k))
                              (+ (aref unknown-places i) (* stride (aref unknown-places j))
                                 offset)))))

(defun numerics-make-sparse (solver pattern mass)
  (let* ((count (length (numerics-pattern-rows (numerics-solver-pattern solver))))
         (complex (numerics-solver-complex solver))
         (storage (numerics-zeros (if complex (* 2 count) count))))
    (setf (numerics-solver-real solver) storage
          (numerics-solver-imaginary solver) storage
          (numerics-solver-imaginary-offset solver) (if complex 1 0)
          (numerics-solver-work solver)
          (numerics-zeros (if complex (* 2 (numerics-solver-size solver)) 0)))
    (numerics-place-entries solver pattern mass
                            (lambda (i j k) (declare (ignore i j)) (if complex (* 2 k) k)))
    (numerics-analyse-by-klu solver)))

;;; Use.

(defun numerics-factor (solver jacobian)
  "Factors of shift*M - J; true where this is singular."
  (numerics-assemble solver jacobian)
  (cond ((eq (numerics-solver-kind solver) :klu) (numerics-factor-by-klu solver))
        (t (numerics-unit-scales solver)
           (and (numerics-eliminate-measured solver)
                (progn (numerics-assemble solver jacobian)
                       (numerics-balance-columns solver)
                       (numerics-eliminate-measured solver))
                (numerics-find-singular-row solver jacobian)))))

(defun numerics-eliminate-measured (solver)
  (numerics-measure-entries solver)
  (if (numerics-solver-complex solver)
      (numerics-eliminate-complex solver)
      (numerics-eliminate solver)))

(defun numerics-find-singular-row (solver jacobian)
  "Notes a row of a real matrix that follows from the others. True."
  (numerics-assemble solver jacobian)
  (let* ((places (numerics-solver-places solver)) (values (numerics-zeros (length places)))
         (real (numerics-solver-real solver)))
    (map-into values (lambda (place) (aref real place)) places)
    (let ((combination (first (numerics-null-vectors
                               (make-numerics-matrix :pattern (numerics-solver-pattern solver)
                                                     :values values)
                               nil))))
      (setf (numerics-solver-singular-row solver)
            (and combination (not (numerics-solver-complex solver))
                 (car (numerics-largest-entry combination))))
      t)))

(defun numerics-orientation (solver)
  "The sign of the determinant of the factored real matrix; nil where it is not known."
  (if (eq (numerics-solver-kind solver) :klu) nil (numerics-determinant-sign solver)))

(defun numerics-solve (solver x &optional y)
  "X, and its imaginary part Y, become the solution for this right side."
  (ecase (numerics-solver-kind solver)
    (:klu (if y (numerics-solve-complex-by-klu solver x y) (numerics-solve-by-klu solver x)))
    (:dense (if y (numerics-substitute-complex solver x y) (numerics-substitute solver x)))
    (:banded
     (let ((order (numerics-solver-order solver)) (u (numerics-solver-work solver))
           (v (numerics-solver-work-imaginary solver)))
       (numerics-gather x order u)
       (cond (y (numerics-gather y order v)
                (numerics-substitute-complex solver u v)
                (numerics-put-in-order v order y))
             (t (numerics-substitute solver u)))
       (numerics-put-in-order u order x)))))

(defun numerics-gather (x order y)
  (declare (type numerics-vector x y) (type numerics-indices order) (optimize speed))
  (dotimes (k (length order)) (setf (aref y k) (aref x (aref order k)))))

(defun numerics-put-in-order (x order y)
  (declare (type numerics-vector x y) (type numerics-indices order) (optimize speed))
  (dotimes (k (length order)) (setf (aref y (aref order k)) (aref x k))))

(defun numerics-release-solver (solver)
  (when (numerics-solver-klu solver) (numerics-release-klu solver)))
