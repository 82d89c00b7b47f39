;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The adversary of signs: random facts that hold at some point, random expressions, and points
;;; with rational coordinates at which all facts hold. A sign that was decided must be the sign at
;;; each such point, by arithmetic alone; facts that hold somewhere must not be called
;;; contradictory; what Maxima's simplifier makes of abs, sqrt, signum and max while we compute
;;; must have the value that it had before. Look first at fuzz-signs-case.

(in-package :maxima)

(core-require "algebra/sign")

(defvar *signs-state* 1 "State of the generator of random numbers.")
(defparameter *signs-names* '($a $b $c |$a| $x))

(defun signs-random (n)
  (setq *signs-state* (logand (+ (* *signs-state* 25214903917) 11) #xffffffffffff))
  (mod (ash *signs-state* -17) n))

(defun signs-choice (list) (nth (signs-random (length list)) list))

(defun signs-number ()
  (let ((n (- (signs-random 13) 6)))
    (if (zerop (signs-random 4)) (/ n (1+ (signs-random 4))) n)))

;;; Points: ((name . rational) ..)

(defun signs-point () (loop for name in *signs-names* collect (cons name (signs-number))))

(defun signs-near (point)
  "A point beside POINT in some of its coordinates; often on the border of a fact."
  (loop for (name . value) in point
        collect (cons name (case (signs-random 8)
                             (3 (signs-number))
                             (4 (cdr (signs-choice point)))
                             (0 (+ value (/ (signs-number) (1+ (signs-random 40)))))
                             (1 (+ value (signs-number)))
                             (2 (* value (1+ (signs-random 9))))
                             (t value)))))

(defun signs-value (e point)
  "The value of E, by rational arithmetic; throws no-value where there is none."
  (cond ((rationalp e) e)
        ((ratnump e) (/ (cadr e) (caddr e)))
        ((symbolp e) (or (cdr (assoc e point)) (throw 'no-value nil)))
        (t (let ((parts (mapcar (lambda (part) (signs-value part point)) (cdr e))))
             (case (caar e)
               (mplus (reduce #'+ parts))
               (mtimes (reduce #'* parts))
               (mexpt (signs-power (first parts) (second parts)))
               (mabs (abs (first parts)))
               (%signum (signum (first parts)))
               ($max (reduce #'max parts))
               ($min (reduce #'min parts))
               (t (throw 'no-value nil)))))))

(defun signs-power (base exponent)
  (cond ((and (zerop base) (<= exponent 0)) (throw 'no-value nil))
        ((integerp exponent) (expt base exponent))
        (t (let ((root (signs-root base (denominator exponent))))
             (unless root (throw 'no-value nil))
             (signs-power root (numerator exponent))))))

(defun signs-root (base degree)
  "The rational root of BASE, or nil."
  (flet ((whole (n) (let ((root (round (expt (float n 1d0) (/ 1d0 degree)))))
                      (and (= n (expt root degree)) root))))
    (let ((n (whole (abs (numerator base)))) (d (whole (denominator base))))
      (and n d (or (plusp base) (zerop base) (oddp degree))
           (if (minusp base) (- (/ n d)) (/ n d))))))

;;; Facts that hold at a point

(defun signs-expression ()
  "A short sum for a fact."
  (case (signs-random 9)
    ((0 1 6 7 8) (sub (signs-choice *signs-names*) (algebra-maxima-rational (signs-number))))
    (2 (signs-choice *signs-names*))
    (3 (sub (signs-choice *signs-names*) (signs-choice *signs-names*)))
    (4 (add (signs-choice *signs-names*) (mul (signs-number-m) (signs-choice *signs-names*))
            (signs-number-m)))
    (t (add (mul (signs-choice *signs-names*) (signs-choice *signs-names*)) (signs-number-m)))))

(defun signs-number-m () (algebra-maxima-rational (signs-number)))

(defun signs-fact (point)
  "A relation that holds at POINT."
  (let* ((e (signs-expression)) (value (signs-value e point)))
    (cond ((plusp value) (list (signs-choice '((mgreaterp) (mgeqp) (mgreaterp))) e 0))
          ((minusp value) (list (signs-choice '((mlessp) (mleqp) (mlessp))) e 0))
          (t (list (signs-choice '((mgeqp) (mleqp))) e 0)))))

(defun signs-holds-p (fact point)
  (let ((value (signs-value (second fact) point)))
    (ecase (caar fact)
      (mgreaterp (plusp value)) (mgeqp (>= value 0))
      (mlessp (minusp value)) (mleqp (<= value 0)))))

(defun signs-points (facts point count)
  "POINT, and those of COUNT points beside it at which the FACTS hold."
  (cons point (remove-if-not (lambda (p) (every (lambda (f) (signs-holds-p f p)) facts))
                             (loop repeat count collect (signs-near point)))))

;;; Expressions to be judged

(defun signs-polynomial (depth)
  (if (zerop depth)
      (if (zerop (signs-random 3)) (signs-number-m) (signs-choice *signs-names*))
      (case (signs-random 7)
        ((0 1 2) (add (signs-polynomial (1- depth)) (signs-polynomial (1- depth))))
        ((3 4) (mul (signs-polynomial (1- depth)) (signs-polynomial (1- depth))))
        (5 (sub (power (signs-polynomial (1- depth)) 2) (signs-polynomial (1- depth))))
        (t (sub (signs-polynomial (1- depth)) (signs-polynomial (1- depth)))))))

(defun signs-short ()
  "A few terms with products of names."
  (addn (loop repeat (+ 2 (signs-random 2))
              collect (muln (cons (signs-number-m)
                                  (loop repeat (signs-random 3)
                                        collect (signs-choice *signs-names*)))
                            nil))
        nil))

(defun signs-wrapped (depth)
  "A polynomial, or one inside of abs, a root, signum, max, or below a line."
  (let ((e (signs-polynomial depth)))
    (case (signs-random 18)
      ((12 13 14 15 16 17) (signs-short))
      (0 (sub (simplify (list '(mabs) e)) (signs-polynomial 1)))
      (1 (simplify (list '(%signum) e)))
      (2 (simplify (list '($max) e (signs-polynomial 1))))
      (3 (div e (signs-polynomial 1)))
      (4 (power (power e 2) '((rat simp) 1 2)))
      (5 (add (power e '((rat simp) 1 3)) (signs-polynomial 1)))
      (6 ($expand e))
      (7 ($expand (mul e (signs-polynomial 1))))
      (t e))))

(defun signs-of-value (value)
  (cond ((plusp value) '($pos $pz $pn $unknown))
        ((minusp value) '($neg $nz $pn $unknown))
        (t '($zero $pz $nz $unknown))))

(defun signs-unsimplified (depth)
  "abs, sqrt of a square, signum, max of a polynomial, as a form not yet simplified."
  (let ((e (if (zerop (signs-random 2)) (signs-short) (signs-polynomial depth))))
    (case (signs-random 4)
      (0 (list '(mabs) e))
      (1 (list '(mexpt) (list '(mexpt) e 2) '((rat simp) 1 2)))
      (2 (list '(%signum) e))
      (t (list '($max) e (signs-polynomial 1))))))

(defun fuzz-signs-case ()
  "nil, or what is wrong with one random case."
  (let* ((point (signs-point))
         (facts (remove nil (loop repeat (signs-random 6)
                                  collect (catch 'no-value (signs-fact point)))))
         (points (signs-points facts point 12)))
    (core-guarded facts
                  (lambda ()
                    (or (signs-wrong-sign facts points)
                        (signs-wrong-root facts points)
                        (signs-wrong-form '$simplified #'simplify facts points)
                        (signs-wrong-form '$normal #'signs-normal facts points))))))

(defun signs-wrong-sign (facts points)
  (let* ((e (or (car (core-attempt (lambda () (signs-wrapped (1+ (signs-random 3)))))) 1))
         (sign ($algebra_sign e)))
    (loop for point in points
          for value = (catch 'no-value (signs-value e point))
          unless (or (null value) (member sign (signs-of-value value)))
            return (list '(mlist simp) sign e (cons '(mlist simp) facts)
                         (signs-shown point)))))

(defun signs-wrong-root (facts points)
  "The sign of c*sqrt(p) + b against those at the points, where squares are compared."
  (let* ((b (signs-short)) (c (if (zerop (signs-random 3)) (signs-short) (signs-number-m)))
         (p (add (power b 2) (if (zerop (signs-random 2)) (signs-short) (signs-number-m))))
         (sign ($algebra_sign (add (mul c (power p '((rat simp) 1 2))) b))))
    (loop for point in points
          for (vb vc vp) = (loop for e in (list b c p)
                                 collect (catch 'no-value (signs-value e point)))
          unless (or (null vb) (null vc) (null vp) (minusp vp)
                     (member sign (signs-of-value (signs-root-sum vb vc vp))))
            return (list '(mlist simp) sign b c p (cons '(mlist simp) facts)
                         (signs-shown point)))))

(defun signs-root-sum (b c p)
  "Has the sign of b + c*sqrt(p), numbers."
  (let ((root (* (signum c) c c p)) (beside (* (signum b) b b)))
    (+ root beside)))

(defun signs-normal (form) (algebra-normal-form (simplify form)))

(defun signs-wrong-form (what function facts points)
  "A form whose value at a point is no longer the same after FUNCTION."
  (let* ((form (signs-unsimplified (1+ (signs-random 2))))
         (after (funcall function (copy-tree form))))
    (loop for point in points
          for value = (catch 'no-value (signs-value form point))
          for other = (catch 'no-value (signs-value after point))
          unless (or (null value) (null other) (= value other))
            return (list '(mlist simp) what form after (cons '(mlist simp) facts)
                         (signs-shown point)))))

;;; Facts on products, and products that follow from several

(defun signs-factor ()
  (case (signs-random 4)
    (0 (sub (signs-choice *signs-names*) (signs-choice *signs-names*)))
    (1 (sub (signs-choice *signs-names*) (signs-number-m)))
    (t (signs-choice *signs-names*))))

(defun signs-product (factors)
  (muln (cons (signs-choice '(1 -1 2))
              (loop for f in factors
                    when (zerop (signs-random 2))
                      collect (if (zerop (signs-random 5)) (power f 2) f)))
        nil))

(defun signs-related (e point)
  "A relation of E to 0 that holds at POINT."
  (let ((value (signs-value e point)))
    (list (signs-choice (cond ((plusp value) '((mgreaterp) (mgeqp)))
                              ((minusp value) '((mlessp) (mleqp)))
                              (t '((mgeqp) (mleqp)))))
          e 0)))

(defun signs-wrong-product ()
  "A sign that a point refutes, or a contradiction that facts are said to have which hold at one."
  (let* ((point (signs-point)) (factors (loop repeat 4 collect (signs-factor)))
         (facts (loop repeat (1+ (signs-random 4))
                      collect (signs-related (signs-product factors) point)))
         (more (signs-related (signs-product factors) point))
         (e (signs-product factors)) (points (signs-points facts point 30)))
    (core-guarded facts
      (lambda ()
        (let ((sign ($algebra_sign e)))
          (or (and ($algebra_contradictory (list '(mlist) more))
                   (list '(mlist simp) "contradictory" more (cons '(mlist simp) facts)
                         (signs-shown point)))
              (loop for p in points
                    unless (member sign (signs-of-value (signs-value e p)))
                      return (list '(mlist simp) sign e (cons '(mlist simp) facts)
                                   (signs-shown p)))))))))

(defun $fuzz_products (count seed)
  "The failures among COUNT random cases from SEED."
  (signs-failures count seed #'signs-wrong-product))

(defun signs-shown (point)
  (cons '(mlist simp) (loop for (name . value) in point
                            collect (list '(mequal simp) name (algebra-maxima-rational value)))))

(defun signs-failures (count seed function)
  "What FUNCTION finds wrong in COUNT cases from SEED; errors count."
  (setq *signs-state* (+ 1 (* 7919 seed)))
  (cons '(mlist simp)
        (loop repeat count
              for state = *signs-state*
              for wrong = (multiple-value-bind (wrong text) (core-caught function)
                            (if text (list '(mlist simp) text state) wrong))
              when wrong collect wrong)))

(defun $fuzz_signs (count seed)
  "The failures among COUNT random cases from SEED."
  (signs-failures count seed #'fuzz-signs-case))
