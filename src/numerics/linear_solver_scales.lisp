;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; When a pivot is nothing but rounding, where equations and unknowns have units of their own: a
;;; pivot is the largest entry of its column where each row is divided by its largest entry; and
;;; where each column is divided by its largest one then, a pivot that is not above rounding is
;;; none. Units of unknowns may mislead that. So before a matrix is called singular, its columns
;;; are balanced first: the logarithms of its entries are brought near to 0 (Curtis & Reid, J.
;;; Inst. Maths Applics 10, 1972), and the elimination is done again.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/linear_solver_matrix"))

(defmacro numerics-with-entries ((solver) &body body)
  "BODY with the scales, and (entries (i j magnitude) ..) for all entries of the matrix."
  `(let ((real (numerics-solver-real ,solver)) (imaginary (numerics-solver-imaginary ,solver))
         (complex (numerics-solver-complex ,solver)) (places (numerics-solver-places ,solver))
         (rows (numerics-solver-rows ,solver)) (columns (numerics-solver-columns ,solver))
         (row-scales (numerics-solver-row-scales ,solver))
         (column-scales (numerics-solver-column-scales ,solver)))
     (macrolet ((entries ((i j magnitude) &body body)
                  `(dotimes (k (length places))
                     (let* ((place (aref places k)) (,i (aref rows k)) (,j (aref columns k))
                            (,magnitude (abs (aref real place))))
                       (declare (double-float ,magnitude) (ignorable ,i ,j))
                       (when complex (incf ,magnitude (abs (aref imaginary place))))
                       ,@body))))
       ,@body)))

(defun numerics-invert-sizes (sizes)
  (declare (type numerics-vector sizes) (optimize speed))
  (dotimes (i (length sizes))
    (when (> (aref sizes i) 1d-300) (setf (aref sizes i) (/ (aref sizes i))))))

(defun numerics-measure-entries (solver)
  "What the rows, and then the columns, are multiplied with; columns have been already, by their
scales."
  (declare (optimize speed))
  (numerics-with-entries (solver)
    (fill row-scales 0d0)
    (entries (i j magnitude)
      (let ((scaled (* magnitude (aref column-scales j))))
        (when (> scaled (aref row-scales i)) (setf (aref row-scales i) scaled))))
    (numerics-invert-sizes row-scales)
    (fill column-scales 0d0)
    (entries (i j magnitude)
      (let ((scaled (* magnitude (aref row-scales i))))
        (when (> scaled (aref column-scales j)) (setf (aref column-scales j) scaled))))
    (numerics-invert-sizes column-scales)
    solver))

(defun numerics-unit-scales (solver)
  (fill (numerics-solver-column-scales solver) 1d0))

(defun numerics-balance-columns (solver)
  "Scales of the columns, by ten sweeps that make the mean logarithm in each row and column 0."
  (numerics-with-entries (solver)
    (let ((counts (numerics-zeros (length row-scales))))
      (fill row-scales 0d0)
      (fill column-scales 0d0)
      (flet ((sweep (scales others of-row)
               (let ((sums (numerics-zeros (length scales))))
                 (fill counts 0d0)
                 (entries (i j magnitude)
                   (when (< 0d0 magnitude most-positive-double-float)
                     (let ((here (if of-row i j)) (there (if of-row j i)))
                       (incf (aref counts here))
                       (decf (aref sums here) (+ (log magnitude) (aref others there))))))
                 (map-into scales (lambda (sum count) (/ sum (max count 1d0))) sums counts))))
        (loop repeat 10
              do (sweep row-scales column-scales t)
                 (sweep column-scales row-scales nil)))
      (map-into column-scales (lambda (x) (exp (max -600d0 (min 600d0 x)))) column-scales))))

(declaim (inline numerics-no-pivot-p))
(defun numerics-no-pivot-p (solver magnitude k)
  "Whether MAGNITUDE, of the pivot in column K and the row that stands there, is rounding alone."
  (declare (double-float magnitude) (fixnum k))
  (not (> (* magnitude (aref (numerics-solver-row-scales solver) k)
             (aref (numerics-solver-column-scales solver) k))
          (* 2.2d-16 (numerics-solver-size solver)))))

(defun numerics-note-singular (solver k)
  "Column K has no pivot. True."
  (setf (numerics-solver-singular-column solver) (aref (numerics-solver-order solver) k)
        (numerics-solver-singular-row solver) nil)
  t)
