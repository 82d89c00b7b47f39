;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Does a reduced polynomial vanish?  Kernels are independent (symbols, open functions, angles) or
;;; constants; as a polynomial in the former it vanishes with its coefficients, which the sign of a
;;; constant decides.  Terms whose coefficient is a zero in disguise are left out of normal forms.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels" "algebra/relations" "algebra/readable" "algebra/constant_sign"
                "algebra/separation_bound"))

(defun algebra-polynomial-test (p)
  (let ((unsure (algebra-unsure-kernels p)))
    (cond ((pzerop p) 'zero)
          ((null unsure) 'not-zero)
          ((every #'algebra-constant-kernel-p unsure) (algebra-coefficients-test p))
          (t 'dependent))))

(defun algebra-unsure-kernels (p)
  (loop for kernel in (algebra-ring-kernels *algebra-ring*)
        unless (or (algebra-kernel-sure kernel)
                   (not (algebra-occurs-p (algebra-kernel-variable kernel) p)))
          collect kernel))

(defun algebra-constant-kernel-p (kernel)
  ($constantp (algebra-kernel-expression kernel)))

(defun algebra-coefficients-test (p)
  "A polynomial in independent kernels whose coefficients are constants: test each of these."
  (let ((answers (mapcar #'algebra-constant-test (algebra-constant-coefficients p))))
    (cond ((member 'dependent answers) 'dependent)
          ((member 'not-zero answers) 'not-zero)
          (t 'zero))))

(defun algebra-constant-coefficients (p)
  (let ((coefficients (list p)))
    (dolist (kernel (algebra-ring-kernels *algebra-ring*) coefficients)
      (when (or (algebra-kernel-sure kernel) (eq (algebra-kernel-expression kernel) '$%i))
        (setq coefficients (algebra-coefficients-of-all coefficients
                                                        (algebra-kernel-variable kernel)))))))

(defun algebra-coefficients-of-all (polynomials variable)
  (loop for p in polynomials
        append (mapcar #'cadr (algebra-powers p variable))))

(defun algebra-constant-test (p)
  "zero, not-zero or dependent, P a polynomial in constant kernels."
  (if (pzerop p)
      'zero
      (case (algebra-constant-verdict (simplify (pdisrep p)))
        (0 'zero)
        ((1 -1) 'not-zero)
        (t (if (algebra-zero-parts-p p) 'zero 'dependent)))))

(defun algebra-zero-parts-p (p)
  "P vanishes for every value of the transcendental constants in it."
  (let ((parts (list p)))
    (dolist (kernel (algebra-ring-kernels *algebra-ring*))
      (unless (algebra-algebraic-p (algebra-kernel-expression kernel))
        (setq parts (algebra-coefficients-of-all parts (algebra-kernel-variable kernel)))))
    (and (not (equal parts (list p)))
         (loop for part in parts
               always (eql 0 (algebra-constant-verdict (simplify (pdisrep part))))))))

(defun algebra-without-zero-terms (p)
  "P without the terms whose constant coefficients vanish."
  (if (some #'algebra-constant-kernel-p (algebra-unsure-kernels p))
      (algebra-nonzero-terms p (remove-if #'algebra-constant-kernel-p
                                          (algebra-ring-kernels *algebra-ring*)))
      p))

(defun algebra-nonzero-terms (p kernels)
  "The same, where KERNELS are those of P that are not constant."
  (if (null kernels)
      (if (eq 'zero (algebra-constant-test p)) 0 p)
      (let* ((variable (algebra-kernel-variable (car kernels)))
             (powers (algebra-powers p variable))
             (kept (loop for (nil coefficient) in powers
                         collect (algebra-nonzero-terms coefficient (cdr kernels)))))
        (if (every #'eq kept (mapcar #'cadr powers))
            p
            (algebra-sum-of-powers variable (mapcar #'car powers) kept)))))

(defun algebra-sum-of-powers (variable exponents coefficients)
  (let ((sum 0))
    (loop for exponent in exponents
          for coefficient in coefficients
          do (setq sum (pplus sum (ptimes coefficient
                                          (if (zerop exponent) 1 (list variable exponent 1))))))
    sum))
