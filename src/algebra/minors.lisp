;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Determinants, adjugates and leading minors by one expansion, algebra-minors: the minor of the
;;; rows R and the columns S is the sum over j in S of +- a_ij * minor(R without i, S without j),
;;; each computed once.  Here the row i is the last of R, so that leading minors are shared, and the
;;; arithmetic is that of polynomials; linear.lisp expands expressions and lengths, and so does
;;; Legendre's transformation.  Large matrices go by fraction-free elimination (Bareiss).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/relations" "algebra/matrices"
                "algebra/normal" "algebra/general_form" "algebra/quotient"))

;;; The expansion. Sets of rows and of columns are bits of integers.

(defun algebra-minors (matrix row times plus &optional (made #'identity))
  "The function of a set of rows and a set of columns that gives their minor: MADE of the sum by
PLUS of the products by TIMES of sign, element and smaller minor; 1 where the sets are empty, 0
where there are no products.  ROW takes from a set of rows the one to expand by."
  (let ((known (make-hash-table :test #'eql)) (m (array-dimension matrix 1)))
    (labels ((minor (rows columns)
               (if (zerop rows)
                   1
                   (let ((key (logior (ash rows m) columns)))
                     (or (gethash key known)
                         (setf (gethash key known) (expanded rows columns (funcall row rows)))))))
             (expanded (rows columns i)
               (let ((others (logxor rows (ash 1 i))) (sum nil) (sign (algebra-row-sign i rows)))
                 (dotimes (j m (if sum (funcall made sum) 0))
                   (when (logbitp j columns)
                     (let ((product (product i j others columns sign)))
                       (when product (setq sum (if sum (funcall plus sum product) product))))
                     (setq sign (- sign))))))
             (product (i j others columns sign)
               (let ((entry (aref matrix i j)))
                 (unless (eql entry 0)
                   (let ((smaller (minor others (logxor columns (ash 1 j)))))
                     (unless (eql smaller 0) (funcall times sign entry smaller)))))))
      #'minor)))

(defun algebra-row-sign (i rows)
  "The sign of an expansion by row I, one of ROWS."
  (if (evenp (logcount (logand rows (algebra-all-of i)))) 1 -1))

(defun algebra-last-row (rows) (1- (integer-length rows)))

(defun algebra-first-row (rows) (1- (integer-length (logand rows (- rows)))))

(defun algebra-all-of (n) (1- (ash 1 n)))

(defun algebra-all-but (k n) (logxor (ash 1 k) (algebra-all-of n)))

;;; Polynomials.

(defvar *algebra-minor-terms* 0 "how many terms the minors have together")

(defun algebra-polynomial-minors (matrix)
  (algebra-minors matrix #'algebra-last-row
                  (lambda (sign entry minor) (algebra-guarded-times (ptimes sign entry) minor))
                  #'pplus
                  (lambda (sum) (algebra-counted-minor (algebra-reduce-angles sum)))))

(defun algebra-counted-minor (minor)
  (incf *algebra-minor-terms* (algebra-monomials minor))
  (algebra-guard *algebra-minor-terms* "the minors of a determinant"
                 "put in what is known of them")
  minor)

(defun algebra-guarded-times (p q)
  (unless (or (algebra-one-term-p p) (algebra-one-term-p q))
    (algebra-guard-product p q))
  (ptimes p q))

(defun algebra-leading-minor-polynomials (matrix)
  (let ((minor (algebra-polynomial-minors matrix)) (*algebra-minor-terms* 0))
    (loop for k from 1 to (array-dimension matrix 0)
          collect (funcall minor (algebra-all-of k) (algebra-all-of k)))))

(defun algebra-determinant-polynomial (matrix)
  (let* ((balanced (algebra-copy-array matrix))
         (content (algebra-poly-product (append (algebra-row-contents balanced)
                                                (algebra-column-contents balanced)))))
    (ptimes content
            (if (algebra-eliminate-p matrix)
                (algebra-bareiss balanced)
                (algebra-expanded-determinant balanced)))))

(defun algebra-expanded-determinant (matrix)
  (let ((all (algebra-all-of (array-dimension matrix 0))) (*algebra-minor-terms* 0))
    (funcall (algebra-polynomial-minors matrix) all all)))

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

(defun algebra-eliminated-leading-minors (matrix)
  "The pivots where no rows change places; nil where one vanishes before the last."
  (let* ((n (array-dimension matrix 0)) (a (algebra-copy-array matrix)) (previous 1)
         (minors (list (aref a 0 0))))
    (dotimes (k (1- n) (nreverse minors))
      (when (algebra-zero-polynomial-p (aref a k k))
        (return-from algebra-eliminated-leading-minors nil))
      (loop for i from (1+ k) below n
            do (loop for j from (1+ k) below n
                     do (setf (aref a i j) (algebra-bareiss-entry a i j k previous))))
      (setq previous (aref a k k))
      (push (aref a (1+ k) (1+ k)) minors))))

(defun algebra-bareiss-entry (a i j k previous)
  (pquotient (pdifference (algebra-guarded-times (aref a i j) (aref a k k))
                          (algebra-guarded-times (aref a i k) (aref a k j)))
             previous))

(defun algebra-shortest-pivot (a k)
  (let ((rows (loop for i from k below (array-dimension a 0)
                    unless (algebra-zero-polynomial-p (aref a i k)) collect i)))
    (if rows
        (algebra-least rows (lambda (i) (algebra-poly-size (aref a i k)))))))

;;; Cofactors.

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
         (minor (algebra-polynomial-minors matrix))
         (symmetric (algebra-symmetric-p matrix))
         (cofactors (make-array (list n n))))
    (flet ((cofactor (i j)
             (let ((value (funcall minor (algebra-all-but i n) (algebra-all-but j n))))
               (if (evenp (+ i j)) value (pminus value)))))
      (loop for i from (1- n) downto 0
            do (let ((*algebra-minor-terms* 0))
                 (dotimes (j n)
                   (setf (aref cofactors i j)
                         (if (and symmetric (> j i)) (aref cofactors j i) (cofactor i j)))))))
    cofactors))

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
              (loop for minor in (or (and (algebra-eliminate-p matrix)
                                          (algebra-eliminated-leading-minors matrix))
                                     (algebra-leading-minor-polynomials matrix))
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
        (algebra-adjugate-matrix (algebra-cofactors (algebra-rectangle polynomials))
                                 denominators)))))

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
