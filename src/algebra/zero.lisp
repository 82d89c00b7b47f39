;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Does an expression vanish?  Four questions, each with a word of its own:
;;;   (eql e 0)                   it is the number 0 as it stands;
;;;   algebra_zero_at_samples(e)  it is 0 at two random points: a check, no proof;
;;;   algebra_zerop(e)            it vanishes identically, proved; unknown where nothing is;
;;;   algebra_nonzero(e)          it cannot vanish where the facts hold (sign.lisp).
;;; algebra_zerop: true where the numerator vanishes modulo the relations of its kernels; false
;;; where a value at a point is not zero, modulo a prime where the kernels are independent, else by
;;; intervals.  It begins with polynomials in kernels.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/constant_sign" "algebra/evaluate" "algebra/interval" "algebra/kernels"
                "algebra/memory"
                "algebra/modular" "algebra/normal" "algebra/noun_values" "algebra/nouns"
                "algebra/random_numbers" "algebra/real_roots"
                "algebra/relations" "algebra/root_kernels" "algebra/scan" "algebra/size"))

;;; Does a reduced polynomial vanish?  Kernels are independent (symbols, open functions, angles) or
;;; constants; as a polynomial in the former it vanishes with its coefficients, which the sign of a
;;; constant decides.  Terms whose coefficient is a zero in disguise are left out of normal forms.

(defun algebra-polynomial-test (p)
  (let ((unsure (algebra-unsure-kernels p)))
    (cond ((pzerop p) 'zero)
          ((null unsure) 'not-zero)
          ((every #'algebra-constant-kernel-p unsure) (algebra-coefficients-test p))
          (t 'dependent))))

(defun algebra-unsure-kernels (p)
  (loop for kernel in (algebra-ring-kernels *algebra-ring*)
        unless (or (algebra-kernel-sure kernel)
                   (not (algebra-occurs-p (algebra-kernel-variable kernel) p)))
          collect kernel))

(defun algebra-constant-kernel-p (kernel)
  (algebra-constant-p (algebra-kernel-expression kernel)))

(defun algebra-coefficients-test (p)
  "A polynomial in independent kernels whose coefficients are constants: test each of these."
  (let ((answers (mapcar #'algebra-constant-test (algebra-constant-coefficients p))))
    (cond ((member 'dependent answers) 'dependent)
          ((member 'not-zero answers) 'not-zero)
          (t 'zero))))

(defun algebra-constant-coefficients (p)
  (let ((coefficients (list p)))
    (dolist (kernel (algebra-ring-kernels *algebra-ring*) coefficients)
      (when (or (algebra-kernel-sure kernel) (eq (algebra-kernel-expression kernel) '$%i))
        (setq coefficients (algebra-coefficients-of-all coefficients
                                                        (algebra-kernel-variable kernel)))))))

(defun algebra-coefficients-of-all (polynomials variable)
  (loop for p in polynomials
        append (mapcar #'cadr (algebra-powers p variable))))

(defun algebra-constant-test (p)
  "zero, not-zero or dependent, P a polynomial in constant kernels."
  (if (pzerop p)
      'zero
      (case (algebra-constant-verdict (simplify (pdisrep p)))
        (0 'zero)
        ((1 -1) 'not-zero)
        (t (if (algebra-zero-parts-p p) 'zero 'dependent)))))

(defun algebra-zero-parts-p (p)
  "P vanishes for every value of the transcendental constants in it."
  (let ((parts (list p)))
    (dolist (kernel (algebra-ring-kernels *algebra-ring*))
      (unless (algebra-algebraic-p (algebra-kernel-expression kernel))
        (setq parts (algebra-coefficients-of-all parts (algebra-kernel-variable kernel)))))
    (and (not (equal parts (list p)))
         (loop for part in parts
               always (eql 0 (algebra-constant-verdict (simplify (pdisrep part))))))))

(defun algebra-without-zero-terms (p)
  "P without the terms whose constant coefficients vanish."
  (if (some #'algebra-constant-kernel-p (algebra-unsure-kernels p))
      (algebra-nonzero-terms p (remove-if #'algebra-constant-kernel-p
                                          (algebra-ring-kernels *algebra-ring*)))
      p))

(defun algebra-nonzero-terms (p kernels)
  "The same, where KERNELS are those of P that are not constant."
  (if (null kernels)
      (if (eq 'zero (algebra-constant-test p)) 0 p)
      (let* ((variable (algebra-kernel-variable (car kernels)))
             (powers (algebra-powers p variable))
             (kept (loop for (nil coefficient) in powers
                         collect (algebra-nonzero-terms coefficient (cdr kernels)))))
        (if (every #'eq kept (mapcar #'cadr powers))
            p
            (algebra-sum-of-powers variable (mapcar #'car powers) kept)))))

(defun algebra-sum-of-powers (variable exponents coefficients)
  (let ((sum 0))
    (loop for exponent in exponents
          for coefficient in coefficients
          do (setq sum (pplus sum (ptimes coefficient
                                          (if (zerop exponent) 1 (list variable exponent 1))))))
    sum))

;;; ---- zero

(defun $algebra_zerop (e)
  "true, false or unknown, exactly"
  (algebra-asked-of-all (lambda (e) (if (numberp e) (zerop e) (algebra-zero-test e))) e))

(defun $algebra_zero_at_samples (e)
  "true: at two random points; false: surely not zero; unknown: roots or other bound kernels."
  (algebra-asked-of-all #'algebra-zero-at-samples e))

(defun algebra-asked-of-all (question e)
  "The answer for E, for the difference of both sides, for the worst of many elements."
  (cond ((mequalp e) (funcall question (sub (cadr e) (caddr e))))
        ((mbagp e) (algebra-worst-answer
                    (mapcar (lambda (part) (algebra-asked-of-all question part)) (cdr e))))
        (t (funcall question e))))

(defun algebra-worst-answer (answers)
  (cond ((member nil answers) nil)
        ((member '$unknown answers) '$unknown)
        (t t)))

;;; The proof

(defun algebra-zero-test (e)
  (case (or (and (algebra-with-real-root-p e) (eq 'zero (algebra-remainder-test e)) 'zero)
            (and (algebra-constant-p e) (algebra-constant-verdict e))
            (algebra-remainder-test e))
    ((0 zero) t)
    ((1 -1 not-zero) nil)
    (t (if (and (not (algebra-constant-p e)) (algebra-nonzero-somewhere-p e)) nil '$unknown))))

(setq *algebra-zero-judge* 'algebra-zero-test)

(defun algebra-decided-zero-p (e)
  "Whether E vanishes; an error where that is not decided."
  (or (eql e 0)
      (case (algebra-zero-test e)
        ((nil) nil)
        ((t) t)
        (t (algebra-zero-undecided e)))))

(defun algebra-zero-undecided (e)
  (core-undecided "it is not decided whether ~A vanishes" (algebra-short-text e)))

(defmacro with-algebra-zero-form (&body body)
  "Expressions are read as a zero test wants them: hyperbolic functions as exponentials, roots of
products apart, all multiples of angles expanded, nouns taken apart."
  `(let ((*algebra-exponential-form* t) (*algebra-roots-apart* t) (*algebra-every-multiple* t)
         (*algebra-nouns-apart* t))
     ,@body))

(defun algebra-remainder-test (e)
  "zero; not-zero; dependent: no zero polynomial, but its kernels may be bound; too-large."
  (if (algebra-plain-p e)
      (algebra-kept (list 'remainder *algebra-limit*) e
                    (lambda () (algebra-new-remainder-test e)))
      (algebra-new-remainder-test e)))

(defun algebra-new-remainder-test (e)
  (with-algebra-ring
    (with-algebra-zero-form
      (let ((skeleton (algebra-scan e)))
        (algebra-order-kernels)
        (if (algebra-seen-nonzero-p e (algebra-sampled-zero skeleton))
            'not-zero
            (let ((*algebra-may-give-up* t))
              (catch 'algebra-too-large
                (algebra-expanded-test (algebra-evaluate skeleton)))))))))

(defun algebra-seen-nonzero-p (e sampled)
  "E is not 0 at a point: by the answer SAMPLED modulo a prime, else at one of a few points by
intervals, which costs less than expanding roots."
  (if (eq sampled '$unknown)
      (and (not (algebra-constant-p e)) (algebra-nonzero-somewhere-p e 4))
      (null sampled)))

(defun algebra-expanded-test (quotient)
  (when (eq 'zero (algebra-polynomial-test (car (algebra-reduce (cdr quotient)))))
    (core-error "division by zero"))
  (algebra-polynomial-test (car (algebra-reduce (car quotient)))))

;;; At points modulo a prime, nothing expanded: rational points of the circle for the angles, any
;;; numbers for independent kernels.

(defun algebra-zero-at-samples (e)
  (with-algebra-ring
    (with-algebra-zero-form
      (let ((skeleton (algebra-scan e)))
        (algebra-number-kernels)
        (algebra-sampled-zero skeleton)))))

(defun algebra-sampled-zero (skeleton)
  "The answer for a skeleton in the ring at hand."
  (let ((samples (loop for seed in '(20011 70001)
                       collect (algebra-sample skeleton (algebra-modular-point seed)))))
    (cond ((member nil samples) '$unknown)
          ((some #'plusp samples) nil)
          (t t))))

(defun algebra-sample (skeleton point)
  "The value modulo the prime; nil if a kernel is not independent or a denominator vanishes."
  (if (every #'algebra-kernel-sure (algebra-ring-kernels *algebra-ring*))
      (catch 'no-sample (algebra-sampled skeleton point))))

(defun algebra-sampled (skeleton point)
  (cond ((integerp skeleton) (algebra-residue skeleton))
        ((rationalp skeleton)
         (algebra-modulo (* (algebra-residue (numerator skeleton))
                            (algebra-sampled-inverse (denominator skeleton)))))
        ((algebra-kernel-p skeleton) (gethash (algebra-kernel-variable skeleton) point))
        (t (ecase (car skeleton)
             (+ (algebra-sampled-sum (cdr skeleton) point))
             (* (algebra-sampled-product (cdr skeleton) point))
             (^ (algebra-sampled-power (algebra-sampled (cadr skeleton) point) (caddr skeleton)))
             (cosine (car (algebra-sampled-angle (cadr skeleton) point)))
             (sine (cdr (algebra-sampled-angle (cadr skeleton) point)))
             (power (algebra-sampled-exponential (cadr skeleton) point))))))

(defun algebra-sampled-sum (parts point)
  (let ((sum 0))
    (declare (fixnum sum))
    (dolist (part parts sum)
      (setq sum (algebra-modulo (+ sum (the fixnum (algebra-sampled part point))))))))

(defun algebra-sampled-product (parts point)
  (let ((product 1))
    (declare (fixnum product))
    (dolist (part parts product)
      (setq product (algebra-modulo (* product (the fixnum (algebra-sampled part point))))))))

(defun algebra-sampled-inverse (a)
  (if (zerop (mod a (algebra-prime)))
      (throw 'no-sample nil)
      (algebra-modular-inverse a)))

(defun algebra-sampled-power (base n)
  (if (minusp n)
      (algebra-sampled-power (algebra-sampled-inverse base) (- n))
      (algebra-modular-power base n)))

(defun algebra-sampled-angle (terms point)
  "(cosine . sine) of a sum of angles."
  (let ((first (algebra-sampled-term (car terms) point)))
    (if (null (cdr terms))
        first
        (algebra-sampled-turn first (algebra-sampled-angle (cdr terms) point)
                              (algebra-angle-sign (car terms))))))

(defun algebra-sampled-turn (a b sign)
  (cons (algebra-modulo (+ (algebra-modulo (* (car a) (car b)))
                           (* sign (algebra-modulo (* (cdr a) (cdr b))))))
        (algebra-modulo (+ (algebra-modulo (* (cdr a) (car b)))
                           (algebra-modulo (* (car a) (cdr b)))))))

(defun algebra-sampled-term (term point)
  (if (eq (car term) 'known)
      (cons (algebra-sampled (cadr term) point) (algebra-sampled (caddr term) point))
      (let* ((unit (cdr term))
             (n (* (car term) (algebra-unit-denominator unit)))
             (c (gethash (algebra-kernel-variable (algebra-unit-cosine unit)) point))
             (s (gethash (algebra-kernel-variable (algebra-unit-sine unit)) point))
             (step (cons c (if (minusp n) (mod (- s) (algebra-prime)) s)))
             (angle (cons 1 0)))
        (loop repeat (abs n)
              do (setq angle (algebra-sampled-turn angle step (algebra-angle-sign term))))
        angle)))

(defun algebra-sampled-exponential (terms point)
  (let ((product 1))
    (loop for (factor . unit) in terms
          for value = (gethash (algebra-kernel-variable (algebra-unit-cosine unit)) point)
          do (setq product
                   (algebra-modulo
                    (* product (algebra-sampled-power
                                value (* factor (algebra-unit-denominator unit)))))))
    product))

;;; Points with rational coordinates at which the facts of the context hold.

(defun algebra-nonzero-somewhere-p (e &optional (attempts 24))
  "E is proved not zero at one of some rational points that contradict no fact."
  (loop for attempt from 1 to attempts
        thereis (algebra-nonzero-at-p e attempt)))

(defun algebra-nonzero-at-p (e attempt)
  (let ((*algebra-point* nil)
        (*algebra-coordinate* (lambda (name) (algebra-point-coordinate name attempt))))
    (and (not (algebra-facts-fail-p))
         (algebra-interval-sign-at e 192))))

(defun algebra-point-coordinate (name attempt)
  "A number for NAME, such that the facts on this name alone hold where one is soon found: x > 3
beside y < -2 is met by few points of one sort."
  (let ((facts (algebra-facts-on name)))
    (or (loop repeat (if facts 40 1)
              for other from attempt by 25
              for value = (algebra-random-coordinate name other)
              thereis (let ((*algebra-point* (list (cons name value))))
                        (and (notany #'algebra-fact-fails-p facts) value)))
        (algebra-random-coordinate name attempt))))

(defun algebra-facts-on (name)
  "The facts in which NAME is the only one."
  (remove-if-not (lambda (fact) (equal (cdr ($listofvars (core-fact-difference fact))) (list name)))
                 (core-facts)))

(defun algebra-random-coordinate (name attempt)
  "Between 0 and 1, above 1, of either sign, or large: four sorts of ATTEMPT in turn."
  (multiple-value-bind (above rest)
      (algebra-random-below 96 (algebra-random-state name attempt))
    (let ((fraction (/ (1+ above) 97)))
      (ecase (mod attempt 4)
        (1 fraction)
        (2 (+ 1 fraction))
        (3 (* fraction (if (zerop (algebra-random-below 2 rest)) 5 -5)))
        (0 (* 30 fraction))))))

(defun algebra-facts-fail-p () (some #'algebra-fact-fails-p (core-facts)))

(defun algebra-fact-fails-p (fact)
  "Whether FACT does not hold at the point, for sure."
  (multiple-value-bind (e needed) (core-fact-difference fact)
    (let ((sign (and (member needed '($pos $pz)) (algebra-interval-sign-at e 64))))
      (and sign (minusp sign)))))
