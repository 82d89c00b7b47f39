;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Numbers with 512 binary digits behind the point: whole numbers that count units of 2^-512. Sums
;;; are exact, products off by one unit; sine and cosine of x come from their series at x/2^20 by
;;; twenty doublings of 1 - cos,   1 - cos 2x = 2 v (2 - v),  sin 2x = 2 sin x (1 - v),
;;; v = 1 - cos x,  which cost some forty digits. Rows of such numbers are eliminated with the
;;; largest pivot of each column: n^3/3 products, so that a check costs no more than what it checks.

(in-package :maxima)

(defconstant forms-digits 512)
(defconstant forms-doublings 20)

(defun forms-fixed (rational)
  (values (round (ash (numerator rational) forms-digits) (denominator rational))))

(defconstant forms-most-digits 40000
  "Binary digits that a value may have: exp(10^7) has none that is of use.")

(defun forms-no-value (e)
  (declare (ignore e))
  (throw 'forms-no-value nil))

(defun forms-fixed-times (x y)
  (let ((product (ash (* x y) (- forms-digits))))
    (if (< (integer-length product) forms-most-digits) product (forms-no-value product))))

(defun forms-fixed-dot (u v)
  (let ((sum 0))
    (mapc (lambda (x y) (incf sum (* x y))) u v)
    (ash sum (- forms-digits))))

(defun forms-fixed-power (base n)
  "By squaring; in no more steps than N has binary digits."
  (let ((power (ash 1 forms-digits)))
    (loop until (zerop n)
          do (when (oddp n) (setq power (forms-fixed-times power base)))
             (setq n (ash n -1))
             (unless (zerop n) (setq base (forms-fixed-times base base))))
    power))

(defun forms-fixed-inverse (x)
  (round (ash 1 (* 2 forms-digits)) x))

(defun forms-fixed-sine-cosine (x)
  "Sine and cosine of X, which is no angle of millions of turns."
  (when (> (integer-length x) (+ forms-digits forms-doublings 6)) (forms-no-value x))
  (multiple-value-bind (sine versine) (forms-fixed-series (ash x (- forms-doublings)))
    (loop repeat forms-doublings
          do (psetq sine (* 2 (forms-fixed-times sine (- (ash 1 forms-digits) versine)))
                    versine (* 2 (forms-fixed-times versine (- (ash 2 forms-digits) versine)))))
    (values sine (- (ash 1 forms-digits) versine))))

(defun forms-fixed-series (x)
  "Sine and 1 - cosine of a small X: the terms of both are x^n/n!."
  (let ((sine x) (versine 0) (term x) (n 1))
    (loop until (member term '(0 -1))
          do (incf n)
             (setq term (floor (forms-fixed-times term x) n))
             (case (mod n 4)
               (2 (incf versine term))
               (3 (decf sine term))
               (0 (decf versine term))
               (1 (incf sine term))))
    (values sine versine)))

(defun forms-fixed-quotient (x y)
  "X/Y, Y being more than what is left of 0 by rounding."
  (if (< (integer-length y) (floor forms-digits 4))
      (forms-no-value y)
      (floor (ash x forms-digits) y)))

(defun forms-fixed-root (x)
  (if (minusp x) (forms-no-value x) (isqrt (ash x forms-digits))))

;;; Elimination.

(defun forms-transposed (rows)
  (loop while (first rows)
        collect (mapcar #'car rows)
        do (setq rows (mapcar #'cdr rows))))

(defparameter *forms-least-pivot* (forms-fixed (expt 10 -60))
  "What is smaller in a column of rows of rank less than full is rounding.")

(defun forms-row-cleared (row pivot-row)
  "ROW without its first entry, cleared by PIVOT-ROW, whose first entry is not 0."
  (let ((factor (round (ash (car row) forms-digits) (car pivot-row))))
    (mapcar (lambda (x y) (- x (forms-fixed-times factor y))) (cdr row) (cdr pivot-row))))

(defun forms-largest-row (rows)
  "The number of the row of ROWS whose first entry is largest, and its size."
  (let* ((sizes (mapcar (lambda (row) (abs (car row))) rows))
         (size (reduce #'max sizes :initial-value 0)))
    (values (position size sizes) size)))

(defun forms-echelon (rows columns &optional (least *forms-least-pivot*))
  "For each of the first COLUMNS of ROWS the row that clears it, from that column on, or nil where
no entry is larger than LEAST; and the sign of the order in which the rows were taken."
  (let ((sign 1))
    (values (loop repeat columns
                  collect (multiple-value-bind (place size) (forms-largest-row rows)
                            (let ((pivot-row (and (> size least) (nth place rows))))
                              (when (and pivot-row (oddp place)) (setq sign (- sign)))
                              (setq rows (forms-rows-below rows pivot-row))
                              pivot-row)))
            sign)))

(defun forms-rows-below (rows pivot-row)
  "The other ROWS without their first column, cleared where there is a PIVOT-ROW."
  (if pivot-row
      (loop for row in rows
            unless (eq row pivot-row) collect (forms-row-cleared row pivot-row))
      (mapcar #'cdr rows)))

(defun forms-in-echelon-p (row echelon)
  "Whether ROW is a combination of the rows of ECHELON."
  (dolist (pivot-row echelon)
    (setq row (cond (pivot-row (forms-row-cleared row pivot-row))
                    ((forms-negligible-p (car row)) (cdr row))
                    (t (return-from forms-in-echelon-p nil)))))
  (every #'forms-negligible-p row))

(defvar *forms-negligible* (forms-fixed (expt 10 -40)))

(defun forms-negligible-p (x) (< (abs x) *forms-negligible*))

(defun forms-fixed-determinant (rows)
  (multiple-value-bind (echelon sign) (forms-echelon rows (length rows) 0)
    (if (member nil echelon)
        0
        (let ((determinant (forms-fixed sign)))
          (dolist (row echelon determinant)
            (setq determinant (forms-fixed-times determinant (car row))))))))
