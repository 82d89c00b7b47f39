;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials modulo a prime: their values at points, their images on a line x_i = a_i + b_i*t.
;;; Two polynomials are coprime, surely, if their images on a line are and no image loses degree:
;;; the form of highest degree of a common factor divides that of the polynomial.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels"))

(defvar *algebra-prime* 1073741789 "the largest prime below 2^30: products are fixnums")

(defun algebra-modular-inverse (a)
  "a^(p-2) modulo p"
  (let ((power 1) (base (mod a *algebra-prime*)))
    (loop for n = (- *algebra-prime* 2) then (ash n -1)
          until (zerop n)
          do (when (oddp n) (setq power (mod (* power base) *algebra-prime*)))
             (setq base (mod (* base base) *algebra-prime*)))
    power))

;;; Values at a point: a table of the variables.

(defun algebra-modular-value (p point)
  (if (atom p)
      (mod p *algebra-prime*)
      (let ((x (gethash (car p) point)) (sum 0))
        (loop for (exponent coefficient) on (cdr p) by #'cddr
              do (setq sum (mod (+ sum (* (algebra-modular-power x exponent)
                                          (algebra-modular-value coefficient point)))
                                *algebra-prime*)))
        sum)))

(defun algebra-modular-power (x n)
  (let ((power 1))
    (loop repeat n do (setq power (mod (* power x) *algebra-prime*)))
    power))

;;; Images on a line: vectors of coefficients, lowest first, without leading zeros.

(defun algebra-line-image (p line)
  "LINE is a table of pairs (a . b)."
  (if (atom p)
      (algebra-trimmed (vector (mod p *algebra-prime*)))
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
              (cons (mod (* seed seed) *algebra-prime*)
                    (1+ (mod (* seed 48271) (1- *algebra-prime*))))))))

(defun algebra-times-linear (image a b)
  "IMAGE times a + b*t."
  (let* ((n (length image))
         (product (make-array (1+ n) :initial-element 0)))
    (dotimes (k n (algebra-trimmed product))
      (let ((c (svref image k)))
        (setf (svref product k) (mod (+ (svref product k) (* a c)) *algebra-prime*)
              (svref product (1+ k)) (mod (* b c) *algebra-prime*))))))

(defun algebra-modular-sum (u v)
  (when (< (length u) (length v)) (rotatef u v))
  (let ((sum (copy-seq u)))
    (dotimes (k (length v) (algebra-trimmed sum))
      (setf (svref sum k) (mod (+ (svref u k) (svref v k)) *algebra-prime*)))))

(defun algebra-trimmed (image)
  (let ((n (length image)))
    (loop while (and (plusp n) (zerop (svref image (1- n)))) do (decf n))
    (if (= n (length image)) image (subseq image 0 n))))

(defun algebra-modular-remainder (u v)
  "The remainder of the division of U by V."
  (let* ((u (copy-seq u))
         (m (length v))
         (inverse (algebra-modular-inverse (svref v (1- m)))))
    (loop for top from (1- (length u)) downto (1- m)
          do (let ((factor (mod (* (svref u top) inverse) *algebra-prime*)))
               (unless (zerop factor)
                 (loop for k from 0 below m
                       for place = (+ k (- top m -1))
                       do (setf (svref u place)
                                (mod (- (svref u place) (* factor (svref v k)))
                                     *algebra-prime*))))))
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

(defun algebra-surely-coprime-p (p q)
  "No common factor but numbers; nil if there is one or the line was unlucky."
  (let* ((line (make-hash-table :test #'eq))
         (u (algebra-line-image p line))
         (v (algebra-line-image q line)))
    (and (= (1- (length u)) (algebra-total-degree p))
         (= (1- (length v)) (algebra-total-degree q))
         (algebra-modular-coprime-p u v))))
