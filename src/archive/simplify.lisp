;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Sums, products and powers as Maxima simplifies them, for text that nobody vouches for: no step
;;; may hang, exhaust the heap, ask, or depend on what the session assumes. Sizes of numbers are
;;; predicted before Maxima computes them. What is too costly to simplify stays as written. Look
;;; first at archive-sum, archive-product and archive-power; functions: function_values.lisp.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/tokens" "archive/plain_simplifier" "core/bigfloats"))

(defvar *archive-reader* nil
  "The reader whose text is being simplified, for the place of an error.")
(defvar *archive-position* 0 "Where the expression begins that is being simplified.")

(defparameter *archive-factors* 4000 "The most factors in one product.")
(defparameter *archive-steps* 20000000
  "The most steps that the products of one archive may take, about ten seconds.")
(defvar *archive-work* nil
  "A list of the number of steps that the products of an archive have taken.")
(defparameter *archive-weight* 20000
  "The most digits that the numbers of one product may have together.")
(defparameter *archive-root-order* 1000 "The largest order of a root of a number.")

(defun archive-refuse (control &rest arguments)
  "An error at the expression being simplified."
  (apply #'archive-fault *archive-reader* *archive-position* control arguments))

;; Sizes

(defun archive-integer-digits (n)
  "About the number of decimal digits of the integer N."
  (ceiling (* (integer-length n) 30103) 100000))

(defun archive-digits (e)
  "About the number of digits of E if it is a number, else 0."
  (cond ((integerp e) (archive-integer-digits e))
        ((ratnump e) (max (archive-integer-digits (cadr e)) (archive-integer-digits (caddr e))))
        (t 0)))

(defun archive-factors-of (e) (if (mtimesp e) (cdr e) (list e)))

(defun archive-weight (e)
  "Digits of the numbers in E that meet other numbers when E is multiplied: coefficient,
exponents."
  (loop for factor in (archive-factors-of e)
        sum (cond ((mexptp factor) (archive-digits (caddr factor)))
                  (t (archive-digits factor)))))

(defun archive-coefficient (e)
  "The number in front of the product E, E if it is a number, else 0."
  (cond ((mnump e) e)
        ((and (mtimesp e) (mnump (cadr e))) (cadr e))
        (t 0)))

(defun archive-added-number (e)
  "The number that is added in the sum E, E if it is a number, else 0."
  (cond ((mnump e) e)
        ((and (mplusp e) (mnump (cadr e))) (cadr e))
        (t 0)))

(defun archive-ceiling (number)
  "The least integer not below the size of NUMBER."
  (if (integerp number) (abs number) (ceiling (abs (cadr number)) (caddr number))))

(defun archive-decimal-size (number)
  "The logarithm to base 10 of NUMBER, or of its larger part, as a rational that is a little too
large."
  (let ((n (if (integerp number) (abs number) (max (abs (cadr number)) (caddr number)))))
    (if (< n 1000000) (rational (+ (log (float n 1d0) 10) 1d-9)) (archive-integer-digits n))))

(defun archive-check-power-size (base exponent)
  "An error if the number BASE to the number in EXPONENT has too many digits."
  (let ((part (archive-added-number exponent)))
    (when (and (mnump base) (not (floatp base)) (not (floatp part))
               (not (member base '(0 1 -1)))
               (> (* (archive-decimal-size base) (archive-ceiling part)) *archive-digits*))
      (archive-refuse "a power with more than ~d digits" *archive-digits*))))

(defun archive-check-number (number)
  "NUMBER, or an error if it has too many digits or, as a double, no value."
  (when (and (floatp number) (not (<= (abs number) most-positive-double-float)))
    (archive-refuse "a result outside the range of doubles"))
  (when (> (archive-digits number) *archive-weight*)
    (archive-refuse "a number with more than ~d digits" *archive-weight*))
  number)

(defun archive-check-root (number order)
  "An error if the root of NUMBER of this ORDER would take long: Maxima looks for the number's
factors."
  (when (> order *archive-root-order*)
    (archive-refuse "a root of an order above ~d" *archive-root-order*))
  (dolist (n (if (integerp number) (list number) (cdr number)))
    (when (> (archive-integer-digits (archive-without-small-factors n)) 18)
      (archive-refuse "a root of a number with a factor of more than 18 digits, too large to be ~
                       factored"))))

(defun archive-without-small-factors (n)
  "N without its prime factors below 100; N itself when it is very long."
  (when (< (integer-length n) 4000)
    (dolist (p '(2 3 5 7 11 13 17 19 23 29 31 37 41 43 47 53 59 61 67 71 73 79 83 89 97))
      (loop while (and (/= n 0) (zerop (rem n p))) do (setq n (floor n p)))))
  n)

;; Sums

(defun archive-sum (terms)
  "The sum of simplified TERMS."
  (archive-merged-sum (archive-ordered terms)))

(defun archive-merged-sum (terms)
  "The sum of TERMS; halves are merged, so that a long sum takes n*log(n) steps."
  (let ((n (length terms)))
    (cond ((= n 1) (car terms))
          ((<= n 4) (archive-check-sum (archive-simplified (list* '(mplus) terms))))
          (t (let ((half (floor n 2)))
               (archive-check-sum
                (archive-simplified (list '(mplus)
                                          (archive-merged-sum (subseq terms 0 half))
                                          (archive-merged-sum (nthcdr half terms))))))))))

(defun archive-check-sum (sum)
  "SUM, or an error if one of its numbers has grown too long."
  (dolist (term (if (mplusp sum) (cdr sum) (list sum)) sum)
    (archive-check-number (archive-coefficient term))))

(defun archive-negative (e)
  "-E"
  (cond ((floatp e) (- e))
        (($bfloatp e) (core-bigfloat-negative e))
        ((mnump e) (timesk -1 e))
        (t (archive-simplified (list '(mtimes) -1 e)))))

;; Products

(defun archive-product (factors)
  "The product of simplified FACTORS."
  (cond ((null (cdr factors)) (car factors))
        ((loop for factor in factors always (mnump factor)) (archive-number-product factors))
        (t (archive-check-factors factors)
           (archive-check-product (archive-simplified (list* '(mtimes)
                                                             (archive-ordered factors)))))))

(defun archive-number-product (numbers)
  "The product of NUMBERS, by halves."
  (when (> (loop for number in numbers sum (archive-bits number)) (* 10 *archive-weight*))
    (archive-refuse "a product whose numbers have more than ~d digits together" *archive-weight*))
  (labels ((product (numbers n)
             (if (= n 1)
                 (car numbers)
                 (let ((half (floor n 2)))
                   (archive-check-number (timesk (product numbers half)
                                                 (product (nthcdr half numbers) (- n half))))))))
    (product numbers (length numbers))))

(defun archive-bits (number)
  (cond ((integerp number) (integer-length number))
        ((ratnump number) (+ (integer-length (cadr number)) (integer-length (caddr number))))
        (t 0)))

(defun archive-check-factors (factors)
  (let ((number (loop for f in factors sum (length (archive-factors-of f)))))
    (when (> number *archive-factors*)
      (archive-refuse "a product of more than ~d factors" *archive-factors*))
    (archive-count-work (* number number))
    (when (> number 50)
      (archive-count-work (floor (* number (loop for f in factors sum (archive-size f))) 50))))
  (when (> (loop for factor in factors sum (archive-weight factor)) *archive-weight*)
    (archive-refuse "a product whose numbers have more than ~d digits together" *archive-weight*))
  (archive-check-common-root factors))

(defun archive-size (e)
  "The number of atoms in E, operators among them."
  (if (atom e) 1 (loop for part in (cdr e) sum (archive-size part) into size finally
                   (return (1+ size)))))

(defun archive-count-work (steps)
  "Adds the STEPS of a product, whose factors Maxima compares and copies, to those of the archive."
  (when *archive-work*
    (when (> (incf (car *archive-work*) steps) *archive-steps*)
      (archive-refuse "products too long and too many to be simplified: more than ~d steps"
                      *archive-steps*))))

(defun archive-check-common-root (factors)
  "An error if roots of numbers in FACTORS would meet in a root of too high an order."
  (let ((order 1))
    (dolist (e factors)
      (dolist (factor (archive-factors-of e))
        (when (and (mexptp factor) (mnump (cadr factor)) (ratnump (caddr factor)))
          (setq order (lcm order (caddr (caddr factor)))))))
    (when (> order *archive-root-order*)
      (archive-refuse "roots of numbers that meet in a root of an order above ~d"
                      *archive-root-order*))))

(defun archive-check-product (product)
  "PRODUCT, or an error if a power of a number in it has grown too large."
  (dolist (factor (archive-factors-of product) product)
    (when (mexptp factor) (archive-check-power-size (cadr factor) (caddr factor)))))

(defun archive-inverse (e)
  "1/E"
  (when (zerop1 e) (archive-refuse "division by zero"))
  (if (floatp e)
      (archive-double-or-refuse (lambda () (/ 1d0 e)))
      (archive-power e -1)))

(defun archive-quotient-of-numbers (a b)
  "A/B for doubles and exact numbers: one rounding, not two."
  (when (zerop1 b) (archive-refuse "division by zero"))
  (archive-double-or-refuse (lambda () (/ (archive-double a) (archive-double b)))))

(defun archive-double (number)
  (cond ((floatp number) number)
        (t (or (archive-nearest-double (if (integerp number) number
                                           (/ (cadr number) (caddr number))))
               (archive-refuse "the number is too large for a double")))))

(defun archive-double-or-refuse (function)
  "The double that FUNCTION returns, or an error if the floating-point unit finds none."
  (let ((double (ignore-errors (funcall function))))
    (if (and (floatp double) (<= (abs double) most-positive-double-float))
        double
        (archive-refuse "a result outside the range of doubles"))))

;; Powers

(defun archive-power (base exponent)
  "BASE^EXPONENT"
  (cond ((zerop1 base) (archive-power-of-zero base exponent))
        ((or (floatp base) (floatp exponent)) (archive-power-with-doubles base exponent))
        ((eq base '$%e) (archive-exponential exponent))
        ((mnump base) (archive-power-of-number base exponent))
        ((and (mtimesp base) (integerp exponent))
         (archive-product (mapcar (lambda (factor) (archive-power factor exponent)) (cdr base))))
        ((and (mexptp base) (integerp exponent))
         (archive-power (cadr base) (archive-product (list (caddr base) exponent))))
        ((mtimesp base) (archive-power-of-product base exponent))
        ((and (consp base) (eq (caar base) 'mabs)) (list '(mexpt simp) base exponent))
        (t (archive-check-product (archive-simplified (list '(mexpt) base exponent))))))

(defun archive-power-of-zero (base exponent)
  (cond ((zerop1 exponent) (archive-refuse "0^0 has no value"))
        ((not (mnump exponent)) (archive-refuse "0 to a power whose sign is not known"))
        ((mnegp exponent) (archive-refuse "division by zero"))
        (t base)))

(defun archive-power-of-number (base exponent)
  (archive-check-power-size base exponent)
  (when (ratnump exponent) (archive-check-root base (caddr exponent)))
  (archive-simplified (list '(mexpt) base exponent)))

(defun archive-power-of-product (base exponent)
  "A power of a product, whose numbers Maxima takes out: they are checked first."
  (dolist (factor (cdr base))
    (let ((number (if (mexptp factor) (cadr factor) factor)))
      (when (mnump number)
        (archive-check-power-size number exponent)
        (when (ratnump exponent) (archive-check-root number (caddr exponent))))))
  (archive-check-product (archive-simplified (list '(mexpt) base exponent))))

(defun archive-power-with-doubles (base exponent)
  "A power in a table of numerical results: of numbers a double, else as it stands."
  (if (and (mnump base) (mnump exponent))
      (archive-double-or-refuse (lambda () (expt (archive-double base)
                                                 (if (integerp exponent) exponent
                                                     (archive-double exponent)))))
      (list '(mexpt simp) base exponent)))

(defun archive-exponential (exponent)
  "%e^EXPONENT; as it stands where Maxima's rules for logarithms and %i*%pi inside could take
long."
  (cond ((floatp exponent) (archive-double-or-refuse (lambda () (exp exponent))))
        ((and (archive-contains-p exponent '%log) (not (archive-modest-p exponent)))
         (list '(mexpt simp) '$%e exponent))
        ((and (archive-contains-p exponent '$%i) (archive-contains-p exponent '$%pi)
              (not (archive-modest-p exponent)))
         (list '(mexpt simp) '$%e exponent))
        (t (archive-simplified (list '(mexpt) '$%e exponent)))))

(defun archive-contains-p (e word)
  "True when the symbol WORD is an atom or an operator in E."
  (cond ((atom e) (eq e word))
        ((eq (caar e) word) t)
        (t (loop for part in (cdr e) thereis (archive-contains-p part word)))))

(defun archive-modest-p (e)
  "True when E is so small that Maxima may expand it: few nodes, short numbers, small exponents."
  (let ((nodes 60))
    (labels ((visit (e)
               (decf nodes)
               (and (plusp nodes)
                    (cond ((mnump e) (< (archive-digits e) 4))
                          ((atom e) t)
                          ((mexptp e) (and (visit (cadr e)) (archive-small-exponent-p (caddr e))
                                           (visit (caddr e))))
                          (t (loop for part in (cdr e) always (visit part)))))))
      (visit e))))

(defun archive-small-exponent-p (e)
  (or (not (mnump e)) (<= (archive-ceiling e) 3)))
