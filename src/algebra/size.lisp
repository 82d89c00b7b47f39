;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The size of expressions, a bound of their degree, and the guard that stands before every
;;; expansion: running out of heap kills the Lisp, so a result that is predicted too large is
;;; refused with its figure.
;;; It begins with what all of the algebra uses.

(in-package :maxima)

;;; What all of the algebra uses: exact numbers, the least of several forms, Maxima's functions
;;; asked without consequences, and the words for what lies outside.

(defun algebra-rational-number (e)
  (cond ((rationalp e) e)
        ((ratnump e) (/ (cadr e) (caddr e)))))

(defun algebra-maxima-rational (r)
  "The rational R as Maxima holds it."
  (if (integerp r) r (list '(rat simp) (numerator r) (denominator r))))

(defun algebra-without-fractions (numbers)
  "Rational NUMBERS of Lisp times their least common denominator."
  (let ((denominator (reduce #'lcm numbers :key #'denominator :initial-value 1)))
    (mapcar (lambda (x) (* x denominator)) numbers)))

(defun algebra-prime-factors (n)
  "(prime power prime power ..); a large N counts as one prime."
  (cond ((= n 1) nil)
        ((< n (expt 10 14)) (cfactorw n))
        (t (list n 1))))

(defun algebra-golden-ratio ()
  (mul '((rat simp) 1 2) (add 1 (power 5 '((rat simp) 1 2)))))

(defun algebra-least (items measure)
  (let ((least (car items)) (smallest (funcall measure (car items))))
    (dolist (item (cdr items) least)
      (let ((size (funcall measure item)))
        (when (< size smallest) (setq least item smallest size))))))

(defun algebra-quietly (function)
  "The value of FUNCTION, nil if Maxima signals an error, or throws one as its polynomials do;
questions are errors, too."
  (let ((errcatch t) ($errormsg nil) (*mdebug* nil))
    (declare (special errcatch $errormsg *mdebug*))
    (car (errset (rat-error-to-merror (funcall function))))))

(defun algebra-outside (e)
  (core-error "a formula was expected, found ~A" (algebra-short-text e)))

(defun algebra-decimal (e)
  (core-error "the decimal ~A came into exact mathematics; type a fraction" (algebra-short-text e)))

(defun algebra-short-text (e)
  (core-cut (coerce (mstring e) 'string)))

;;; ---- size

(defvar *algebra-limit* 400000 "largest number of terms that an expansion may be predicted to give")

(defvar *algebra-may-give-up* nil "true: the guard throws algebra-too-large, no error")

(defvar *algebra-advice* nil
  "what else helps against too large a result: another form, where there is one")

(defun algebra-size (e)
  (let ((nodes 0))
    (declare (fixnum nodes))
    (labels ((walk (e)
               (incf nodes)
               (unless (atom e) (mapc #'walk (cdr e)))))
      (walk e)
      nodes)))

(defun $algebra_size (e)
  (algebra-size e))

(defun $algebra_size_with (e name value)
  "The number of nodes of E with VALUE in the place of NAME, simplification aside."
  (+ (algebra-size e) (* (algebra-count-of name e) (1- (algebra-size value)))))

(defun algebra-count-of (name e)
  "How often NAME stands in E."
  (if (atom e)
      (if (eq e name) 1 0)
      (loop for part in (cdr e) sum (algebra-count-of name part))))

(defun algebra-written-size (e)
  "The number of nodes of E written out, what is shared in memory counted every time."
  (let ((sizes (make-hash-table :test #'eq)))
    (labels ((size (e)
               (if (atom e)
                   1
                   (or (gethash e sizes)
                       (setf (gethash e sizes) (1+ (loop for part in (cdr e) sum (size part))))))))
      (size e))))

(defun algebra-guard-written (e what advice)
  "E, unless it would be too long to write: some five nodes make a term."
  (algebra-guard (floor (algebra-written-size e) 5) what advice)
  e)

(defun algebra-guard (predicted what &optional (advice *algebra-advice*))
  (when (> predicted *algebra-limit*)
    (when *algebra-may-give-up* (throw 'algebra-too-large 'too-large))
    (setq *core-too-large* t)
    (core-error "~A would have about ~A terms, more than the ~A that are safe~A"
                what (algebra-about predicted) *algebra-limit*
                (core-advised (core-number-advice) advice))))

(defun algebra-about (n)
  "Two leading digits of a large number."
  (let ((digits (length (format nil "~D" (floor n)))))
    (if (< digits 7) (floor n) (format nil "10^~D" (1- digits)))))

;; algebra_unless_long(e): the value of e, or false where what it expands would be too long.
(defmspec $algebra_unless_long (form)
  (let ((value (catch 'algebra-too-large
                 (let ((*algebra-may-give-up* t)) (meval (cadr form))))))
    (if (eq value 'too-large) nil value)))

(defun $algebra_guard (predicted what)
  (algebra-guard predicted (if (stringp what) what (coerce (mstring what) 'string)))
  '$done)

;;; Degree: from exponents alone, nothing is expanded.

(defun $algebra_degree_bound (e x)
  "Not less than the degree of E in X, if it is a polynomial."
  (cond ((eq e x) 1)
        ((atom e) 0)
        ((mplusp e) (reduce #'max (cdr e) :key (lambda (part) ($algebra_degree_bound part x))))
        ((mexptp e) (let ((n (caddr e)))
                      (* (if (typep n '(integer 0)) n 1) ($algebra_degree_bound (cadr e) x))))
        (t (loop for part in (cdr e) sum ($algebra_degree_bound part x)))))

;;; Products and powers of polynomials (Maxima's recursive form).

(defun algebra-monomials (p)
  (if (atom p)
      1
      (loop for (nil coefficient) on (cdr p) by #'cddr sum (algebra-monomials coefficient))))

(defun algebra-guard-product (p q)
  "Terms of P*Q: not more than the product of both counts, nor than their degrees allow."
  #-sbcl (core-watch) ; without a timer the clock is looked at here
  (let ((bound (* (algebra-monomials p) (algebra-monomials q))))
    (when (> bound *algebra-limit*)
      (algebra-guard (min bound (algebra-dense-bound (algebra-degrees p) (algebra-degrees q)))
                     "a product"))))

(defun algebra-guard-power (p n)
  (let* ((terms (algebra-monomials p))
         (order (abs n))
         (bound (algebra-binomial (+ terms order -1) order)))
    (when (> bound *algebra-limit*)
      (algebra-guard (min bound
                          (algebra-dense-bound
                           (loop for (variable . degree) in (algebra-degrees p)
                                 collect (cons variable (* degree order)))
                           nil))
                     "a power"))))

;;; Powers of numbers

(defparameter *algebra-most-digits* 100000 "decimal digits that a power of numbers may have")

(defun algebra-guard-power-of-number (base exponent)
  "An error where BASE^EXPONENT is a number too long to be computed."
  (let ((n (algebra-larger-part base)) (k (algebra-larger-part exponent)))
    (when (and n k (> n 1))
      (let ((digits (floor (* k (integer-length (1- n)) 30103) 100000)))
        (when (> digits *algebra-most-digits*)
          (setq *core-too-large* t)
          (core-error "~A would have about ~A digits, more than the ~A that are safe"
                      (core-words (list (list '(mexpt simp) base exponent)))
                      (algebra-about digits) *algebra-most-digits*))))))

(defun algebra-larger-part (number)
  "The larger one of numerator and denominator of a rational NUMBER, else nil."
  (cond ((integerp number) (abs number))
        ((ratnump number) (max (abs (cadr number)) (caddr number)))))

(defun algebra-binomial (n k)
  (let ((product 1))
    (loop for i from 1 to (min k (- n k))
          do (setq product (/ (* product (- (1+ n) i)) i))
          while (< product (expt 10 30)))
    product))

(defun algebra-degrees (p)
  "A list of (variable . degree)."
  (let ((degrees nil))
    (labels ((walk (p)
               (unless (atom p)
                 (let ((entry (assoc (car p) degrees :test #'eq)))
                   (if entry
                       (setf (cdr entry) (max (cdr entry) (cadr p)))
                       (push (cons (car p) (cadr p)) degrees)))
                 (loop for (nil coefficient) on (cdr p) by #'cddr do (walk coefficient)))))
      (walk p)
      degrees)))

(defun algebra-dense-bound (degrees more)
  (let ((bound 1))
    (loop for (variable . degree) in degrees
          do (setq bound (* bound (+ 1 degree
                                     (or (cdr (assoc variable more :test #'eq)) 0)))))
    (loop for (variable . degree) in more
          unless (assoc variable degrees :test #'eq) do (setq bound (* bound (1+ degree))))
    bound))
