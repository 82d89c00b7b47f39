;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials in kernels modulo their relations: s^2 = 1 - c^2 for each angle, kernel^n =
;;; radicand for each root, p(kernel) = 0 for RealRoot(p, k).  With s below the second degree and
;;; each root below its degree the remainder is unique; it vanishes exactly when the polynomial
;;; vanishes (angles; for roots see zero.lisp).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/quotient" "algebra/real_roots"))

(defun algebra-reduce (p)
  "The remainder of the polynomial P, a quotient (radicands may have denominators)."
  (let ((quotient (cons (algebra-reduce-angles p) 1)))
    (dolist (kernel (reverse (algebra-ring-kernels *algebra-ring*)) quotient)
      (cond ((algebra-kernel-degree kernel)
             (setq quotient (algebra-reduce-root quotient kernel)))
            ((algebra-real-root-p (algebra-kernel-expression kernel))
             (setq quotient (algebra-reduce-real-root quotient kernel)))))))

(defun algebra-reduce-angles (p)
  (dolist (unit (algebra-ring-units *algebra-ring*) p)
    (setq p (algebra-eliminate-sine p unit))))

(defun algebra-eliminate-sine (p unit)
  "s^2 = 1 - c^2, or c^2 - 1 for hyperbolic angles."
  (if (algebra-pair-p unit)
      (algebra-replace-square p (algebra-kernel-variable (algebra-unit-sine unit))
                              (algebra-other-square unit (algebra-unit-cosine unit) t))
      p))

(defun algebra-eliminate-cosine (p unit)
  "c^2 = 1 - s^2, or 1 + s^2 for hyperbolic angles."
  (if (algebra-pair-p unit)
      (algebra-replace-square p (algebra-kernel-variable (algebra-unit-cosine unit))
                              (algebra-other-square unit (algebra-unit-sine unit) nil))
      p))

(defun algebra-other-square (unit kept sine)
  (let ((x (algebra-kernel-variable kept)))
    (cond ((eq (algebra-unit-kind unit) 'circular) (list x 2 -1 0 1))
          (sine (list x 2 1 0 -1))
          (t (list x 2 1 0 1)))))

(defun algebra-replace-square (p variable square)
  "Put SQUARE for variable^2 in P."
  (cond ((or (atom p) (pointergp variable (car p))) p)
        ((eq variable (car p)) (algebra-lower-powers p variable square))
        (t (let ((changed nil))
             (flet ((replaced (coefficient)
                      (let ((found (algebra-replace-square coefficient variable square)))
                        (unless (eq found coefficient) (setq changed t))
                        found)))
               (let ((terms (loop for (exponent coefficient) on (cdr p) by #'cddr
                                  collect exponent
                                  collect (replaced coefficient))))
                 (if changed (algebra-terms-together (car p) terms) p)))))))

(defun algebra-terms-together (variable terms)
  "The sum of the coefficients in TERMS, (exponent coefficient ..), times powers of VARIABLE."
  (if (loop for (nil coefficient) on terms by #'cddr
            always (or (atom coefficient) (pointergp variable (car coefficient))))
      (psimp variable (loop for (exponent coefficient) on terms by #'cddr
                            unless (pzerop coefficient)
                              collect exponent and collect coefficient))
      (let ((sum 0))
        (loop for (exponent coefficient) on terms by #'cddr
              do (setq sum (pplus sum (ptimes (list variable exponent 1) coefficient))))
        sum)))

(defun algebra-lower-powers (p variable square)
  (cond ((< (cadr p) 2) p)
        ((> (length p) 17) (algebra-lower-many-powers p variable square))
        (t (let ((sum 0))
             (loop for (exponent coefficient) on (cdr p) by #'cddr
                   for power = (algebra-binomial-power square (floor exponent 2))
                   do (setq sum (pplus sum (ptimes (ptimes coefficient power)
                                                   (if (oddp exponent) (list variable 1 1) 1)))))
             sum))))

(defun algebra-lower-many-powers (p variable square)
  "The same for many terms, by Horner's rule: nothing but sums."
  (let* ((half (floor (cadr p) 2))
         (even (make-array (1+ half) :initial-element 0))
         (odd (make-array (1+ half) :initial-element 0)))
    (algebra-guard (* half half) "a power of a sine or cosine, put in for the other,")
    (loop for (exponent coefficient) on (cdr p) by #'cddr
          do (setf (aref (if (oddp exponent) odd even) (floor exponent 2)) coefficient))
    (multiple-value-bind (x a b) (algebra-square-parts square)
      (flet ((lowered (coefficients)
               (algebra-even-powers x (algebra-horner coefficients a b))))
        (pplus (lowered even) (ptimes (lowered odd) (list variable 1 1)))))))

(defun algebra-square-parts (square)
  "Three values: x, a, b of SQUARE, the polynomial a*x^2 + b."
  (destructuring-bind (x degree-2 a degree-0 b) square
    (declare (ignore degree-2 degree-0))
    (values x a b)))

(defun algebra-even-powers (x coefficients)
  "sum of coefficient_k*x^(2k)"
  (algebra-terms-together x (loop for k from (1- (length coefficients)) downto 0
                                  unless (pzerop (aref coefficients k))
                                    collect (* 2 k) and collect (aref coefficients k))))

(defun algebra-horner (coefficients a b)
  "The coefficients of the powers of y in the sum of coefficient_k*(a*y + b)^k; A, B are 1 or -1."
  (let* ((degree (1- (length coefficients)))
         (sum (make-array (1+ degree) :initial-element 0)))
    (flet ((signed (sign e) (if (minusp sign) (pminus e) e)))
      (loop for k from degree downto 0
            do (loop for i from (- degree k) downto 1
                     do (setf (aref sum i) (pplus (signed b (aref sum i))
                                                  (signed a (aref sum (1- i))))))
               (setf (aref sum 0) (pplus (signed b (aref sum 0)) (aref coefficients k)))))
    sum))

(defun algebra-binomial-power (square n)
  "(a*x^2 + b)^N for SQUARE, (x 2 a 0 b) with a, b = 1 or -1."
  (algebra-guard (* n n) "a power of a sine or cosine, put in for the other,")
  (if (zerop n)
      1
      (multiple-value-bind (x a b) (algebra-square-parts square)
        (cons x (loop for k from n downto 0
                      for choices = 1 then (/ (* choices (1+ k)) (- n k))
                      collect (* 2 k)
                      collect (* choices (expt a k) (expt b (- n k))))))))

(defun algebra-reduce-root (quotient kernel)
  "Lower the powers of a root in the numerator of QUOTIENT."
  (let ((p (car quotient)) (variable (algebra-kernel-variable kernel)))
    (if (or (atom p) (not (algebra-occurs-p variable p)))
        quotient
        (let ((lowered (algebra-lower-root p variable (algebra-kernel-degree kernel)
                                           (algebra-kernel-radicand kernel))))
          (algebra-angles-again (algebra-over-quotient lowered (cons (cdr quotient) 1)))))))

(defun algebra-reduce-real-root (quotient kernel)
  "The remainder of the numerator of QUOTIENT by the polynomial of which KERNEL is a root."
  (let* ((relation (cdadr (algebra-kernel-expression kernel)))
         (degree (1- (length relation)))
         (variable (algebra-kernel-variable kernel))
         (powers (algebra-powers (car quotient) variable))
         (highest (reduce #'max powers :key #'car)))
    (if (< highest degree)
        quotient
        (let ((rest (make-array (1+ highest) :initial-element 0))
              (scale (expt (car relation) (1+ (- highest degree)))))
          (loop for (exponent coefficient) in powers
                do (setf (aref rest exponent) (ptimes scale coefficient)))
          (loop for k from highest downto degree
                for factor = (pquotient (aref rest k) (car relation))
                do (loop for a in relation
                         for j downfrom k
                         do (setf (aref rest j)
                                  (pdifference (aref rest j) (ptimes a factor)))))
          (algebra-over-quotient
           (cons (algebra-polynomial-sum
                  (loop for k below degree
                        collect (ptimes (aref rest k)
                                        (if (zerop k) 1 (list variable k 1)))))
                 1)
           (cons (ptimes scale (cdr quotient)) 1))))))

(defun algebra-angles-again (quotient)
  (let ((reduced (algebra-reduce-angles (car quotient))))
    (if (eq reduced (car quotient)) quotient (algebra-quotient-of reduced (cdr quotient)))))

(defun algebra-lower-root (p variable degree radicand)
  (cond ((or (atom p) (pointergp variable (car p))) (cons p 1))
        ((eq variable (car p))
         (algebra-sum
          (loop for (exponent coefficient) on (cdr p) by #'cddr
                collect (multiple-value-bind (whole rest) (floor exponent degree)
                          (algebra-times (cons (ptimes coefficient
                                                       (if (zerop rest)
                                                           1
                                                           (list variable rest 1)))
                                               1)
                                         (algebra-to-power radicand whole))))))
        (t (algebra-sum
            (loop for (exponent coefficient) on (cdr p) by #'cddr
                  collect (algebra-times (cons (list (car p) exponent 1) 1)
                                         (algebra-lower-root coefficient variable degree
                                                             radicand)))))))

(defun algebra-powers (p variable)
  "P as a list of (exponent coefficient) in any of its variables."
  (cond ((or (atom p) (pointergp variable (car p))) (list (list 0 p)))
        ((eq (car p) variable)
         (loop for (exponent coefficient) on (cdr p) by #'cddr
               collect (list exponent coefficient)))
        (t (algebra-inner-powers p variable))))

(defun algebra-inner-powers (p variable)
  "The same where VARIABLE stands below the main variable of P; nothing is multiplied."
  (let ((powers nil))
    (loop for (outer part) on (cdr p) by #'cddr
          do (loop for (exponent coefficient) in (algebra-powers part variable)
                   for entry = (or (assoc exponent powers)
                                   (car (push (list exponent) powers)))
                   do (push outer (cdr entry))
                      (push coefficient (cdr entry))))
    (loop for (exponent . terms) in powers
          collect (list exponent (psimp (car p) (reverse terms))))))

(defun algebra-occurs-p (variable p)
  (cond ((atom p) nil)
        ((pointergp variable (car p)) nil)
        ((eq variable (car p)) t)
        (t (loop for (nil coefficient) on (cdr p) by #'cddr
                 thereis (algebra-occurs-p variable coefficient)))))

(defun algebra-unit-occurs-p (unit p)
  (or (algebra-occurs-p (algebra-kernel-variable (algebra-unit-cosine unit)) p)
      (algebra-occurs-p (algebra-kernel-variable (algebra-unit-sine unit)) p)))

(defun algebra-poly-size (p)
  (if (atom p)
      1
      (loop for (exponent coefficient) on (cdr p) by #'cddr
            sum (+ (min exponent 2) (algebra-poly-size coefficient)))))

(defun algebra-zero-polynomial-p (p)
  (pzerop (car (algebra-reduce p))))
