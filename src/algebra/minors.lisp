;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Determinants, adjugates and leading minors by memoised minors: the minor of the first k rows in
;;; the columns S is the sum over j in S of +- a_kj * minor(k-1, S without j), each computed once;
;;; S is a set of bits.  Rows are freed of denominators first, so that all arithmetic is in
;;; polynomials.  Large matrices go by fraction-free elimination (Bareiss).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/reduction" "algebra/contents"
                "algebra/normal"))

;;; Matrices of expressions, of quotients, of polynomials.

(defun algebra-check-square (m what)
  (algebra-check-matrix m what)
  (unless (= (length (cdr m)) (length (cdadr m)))
    (core-error "~A must be square, it is ~A by ~A" what (length (cdr m)) (length (cdadr m)))))

(defun algebra-check-matrix (m what)
  (unless (and ($matrixp m) (cdr m) (cdadr m))
    (core-error "~A must be a matrix, found ~A" what (algebra-short-text m))))

(defun algebra-scan-rows (m)
  (loop for row in (cdr m) collect (mapcar #'algebra-scan (cdr row))))

(defun algebra-quotients (expressions)
  "Their quotients in the ring, which is put in order."
  (let ((skeletons (mapcar #'algebra-scan expressions)))
    (algebra-order-kernels)
    (mapcar #'algebra-evaluate skeletons)))

(defun algebra-matrix-quotients (m)
  (let ((rows (algebra-scan-rows m)))
    (algebra-order-kernels)
    (loop for row in rows collect (mapcar #'algebra-evaluate row))))

(defun algebra-common-denominator (quotients)
  "Polynomials p_i and d with quotient i = p_i/d."
  (let ((d 1))
    (dolist (quotient quotients) (setq d (algebra-poly-lcm d (cdr quotient))))
    (values (loop for (above . below) in quotients
                  collect (ptimes above (pquotient d below)))
            d)))

(defun algebra-poly-lcm (a b)
  (cond ((eql a 1) b)
        ((eql b 1) a)
        (t (ptimes a (pquotient b (algebra-gcd a b))))))

(defun algebra-clear-rows (rows)
  "A square array of polynomials, and the product of the rows' denominators."
  (let ((product 1))
    (values (algebra-square-array
             (loop for row in rows
                   collect (multiple-value-bind (polynomials d) (algebra-common-denominator row)
                             (setq product (ptimes product d))
                             polynomials)))
            product)))

(defun algebra-square-array (rows)
  (let ((n (length rows)))
    (make-array (list n n) :initial-contents rows)))

;;; Memoised minors.

(defun algebra-minor-table (matrix)
  "A function of (k columns): the minor of rows 0 .. k-1 in the set of COLUMNS."
  (let ((known (make-hash-table :test #'eql))
        (terms 0))
    (labels ((minor (k columns)
               (if (zerop k)
                   1
                   (or (gethash columns known)
                       (setf (gethash columns known) (counted (expanded (1- k) columns))))))
             (counted (minor)
               (incf terms (algebra-monomials minor))
               (algebra-guard terms "the minors of a determinant" "put in what is known of them")
               minor)
             (expanded (row columns)
               (algebra-reduce-angles
                (algebra-expanded-row matrix row columns
                                      (lambda (j) (minor row (logandc2 columns (ash 1 j))))))))
      #'minor)))

(defun algebra-expanded-row (matrix row columns minor-without)
  "The sum over the COLUMNS of +- entry * minor without its column."
  (let ((sum 0)
        (sign (if (evenp row) 1 -1)))
    (dotimes (j (array-dimension matrix 0) sum)
      (when (logbitp j columns)
        (let ((entry (aref matrix row j)))
          (unless (pzerop entry)
            (setq sum (pplus sum (algebra-guarded-times (ptimes sign entry)
                                                        (funcall minor-without j))))))
        (setq sign (- sign))))))

(defun algebra-leading-minor-polynomials (matrix)
  (let ((minor (algebra-minor-table matrix)))
    (loop for k from 1 to (array-dimension matrix 0)
          collect (funcall minor k (1- (ash 1 k))))))

(defun algebra-determinant-polynomial (matrix)
  (let* ((n (array-dimension matrix 0))
         (balanced (algebra-copy-array matrix))
         (content (algebra-poly-product (append (algebra-row-contents balanced)
                                                (algebra-column-contents balanced)))))
    (ptimes content
            (if (algebra-eliminate-p matrix)
                (algebra-bareiss balanced)
                (funcall (algebra-minor-table balanced) n (1- (ash 1 n)))))))

(defun algebra-eliminate-p (matrix)
  "Large and full: minors are too many."
  (let* ((n (array-dimension matrix 0))
         (filled (loop for i below n
                       sum (loop for j below n count (not (pzerop (aref matrix i j)))))))
    (and (> n 10) (> filled (* 4 n)))))

(defun algebra-quotient-determinant (rows)
  (multiple-value-bind (matrix denominator) (algebra-clear-rows rows)
    (let ((determinant (algebra-determinant-polynomial matrix)))
      (algebra-quotient-of determinant denominator))))

;;; Fraction-free elimination.

(defun algebra-bareiss (matrix)
  (let* ((n (array-dimension matrix 0))
         (a (algebra-copy-array matrix))
         (previous 1)
         (sign 1))
    (dotimes (k (1- n))
      (let ((pivot (algebra-shortest-pivot a k)))
        (unless pivot (return-from algebra-bareiss 0))
        (unless (= pivot k)
          (algebra-swap-rows a k pivot)
          (setq sign (- sign))))
      (loop for i from (1+ k) below n
            do (loop for j from (1+ k) below n
                     do (setf (aref a i j) (algebra-bareiss-entry a i j k previous))))
      (setq previous (aref a k k)))
    (ptimes sign (aref a (1- n) (1- n)))))

(defun algebra-bareiss-entry (a i j k previous)
  (pquotient (pdifference (algebra-guarded-times (aref a i j) (aref a k k))
                          (algebra-guarded-times (aref a i k) (aref a k j)))
             previous))

(defun algebra-guarded-times (p q)
  (unless (or (algebra-one-term-p p) (algebra-one-term-p q))
    (algebra-guard-product p q))
  (ptimes p q))

(defun algebra-copy-array (matrix)
  (let* ((n (array-dimension matrix 0))
         (copy (make-array (list n n))))
    (dotimes (i n copy)
      (dotimes (j n)
        (setf (aref copy i j) (aref matrix i j))))))

(defun algebra-shortest-pivot (a k)
  (let ((rows (loop for i from k below (array-dimension a 0)
                    unless (algebra-vanishes-p (aref a i k)) collect i)))
    (if rows
        (algebra-least rows (lambda (i) (algebra-poly-size (aref a i k)))))))

(defun algebra-swap-rows (a i k)
  (dotimes (j (array-dimension a 0))
    (rotatef (aref a i j) (aref a k j))))

;;; What Maxima calls.

(defun $algebra_determinant (m)
  (algebra-check-square m "the matrix of a determinant")
  (with-algebra-ring
    (algebra-general-reduced (algebra-quotient-determinant (algebra-matrix-quotients m)))))

(defun $algebra_leading_minors (m)
  (algebra-check-square m "the matrix of leading minors")
  (with-algebra-ring
    (let ((rows (algebra-matrix-quotients m)) (denominator 1))
      (multiple-value-bind (matrix) (algebra-clear-rows rows)
        (cons '(mlist simp)
              (loop for minor in (algebra-leading-minor-polynomials matrix)
                    for row in rows
                    do (setq denominator
                             (ptimes denominator
                                     (nth-value 1 (algebra-common-denominator row))))
                    collect (algebra-general-reduced (cons minor denominator))))))))

(defun $algebra_adjugate (m)
  (algebra-check-square m "the matrix of an adjugate")
  (with-algebra-ring
    (let ((rows (algebra-matrix-quotients m)))
      (multiple-value-bind (polynomials denominators) (algebra-row-denominators rows)
        (algebra-adjugate-matrix (algebra-cofactors (algebra-square-array polynomials))
                                 denominators)))))

(defun algebra-row-denominators (rows)
  (loop for row in rows
        for (polynomials d) = (multiple-value-list (algebra-common-denominator row))
        collect polynomials into matrix
        collect d into denominators
        finally (return (values matrix denominators))))

(defun algebra-cofactors (matrix)
  "The array of (-1)^(i+j) * minor without row i and column j."
  (let* ((balanced (algebra-copy-array matrix))
         (rows (algebra-row-contents balanced))
         (columns (algebra-column-contents balanced))
         (cofactors (algebra-balanced-cofactors balanced))
         (n (array-dimension matrix 0)))
    (dotimes (i n cofactors)
      (dotimes (j n)
        (setf (aref cofactors i j)
              (ptimes (ptimes (algebra-product-without rows i)
                              (algebra-product-without columns j))
                      (aref cofactors i j)))))))

(defun algebra-balanced-cofactors (matrix)
  (let* ((n (array-dimension matrix 0))
         (all (1- (ash 1 n)))
         (symmetric (algebra-symmetric-p matrix))
         (cofactors (make-array (list n n))))
    (loop for i from (1- n) downto 0
          do (let ((minor (algebra-minor-table (algebra-row-last matrix i))))
               (dotimes (j n)
                 (setf (aref cofactors i j)
                       (if (and symmetric (> j i))
                           (aref cofactors j i)
                           (let ((value (funcall minor (1- n) (logandc2 all (ash 1 j)))))
                             (if (evenp (+ i j)) value (pminus value))))))))
    cofactors))

(defun algebra-row-last (matrix row)
  "MATRIX with ROW moved to the end."
  (let* ((n (array-dimension matrix 0))
         (moved (make-array (list n n))))
    (dotimes (i n moved)
      (let ((source (cond ((= i (1- n)) row) ((< i row) i) (t (1+ i)))))
        (dotimes (j n)
          (setf (aref moved i j) (aref matrix source j)))))))

(defun algebra-adjugate-matrix (cofactors denominators)
  "Cofactors of the cleared rows, each over the denominators of the rows it comes from."
  (let* ((n (array-dimension cofactors 0))
         (symmetric (and (algebra-symmetric-p cofactors) (every #'onep1 denominators)))
         (entries (make-array (list n n))))
    (dotimes (i n)
      (dotimes (j n)
        (setf (aref entries i j)
              (if (and symmetric (< j i))
                  (aref entries j i)
                  (algebra-general-reduced
                   (cons (aref cofactors j i) (algebra-product-without denominators j)))))))
    (algebra-array-matrix entries)))

(defun algebra-array-matrix (entries)
  (cons '($matrix simp)
        (loop for i below (array-dimension entries 0)
              collect (cons '(mlist simp)
                            (loop for j below (array-dimension entries 1)
                                  collect (aref entries i j))))))
