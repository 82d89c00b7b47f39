;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions in archives. First what they are at simplified arguments, for text that nobody vouches
;;; for: abs, signum, unit_step, max, min by signs that the form of an expression shows, roots and
;;; exponentials as powers, all others by Maxima, where it finds a value. Then how other programs
;;; and other schools spell them. Look first at archive-function-value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/plain_simplifier" "archive/simplify"))

(defun archive-function-value (operator arguments)
  "The function of Maxima's name OPERATOR at simplified ARGUMENTS."
  (case operator
    (%sqrt (archive-power (car arguments) '((rat simp) 1 2)))
    (%exp (archive-power '$%e (car arguments)))
    (mabs (archive-absolute-value (car arguments)))
    (%signum (archive-signum (car arguments)))
    ($unit_step (archive-unit-step (car arguments)))
    (($max $min) (archive-extremum operator arguments))
    ($atan2 (archive-atan2 arguments))
    (%log (archive-logarithm (car arguments)))
    (t (if (some #'floatp arguments)
           (archive-inert operator arguments)
           (archive-attempted (list* (list operator) arguments))))))

(defun archive-attempted (form)
  "FORM simplified; where Maxima finds no value (cot(0)) an error with its place."
  (let ((value (core-attempt (lambda () (archive-simplified form)))))
    (if value
        (car value)
        (archive-refuse "a function has no value here"))))

(defun archive-absolute-value (e)
  (case (archive-plain-sign e)
    (($pos $pz $zero) e)
    ($neg (archive-negative e))
    (t (archive-inert 'mabs (list (archive-without-sign e))))))

(defun archive-without-sign (e)
  "E or -E, the one that a person would write."
  (if (and (mtimesp e) (mnegp (cadr e))) (archive-negative e) e))

(defun archive-signum (e)
  (case (archive-plain-sign e)
    ($pos 1)
    ($neg -1)
    ($zero e)
    (t (archive-inert '%signum (list e)))))

(defun archive-unit-step (e)
  (case (archive-plain-sign e)
    ($pos 1)
    (($neg $zero) 0)
    (t (archive-inert '$unit_step (list e)))))

(defun archive-extremum (operator arguments)
  (if (every #'mnump arguments)
      (reduce (lambda (a b)
                (if (eq (archive-number-sign (addk a (timesk -1 b)))
                        (if (eq operator '$max) '$neg '$pos)) b a))
              arguments)
      (archive-inert operator arguments)))

(defun archive-atan2 (arguments)
  (when (every #'zerop1 arguments) (archive-refuse "atan2(0, 0) has no value"))
  (if (and (every #'mnump arguments) (every #'archive-modest-p arguments)
           (notany #'floatp arguments))
      (archive-attempted (list* '($atan2) arguments))
      (archive-inert '$atan2 arguments)))

(defun archive-even-p (exponent)
  "Whether x^EXPONENT is the same for x and -x."
  (if (ratnump exponent)
      (evenp (cadr exponent))
      (and (integerp exponent) (evenp exponent))))

(defun archive-logarithm (e)
  "log(E); of x^2 it is 2*log(abs(x)), where Maxima would have 2*log(x)."
  (cond ((zerop1 e) (archive-refuse "log(0) has no value"))
        ((floatp e) (archive-inert '%log (list e)))
        ((and (mexptp e) (archive-even-p (caddr e)))
         (archive-product
          (list (caddr e) (archive-logarithm (archive-absolute-value (cadr e))))))
        (t (archive-attempted (list '(%log) e)))))

;;; Spellings: Cos[th], ctg(x), arcsin(x). Maxima takes Cos[th] for a constant with a subscript and
;;; ctg(x) for a function it knows nothing of; both would be computed with. Here is what is meant.

(defparameter *archive-function-spellings*
  '(("tg" . "tan") ("tang" . "tan") ("ctg" . "cot") ("cotg" . "cot") ("cotan" . "cot")
    ("ctan" . "cot") ("cosec" . "csc") ("arcsin" . "asin") ("arccos" . "acos")
    ("arctan" . "atan") ("arctg" . "atan") ("arctan2" . "atan2") ("arccot" . "acot")
    ("arcctg" . "acot") ("arcsinh" . "asinh") ("arccosh" . "acosh") ("arctanh" . "atanh")
    ("arsinh" . "asinh") ("arcosh" . "acosh") ("artanh" . "atanh") ("sh" . "sinh")
    ("ch" . "cosh") ("th" . "tanh") ("cth" . "coth") ("tgh" . "tanh") ("ln" . "log")
    ("sgn" . "signum") ("sign" . "signum") ("heaviside" . "unit_step")
    ("heavisidetheta" . "unit_step"))
  "Names in small letters, and Maxima's.")

(defparameter *archive-capital-functions*
  '("sin" "cos" "tan" "cot" "sec" "csc" "asin" "acos" "atan" "atan2" "sinh" "cosh" "tanh" "coth"
    "exp" "log" "sqrt" "abs" "signum" "max" "min" "integrate" "diff" "matrix")
  "Functions of Maxima that others write with a capital letter.")

(defun archive-meant-name (name)
  "The name of the function of Maxima that NAME is meant for, or nil."
  (let* ((small (string-downcase name))
         (other (cdr (assoc small *archive-function-spellings* :test #'string=))))
    (cond (other)
          ((and (string/= small name) (member small *archive-capital-functions* :test #'string=))
           small))))

(defun archive-meant-advice (name)
  "\"; did you mean cos?\", or nothing."
  (format nil "~@[; did you mean ~a?~]" (archive-meant-name name)))

(defun archive-head-name (e)
  "How a person spells the operator of E, or nil where it is none of a person's."
  (and (consp e) (consp (car e)) (symbolp (caar e))
       (char= (char (symbol-name (caar e)) 0) #\$)
       (core-spelling (caar e))))

(defun archive-meant-function (e)
  "The name of the function that the call or subscripted name E is meant for, or nil."
  (let ((name (archive-head-name e)))
    (and name (cdr e) (not (fboundp (caar e))) (archive-meant-name name))))

(defun archive-meant-text (e)
  "E with the function that is meant."
  (format nil "~a(~{~a~^, ~})" (archive-meant-function e)
          (mapcar (lambda (part) (core-words (list part))) (cdr e))))
