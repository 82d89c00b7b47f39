;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The sign of a real constant, zero included.  Intervals prove that it is not zero.  An algebraic
;;; number (nested roots, sines and cosines of parts of %pi) is zero if it is smaller than it could
;;; be otherwise (below): one interval of that many digits decides.  What intervals do not
;;; separate and no bound covers, or would take too many digits, is not decided.
;;; It begins with that bound.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/interval" "algebra/noun_values" "algebra/real_roots"))

;;; How small a real algebraic number can be that is not 0.  A constant is U/(m*L) with algebraic
;;; integers U, L and a whole m; u and l bound U and L in every embedding of their field, of degree
;;; D.  If U is not 0 its norm is at least 1, so |U| >= u^(1-D) and the constant at least
;;; 1/(m*l*u^(D-1))  (Burnikel, Funke, Mehlhorn, Schirra, Schmitt, A separation bound for real
;;; algebraic expressions, Algorithmica 55, 2009).  D counts each radical once, and all angles
;;; together: cosines of parts of a turn lie in one real cyclotomic field, of degree phi(N)/2.

;;; Bounds: u and l in units of 2^-32, rounded up to 96 digits; m exact.

(defstruct (algebra-bound (:conc-name algebra-bound-) (:constructor algebra-bound (u m l)))
  u m l)

(defconstant algebra-bound-digits 32)

(defun algebra-bound-of-number (r)
  "The bound of a rational, or of an algebraic integer over 1."
  (algebra-bound (ash (abs (numerator r)) algebra-bound-digits)
                 (denominator r)
                 (ash 1 algebra-bound-digits)))

(defun algebra-up (x)
  "The integer X with 96 digits, not less than it was."
  (let ((shift (- (integer-length x) 96)))
    (if (plusp shift) (ash (- (ash (- x) (- shift))) shift) x)))

(defun algebra-up-times (x y)
  (algebra-up (- (ash (- (* x y)) (- algebra-bound-digits)))))

(defun algebra-up-root (x n)
  (- (algebra-root-below (- (ash x (* (1- n) algebra-bound-digits))) n)))

(defun algebra-bound-sum (a b)
  (let ((m (lcm (algebra-bound-m a) (algebra-bound-m b))))
    (flet ((part (a b)
             (algebra-up (* (algebra-up-times (algebra-bound-u a) (algebra-bound-l b))
                            (floor m (algebra-bound-m a))))))
      (algebra-bound (+ (part a b) (part b a))
                     m
                     (algebra-up-times (algebra-bound-l a) (algebra-bound-l b))))))

(defun algebra-bound-product (a b)
  (algebra-bound (algebra-up-times (algebra-bound-u a) (algebra-bound-u b))
                 (* (algebra-bound-m a) (algebra-bound-m b))
                 (algebra-up-times (algebra-bound-l a) (algebra-bound-l b))))

(defun algebra-bound-inverse (a)
  (algebra-bound (algebra-up (* (algebra-bound-l a) (algebra-bound-m a)))
                 1
                 (algebra-bound-u a)))

(defun algebra-bound-root (a n)
  "The root of U/(m*L) is the root of U*(m*L)^(n-1), over m*L."
  (let ((below (algebra-up (* (algebra-bound-m a) (algebra-bound-l a))))
        (u (algebra-bound-u a)))
    (loop repeat (1- n) do (setq u (algebra-up-times u below)))
    (algebra-bound (algebra-up-root u n) (algebra-bound-m a) (algebra-bound-l a))))

(defun algebra-bound-power (a n)
  (cond ((minusp n) (algebra-bound-inverse (algebra-bound-power a (- n))))
        ((zerop n) (algebra-bound-of-number 1))
        ((evenp n) (let ((half (algebra-bound-power a (floor n 2))))
                     (algebra-bound-product half half)))
        (t (algebra-bound-product a (algebra-bound-power a (1- n))))))

;;; The bound of an expression in numbers, powers, real roots of polynomials, and sines and cosines
;;; of parts of %pi; all else throws not-algebraic.

(defun algebra-bound-of (e)
  (let ((number (algebra-rational-number e)))
    (cond (number (algebra-bound-of-number number))
          ((atom e) (throw 'not-algebraic nil))
          (t (case (caar e)
               (mplus (reduce #'algebra-bound-sum (mapcar #'algebra-bound-of (cdr e))))
               (mtimes (reduce #'algebra-bound-product (mapcar #'algebra-bound-of (cdr e))))
               (mexpt (algebra-bound-of-power (cadr e) (algebra-rational-number (caddr e))))
               ((%cos %sin) (if (algebra-turn-of e)
                                (algebra-bound (ash 2 algebra-bound-digits) 2
                                               (ash 1 algebra-bound-digits))
                                (throw 'not-algebraic nil)))
               (|$RealRoot| (if (algebra-real-root-p e)
                                (algebra-bound-of-real-root (cdadr e))
                                (throw 'not-algebraic nil)))
               (t (throw 'not-algebraic nil)))))))

(defun algebra-bound-of-real-root (p)
  "a0 times the root is an algebraic integer, each root below 1 + max|a_i/a0| (Cauchy)."
  (let ((first (abs (car p))))
    (algebra-bound (algebra-up (ash (+ first (reduce #'max (mapcar #'abs p)))
                                    algebra-bound-digits))
                   first
                   (ash 1 algebra-bound-digits))))

(defun algebra-algebraic-p (e)
  (and (catch 'not-algebraic (algebra-bound-of e)) t))

(defun algebra-bound-of-power (base exponent)
  (unless (and exponent (< (+ (abs (numerator exponent)) (denominator exponent)) 10000))
    (throw 'not-algebraic nil))
  (algebra-bound-power (algebra-bound-root (algebra-bound-of base) (denominator exponent))
                       (numerator exponent)))

(defun algebra-turn-of (e)
  "The part of a turn whose cosine E is, rational; nil for other expressions."
  (let ((part (and (consp e) (member (caar e) '(%cos %sin))
                   (algebra-rational-number (div (cadr e) (mul 2 '$%pi))))))
    (and part (if (eq (caar e) '%sin) (- 1/4 part) part))))

;;; The degree of a field that holds the values of some expressions.

(defun algebra-field-degree (expressions)
  (let ((radicals nil) (turns 1) (roots nil))
    (labels ((walk (e)
               (let ((turn (algebra-turn-of e)))
                 (cond ((atom e))
                       ((algebra-real-root-p e) (pushnew e roots :test #'alike1))
                       (turn (setq turns (lcm turns (denominator turn))))
                       ((and (mexptp e) (ratnump (caddr e)))
                        (setq radicals (algebra-with-radical (cadr e) (caddr (caddr e)) radicals))
                        (walk (cadr e)))
                       (t (mapc #'walk (cdr e)))))))
      (mapc #'walk expressions))
    (* (reduce #'* roots :key (lambda (root) (length (cddr (cadr root)))))
       (algebra-radicals-degree radicals)
       (max 1 (floor (algebra-totient turns) 2)))))

(defun algebra-with-radical (base degree radicals)
  "RADICALS, a list of (base . degree), with one more."
  (let ((known (assoc base radicals :test #'alike1)))
    (if known
        (acons base (lcm degree (cdr known)) (remove known radicals :test #'eq))
        (acons base degree radicals))))

(defun algebra-radicals-degree (radicals)
  "Roots of rationals are counted once each, or once for each of their primes."
  (flet ((degree (radicals) (reduce #'* radicals :key #'cdr)))
    (let ((numbers (remove-if-not #'algebra-rational-number radicals :key #'car)))
      (* (degree (set-difference radicals numbers :test #'eq))
         (min (degree numbers) (degree (algebra-prime-radicals numbers)))))))

(defun algebra-prime-radicals (radicals)
  (let ((primes nil))
    (loop for (base . degree) in radicals
          for number = (abs (algebra-rational-number base))
          do (dolist (part (list (numerator number) (denominator number)) primes)
               (loop for (prime) on (algebra-prime-factors part) by #'cddr
                     do (setq primes (algebra-with-radical prime degree primes)))))
    primes))

(defun algebra-totient (n)
  (loop with product = n
        for (prime) on (algebra-prime-factors n) by #'cddr
        do (setq product (* (floor product prime) (1- prime)))
        finally (return product)))

(defun algebra-binary-logarithm (x)
  "At least the binary logarithm of the integer X > 0, by less than 1/16 too much."
  (/ (integer-length (expt (algebra-up x) 16)) 16))

(defun algebra-log-of-bound (x)
  "The same of a bound in units of 2^-32, at least 0."
  (max 0 (- (algebra-binary-logarithm (max 1 x)) algebra-bound-digits)))

(defun algebra-separation-bits (e)
  "B: the constant E is 0 or its size at least 2^-B; nil where E is not known to be algebraic."
  (let ((bound (catch 'not-algebraic (algebra-bound-of e))))
    (and bound
         (ceiling (+ (algebra-binary-logarithm (algebra-bound-m bound))
                     (algebra-log-of-bound (algebra-bound-l bound))
                     (* (1- (algebra-field-degree (list e)))
                        (algebra-log-of-bound (algebra-bound-u bound))))))))

;;; ---- constant sign

(defparameter *algebra-most-bits* 30000 "binary digits that are spent on the sign of a constant")

(defparameter *algebra-kept-verdicts* 300 "for how many constants the verdict is kept")
(defvar *algebra-verdicts* (make-hash-table :test #'equal)
  "Constant -> verdict. What is not decided took the most digits, and is asked again and again.")

(defun algebra-constant-verdict (e)
  "1, -1 or 0, proved, for the real constant E; nil if it is not decided."
  (let ((number (algebra-rational-number e)))
    (if number
        (signum number)
        (multiple-value-bind (verdict kept) (gethash e *algebra-verdicts*)
          (if kept verdict (algebra-keep-verdict e (algebra-new-verdict e)))))))

(defun algebra-keep-verdict (e verdict)
  (when (>= (hash-table-count *algebra-verdicts*) *algebra-kept-verdicts*)
    (clrhash *algebra-verdicts*))
  (setf (gethash e *algebra-verdicts*) verdict))

(defun algebra-new-verdict (e)
  (or (algebra-interval-sign-among e '(64 256))
      (algebra-separated-sign e)))

(defun algebra-interval-sign (e)
  "1 or -1 if the constant E is proved positive or negative, else nil."
  (let ((sign (algebra-constant-verdict e)))
    (if (eql sign 0) nil sign)))

(defun algebra-separated-sign (e)
  (let* ((plain (catch 'algebra-undecided (algebra-plain-constant e)))
         (bits (and plain (algebra-separation-bits plain))))
    (cond ((null plain) nil)
          ((or (null bits) (> bits *algebra-most-bits*))
           (algebra-interval-sign-among plain '(1024 4096)))
          ((algebra-interval-sign-among plain (if (> bits 4096) '(1024))))
          (t (algebra-sign-or-zero plain bits)))))

(defun algebra-sign-or-zero (e bits)
  "The sign of E, which is 0 or in size at least 2^-BITS; more digits where E loses some."
  (loop for width in (list (+ bits 64) (* 2 (+ bits 64)))
        thereis (let* ((*algebra-interval-bits* width)
                       (interval (catch 'no-interval (algebra-i-of e))))
                  (cond ((null interval) nil)
                        ((plusp (car interval)) 1)
                        ((minusp (cdr interval)) -1)
                        ((algebra-i-below-p interval bits) 0)))))

(defun algebra-i-below-p (interval bits)
  "Whether all of INTERVAL is smaller than 2^-BITS."
  (< (max (abs (car interval)) (abs (cdr interval)))
     (ash 1 (max 0 (- *algebra-interval-bits* bits)))))

;;; A constant without absolute values, tangents and the like.  What stands under an even root or
;;; below the line is decided: a zero is written as 0.

(defun algebra-plain-constant (e)
  "E in sums, products, powers, sines and cosines; throws algebra-undecided."
  (cond ((eq e '$%phi) (algebra-golden-ratio))
        ((or (atom e) (algebra-rational-number e)) e)
        (t (case (caar e)
             ((mplus mtimes)
              (simplifya (cons (list (caar e)) (mapcar #'algebra-plain-constant (cdr e))) nil))
             (mexpt (algebra-plain-power (algebra-plain-constant (cadr e)) (caddr e)))
             (mabs (let ((inside (algebra-plain-constant (cadr e))))
                     (mul (algebra-decided-sign inside) inside)))
             (%tan (algebra-plain-ratio '%sin '%cos (cadr e)))
             (%cot (algebra-plain-ratio '%cos '%sin (cadr e)))
             (%sec (algebra-plain-ratio nil '%cos (cadr e)))
             (%csc (algebra-plain-ratio nil '%sin (cadr e)))
             (t (let ((value (algebra-noun-value e)))
                  (if value (algebra-plain-constant value) e)))))))

(defun algebra-plain-ratio (above below angle)
  (flet ((of (f) (if f (simplify (list (list f) angle)) 1)))
    (mul (of above) (algebra-plain-power (of below) -1))))

(defun algebra-plain-power (base exponent)
  (let ((number (algebra-rational-number exponent)))
    (if (or (null number) (algebra-rational-number base)
            (not (or (minusp number) (evenp (denominator number)))))
        (power base exponent)
        (let ((sign (algebra-decided-sign base)))
          (cond ((not (zerop sign)) (if (and (minusp sign) (evenp (denominator number)))
                                        (throw 'algebra-undecided nil)
                                        (power base exponent)))
                ((minusp number) (core-error "division by zero"))
                (t 0))))))

(defun algebra-decided-sign (e)
  (or (algebra-constant-verdict e) (throw 'algebra-undecided nil)))
