;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Expressions as SPICE writes them, for WriteNetlist: numbers as decimals of doubles, the variable
;;; of a law as a voltage or current, t as time, whole powers as products (programs differ on x^3 of
;;; a negative x), piecewise as condition ? value : value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_languages"))

(defparameter *circuits-spice-functions*
  '((%sin . "sin") (%cos . "cos") (%tan . "tan") (%asin . "asin") (%acos . "acos") (%atan . "atan")
    (%sinh . "sinh") (%cosh . "cosh") (%tanh . "tanh") (%log . "ln") (%exp . "exp") (%sqrt . "sqrt")
    (mabs . "abs") (%signum . "sgn") ($max . "max") ($min . "min")
    ($unit_step . "u")))

(defparameter *circuits-spice-relations*
  '((mlessp . "<") (mleqp . "<=") (mgreaterp . ">") (mgeqp . ">=")))

(defun circuits-number-of (e what)
  "The rational number that E is nearly; WHAT says of what, where it is none."
  (cond ((integerp e) e)
        ((ratnump e) (/ (cadr e) (caddr e)))
        (t (let ((x (let (($numer t) ($%enumer t)) ($float e))))
             (unless (and (floatp x) (<= (abs x) most-positive-double-float))
               (core-error "~a is ~a, no number; give `values' to its parameters" what
                           (core-words (list e))))
             (rational x)))))

(defun circuits-spice-number (x)
  "The double next to X, 4700 and 2e-6 rather than 4700.0e0 and 2.0e-6."
  (let* ((text (algebra-double-text (abs x) "e")) (mark (position #\e text))
         (mantissa (subseq text 0 mark)) (exponent (subseq text mark))
         (n (length mantissa)))
    (format nil "~:[~;-~]~a~:[~a~;~]" (minusp x)
            (if (string= ".0" mantissa :start2 (- n 2)) (subseq mantissa 0 (- n 2)) mantissa)
            (string= exponent "e0") exponent)))

(defun circuits-spice-formula (e names)
  "E as a text in parentheses where it needs them; NAMES: ((symbol . text) ..)."
  (cond ((assoc e names) (cdr (assoc e names)))
        ((or (atom e) (ratnump e) (not (circuits-any-of-p e names)))
         (format nil "(~a)" (circuits-spice-number (circuits-number-of e "a part of a formula"))))
        (t (circuits-spice-operation (caar e) (cdr e) names))))

(defun circuits-any-of-p (e names)
  (cond ((atom e) (assoc e names))
        (t (some (lambda (part) (circuits-any-of-p part names)) (cdr e)))))

(defun circuits-spice-operation (operator parts names)
  (flet ((each () (mapcar (lambda (part) (circuits-spice-formula part names)) parts)))
    (case operator
      (mplus (format nil "(~{~a~^+~})" (each)))
      (mtimes (format nil "(~{~a~^*~})" (each)))
      (mexpt (circuits-spice-power (first parts) (second parts) names))
      ($piecewise (circuits-spice-cases parts names))
      (t (let ((name (cdr (assoc operator *circuits-spice-functions*))))
           (unless name
             (core-error "SPICE has no function ~a" (core-spelling operator)))
           (format nil "~a(~{~a~^,~})" name (each)))))))

(defun circuits-spice-power (base exponent names)
  (flet ((formula (e) (circuits-spice-formula e names)))
    (cond ((eq base '$%e) (format nil "exp(~a)" (formula exponent)))
          ((and (integerp exponent) (<= 1 exponent 20))
           (format nil "(~{~a~^*~})" (loop with text = (formula base)
                                           repeat exponent collect text)))
          ((and (integerp exponent) (<= -20 exponent -1))
           (format nil "(1/~a)" (circuits-spice-power base (- exponent) names)))
          ((alike1 exponent '((rat simp) 1 2)) (format nil "sqrt(~a)" (formula base)))
          ((alike1 exponent '((rat simp) -1 2)) (format nil "(1/sqrt(~a))" (formula base)))
          (t (core-error "the power ~a^~a is not written: programs differ on it"
                         (core-words (list base)) (core-words (list exponent)))))))

(defun circuits-spice-cases (pieces names)
  "condition ? value : value .., the last value without condition."
  (let ((condition (second (first pieces))) (value (third (first pieces))))
    (if (or (eq condition t) (null (rest pieces)))
        (circuits-spice-formula value names)
        (format nil "(~a ? ~a : ~a)" (circuits-spice-condition condition names)
                (circuits-spice-formula value names)
                (circuits-spice-cases (rest pieces) names)))))

(defun circuits-spice-condition (condition names)
  (let ((relation (and (consp condition)
                       (cdr (assoc (caar condition) *circuits-spice-relations*)))))
    (unless relation
      (core-error "the condition ~a is not written; < <= > >= are" (core-words (list condition))))
    (format nil "(~a ~a ~a)" (circuits-spice-formula (second condition) names) relation
            (circuits-spice-formula (third condition) names))))
