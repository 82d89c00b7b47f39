;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Sparse matrices by columns: their products with vectors, their patterns from entries, which of
;;; their rows depend on the others, and which of their columns can share a direction: two that have
;;; no row in common, so that the derivative along their sum shows both apart (Curtis, Powell, Reid:
;;; On the estimation of sparse Jacobian matrices, J. Inst. Maths Applics 13, 1974).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"))

(defun numerics-multiply (pattern values x out)
  "The matrix of PATTERN and VALUES times X into OUT."
  (declare (type numerics-vector values x out) (optimize speed))
  (let ((starts (numerics-pattern-starts pattern)) (rows (numerics-pattern-rows pattern)))
    (fill out 0d0)
    (dotimes (j (length x) out)
      (let ((factor (aref x j)))
        (loop for k of-type numerics-index from (aref starts j) below (aref starts (1+ j))
              do (incf (aref out (aref rows k)) (* (aref values k) factor)))))))

;;; Entries are (column row ..).

(defun numerics-entry-before-p (a b)
  (or (< (first a) (first b)) (and (= (first a) (first b)) (< (second a) (second b)))))

(defun numerics-pattern-of (n entries)
  "The pattern of N columns with ENTRIES in their order."
  (let ((starts (make-array (1+ n) :element-type '(unsigned-byte 32) :initial-element 0)))
    (loop for (column) in entries do (incf (aref starts (1+ column))))
    (dotimes (j n) (incf (aref starts (1+ j)) (aref starts j)))
    (make-numerics-pattern :size n :starts starts
                           :rows (coerce (mapcar #'second entries) 'numerics-indices))))

;;; Which rows of a constant matrix depend on the others: those combinations of equations M x' = X
;;; from which the derivatives drop out. Rows are reduced one by one by those before them, each with
;;; its largest entry as the pivot.

(defun numerics-matrix-rows (matrix transposed)
  "Vector of the rows, or of the columns where TRANSPOSED, as lists of (index . value)."
  (let* ((pattern (numerics-matrix-pattern matrix)) (n (numerics-pattern-size pattern))
         (lists (make-array n :initial-element '())))
    (dotimes (j n lists)
      (loop for k from (aref (numerics-pattern-starts pattern) j)
              below (aref (numerics-pattern-starts pattern) (1+ j))
            do (let ((i (aref (numerics-pattern-rows pattern) k))
                     (value (aref (numerics-matrix-values matrix) k)))
                 (unless (= value 0)
                   (push (cons (if transposed i j) value) (aref lists (if transposed j i)))))))))

(defun numerics-less-multiple (row factor other)
  "ROW - FACTOR*OTHER, lists of (index . value)."
  (let ((sum (mapcar (lambda (entry) (cons (car entry) (cdr entry))) row)))
    (loop for (index . value) in other
          do (let ((entry (assoc index sum)))
               (if entry
                   (decf (cdr entry) (* factor value))
                   (push (cons index (- (* factor value))) sum))))
    sum))

(defun numerics-reduced-row (row combination pivots)
  "ROW less multiples of the rows in PIVOTS, vector by column of (rank pivot-row combination), and
the COMBINATION of rows that it then is."
  (loop
    (let ((column nil) (rank nil))
      (loop for (j) in row
            do (let ((pivot (aref pivots j)))
                 (when (and pivot (or (null rank) (< (first pivot) rank)))
                   (setq column j rank (first pivot)))))
      (unless column (return (values row combination)))
      (destructuring-bind (other others) (rest (aref pivots column))
        (let ((factor (/ (cdr (assoc column row)) (cdr (assoc column other)))))
          (setq row (remove column (numerics-less-multiple row factor other) :key #'car)
                combination (numerics-less-multiple combination factor others)))))))

(defun numerics-largest-entry (row)
  (let ((largest nil))
    (dolist (entry row largest)
      (when (or (null largest) (> (abs (cdr entry)) (abs (cdr largest)))) (setq largest entry)))))

(defun numerics-null-vectors (matrix transposed)
  "The combinations, lists of (index . weight), of rows that vanish; of columns where TRANSPOSED."
  (let* ((rows (numerics-matrix-rows matrix transposed)) (found '())
         (pivots (make-array (length rows) :initial-element nil)))
    (dotimes (i (length rows) (nreverse found))
      (multiple-value-bind (row combination)
          (numerics-reduced-row (aref rows i) (list (cons i 1d0)) pivots)
        (let ((largest (numerics-largest-entry row))
              (before (numerics-largest-entry (aref rows i))))
          (if (and largest (> (abs (cdr largest)) (* 1d-13 (abs (cdr before)))))
              (setf (aref pivots (car largest)) (list i row combination))
              (push combination found)))))))

;;; Columns are coloured one after the other, those with most neighbours first.

(defun numerics-colours (n columns)
  "The vector of colours from 0 of the N columns in COLUMNS, a vector of lists of rows, and their
number; an empty column has none, nil."
  (let ((rows (make-array n :initial-element '())) (colours (make-array n :initial-element nil))
        (most 0))
    (dotimes (j n) (dolist (i (aref columns j)) (push j (aref rows i))))
    (dolist (j (numerics-columns-in-order n columns rows))
      (let ((colour (numerics-free-colour (aref columns j) rows colours)))
        (setf (aref colours j) colour)
        (setq most (max most (1+ colour)))))
    (values colours most)))

(defun numerics-columns-in-order (n columns rows)
  "The columns that are not empty, those first whose rows have most entries."
  (flet ((weight (j) (loop for i in (aref columns j) sum (length (aref rows i)))))
    (let ((weights (make-array n)))
      (dotimes (j n) (setf (aref weights j) (weight j)))
      (stable-sort (loop for j from 0 below n when (aref columns j) collect j)
                   #'> :key (lambda (j) (aref weights j))))))

(defun numerics-free-colour (column rows colours)
  "The first colour that no column has which shares a row with COLUMN."
  (let ((taken '()))
    (dolist (i column)
      (dolist (j (aref rows i))
        (let ((colour (aref colours j))) (when colour (pushnew colour taken)))))
    (loop for colour from 0 unless (member colour taken) return colour)))
