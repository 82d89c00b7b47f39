;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Numbers and expressions as coefficients of sparse rows: rational numbers of Lisp, which cost
;;; nothing, or expressions of Maxima. A sum of expressions is brought to its canonical form, so
;;; that what vanishes is 0; what is not decided ends in an error.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "algebra/size" "algebra/zero"))

(defun circuits-inside (e)
  "E as a coefficient."
  (or (algebra-rational-number e) e))

(defun circuits-outside (x)
  "The coefficient X as an expression."
  (if (rationalp x) (algebra-maxima-rational x) x))

(defun circuits-nothing-p (x) (eql x 0))

(defun circuits-plus (x y)
  (cond ((eql x 0) y)
        ((eql y 0) x)
        ((and (rationalp x) (rationalp y)) (+ x y))
        (t (circuits-settled (add (circuits-outside x) (circuits-outside y))))))

(defun circuits-settled (e)
  "The canonical form of the sum E as a coefficient."
  (let ((x (circuits-inside (if (mplusp e) (algebra-normal-form e) e))))
    (if (or (rationalp x) (circuits-rational-function-p x) (not (algebra-decided-zero-p x))) x 0)))

(defun circuits-rational-function-p (e)
  "Whether the canonical form of E is 0 where it vanishes: sums, products, whole powers of names."
  (cond ((atom e) (or (not (floatp e)) (algebra-decimal e)))
        ((eq (caar e) 'rat) t)
        ((member (caar e) '(mplus mtimes)) (every #'circuits-rational-function-p (cdr e)))
        ((mexptp e) (and (integerp (caddr e)) (circuits-rational-function-p (cadr e))))))

(defun circuits-times (x y)
  (cond ((or (eql x 0) (eql y 0)) 0)
        ((eql x 1) y)
        ((eql y 1) x)
        ((and (rationalp x) (rationalp y)) (* x y))
        (t (circuits-inside (mul (circuits-outside x) (circuits-outside y))))))

(defun circuits-over (x y)
  (cond ((eql y 1) x)
        ((and (rationalp x) (rationalp y)) (/ x y))
        (t (circuits-inside (div (circuits-outside x) (circuits-outside y))))))

(defun circuits-negative (x)
  (if (circuits-plain-name-p x)
      (list '(mtimes simp) -1 x)
      (circuits-times -1 x)))

(defun circuits-plain-name-p (x)
  "Whether -x is already simple: most coefficients are 1, -1 and names."
  (and x (symbolp x) (core-users-name-p x)))

;;; Rows: hash tables from columns to coefficients that are not 0.

(defun circuits-new-row () (make-hash-table))

(defun circuits-add-entry (row column x)
  "Adds X at COLUMN of ROW."
  (let ((sum (circuits-plus (gethash column row 0) x)))
    (if (circuits-nothing-p sum) (remhash column row) (setf (gethash column row) sum))
    sum))

(defun circuits-add-multiple (row factor other)
  "ROW := ROW + FACTOR*OTHER."
  (unless (circuits-nothing-p factor)
    (maphash (lambda (column x) (circuits-add-entry row column (circuits-times factor x))) other)))

(defun circuits-copied-row (row)
  (let ((copy (circuits-new-row)))
    (maphash (lambda (column x) (setf (gethash column copy) x)) row)
    copy))

(defun circuits-row-entries (row)
  "((column . coefficient) ..) in the order of the columns."
  (sort (loop for column being the hash-keys of row using (hash-value x)
              collect (cons column x))
        #'< :key #'car))
