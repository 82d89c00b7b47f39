;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The matrices that implicit methods solve with: s*M - J with a number s, real or complex, a
;;; constant sparse mass matrix M (or the identity) and a sparse Jacobian J. Where each entry
;;; stands in the storage of a solver is found once; after that a matrix is made by two sweeps
;;; over the entries.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"))

(defun numerics-index-zeros (n)
  (make-array n :element-type '(unsigned-byte 32) :initial-element 0))

(defstruct numerics-solver
  kind                   ; :dense, :banded or :klu
  (size 0 :type fixnum)
  complex                ; whether s has an imaginary part
  (shift 1d0 :type double-float)
  (shift-imaginary 0d0 :type double-float)
  ;; Storage. The imaginary part of an entry stands at its place + imaginary-offset.
  (real (numerics-zeros 0) :type (simple-array double-float (*)))
  (imaginary (numerics-zeros 0) :type (simple-array double-float (*)))
  (imaginary-offset 0 :type fixnum)
  (pattern nil)          ; of M and J together
  (places (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*))) ; of its entries,
  (rows (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*)))   ; their rows
  (columns (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*))) ; and columns
  (jacobian-places (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*)))
  (mass-places (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*)))
  (mass (numerics-zeros 0) :type (simple-array double-float (*)))
  ;; For the elimination.
  (row-scales (numerics-zeros 0) :type (simple-array double-float (*)))       ; see below
  (column-scales (numerics-zeros 0) :type (simple-array double-float (*)))
  (pivots (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*)))
  (order (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*))) ; place -> unknown
  (work (numerics-zeros 0) :type (simple-array double-float (*)))
  (work-imaginary (numerics-zeros 0) :type (simple-array double-float (*)))
  (lower 0 :type fixnum)  ; widths of the band
  (upper 0 :type fixnum)
  (stride 0 :type fixnum) ; entry (i, j) stands at i + j*stride + offset
  (offset 0 :type fixnum)
  (klu nil)               ; what the library holds
  (singular-row nil)          ; nil where it is not known
  (singular-column 0 :type fixnum))

;;; Patterns.

(defun numerics-pattern-of-columns (columns)
  "The pattern whose column j has the increasing rows of the list number j of COLUMNS, a vector."
  (let* ((n (length columns)) (starts (numerics-index-zeros (1+ n)))
         (rows (numerics-index-zeros (reduce #'+ (map 'list #'length columns)))) (k 0))
    (dotimes (j n)
      (setf (aref starts j) k)
      (dolist (row (aref columns j))
        (setf (aref rows k) row)
        (incf k)))
    (setf (aref starts n) k)
    (make-numerics-pattern :size n :starts starts :rows rows)))

(defun numerics-full-pattern (n)
  (numerics-pattern-of-columns
   (make-array n :initial-element (loop for i below n collect i))))

(defun numerics-identity (n)
  (let ((columns (make-array n)))
    (dotimes (j n) (setf (aref columns j) (list j)))
    (make-numerics-matrix :pattern (numerics-pattern-of-columns columns)
                          :values (make-array n :element-type 'double-float
                                                :initial-element 1d0))))

(defun numerics-column-rows (pattern j)
  (loop for k from (aref (numerics-pattern-starts pattern) j)
          below (aref (numerics-pattern-starts pattern) (1+ j))
        collect (aref (numerics-pattern-rows pattern) k)))

(defun numerics-united-pattern (one other)
  (let ((columns (make-array (numerics-pattern-size one))))
    (dotimes (j (length columns) (numerics-pattern-of-columns columns))
      (setf (aref columns j)
            (numerics-without-repeats
             (merge 'list (numerics-column-rows one j) (numerics-column-rows other j) #'<))))))

(defun numerics-without-repeats (numbers)
  "NUMBERS, which do not decrease, each once."
  (loop for (number . more) on numbers
        unless (eql number (car more)) collect number))

(defun numerics-entries-within (pattern whole)
  "Which entries of WHOLE those of PATTERN are."
  (let ((found (numerics-index-zeros (length (numerics-pattern-rows pattern)))))
    (dotimes (j (numerics-pattern-size pattern) found)
      (let ((k (aref (numerics-pattern-starts whole) j)))
        (loop for p from (aref (numerics-pattern-starts pattern) j)
                below (aref (numerics-pattern-starts pattern) (1+ j))
              do (loop until (= (aref (numerics-pattern-rows whole) k)
                                (aref (numerics-pattern-rows pattern) p))
                       do (incf k))
                 (setf (aref found p) k))))))

(defun numerics-column-numbers (pattern)
  "The column of each entry."
  (let ((columns (numerics-index-zeros (length (numerics-pattern-rows pattern)))))
    (dotimes (j (numerics-pattern-size pattern) columns)
      (fill columns j :start (aref (numerics-pattern-starts pattern) j)
                      :end (aref (numerics-pattern-starts pattern) (1+ j))))))

;;; Making the matrix.

(defun numerics-place-entries (solver jacobian-pattern mass place)
  "PLACE: function of row and column, and of the number of an entry, to where it stands."
  (let* ((pattern (numerics-solver-pattern solver)) (columns (numerics-column-numbers pattern))
         (places (numerics-index-zeros (length columns))))
    (flet ((within (part)
             (map '(simple-array (unsigned-byte 32) (*)) (lambda (k) (aref places k))
                  (numerics-entries-within part pattern))))
      (dotimes (k (length columns))
        (setf (aref places k)
              (funcall place (aref (numerics-pattern-rows pattern) k) (aref columns k) k)))
      (setf (numerics-solver-places solver) places
            (numerics-solver-jacobian-places solver) (within jacobian-pattern)
            (numerics-solver-mass-places solver) (within (numerics-matrix-pattern mass))
            (numerics-solver-mass solver) (numerics-matrix-values mass))
      solver)))

(defun numerics-assemble (solver jacobian)
  "s*M - J into the storage; JACOBIAN: the entries of J."
  (declare (type numerics-vector jacobian) (optimize speed))
  (let ((real (numerics-solver-real solver)) (imaginary (numerics-solver-imaginary solver))
        (offset (numerics-solver-imaginary-offset solver))
        (shift (numerics-solver-shift solver))
        (shift-imaginary (numerics-solver-shift-imaginary solver))
        (mass (numerics-solver-mass solver)) (mass-places (numerics-solver-mass-places solver))
        (jacobian-places (numerics-solver-jacobian-places solver)))
    (declare (type (integer 0 1) offset))
    (fill real 0d0)
    (when (numerics-solver-complex solver)
      (fill imaginary 0d0)
      (dotimes (k (length mass))
        (setf (aref imaginary (+ (aref mass-places k) offset))
              (* shift-imaginary (aref mass k)))))
    (dotimes (k (length mass))
      (setf (aref real (aref mass-places k)) (* shift (aref mass k))))
    (dotimes (k (length jacobian-places) solver)
      (decf (aref real (aref jacobian-places k)) (aref jacobian k)))))
