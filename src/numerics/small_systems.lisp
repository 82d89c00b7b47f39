;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Small full systems: rows are scaled by their largest entry, then eliminated with partial
;;; pivoting (Golub & Van Loan: Matrix Computations, section 3.4). And which rows of a matrix follow
;;; from those before them, by modified Gram-Schmidt (section 5.2).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"))

(defstruct numerics-small-system
  (order 0 :type fixnum)                                ; of the system that is set
  (entries (numerics-zeros 0) :type numerics-vector)    ; by rows
  (right (numerics-zeros 0) :type numerics-vector))     ; the right side, then the solution

(defun numerics-new-small-system (most)
  "A system of an order up to MOST."
  (make-numerics-small-system :entries (numerics-zeros (* most most)) :right (numerics-zeros most)))

(defun numerics-set-products (system rows columns size kept)
  "SYSTEM becomes ROWS times COLUMNS, both vectors of SIZE after vectors of SIZE, those that are
KEPT."
  (declare (type numerics-vector rows columns) (fixnum size))
  (let ((order (length kept)) (entries (numerics-small-system-entries system)))
    (setf (numerics-small-system-order system) order)
    (loop for row of-type fixnum in kept
          for i of-type fixnum from 0
          do (loop for column of-type fixnum in kept
                   for j of-type fixnum from 0
                   do (let ((sum 0d0))
                        (declare (double-float sum))
                        (dotimes (k size)
                          (incf sum (* (aref rows (+ k (* row size)))
                                       (aref columns (+ k (* column size))))))
                        (setf (aref entries (+ j (* i order))) sum))))
    system))

(defun numerics-scale-rows (system)
  "Each row by its largest entry; whether there is one in every row."
  (let ((n (numerics-small-system-order system)) (entries (numerics-small-system-entries system))
        (right (numerics-small-system-right system)))
    (dotimes (i n t)
      (let ((largest (loop for j below n maximize (abs (aref entries (+ j (* i n)))))))
        (unless (> largest 0d0) (return nil))
        (dotimes (j n) (setf (aref entries (+ j (* i n))) (/ (aref entries (+ j (* i n))) largest)))
        (setf (aref right i) (/ (aref right i) largest))))))

(defun numerics-pivot-row (entries n k)
  (let ((chosen k))
    (loop for i from (1+ k) below n
          do (when (> (abs (aref entries (+ k (* i n)))) (abs (aref entries (+ k (* chosen n)))))
               (setq chosen i)))
    chosen))

(defun numerics-eliminate-below (entries right n k)
  "Takes multiples of the row K from those below it."
  (declare (type numerics-vector entries right) (fixnum n k) (optimize speed))
  (loop for i of-type fixnum from (1+ k) below n
        do (let ((factor (/ (aref entries (+ k (the fixnum (* i n))))
                            (aref entries (+ k (the fixnum (* k n)))))))
             (unless (= factor 0d0)
               (loop for j of-type fixnum from (1+ k) below n
                     do (decf (aref entries (+ j (the fixnum (* i n))))
                              (* factor (aref entries (+ j (the fixnum (* k n)))))))
               (decf (aref right i) (* factor (aref right k)))))))

(defun numerics-solve-small-system (system)
  "The solution of SYSTEM, whose entries it uses up; nil where it is singular."
  (let ((n (numerics-small-system-order system)) (entries (numerics-small-system-entries system))
        (right (numerics-small-system-right system)))
    (when (numerics-scale-rows system)
      (dotimes (k n)
        (let ((row (numerics-pivot-row entries n k)))
          (unless (> (abs (aref entries (+ k (* row n)))) 1d-14)
            (return-from numerics-solve-small-system nil))
          (unless (= row k)
            (dotimes (j n) (rotatef (aref entries (+ j (* k n))) (aref entries (+ j (* row n)))))
            (rotatef (aref right k) (aref right row))))
        (numerics-eliminate-below entries right n k))
      (loop for k from (1- n) downto 0
            do (loop for j from (1+ k) below n
                     do (decf (aref right k) (* (aref entries (+ j (* k n))) (aref right j))))
               (setf (aref right k) (/ (aref right k) (aref entries (+ k (* k n))))))
      right)))

;;; Rows that follow from others

(defun numerics-row-product (one other)
  (declare (type numerics-vector one other))
  (let ((sum 0d0))
    (dotimes (j (length one) sum) (incf sum (* (aref one j) (aref other j))))))

(defun numerics-row-rests (rows count size)
  "For each of COUNT rows of SIZE (rest . whole): its length without its part in the span of those
before it, and its length."
  (let ((basis '()))
    (loop for i below count
          for row = (subseq rows (* i size) (* (1+ i) size))
          for whole = (sqrt (numerics-row-product row row))
          do (loop repeat 2 ; the second time takes away what rounding left
                   do (dolist (direction basis)
                        (let ((part (numerics-row-product row direction)))
                          (map-into row (lambda (x y) (- x (* part y))) row direction))))
          collect (let ((rest (sqrt (numerics-row-product row row))))
                    (when (numerics-independent-p rest whole)
                      (push (map-into row (lambda (x) (/ x rest)) row) basis))
                    (cons rest whole)))))

(defun numerics-independent-p (rest whole) (> rest (* 1d-9 whole)))

(defun numerics-independent-rows (rows count size)
  "The places of those of COUNT rows of SIZE that do not follow from the ones before."
  (loop for (rest . whole) in (numerics-row-rests rows count size)
        for i from 0
        when (numerics-independent-p rest whole) collect i))
