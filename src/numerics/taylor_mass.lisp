;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A constant matrix M in fixed-point numbers, for the Taylor series of M x' = X: its inverse, once
;;; for a number of bits, by elimination with the largest pivots and 64 bits more.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/program" "numerics/taylor_numbers"))

(defconstant numerics-mass-guard-bits 64)

(defun numerics-fixed-inverse (rows bits)
  "The rows of the inverse of the matrix ROWS, both vectors of vectors; nil where it is singular."
  (let* ((n (length rows)) (one (ash 1 bits))
         (wide (map 'vector
                    (lambda (row) (concatenate 'vector row (make-array n :initial-element 0)))
                    rows)))
    (dotimes (i n) (setf (aref (aref wide i) (+ n i)) one))
    (dotimes (j n (map 'vector (lambda (row) (subseq row n)) wide))
      (let ((pivot (numerics-row-of-largest wide j)))
        (when (< (integer-length (aref (aref wide pivot) j)) (floor bits 3)) (return nil))
        (rotatef (aref wide j) (aref wide pivot))
        (numerics-eliminate-column wide j bits)))))

(defun numerics-row-of-largest (rows j)
  (let ((largest j))
    (loop for i from j below (length rows)
          do (when (> (abs (aref (aref rows i) j)) (abs (aref (aref rows largest) j)))
               (setq largest i)))
    largest))

(defun numerics-eliminate-column (rows j bits)
  "The column J becomes that of the unit matrix."
  (let* ((row (aref rows j)) (pivot (aref row j)))
    (map-into row (lambda (x) (round (ash x bits) pivot)) row)
    (dotimes (i (length rows))
      (let ((factor (aref (aref rows i) j)))
        (unless (or (= i j) (zerop factor))
          (map-into (aref rows i)
                    (lambda (x y) (- x (numerics-shifted (* factor y) (- bits))))
                    (aref rows i) row))))))

(defun numerics-mass-solver (program value bits)
  "nil where M is the identity, else the function of a list X that gives M^-1 X. VALUE gives the
fixed-point number of an element."
  (when (numerics-program-mass program)
    (let* ((n (length (numerics-program-names program))) (inner (+ bits numerics-mass-guard-bits))
           (rows (map 'vector
                      (lambda (entries)
                        (let ((row (make-array n :initial-element 0)))
                          (loop for (j . element) in entries
                                do (setf (aref row j) (ash (funcall value element)
                                                           numerics-mass-guard-bits)))
                          row))
                      (numerics-program-mass program)))
           (inverse (or (numerics-fixed-inverse rows inner)
                        (core-error "the matrix mass is singular, and Taylor series need its ~
                                     inverse"))))
      (lambda (x)
        (loop for row across inverse
              collect (numerics-shifted (loop for a across row for b in x sum (* a b))
                                        (- inner)))))))
