;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Minors of Hurwitz whose coefficients are single terms, as the generic ones a_0, a_1, ..: the
;;; polynomials are sorted vectors of monomials packed into one fixnum, and of whole numbers.  A
;;; product by a term adds to each monomial and keeps the order, so that the expansion by the last
;;; row is a merge of the smaller minors.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/general_form" "algebra/minors"))

(deftype algebra-packed-monomials () '(simple-array fixnum (*)))

(defstruct (algebra-packed (:conc-name algebra-packed-))
  (length 0 :type fixnum) ; of the vectors, which may be longer
  (monomials (make-array 0 :element-type 'fixnum) :type algebra-packed-monomials)
  (numbers (vector) :type simple-vector))

(defun algebra-packed-room (length)
  (make-algebra-packed :monomials (make-array length :element-type 'fixnum)
                       :numbers (make-array length)))

(defun algebra-packed-hurwitz (coefficients)
  "The leading minors of H_ij = a_(2j-i), or nil where the COEFFICIENTS, polynomials of the ring,
are not single terms or their monomials are too long."
  (let* ((n (1- (length coefficients)))
         (variables (algebra-packed-variables coefficients))
         (bits (integer-length (* n (reduce #'max coefficients :key #'algebra-term-degree))))
         (terms (and (every #'algebra-one-term-p coefficients)
                     (<= (* bits (length variables)) 60)
                     (mapcar (lambda (a) (algebra-packed-term a variables bits)) coefficients))))
    (and terms
         (loop for minor in (algebra-packed-leading n (coerce terms 'vector))
               collect (algebra-unpacked minor variables bits)))))

(defun algebra-packed-leading (n terms)
  "The last one is a_n times that before it."
  (let* ((known (make-hash-table :test #'eql))
         (minors (loop for k from 1 to (max 1 (1- n))
                       collect (algebra-packed-minor k (algebra-all-of k) terms known)))
         (last (aref terms n)))
    (append minors
            (and (> n 1)
                 (list (if (eql 0 (cdr last))
                           (algebra-packed-room 0)
                           (algebra-packed-sum (algebra-packed-room 0) (car last) (cdr last)
                                               (car (last minors)))))))))

(defun algebra-packed-variables (coefficients)
  "From low to high in the order of the ring."
  (let ((variables '()))
    (labels ((walk (p)
               (unless (atom p)
                 (pushnew (car p) variables :test #'eq)
                 (walk (caddr p)))))
      (mapc #'walk coefficients))
    (sort variables #'< :key #'symbol-value)))

(defun algebra-term-degree (p)
  "The largest exponent in a term."
  (if (atom p) 1 (max (cadr p) (algebra-term-degree (caddr p)))))

(defun algebra-packed-term (p variables bits)
  "(monomial . number)"
  (let ((monomial 0))
    (loop until (atom p)
          do (incf monomial (ash (cadr p) (* bits (position (car p) variables :test #'eq))))
             (setq p (caddr p)))
    (cons monomial p)))

(defun algebra-packed-minor (rows columns terms known)
  "Of the first ROWS rows and the set of COLUMNS, expanded by the last of these rows."
  (if (zerop rows)
      (make-algebra-packed :length 1 :numbers (vector 1)
                           :monomials (make-array 1 :element-type 'fixnum :initial-element 0))
      (or (gethash columns known)
          (setf (gethash columns known)
                (algebra-packed-expansion rows columns terms known)))))

(defun algebra-packed-expansion (rows columns terms known)
  (let ((sum (algebra-packed-room 0)) (sign (if (oddp rows) 1 -1)))
    (loop for j from 0 below (integer-length columns)
          when (logbitp j columns)
            do (let* ((place (- (* 2 (1+ j)) rows))
                      (term (and (< -1 place (length terms)) (aref terms place))))
                 (when (and term (not (eql 0 (cdr term))))
                   (setq sum (algebra-packed-sum
                              sum (car term) (* sign (cdr term))
                              (algebra-packed-minor (1- rows) (logxor columns (ash 1 j))
                                                    terms known))))
                 (setq sign (- sign))))
    sum))

(defun algebra-packed-sum (a monomial number b)
  "A + NUMBER*MONOMIAL*B, monomials descending."
  (declare (fixnum monomial))
  (let* ((xs (algebra-packed-monomials a)) (ps (algebra-packed-numbers a))
         (ys (algebra-packed-monomials b)) (qs (algebra-packed-numbers b))
         (m (algebra-packed-length a)) (n (algebra-packed-length b))
         (sum (algebra-packed-room (the fixnum (+ m n))))
         (zs (algebra-packed-monomials sum)) (rs (algebra-packed-numbers sum))
         (i 0) (j 0) (k 0))
    (declare (fixnum m n i j k))
    (flet ((times (q) (case number (1 q) (-1 (- q)) (t (* number q))))
           (put (z r)
             (setf (aref zs k) z (svref rs k) r)
             (incf k)))
      (declare (inline put times))
      (loop until (= j n)
            do (let ((y (the fixnum (+ monomial (aref ys j)))) (q (times (svref qs j))))
                 (declare (fixnum y))
                 (loop while (and (< i m) (> (aref xs i) y))
                       do (put (aref xs i) (svref ps i))
                          (incf i))
                 (cond ((and (< i m) (= (aref xs i) y))
                        (let ((r (+ q (svref ps i))))
                          (unless (eql r 0) (put y r)))
                        (incf i))
                       (t (put y q)))
                 (incf j)))
      (replace zs xs :start1 k :start2 i :end2 m)
      (replace rs ps :start1 k :start2 i :end2 m)
      (setf (algebra-packed-length sum) (+ k (- m i)))
      sum)))

;;; Back to Maxima's recursive form.

(defun algebra-unpacked (p variables bits)
  (let ((monomials (algebra-packed-monomials p)) (numbers (algebra-packed-numbers p))
        (mask (1- (ash 1 bits))))
    (declare (type (unsigned-byte 60) mask))
    (labels ((exponent (place shift)
               (declare (fixnum place) (type (integer 0 60) shift))
               (logand mask (ash (the (unsigned-byte 60) (aref monomials place)) (- shift))))
             (between (from to variables shift)
               "The terms from FROM to TO, which agree in all higher variables."
               (cond ((null variables) (svref numbers from))
                     (t (let ((powers (powers from to (cdr variables) shift)))
                          (if (eql 0 (car powers))
                              (cadr powers)
                              (cons (car variables) powers))))))
             (powers (from to variables shift)
               (declare (fixnum from to))
               (let ((n (exponent from shift)) (next (1+ from)))
                 (declare (fixnum next))
                 (loop while (and (< next to) (= n (the fixnum (exponent next shift))))
                       do (incf next))
                 (list* n (between from next variables (- shift bits))
                        (and (< next to) (powers next to variables shift))))))
      (declare (fixnum bits))
      (if (zerop (algebra-packed-length p))
          0
          (between 0 (algebra-packed-length p) (reverse variables)
                   (* bits (1- (length variables))))))))
