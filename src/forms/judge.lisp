;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The judge of Lagrange's equations e_i = d/dt dL/dq_i' - dL/dq_i + dR/dq_i' - Q_i. For random
;;; numbers c_i the sum of c_i e_i is compared with quotients of differences of L along a random
;;; motion q + v*s + a*s^2/2: with D the derivative in the direction c,
;;;     sum c_i e_i = d/ds D_v L - D_q L + D_v R - c.Q,
;;; six values of L whatever the number of equations, and no symbolic derivative. With steps of
;;; 2^-100 the error is about 2^-200. See forms-judged-sum first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/noun_value"))

(defconstant forms-step-digits 100)

(defun forms-step () (ash 1 (- forms-digits forms-step-digits)))

(defun forms-quotient-of-differences (after before)
  (ash (- after before) (1- forms-step-digits)))

;;; A motion: the names of the coordinates and velocities, the numbers c_i.

(defstruct forms-trial q v a weights)

(defun forms-shifted (trial point names step)
  "POINT with STEP times the weights added to NAMES."
  (let ((shifted (forms-moved-point point)))
    (loop for x in names
          for weight in (forms-trial-weights trial)
          do (forms-set-place x (+ (forms-variable-value x point) (forms-fixed-times step weight))
                              shifted))
    shifted))

(defun forms-moved (trial point step)
  "POINT after the time STEP."
  (let ((moved (forms-moved-point point))
        (half-square (floor (forms-fixed-times step step) 2)))
    (flet ((value (e) (forms-variable-value e point)))
      (forms-set-place '$t (+ (value '$t) step) moved)
      (loop for x in (forms-trial-q trial)
            for v in (forms-trial-v trial)
            for a in (forms-trial-a trial)
            do (forms-set-place x (+ (value x) (forms-fixed-times (value v) step)
                                     (forms-fixed-times (value a) half-square))
                                moved)
               (forms-set-place v (+ (value v) (forms-fixed-times (value a) step)) moved)))
    moved))

(defun forms-slope (trial function point names)
  "The derivative of FUNCTION, of points, in the direction of the weights of NAMES."
  (forms-quotient-of-differences
   (funcall function (forms-shifted trial point names (forms-step)))
   (funcall function (forms-shifted trial point names (- (forms-step))))))

(defun forms-judged-sum (trial function dissipation forces point)
  "sum c_i e_i from the FUNCTION of points, L, from the expressions R and [Q_1, ..]."
  (let ((v (forms-trial-v trial)))
    (flet ((momentum (step) (forms-slope trial function (forms-moved trial point step) v))
           (dissipation (point) (forms-fixed-value dissipation point)))
      (- (+ (forms-quotient-of-differences (momentum (forms-step)) (momentum (- (forms-step))))
            (if (eql dissipation 0) 0 (forms-slope trial #'dissipation point v)))
         (forms-slope trial function point (forms-trial-q trial))
         (forms-weighted-sum trial forces point)))))

(defun forms-weighted-sum (trial expressions point)
  (loop for e in expressions
        for weight in (forms-trial-weights trial)
        sum (forms-fixed-times weight (forms-fixed-value e point))))

(defun forms-new-trial (q v a)
  (make-forms-trial :q q :v v :a a
                    :weights (loop for x in q for k from 1
                                   collect (forms-random-value (list '(mtimes) k x)))))

(defun forms-trial-point (trial)
  "A random point; velocities and accelerations have their values under both of their names."
  (let ((point (forms-new-point t)))
    (loop for x in (forms-trial-q trial)
          for v in (forms-trial-v trial)
          for a in (forms-trial-a trial)
          do (loop for plain in (list v a)
                   for order from 1
                   do (forms-set-place (list '(%derivative simp) x '$t order)
                                       (forms-variable-value plain point) point)))
    point))

;;; The verdict.

(defun forms-differ-p (x y)
  (> (abs (- x y))
     (forms-fixed-times (forms-fixed (expt 10 -30)) (+ (ash 1 forms-digits) (abs x) (abs y)))))

(defun forms-point-text (point)
  "The values of POINT, for a report."
  (let ((equations '()))
    (maphash (lambda (name value)
               (push (list '(mequal simp) name (div value (ash 1 forms-digits))) equations))
             (forms-point-names point))
    (coerce (mstring (cons '(mlist simp) equations)) 'string)))

(defun forms-verdict (how found expected point)
  "Notes how it was checked, or stops; FOUND or EXPECTED is nil where there is no number."
  (cond ((not (and found expected))
         ($core_checked "not checked (" how "): no number at a random point"))
        ((forms-differ-p found expected)
         (core-error "the result fails its check (~a) at ~a; please report this with the input"
                     how (forms-point-text point)))
        (t ($core_checked how))))

(defun forms-both-sides (trial expressions function dissipation forces point)
  "The sum of c_i e_i found in EXPRESSIONS and the one expected; nil where there is no number."
  (values (catch 'forms-no-value (forms-weighted-sum trial expressions point))
          (catch 'forms-no-value (forms-judged-sum trial function dissipation forces point))))

;;; For Maxima.

(defparameter *forms-judged-how*
  "d/dt dL/dq' - dL/dq as quotients of differences along a random motion")

(defun $forms_check_lagrange (expressions plain q v a)
  "The EXPRESSIONS against [L, R, [Q_1, ..]] in PLAIN symbols."
  (destructuring-bind (function dissipation forces) (cdr plain)
    (let* ((trial (forms-new-trial (cdr q) (cdr v) (cdr a)))
           (point (forms-trial-point trial)))
      (multiple-value-bind (found expected)
          (forms-both-sides trial (cdr expressions)
                            (lambda (point) (forms-fixed-value function point))
                            dissipation (cdr forces) point)
        (forms-verdict *forms-judged-how* found expected point)))))

(defun $forms_judged_slope (e x point)
  "The derivative of E by X at POINT, equations, as a quotient of differences."
  (let ((point (forms-given-point point))
        (trial (make-forms-trial :weights (list (ash 1 forms-digits)))))
    (let ((slope (catch 'forms-no-value
                   (forms-slope trial (lambda (point) (forms-fixed-value e point)) point
                                (list x)))))
      (and slope (div slope (ash 1 forms-digits))))))
