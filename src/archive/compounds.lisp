;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Expressions put together from their parts: what kind of thing each is, and the error where
;;; another kind was expected; arithmetic with lists and matrices, element by element; functions
;;; whose arguments have a form of their own: diff, integrate, at, RealRoot, matrix, diag,
;;; notequal, piecewise.
;;; Look first at archive-form-kind.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/plain_simplifier" "archive/simplify" "archive/tokens"))

(defvar *archive-nesting* #-gcl 200 #+gcl 100
  "The most levels of nesting. GCL has room for two thousand calls in each other, of Maxima's
simplifier too.")

;;; What an expression is

(defun archive-form-kind (e)
  "What E is: :number-like, :relation, :list, :matrix, :string or :truth-value."
  (cond ((stringp e) :string)
        ((member e '(t nil)) :truth-value)
        ((atom e) :scalar)
        (t (case (caar e)
             ((mequal mlessp mleqp mgreaterp mgeqp mand mor mnot $notequal mnotequal) :relation)
             (mlist :list)
             ($matrix :matrix)
             (t :scalar)))))

(defun archive-kind-shown (kind)
  (ecase kind
    (:scalar "an expression") (:relation "an equation or comparison") (:list "a list")
    (:matrix "a matrix")
    (:string "a string") (:truth-value "true or false")))

(defun archive-expect-kind (reader position e expected &rest kinds)
  "E if it is of one of KINDS, else an error at POSITION that names what was EXPECTED."
  (let ((kind (archive-form-kind e)))
    (unless (member kind kinds)
      (archive-fault reader position "found ~a, expected ~a~a" (archive-kind-shown kind) expected
                     (if (eq kind :relation) "; = and comparisons stand in lists" "")))
    e))

;; `every' and its like take time in squares in GCL: long lists go through `loop'.

(defun archive-all-scalar-p (list)
  (loop for e in list always (eq (archive-form-kind e) :scalar)))

(defun archive-expect-scalar (reader position e)
  (archive-expect-kind reader position e "an expression" :scalar))

(defmacro archive-computed ((reader position) &body body)
  "BODY, with POSITION as the place of an error in a simplification."
  `(let ((*archive-position* ,position) (*archive-reader* ,reader)) ,@body))

;;; Sums, products and quotients that are not plain arithmetic

(defun archive-minus (reader position e)
  (archive-expect-kind reader position e "an expression" :scalar :list :matrix)
  (archive-computed (reader position) (archive-over-elements #'archive-negative e)))

(defun archive-over-elements (function e)
  "FUNCTION of E, or of each element of a list or matrix E."
  (if (member (archive-form-kind e) '(:list :matrix))
      (cons (car e) (mapcar (lambda (part)
                              (unless (member (archive-form-kind part) '(:scalar :list :matrix))
                                (archive-refuse "arithmetic with a list that holds more than ~
                                                 expressions"))
                              (archive-over-elements function part))
                            (cdr e)))
      (funcall function e)))

(defun archive-over (reader position e)
  (archive-expect-scalar reader position e)
  (archive-computed (reader position)
    (if (reader-doubles reader) (list '(archive-over) e) (archive-inverse e))))

(defun archive-multiply (reader places factors)
  "The product of FACTORS, of which one may be a list or a matrix."
  (loop for place in places for factor in factors
        unless (archive-divisor-p factor)
          do (archive-expect-kind reader place factor "an expression" :scalar :list :matrix))
  (let ((composite (remove-if-not (lambda (f) (member (archive-form-kind f) '(:list :matrix)))
                                  factors)))
    (when (cdr composite)
      (archive-fault reader (car places) "a product of lists or matrices; write it out"))
    (archive-computed (reader (car places))
      (if composite
          (archive-over-elements (lambda (e)
                                   (archive-multiply-scalars (substitute e (car composite)
                                                                         factors)))
                                 (car composite))
          (archive-multiply-scalars factors)))))

(defun archive-divisor-p (factor) (and (consp factor) (eq (caar factor) 'archive-over)))

(defun archive-multiply-scalars (factors)
  "The product of FACTORS; a divisor is still a divisor where results are doubles, so that 1.0/3
is rounded once."
  (if (loop for factor in factors never (archive-divisor-p factor))
      (archive-product factors)
      (let ((product (car factors)))
        (dolist (factor (cdr factors) product)
          (setq product
                (cond ((not (archive-divisor-p factor)) (archive-product (list product factor)))
                      ((and (mnump product) (mnump (cadr factor))
                            (or (floatp product) (floatp (cadr factor))))
                       (archive-quotient-of-numbers product (cadr factor)))
                      (t (archive-product (list product (archive-inverse (cadr factor)))))))))))

(defun archive-add (reader places terms)
  "The sum of TERMS: of expressions, or of lists or matrices of one shape."
  (loop for place in places for term in terms
        do (archive-expect-kind reader place term "an expression" :scalar :list :matrix))
  (archive-computed (reader (car places))
    (if (archive-all-scalar-p terms)
        (archive-sum terms)
        (archive-add-elements terms))))

(defun archive-add-elements (terms)
  (if (archive-all-scalar-p terms)
      (archive-sum terms)
      (let ((first (car terms)))
        (unless (and (member (archive-form-kind first) '(:list :matrix))
                     (loop for term in terms
                           always (and (eq (archive-form-kind term) (archive-form-kind first))
                                       (= (length term) (length first)))))
          (archive-refuse "a sum of lists or matrices that differ in shape"))
        (cons (car first)
              (apply #'mapcar (lambda (&rest parts) (archive-add-elements parts))
                     (mapcar #'cdr terms))))))

;;; Functions: each takes the arguments and their places and makes a noun or a matrix, or says what
;;; it expects.

(defun archive-expect-count (reader name from arguments &rest counts)
  (unless (member (length arguments) counts)
    (archive-fault reader from "~a has ~d argument~:p, expected ~{~d~^ or ~}" name
                   (length arguments) counts)))

(defun archive-expect-name (reader position e what)
  (unless (and (symbolp e) (not (member e '(t nil $%pi $%e $%i $inf))))
    (archive-fault reader position "expected a name: ~a" what))
  e)

(defun archive-make-derivative (reader name from arguments places)
  "diff(e, name) or diff(e, name, n)"
  (archive-expect-count reader name from arguments 2 3)
  (destructuring-bind (e variable &optional (order 1)) arguments
    (archive-expect-scalar reader (car places) e)
    (archive-expect-name reader (cadr places) variable "the variable of a derivative")
    (unless (and (integerp order) (<= 1 order *archive-nesting*))
      (archive-fault reader (caddr places)
                     "expected the order of a derivative, an integer from 1 to ~d"
                     *archive-nesting*))
    (when (mnump e)
      (archive-fault reader (car places) "the derivative of a number"))
    (archive-derivative e variable order)))

(defun archive-derivative (e variable order)
  "The noun of a derivative; derivatives of derivatives are one, as in Maxima."
  (cond ((and (consp e) (eq (caar e) '%derivative))
         (archive-simplified (list '(%derivative) e variable order)))
        ((eq e variable) (archive-refuse "the derivative of a name by itself"))
        (t (list '(%derivative simp) e variable order))))

(defun archive-make-integral (reader name from arguments places)
  "integrate(e, name) or integrate(e, name, a, b)"
  (archive-expect-count reader name from arguments 2 4)
  (archive-expect-name reader (cadr places) (cadr arguments) "the variable of an integral")
  (loop for e in arguments for place in places do (archive-expect-scalar reader place e))
  (archive-inert '%integrate arguments))

(defun archive-make-at (reader name from arguments places)
  "at(e, name = v) or at(e, [name = v, ..])"
  (archive-expect-count reader name from arguments 2)
  (destructuring-bind (e where) arguments
    (archive-expect-scalar reader (car places) e)
    (unless (or (archive-substitution-p where)
                (and (eq (archive-form-kind where) :list) (cdr where)
                     (every #'archive-substitution-p (cdr where))))
      (archive-fault reader (cadr places)
                     "expected name = value, or a list of these, as second argument of at"))
    (archive-inert '%at
                   (list e (if (and (eq (archive-form-kind where) :list) (null (cddr where)))
                               (cadr where) where)))))

(defun archive-substitution-p (e)
  "True for name = value, where the name may be a derivative."
  (and (consp e) (eq (caar e) 'mequal) (eq (archive-form-kind (caddr e)) :scalar)
       (or (symbolp (cadr e)) (and (consp (cadr e)) (eq (caar (cadr e)) '%derivative)))))

(defparameter *archive-root-degree* 200 "the greatest degree of a polynomial in RealRoot")

(defun archive-make-real-root (reader name from arguments places)
  "RealRoot([a0, .., an], k), a constant: see algebra/real_roots.lisp"
  (archive-expect-count reader name from arguments 2)
  (destructuring-bind (polynomial k) arguments
    (unless (and (eq (archive-form-kind polynomial) :list)
                 (<= 2 (length (cdr polynomial)) (1+ *archive-root-degree*))
                 (loop for a in (cdr polynomial) always (integerp a))
                 (not (eql (cadr polynomial) 0)))
      (archive-fault reader (car places) "expected a list of 2 to ~d whole numbers, not 0 first"
                     (1+ *archive-root-degree*)))
    (unless (typep k `(integer 1 ,*archive-root-degree*))
      (archive-fault reader (cadr places) "expected the number of a root from below, 1, 2, .."))
    (unless (core-attempt (lambda () (core-judge-root (cdr polynomial) k) t))
      (archive-fault reader from "this polynomial has no real root number ~d" k))
    (archive-inert '|$RealRoot| arguments)))

(defun archive-make-matrix (reader name from arguments places)
  (declare (ignore name from))
  (loop for row in arguments for place in places
        do (archive-expect-kind reader place row "a row, [..]," :list)
           (unless (and (cdr row) (= (length row) (length (car arguments))))
             (archive-fault reader place "a row of ~d elements in a matrix whose first row has ~d"
                            (length (cdr row)) (length (cdar arguments))))
           (unless (archive-all-scalar-p (cdr row))
             (archive-fault reader place "the elements of a matrix are expressions")))
  (archive-inert '$matrix arguments))

(defun archive-make-diagonal (reader name from arguments places)
  "The square matrix with ARGUMENTS on its diagonal."
  (declare (ignore name))
  (loop for e in arguments for place in places do (archive-expect-scalar reader place e))
  (when (> (length arguments) *archive-nesting*)
    (archive-fault reader from "a diagonal of more than ~d elements" *archive-nesting*))
  (archive-inert '$matrix
                 (loop for e in arguments for i from 0
                       collect (archive-inert 'mlist
                                              (loop for j below (length arguments) collect
                                                (if (= i j) e 0))))))

(defun archive-make-notequal (reader name from arguments places)
  (archive-expect-count reader name from arguments 2)
  (loop for e in arguments for place in places do (archive-expect-scalar reader place e))
  (archive-inert '$notequal arguments))

(defun archive-make-piecewise (reader name from arguments places)
  "piecewise([condition, value], ...)"
  (declare (ignore name from))
  (loop for case in arguments for place in places
        unless (and (eq (archive-form-kind case) :list) (= (length case) 3)
                    (member (archive-form-kind (cadr case)) '(:relation :truth-value))
                    (eq (archive-form-kind (caddr case)) :scalar))
          do (archive-fault reader place "expected [condition, value] in piecewise"))
  (archive-inert '$piecewise arguments))
