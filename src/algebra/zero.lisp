;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; algebra_zerop(e): true, false or unknown, exactly.  True: the numerator vanishes modulo the
;;; relations of its kernels.  False: a value at a point is not zero, modulo a prime where the
;;; kernels are independent, else by intervals.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "algebra/sample" "algebra/vanishing" "algebra/interval"))

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
  (when (eq 'zero (algebra-polynomial-test (car (algebra-reduce (cdr quotient)))))
    (core-error "division by zero"))
  (algebra-polynomial-test (car (algebra-reduce (car quotient)))))
