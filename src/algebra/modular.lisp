;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Modulo a prime: values of polynomials at points; elimination; images of polynomials on a line
;;; x_i = a_i + b_i*t.
;;; Two polynomials are coprime, surely, if their images on a line are and no image loses degree:
;;; the form of highest degree of a common factor divides that of the polynomial.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels"))

(defmacro algebra-prime ()
  "The largest prime below 2^30: products are fixnums."
  1073741789)

(defmacro algebra-modulo (x)
  `(the fixnum (mod (the fixnum ,x) (algebra-prime))))

(declaim (inline algebra-power-modulo))
(defun algebra-power-modulo (x n p)
  "X^N modulo P, a prime below 2^30; inline, for where the prime is a constant"
  (let ((power 1) (base x))
    (declare (fixnum power base p))
    (loop until (zerop n)
          do (when (oddp n) (setq power (mod (the fixnum (* power base)) p)))
             (setq base (mod (the fixnum (* base base)) p)
                   n (ash n -1)))
    power))

(defun algebra-modular-power (x n) (algebra-power-modulo x n (algebra-prime)))

(defun algebra-modular-inverse (a)
  "a^(p-2) modulo p"
  (algebra-modular-power (mod a (algebra-prime)) (- (algebra-prime) 2)))

;; GCL's mod of -2^63 is negative.
(defun algebra-residue (n)
  "The whole number N modulo the prime."
  (let ((rest (mod (abs n) (algebra-prime))))
    (if (and (minusp n) (plusp rest)) (- (algebra-prime) rest) rest)))

(defun algebra-inverse-modulo (a p) (algebra-power-modulo (mod a p) (- p 2) p))

;;; Values at a point: a table of the variables.

(defun algebra-modular-value (p point)
  (if (atom p)
      (algebra-residue p)
      (let ((x (gethash (car p) point)) (sum 0))
        (loop for (exponent coefficient) on (cdr p) by #'cddr
              do (setq sum (mod (+ sum (* (algebra-modular-power x exponent)
                                          (algebra-modular-value coefficient point)))
                                (algebra-prime))))
        sum)))

(defun algebra-modular-point (seed)
  "Values of all variables: for each angle c = (1-u^2)/(1+u^2), s = 2u/(1+u^2)."
  (let ((point (make-hash-table :test #'eq)))
    (flet ((next () (setq seed (mod (+ (* seed 48271) 11) (algebra-prime)))))
      (dolist (kernel (algebra-ring-kernels *algebra-ring*))
        (setf (gethash (algebra-kernel-variable kernel) point) (next)))
      (dolist (unit (algebra-ring-units *algebra-ring*) point)
        (when (algebra-pair-p unit)
          (destructuring-bind (c . s)
              (algebra-modular-angle (next) (eq (algebra-unit-kind unit) 'circular))
            (setf (gethash (algebra-kernel-variable (algebra-unit-cosine unit)) point) c
                  (gethash (algebra-kernel-variable (algebra-unit-sine unit)) point) s)))))))

(defun algebra-modular-angle (u circular)
  (let* ((square (if circular (* u u) (- (* u u))))
         (below (algebra-modular-inverse (1+ square))))
    (cons (mod (* (- 1 square) below) (algebra-prime))
          (mod (* 2 u below) (algebra-prime)))))

;;; Elimination modulo any prime below 2^30.

(defun algebra-subtract-row (row factor pivot-row from p)
  "ROW less FACTOR times PIVOT-ROW, from a column on."
  (declare (simple-vector row pivot-row) (fixnum factor from p))
  (loop for k of-type fixnum from from below (length row)
        for x of-type fixnum = (svref pivot-row k)
        unless (zerop x)
          do (setf (svref row k)
                   (mod (the fixnum (- (the fixnum (svref row k)) (the fixnum (* factor x)))) p))))

(defun algebra-echelon-modulo (rows p)
  "((column . row) ..): the reduced echelon form of ROWS modulo P; and which rows became these."
  (let* ((all (loop for row in rows collect (map 'simple-vector (lambda (x) (mod x p)) row)))
         (rest all)
         (done '()))
    (dotimes (column (length (car rows)))
      (let ((pivot (find-if (lambda (row) (plusp (svref row column))) rest)))
        (when pivot
          (let ((inverse (algebra-inverse-modulo (svref pivot column) p)))
            (map-into pivot (lambda (x) (mod (* x inverse) p)) pivot))
          (setq rest (remove pivot rest :test #'eq))
          (dolist (row (append rest (mapcar #'cdr done)))
            (algebra-subtract-row row (svref row column) pivot column p))
          (push (cons column pivot) done))))
    (let ((echelon (nreverse done)))
      (values echelon (loop for (nil . row) in echelon collect (position row all :test #'eq))))))

;;; Images on a line: vectors of coefficients, lowest first, without leading zeros.

(defun algebra-line-image (p line)
  "LINE is a table of pairs (a . b)."
  (if (atom p)
      (algebra-trimmed (vector (algebra-residue p)))
      (destructuring-bind (a . b) (algebra-line-of (car p) line)
        (let ((image (vector)) (last (cadr p)))
          (loop for (exponent coefficient) on (cdr p) by #'cddr
                do (loop repeat (- last exponent)
                         do (setq image (algebra-times-linear image a b)))
                   (setq image (algebra-modular-sum image (algebra-line-image coefficient line))
                         last exponent))
          (loop repeat last do (setq image (algebra-times-linear image a b)))
          image))))

(defun algebra-line-of (variable line)
  "The same pair for a variable every time, spread by its place."
  (or (gethash variable line)
      (setf (gethash variable line)
            (let ((seed (+ 7919 (* 104729 (1+ (hash-table-count line))))))
              (cons (mod (* seed seed) (algebra-prime))
                    (1+ (mod (* seed 48271) (1- (algebra-prime)))))))))

(defun algebra-times-linear (image a b)
  "IMAGE times a + b*t."
  (declare (simple-vector image) (fixnum a b))
  (let* ((n (length image))
         (product (make-array (1+ n) :initial-element 0)))
    (dotimes (k n (algebra-trimmed product))
      (let ((c (svref image k)))
        (declare (fixnum c))
        (setf (svref product k)
              (algebra-modulo (+ (the fixnum (svref product k)) (the fixnum (* a c))))
              (svref product (1+ k)) (algebra-modulo (* b c)))))))

(defun algebra-modular-sum (u v)
  (declare (simple-vector u v))
  (when (< (length u) (length v)) (rotatef u v))
  (let ((sum (copy-seq u)))
    (declare (simple-vector sum))
    (dotimes (k (length v) (algebra-trimmed sum))
      (setf (svref sum k)
            (algebra-modulo (+ (the fixnum (svref u k)) (the fixnum (svref v k))))))))

(defun algebra-trimmed (image)
  (declare (simple-vector image))
  (let ((n (length image)))
    (loop while (and (plusp n) (eql 0 (svref image (1- n)))) do (decf n))
    (if (= n (length image)) image (subseq image 0 n))))

(defun algebra-modular-remainder (u v)
  "The remainder of the division of U by V."
  (let* ((u (copy-seq u))
         (m (length v))
         (inverse (algebra-modular-inverse (svref v (1- m)))))
    (loop for top from (1- (length u)) downto (1- m)
          do (let ((factor (mod (* (svref u top) inverse) (algebra-prime))))
               (unless (zerop factor)
                 (loop for k from 0 below m
                       for place = (+ k (- top m -1))
                       do (setf (svref u place)
                                (mod (- (svref u place) (* factor (svref v k)))
                                     (algebra-prime)))))))
    (algebra-trimmed u)))

(defun algebra-modular-coprime-p (u v)
  (loop while (> (length v) 1)
        do (psetq u v
                  v (algebra-modular-remainder u v)))
  (= (length v) 1))

(defun algebra-total-degree (p)
  (if (atom p)
      0
      (loop for (exponent coefficient) on (cdr p) by #'cddr
            maximize (+ exponent (algebra-total-degree coefficient)))))

(defparameter *algebra-image-degree* 10000
  "The largest degree of an image on a line, all of whose coefficients are stored.")

(defun algebra-surely-coprime-p (p q)
  "No common factor but numbers; nil if there is one, the degree is too high or the line was
unlucky."
  (let ((m (algebra-total-degree p)) (n (algebra-total-degree q)))
    (and (<= (max m n) *algebra-image-degree*)
         (let* ((line (make-hash-table :test #'eq))
                (u (algebra-line-image p line))
                (v (algebra-line-image q line)))
           (and (= (1- (length u)) m)
                (= (1- (length v)) n)
                (algebra-modular-coprime-p u v))))))
