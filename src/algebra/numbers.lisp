;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Constants: is a polynomial in roots of numbers, in sines and cosines of %pi/n, and in other
;;; constants zero?  Intervals prove that it is not.  For an algebraic number z a polynomial P with
;;; P(z) = 0 comes by resultants; a root that is not zero is at least |q0|/(|q0| + max|qi|) in size
;;; (Cauchy, q the coefficients of P from the lowest that is not zero): an interval below that
;;; bound proves z = 0.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels" "algebra/reduction" "algebra/interval"))

(defun algebra-constant-test (p)
  "zero, not-zero or dependent, P a polynomial in constant kernels."
  (if (pzerop p)
      'zero
      (let ((e (simplify (pdisrep p))))
        (cond ((algebra-interval-sign-among e '(64 256)) 'not-zero)
              ((algebra-algebraic-zero-p p e) 'zero)
              ((algebra-interval-sign-among e '(1024)) 'not-zero)
              (t 'dependent)))))

(defun algebra-algebraic-zero-p (p e)
  (let ((relations (algebra-number-relations p)))
    (and (listp relations)
         (<= (reduce #'* (mapcar #'cddr relations)) 100)
         (let ((bound (algebra-root-bound (algebra-annihilator p relations))))
           (and bound (algebra-below-p e bound))))))

(defun algebra-number-relations (p)
  "A list of (variable polynomial . degree), highest variable first, or `transcendental'."
  (let ((relations nil))
    (dolist (kernel (algebra-ring-kernels *algebra-ring*) relations)
      (when (and ($constantp (algebra-kernel-expression kernel))
                 (or relations (algebra-occurs-p (algebra-kernel-variable kernel) p)
                     (algebra-kernel-degree kernel)
                     (algebra-number-unit kernel)))
        (let ((relation (algebra-number-relation kernel)))
          (cond (relation (push relation relations))
                ((algebra-occurs-p (algebra-kernel-variable kernel) p)
                 (return 'transcendental))))))))

(defun algebra-number-relation (kernel)
  (let ((variable (algebra-kernel-variable kernel))
        (degree (algebra-kernel-degree kernel))
        (unit (algebra-number-unit kernel)))
    (cond (degree
           (destructuring-bind (n . d) (algebra-kernel-radicand kernel)
             (list* variable (pdifference (ptimes d (list variable degree 1)) n) degree)))
          (unit
           (if (eq kernel (algebra-unit-cosine unit))
               (let ((order (algebra-unit-denominator unit)))
                 (list* variable
                        (pplus 1 (caar (algebra-chebyshev (algebra-variable kernel) 1 order)))
                        order))
               (list* variable
                      (pplus (list variable 2 1)
                             (list (algebra-kernel-variable (algebra-unit-cosine unit)) 2 1 0 -1))
                      2))))))

(defun algebra-number-unit (kernel)
  "The unit of cos(%pi/n) or sin(%pi/n)."
  (find-if (lambda (unit)
             (and (eq (algebra-unit-base unit) '$%pi)
                  (member kernel (list (algebra-unit-cosine unit) (algebra-unit-sine unit)))))
           (algebra-ring-units *algebra-ring*)))

(defun algebra-annihilator (p relations)
  "The rational coefficients, highest first, of a polynomial that vanishes at the value of P."
  (let* ((z (gensym))
         (polynomial (sub z (algebra-plain p))))
    (loop for (variable relation) in relations
          do (when (among variable polynomial)
               (setq polynomial ($resultant polynomial (algebra-plain relation) variable))))
    (setq polynomial ($expand ($ratdisrep polynomial)))
    (loop for power from ($hipow polynomial z) downto 0
          collect (algebra-rational-number ($coeff polynomial z power)))))

(defun algebra-plain (p)
  "P with the polynomials' own symbols as its variables."
  (if (atom p)
      p
      (addn (loop for (exponent coefficient) on (cdr p) by #'cddr
                  collect (mul (algebra-plain coefficient) (power (car p) exponent)))
            nil)))

(defun algebra-root-bound (coefficients)
  (let* ((significant (reverse (member 0 (reverse coefficients) :test-not #'eql)))
         (lowest (abs (or (car (last significant)) 0))))
    (if (and significant (every #'rationalp significant) (plusp lowest))
        (/ lowest (+ lowest (reduce #'max significant :key #'abs))))))

(defun algebra-below-p (e bound)
  "|E| is proved below BOUND."
  (loop for bits in (let ((needed (+ 80 (integer-length (ceiling (/ 1 bound))))))
                      (list needed (* 2 needed) (* 4 needed)))
        thereis (let* ((*algebra-interval-bits* bits)
                       (interval (catch 'no-interval (algebra-i-of e))))
                  (and interval
                       (< (max (abs (car interval)) (abs (cdr interval)))
                          (* bound (algebra-i-unit)))))))
