;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The determinant of a matrix at a rational point, by elimination with numbers of 512 binary
;;; digits and the largest pivot of each column: n^3/3 products, so that a check costs no more than
;;; what it checks.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/value"))

(defun forms-row-cleared (row pivot-row)
  "ROW without its first entry, cleared by PIVOT-ROW, whose first entry is not smaller."
  (let ((factor (round (ash (car row) forms-digits) (car pivot-row))))
    (mapcar (lambda (x y) (- x (forms-fixed-times factor y))) (cdr row) (cdr pivot-row))))

(defun forms-eliminated-determinant (rows)
  "The determinant of ROWS, lists of fixed-point numbers."
  (let ((determinant (forms-fixed 1)))
    (loop while rows
          do (let* ((size (reduce #'max rows :key (lambda (row) (abs (car row)))))
                    (place (position size rows :key (lambda (row) (abs (car row)))))
                    (pivot-row (nth place rows)))
               (when (zerop size) (return 0))
               (setq determinant (forms-fixed-times determinant
                                                    (* (if (evenp place) 1 -1) (car pivot-row)))
                     rows (loop for row in (append (subseq rows 0 place) (nthcdr (1+ place) rows))
                                collect (forms-row-cleared row pivot-row))))
          finally (return determinant))))

(defun $forms_determinant_value (matrix point)
  "The value at POINT, as for forms_value; false where an entry or a product has none."
  (let ((value (catch 'forms-no-value
                 (forms-determinant-at (mapcar #'cdr (cdr matrix)) (forms-given-point point)))))
    (and value (div value (forms-fixed 1)))))

(defun forms-determinant-at (rows point)
  (forms-eliminated-determinant
   (loop for row in rows
         collect (loop for e in row collect (forms-fixed-value e point)))))
