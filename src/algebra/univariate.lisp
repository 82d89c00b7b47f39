;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials in one variable with symbolic coefficients: algebra_coefficients, Hurwitz's minors
;;; of H_ij = a_(2j-i), p = a_0 x^n + .. + a_n.  With few parameters the minors come from Routh's
;;; array without fractions (each entry is a minor, each division is exact), with many from
;;; memoised minors (minors.lisp).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/normal" "algebra/minors"
                "algebra/evaluate" "algebra/matrices" "algebra/packed_minors" "algebra/quotient"
                "algebra/relations" "algebra/scan"))

(defun $algebra_coefficients (p x)
  "[a_0, .., a_n], highest power first."
  (with-algebra-ring
    (let* ((skeleton (algebra-scan p))
           (variable (algebra-polynomial-variable x))
           (quotient (progn (algebra-order-kernels) (algebra-evaluate skeleton)))
           (powers (algebra-powers-of quotient variable x)))
      (cons '(mlist simp)
            (loop for power from (reduce #'max powers :key #'car) downto 0
                  for entry = (assoc power powers)
                  collect (if entry
                              (algebra-general-reduced (cons (cadr entry) (cdr quotient)))
                              0))))))

(defun algebra-polynomial-variable (x)
  (let ((kernel (algebra-scan x)))
    (unless (algebra-kernel-p kernel)
      (core-error "~A is no variable of a polynomial" (algebra-short-text x)))
    kernel))

(defun algebra-powers-of (quotient kernel x)
  "The powers of a kernel in a polynomial: a list of (exponent coefficient)."
  (when (algebra-occurs-p (algebra-kernel-variable kernel) (cdr quotient))
    (core-error "a polynomial in ~A was expected, found it in a denominator"
                (algebra-short-text x)))
  (or (algebra-powers (car quotient) (algebra-kernel-variable kernel))
      '((0 0))))

;;; Hurwitz's minors.

(defun $algebra_hurwitz_minors (coefficients)
  "[Delta_1, .., Delta_n], expanded."
  (unless (and ($listp coefficients) (cddr coefficients))
    (core-error "a list of two or more coefficients was expected, found ~A"
                (algebra-short-text coefficients)))
  (with-algebra-ring
    (multiple-value-bind (polynomials denominator)
        (algebra-common-denominator (algebra-quotients (cdr coefficients)))
      (cons '(mlist simp)
            (loop for minor in (algebra-hurwitz-polynomials polynomials)
                  for power from 1
                  collect (algebra-expanded-reduced
                           (cons minor (pexpt denominator power))))))))

(defun $algebra_short_hurwitz_minors (coefficients limit)
  "The same, or false where a product is predicted to have more than LIMIT terms."
  (let ((minors (catch 'algebra-too-large
                  (let ((*algebra-may-give-up* t) (*algebra-limit* limit))
                    ($algebra_hurwitz_minors coefficients)))))
    (if (eq minors 'too-large) nil minors)))

(defun algebra-hurwitz-polynomials (coefficients)
  (or (and (<= (length (algebra-ring-kernels *algebra-ring*)) 2)
           (notany #'algebra-pair-p (algebra-ring-units *algebra-ring*))
           (algebra-routh-minors coefficients))
      (and (algebra-independent-ring-p) (algebra-packed-hurwitz coefficients))
      (algebra-memoised-hurwitz coefficients)))

(defun algebra-independent-ring-p ()
  "Whether no relation binds the kernels."
  (and (notany #'algebra-pair-p (algebra-ring-units *algebra-ring*))
       (notany #'algebra-kernel-degree (algebra-ring-kernels *algebra-ring*))))

(defun algebra-memoised-hurwitz (coefficients)
  (let* ((n (1- (length coefficients)))
         (a (coerce coefficients 'vector))
         (matrix (make-array (list n n) :initial-element 0)))
    (loop for i from 1 to n
          do (loop for j from 1 to n
                   for place = (- (* 2 j) i)
                   do (when (<= 0 place n)
                        (setf (aref matrix (1- i) (1- j)) (aref a place)))))
    (algebra-leading-minor-polynomials matrix)))

(defun algebra-routh-minors (coefficients)
  "Routh's array without fractions; nil where a leading entry vanishes before the end."
  (let* ((n (1- (length coefficients)))
         (above (loop for a in coefficients by #'cddr collect a))
         (row (loop for a in (cdr coefficients) by #'cddr collect a))
         (minors (list (car row)))
         (divisor 1))
    (loop for k from 2 to n
          do (when (pzerop (car row)) (return-from algebra-routh-minors nil))
             (let ((next (algebra-routh-row above row divisor)))
               (setq divisor (if (= k 2) 1 (car above))
                     above row
                     row next)
               (push (car row) minors)))
    (nreverse minors)))

(defun algebra-routh-row (above row divisor)
  (loop for (b) on (cdr above)
        for rest = (cdr row) then (cdr rest)
        for cross = (pdifference (ptimes (car row) b) (ptimes (car above) (or (car rest) 0)))
        collect (pquotient cross divisor)))

;;; Determinants with a parameter lambda.

(defun $algebra_characteristic_polynomial (a lambda)
  "det(lambda*E - A), expanded."
  (algebra-check-square a "the matrix of the characteristic polynomial")
  ($algebra_quadratic_pencil (algebra-zero-matrix a) (algebra-unit-matrix a) (mul -1 a) lambda))

(defun algebra-zero-matrix (a)
  (algebra-matrix-by a (lambda (i j) (declare (ignore i j)) 0)))

(defun algebra-unit-matrix (a)
  (algebra-matrix-by a (lambda (i j) (if (= i j) 1 0))))

(defun algebra-matrix-by (a entry)
  (cons '($matrix simp)
        (loop for i from 1 to (length (cdr a))
              collect (cons '(mlist simp)
                            (loop for j from 1 to (length (cdr a))
                                  collect (funcall entry i j))))))

(defun $algebra_quadratic_pencil (m s w lambda)
  "det(M*lambda^2 + S*lambda + W), expanded."
  (algebra-check-square m "the matrix M")
  (algebra-check-square s "the matrix S")
  (algebra-check-square w "the matrix W")
  (unless (= (length m) (length s) (length w))
    (core-error "matrices of one size were expected, found sizes ~A, ~A, ~A"
                (length (cdr m)) (length (cdr s)) (length (cdr w))))
  (with-algebra-ring
    (let* ((entries (list (algebra-scan-rows m) (algebra-scan-rows s) (algebra-scan-rows w)))
           (variable (algebra-polynomial-variable lambda)))
      (algebra-order-kernels)
      (algebra-expanded-powers
       (algebra-quotient-determinant (algebra-pencil-rows entries variable))
       variable lambda))))

(defun algebra-pencil-rows (entries variable)
  (let ((x (cons (algebra-variable variable) 1)))
    (flet ((entry (m s w)
             (algebra-sum (list (algebra-times (algebra-evaluate m) (algebra-to-power x 2))
                                (algebra-times (algebra-evaluate s) x)
                                (algebra-evaluate w)))))
      (apply #'mapcar (lambda (m s w) (mapcar #'entry m s w)) entries))))

(defun algebra-expanded-powers (quotient variable x)
  "The expanded sum of coefficients times powers of X."
  (if (eql (cdr quotient) 1)
      (algebra-expanded-reduced quotient)
      (addn (loop for (power coefficient) in (algebra-powers-of quotient variable x)
                  collect ($expand (mul (algebra-expanded-reduced (cons coefficient (cdr quotient)))
                                        (power x power))
                                   1 1))
            nil)))
