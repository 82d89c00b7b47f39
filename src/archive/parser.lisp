;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Recursive descent over the archive's grammar: text to a simplified Maxima expression, with
;;; nothing evaluated.
;;;   weak to strong   or  and  not  = < <= > >= (no chains)  + -  * /  unary -  ^ (to the right)  '
;;; Names of functions that Maxima does not have are collected with their places: which of them
;;; the archive's own keys allow is known only when [system] has been read, see
;;; archive-check-functions. Look first at archive-parse-value, then at the chain
;;; archive-parse-expression! .. archive-parse-atom!.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/tokens" "archive/simplify"))

(defvar *archive-nesting* #-gcl 200 #+gcl 100
  "The most levels of nesting. GCL has room for two thousand calls in each other, of Maxima's
simplifier too.")
(defparameter *archive-open-functions* 1000 "The most functions that an archive may leave open.")

(defparameter *archive-functions*
  '(("sin" %sin 1) ("cos" %cos 1) ("tan" %tan 1) ("cot" %cot 1) ("sec" %sec 1) ("csc" %csc 1)
    ("asin" %asin 1) ("acos" %acos 1) ("atan" %atan 1) ("atan2" $atan2 2)
    ("sinh" %sinh 1) ("cosh" %cosh 1) ("tanh" %tanh 1) ("exp" %exp 1) ("log" %log 1)
    ("sqrt" %sqrt 1)
    ("abs" mabs 1) ("signum" %signum 1) ("max" $max nil) ("min" $min nil))
  "Functions of numbers: name, Maxima's name, number of arguments (nil: one or more).")

(defparameter *archive-forms*
  '(("diff" . archive-make-derivative) ("integrate" . archive-make-integral)
    ("at" . archive-make-at)
    ("matrix" . archive-make-matrix) ("diag" . archive-make-diagonal)
    ("notequal" . archive-make-notequal)
    ("piecewise" . archive-make-piecewise))
  "Functions whose arguments have a form of their own, with what makes the expression.")

(defparameter *archive-keywords*
  '("if" "then" "else" "elseif" "for" "from" "step" "next" "in" "unless" "while" "thru" "do" "and"
    "or" "not")
  "Words that Maxima's own language keeps for itself.")

(defparameter *archive-relations*
  '((:equal . mequal) (:less . mlessp) (:less-or-equal . mleqp) (:greater . mgreaterp)
    (:greater-or-equal . mgeqp)))

;; What an expression is

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

;; Moving on

(defun archive-expect! (reader kind what)
  "Passes over a token of KIND."
  (unless (eq (reader-kind reader) kind)
    (archive-fault reader (reader-from reader) "found ~a, expected ~a" (archive-token-shown reader)
                   what))
  (archive-next-token! reader))

(defun archive-word-is (reader word)
  (and (eq (reader-kind reader) :name) (zerop (reader-primes reader))
       (string= (reader-value reader) word)))

(defun archive-go-deeper! (reader)
  "One level of nesting more."
  (when (> (incf (reader-depth reader)) *archive-nesting*)
    (archive-fault reader (reader-from reader) "more than ~d levels of nesting"
                   *archive-nesting*)))

(defmacro archive-computed ((reader position) &body body)
  "BODY, with POSITION as the place of an error in a simplification."
  `(let ((*archive-position* ,position) (*archive-reader* ,reader)) ,@body))

;; Expressions and conditions. GCL has room for about two thousand calls in each other: hence
;; few functions from one level of nesting to the next.

(defmacro archive-condition-or-sum (reader from)
  "What stands between and, or: not .., a comparison, or a sum alone."
  `(if (archive-word-is ,reader "not")
       (archive-parse-not! ,reader)
       (let ((left (archive-parse-sum! ,reader)))
         (if (archive-relation-of ,reader) (archive-parse-relation! ,reader ,from left) left))))

(defun archive-parse-expression! (reader)
  "The weakest signs: or, and."
  (let* ((from (reader-from reader)) (first (archive-condition-or-sum reader from)))
    (if (or (archive-word-is reader "and") (archive-word-is reader "or"))
        (archive-parse-conditions! reader from first)
        first)))

(defun archive-parse-condition! (reader)
  (let ((from (reader-from reader)))
    (archive-expect-condition reader from (archive-condition-or-sum reader from))))

(defun archive-expect-condition (reader position e)
  (archive-expect-kind reader position e "a condition" :relation :truth-value))

(defun archive-parse-conditions! (reader from first)
  "What follows FIRST, which stands at FROM, after and, or."
  (archive-expect-condition reader from first)
  (let ((alternatives (list (archive-parse-conjunction! reader first))))
    (loop while (archive-word-is reader "or")
          do (archive-next-token! reader)
             (push (archive-parse-conjunction! reader (archive-parse-condition! reader))
                   alternatives))
    (if (cdr alternatives) (archive-inert 'mor (nreverse alternatives)) (car alternatives))))

(defun archive-parse-conjunction! (reader first)
  (let ((conditions (list first)))
    (loop while (archive-word-is reader "and")
          do (archive-next-token! reader)
             (push (archive-parse-condition! reader) conditions))
    (if (cdr conditions) (archive-inert 'mand (nreverse conditions)) first)))

(defun archive-parse-not! (reader)
  (archive-go-deeper! reader)
  (archive-next-token! reader)
  (prog1 (archive-inert 'mnot (list (archive-parse-condition! reader)))
    (decf (reader-depth reader))))

(defun archive-relation-of (reader) (cdr (assoc (reader-kind reader) *archive-relations*)))

(defun archive-parse-relation! (reader from left)
  "The comparison whose left side LEFT stands at FROM."
  (archive-expect-side reader from left)
  (let ((operator (archive-relation-of reader)))
    (archive-next-token! reader)
    (let* ((from (reader-from reader))
           (right (archive-expect-side reader from (archive-parse-sum! reader))))
      (when (archive-relation-of reader)
        (archive-fault reader (reader-from reader)
                       "found ~a after a comparison; comparisons do not chain, write each one by itself"
                       (archive-token-shown reader)))
      (archive-inert operator (list left right)))))

(defun archive-expect-side (reader position e)
  "A side of an equation: anything but another equation."
  (archive-expect-kind reader position e "one side of an equation or comparison"
                       :scalar :list :matrix :string :truth-value))

;; Sums, products, signs, powers

(defun archive-parse-sum! (reader)
  (let* ((from (reader-from reader)) (first (archive-parse-product! reader)))
    (if (not (member (reader-kind reader) '(:plus :minus)))
        first
        (let ((terms (list first)) (places (list from)))
          (loop while (member (reader-kind reader) '(:plus :minus))
                do (let ((minus (eq (reader-kind reader) :minus)))
                     (archive-next-token! reader)
                     (push (reader-from reader) places)
                     (let ((term (archive-parse-product! reader)))
                       (push (if minus (archive-minus reader (car places) term) term) terms))))
          (archive-add reader (nreverse places) (nreverse terms))))))

(defun archive-parse-product! (reader)
  "Factors and divisors. Their signs are put in front as one -1: -(a+b)*c is -1*(a+b)*c."
  (let ((from (reader-from reader)))
    (multiple-value-bind (first minus) (archive-parse-factor! reader)
      (cond ((member (reader-kind reader) '(:times :over))
             (archive-parse-more-factors! reader from first minus))
            (minus (archive-minus reader from first))
            (t first)))))

(defun archive-parse-more-factors! (reader from first minus)
  "What follows the factor FIRST at FROM, which is negative if MINUS."
  (let ((factors (list first)) (places (list from)))
    (loop while (member (reader-kind reader) '(:times :over))
          do (let ((over (eq (reader-kind reader) :over)))
               (archive-next-token! reader)
               (push (reader-from reader) places)
               (multiple-value-bind (factor negative) (archive-parse-factor! reader)
                 (when negative (setq minus (not minus)))
                 (push (if over (archive-over reader (car places) factor) factor) factors))))
    (when minus
      (push -1 factors)
      (push from places))
    (archive-multiply reader (nreverse places) (nreverse factors))))

(defun archive-parse-factor! (reader)
  "Two values: a power without the signs before it, and whether they make it negative."
  (let ((depth (reader-depth reader)) (from (reader-from reader)) (minus nil))
    (loop while (member (reader-kind reader) '(:minus :plus))
          do (archive-go-deeper! reader)
             (when (eq (reader-kind reader) :minus) (setq minus (not minus)))
             (archive-next-token! reader))
    (let* ((place (reader-from reader)) (factor (archive-parse-atom! reader)))
      (when (eq (reader-kind reader) :power)
        (setq factor (archive-parse-exponent! reader place factor)))
      (unless (= place from)
        (archive-expect-kind reader place factor "an expression" :scalar :list :matrix))
      (setf (reader-depth reader) depth)
      (values factor minus))))

(defun archive-parse-exponent! (reader place base)
  "BASE, which stands at PLACE, to the power that follows."
  (archive-expect-scalar reader place base)
  (archive-go-deeper! reader)
  (archive-next-token! reader)
  (let ((from (reader-from reader)))
    (multiple-value-bind (exponent minus) (archive-parse-factor! reader)
      (archive-expect-scalar reader from exponent)
      (archive-computed (reader place)
        (archive-power base (if minus (archive-negative exponent) exponent))))))

;; Arithmetic of expressions, lists and matrices: what is not plain is done here, element by
;; element

(defun archive-minus (reader position e)
  (archive-expect-kind reader position e "an expression" :scalar :list :matrix)
  (archive-computed (reader position) (archive-over-elements #'archive-negative e)))

(defun archive-over-elements (function e)
  "FUNCTION of E, or of each element of a list or matrix E."
  (if (member (archive-form-kind e) '(:list :matrix))
      (cons (car e) (mapcar (lambda (part)
                              (unless (member (archive-form-kind part) '(:scalar :list :matrix))
                                (archive-refuse "arithmetic with a list that holds more than expressions"))
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

;; Atoms

(defun archive-parse-atom! (reader)
  (case (reader-kind reader)
    ((:number :string) (prog1 (reader-value reader) (archive-next-token! reader)))
    (:constant (prog1 (intern-invert-case (concatenate 'string "$" (reader-value reader)))
                 (archive-next-token! reader)))
    (:name (archive-parse-name! reader))
    (:quote (archive-parse-noun! reader))
    (:open (archive-parse-parenthesis! reader))
    (:open-list (archive-parse-list! reader :close-list "]"))
    (:open-brace (archive-parse-list! reader :close-brace "}"))
    (t (archive-fault reader (reader-from reader) "found ~a, expected a value"
                      (archive-token-shown reader)))))

(defun archive-parse-parenthesis! (reader)
  (let ((from (reader-from reader)))
    (archive-go-deeper! reader)
    (archive-next-token! reader)
    (let ((value (archive-parse-expression! reader)))
      (archive-close! reader from :close ")")
      (decf (reader-depth reader))
      value)))

(defun archive-close! (reader opened kind sign)
  "Passes over the bracket that closes the one at OPENED."
  (unless (eq (reader-kind reader) kind)
    (multiple-value-bind (line column) (archive-reader-place reader opened)
      (archive-fault reader (reader-from reader)
                     "found ~a, expected an operator, a comma or ~a (the bracket opened at line ~d, column ~d)~a"
                     (archive-token-shown reader) sign line column
                     (if (eq (reader-kind reader) :end)
                         "; a value continued on the next line is indented" ""))))
  (archive-next-token! reader))

(defun archive-parse-elements! (reader kind sign)
  "The values up to the bracket of KIND, with their places: two lists."
  (let ((opened (reader-from reader)) (elements '()) (places '()))
    (archive-go-deeper! reader)
    (unless (eq (archive-next-token! reader) kind)
      (loop
        (push (reader-from reader) places)
        (push (archive-parse-expression! reader) elements)
        (unless (eq (reader-kind reader) :comma) (return))
        (archive-next-token! reader)))
    (archive-close! reader opened kind sign)
    (decf (reader-depth reader))
    (values (nreverse elements) (nreverse places))))

(defun archive-parse-list! (reader kind sign)
  (archive-inert 'mlist (archive-parse-elements! reader kind sign)))

(defun archive-symbol (name)
  "The Maxima symbol of NAME."
  (getalias (intern-invert-case (concatenate (quote string) "$" name))))

(defun archive-parse-name! (reader)
  (let ((name (reader-value reader)) (primes (reader-primes reader)) (from (reader-from reader)))
    (when (member name *archive-keywords* :test #'string=)
      (archive-fault reader from
                     "found `~a', expected a value: the word is reserved and cannot be a name" name))
    (archive-next-token! reader)
    (cond ((plusp primes) (archive-primed-name reader name primes from))
          ((eq (reader-kind reader) :open)
           (multiple-value-bind (arguments places) (archive-parse-elements! reader :close ")")
             (archive-function-call reader name from arguments places)))
          ((string= name "true") t)
          ((string= name "false") nil)
          ((member (reader-kind reader) '(:quote))
           (archive-fault reader (reader-from reader)
                          "found ', expected an operator: a time derivative's ' stands directly after the name"))
          (t (core-read-symbol (archive-symbol name))))))

(defun archive-primed-name (reader name primes from)
  "The time derivative of order PRIMES."
  (when (member name '("true" "false" "inf" "t") :test #'string=)
    (archive-fault reader from "found ~a', expected the name of a coordinate before '" name))
  (when (> primes *archive-nesting*)
    (archive-fault reader from "more than ~d signs ' after a name" *archive-nesting*))
  (when (eq (reader-kind reader) :open)
    (archive-fault reader (reader-from reader)
                   "found ( after ~a', expected an operator: ' stands after names of coordinates only" name))
  (list '(%derivative simp) (core-read-symbol (archive-symbol name)) '$t primes))

(defun archive-parse-noun! (reader)
  "The quote before diff, integrate or at: these are nouns with and without it."
  (archive-next-token! reader)
  (unless (and (eq (reader-kind reader) :name) (zerop (reader-primes reader))
               (member (reader-value reader) '("diff" "integrate" "at") :test #'string=))
    (archive-fault reader (reader-from reader) "found ~a after ', expected diff, integrate or at"
                   (archive-token-shown reader)))
  (let ((name (reader-value reader)) (from (reader-from reader)))
    (archive-next-token! reader)
    (unless (eq (reader-kind reader) :open)
      (archive-fault reader (reader-from reader) "found ~a, expected ( after ~a"
                     (archive-token-shown reader) name))
    (multiple-value-bind (arguments places) (archive-parse-elements! reader :close ")")
      (archive-function-call reader name from arguments places))))

;; Functions

(defun archive-function-call (reader name from arguments places)
  "The function NAME, which stands at FROM, of ARGUMENTS, which stand at PLACES."
  (let ((form (cdr (assoc name *archive-forms* :test #'string=)))
        (function (assoc name *archive-functions* :test #'string=)))
    (when (null arguments)
      (archive-fault reader from "~a() has no arguments" name))
    (archive-computed (reader from)
      (cond (form (funcall form reader name from arguments places))
            (t (unless function (archive-note-call reader name from))
               (loop for argument in arguments for place in places
                     do (archive-expect-scalar reader place argument))
               (if function
                   (archive-make-function reader function from arguments)
                   (archive-inert (archive-symbol name) arguments)))))))

(defun archive-make-function (reader function from arguments)
  (destructuring-bind (name operator number) function
    (when (and number (/= number (length arguments)))
      (archive-fault reader from "~a has ~d argument~:p, expected ~d" name (length arguments)
                     number))
    (archive-function-value operator arguments)))

(defun archive-note-call (reader name from)
  "Keeps the call of a function that Maxima does not have: the archive's keys must name it."
  (when (member name '("true" "false" "inf") :test #'string=)
    (archive-fault reader from "~a is not a function" name))
  (when (archive-maxima-function-p name)
    (archive-fault reader from "found the function ~a of Maxima; an archive cannot call it" name))
  (unless (assoc name (reader-calls reader) :test #'string=)
    (when (> (length (reader-calls reader)) *archive-open-functions*)
      (archive-fault reader from "more than ~d functions" *archive-open-functions*))
    (push (cons name from) (reader-calls reader))))

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
                     "expected the order of a derivative, an integer from 1 to ~d" *archive-nesting*))
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

;; Whole values

(defun archive-parse-reader! (reader &key relations)
  "The value that READER stands on, up to its end; with RELATIONS it may be an equation or a
condition."
  (archive-with-plain-simplifier
    (let* ((*archive-reader* reader) (*archive-position* (reader-from reader))
           (from (reader-from reader))
           (*archive-work* (or *archive-work* (list 0))))
      (when (eq (reader-kind reader) :end)
        (archive-fault reader from "an empty value"))
      (let ((value (handler-case (archive-parse-expression! reader)
                     (arithmetic-error ()
                                       (archive-fault reader (reader-from reader)
                                                      "a result outside the range of doubles")))))
        (unless (eq (reader-kind reader) :end)
          (archive-fault reader (reader-from reader)
                         "found ~a, expected an operator or the end of the value"
                         (archive-token-shown reader)))
        (unless relations
          (archive-expect-kind reader from value "a value" :scalar :list :matrix :string
                               :truth-value))
        value))))

(defun archive-parse-value (text &key file (line 1) (column 1) (start 0) end doubles relations)
  "Two values: the Maxima expression that TEXT from START to END spells, and the functions called
in it that Maxima does not have, as a list of (name line column), each once. DOUBLES: decimals are
doubles. RELATIONS: the value may be an equation."
  (let* ((reader (archive-open-text text :file file :line line :column column :start start :end end
                                    :doubles doubles))
         (value (archive-parse-reader! reader :relations relations)))
    (values value (archive-reader-calls reader))))

(defun archive-reader-calls (reader)
  "The open functions that READER met, each with the place where it came first: list of (name
line column)."
  (loop for (name . position) in (reverse (reader-calls reader))
        collect (cons name (multiple-value-list (archive-reader-place reader position)))))

(defun archive-maxima-function-p (name)
  "True when Maxima, not the person, has a function or operator called NAME."
  (let ((symbol (archive-symbol name)))
    (and (not (mget symbol 'mexpr))
         (or (fboundp symbol) (get symbol 'operators) (get symbol 'mfexpr*) (get symbol 'autoload)
             (get symbol 'alias)
             (get (intern-invert-case (concatenate 'string "%" name)) 'operators))
         t)))

(defun archive-check-functions (calls known file)
  "An error for the first of CALLS (name line column) that is not in KNOWN, a list of names."
  (loop for (name line column) in calls
        unless (member name known :test #'string=)
          do (archive-fault-at file line column
                               "found the function ~a, which is neither one of the archive's nor named in `functions'" name)))
