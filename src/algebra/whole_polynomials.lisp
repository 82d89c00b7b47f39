;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials with whole numbers, lists of coefficients, the highest power first: the greatest
;;; common divisor by its images modulo primes (Knuth, The Art of Computer Programming 2, 4.6.1; von
;;; zur Gathen, Gerhard, Modern Computer Algebra, 6.7), parts without multiple roots (Yun).  A
;;; prime that does not divide the leading coefficients never makes the degree of the divisor
;;; smaller: degree 0 modulo one of them proves that there is none.  What primes put together must
;;; divide both polynomials.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/modular" "algebra/sturm"))

(defun algebra-common-polynomial (f g)
  "The greatest common divisor of F and G, which are not zero, primitive, its first coefficient
positive."
  (let ((leading (gcd (car f) (car g))) (p (algebra-prime)) (found nil) (modulus 1))
    (loop
      (unless (zerop (mod (* (car f) (car g)) p))
        (let ((image (algebra-common-image f g leading p)))
          (cond ((null (cdr image)) (return '(1)))
                ((or (null found) (< (length image) (length found)))
                 (setq found (algebra-balanced image p) modulus p))
                ((= (length image) (length found))
                 (setq found (algebra-lifted found modulus image p) modulus (* modulus p))))
          (let ((divisor (algebra-leading-plus (algebra-primitive found))))
            (when (and (algebra-whole-quotient f divisor) (algebra-whole-quotient g divisor))
              (return divisor)))))
      #-sbcl (core-watch)
      (setq p ($prev_prime p)))))

(defun algebra-leading-plus (f) (if (minusp (car f)) (mapcar #'- f) f))

(defun algebra-common-image (f g leading p)
  "The divisor modulo P with the first coefficient LEADING."
  (flet ((image (f) (map 'simple-vector (lambda (c) (mod c p)) f)))
    (let* ((common (algebra-divisor-modulo (image f) (image g) p))
           (factor (mod (* leading (algebra-inverse-modulo (svref common 0) p)) p)))
      (map 'list (lambda (c) (mod (* factor c) p)) common))))

(defun algebra-divisor-modulo (u v p)
  (loop until (zerop (length v))
        do (psetq u v
                  v (algebra-rest-modulo u v p)))
  u)

(defun algebra-rest-modulo (u v p)
  "The remainder of U by V, vectors of residues, modulo P, without leading zeros."
  (declare (simple-vector u v) (fixnum p))
  (let* ((u (copy-seq u)) (m (length v)) (n (length u))
         (inverse (algebra-inverse-modulo (svref v 0) p)))
    (declare (fixnum m n inverse))
    (loop for i of-type fixnum from 0 to (- n m)
          for factor of-type fixnum = (mod (the fixnum (* (the fixnum (svref u i)) inverse)) p)
          unless (zerop factor)
            do (loop for k of-type fixnum from 1 below m
                     for c of-type fixnum = (svref v k)
                     do (setf (svref u (+ i k))
                              (mod (the fixnum (- (the fixnum (svref u (+ i k)))
                                                  (the fixnum (* factor c))))
                                   p))))
    (subseq u (or (position 0 u :start (max 0 (- n m -1)) :test-not #'eql) n))))

(defun algebra-balanced (residues modulus)
  "The whole numbers nearest to 0 that leave these RESIDUES."
  (mapcar (lambda (c) (if (> (* 2 c) modulus) (- c modulus) c)) residues))

(defun algebra-lifted (numbers modulus residues p)
  "The balanced numbers that leave NUMBERS modulo MODULUS and RESIDUES modulo P."
  (let ((inverse (algebra-inverse-modulo modulus p)))
    (algebra-balanced
     (loop for c in numbers
           for r in residues
           collect (mod (+ c (* modulus (mod (* inverse (- r c)) p))) (* modulus p)))
     (* modulus p))))

(defun algebra-whole-quotient (f g)
  "F/G where it has whole numbers, else nil."
  (let ((quotient '()))
    (loop while (>= (length f) (length g))
          do (multiple-value-bind (factor rest) (truncate (car f) (car g))
               (unless (zerop rest) (return-from algebra-whole-quotient nil))
               (push factor quotient)
               (setq f (cdr f))
               (unless (zerop factor)
                 (setq f (append (loop for a in f for b in (cdr g) collect (- a (* factor b)))
                                 (nthcdr (1- (length g)) f))))))
    (and (every #'zerop f) (nreverse quotient))))

(defun algebra-square-free-parts (f)
  "((part . multiplicity) ..) of F, of degree 1 at least; the parts have no multiple roots."
  (let* ((repeated (algebra-common-polynomial f (algebra-slope-numbers f)))
         (distinct (algebra-whole-quotient f repeated)))
    (loop for multiplicity from 1
          while (cdr distinct)
          for common = (algebra-common-polynomial distinct repeated)
          for part = (algebra-whole-quotient distinct common)
          when (cdr part) collect (cons part multiplicity)
          do (setq distinct common
                   repeated (algebra-whole-quotient repeated common)))))
