;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Intervals that surely hold a number: [lo, hi]/2^bits with integers lo <= hi, rounded outwards.
;;; Constants with roots, %pi, exponentials, logarithms and angles are enclosed; more bits make the
;;; interval shorter until the sign separates.  A zero is never proved here.  algebra-i makes an
;;; interval of a rational; algebra-i+, -, *, / are the arithmetic.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/interval_branches" "algebra/size" "algebra/noun_values" "algebra/nouns"
                "algebra/real_roots"))

(defvar *algebra-interval-bits* 64)
(defvar *algebra-point* nil "values of symbols and open functions: (expression . rational), ..")
(defvar *algebra-dummies* '() "intervals of dummy variables: (name . interval), ..")
(defvar *algebra-coordinate* nil "function: symbol or open function -> value; nil: constants only")

(defun algebra-interval-sign-among (e widths)
  (loop for bits in widths
        thereis (algebra-interval-sign-at e bits)))

(defun algebra-interval-sign-at (e bits)
  (let* ((*algebra-interval-bits* bits)
         (interval (catch 'no-interval (algebra-i-of e))))
    (cond ((null interval) nil)
          ((plusp (car interval)) 1)
          ((minusp (cdr interval)) -1))))

;;; Expressions.

(defun algebra-i-of (e)
  (cond ((rationalp e) (algebra-i e))
        ((eq e '$%pi) (algebra-i-pi))
        ((eq e '$%e) (algebra-i-exp (algebra-i 1)))
        ((eq e '$%phi) (algebra-i-of (algebra-golden-ratio)))
        ((symbolp e) (algebra-i-unknown e))
        ((atom e) (throw 'no-interval nil))
        (t (case (caar e)
             (rat (algebra-i (/ (cadr e) (caddr e))))
             (bigfloat (throw 'no-interval nil))
             (mplus (reduce #'algebra-i+ (mapcar #'algebra-i-of (cdr e))))
             (mtimes (reduce #'algebra-i* (mapcar #'algebra-i-of (cdr e))))
             (mexpt (algebra-i-general-power (cadr e) (caddr e)))
             (t (algebra-i-function e))))))

(defun algebra-i-function (e)
  (let ((x (and (cdr e) (null (cddr e)) (cadr e))))
    (case (and (or x (algebra-real-root-p e)) (caar e))
      (|$RealRoot| (algebra-scaled-root (cdadr e) (caddr e) *algebra-interval-bits*))
      (%sin (cdr (algebra-i-angle (algebra-i-of x))))
      (%cos (car (algebra-i-angle (algebra-i-of x))))
      (%tan (algebra-i-tangent (algebra-i-angle (algebra-i-of x))))
      (%cot (algebra-i/ (algebra-i 1) (algebra-i-tangent (algebra-i-angle (algebra-i-of x)))))
      (%sec (algebra-i/ (algebra-i 1) (car (algebra-i-angle (algebra-i-of x)))))
      (%csc (algebra-i/ (algebra-i 1) (cdr (algebra-i-angle (algebra-i-of x)))))
      (%sinh (car (algebra-i-hyperbolic (algebra-i-of x))))
      (%cosh (cdr (algebra-i-hyperbolic (algebra-i-of x))))
      (%tanh (let ((pair (algebra-i-hyperbolic (algebra-i-of x))))
               (algebra-i/ (car pair) (cdr pair))))
      (%log (algebra-i-log (algebra-i-of x)))
      (%atan (algebra-i-atan (algebra-i-of x)))
      (%asin (algebra-i-asin (algebra-i-of x)))
      (%acos (algebra-i- (algebra-i* (algebra-i 1/2) (algebra-i-pi))
                         (algebra-i-asin (algebra-i-of x))))
      (t (or (algebra-i-branched e #'algebra-i-of (algebra-i-unit)) (algebra-i-noun e))))))

(defun algebra-i-noun (e)
  "By its value; else an integral by parts of the interval, an open function as it is given."
  (let ((value (let ((*algebra-nouns-apart* t)) (algebra-noun-value e))))
    (cond (value (algebra-i-of value))
          ((and (eq (caar e) '%integrate) (= (length e) 5) (not (algebra-has-open-p (cadr e))))
           (algebra-i-integral (cdr e)))
          (t (algebra-i-unknown e)))))

(defun algebra-i-integral (parts)
  "The sum over equal parts, on each of which the integrand lies in an interval: wide intervals, 64
digits are enough."
  (when (> *algebra-interval-bits* 256) (throw 'no-interval nil))
  (let* ((more (- *algebra-interval-bits* 64))
         (sum (let ((*algebra-interval-bits* 64))
                (algebra-i-rectangles parts (if (plusp more) 256 32)))))
    (algebra-i-scale-up sum more)))

(defun algebra-i-rectangles (parts count)
  (destructuring-bind (body s low high) parts
    (let* ((start (algebra-i-of low))
           (step (algebra-i-over (algebra-i- (algebra-i-of high) start) count))
           (sum (algebra-i 0)))
      (dotimes (k count (algebra-i* sum step))
        (let ((*algebra-dummies*
                (acons s (algebra-i+ start (algebra-i* step (cons (* k (algebra-i-unit))
                                                                  (* (1+ k) (algebra-i-unit)))))
                       *algebra-dummies*)))
          (setq sum (algebra-i+ sum (algebra-i-of body))))))))

(defun algebra-i-tangent (angle)
  (algebra-i/ (cdr angle) (car angle)))

(defun algebra-i-unknown (e)
  "The value given to a symbol or an open function at the point tried."
  (let ((key (if (atom e) e (algebra-canonical-noun e))))
    (cond ((cdr (assoc e *algebra-dummies* :test #'eq)))
          ((assoc key *algebra-point* :test #'alike1)
           (algebra-i (cdr (assoc key *algebra-point* :test #'alike1))))
          ((or (null *algebra-coordinate*) (algebra-bound-at-point-p e key))
           (throw 'no-interval nil))
          (t (push (cons key (funcall *algebra-coordinate* key)) *algebra-point*)
             (algebra-i (cdar *algebra-point*))))))

(defun algebra-bound-at-point-p (e key)
  "Whether E, or KEY as it is written for all, is constant or may be bound to what has a value."
  (if (symbolp e)
      ($constantp e)
      (or (not (algebra-independent-noun-p key))
          (some (lambda (name) (among name e)) (mapcar #'car *algebra-dummies*))
          (some (lambda (entry) (algebra-bound-nouns-p key (car entry))) *algebra-point*))))

;;; Arithmetic.

(defun algebra-i-unit () (ash 1 *algebra-interval-bits*))

;; GCL's floor of -2^63 by 17 is not below the quotient, its ceiling is right.

(defun algebra-floor (n d) (- (values (ceiling (- n) d))))

(defun algebra-i (r)
  (let ((scaled (* r (algebra-i-unit))))
    (cons (algebra-floor (numerator scaled) (denominator scaled)) (ceiling scaled))))

(defun algebra-i+ (a b)
  (cons (+ (car a) (car b)) (+ (cdr a) (cdr b))))

(defun algebra-i-minus (a)
  (cons (- (cdr a)) (- (car a))))

(defun algebra-i- (a b)
  (algebra-i+ a (algebra-i-minus b)))

(defun algebra-i* (a b)
  (if (and (plusp (car a)) (plusp (car b)))
      (algebra-i-rounded (* (car a) (car b)) (* (cdr a) (cdr b)))
      (let ((products (list (* (car a) (car b)) (* (car a) (cdr b))
                            (* (cdr a) (car b)) (* (cdr a) (cdr b)))))
        (algebra-i-rounded (reduce #'min products) (reduce #'max products)))))

(defun algebra-i-rounded (low high)
  (let ((shift (- *algebra-interval-bits*)))
    (cons (ash low shift) (- (ash (- high) shift)))))

(defun algebra-i/ (a b)
  (unless (or (plusp (car b)) (minusp (cdr b))) (throw 'no-interval nil))
  (let ((quotients (loop for x in (list (car a) (cdr a))
                         append (loop for y in (list (car b) (cdr b))
                                      collect (/ (* x (algebra-i-unit)) y)))))
    (let ((least (reduce #'min quotients)))
      (cons (algebra-floor (numerator least) (denominator least))
            (ceiling (reduce #'max quotients))))))

(defun algebra-i-over (a n)
  "A divided by the integer N > 0."
  (cons (algebra-floor (car a) n) (ceiling (cdr a) n)))

(defun algebra-i-power (a n)
  (cond ((minusp n) (algebra-i/ (algebra-i 1) (algebra-i-power a (- n))))
        ((zerop n) (algebra-i 1))
        ((evenp n) (let ((half (algebra-i-power (algebra-i-abs a) (floor n 2))))
                     (algebra-i* half half)))
        (t (algebra-i* a (algebra-i-power a (1- n))))))

(defun algebra-i-general-power (base exponent)
  (let ((number (algebra-rational-number exponent)))
    (cond ((eq base '$%e) (algebra-i-exp (algebra-i-of exponent)))
          ((and number (> (max (abs (numerator number)) (denominator number)) 10000))
           (throw 'no-interval nil))
          ((integerp number) (algebra-i-power (algebra-i-of base) number))
          (number (algebra-i-power (algebra-i-root (algebra-i-of base) (denominator number))
                                   (numerator number)))
          (t (algebra-i-exp (algebra-i* (algebra-i-of exponent)
                                        (algebra-i-log (algebra-i-of base))))))))

(defun algebra-i-root (a n)
  "Odd roots of negative numbers are real, as Maxima has them."
  (when (and (evenp n) (minusp (car a))) (throw 'no-interval nil))
  (let ((shift (* (1- n) *algebra-interval-bits*)))
    (cons (algebra-root-below (ash (car a) shift) n)
          (- (algebra-root-below (- (ash (cdr a) shift)) n)))))

(defun algebra-root-below (a n)
  "The largest integer not above the root of A, which has the sign of A."
  (if (minusp a)
      (let ((root (algebra-integer-root (- a) n)))
        (- (if (= (expt root n) (- a)) root (1+ root))))
      (algebra-integer-root a n)))

(defun algebra-integer-root (a n)
  "The largest integer whose n-th power is not above A >= 0: Newton's iteration from above, which
the root of the leading half of the digits begins."
  (cond ((= n 2) (isqrt a))
        ((zerop a) 0)
        (t (loop with half = (floor (integer-length a) (* 2 n))
                 with x = (if (< half 16)
                              (ash 1 (ceiling (integer-length a) n))
                              (ash (1+ (algebra-integer-root (ash a (- (* n half))) n)) half))
                 for better = (floor (+ (* (1- n) x) (floor a (expt x (1- n)))) n)
                 while (< better x)
                 do (setq x better)
                 finally (return x)))))

;;; Series.  Each is summed in intervals; the remainder is below the last term kept.

(defun algebra-i-series (first next)
  "FIRST and the terms that follow, each by NEXT from the last and its place, halving at least."
  (let ((sum first) (term first))
    (loop for k from 1
          do (setq term (funcall next term k))
             (setq sum (algebra-i+ sum term))
          until (and (<= -2 (car term)) (<= (cdr term) 2)))
    (cons (- (car sum) 8) (+ (cdr sum) 8))))

(defun algebra-i-scale-up (x k)
  (cons (ash (car x) k) (ash (cdr x) k)))

(defun algebra-i-scale-down (x k)
  (cons (ash (car x) (- k)) (- (ash (- (cdr x)) (- k)))))

(defun algebra-i-halvings (x)
  "How often X is halved until it is below 1/4."
  (let ((size (- (max (integer-length (car x)) (integer-length (cdr x))) *algebra-interval-bits*)))
    (when (> size 20) (throw 'no-interval nil))
    (max 0 (+ size 2))))

(defmacro algebra-with-guard-bits ((count &rest intervals) &body body)
  "BODY with more bits for the INTERVALS, its interval rounded back."
  `(let ((guard ,count))
     (algebra-i-scale-down
      (let ((*algebra-interval-bits* (+ *algebra-interval-bits* guard))
            ,@(loop for x in intervals
                    collect `(,x (algebra-i-scale-up ,x guard))))
        ,@body)
      guard)))

(defun algebra-i-exp (x)
  (let ((k (algebra-i-halvings x)))
    (algebra-with-guard-bits ((+ 16 (* 2 k)) x)
      (let* ((small (algebra-i-scale-down x k))
             (power (algebra-i-series (algebra-i 1)
                                      (lambda (term n)
                                        (algebra-i-over (algebra-i* small term) n)))))
        (loop repeat k do (setq power (algebra-i* power power)))
        power))))

(defun algebra-i-hyperbolic (x)
  "(sinh . cosh)"
  (let* ((growing (algebra-i-exp x))
         (falling (algebra-i/ (algebra-i 1) growing))
         (half (algebra-i 1/2)))
    (cons (algebra-i* half (algebra-i- growing falling))
          (algebra-i* half (algebra-i+ growing falling)))))

(defun algebra-i-angle (x)
  "(cosine . sine) by halving the angle, the series, and doubling."
  (let* ((k (+ (algebra-i-halvings x) (isqrt (floor *algebra-interval-bits* 8))))
         (guard (+ 16 (* 3 k)))
         (angle (let ((*algebra-interval-bits* (+ *algebra-interval-bits* guard)))
                  (algebra-i-doubled (algebra-i-small-angle
                                      (algebra-i-scale-down (algebra-i-scale-up x guard) k))
                                     k))))
    (cons (algebra-i-scale-down (car angle) guard) (algebra-i-scale-down (cdr angle) guard))))

(defun algebra-i-small-angle (x)
  (let ((minus-square (algebra-i-minus (algebra-i* x x))))
    (flet ((series (first shift)
             (algebra-i-series
              first
              (lambda (term n)
                (algebra-i-over (algebra-i* minus-square term)
                                (* (+ n n shift) (+ n n shift -1)))))))
      (cons (series (algebra-i 1) 0) (series x 1)))))

(defun algebra-i-doubled (angle k)
  (loop repeat k
        do (destructuring-bind (c . s) angle
             (setq angle
                   (cons (algebra-i- (algebra-i 1) (algebra-i* (algebra-i 2) (algebra-i* s s)))
                         (algebra-i* (algebra-i 2) (algebra-i* s c))))))
  angle)

(defun algebra-i-odd-series (z sign)
  "z + sign*z^3/3 + z^5/5 + ..: atan for sign -1, artanh for 1; |z| below 1/2."
  (when (> (* 2 (max (abs (car z)) (abs (cdr z)))) (algebra-i-unit)) (throw 'no-interval nil))
  (let* ((square (algebra-i* (algebra-i sign) (algebra-i* z z)))
         (power z)
         (sum z))
    (loop for n from 3 by 2
          do (setq power (algebra-i* power square)
                   sum (algebra-i+ sum (algebra-i-over power n)))
          until (and (<= -2 (car power)) (<= (cdr power) 2)))
    (cons (- (car sum) 8) (+ (cdr sum) 8))))

(defun algebra-i-pi ()
  "Machin: 16*atan(1/5) - 4*atan(1/239)."
  (algebra-with-guard-bits (24)
    (algebra-i-
     (algebra-i* (algebra-i 16) (algebra-i-atan-of-inverse 5))
     (algebra-i* (algebra-i 4) (algebra-i-atan-of-inverse 239)))))

(defun algebra-i-atan-of-inverse (n)
  "atan(1/n) = 1/n - 1/(3*n^3) + .., each quotient of integers wrong by less than 2."
  (let ((power (floor (algebra-i-unit) n)) (sum 0) (terms 0))
    (loop until (zerop power)
          do (let ((term (floor power (1+ (* 2 terms)))))
               (setq sum (if (evenp terms) (+ sum term) (- sum term))
                     power (floor power (* n n))
                     terms (1+ terms))))
    (cons (- sum terms terms 2) (+ sum terms terms 2))))

(defun algebra-i-atan (x)
  "atan(x) = 2*atan(x/(1+sqrt(1+x^2))), three times."
  (algebra-with-guard-bits (24 x)
    (let ((one (algebra-i 1)))
      (loop repeat 3
            do (setq x (algebra-i/ x (algebra-i+ one (algebra-i-root
                                                      (algebra-i+ one (algebra-i-power x 2))
                                                      2)))))
      (algebra-i* (algebra-i 8) (algebra-i-odd-series x -1)))))

(defun algebra-i-asin (x)
  (let ((cosine (algebra-i-root (algebra-i- (algebra-i 1) (algebra-i-power x 2)) 2)))
    (algebra-i-atan (algebra-i/ x cosine))))

(defun algebra-i-log (x)
  "log(m*2^k) = k*log(2) + 2*artanh((m-1)/(m+1)) with m near 1."
  (unless (plusp (car x)) (throw 'no-interval nil))
  (algebra-with-guard-bits (32 x)
    (let* ((k (- (integer-length (car x)) *algebra-interval-bits*))
           (m (algebra-i* x (algebra-i (expt 2 (- k)))))
           (one (algebra-i 1)))
      (flet ((twice-artanh (m)
               (algebra-i* (algebra-i 2)
                           (algebra-i-odd-series (algebra-i/ (algebra-i- m one)
                                                             (algebra-i+ m one))
                                                 1))))
        (algebra-i+ (algebra-i* (algebra-i k) (twice-artanh (algebra-i 2)))
                    (twice-artanh m))))))
