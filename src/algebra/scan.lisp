;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The scan names the kernels of an expression and leaves a skeleton: numbers, kernels, (+ ..),
;;; (* ..), (^ base n), (cosine terms), (sine terms), (power terms), where terms is a list of
;;; (rational . unit) or (known cosine sine).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/inverse_angles" "algebra/size" "algebra/kernels" "algebra/noun_values"
                "algebra/nouns" "algebra/root_kernels"))

(defvar *algebra-exponential-form* nil "true: sinh and cosh become exponentials")

(defun algebra-scan (e)
  (cond ((symbolp e) (algebra-scan-symbol e))
        ((rationalp e) e)
        ((or (floatp e) ($bfloatp e)) (algebra-decimal e))
        ((atom e) (algebra-outside e))
        (t (case (caar e)
             (rat (/ (cadr e) (caddr e)))
             (mplus (cons '+ (mapcar #'algebra-scan (cdr e))))
             (mtimes (cons '* (mapcar #'algebra-scan (cdr e))))
             (mminus (list '* -1 (algebra-scan (cadr e))))
             (mquotient (list '* (algebra-scan (cadr e)) (list '^ (algebra-scan (caddr e)) -1)))
             (mexpt (algebra-scan-power (cadr e) (caddr e)))
             (%sqrt (algebra-scan-power (cadr e) '((rat simp) 1 2)))
             (mrat (algebra-scan (ratdisrep e)))
             ((mlist $matrix $set mequal mnotequal mgreaterp mlessp mgeqp mleqp mand mor mnot msetq
               mdefine mcond mprog mprogn)
              (algebra-outside e))
             (mabs (algebra-absolute (cadr e) #'algebra-scan))
             (t (algebra-scan-function e))))))

(defun algebra-scan-symbol (e)
  (case e
    ($%i (algebra-root -1 2 #'algebra-scan))
    ($%e (algebra-scan-power '$%e 1))
    ($%phi (list '* 1/2 (list '+ 1 (algebra-root 5 2 #'algebra-scan))))
    (($inf $minf $infinity $und $ind nil t) (algebra-outside e))
    (t (or (gethash e (algebra-ring-symbols *algebra-ring*))
           (setf (gethash e (algebra-ring-symbols *algebra-ring*))
                 (algebra-new-kernel e 2 (not ($constantp e))))))))

(defun algebra-scan-function (e)
  (case (caar e)
    (%sin (algebra-scan-sine (cadr e) 'circular))
    (%cos (algebra-scan-cosine (cadr e) 'circular))
    (%tan (algebra-over (algebra-scan-sine (cadr e) 'circular)
                        (algebra-scan-cosine (cadr e) 'circular)))
    (%cot (algebra-over (algebra-scan-cosine (cadr e) 'circular)
                        (algebra-scan-sine (cadr e) 'circular)))
    (%sec (algebra-over 1 (algebra-scan-cosine (cadr e) 'circular)))
    (%csc (algebra-over 1 (algebra-scan-sine (cadr e) 'circular)))
    (%sinh (algebra-scan-hyperbolic-sine (cadr e)))
    (%cosh (algebra-scan-hyperbolic-cosine (cadr e)))
    (%tanh (algebra-over (algebra-scan-hyperbolic-sine (cadr e))
                         (algebra-scan-hyperbolic-cosine (cadr e))))
    (%coth (algebra-over (algebra-scan-hyperbolic-cosine (cadr e))
                         (algebra-scan-hyperbolic-sine (cadr e))))
    (%sech (algebra-over 1 (algebra-scan-hyperbolic-cosine (cadr e))))
    (%csch (algebra-over 1 (algebra-scan-hyperbolic-sine (cadr e))))
    (t (let ((value (algebra-noun-value e)))
         (if value (algebra-scan value) (algebra-opaque-kernel e))))))

;;; Hyperbolic functions: pairs of their own, or exponentials.

(defun algebra-scan-hyperbolic-sine (u)
  (if *algebra-exponential-form*
      (algebra-half-sum u -1)
      (algebra-scan-sine u 'hyperbolic)))

(defun algebra-scan-hyperbolic-cosine (u)
  (if *algebra-exponential-form*
      (algebra-half-sum u 1)
      (algebra-scan-cosine u 'hyperbolic)))

(defun algebra-half-sum (u sign)
  "(exp(u) + sign*exp(-u))/2"
  (let ((growing (algebra-scan-power '$%e u)))
    (list '* 1/2 (list '+ growing (list '* sign (list '^ growing -1))))))

;;; Angles and exponents: sums of rational multiples of units.

(defun algebra-scan-sine (angle kind)
  (if (eql angle 0) 0 (list 'sine (algebra-terms angle kind))))

(defun algebra-scan-cosine (angle kind)
  (if (eql angle 0) 1 (list 'cosine (algebra-terms angle kind))))

(defun algebra-terms (angle kind)
  (let ((sum (if (symbolp angle) angle ($expand (algebra-argument-form angle)))))
    (loop for term in (if (mplusp sum) (cdr sum) (list sum))
          collect (algebra-term term kind))))

(defun algebra-term (term kind)
  (or (and (eq kind 'circular) (or (algebra-known-angle term) (algebra-known-inverse term)))
      (multiple-value-bind (factor base) (algebra-angle-factor term kind)
        (algebra-unit-term factor (algebra-find-unit base kind)))))

(defun algebra-unit-term (factor unit)
  "The term FACTOR times the base of UNIT, whose step is made to divide it."
  (let ((apart (assoc (abs factor) (algebra-unit-apart unit))))
    (if apart
        (cons (signum factor) (cdr apart))
        (let ((term (cons factor unit)))
          (setf (algebra-unit-denominator unit)
                (* (algebra-unit-denominator unit)
                   (denominator (* factor (algebra-unit-denominator unit)))))
          (push term (algebra-unit-terms unit))
          term))))

(defun algebra-angle-factor (term kind)
  "Factor and base of TERM; each part of %pi is a base of its own, less than a half turn: as
multiples of a common part their polynomials would be long, and zeros are found without."
  (multiple-value-bind (factor base) (algebra-numeric-factor term)
    (if (and (eq kind 'circular) (eq base '$%pi))
        (let ((part (- (mod (1+ factor) 2) 1)))
          (values (if (minusp part) -1 1) (mul (algebra-maxima-rational (abs part)) '$%pi)))
        (values factor base))))

(defun algebra-known-angle (term)
  "(known cosine sine) for multiples of %pi whose sines Maxima knows by roots."
  (when (and (not (symbolp term)) (among '$%pi term) ($constantp term))
    (let ((cosine (simplify (list '(%cos) term)))
          (sine (simplify (list '(%sin) term))))
      (unless (or (among '$%pi cosine) (among '$%pi sine))
        (list 'known (algebra-scan cosine) (algebra-scan sine))))))

(defun algebra-known-inverse (term)
  "(known cosine sine) for whole multiples of acos(u), asin(u), atan(u), atan2(u, v)."
  (let ((pair (and (consp term)
                   (multiple-value-call #'algebra-inverse-angle (algebra-numeric-factor term)))))
    (and pair (list 'known (algebra-scan (car pair)) (algebra-scan (cdr pair))))))

(defun algebra-numeric-factor (term)
  "The number and the base of an angle; large multiples stay angles of their own."
  (let* ((product (mtimesp term))
         (number (algebra-rational-number (if product (cadr term) term))))
    (cond ((or (null number) (> (abs (numerator number)) 60)) (values 1 term))
          ((not product) (values number 1))
          ((cdddr term) (values number (cons '(mtimes simp) (cddr term))))
          (t (values number (caddr term))))))

(defparameter *algebra-root-order* 1000
  "Roots of a higher order are powers about which no more is known.")

(defun algebra-scan-power (base exponent)
  (let ((number (algebra-rational-number exponent)))
    (cond ((eq base '$%e) (list 'power (algebra-terms exponent '$%e)))
          ((integerp number) (list '^ (algebra-scan base) number))
          ((and number (<= (denominator number) *algebra-root-order*))
           (list '^ (algebra-root base (denominator number) #'algebra-scan) (numerator number)))
          (t (let ((plain (algebra-power-of-logarithm base exponent)))
               (if plain
                   (algebra-scan plain)
                   (list 'power (algebra-terms exponent (algebra-argument-form base)))))))))

(defun algebra-power-of-logarithm (base exponent)
  "a^(u*log(b)/log(a)) as b^u, a positive; else nil."
  (when (and (among '%log exponent) (eq (algebra-known-sign base) '$pos))
    (let ((plain (power '$%e ($expand (mul exponent (simplify (list '(%log) base)))))))
      (and (not (among '%log plain)) plain))))
