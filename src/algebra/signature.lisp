;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The signature of a symmetric form by Lagrange: a square is split off where a coefficient a_kk
;;; is not 0, a_ij - a_ik*a_kj/a_kk is a form without x_k. The arithmetic is that of rationals or
;;; of expressions, whose signs are known or not.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common" "algebra/normal" "algebra/zero" "algebra/sign"))

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
