;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Linear programming over the rationals: the largest c.x where A x = b, x >= 0, by the simplex
;;; method in two phases with Bland's rule, which does not cycle (Chvatal, Linear Programming, 3).
;;; Exact; for some dozens of rows and columns.

(in-package :maxima)

(defun algebra-simplex (a b c)
  "The largest c.x for A x = b, x >= 0, or nil where there is no such x; :unbounded. A is a list of
rows, B the list of right sides, C the costs; all rational."
  (let* ((columns (length c)) (rows (length a))
         (table (make-array (list (1+ rows) (+ columns rows 1)) :initial-element 0))
         (basis (make-array rows)))
    (algebra-simplex-fill table basis a b)
    (algebra-simplex-phase-one table basis columns)
    (if (zerop (aref table rows (+ columns rows)))
        (progn (algebra-simplex-drive-out table basis columns)
               (algebra-simplex-costs table basis c)
               (algebra-simplex-run table basis columns))
        nil)))

(defun algebra-simplex-fill (table basis a b)
  "Rows with right sides that are not negative, each with a variable of its own in the basis."
  (let* ((rows (length a)) (last (1- (array-dimension table 1))) (columns (- last rows)))
    (loop for row in a for right in b for i from 0
          for sign = (if (minusp right) -1 1)
          do (loop for x in row for j from 0 do (setf (aref table i j) (* sign x)))
             (setf (aref table i (+ columns i)) 1
                   (aref table i last) (* sign right)
                   (aref basis i) (+ columns i)))))

(defun algebra-simplex-phase-one (table basis columns)
  "Makes the sum of the rows' own variables as small as it goes."
  (let ((rows (length basis)) (last (1- (array-dimension table 1))))
    (dotimes (j (1+ last))
      (unless (<= columns j (1- last))
        (setf (aref table rows j) (- (loop for i below rows sum (aref table i j))))))
    (algebra-simplex-run table basis columns)))

(defun algebra-simplex-drive-out (table basis columns)
  "Takes the rows' own variables, which are 0 now, out of the basis where that can be done."
  (dotimes (i (length basis))
    (when (>= (aref basis i) columns)
      (let ((j (loop for j below columns
                     unless (zerop (aref table i j)) return j)))
        (when j (algebra-simplex-pivot table basis i j))))))

(defun algebra-simplex-costs (table basis c)
  "The last row: costs of the columns, with sign changed, expressed by those outside the basis."
  (let ((rows (length basis)) (last (1- (array-dimension table 1))))
    (dotimes (j (1+ last)) (setf (aref table rows j) 0))
    (loop for cost in c for j from 0 do (setf (aref table rows j) (- cost)))
    (dotimes (i rows)
      (let ((cost (if (< (aref basis i) (length c)) (nth (aref basis i) c) 0)))
        (unless (zerop cost)
          (dotimes (j (1+ last))
            (incf (aref table rows j) (* cost (aref table i j)))))))))

(defun algebra-simplex-run (table basis columns)
  "Pivots until no cost is negative: the value, or :unbounded."
  (let ((rows (length basis)) (last (1- (array-dimension table 1))))
    (loop
      (let ((j (loop for j below columns
                     when (minusp (aref table rows j)) return j)))
        (unless j (return (aref table rows last)))
        (let ((i (algebra-simplex-leaving table basis j)))
          (unless i (return :unbounded))
          (algebra-simplex-pivot table basis i j))))))

(defun algebra-simplex-leaving (table basis j)
  "The row that bounds column J most, of several that with the least variable."
  (let ((best nil) (least nil) (last (1- (array-dimension table 1))))
    (dotimes (i (length basis) best)
      (when (plusp (aref table i j))
        (let ((ratio (/ (aref table i last) (aref table i j))))
          (when (or (null best) (< ratio least)
                    (and (= ratio least) (< (aref basis i) (aref basis best))))
            (setq best i least ratio)))))))

(defun algebra-simplex-pivot (table basis i j)
  (let ((width (array-dimension table 1)) (pivot (aref table i j)))
    (dotimes (k width) (setf (aref table i k) (/ (aref table i k) pivot)))
    (dotimes (row (array-dimension table 0))
      (let ((factor (aref table row j)))
        (unless (or (= row i) (zerop factor))
          (dotimes (k width)
            (unless (zerop (aref table i k))
              (decf (aref table row k) (* factor (aref table i k))))))))
    (setf (aref basis i) j)))
