;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Patterns of sparse matrices, and which of their columns can share a direction: two columns that
;;; have no row in common, so that the derivative along their sum shows both apart (Curtis, Powell,
;;; Reid: On the estimation of sparse Jacobian matrices, J. Inst. Maths Applics 13, 1974). Columns
;;; are coloured one after the other, those with most neighbours first. See numerics-colours first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"))

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
