;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Derivatives in the ring of kernels: de/dx is the sum over the kernels k of de/dk * dk/dx; for
;;; the pair of an angle u it is (c*d/ds - s*d/dc) * du/dx.  Expressions are read once for all
;;; variables, nothing goes through Maxima's simplifier but the derivatives of single kernels.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/branch_slopes" "algebra/memory" "algebra/size" "algebra/kernels"
                "algebra/normal" "algebra/evaluate" "algebra/quotient" "algebra/scan"))

(defun $algebra_jacobian (es xs)
  "The matrix of de_i/dx_j, normal."
  (unless (and ($listp es) (cdr es) ($listp xs) (cdr xs))
    (core-error "lists of expressions and of variables were expected, found ~A and ~A"
                (algebra-short-text es) (algebra-short-text xs)))
  (cons '($matrix simp)
        (mapcar (lambda (row) (cons '(mlist simp) row)) (algebra-jacobian (cdr es) (cdr xs)))))

(defun algebra-jacobian (es xs)
  (with-algebra-ring
    (let* ((*algebra-exponential-form* (some #'algebra-exponentials-p es))
           (skeletons (mapcar #'algebra-scan es))
           (rates (progn (algebra-collect-multiples)
                         (mapcar #'algebra-rates-of-kernels xs))))
      (algebra-order-kernels)
      (setq rates (mapcar #'algebra-evaluated-rates rates))
      (loop for skeleton in skeletons
            for quotient = (algebra-evaluate skeleton)
            collect (loop for rate in rates
                          collect (algebra-general-reduced
                                   (algebra-derivative quotient rate)))))))

;;; The coefficient of a name in a linear equation

(defvar *algebra-slopes* (make-algebra-memory) "Slopes: steps of solving ask them in turn.")

(defun $algebra_slope (e x)
  "de/dX, normal, where E is linear in X and not free of it; else false."
  (algebra-remembered *algebra-slopes* (cons x e) (lambda () (algebra-new-slope e x))))

(defun algebra-new-slope (e x)
  (let ((slope ($algebra_normal ($diff e x))))
    (and (algebra-free-p x slope)
         (not (eql slope 0))
         (algebra-free-p x (maxima-substitute 0 x e))
         slope)))

;;; How kernels change with a variable: (kernel or unit . skeleton), .. where they do.

(defun algebra-rates-of-kernels (x)
  (append
   (loop for unit in (copy-list (algebra-ring-units *algebra-ring*))
         unless (algebra-free-p x (algebra-unit-exponent unit))
           collect (cons unit (algebra-scan ($algebra_diff (algebra-unit-exponent unit) x))))
   (loop for kernel in (copy-list (algebra-ring-kernels *algebra-ring*))
         unless (algebra-free-p x (algebra-kernel-expression kernel))
           collect (cons kernel (algebra-scan
                                 ($algebra_diff (algebra-kernel-expression kernel) x))))))

(defun algebra-free-p (x e)
  (not (among x e)))

(defun algebra-unit-exponent (unit)
  "The angle; for a power its exponent times the logarithm of the base."
  (if (member (algebra-unit-kind unit) '(circular hyperbolic $%e))
      (algebra-unit-base unit)
      (mul (algebra-unit-base unit) (take '(%log) (algebra-unit-kind unit)))))

(defun algebra-evaluated-rates (rates)
  "A list of (variable . quotient): the rate of each kernel's variable."
  (loop for (changing . skeleton) in rates
        for rate = (algebra-evaluate skeleton)
        append (if (algebra-unit-p changing)
                   (algebra-unit-rates changing rate)
                   (list (cons (algebra-kernel-variable changing) rate)))))

(defun algebra-unit-rates (unit rate)
  (let* ((inverse (algebra-unit-denominator unit))
         (step (algebra-times rate (cons (denominator inverse) (numerator inverse))))
         (cosine (algebra-variable (algebra-unit-cosine unit)))
         (sine (and (algebra-unit-sine unit) (algebra-variable (algebra-unit-sine unit))))
         (sign (if (eq (algebra-unit-kind unit) 'circular) -1 1)))
    (if sine
        (list (cons (car sine) (algebra-times (cons cosine 1) step))
              (cons (car cosine) (algebra-times (cons (ptimes sign sine) 1) step)))
        (list (cons (car cosine) (algebra-times (cons cosine 1) step))))))

;;; (n/d)' = (n' - (n/d)*d')/d

(defun algebra-derivative (quotient rates)
  (destructuring-bind (n . d) quotient
    (let ((of-n (algebra-polynomial-derivative n rates)))
      (if (eql d 1)
          of-n
          (algebra-over-quotient
           (algebra-plus of-n
                         (algebra-times (cons (pminus n) d)
                                        (algebra-polynomial-derivative d rates)))
           (cons d 1))))))

(defun algebra-polynomial-derivative (p rates)
  (algebra-sum (loop for (variable . rate) in rates
                     for partial = (pderivative p variable)
                     unless (pzerop partial)
                       collect (algebra-times (cons partial 1) rate))))
