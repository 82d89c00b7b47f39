;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Finding the time derivatives 'diff(q,t,n) in an expression, and exchanging names and these for
;;; other expressions, all at once. subst() goes through the expression once for each of them,
;;; breaks 'diff(q,t) when it puts in a value for q, and takes the variable of an integral for
;;; something of its own. How nouns with variables of their own are served: bound.lisp; piecewise
;;; is the piece whose condition is seen to hold: pieces.lisp. Powers of numbers are predicted.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "forms/pieces"))

(defun forms-derivative-p (e)
  "True for 'diff(q,t,n) where q is a name, possibly with a subscript."
  (and (consp e) (eq (caar e) '%derivative)
       (= (length e) 4) (eq (third e) '$t) (integerp (fourth e))
       (or (symbolp (second e)) (member 'array (car (second e))))))

(defun forms-collect-derivatives (e found)
  (cond ((atom e) found)
        ((forms-derivative-p e) (if (member e found :test #'alike1) found (cons e found)))
        (t (dolist (part (cdr e) found)
             (setq found (forms-collect-derivatives part found))))))

(defun $forms_derivatives (e)
  "The list of all 'diff(q,t,n) in E, in the order in which they occur."
  (cons '(mlist simp) (nreverse (forms-collect-derivatives e '()))))

(defstruct forms-pairs
  names      ; name -> its value
  others     ; (expression . value), ..
  operators  ; of the others
  hidden)    ; what stays: the variables of the nouns around

(defun forms-read-pairs (pairs)
  (let ((read (make-forms-pairs :names (make-hash-table :test #'eq))))
    (dolist (pair pairs read)
      (destructuring-bind (old new) (cdr pair)
        (cond ((symbolp old) (setf (gethash old (forms-pairs-names read)) new))
              (t (push (cons old new) (forms-pairs-others read))
                 (pushnew (caar old) (forms-pairs-operators read))))))))

(defun forms-value-in (pairs part)
  "What PART is to be exchanged for; PART itself where it is not."
  (cond ((and (forms-pairs-hidden pairs) (member part (forms-pairs-hidden pairs) :test #'alike1))
         part)
        ((symbolp part) (values (gethash part (forms-pairs-names pairs) part)))
        ((and (consp part) (member (caar part) (forms-pairs-operators pairs) :test #'eq))
         (let ((pair (assoc part (forms-pairs-others pairs) :test #'alike1)))
           (if pair (cdr pair) part)))
        (t part)))

(defvar *forms-bound-exchange* nil "Serves the nouns with variables of their own, see bound.lisp.")

(defun forms-exchange (e pairs)
  (let ((other (forms-value-in pairs e)))
    (cond ((not (eq other e)) other)
          ((or (atom e) (forms-derivative-p e)) e)
          ((member (caar e) '(%derivative %integrate %sum %product %limit %laplace %at) :test #'eq)
           (funcall *forms-bound-exchange* e pairs))
          (t (forms-exchange-parts e pairs)))))

(defun forms-exchange-parts (e pairs)
  (forms-with-parts e (mapcar (lambda (part) (forms-exchange part pairs)) (cdr e))))

(defun forms-with-parts (e parts)
  (cond ((every #'eq parts (cdr e)) e)
        ((eq (caar e) '$piecewise) (forms-piecewise parts))
        (t (when (eq (caar e) 'mexpt) (algebra-guard-power-of-number (first parts) (second parts)))
           (simplifya (cons (remove 'simp (car e)) parts) nil))))

(defun $forms_exchange (e pairs)
  "E with the right sides of PAIRS in place of their left sides (names and 'diff(q,t,n))."
  (forms-exchange e (forms-read-pairs (cdr pairs))))
