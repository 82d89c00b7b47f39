;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The rank of a matrix of expressions.  At a point modulo a large prime (rational points of the
;;; circle for each angle) the rank r is a lower bound, with r rows and columns whose minor is
;;; not zero.  The rank is r when every minor of r + 1 rows that borders that one vanishes exactly.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/minors" "algebra/modular" "algebra/zero"))

(defun $algebra_rank (m)
  (algebra-check-matrix m "the matrix of a rank")
  (with-algebra-ring
    (let* ((matrix (algebra-rank-matrix m))
           (minor (algebra-point-minor matrix)))
      (algebra-border matrix (car minor) (cdr minor)))))

(defun $algebra_least_rank (m)
  "A lower bound of the rank, that at a point; no minor is formed."
  (algebra-check-matrix m "the matrix of a rank")
  (with-algebra-ring
    (length (car (algebra-point-minor (algebra-rank-matrix m))))))

(defun algebra-rank-matrix (m)
  "Its rows without denominators, in the ring at hand."
  (let ((*algebra-exponential-form* t)
        (*algebra-roots-apart* t)
        (*algebra-every-multiple* t))
    (algebra-rectangle (mapcar (lambda (row) (nth-value 0 (algebra-common-denominator row)))
                               (algebra-matrix-quotients m)))))

(defun algebra-rectangle (rows)
  (make-array (list (length rows) (length (car rows))) :initial-contents rows))

(defun algebra-border (matrix rows columns)
  "The rank, from the ROWS and COLUMNS of a minor that does not vanish."
  (dotimes (i (array-dimension matrix 0) (length rows))
    (unless (member i rows)
      (dotimes (j (array-dimension matrix 1))
        (unless (member j columns)
          (unless (algebra-minor-vanishes-p matrix (cons i rows) (cons j columns))
            (return-from algebra-border
              (algebra-border matrix (cons i rows) (cons j columns)))))))))

(defun algebra-minor-vanishes-p (matrix rows columns)
  (let ((minor (algebra-reduce
                (algebra-determinant-polynomial
                 (algebra-square-array
                  (loop for i in rows
                        collect (loop for j in columns collect (aref matrix i j))))))))
    (or (pzerop (car minor))
        (case (algebra-polynomial-test (car minor))
          (zero t)
          (not-zero nil)
          (t (if (algebra-nonzero-somewhere-p (algebra-general (car minor)))
                 nil
                 (core-undecided "it is not decided whether ~A vanishes"
                                 (algebra-short-text (algebra-general (car minor))))))))))

;;; A point modulo a prime.

(defun algebra-point-minor (matrix)
  "(rows . columns) of a minor that does not vanish at a point; none if some kernel has no value."
  (if (every #'algebra-kernel-sure (algebra-ring-kernels *algebra-ring*))
      (algebra-modular-pivots (algebra-modular-matrix matrix (algebra-modular-point 20011)))
      '(nil)))

(defun algebra-modular-matrix (matrix point)
  (let ((values (make-array (array-dimensions matrix))))
    (dotimes (i (array-dimension matrix 0) values)
      (dotimes (j (array-dimension matrix 1))
        (setf (aref values i j) (algebra-modular-value (aref matrix i j) point))))))

(defun algebra-modular-pivots (a)
  (let ((rows nil) (columns nil))
    (dotimes (j (array-dimension a 1) (cons rows columns))
      (let ((pivot (loop for i below (array-dimension a 0)
                         when (and (not (member i rows)) (plusp (aref a i j))) return i)))
        (when pivot
          (push pivot rows)
          (push j columns)
          (algebra-modular-clear a pivot j))))))

(defun algebra-modular-clear (a pivot j)
  (let ((inverse (algebra-modular-inverse (aref a pivot j))))
    (dotimes (i (array-dimension a 0))
      (unless (or (= i pivot) (zerop (aref a i j)))
        (let ((factor (* (aref a i j) inverse)))
          (dotimes (k (array-dimension a 1))
            (setf (aref a i k)
                  (mod (- (aref a i k) (* factor (aref a pivot k))) (algebra-prime)))))))))
