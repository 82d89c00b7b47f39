;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; What nouns are, where that is exact and cheap: integrals of polynomials, of sin, cos, exp of
;;; linear arguments; sums and products of few terms; derivatives of formulas; values at a point.
;;; For a zero test they are taken apart besides, so that what is left is independent:
;;;     'integrate(a*f(s) + s, s, 0, u) = a*(F(u) - F(0)) + u^2/2,
;;;     'diff(V(x - y), x) = V'(x - y), written as 'at('diff(V(s1), s1), s1 = x - y).
;;; Nothing asks Maxima's integrator.  Look at algebra-noun-value first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/nouns" "algebra/factoring"))

(defvar *algebra-nouns-apart* nil "true: integrals and derivatives of open functions come apart")

(defun algebra-noun-value (e)
  "What E is, in other kernels than E; nil where that is not known."
  (case (caar e)
    (%integrate (and (= (length e) 5) (symbolp (caddr e)) (algebra-integral-value e)))
    ((%sum %product) (algebra-series-value e))
    (%derivative (algebra-slope-value e))
    (%at (algebra-value-at e))))

(defun algebra-carried-out (e)
  "E with the values of its nouns."
  (if (not (algebra-call-p e))
      e
      (let* ((value (algebra-noun-value e)))
        (cond (value (algebra-carried-out value))
              ((or (algebra-bound-name e) (member (caar e) '(%derivative %at %integrate))
                   (member 'array (car e)))
               e)
              (t (algebra-with-parts e (mapcar #'algebra-carried-out (cdr e))))))))

;;; ---- sums and products of few terms

(defparameter *algebra-most-summands* 100)

(defun algebra-series-value (e)
  (destructuring-bind (body k low high) (cdr e)
    (when (and (symbolp k) (integerp low) (integerp high)
               (<= -1 (- high low) *algebra-most-summands*))
      (let ((terms (loop for value from low to high
                         collect (algebra-put body (list k) (list value)))))
        (and (notany #'null terms)
             (if (eq (caar e) '%sum) (addn terms nil) (muln terms nil)))))))

;;; ---- derivatives

(defparameter *algebra-carried-order* 6 "The order up to which a derivative is carried out.")

(defun algebra-slope-value (e)
  "Of a formula: by the rules; of open functions of more than names: by the chain rule."
  (destructuring-bind (body . variables) (cdr e)
    (let ((orders (loop for (nil order) on variables by #'cddr collect order)))
      (cond ((or (symbolp body) (algebra-plain-jet-p e)
                 (notevery #'integerp orders)
                 (> (reduce #'+ orders) *algebra-carried-order*)
                 (> (algebra-size body) 200))
             nil)
            ((not (algebra-named-derivative-p body variables)) nil)
            ((or *algebra-nouns-apart* (not (algebra-has-open-p body)))
             (catch 'algebra-no-value
               (loop for (x order) on variables by #'cddr
                     do (loop repeat order do (setq body (algebra-rate-of body x))))
               body))))))

(defun algebra-named-derivative-p (body variables)
  "Whether the names in BODY do not move with the VARIABLES: d/dt of x is no 0."
  (loop for (x) on variables by #'cddr
        always (and (symbolp x)
                    (among x body)
                    (or (not (eq x '$t))
                        (equal (cdr ($listofvars body)) '($t))))))

(defun algebra-rate-of (e x)
  "The derivative of E by the name X; open functions by the chain rule."
  (if (not (among x e))
      0
      (let ((values '()))
        (labels ((named (e)
                   (cond ((not (algebra-call-p e)) e)
                         ((or (algebra-open-call-p e) (algebra-value-of-jet-p e)
                              (algebra-plain-jet-p e))
                          (or (car (rassoc e values :test #'alike1))
                              (let ((name (gensym "$Z")))
                                (push (cons name e) values)
                                name)))
                         ((or (algebra-bound-name e) (member (caar e) '(%derivative %at %integrate))
                              (algebra-kinked-p e))
                          (throw 'algebra-no-value nil))
                         (t (algebra-with-parts e (mapcar #'named (cdr e)))))))
          (let ((outer (named e)))
            (add (algebra-named-again (algebra-plain-slope outer x) values)
                 (addn (loop for (name . call) in values
                             collect (mul (algebra-named-again (algebra-plain-slope outer name)
                                                               values)
                                          (algebra-slope-of-call call x)))
                       nil)))))))

(defun algebra-kinked-p (e)
  (member (caar e) '(mabs %signum $max $min %floor $floor $piecewise $unit_step %mod $mod mcond
                     %ceiling $ceiling)))

(defun algebra-plain-slope (e x)
  (let ((slope (algebra-quietly (lambda () ($diff e x)))))
    (if (or (null slope) (among '%derivative slope) (> (algebra-size slope) 2000))
        (throw 'algebra-no-value nil)
        slope)))

(defun algebra-named-again (e values)
  (dolist (pair values e)
    (setq e (maxima-substitute (cdr pair) (car pair) e))))

(defun algebra-slope-of-call (call x)
  (if (not (among x call))
      0
      (multiple-value-bind (operator orders places) (algebra-parts-of-jet call)
        (addn (loop for place in places
                    for k from 0
                    for rate = (algebra-rate-of place x)
                    unless (eql rate 0)
                      collect (mul rate (algebra-jet operator
                                                     (loop for order in orders
                                                           for i from 0
                                                           collect (if (= i k) (1+ order) order))
                                                     places)))
              nil))))

(defun algebra-parts-of-jet (e)
  "Three values: the function, its orders, its arguments."
  (cond ((member (caar e) '(mqapply)) (throw 'algebra-no-value nil))
        ((eq (caar e) '%at)
         (if (symbolp (cadr (cadr e))) (throw 'algebra-no-value nil))
         (values (caar (cadr (cadr e))) (cdddr (algebra-jet-family (cadr e)))
                 (mapcar #'caddr (algebra-equations-at e))))
        ((eq (caar e) '%derivative)
         (if (symbolp (cadr e)) (throw 'algebra-no-value nil))
         (values (caar (cadr e)) (cdddr (algebra-jet-family e)) (cdr (cadr e))))
        ((member 'array (car e)) (throw 'algebra-no-value nil))
        (t (values (caar e) (mapcar (constantly 0) (cdr e)) (cdr e)))))

(defun algebra-jet (operator orders places)
  "The derivative of OPERATOR of these ORDERS at PLACES."
  (let* ((places (mapcar #'algebra-normal-argument places))
         (names (if (algebra-distinct-symbols-p places)
                    places
                    (loop for nil in places
                          for k from 1 collect ($concat '$s k))))
         (call (cons (list operator 'simp) names))
         (slope (list* '(%derivative) call
                       (loop for name in names
                             for order in orders
                             unless (eql order 0) collect name and collect order)))
         (jet (if (every #'zerop orders) call (simplifya slope nil))))
    (cond ((eq names places) jet)
          ((eq jet call) (cons (list operator 'simp) places))
          (t (list '(%at simp) jet
                   (cons '(mlist simp)
                         (mapcar (lambda (name place) (list '(mequal simp) name place))
                                 names places)))))))

;;; ---- values at a point

(defun algebra-value-at (e)
  (let* ((equations (algebra-equations-at e))
         (names (mapcar #'cadr equations)))
    (when (and equations (every #'mequalp equations) (algebra-distinct-symbols-p names)
               (or *algebra-nouns-apart* (not (algebra-value-of-jet-p e))))
      (let ((value (algebra-put (algebra-carried-out (cadr e)) names (mapcar #'caddr equations))))
        (if (or (null value) (alike1 value e)) nil value)))))

(defun algebra-put (e names values)
  "E with VALUES for NAMES, all at once; nil where a noun in E does not let them in."
  (catch 'algebra-no-value (algebra-quietly (lambda () (algebra-put-in e names values)))))

(defun algebra-put-in (e names values)
  (flet ((put (part) (algebra-put-in part names values)))
    (cond ((symbolp e) (let ((place (position e names))) (if place (nth place values) e)))
          ((not (algebra-call-p e)) e)
          ((notany (lambda (name) (among name e)) names) e)
          ((algebra-value-of-jet-p e)
           (list (car e) (cadr e)
                 (cons '(mlist simp)
                       (loop for (nil name value) in (algebra-equations-at e)
                             collect (list '(mequal simp) name
                                           (algebra-normal-argument (put value)))))))
          ((algebra-plain-jet-p e) (algebra-put-in-jet e names values))
          ((member 'array (car e)) (throw 'algebra-no-value nil))
          ((eq (algebra-bound-name e) nil)
           (if (member (caar e) '(%derivative %at %integrate))
               (throw 'algebra-no-value nil)
               (algebra-with-parts e (mapcar #'put (cdr e)))))
          (t (algebra-put-in-bound e names values)))))

(defun algebra-put-in-jet (e names values)
  (let ((body (cadr e)))
    (if (symbolp body)
        (if (or (member body names) (/= (length e) 4) (not (equal names (list (caddr e)))))
            (throw 'algebra-no-value nil)
            (list '(%at simp) e (list '(mequal simp) (car names) (car values))))
        (algebra-jet (caar body) (cdddr (algebra-jet-family e))
                     (loop for x in (cdr body)
                           collect (algebra-put-in x names values))))))

(defun algebra-put-in-bound (e names values)
  (destructuring-bind (body s . rest) (cdr e)
    (when (or (member s names) (some (lambda (value) (among s value)) values))
      (throw 'algebra-no-value nil))
    (flet ((put (part) (algebra-put-in part names values)))
      (algebra-with-parts e (list* (put body) s (mapcar #'put rest))))))

;;; ---- integrals

(defparameter *algebra-expanded-integrand* 24 "The degree up to which an integrand is expanded.")

(defun algebra-integral-value (e)
  (destructuring-bind (body s low high) (cdr e)
    (unless (or (eq low '$algebra_base) (intersection '($inf $minf) (list low high)))
      (let* ((terms (algebra-integrand-terms (algebra-carried-out body) s))
             (parts (loop for term in terms collect (algebra-term-integral term s low high))))
        (and terms
             (notany #'null parts)
             (not (and (null (cdr parts)) (alike1 (car parts) e)))
             (addn parts nil))))))

(defun algebra-integrand-terms (body s)
  "The terms of an integrand, expanded where that is short."
  (let ((expanded (if (and (> (algebra-degree-at-most body) *algebra-expanded-integrand*)
                           (among 'mplus body))
                      body
                      (or (algebra-quietly (lambda () ($expand body))) body))))
    (and (< (algebra-size body) 400)
         (not (algebra-kernel-of-name-p expanded s))
         (if (mplusp expanded) (cdr expanded) (list expanded)))))

(defun algebra-kernel-of-name-p (e s)
  "Whether S is differentiated by, or bound again, in E."
  (and (algebra-call-p e)
       (or (and (member (caar e) '(%derivative %at %integrate %sum %product %limit)) (among s e))
           (some (lambda (part) (algebra-kernel-of-name-p part s)) (cdr e)))))

(defun algebra-term-integral (term s low high)
  "The integral of one TERM; nil where it does not come apart."
  (let ((outside 1) (inside 1))
    (dolist (factor (if (mtimesp term) (cdr term) (list term)))
      (if (among s factor) (setq inside (mul inside factor)) (setq outside (mul outside factor))))
    (let ((antiderivative (algebra-antiderivative inside s)))
      (cond (antiderivative
             (mul outside (sub (algebra-put antiderivative (list s) (list high))
                               (algebra-put antiderivative (list s) (list low)))))
            ((and *algebra-nouns-apart* (algebra-open-depends-p inside s))
             (mul outside (sub (algebra-integral-from-base inside s high)
                               (algebra-integral-from-base inside s low))))))))

(defun algebra-integral-from-base (body s high)
  (list '(%integrate simp) body s '$algebra_base high))

(defun algebra-antiderivative (e s)
  "Of a power of S, of sin, cos or exp of an argument linear in S; else nil."
  (cond ((eql e 1) s)
        ((eq e s) (div (power s 2) 2))
        ((and (mexptp e) (eq (cadr e) s) (typep (caddr e) '(integer 0)))
         (div (power s (1+ (caddr e))) (1+ (caddr e))))
        ((and (mexptp e) (eq (cadr e) '$%e) (algebra-slope-of-line (caddr e) s))
         (div e (algebra-slope-of-line (caddr e) s)))
        ((and (algebra-call-p e) (member (caar e) '(%sin %cos))
              (algebra-slope-of-line (cadr e) s))
         (div (if (eq (caar e) '%cos)
                  (simplify (list '(%sin) (cadr e)))
                  (mul -1 (simplify (list '(%cos) (cadr e)))))
              (algebra-slope-of-line (cadr e) s)))))

(defun algebra-slope-of-line (e s)
  "The rational number k of k*S + c, not 0; else nil."
  (let ((slope (algebra-quietly (lambda () ($diff e s)))))
    (and (algebra-rational-number slope) (not (eql slope 0)) slope)))
