;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Groups of a constant matrix M in numbers, to 512 binary digits: whether one is regular, else the
;;; l and r with l M = 0, M r = 0; and pivots of a regular one. See numerics-kernel-of first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "forms/fixed" "forms/program_judge"
                "forms/sparse_elimination" "forms/value"))

(defparameter *numerics-dense-group* 150 "States of a group whose rank is found.")

(defstruct numerics-kernel group left right) ; of a group of places: bases of l and of r

(defun numerics-number-rows (rows)
  "ROWS with numbers in units of 2^-512 for their elements; nil where a name is in them."
  (let ((elements (loop for row in rows append (mapcar #'cdr row))))
    (unless (remove-if (lambda (name) (member name '($%pi $%e))) (algebra-inputs-of elements))
      (let ((values (forms-program-values elements (forms-new-point nil))))
        (loop for row in rows
              collect (loop for (j) in row collect (cons j (pop values))))))))

;;; Rank.

(defun numerics-dense-rows (rows)
  (loop for row in rows
        collect (loop for j below (length rows) collect (or (cdr (assoc j row)) 0))))

(defun numerics-kernel-of (group rows)
  "The numerics-kernel of GROUP with the numbers ROWS; nil where they are regular."
  (when (<= (length group) *numerics-dense-group*)
    (let* ((dense (numerics-dense-rows rows)) (right (numerics-exact-null-vectors dense)))
      (when right
        (make-numerics-kernel
         :group group :right right
         :left (numerics-exact-null-vectors (forms-transposed dense)))))))

(defun numerics-exact-null-vectors (rows)
  "A basis of the x with ROWS x = 0."
  (let* ((n (length rows)) (echelon (coerce (values (forms-echelon rows n)) 'vector)))
    (loop for free below n
          unless (aref echelon free) collect (numerics-exact-null-vector echelon free n))))

(defun numerics-exact-null-vector (echelon free n)
  "That of which the place FREE is 1."
  (let ((x (make-list n :initial-element 0)))
    (setf (nth free x) (forms-fixed 1))
    (loop for i from (1- free) downto 0
          for row = (aref echelon i)
          for known = (and row (forms-fixed-dot (rest row) (nthcdr (1+ i) x)))
          do (when row (setf (nth i x) (round (ash (- known) forms-digits) (first row)))))
    x))

;;; Pivots of a regular group, in double-float numbers.

(defun numerics-number-guards (names rows)
  "(name pivot . whole) of the regular and symmetric ROWS of NAMES."
  (let ((doubles (loop for row in rows
                       collect (loop for (j . x) in row
                                     collect (cons j (coerce (/ x (ash 1 forms-digits))
                                                             'double-float))))))
    (loop for step in (forms-sparse-factors
                       doubles (constantly 1d0)
                       (make-forms-arithmetic :subtract #'- :multiply #'* :divide #'/))
          for place = (forms-sparse-step-place step)
          collect (list* (nth place names)
                         (rational (forms-sparse-step-pivot step))
                         (rational (cdr (assoc place (nth place doubles))))))))

(defun numerics-symmetric-p (rows)
  (loop for row in rows
        for i from 0
        always (loop for (j . x) in row
                     always (eql x (or (cdr (assoc i (nth j rows))) 0)))))
