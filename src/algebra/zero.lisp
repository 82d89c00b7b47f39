;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; algebra_zerop(e): true, false or unknown, exactly.  True: the numerator vanishes modulo the
;;; relations of its kernels.  False: a value at a point is not zero, modulo a prime where the
;;; kernels are independent, else by intervals.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "algebra/sample" "algebra/interval" "algebra/numbers"))

(defun $algebra_zerop (e)
  (cond ((mequalp e) (algebra-zero-test (sub (cadr e) (caddr e))))
        ((mbagp e) (algebra-worst-answer (mapcar #'$algebra_zerop (cdr e))))
        ((numberp e) (zerop e))
        (t (algebra-zero-test e))))

(defun algebra-zero-test (e)
  (case (or (and ($constantp e) (algebra-constant-verdict e)) (algebra-remainder-test e))
    ((0 zero) t)
    ((1 -1 not-zero) nil)
    (t (if (algebra-nonzero-somewhere-p e) nil '$unknown))))

(defun algebra-remainder-test (e)
  "zero; not-zero; dependent: no zero polynomial, but its kernels may be bound; too-large."
  (with-algebra-ring
    (let* ((*algebra-exponential-form* t)
           (*algebra-roots-apart* t)
           (*algebra-every-multiple* t)
           (skeleton (algebra-scan e)))
      (algebra-order-kernels)
      (if (null (algebra-sampled-zero skeleton))
          'not-zero
          (let ((*algebra-may-give-up* t))
            (catch 'algebra-too-large
              (algebra-expanded-test (algebra-evaluate skeleton))))))))

(defun algebra-expanded-test (quotient)
  (when (algebra-vanishes-p (cdr quotient)) (core-error "division by zero"))
  (algebra-polynomial-test (car (algebra-reduce (car quotient)))))

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
        (t (if (algebra-parts-vanish-p p) 'zero 'dependent)))))

(defun algebra-parts-vanish-p (p)
  "P vanishes for every value of the transcendental constants in it."
  (let ((parts (list p)))
    (dolist (kernel (algebra-ring-kernels *algebra-ring*))
      (unless (algebra-algebraic-p (algebra-kernel-expression kernel))
        (setq parts (algebra-coefficients-of-all parts (algebra-kernel-variable kernel)))))
    (and (not (equal parts (list p)))
         (loop for part in parts
               always (eql 0 (algebra-constant-verdict (simplify (pdisrep part))))))))
