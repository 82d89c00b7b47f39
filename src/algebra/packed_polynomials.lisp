;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials as tables, monomial -> rational coefficient, in names and kernels that the caller
;;; lists: short ones, multiplied and taken apart many times where signs are sought. A monomial is
;;; one whole number, its exponents packed side by side, so that a product is a sum.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size"))

;;; Terms and factors of an expanded expression

(defun algebra-kernels-of (expressions)
  "The names and kernels in which the expanded EXPRESSIONS are polynomials with rational
coefficients."
  (let ((kernels '()))
    (dolist (e expressions (nreverse kernels))
      (dolist (term (algebra-summands e))
        (dolist (factor (algebra-factors-of term))
          (let ((base (algebra-base-of factor)))
            (unless (algebra-rational-number base) (pushnew base kernels :test #'alike1))))))))

(defun $algebra_made_as_polynomial (e names)
  "Whether E is a polynomial in NAMES as it stands, not written out, all else being coefficients."
  (labels ((made-p (e)
             (cond ((or (atom e) (member e (cdr names) :test #'alike1)) t)
                   ((or (mplusp e) (mtimesp e)) (every #'made-p (cdr e)))
                   (t (or ($lfreeof names e)
                          (and (mexptp e) (typep (caddr e) '(integer 0)) (made-p (cadr e))))))))
    (made-p e)))

(defun algebra-summands (e) (if (mplusp e) (cdr e) (list e)))
(defun algebra-factors-of (e) (if (mtimesp e) (cdr e) (list e)))

(defun algebra-base-of (factor)
  (if (and (mexptp factor) (integerp (caddr factor)) (plusp (caddr factor)))
      (cadr factor)
      factor))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defconstant +algebra-exponent-bits+ 10 "Room for one exponent: callers keep degrees below."))

(defparameter *algebra-table-degree* 1000 "The largest degree that a product of tables may have.")

(defun algebra-monomial-of (place power)
  (ash power (* place +algebra-exponent-bits+)))

(defun algebra-exponent (monomial place)
  (ldb (byte +algebra-exponent-bits+ (* place +algebra-exponent-bits+)) monomial))

(defun algebra-monomial-degree (monomial)
  (loop until (zerop monomial)
        sum (algebra-exponent monomial 0)
        do (setq monomial (ash monomial (- +algebra-exponent-bits+)))))

(defun algebra-new-table () (make-hash-table :test #'eql))

(defun algebra-table-of (e kernels)
  (let ((table (algebra-new-table)))
    (dolist (term (algebra-summands e) table)
      (let ((coefficient 1) (monomial 0))
        (dolist (factor (algebra-factors-of term))
          (let ((number (algebra-rational-number factor)) (base (algebra-base-of factor)))
            (if number
                (setq coefficient (* coefficient number))
                (incf monomial
                      (algebra-monomial-of (position base kernels :test #'alike1)
                                           (if (eq base factor) 1 (caddr factor)))))))
        (incf (gethash monomial table 0) coefficient)))))

(defun algebra-table-product (a b)
  (let ((table (algebra-new-table)))
    (maphash (lambda (m x)
               (maphash (lambda (n y) (incf (gethash (+ m n) table 0) (* x y))) b))
             a)
    (maphash (lambda (m x) (when (zerop x) (remhash m table))) table)
    table))

(defun algebra-table-degree (table)
  (loop with degree = 0
        for monomial being the hash-keys of table
        do (setq degree (max degree (algebra-monomial-degree monomial)))
        finally (return degree)))

(defun algebra-turned (e)
  "-E of the expanded E; what stands inside its kernels stays as it is."
  (addn (mapcar (lambda (term) (mul -1 term)) (algebra-summands e)) nil))

;;; Arithmetic

(defun algebra-table-sum (a b &optional (factor 1))
  "A + FACTOR*B; terms that cancel are gone."
  (let ((table (algebra-new-table)))
    (maphash (lambda (m x) (setf (gethash m table) x)) a)
    (maphash (lambda (m x)
               (let ((sum (+ (gethash m table 0) (* factor x))))
                 (if (zerop sum) (remhash m table) (setf (gethash m table) sum))))
             b)
    table))

(defun algebra-table-coefficient (table place power)
  "The coefficient of the POWER of the variable at PLACE."
  (let ((coefficient (algebra-new-table)))
    (maphash (lambda (m x)
               (when (= (algebra-exponent m place) power)
                 (setf (gethash (- m (algebra-monomial-of place power)) coefficient) x)))
             table)
    coefficient))

(defun algebra-table-degree-in (table place)
  (loop with degree = 0
        for monomial being the hash-keys of table
        do (setq degree (max degree (algebra-exponent monomial place)))
        finally (return degree)))

(defun algebra-table-put-in (table place value divisor)
  "divisor^n times TABLE, of degree n in the variable at PLACE, with VALUE/DIVISOR for this."
  (let ((sum (algebra-new-table)) (value-power nil) (n (algebra-table-degree-in table place)))
    (flet ((times (a b) (cond ((null a) b) ((null b) a) (t (algebra-table-product a b)))))
      (dotimes (k (1+ n) sum)
        (let ((term (times (algebra-table-coefficient table place k) value-power)))
          (loop repeat (- n k) do (setq term (times term divisor)))
          (setq sum (algebra-table-sum sum term)
                value-power (times value-power value)))))))
