;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Products of general expressions: two lists of factors in Maxima's order become one, powers of
;;; one base joined. The simplifier copies every factor each time, which costs as much as the
;;; recursion over bodies itself; to it are left numbers times sums, roots of numbers and exponents
;;; that are no whole numbers. See linmodel-product first.

(in-package :maxima)

(defun linmodel-product (x y)
  (cond ((eql x -1) (linmodel-negated y))
        ((eql y -1) (linmodel-negated x))
        (t (let ((first (linmodel-factors x)) (second (linmodel-factors y)))
             (if (and (linmodel-plain-p first) (linmodel-plain-p second)
                      (not (and (mnump (car first)) (mnump (car second)))))
                 (linmodel-of-factors (linmodel-joined first second))
                 (mul x y))))))

(defun linmodel-factors (e)
  (if (mtimesp e) (cdr e) (list e)))

(defun linmodel-negated (e)
  "-E; a sum is negated term by term."
  (cond ((mplusp e) (cons (car e) (mapcar #'linmodel-negated (cdr e))))
        ((mnump e) (mul -1 e))
        ((not (mtimesp e)) (list '(mtimes simp) -1 e))
        ((not (mnump (cadr e))) (list* '(mtimes simp) -1 (cdr e)))
        ((not (eql (cadr e) -1)) (list* (car e) (mul -1 (cadr e)) (cddr e)))
        (t (linmodel-of-factors (cddr e)))))

(defun linmodel-plain-p (factors)
  "No number alone; all exponents are whole numbers."
  (and (or (cdr factors) (not (mnump (car factors))))
       (loop for factor in factors
             always (or (not (mexptp factor)) (integerp (caddr factor))))))

(defun linmodel-base (e) (if (mexptp e) (cadr e) e))
(defun linmodel-exponent (e) (if (mexptp e) (caddr e) 1))

(defun linmodel-joined (first second)
  (let ((factors '()))
    (loop while (and first second)
          do (let ((x (car first)) (y (car second)))
               (cond ((alike1 (linmodel-base x) (linmodel-base y))
                      (let ((power (linmodel-power (pop first) (pop second))))
                        (when power (push power factors))))
                     ((linmodel-before-p x y) (push (pop first) factors))
                     (t (push (pop second) factors)))))
    (nreconc factors (or first second))))

(defun linmodel-power (x y)
  "The product of two powers of one base; nil where it is 1."
  (let ((base (linmodel-base x)) (exponent (+ (linmodel-exponent x) (linmodel-exponent y))))
    (case exponent
      (0 nil)
      (1 base)
      (t (list '(mexpt simp) base exponent)))))

(defun linmodel-before-p (x y)
  (or (mnump x) (and (not (mnump y)) (great y x))))

(defun linmodel-of-factors (factors)
  (cond ((null factors) 1)
        ((cdr factors) (cons '(mtimes simp) factors))
        (t (car factors))))
