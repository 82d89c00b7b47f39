;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; How many real roots a polynomial with rational coefficients has between two bounds, exactly, and
;;; to six decimals where they are: by Sturm's chain p, p', and each time the negative remainder of
;;; the last two; the changes of sign in it at a less those at b are the roots in (a, b]
;;; (Gantmacher, The Theory of Matrices, XV, 2). Other coefficients: euclid.lisp; where the roots
;;; lie in the plane: root_location.lisp.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size"))

(defun $algebra_real_roots_between (coefficients low high)
  "How many numbers x, LOW < x <= HIGH, are roots; coefficients highest power first; the bounds are
rational, minf or inf."
  (flet ((rational (x) (or (algebra-rational-number x)
                           (core-error "a rational number was expected, found ~A"
                                       (algebra-short-text x)))))
    (algebra-real-roots-between (mapcar #'rational (cdr coefficients))
                                (if (eq low '$minf) nil (rational low))
                                (if (eq high '$inf) nil (rational high)))))

(defun algebra-real-roots-between (p low high)
  "The same for rational numbers of Lisp; nil is an infinite bound."
  (algebra-chain-roots (algebra-sturm-chain (algebra-primitive p)) low high))

(defun algebra-chain-roots (chain low high)
  "How many real roots a polynomial with this CHAIN has in (LOW, HIGH]."
  (flet ((changes (bound direction)
           (algebra-sign-changes
            (mapcar (lambda (f) (if bound
                                    (algebra-sign-of-value f bound)
                                    (algebra-sign-far-out f direction)))
                    chain))))
    (- (changes low -1) (changes high 1))))

(defun $algebra_real_root_places (coefficients)
  "The real roots in order, to six decimals, of rational coefficients: by bisection."
  (let* ((p (algebra-primitive (mapcar #'algebra-rational-number (cdr coefficients))))
         (bound (1+ (ceiling (reduce #'max (mapcar #'abs (cdr p))) (abs (car p))))))
    (cons '(mlist simp)
          (mapcar (lambda (r) (coerce (/ (round (* r 1000000)) 1000000) 'double-float))
                  (algebra-places-between (algebra-sturm-chain p) (- bound) bound)))))

(defun algebra-places-between (chain low high)
  "Those in (LOW, HIGH]."
  (let ((count (algebra-chain-roots chain low high))
        (middle (/ (+ low high) 2)))
    (cond ((zerop count) '())
          ((< (- high low) 1/100000000) (make-list count :initial-element middle))
          (t (append (algebra-places-between chain low middle)
                     (algebra-places-between chain middle high))))))

(defun $algebra_real_root_intervals (coefficients width)
  "[[low, high], ..] in order, each shorter than WIDTH, with one real root in low < x <= high."
  (let* ((p (algebra-primitive (mapcar #'algebra-rational-number (cdr coefficients))))
         (bound (1+ (ceiling (reduce #'max (mapcar #'abs (cdr p))) (abs (car p)))))
         (width (algebra-rational-number width)))
    (cons '(mlist simp)
          (loop for interval in (algebra-isolated (algebra-sturm-chain p) (- bound) bound width)
                collect (cons '(mlist simp) (mapcar #'algebra-maxima-rational interval))))))

(defun algebra-isolated (chain low high width)
  (let ((count (algebra-chain-roots chain low high)) (middle (/ (+ low high) 2)))
    (cond ((zerop count) '())
          ((and (= count 1) (< (- high low) width)) (list (list low high)))
          (t (append (algebra-isolated chain low middle width)
                     (algebra-isolated chain middle high width))))))

(defun algebra-sturm-chain (p)
  "The chain of P without its multiple roots: at these all of it would vanish."
  (let* ((chain (algebra-remainders p (algebra-slope-numbers p)))
         (common (car (last chain))))
    (if (cdr common)
        (algebra-sturm-chain (algebra-primitive (nth-value 1 (algebra-division p common))))
        chain)))

(defun algebra-remainders (f g)
  (if (null g)
      (list f)
      (cons f (algebra-remainders
               g (algebra-primitive (mapcar #'- (algebra-division f g)))))))

;;; Lists of whole numbers, coefficients, the highest power first.

(defun algebra-primitive (numbers)
  "Rational NUMBERS as whole ones without a common factor, signs kept, leading zeros left out."
  (let* ((whole (algebra-without-fractions (member 0 numbers :test-not #'eql)))
         (content (reduce #'gcd whole :initial-value 0)))
    (if (member content '(0 1)) whole (mapcar (lambda (c) (truncate c content)) whole))))

(defun algebra-slope-numbers (p)
  (loop for c in (butlast p)
        for k downfrom (1- (length p))
        collect (* k c)))

(defun algebra-division (a b)
  "The remainder of A by B, and the quotient, both times one positive number."
  (let ((size (abs (car b))) (sign (signum (car b))) (quotient '()))
    (loop while (>= (length a) (length b))
          do (let ((factor (* sign (car a))))
               (if (zerop factor)
                   (setq quotient (cons 0 quotient)
                         a (cdr a))
                   (setq quotient (cons factor (mapcar (lambda (q) (* size q)) quotient))
                         a (append (loop for c in (cdr a)
                                         for d in (cdr b)
                                         collect (- (* size c) (* factor d)))
                                   (mapcar (lambda (c) (* size c)) (nthcdr (length b) a)))))))
    (values a (nreverse quotient))))

(defun algebra-sign-of-value (p x)
  (let ((n (numerator x)) (d (denominator x)) (value 0) (power 1))
    (dolist (c p (signum value))
      (setq value (+ (* value n) (* c power))
            power (* power d)))))

(defun algebra-sign-far-out (p direction)
  "The sign of P near inf for DIRECTION 1, near minf for -1."
  (* (signum (car p)) (if (oddp (length p)) 1 direction)))

(defun algebra-sign-changes (signs)
  (loop for (a b) on (remove 0 signs)
        count (and b (/= a b))))

(defun $algebra_sign_changes (signs)
  "In a list of the numbers 1, 0, -1."
  (algebra-sign-changes (cdr signs)))
