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

(defun numerics-gauss-memory (nodes weights)
  "Foresight from the last step, which goes from 0 to 1, for the next one."
  (numerics-stage-foresight nodes weights (mapcar #'1+ nodes) weights))

;;; The rates in the stages are no values of a smooth function: their errors, of order s + 1, make
;;; the same pattern in each step, and a polynomial through two steps would make it thousands of
;;; times as large. So foresight from two steps is exact for polynomials of degree 2s - 3 and for
;;; that pattern, constant or linear in time (starting approximations: Hairer, Lubich, Wanner,
;;; Geometric Numerical Integration, VIII.6.1).

(defun numerics-stage-errors (nodes)
  "The pattern: (s + 1) sum_j a_ij c_j^s - c_i^(s + 1)."
  (let ((s (length nodes)))
    (loop for node in nodes
          for row in (numerics-collocation-integrals nodes nodes)
          collect (- (* (1+ s) (loop for a in row for c in nodes sum (* a (expt c s))))
                     (expt node (1+ s))))))

(defun numerics-gauss-memory-of-two (nodes weights)
  "Foresight from the last two steps, the older first."
  (let* ((known (append (mapcar #'1- nodes) nodes)) (errors (numerics-stage-errors nodes))
         (free (numerics-free-factors known)))
    (loop for node in nodes
          for weight in weights
          for own in errors
          for row = (numerics-lagrange-values known (1+ node))
          collect (loop for factor in (numerics-with-pattern row free errors own)
                        for known-weight in (append weights weights)
                        collect (/ (* weight factor) known-weight)))))

(defun numerics-free-factors (known)
  "Two rows of factors that give 0 for polynomials of degree 2s - 3 on the 2s nodes KNOWN."
  (let ((difference (loop for node in known
                          collect (/ (reduce #'* (mapcar (lambda (other) (- node other))
                                                         (remove node known)))))))
    (list difference (mapcar #'* known difference))))

(defun numerics-with-pattern (row free errors own)
  "ROW and a combination of the rows FREE, so that ERRORS foretell OWN whether they stay or grow by
the step: twice OWN from the last step, -OWN from the older one."
  (flet ((sums (row)
           (let ((s (length errors)))
             (list (reduce #'+ (mapcar #'* errors (subseq row 0 s)))
                   (reduce #'+ (mapcar #'* errors (subseq row s)))))))
    (destructuring-bind ((older last) (a c) (b d)) (mapcar #'sums (cons row free))
      (let* ((p (- (- own) older)) (q (- (* 2 own) last)) (determinant (- (* a d) (* b c)))
             (first (/ (- (* p d) (* q b)) determinant))
             (second (/ (- (* a q) (* c p)) determinant)))
        (mapcar (lambda (x u w) (+ x (* first u) (* second w)))
                row (first free) (second free))))))

(defun numerics-gauss-share (nodes weights share)
  (numerics-stage-foresight nodes weights
                            (mapcar (lambda (c) (* share c)) nodes)
                            (mapcar (lambda (b) (* share b)) weights)))

(defun numerics-new-gauss-table (stages)
  (let* ((nodes (numerics-gauss-nodes stages 120)) (weights (numerics-gauss-weights nodes)))
    (flet ((vectors (rows)
             (coerce (cons nil (mapcar #'numerics-vector-of rows)) 'simple-vector)))
      (make-numerics-gauss-table
       :nodes (numerics-vector-of (list nodes))
       :weights (numerics-vector-of (list weights))
       :quotients (numerics-vector-of (numerics-gauss-quotients nodes weights))
       :memories (vectors (list (numerics-gauss-memory nodes weights)
                                (numerics-gauss-memory-of-two nodes weights)))
       :shares (vectors (loop for k from 1 below stages
                              collect (numerics-gauss-share nodes weights (/ k stages))))))))

(defvar *numerics-gauss-tables* (make-hash-table) "Stages -> table, made when first asked for.")

(defun numerics-gauss-table (stages)
  (or (gethash stages *numerics-gauss-tables*)
      (setf (gethash stages *numerics-gauss-tables*) (numerics-new-gauss-table stages))))
