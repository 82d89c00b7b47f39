;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Which rows of a constant sparse matrix depend on the others: those combinations of equations
;;; M x' = X from which the derivatives drop out. Rows are reduced one by one by those before them,
;;; each with its largest entry as the pivot.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"))

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
