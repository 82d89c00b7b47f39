;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The rank of a matrix of expressions.  At a point modulo a large prime (rational points of the
;;; circle for each angle) the rank r is a lower bound, with r rows and columns whose minor is
;;; not zero.  The rank is r when every minor of r + 1 rows that borders that one vanishes exactly.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels" "algebra/minors" "algebra/modular" "algebra/zero"
                "algebra/general_form" "algebra/matrices" "algebra/relations"
                "algebra/zero_polynomials"))

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
  (with-algebra-zero-form
    (algebra-rectangle (mapcar (lambda (row) (nth-value 0 (algebra-common-denominator row)))
                               (algebra-matrix-quotients m)))))

(defun algebra-border (matrix rows columns)
  "The rank, from the ROWS and COLUMNS of a minor that does not vanish."
  (dotimes (i (array-dimension matrix 0) (length rows))
    (unless (member i rows)
      (dotimes (j (array-dimension matrix 1))
        (unless (member j columns)
          (unless (algebra-minor-zero-p matrix (cons i rows) (cons j columns))
            (return-from algebra-border
              (algebra-border matrix (cons i rows) (cons j columns)))))))))

(defun algebra-minor-zero-p (matrix rows columns)
  (let ((minor (algebra-reduce
                (algebra-determinant-polynomial
                 (algebra-rectangle
                  (loop for i in rows
                        collect (loop for j in columns collect (aref matrix i j))))))))
    (or (pzerop (car minor))
        (case (algebra-polynomial-test (car minor))
          (zero t)
          (not-zero nil)
          (t (if (algebra-nonzero-somewhere-p (algebra-general (car minor)))
                 nil
                 (algebra-zero-undecided (algebra-general (car minor)))))))))

;;; A point modulo a prime.

(defun algebra-point-minor (matrix)
  "(rows . columns) of a minor that does not vanish at a point; none if some kernel has no value."
  (if (every #'algebra-kernel-sure (algebra-ring-kernels *algebra-ring*))
      (multiple-value-bind (echelon rows)
          (algebra-echelon-modulo (algebra-modular-rows matrix (algebra-modular-point 20011))
                                  (algebra-prime))
        (cons rows (mapcar #'car echelon)))
      '(nil)))

(defun algebra-modular-rows (matrix point)
  (loop for i below (array-dimension matrix 0)
        collect (loop for j below (array-dimension matrix 1)
                      collect (algebra-modular-value (aref matrix i j) point))))
