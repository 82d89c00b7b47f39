;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The cells into which the real roots of some polynomials with rational coefficients cut the
;;; line: open intervals, each with a rational number in it, and the roots, each with a rational
;;; number at which all the other polynomials have the sign that they have at the root. Roots are
;;; isolated by bisection with Sturm's chain of the product. Look first at algebra-line-cells.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/sturm"))

(defun $algebra_line_cells (polynomials)
  "[[x, 0], [x, k], [x, 0], ..] from left to right: 0 for an open interval in which x lies, k for a
root of the k-th one of POLYNOMIALS, lists of rational coefficients, highest power first, without
multiple or common roots."
  (let ((lists (loop for p in (cdr polynomials)
                     collect (algebra-primitive (mapcar #'algebra-rational-number (cdr p))))))
    (cons '(mlist simp)
          (loop for (x . place) in (algebra-line-cells lists)
                collect (list '(mlist simp) (algebra-maxima-rational x) place)))))

(defun algebra-line-cells (polynomials)
  "((x . 0) (x . k) (x . 0) ..)"
  (let* ((chains (mapcar #'algebra-sturm-chain polynomials))
         (chain (algebra-sturm-chain (algebra-product-of-lists polynomials)))
         (roots (algebra-apart chain (algebra-intervals-of-roots chain))))
    (if (null roots)
        (list (cons 0 0))
        (append (list (cons (algebra-simple-below (caar roots)) 0))
                (loop for ((low . high) next) on roots
                      collect (cons high (1+ (position-if
                                              (lambda (c) (plusp (algebra-chain-roots c low high)))
                                              chains)))
                      collect (cons (if next
                                        (algebra-simple-within high (car next))
                                        (algebra-simple-above high))
                                    0))))))

(defun algebra-product-of-lists (polynomials)
  (reduce #'algebra-product-of-two polynomials :initial-value '(1)))

(defun algebra-product-of-two (p q)
  (let ((product (make-list (+ (length p) (length q) -1) :initial-element 0)))
    (loop for a in p for i from 0
          do (loop for b in q for j from i
                   do (incf (nth j product) (* a b))))
    product))

;;; Intervals (low . high), low < root <= high

(defun algebra-intervals-of-roots (chain)
  "One for each root, in order."
  (let* ((p (car chain))
         (bound (if (cdr p)
                    (1+ (ceiling (reduce #'max (mapcar #'abs (cdr p))) (abs (car p))))
                    1)))
    (labels ((within (low high)
               (let ((count (algebra-chain-roots chain low high)) (middle (/ (+ low high) 2)))
                 (case count
                   (0 '())
                   (1 (list (cons low high)))
                   (t (append (within low middle) (within middle high)))))))
      (within (- bound) bound))))

(defun algebra-halved (chain interval)
  "The half of INTERVAL in which the root is."
  (destructuring-bind (low . high) interval
    (let ((middle (/ (+ low high) 2)))
      (if (plusp (algebra-chain-roots chain low middle))
          (cons low middle)
          (cons middle high)))))

(defun algebra-apart (chain intervals)
  "Made shorter until each is less than a quarter of the gaps beside it."
  (let ((intervals (coerce intervals 'vector)) (changed t))
    (flet ((width (k) (- (cdr (aref intervals k)) (car (aref intervals k)))))
      (loop while changed
            do (setq changed nil)
               (loop for k from 0 below (1- (length intervals))
                     for gap = (- (car (aref intervals (1+ k))) (cdr (aref intervals k)))
                     do (dolist (place (list k (1+ k)))
                          (when (>= (* 4 (width place)) gap)
                            (setf changed t
                                  (aref intervals place)
                                  (algebra-halved chain (aref intervals place))))))))
    (coerce intervals 'list)))

;;; Rational numbers with small numerators and denominators

(defun algebra-simple-within (low high)
  "In the middle half between LOW and HIGH."
  (let ((quarter (/ (- high low) 4)))
    (algebra-simplest (+ low quarter) (- high quarter))))

(defun algebra-simple-below (x) (min -1 (1- (floor x))))
(defun algebra-simple-above (x) (max 1 (1+ (ceiling x))))

(defun algebra-simplest (low high)
  "The rational number of least denominator in [LOW, HIGH]."
  (cond ((<= low 0 high) 0)
        ((minusp high) (- (algebra-simplest (- high) (- low))))
        ((<= (ceiling low) high) (ceiling low))
        (t (let ((whole (floor low)))
             (+ whole (/ (algebra-simplest (/ (- high whole)) (/ (- low whole)))))))))

;;; Bounds of roots, for strips of a plane

(defun $algebra_roots_bounded (polynomials low high share)
  "[[a, b], ..]: the roots between LOW and HIGH of POLYNOMIALS, lists of rational coefficients, one
between each a and b, neither of which is a root; b - a is at most SHARE of the whole."
  (destructuring-bind (low high share) (mapcar #'algebra-rational-number (list low high share))
    (let* ((lists (list* (list 1 (- low)) (list 1 (- high))
                         (loop for p in (cdr polynomials)
                               collect (mapcar #'algebra-rational-number (cdr p)))))
           (chain (algebra-sturm-chain
                   (algebra-primitive (algebra-product-of-lists lists)))))
      (cons '(mlist simp)
            (loop for (a . b) in (algebra-bounds-apart
                                  chain (algebra-apart chain (algebra-intervals-of-roots chain))
                                  (* share (- high low)))
                  when (< low a b high)
                    collect (list '(mlist simp) (algebra-maxima-rational a)
                                  (algebra-maxima-rational b)))))))

(defun algebra-bounds-apart (chain intervals width)
  "Not wider than WIDTH, no end of one a root."
  (loop for interval in intervals
        collect (loop while (> (- (cdr interval) (car interval)) width)
                      do (setq interval (algebra-halved chain interval))
                      finally (return (algebra-beyond-root chain interval)))))

(defun algebra-beyond-root (chain interval)
  "INTERVAL, whose right end may be its root, with an end a little further."
  (destructuring-bind (low . high) interval
    (if (zerop (algebra-sign-of-value (car chain) high))
        (cons low (+ high (/ (- high low) 2)))
        interval)))

(defun $algebra_simple_within (low high)
  "A rational number with a small denominator in the middle half between LOW and HIGH."
  (algebra-maxima-rational (algebra-simple-within (algebra-rational-number low)
                                                  (algebra-rational-number high))))
