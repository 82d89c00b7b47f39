;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Linear algebra over few entries: sparse rows, lists of [place, value], and their elimination,
;;; the pivots looked for place by place in a given order. Place 0 holds what is given. A loop is a
;;; sparse row too: its branches with their signs.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/matrices"))

(defun circuits-entry (place value) (list '(mlist simp) place value))
(defun circuits-entry-place (entry) (second entry))
(defun circuits-entry-value (entry) (third entry))

(defun $circuits_places (row)
  "The places of ROW."
  (cons '(mlist simp) (mapcar #'circuits-entry-place (cdr row))))

(defun $circuits_entry (row place)
  "The value in ROW at PLACE."
  (let ((entry (find place (cdr row) :key #'circuits-entry-place)))
    (if entry (circuits-entry-value entry) 0)))

(defun $circuits_along (row quantities)
  "The sum over ROW of its values times the QUANTITIES at their places."
  (addn (loop for (nil place value) in (cdr row)
              collect (mul value (nth place quantities)))
        nil))

(defun $circuits_by_place (count rows numbers)
  "A list of COUNT rows: at each of NUMBERS one of ROWS, else []."
  (let ((table (make-array count :initial-element '((mlist simp)))))
    (loop for row in (cdr rows) for number in (cdr numbers)
          do (setf (aref table (1- number)) row))
    (cons '(mlist simp) (coerce table 'list))))

(defun $circuits_columns (rows count)
  "The COUNT columns of sparse ROWS, each a sparse row of [number of the row, value]."
  (let ((table (make-array count :initial-element '())))
    (loop for row in (cdr rows) for number from 1
          do (loop for (nil place value) in (cdr row)
                   do (push (circuits-entry number value) (aref table (1- place)))))
    (cons '(mlist simp)
          (loop for column across table collect (cons '(mlist simp) (nreverse column))))))

(defun $circuits_position (item items)
  "The place of ITEM, a number or a name, in the list ITEMS."
  (1+ (position item (cdr items) :test #'equal)))

;; Full rows; a matrix without rows or columns is matrix()

(defun $circuits_diagonal_of (matrix)
  "The diagonal of MATRIX where nothing stands beside it, else false."
  (loop for (nil . row) in (cdr matrix) for place from 0
        unless (loop for entry in row for k from 0 always (or (= k place) (eql entry 0)))
          do (return nil)
        collect (nth place row) into diagonal
        finally (return (cons '(mlist simp) diagonal))))

(defun $circuits_products (rows others)
  "A row for each of ROWS: its products with each of OTHERS."
  (cons '(mlist simp)
        (loop for row in (cdr rows)
              collect (cons '(mlist simp)
                            (loop for other in (cdr others)
                                  collect ($algebra_dot row other))))))

(defun $circuits_matrix (rows)
  (cons '($matrix simp) (if (cdr (cadr rows)) (cdr rows))))

;; Elimination

(defun circuits-simpler (e)
  (if (atom e) e (simplify ($ratsimp e))))

(defun circuits-row-table (row)
  (let ((table (make-hash-table)))
    (loop for (nil place value) in (cdr row)
          for sum = (circuits-simpler (add (gethash place table 0) value))
          do (if (zerop1 sum) (remhash place table) (setf (gethash place table) sum)))
    table))

(defun circuits-row-of-table (table)
  (let ((entries '()))
    (maphash (lambda (place value) (push (circuits-entry place value) entries)) table)
    (cons '(mlist simp) (sort entries #'< :key #'circuits-entry-place))))

(defun circuits-subtract (row pivot factor)
  "ROW := ROW - FACTOR*PIVOT."
  (maphash (lambda (place value)
             (let ((new (circuits-simpler (sub (gethash place row 0) (mul factor value)))))
               (if (zerop1 new) (remhash place row) (setf (gethash place row) new))))
           pivot))

(defun circuits-scale (row place)
  (let ((pivot (gethash place row)))
    (maphash (lambda (key value)
               (setf (gethash key row) (circuits-simpler (div value pivot))))
             row)))

(defun circuits-pivot-row (rows used place)
  "The shortest unused row with an entry at PLACE, or nil."
  (let ((best nil))
    (dolist (row rows best)
      (when (and (gethash place row) (not (member row used :test #'eq))
                 (or (null best) (< (hash-table-count row) (hash-table-count best))))
        (setq best row)))))

(defun circuits-eliminate (tables order)
  "Two lists: (place . reduced row) for the places of ORDER with a pivot, and the rows used."
  (let ((used '()) (pivots '()))
    (dolist (place order (values (nreverse pivots) used))
      (let ((row (circuits-pivot-row tables used place)))
        (when row
          (circuits-scale row place)
          (dolist (other tables)
            (let ((factor (and (not (eq other row)) (gethash place other))))
              (when factor (circuits-subtract other row factor))))
          (push row used)
          (push (cons place row) pivots))))))

(defun $circuits_elimination (rows order)
  "[places of ORDER with a pivot, their reduced rows without it, rows left]: in the second,
x_place + sum value*x = 0."
  (let ((tables (mapcar #'circuits-row-table (cdr rows))))
    (multiple-value-bind (pivots used) (circuits-eliminate tables (cdr order))
      (loop for (place . row) in pivots do (remhash place row))
      (flet ((rows-of (tables) (cons '(mlist simp) (mapcar #'circuits-row-of-table tables))))
        (list '(mlist simp)
              (cons '(mlist simp) (mapcar #'car pivots))
              (rows-of (mapcar #'cdr pivots))
              (rows-of (remove-if (lambda (row) (member row used :test #'eq)) tables)))))))

(defun $circuits_consistent (rows places)
  "Whether nothing is left of ROWS after elimination of the PLACES."
  (destructuring-bind (pivots reduced left) (cdr ($circuits_elimination rows places))
    (declare (ignore pivots reduced))
    (every (lambda (row) (null (cdr row))) (cdr left))))

(defun $circuits_solution (matrix right)
  "x with MATRIX.x = RIGHT, or false where it is not determined."
  (let* ((numbers (loop for nil in (cdr right) for k from 1 collect k))
         (rows (loop for row in (cdr matrix) for b in (cdr right)
                     collect (list* '(mlist simp) (list '(mlist simp) 0 (neg b))
                                    (loop for value in (cdr row) for k in numbers
                                          collect (list '(mlist simp) k value)))))
         (reduced (third ($circuits_elimination (cons '(mlist) rows) (cons '(mlist) numbers)))))
    (when (= (length (cdr reduced)) (length numbers))
      (cons '(mlist simp) (loop for row in (cdr reduced) collect (neg ($circuits_entry row 0)))))))
