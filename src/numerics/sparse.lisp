;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Products of sparse matrices, by columns, with vectors.

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
