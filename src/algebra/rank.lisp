;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The rank of a matrix of expressions, and its null space.  At a point modulo a large prime
;;; (rational points of the circle for each angle) the rank r is a lower bound, with r rows and
;;; columns whose minor is not zero.  The rank is r when every minor of r + 1 rows that borders
;;; that one vanishes exactly.
;;; It begins with the null space.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/general_form" "algebra/kernels" "algebra/linear"
                "algebra/matrices" "algebra/minors" "algebra/modular" "algebra/relations"
                "algebra/zero"))

;;; Vectors v with M v = 0.  Rational M: the reduced echelon form modulo primes, put together to
;;; rational numbers, as few primes as these need.  The proof: M v = 0 exactly, and there are no
;;; more such vectors than modulo a prime, where the rank is not greater.  Other M: elimination
;;; with exact zero tests (linear.lisp).

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

;;; ---- rank

(defun $algebra_rank (m)
  (algebra-check-matrix m "the matrix of a rank")
  (with-algebra-ring
    (let* ((matrix (algebra-rank-matrix m))
           (minor (algebra-point-minor matrix)))
      (algebra-border matrix (car minor) (cdr minor)))))

(defun $algebra_least_rank (m)
  "A lower bound of the rank, that at a point; no minor is formed."
  (algebra-check-matrix m "the matrix of a rank")
  (with-algebra-ring
    (length (car (algebra-point-minor (algebra-rank-matrix m))))))

(defun algebra-rank-matrix (m)
  "Its rows without denominators, in the ring at hand."
  (with-algebra-zero-form
    (algebra-rectangle (mapcar (lambda (row) (nth-value 0 (algebra-common-denominator row)))
                               (algebra-matrix-quotients m)))))

(defun algebra-border (matrix rows columns)
  "The rank, from the ROWS and COLUMNS of a minor that does not vanish."
  (dotimes (i (array-dimension matrix 0) (length rows))
    (unless (member i rows)
      (dotimes (j (array-dimension matrix 1))
        (unless (member j columns)
          (unless (algebra-minor-zero-p matrix (cons i rows) (cons j columns))
            (return-from algebra-border
              (algebra-border matrix (cons i rows) (cons j columns)))))))))

(defun algebra-minor-zero-p (matrix rows columns)
  (let ((minor (algebra-reduce
                (algebra-determinant-polynomial
                 (algebra-rectangle
                  (loop for i in rows
                        collect (loop for j in columns collect (aref matrix i j))))))))
    (or (pzerop (car minor))
        (case (algebra-polynomial-test (car minor))
          (zero t)
          (not-zero nil)
          (t (if (algebra-nonzero-somewhere-p (algebra-general (car minor)))
                 nil
                 (algebra-zero-undecided (algebra-general (car minor)))))))))

;;; A point modulo a prime.

(defun algebra-point-minor (matrix)
  "(rows . columns) of a minor that does not vanish at a point; none if some kernel has no value."
  (if (every #'algebra-kernel-sure (algebra-ring-kernels *algebra-ring*))
      (multiple-value-bind (echelon rows)
          (algebra-echelon-modulo (algebra-modular-rows matrix (algebra-modular-point 20011))
                                  (algebra-prime))
        (cons rows (mapcar #'car echelon)))
      '(nil)))

(defun algebra-modular-rows (matrix point)
  (loop for i below (array-dimension matrix 0)
        collect (loop for j below (array-dimension matrix 1)
                      collect (algebra-modular-value (aref matrix i j) point))))
