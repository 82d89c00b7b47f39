;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Sines and cosines as a person reads them.  A coefficient of parameters and
;;; velocities is a polynomial in sines and cosines over the rationals, known modulo s^2 + c^2 = 1.
;;; Parity in each s and c splits it into classes that the relation does not mix; of each class the
;;; shortest form is chosen among: in c^2, in s^2, homogeneous in c^2 and s^2 (which gives s^2*c^2).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/relations"))

(defun algebra-readable (p)
  "A polynomial equal to P modulo the relations, short in sines and cosines."
  (let ((pairs (remove-if-not (lambda (unit)
                                (and (algebra-pair-p unit) (algebra-unit-occurs-p unit p)))
                              (algebra-ring-units *algebra-ring*))))
    (if pairs (algebra-readable-leaves p pairs) p)))

(defun algebra-readable-leaves (p pairs)
  (cond ((atom p) p)
        ((algebra-angle-variable-p (car p)) (algebra-readable-leaf p pairs))
        (t (cons (car p)
                 (loop for (exponent coefficient) on (cdr p) by #'cddr
                       collect exponent
                       collect (algebra-readable-leaves coefficient pairs))))))

(defun algebra-angle-variable-p (variable)
  (some (lambda (unit)
          (and (algebra-pair-p unit)
               (or (eq variable (algebra-kernel-variable (algebra-unit-cosine unit)))
                   (eq variable (algebra-kernel-variable (algebra-unit-sine unit))))))
        (algebra-ring-units *algebra-ring*)))

(defun algebra-readable-leaf (p pairs)
  (let ((sum 0)
        (present (remove-if-not (lambda (unit) (algebra-unit-occurs-p unit p)) pairs)))
    (dolist (class (algebra-parity-classes p present) sum)
      (setq sum (pplus sum (algebra-shortest-class class present))))))

(defun algebra-parity-classes (p pairs)
  "P as a list of polynomials, each even or odd in every sine and cosine."
  (let ((classes (list p)))
    (dolist (unit pairs classes)
      (dolist (kernel (list (algebra-unit-sine unit) (algebra-unit-cosine unit)))
        (setq classes
              (loop for class in classes
                    append (algebra-split-parity class (algebra-kernel-variable kernel))))))))

(defun algebra-split-parity (p variable)
  (let ((even (algebra-parity-part p variable 0))
        (odd (algebra-parity-part p variable 1)))
    (remove 0 (list even odd) :test #'eql)))

(defun algebra-parity-part (p variable parity)
  (cond ((or (atom p) (pointergp variable (car p))) (if (zerop parity) p 0))
        (t (psimp (car p)
                  (loop with main = (eq variable (car p))
                        for (exponent coefficient) on (cdr p) by #'cddr
                        for part = (if main
                                       (if (= (mod exponent 2) parity) coefficient 0)
                                       (algebra-parity-part coefficient variable parity))
                        unless (pzerop part) collect exponent and collect part)))))

(defun algebra-shortest-class (p pairs)
  "Try the forms of each angle, all combinations for few angles, else one angle after the other."
  (if (<= (length pairs) 3)
      (algebra-least (algebra-class-forms p pairs) #'algebra-term-count)
      (dolist (unit pairs p)
        (setq p (algebra-least (algebra-angle-forms p unit) #'algebra-term-count)))))

(defun algebra-class-forms (p pairs)
  (if (null pairs)
      (list p)
      (loop for form in (algebra-angle-forms p (car pairs))
            append (algebra-class-forms form (cdr pairs)))))

(defun algebra-angle-forms (p unit)
  (let ((in-cosine (algebra-eliminate-sine p unit)))
    (if (algebra-unit-occurs-p unit in-cosine)
        (list in-cosine
              (algebra-eliminate-cosine p unit)
              (algebra-homogeneous in-cosine unit))
        (list in-cosine))))

(defun algebra-term-count (p)
  "Number of terms, then of factors."
  (+ (* 1000 (algebra-monomials p)) (algebra-poly-size p)))

(defun algebra-homogeneous (p unit)
  "P of even powers of c (times c, s or c*s), made homogeneous in c^2, s^2 by c^2 + s^2 = 1: with
w = s^2/c^2 the sum of a_k*c^(2k) is c^(2m) times that of a_k*(1 + w)^(m-k); 1 - w if hyperbolic."
  (let* ((cosine (algebra-kernel-variable (algebra-unit-cosine unit)))
         (sine (algebra-kernel-variable (algebra-unit-sine unit)))
         (terms (algebra-terms-in p cosine sine))
         (m (floor (loop for (i) in terms maximize i) 2))
         (coefficients (make-array (1+ m) :initial-element 0))
         (sum 0))
    (loop for (i nil coefficient) in terms
          do (setf (aref coefficients (- m (floor i 2))) coefficient))
    (destructuring-bind (i j coefficient) (first terms)
      (declare (ignore coefficient))
      (loop for coefficient across (algebra-horner coefficients (algebra-square-sign unit) 1)
            for k from 0
            do (setq sum (pplus sum (ptimes coefficient
                                            (ptimes (pexpt (list cosine 1 1)
                                                           (+ (* 2 (- m k)) (mod i 2)))
                                                    (pexpt (list sine 1 1) (+ (* 2 k) j))))))))
    sum))

(defun algebra-square-sign (unit)
  "The sign of s^2 in 1 = c^2 + s^2 or c^2 - s^2."
  (if (eq (algebra-unit-kind unit) 'circular) 1 -1))

(defun algebra-terms-in (p cosine sine)
  "P as a list of (i j coefficient): the coefficients of cosine^i*sine^j."
  (loop for (i coefficient) in (algebra-powers p cosine)
        append (loop for (j inner) in (algebra-powers coefficient sine)
                     collect (list i j inner))))
