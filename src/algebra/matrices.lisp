;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Matrices of expressions as arrays of polynomials: rows are freed of denominators, and of
;;; monomials common to a row or a column, M = diag(r) . M' . diag(c). Then
;;; det M = prod(r)*prod(c)*det M', adj(M)_ij = prod(c without i)*prod(r without j)*adj(M')_ij:
;;; mass matrices of chains lose all their lengths this way before their minors are formed.
;;; It begins with the signature of a symmetric form.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/evaluate" "algebra/normal" "algebra/quotient" "algebra/scan"
                "algebra/sign" "algebra/size" "algebra/zero"))

;;; The signature of a symmetric form by Lagrange: a square is split off where a coefficient a_kk
;;; is not 0, a_ij - a_ik*a_kj/a_kk is a form without x_k. The arithmetic is that of rationals or
;;; of expressions, whose signs are known or not.

(defstruct (algebra-form (:conc-name algebra-form-) (:predicate nil))
  rows    ; a vector of vectors, which are changed
  sign    ; of a coefficient: 1 and -1 where it is known
  zero    ; whether a coefficient vanishes identically
  divide  ; (a b): a/b
  less)   ; (a f b): a - f*b

(defun algebra-signature (form)
  "(positive negative vanishing) squares; nil where signs are not known."
  (let ((left (loop for i below (length (algebra-form-rows form)) collect i))
        (signs '()))
    (loop for pivot = (algebra-form-pivot form left)
          while pivot
          do (push (funcall (algebra-form-sign form) (algebra-form-entry form pivot pivot)) signs)
             (setq left (remove pivot left))
             (algebra-split-square form pivot left))
    (when (algebra-form-vanishes-p form left)
      (list (count 1 signs) (count -1 signs) (length left)))))

(defun algebra-form-vanishes-p (form left)
  (loop for i in left
        always (loop for j in left
                     always (funcall (algebra-form-zero form) (algebra-form-entry form i j)))))

(defun algebra-form-entry (form i j) (aref (aref (algebra-form-rows form) i) j))

(defun algebra-form-pivot (form left)
  "An index whose square has a known sign, made so by adding one row and column to another."
  (flet ((known-p (i j) (member (funcall (algebra-form-sign form) (algebra-form-entry form i j))
                                '(1 -1)))
         (zero-p (i) (funcall (algebra-form-zero form) (algebra-form-entry form i i))))
    (or (loop for i in left when (known-p i i) return i)
        (loop for (i . others) on left
              when (zero-p i)
                do (loop for j in others
                         when (and (known-p i j) (zero-p j))
                           do (algebra-add-index form i j)
                              (return-from algebra-form-pivot i))))))

(defun algebra-add-index (form i j)
  (let* ((rows (algebra-form-rows form)) (row (aref rows i)))
    (flet ((plus (a b) (funcall (algebra-form-less form) a -1 b)))
      (dotimes (k (length rows)) (setf (aref row k) (plus (aref row k) (aref (aref rows j) k))))
      (dotimes (k (length rows))
        (setf (aref (aref rows k) i) (plus (aref (aref rows k) i) (aref (aref rows k) j)))))))

(defun algebra-split-square (form pivot left)
  (dolist (i left)
    (let ((row (aref (algebra-form-rows form) i))
          (factor (funcall (algebra-form-divide form) (algebra-form-entry form i pivot)
                           (algebra-form-entry form pivot pivot))))
      (unless (eql factor 0)
        (dolist (j left)
          (setf (aref row j) (funcall (algebra-form-less form) (aref row j) factor
                                      (algebra-form-entry form pivot j))))))))

;;; The two arithmetics

(defun algebra-rational-form (rows &optional (divide #'/))
  (make-algebra-form :rows rows :sign #'signum :zero #'zerop :divide divide
                     :less (lambda (a f b) (- a (* f b)))))

(defun algebra-expression-form (rows)
  (make-algebra-form :rows rows
                     :sign (lambda (e) (case ($algebra_sign e) ($pos 1) ($neg -1)))
                     :zero (lambda (e) (eq t ($algebra_zerop e)))
                     :divide #'div
                     :less (lambda (a f b) ($algebra_normal (sub a (mul f b))))))

(defun $algebra_signature (matrix)
  "[positive, negative, zero] eigenvalues of a symmetric MATRIX; false where signs are not known."
  (let* ((entries (mapcar #'cdr (cdr matrix)))
         (numbers (mapcar (lambda (row) (mapcar #'algebra-rational-number row)) entries))
         (rational (notany (lambda (row) (member nil row)) numbers))
         (rows (map 'vector (lambda (row) (coerce row 'vector)) (if rational numbers entries)))
         (signature (algebra-signature (if rational
                                           (algebra-rational-form rows)
                                           (algebra-expression-form rows)))))
    (and signature (cons '(mlist simp) signature))))

;;; ---- matrices

(defun algebra-check-square (m what)
  (algebra-check-matrix m what)
  (unless (= (length (cdr m)) (length (cdadr m)))
    (core-error "~A must be square, it is ~A by ~A" what (length (cdr m)) (length (cdadr m)))))

(defun algebra-check-matrix (m what)
  (unless (and ($matrixp m) (cdr m) (cdadr m))
    (core-error "~A must be a matrix, found ~A" what (algebra-short-text m))))

(defun $algebra_from_rows (rows)
  "The matrix of a list of ROWS. (A call of matrix has at most 64 of them on GCL.)"
  (cons '($matrix simp) (cdr rows)))

(defun $algebra_congruent (h n)
  "The normal entries of transpose(N).H.N."
  (let* ((columns (cdr ($transpose n)))
         (images (loop for column in columns
                       collect (cons '(mlist simp)
                                     (loop for row in (cdr h) collect ($algebra_dot row column))))))
    (cons '($matrix simp)
          (loop for column in columns
                collect (cons '(mlist simp)
                              (loop for image in images
                                    collect (algebra-normal-form
                                             ($algebra_dot column image))))))))

(defun $algebra_dot (list-1 list-2)
  "The scalar product of two lists, 0 for empty ones."
  (addn (mapcar #'mul (cdr list-1) (cdr list-2)) nil))

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

;;; Blocks: indices that entries join.

(defun algebra-blocks (rows)
  "Ascending lists of indices from 0: entries i,j and j,i of different lists are written 0."
  (let ((entries (algebra-rectangle rows))
        (waiting (loop for i below (length rows) collect i)))
    (loop while waiting
          collect (let ((joined (algebra-joined (list (car waiting)) entries)))
                    (setq waiting (remove-if (lambda (i) (member i joined)) waiting))
                    (sort joined #'<)))))

(defun algebra-joined (indices entries)
  (flet ((apart-p (i j) (and (eql 0 (aref entries i j)) (eql 0 (aref entries j i)))))
    (let ((next (loop for j below (array-dimension entries 0)
                      unless (or (member j indices)
                                 (every (lambda (i) (apart-p i j)) indices))
                        collect j)))
      (if next (algebra-joined (append next indices) entries) indices))))

(defun $algebra_blocks (matrix)
  "Lists of indices from 1 that no entry of a square MATRIX joins."
  (cons '(mlist simp)
        (loop for block in (algebra-blocks (mapcar #'cdr (cdr matrix)))
              collect (cons '(mlist simp) (mapcar #'1+ block)))))

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
