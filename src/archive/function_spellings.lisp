;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions as other programs and other schools spell them: Cos[th], ctg(x), arcsin(x). Maxima
;;; takes Cos[th] for a constant with a subscript and ctg(x) for a function it knows nothing of;
;;; both would be computed with. Here is what is meant.

(in-package :maxima)

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
