;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Vectors v with M v = 0.  Rational M: the reduced echelon form modulo primes, put together to
;;; rational numbers, as few primes as these need.  The proof: M v = 0 exactly, and there are no
;;; more such vectors than modulo a prime, where the rank is not greater.  Other M: elimination
;;; with exact zero tests (linear.lisp).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common" "algebra/linear" "algebra/modular" "algebra/zero"))

(defun $algebra_null_space (m)
  "A basis, a list of lists: in each one of the free unknowns is 1, the other free ones are 0."
  (let ((rows (mapcar #'cdr (cdr m))))
    (cons '(mlist simp)
          (loop for v in (if (every (lambda (row) (every #'algebra-rational-number row)) rows)
                             (algebra-rational-null-space (mapcar #'algebra-whole-row rows))
                             (algebra-general-null-space rows))
                collect (cons '(mlist simp) v)))))

;;; Entries of any kind.

(defun algebra-general-null-space (rows)
  (let* ((columns (length (car rows)))
         (echelon (algebra-echelon rows columns))
         (pivots (loop for row in echelon
                       for place = (position-if-not #'algebra-decided-zero-p row)
                       when place collect (cons place row))))
    (loop for free below columns
          unless (assoc free pivots)
            collect (loop for k below columns
                          for row = (cdr (assoc k pivots))
                          collect (cond (row (mul -1 (nth free row)))
                                        ((= k free) 1)
                                        (t 0))))))

;;; Whole numbers, modulo one prime after the other.

(defun algebra-whole-row (row)
  (algebra-without-fractions (mapcar #'algebra-rational-number row)))

(defun algebra-null-vectors (echelon columns)
  "One list of residues; the vectors of the null space one after the other."
  (loop for free below columns
        unless (assoc free echelon)
          append (loop for k below columns
                       for row = (cdr (assoc k echelon))
                       collect (cond (row (- (svref row free)))
                                     ((= k free) 1)
                                     (t 0)))))

;;; Together: residues modulo the product of the primes, rational numbers from these.

(defun algebra-joined-residues (residues modulus more p)
  "Chinese remainders."
  (let ((inverse (algebra-inverse-modulo modulus p)))
    (loop for r in residues
          for s in more
          collect (+ r (* modulus (mod (* (- s r) inverse) p))))))

(defun algebra-rational-of-residue (r modulus)
  "n/d = R modulo MODULUS with |n| and d below the square root of half of it, or nil."
  (let ((bound (isqrt (floor modulus 2))) (a modulus) (b (mod r modulus)) (s 0) (d 1))
    (loop while (> b bound)
          do (let ((q (floor a b)))
               (psetq a b b (- a (* q b)) s d d (- s (* q d)))))
    (if (<= 1 (abs d) bound) (/ b d))))

(defun algebra-rational-vectors (residues modulus columns)
  "The vectors, or nil where more primes are needed."
  (let ((numbers (loop for r in residues
                       collect (or (algebra-rational-of-residue r modulus) (return nil)))))
    (loop while numbers
          collect (subseq numbers 0 columns)
          do (setq numbers (nthcdr columns numbers)))))

(defun algebra-null-vector-p (rows v)
  (loop for row in rows always (zerop (reduce #'+ (mapcar #'* row v)))))

(defun algebra-better-echelon-p (columns others)
  "Whether the pivots COLUMNS show that the prime of OTHERS is a bad one."
  (or (> (length columns) (length others))
      (and (= (length columns) (length others))
           (loop for x in columns for y in others
                 do (cond ((< x y) (return t)) ((> x y) (return nil)))))))

(defun algebra-rational-null-space (rows)
  (let ((columns (length (car rows))) (p (expt 2 30)) (pivots nil) (residues nil) (modulus 1))
    (loop for count from 1
          do (setq p ($prev_prime p))
             (let* ((echelon (algebra-echelon-modulo rows p))
                    (found (mapcar #'car echelon))
                    (vectors (algebra-null-vectors echelon columns)))
               (when (or (= count 1) (algebra-better-echelon-p found pivots))
                 (setq pivots found modulus 1 residues (mapcar (constantly 0) vectors)))
               (when (equal found pivots)
                 (setq residues (algebra-joined-residues residues modulus vectors p)
                       modulus (* modulus p))
                 (let ((answer (algebra-rational-vectors residues modulus columns)))
                   (when (and (or answer (null residues))
                              (every (lambda (v) (algebra-null-vector-p rows v)) answer))
                     (return (loop for v in answer
                                   collect (mapcar #'algebra-maxima-rational v))))))))))
