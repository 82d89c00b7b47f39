;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Coefficients of Gauss-Legendre collocation (Hairer, Lubich, Wanner, Geometric Numerical
;;; Integration, II.1.3): the nodes c_i are the zeros of Legendre's polynomial on [0, 1], a_ij the
;;; integral of the j-th polynomial of Lagrange from 0 to c_i, b_j that to 1. They are computed as
;;; rational numbers to any number of bits; nothing is copied from a table.
;;; A step uses the quotients a_ij/b_j: where they are rounded so that a_ij/b_j + a_ji/b_i = 1 holds
;;; exactly, the method in double-float numbers is symplectic exactly (Antonana, Makazaga, Murua,
;;; Reducing and monitoring round-off error propagation for symplectic implicit Runge-Kutta
;;; schemes, Numerical Algorithms 76, 2017).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/decimals"))

;;; Polynomials are lists of rational numbers, the lowest power first.

(defun numerics-polynomial-value (p x)
  (let ((value 0))
    (dolist (coefficient (reverse p) value)
      (setq value (+ coefficient (* x value))))))

(defun numerics-polynomial-product (p q)
  (let ((product (make-list (+ (length p) (length q) -1) :initial-element 0)))
    (loop for a in p
          for i from 0
          do (loop for b in q
                   for k from i
                   do (incf (nth k product) (* a b))))
    product))

(defun numerics-polynomial-slope (p)
  (loop for a in (cdr p) for k from 1 collect (* k a)))

(defun numerics-polynomial-integral (p)
  (cons 0 (loop for a in p for k from 1 collect (/ a k))))

(defun numerics-lagrange-polynomial (nodes node)
  "Two values: the product of x - c over the other NODES, and its value at NODE."
  (let* ((others (remove node nodes)) (p (list 1)))
    (dolist (other others)
      (setq p (numerics-polynomial-product p (list (- other) 1))))
    (values p (numerics-polynomial-value p node))))

;;; The method.

(defun numerics-legendre-polynomial (stages)
  "Legendre's polynomial on [0, 1] of degree STAGES, up to a sign."
  (flet ((choose (n k)
           (let ((product 1))
             (dotimes (i k product) (setq product (/ (* product (- n i)) (1+ i)))))))
    (loop for k from 0 to stages
          collect (* (if (oddp k) -1 1) (choose stages k) (choose (+ stages k) k)))))

(defun numerics-gauss-nodes (stages bits)
  "The zeros of Legendre's polynomial in their order, to BITS bits: by Newton's method."
  (let* ((p (numerics-legendre-polynomial stages))
         (slope (numerics-polynomial-slope p)))
    (flet ((zero (start)
             (loop with x = (rational start)
                   for next = (/ (round (* (- x (/ (numerics-polynomial-value p x)
                                                   (numerics-polynomial-value slope x)))
                                           (ash 1 bits)))
                                 (ash 1 bits))
                   repeat 20
                   until (= next x)
                   do (setq x next)
                   finally (return next))))
      (loop for i from 1 to stages
            collect (zero (/ (- 1 (cos (/ (* pi (- i 1/4)) (+ stages 1/2)))) 2))))))

(defun numerics-collocation-integrals (nodes ends)
  "Row by row for ENDS: the integrals from 0 to an end of the polynomials of Lagrange on NODES. They
are computed in whole numbers, multiples of the common part of all."
  (let* ((scale (reduce #'lcm (mapcar #'denominator (append nodes ends))))
         (whole (mapcar (lambda (c) (* scale c)) nodes))
         (integrals (loop for node in whole
                          collect (multiple-value-bind (p value)
                                      (numerics-lagrange-polynomial whole node)
                                    (cons (numerics-polynomial-integral p) (* scale value))))))
    (loop for end in ends
          collect (loop for (p . value) in integrals
                        collect (/ (numerics-polynomial-value p (* scale end)) value)))))

(defun numerics-gauss-weights (nodes)
  (car (numerics-collocation-integrals nodes (list 1))))

;;; What a step needs, in double-float numbers.

(defstruct numerics-gauss-table
  (nodes (numerics-zeros 0) :type (simple-array double-float (*)))
  (weights (numerics-zeros 0) :type (simple-array double-float (*)))
  (quotients (numerics-zeros 0) :type (simple-array double-float (*))) ; a_ij/b_j, row by row
  memories  ; vector: [k] foretells the stages from those of the last k steps, [0] is not used
  shares)   ; vector: [k] foretells the stages of the first k/stages of a step from those of it

(defun numerics-vector-of (rows)
  (let ((numbers (apply #'append rows)))
    (make-array (length numbers) :element-type 'double-float
                                 :initial-contents (mapcar #'numerics-rounded numbers))))

(defun numerics-gauss-quotients (nodes weights)
  "Rows of a_ij/b_j, those below the diagonal rounded, those above it 1 less the former."
  (let ((exact (coerce (numerics-collocation-integrals nodes nodes) 'vector)))
    (flet ((quotient (i j)
             (rational (numerics-rounded (/ (nth j (aref exact i)) (nth j weights))))))
      (loop for i below (length nodes)
            collect (loop for j below (length nodes)
                          collect (cond ((= i j) 1/2)
                                        ((> i j) (quotient i j))
                                        (t (- 1 (quotient j i)))))))))

(defun numerics-lagrange-values (nodes x)
  "The polynomials of Lagrange on NODES at X, by products of whole numbers."
  (let* ((scale (reduce #'lcm (mapcar #'denominator (cons x nodes))))
         (whole (mapcar (lambda (c) (* scale c)) nodes)) (place (* scale x)))
    (loop for node in whole
          collect (let ((above 1) (below 1))
                    (dolist (other whole (/ above below))
                      (unless (= other node)
                        (setq above (* above (- place other))
                              below (* below (- node other)))))))))

(defun numerics-stage-foresight (known known-weights nodes weights)
  "Rows for NODES: the increment b_i h x'(c_i) from increments at the nodes KNOWN."
  (loop for node in nodes
        for weight in weights
        collect (loop for value in (numerics-lagrange-values known node)
                      for known-weight in known-weights
                      collect (/ (* weight value) known-weight))))

(defun numerics-gauss-memory (nodes weights steps)
  "Foresight from the last STEPS steps, the oldest first; the next one goes from 1 to 2."
  (numerics-stage-foresight
   (loop for k from (- 1 steps) to 0 append (mapcar (lambda (c) (+ c k)) nodes))
   (loop repeat steps append weights)
   (mapcar #'1+ nodes) weights))

(defun numerics-gauss-share (nodes weights share)
  (numerics-stage-foresight nodes weights
                            (mapcar (lambda (c) (* share c)) nodes)
                            (mapcar (lambda (b) (* share b)) weights)))

(defparameter *numerics-gauss-memory* 2 "From how many steps the stages of the next are foretold.")

(defun numerics-new-gauss-table (stages)
  (let* ((nodes (numerics-gauss-nodes stages 120)) (weights (numerics-gauss-weights nodes)))
    (flet ((vectors (rows first last)
             (coerce (cons nil (loop for k from first to last
                                     collect (numerics-vector-of (funcall rows k))))
                     'simple-vector)))
      (make-numerics-gauss-table
       :nodes (numerics-vector-of (list nodes))
       :weights (numerics-vector-of (list weights))
       :quotients (numerics-vector-of (numerics-gauss-quotients nodes weights))
       :memories (vectors (lambda (k) (numerics-gauss-memory nodes weights k))
                          1 *numerics-gauss-memory*)
       :shares (vectors (lambda (k) (numerics-gauss-share nodes weights (/ k stages)))
                        1 (1- stages))))))

(defvar *numerics-gauss-tables* (make-hash-table) "Stages -> table, made when first asked for.")

(defun numerics-gauss-table (stages)
  (or (gethash stages *numerics-gauss-tables*)
      (setf (gethash stages *numerics-gauss-tables*) (numerics-new-gauss-table stages))))
