;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Legendre's transformation of a function of the second degree in the velocities: with
;;; p = A q' + a and b = p - a
;;;     p.q' - L = b.A^-1.b/2 - A0,   q' = A^-1 b, its derivative with respect to p.
;;; With the cofactors C of A it is b.C.b/(2 det A), all minors being computed once. Coordinates
;;; without products in A have fractions of their own. Numerator and determinant are polynomials in
;;; the kernels (canonical) or sums of products that nest as the minors do (factored); the length
;;; of the latter is known before they are formed, by the same expansion over numbers. Plane chain
;;; of 5 links: 0.05 s; three bodies with full tensors, six coordinates, 2 s by elimination, which
;;; grows as 4^n where minors grow as n!.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/evaluate" "algebra/kernels" "algebra/linear" "algebra/matrices"
                "algebra/minors" "algebra/normal" "algebra/scan" "algebra/size" "algebra/zero"))

(defun $forms_inverse_form (a b form)
  "b.A^-1.b/2 for a symmetric regular A."
  (let ((rows (mapcar #'cdr (cdr a))) (b (cdr b)))
    (addn (loop for block in (algebra-blocks rows)
                collect (forms-block-form (forms-chosen-rows block rows)
                                          (forms-chosen block b)
                                          form))
          nil)))

(defun forms-block-form (rows b form)
  (ecase form
    ($canonical (let ((*algebra-advice* "take form = factored"))
                  (forms-canonical-form rows b)))
    ($factored (forms-nested-form rows b))
    ($auto (or (forms-moderate-form rows b)
               (progn (core-factored) (forms-nested-form rows b))))))

(defun forms-moderate-form (rows b)
  "The canonical form; nil where it is long and the other would be much shorter."
  (let ((found (catch 'algebra-too-large
                 (let ((*algebra-may-give-up* t) (*algebra-limit* 60000))
                   (forms-canonical-form rows b)))))
    (unless (or (eq found 'too-large) (forms-much-longer-p (algebra-size found) rows b))
      found)))

(defun forms-much-longer-p (size rows b)
  (> size (max 20000 (* 4 (reduce #'min (forms-nested-sizes rows b))))))

;;; Rows and elements of a block.

(defun forms-chosen (indices items)
  (mapcar (lambda (i) (nth i items)) indices))

(defun forms-chosen-rows (indices rows)
  (mapcar (lambda (row) (forms-chosen indices row)) (forms-chosen indices rows)))

;;; Canonical.

(defun forms-canonical-form (rows b)
  (with-algebra-ring
    (let* ((skeletons (mapcar (lambda (row) (mapcar #'algebra-scan row)) (cons b rows)))
           (quotients (progn (algebra-order-kernels)
                             (mapcar (lambda (row) (mapcar #'algebra-evaluate row)) skeletons)))
           (found (algebra-inverse-form (cdr quotients) (car quotients))))
      (algebra-guard (algebra-monomials (car found)) "the canonical form")
      (algebra-general-reduced (cons (car found) (ptimes 2 (cdr found)))))))

;;; Factored.

(defparameter *forms-advice* "take EquationProgram, in which nothing is repeated")

(defun $forms_guard_derivatives (h n)
  "Each of the 2n derivatives of H has a few times its length."
  (let ((*algebra-advice* *forms-advice*))
    (algebra-guard (floor (* n (algebra-size h)) 2) "Hamilton's equations")
    '$done))

(defun $forms_guard_second_derivatives (r n)
  "Lagrange's equations of a function R with quotients: n of them, each with n second derivatives
of some three times its length."
  (let ((*algebra-advice* *forms-advice*))
    (algebra-guard (floor (* 3 n n (algebra-size r)) 5) "the equations of Routh's function")
    '$done))

(defun forms-nested-form (rows b)
  "By minors, or by elimination where that is much shorter."
  (let ((*algebra-advice* *forms-advice*)
        (entries (algebra-rectangle rows)))
    (destructuring-bind (minors elimination) (forms-nested-sizes rows b)
      (algebra-guard (min minors elimination) "this quadratic form in the momenta")
      (if (< minors (* 2 elimination))
          (forms-quotient-of-minors entries b #'mul #'add (lambda (x y) (div x (mul 2 y))))
          (forms-by-elimination rows b)))))

(defun forms-nested-sizes (rows b)
  "How many nodes the form has by minors and by elimination."
  (let* ((rows (loop for row in rows
                     collect (mapcar (lambda (e) (if (eql e 0) 0 (algebra-size e))) row)))
         (b (mapcar #'algebra-size b)))
    (flet ((sum (&rest sizes) (apply #'+ (mapcar #'abs sizes))))
      (list (forms-quotient-of-minors (algebra-rectangle rows) b
                                      #'sum #'sum #'sum)
            (destructuring-bind (rows b) (forms-smallest-first rows rows b)
              (forms-elimination rows b #'sum
                                 (lambda (e factor x pivot same)
                                   (sum e factor (if same 0 x) pivot))
                                 #'sum))))))

;;; Elimination: b.A^-1.b is the sum of b_k^2/a_kk, where after each k what is left of A and b
;;; becomes a_ij - a_ik a_kj/a_kk, b_i - a_ik b_k/a_kk. Short entries first: what comes late is
;;; written least.

(defun forms-by-elimination (rows b)
  (destructuring-bind (rows b)
      (forms-smallest-first (loop for row in rows collect (mapcar #'algebra-size row)) rows b)
    (forms-elimination rows b #'add
                       (lambda (e factor x pivot same)
                         (sub e (div (if same (power factor 2) (mul factor x)) pivot)))
                       (lambda (y pivot)
                         (when (eq t ($algebra_zero_at_samples pivot))
                           (core-error "the quadratic form in the momenta is long, and its ~
                                        elimination meets a zero; give numbers to parameters"))
                         (div (power y 2) (mul 2 pivot))))))

(defun forms-smallest-first (sizes rows b)
  "(ROWS B) in the order of the SIZES on the diagonal."
  (let ((order (stable-sort (loop for i below (length rows) collect i) #'<
                            :key (lambda (i) (nth i (nth i sizes))))))
    (list (forms-chosen-rows order rows) (forms-chosen order b))))

(defun forms-elimination (rows b add less over)
  (if (null rows)
      0
      (destructuring-bind ((pivot . row) . others) rows
        (flet ((less (e factor x same)
                 (if (or (eql factor 0) (eql x 0)) e (funcall less e factor x pivot same))))
          (funcall add (funcall over (car b) pivot)
                   (forms-elimination
                    (loop for (factor . entries) in others
                          for i from 0
                          collect (loop for e in entries
                                        for x in row
                                        for j from 0
                                        collect (less e factor x (= i j))))
                    (loop for (factor) in others
                          for y in (cdr b)
                          collect (less y factor (car b) nil))
                    add less over))))))

(defun forms-quotient-of-minors (entries b times plus over)
  "The sum of b_i b_j C_ij OVER the determinant, in the arithmetic of TIMES and PLUS."
  (let* ((n (array-dimension entries 0)) (sum 0)
         (minor (algebra-minors entries #'algebra-first-row times plus)))
    (loop for i from 0
          for (b-i . others) on b
          do (loop for j from i
                   for b-j in (cons b-i others)
                   for c = (funcall minor (algebra-all-but i n) (algebra-all-but j n))
                   unless (eql c 0)
                     do (setq sum (funcall plus sum
                                           (funcall times
                                                    (* (if (= i j) 1 2) (if (evenp (+ i j)) 1 -1))
                                                    b-i b-j c)))))
    (funcall over sum (funcall minor (algebra-all-of n) (algebra-all-of n)))))
