;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Elimination of unknowns from many rows with few entries each: the row with the fewest unknowns
;;; goes first, and in it the unknown that fewest rows hold (H. Markowitz, Management Science 3
;;; (1957)), so that what determines itself step by step costs no more than its entries. Columns are
;;; whole numbers; those that are not among the unknowns are given, and only carried along.
;;; See circuits-eliminated-rows first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/coefficients"))

(defstruct (circuits-elimination (:conc-name circuits-elimination-))
  rows                 ; vector of rows
  unknowns             ; table of the columns that are unknown
  open                 ; vector: whether a row is still to be used
  counts               ; vector: unknowns in each row
  holders              ; column -> numbers of rows that held it at some time
  sizes                ; column -> how many rows hold it
  waiting              ; vector of lists: rows by their count, some of them by an old one
  (pivots '())         ; (column . row) newest first, the pivot itself 1
  (determinant '()))   ; pivots as they were

(defun circuits-eliminated-rows (rows unknowns)
  "The elimination of the columns UNKNOWNS from the list ROWS, which are changed."
  (let ((work (circuits-new-elimination rows unknowns)))
    (loop for row = (circuits-shortest-row work)
          while row do (circuits-use-row work row (circuits-rarest-unknown work row)))
    work))

(defun circuits-new-elimination (rows unknowns)
  (let* ((count (length rows))
         (work (make-circuits-elimination
                :rows (coerce rows 'vector) :unknowns (make-hash-table)
                :open (make-array count :initial-element t)
                :counts (make-array count :initial-element 0)
                :holders (make-hash-table) :sizes (make-hash-table)
                :waiting (make-array (+ 2 (length unknowns)) :initial-element '()))))
    (dolist (column unknowns)
      (setf (gethash column (circuits-elimination-unknowns work)) t))
    (loop for row across (circuits-elimination-rows work)
          for k from 0
          do (loop for column being the hash-keys of row
                   do (when (circuits-unknown-p work column) (circuits-gained work k column)))
             (circuits-wait work k))
    work))

(defun circuits-unknown-p (work column) (gethash column (circuits-elimination-unknowns work)))

(defun circuits-gained (work k column)
  (incf (aref (circuits-elimination-counts work) k))
  (incf (gethash column (circuits-elimination-sizes work) 0))
  (push k (gethash column (circuits-elimination-holders work))))

(defun circuits-lost (work k column)
  (decf (aref (circuits-elimination-counts work) k))
  (decf (gethash column (circuits-elimination-sizes work))))

(defun circuits-wait (work k)
  (push k (aref (circuits-elimination-waiting work) (aref (circuits-elimination-counts work) k))))

(defun circuits-shortest-row (work)
  "The number of an open row with fewest unknowns, at least one, or nil."
  (let ((waiting (circuits-elimination-waiting work)))
    (loop for count from 1 below (length waiting)
          do (loop while (aref waiting count)
                   do (let ((k (pop (aref waiting count))))
                        (when (and (aref (circuits-elimination-open work) k)
                                   (= count (aref (circuits-elimination-counts work) k)))
                          (return-from circuits-shortest-row k)))))))

(defun circuits-rarest-unknown (work k)
  "The unknown of row K that fewest rows hold; of several the one with a number in front, the
latest."
  (let ((best nil) (best-cost nil))
    (maphash (lambda (column x)
               (when (circuits-unknown-p work column)
                 (let ((cost (list (gethash column (circuits-elimination-sizes work))
                                   (if (rationalp x) 0 1) (- column))))
                   (when (or (null best) (circuits-before-p cost best-cost))
                     (setq best column best-cost cost)))))
             (aref (circuits-elimination-rows work) k))
    best))

(defun circuits-before-p (cost other)
  (loop for x in cost for y in other
        do (cond ((< x y) (return t)) ((> x y) (return nil)))))

(defun circuits-use-row (work k column)
  "Row K determines COLUMN: it is taken out of all other open rows."
  (let* ((rows (circuits-elimination-rows work)) (row (aref rows k)) (pivot (gethash column row)))
    (setf (aref (circuits-elimination-open work) k) nil)
    (push pivot (circuits-elimination-determinant work))
    (unless (eql pivot 1)
      (maphash (lambda (place x) (setf (gethash place row) (circuits-over x pivot))) row)
      (setf (gethash column row) 1))
    (push (cons column row) (circuits-elimination-pivots work))
    (dolist (other (remove-duplicates (gethash column (circuits-elimination-holders work))))
      (when (and (aref (circuits-elimination-open work) other)
                 (gethash column (aref rows other)))
        (circuits-take-row work other row (gethash column (aref rows other)))
        (circuits-wait work other)))))

(defun circuits-take-row (work k pivot-row factor)
  "Row K less FACTOR times the row of a pivot."
  (let ((row (aref (circuits-elimination-rows work) k)) (minus (circuits-negative factor)))
    (maphash (lambda (column x)
               (let* ((before (gethash column row))
                      (after (circuits-add-entry row column (circuits-times minus x))))
                 (when (circuits-unknown-p work column)
                   (cond ((and before (eql after 0)) (circuits-lost work k column))
                         ((and (not before) (not (eql after 0)))
                          (circuits-gained work k column))))))
             pivot-row)))

(defun circuits-rows-left (work)
  "The rows without unknowns that determine nothing, those that are empty apart."
  (loop for row across (circuits-elimination-rows work)
        for open across (circuits-elimination-open work)
        when (and open (plusp (hash-table-count row))) collect row))

(defun circuits-undetermined (work unknowns)
  "Those of UNKNOWNS that no row determines."
  (let ((found (make-hash-table)))
    (loop for (column) in (circuits-elimination-pivots work) do (setf (gethash column found) t))
    (remove-if (lambda (column) (gethash column found)) unknowns)))

;;; Back from the last pivot to the first: what the unknowns are.

(defun circuits-solved-unknowns (work wanted)
  "Table: unknown -> row of what is given, for the list WANTED and all that they need; unknowns that
no row determines are given."
  (let ((needed (make-hash-table)) (solved (make-hash-table)))
    (dolist (column wanted) (setf (gethash column needed) t))
    (loop for (column . row) in (reverse (circuits-elimination-pivots work))
          do (when (gethash column needed)
               (loop for other being the hash-keys of row
                     do (setf (gethash other needed) t))))
    (loop for (column . row) in (circuits-elimination-pivots work)
          do (when (gethash column needed)
               (setf (gethash column solved) (circuits-solved-row row column solved))))
    solved))

(defun circuits-solved-row (row unknown solved)
  (let ((result (circuits-new-row)))
    (maphash (lambda (column x)
               (unless (= column unknown)
                 (let ((known (gethash column solved)))
                   (if known
                       (circuits-add-multiple result (circuits-negative x) known)
                       (circuits-add-entry result column (circuits-negative x))))))
             row)
    result))
