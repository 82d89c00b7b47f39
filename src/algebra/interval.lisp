;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Intervals that surely hold a number: [lo, hi]/2^bits with integers lo <= hi, rounded outwards.
;;; Constants with roots, %pi, exponentials, logarithms and angles are enclosed; more bits make the
;;; interval shorter until the sign separates.  A zero is never proved here, only refused.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/nouns"))

(defvar *interval-bits* 64)
(defvar *interval-values* nil "values of symbols and open functions: (expression . rational), ..")
(defvar *interval-value-of* nil "function that gives a symbol its value; nil: constants only")

(defun algebra-interval-sign (e)
  "1 or -1 if the constant E is proved positive or negative, else nil."
  (algebra-interval-sign-among e '(64 192 640 2048)))

(defun algebra-interval-sign-among (e widths)
  (loop for bits in widths
        thereis (algebra-interval-sign-at e bits)))

(defun algebra-interval-sign-at (e bits)
  (let* ((*interval-bits* bits)
         (interval (catch 'no-interval (interval-of e))))
    (cond ((null interval) nil)
          ((plusp (car interval)) 1)
          ((minusp (cdr interval)) -1))))

;;; Expressions.

(defun interval-of (e)
  (cond ((rationalp e) (interval-rational e))
        ((floatp e) (interval-rational (algebra-rational-number e)))
        ((eq e '$%pi) (interval-pi))
        ((eq e '$%e) (interval-exp (interval-rational 1)))
        ((eq e '$%phi) (interval-of '((mtimes) ((rat) 1 2) ((mplus) 1 ((mexpt) 5 ((rat) 1 2))))))
        ((symbolp e) (interval-unknown e))
        ((atom e) (throw 'no-interval nil))
        (t (case (caar e)
             (rat (interval-rational (/ (cadr e) (caddr e))))
             (bigfloat (interval-of ($rationalize e)))
             (mplus (reduce #'interval-add (mapcar #'interval-of (cdr e))))
             (mtimes (reduce #'interval-multiply (mapcar #'interval-of (cdr e))))
             (mexpt (interval-power (cadr e) (caddr e)))
             (t (interval-function e))))))

(defun interval-function (e)
  (let ((x (and (cdr e) (null (cddr e)) (cadr e))))
    (case (and x (caar e))
      (%sin (cdr (interval-angle (interval-of x))))
      (%cos (car (interval-angle (interval-of x))))
      (%tan (interval-tangent (interval-angle (interval-of x))))
      (%cot (interval-divide (interval-rational 1)
                             (interval-tangent (interval-angle (interval-of x)))))
      (%sec (interval-divide (interval-rational 1) (car (interval-angle (interval-of x)))))
      (%csc (interval-divide (interval-rational 1) (cdr (interval-angle (interval-of x)))))
      (%sinh (car (interval-hyperbolic (interval-of x))))
      (%cosh (cdr (interval-hyperbolic (interval-of x))))
      (%tanh (let ((pair (interval-hyperbolic (interval-of x))))
               (interval-divide (car pair) (cdr pair))))
      (%log (interval-log (interval-of x)))
      (%atan (interval-atan (interval-of x)))
      (%asin (interval-asin (interval-of x)))
      (%acos (interval-subtract (interval-multiply (interval-rational 1/2) (interval-pi))
                                (interval-asin (interval-of x))))
      (mabs (interval-abs (interval-of x)))
      (t (interval-unknown e)))))

(defun interval-tangent (angle)
  (interval-divide (cdr angle) (car angle)))

(defun interval-unknown (e)
  "The value given to a symbol or an open function at the point tried."
  (unless (and *interval-value-of*
               (or (and (symbolp e) (not ($constantp e)))
                   (and (consp e) (algebra-open-p e))))
    (throw 'no-interval nil))
  (let ((key (if (atom e) e (algebra-canonical-noun e))))
    (interval-rational
     (cdr (or (assoc key *interval-values* :test #'alike1)
              (car (push (cons key (funcall *interval-value-of*)) *interval-values*)))))))

;;; Arithmetic.

(defun interval-unit () (ash 1 *interval-bits*))

(defun interval-rational (r)
  (let ((scaled (* r (interval-unit))))
    (cons (floor scaled) (ceiling scaled))))

(defun interval-add (a b)
  (cons (+ (car a) (car b)) (+ (cdr a) (cdr b))))

(defun interval-negate (a)
  (cons (- (cdr a)) (- (car a))))

(defun interval-subtract (a b)
  (interval-add a (interval-negate b)))

(defun interval-multiply (a b)
  (let ((products (list (* (car a) (car b)) (* (car a) (cdr b))
                        (* (cdr a) (car b)) (* (cdr a) (cdr b))))
        (shift (- *interval-bits*)))
    (cons (ash (reduce #'min products) shift)
          (- (ash (- (reduce #'max products)) shift)))))

(defun interval-divide (a b)
  (unless (or (plusp (car b)) (minusp (cdr b))) (throw 'no-interval nil))
  (let ((quotients (loop for x in (list (car a) (cdr a))
                         append (loop for y in (list (car b) (cdr b))
                                      collect (/ (* x (interval-unit)) y)))))
    (cons (floor (reduce #'min quotients)) (ceiling (reduce #'max quotients)))))

(defun interval-abs (a)
  (cond ((minusp (cdr a)) (interval-negate a))
        ((plusp (car a)) a)
        (t (cons 0 (max (- (car a)) (cdr a))))))

(defun interval-integer-power (a n)
  (cond ((minusp n) (interval-divide (interval-rational 1) (interval-integer-power a (- n))))
        ((zerop n) (interval-rational 1))
        ((evenp n) (let ((half (interval-integer-power (interval-abs a) (floor n 2))))
                     (interval-multiply half half)))
        (t (interval-multiply a (interval-integer-power a (1- n))))))

(defun interval-power (base exponent)
  (let ((number (algebra-rational-number exponent)))
    (cond ((eq base '$%e) (interval-exp (interval-of exponent)))
          ((and number (> (abs number) 10000)) (throw 'no-interval nil))
          ((integerp number) (interval-integer-power (interval-of base) number))
          (number (interval-integer-power (interval-root (interval-of base) (denominator number))
                                          (numerator number)))
          (t (interval-exp (interval-multiply (interval-of exponent)
                                              (interval-log (interval-of base))))))))

(defun interval-root (a n)
  (when (minusp (car a)) (throw 'no-interval nil))
  (let ((scale (ash 1 (* (1- n) *interval-bits*))))
    (cons (algebra-integer-root (* (car a) scale) n)
          (1+ (algebra-integer-root (* (cdr a) scale) n)))))

(defun algebra-integer-root (a n)
  "The largest integer whose n-th power is not above A >= 0."
  (if (= n 2)
      (isqrt a)
      (let ((low 0) (high (ash 1 (1+ (ceiling (integer-length a) n)))))
        (loop while (> (- high low) 1)
              do (let ((middle (ash (+ low high) -1)))
                   (if (<= (expt middle n) a) (setq low middle) (setq high middle))))
        low)))

;;; Series.  Each is summed in intervals; the remainder is below the last term kept.

(defun interval-series (first ratio-of)
  "FIRST and the terms that follow by RATIO-OF (an interval for each place), halving at least."
  (let ((sum first) (term first))
    (loop for k from 1
          do (setq term (interval-multiply term (funcall ratio-of k)))
             (setq sum (interval-add sum term))
          until (and (<= -2 (car term)) (<= (cdr term) 2)))
    (cons (- (car sum) 8) (+ (cdr sum) 8))))

(defun interval-scale-down (x k)
  (cons (ash (car x) (- k)) (- (ash (- (cdr x)) (- k)))))

(defun interval-halvings (x)
  "How often X is halved until it is below 1/4."
  (let ((size (- (max (integer-length (car x)) (integer-length (cdr x))) *interval-bits*)))
    (when (> size 20) (throw 'no-interval nil))
    (max 0 (+ size 2))))

(defmacro with-guard-bits ((count &rest intervals) &body body)
  "BODY with more bits for the INTERVALS, its interval rounded back."
  `(let ((guard ,count))
     (interval-scale-down
      (let ((*interval-bits* (+ *interval-bits* guard))
            ,@(loop for x in intervals
                    collect `(,x (cons (ash (car ,x) guard) (ash (cdr ,x) guard)))))
        ,@body)
      guard)))

(defun interval-exp (x)
  (let ((k (interval-halvings x)))
    (with-guard-bits ((+ 16 (* 2 k)) x)
      (let* ((small (interval-scale-down x k))
             (power (interval-series (interval-rational 1)
                                     (lambda (n) (interval-multiply
                                                  small (interval-rational (/ 1 n)))))))
        (loop repeat k do (setq power (interval-multiply power power)))
        power))))

(defun interval-hyperbolic (x)
  "(sinh . cosh)"
  (let* ((growing (interval-exp x))
         (falling (interval-divide (interval-rational 1) growing))
         (half (interval-rational 1/2)))
    (cons (interval-multiply half (interval-subtract growing falling))
          (interval-multiply half (interval-add growing falling)))))

(defun interval-angle (x)
  "(cosine . sine) by halving the angle, the series, and doubling."
  (let ((k (interval-halvings x)))
    (let (cosine sine)
      (setq cosine (with-guard-bits ((+ 16 (* 3 k)) x)
                     (car (interval-doubled (interval-small-angle (interval-scale-down x k)) k)))
            sine (with-guard-bits ((+ 16 (* 3 k)) x)
                   (cdr (interval-doubled (interval-small-angle (interval-scale-down x k)) k))))
      (cons cosine sine))))

(defun interval-small-angle (x)
  (let ((minus-square (interval-negate (interval-multiply x x))))
    (flet ((series (first shift)
             (interval-series first
                              (lambda (n)
                                (interval-multiply
                                 minus-square
                                 (interval-rational (/ 1 (* (+ n n shift) (+ n n shift -1)))))))))
      (cons (series (interval-rational 1) 0) (series x 1)))))

(defun interval-doubled (angle k)
  (loop repeat k
        do (destructuring-bind (c . s) angle
             (setq angle (cons (interval-subtract (interval-rational 1)
                                                  (interval-multiply (interval-rational 2)
                                                                     (interval-multiply s s)))
                               (interval-multiply (interval-rational 2)
                                                  (interval-multiply s c))))))
  angle)

(defun interval-odd-series (z sign)
  "z + sign*z^3/3 + z^5/5 + ..: atan for sign -1, artanh for 1; |z| below 1/2."
  (when (> (* 2 (max (abs (car z)) (abs (cdr z)))) (interval-unit)) (throw 'no-interval nil))
  (let* ((square (interval-multiply (interval-rational sign) (interval-multiply z z)))
         (power z)
         (sum z))
    (loop for n from 3 by 2
          do (setq power (interval-multiply power square)
                   sum (interval-add sum (interval-multiply power (interval-rational (/ 1 n)))))
          until (and (<= -2 (car power)) (<= (cdr power) 2)))
    (cons (- (car sum) 8) (+ (cdr sum) 8))))

(defun interval-pi ()
  "Machin: 16*atan(1/5) - 4*atan(1/239)."
  (with-guard-bits (16)
    (interval-subtract
     (interval-multiply (interval-rational 16) (interval-odd-series (interval-rational 1/5) -1))
     (interval-multiply (interval-rational 4) (interval-odd-series (interval-rational 1/239) -1)))))

(defun interval-atan (x)
  "atan(x) = 2*atan(x/(1+sqrt(1+x^2))), three times."
  (with-guard-bits (24 x)
    (let ((one (interval-rational 1)))
      (loop repeat 3
            do (setq x (interval-divide
                        x (interval-add one (interval-root
                                             (interval-add one (interval-integer-power x 2)) 2)))))
      (interval-multiply (interval-rational 8) (interval-odd-series x -1)))))

(defun interval-asin (x)
  (let ((cosine (interval-root (interval-subtract (interval-rational 1)
                                                  (interval-integer-power x 2))
                               2)))
    (interval-atan (interval-divide x cosine))))

(defun interval-log (x)
  "log(m*2^k) = k*log(2) + 2*artanh((m-1)/(m+1)) with m near 1."
  (unless (plusp (car x)) (throw 'no-interval nil))
  (with-guard-bits (32 x)
    (let* ((k (- (integer-length (car x)) *interval-bits*))
           (m (interval-multiply x (interval-rational (expt 2 (- k)))))
           (one (interval-rational 1)))
      (flet ((twice-artanh (m)
               (interval-multiply (interval-rational 2)
                                  (interval-odd-series
                                   (interval-divide (interval-subtract m one)
                                                    (interval-add m one))
                                   1))))
        (interval-add (interval-multiply (interval-rational k)
                                         (twice-artanh (interval-rational 2)))
                      (twice-artanh m))))))

;;; Points with rational coordinates at which the facts of the context hold.

(defun algebra-nonzero-somewhere-p (e)
  "E is proved not zero at one of some rational points that contradict no fact."
  (loop for attempt from 1 to 24
        thereis (algebra-nonzero-at-p e attempt)))

(defun algebra-nonzero-at-p (e attempt)
  (let* ((seed (* attempt 7919))
         (*interval-values* nil)
         (*interval-value-of*
           (lambda ()
             (setq seed (mod (+ (* seed 1103515245) 12345) 2147483648))
             (algebra-point-coordinate (floor seed 65536) attempt))))
    (and (not (algebra-facts-fail-p))
         (algebra-interval-sign-at e 192))))

(defun algebra-point-coordinate (random attempt)
  (let ((fraction (/ (+ 1 (mod random 96)) 97)))
    (ecase (mod attempt 4)
      (1 fraction)
      (2 (+ 1 fraction))
      (3 (* fraction (if (oddp (floor random 128)) 5 -5)))
      (0 (* 30 fraction)))))

(defun algebra-facts-fail-p ()
  (loop for fact in (cdr ($facts))
        thereis (and (consp fact)
                     (member (caar fact) '(mgreaterp mgeqp))
                     (let ((sign (algebra-interval-sign-at (sub (cadr fact) (caddr fact)) 64)))
                       (and sign (minusp sign))))))
