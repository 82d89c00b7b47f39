;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Matrices of expressions become arrays of polynomials: rows are freed of denominators, and of
;;; monomials common to a row or a column, M = diag(r) . M' . diag(c). Then
;;; det M = prod(r)*prod(c)*det M', adj(M)_ij = prod(c without i)*prod(r without j)*adj(M')_ij:
;;; mass matrices of chains lose all their lengths this way before their minors are formed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common" "algebra/quotient" "algebra/scan" "algebra/evaluate"))

(defun algebra-check-square (m what)
  (algebra-check-matrix m what)
  (unless (= (length (cdr m)) (length (cdadr m)))
    (core-error "~A must be square, it is ~A by ~A" what (length (cdr m)) (length (cdadr m)))))

(defun algebra-check-matrix (m what)
  (unless (and ($matrixp m) (cdr m) (cdadr m))
    (core-error "~A must be a matrix, found ~A" what (algebra-short-text m))))

;;; Expressions, quotients, polynomials.

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
    (values (algebra-rectangle
             (loop for row in rows
                   collect (multiple-value-bind (polynomials d) (algebra-common-denominator row)
                             (setq product (ptimes product d))
                             polynomials)))
            product)))

(defun algebra-row-denominators (rows)
  (loop for row in rows
        for (polynomials d) = (multiple-value-list (algebra-common-denominator row))
        collect polynomials into matrix
        collect d into denominators
        finally (return (values matrix denominators))))

;;; Arrays.

(defun algebra-rectangle (rows)
  (make-array (list (length rows) (length (car rows))) :initial-contents rows))

(defun algebra-copy-array (matrix)
  (let* ((n (array-dimension matrix 0))
         (copy (make-array (list n n))))
    (dotimes (i n copy)
      (dotimes (j n)
        (setf (aref copy i j) (aref matrix i j))))))

(defun algebra-swap-rows (a i k)
  (dotimes (j (array-dimension a 0))
    (rotatef (aref a i j) (aref a k j))))

(defun algebra-symmetric-p (matrix)
  (let ((n (array-dimension matrix 0)))
    (dotimes (i n t)
      (dotimes (j i)
        (unless (equal (aref matrix i j) (aref matrix j i))
          (return-from algebra-symmetric-p nil))))))

(defun algebra-array-matrix (entries)
  (cons '($matrix simp)
        (loop for i below (array-dimension entries 0)
              collect (cons '(mlist simp)
                            (loop for j below (array-dimension entries 1)
                                  collect (aref entries i j))))))

;;; Monomials of rows and columns.

(defun algebra-row-contents (matrix) (algebra-contents matrix t))

(defun algebra-column-contents (matrix) (algebra-contents matrix nil))

(defun algebra-contents (matrix of-rows)
  "Divide MATRIX in place by the contents of its rows, or of its columns; these are returned."
  (let ((n (array-dimension matrix 0)))
    (flet ((entry (line k) (if of-rows (aref matrix line k) (aref matrix k line)))
           (put-entry (p line k)
             (if of-rows (setf (aref matrix line k) p) (setf (aref matrix k line) p))))
      (loop for line below n
            collect (let ((content (algebra-common-monomial-of
                                    (loop for k below n collect (entry line k)))))
                      (dotimes (k n content)
                        (put-entry (algebra-divided (entry line k) content) line k)))))))

(defun algebra-common-monomial-of (polynomials)
  "The common monomial of POLYNOMIALS, zeros left aside, as a polynomial."
  (let ((common 'none))
    (dolist (p polynomials)
      (unless (pzerop p)
        (setq common (algebra-common-monomial common (algebra-monomial p)))))
    (algebra-monomial-polynomial (if (eq common 'none) nil common))))

(defun algebra-poly-product (polynomials)
  (let ((product 1))
    (dolist (p polynomials product)
      (setq product (ptimes product p)))))

(defun algebra-product-without (polynomials place)
  (algebra-poly-product (loop for p in polynomials
                              for k from 0
                              unless (= k place) collect p)))
