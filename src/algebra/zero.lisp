;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; algebra_zerop(e): true, false or unknown, exactly.  True: the numerator vanishes modulo the
;;; relations of its kernels.  False: it does not, and either the kernels are independent over
;;; the rationals, or the value at a rational point is proved not zero by intervals.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "algebra/interval"))

(defun $algebra_zerop (e)
  (cond ((mbagp e) (algebra-all-zero (mapcar #'$algebra_zerop (cdr e))))
        ((numberp e) (zerop e))
        (t (algebra-zero-test e))))

(defun algebra-all-zero (answers)
  (cond ((member nil answers) nil)
        ((member '$unknown answers) '$unknown)
        (t t)))

(defun algebra-zero-test (e)
  (case (algebra-remainder-test e)
    (zero t)
    (independent nil)
    (t (if (algebra-nonzero-somewhere-p e) nil '$unknown))))

(defun algebra-remainder-test (e)
  "zero; independent: surely not zero; dependent: not zero in kernels that may be bound."
  (with-algebra-ring
    (let* ((*algebra-exponential-form* t)
           (skeleton (algebra-scan e))
           (quotient (progn (algebra-order-kernels) (algebra-evaluate skeleton))))
      (cond ((algebra-vanishes-p (cdr quotient)) (core-error "division by zero"))
            ((algebra-vanishes-p (car quotient)) 'zero)
            ((algebra-sure-p (car quotient)) 'independent)
            (t 'dependent)))))

(defun algebra-sure-p (p)
  (loop for kernel in (algebra-ring-kernels *algebra-ring*)
        always (or (algebra-kernel-sure kernel)
                   (not (algebra-occurs-p (algebra-kernel-variable kernel) p)))))
