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
  (core-require "archive/compounds" "archive/function_values" "archive/plain_simplifier"
                "archive/simplify" "archive/tokens"))

(defparameter *archive-open-functions* 1000 "The most functions that an archive may leave open.")

(defparameter *archive-functions*
  '(("sin" %sin 1) ("cos" %cos 1) ("tan" %tan 1) ("cot" %cot 1) ("sec" %sec 1) ("csc" %csc 1)
    ("asin" %asin 1) ("acos" %acos 1) ("atan" %atan 1) ("atan2" $atan2 2)
    ("sinh" %sinh 1) ("cosh" %cosh 1) ("tanh" %tanh 1) ("exp" %exp 1) ("log" %log 1)
    ("sqrt" %sqrt 1) ("unit_step" $unit_step 1)
    ("abs" mabs 1) ("signum" %signum 1) ("max" $max nil) ("min" $min nil))
  "Functions of numbers: name, Maxima's name, number of arguments (nil: one or more).")

(defparameter *archive-forms*
  '(("diff" . archive-make-derivative) ("integrate" . archive-make-integral)
    ("at" . archive-make-at) ("RealRoot" . archive-make-real-root)
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
                       "found ~a after a comparison; comparisons do not chain, write each one by ~
                        itself"
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
                     "found ~a, expected an operator, a comma or ~a (the bracket opened at line ~
                      ~d, column ~d)~a"
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
                     "found `~a', expected a value: the word is reserved and cannot be a name"
                     name))
    (archive-next-token! reader)
    (cond ((plusp primes) (archive-primed-name reader name primes from))
          ((eq (reader-kind reader) :open)
           (multiple-value-bind (arguments places) (archive-parse-elements! reader :close ")")
             (archive-function-call reader name from arguments places)))
          ((eq (reader-kind reader) :open-list) (archive-fault-subscript reader name))
          ((string= name "true") t)
          ((string= name "false") nil)
          ((member (reader-kind reader) '(:quote))
           (archive-fault reader (reader-from reader)
                          "found ', expected an operator: a time derivative's ' stands directly ~
                           after the name"))
          (t (core-read-symbol (archive-symbol name))))))

(defun archive-fault-subscript (reader name)
  (archive-fault reader (reader-from reader)
                 "found [ after ~a, expected an operator: functions are written with ( ), and ~
                  names have no subscripts~a"
                 name (archive-meant-advice name)))

(defun archive-primed-name (reader name primes from)
  "The time derivative of order PRIMES."
  (when (member name '("true" "false" "inf" "t") :test #'string=)
    (archive-fault reader from "found ~a', expected the name of a coordinate before '" name))
  (when (> primes *archive-nesting*)
    (archive-fault reader from "more than ~d signs ' after a name" *archive-nesting*))
  (when (eq (reader-kind reader) :open)
    (archive-fault reader (reader-from reader)
                   "found ( after ~a', expected an operator: ' stands after names of coordinates ~
                    only"
                   name))
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
    (archive-fault reader from "found the function ~a of Maxima; an archive cannot call it~a" name
                   (archive-meant-advice name)))
  (unless (assoc name (reader-calls reader) :test #'string=)
    (when (> (length (reader-calls reader)) *archive-open-functions*)
      (archive-fault reader from "more than ~d functions" *archive-open-functions*))
    (push (cons name from) (reader-calls reader))))

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

(defun archive-parse-value (text &key doubles relations)
  "Two values: the Maxima expression that TEXT spells, a string or an archive-stretch of one, and
the functions called in it that Maxima does not have, as a list of (name line column), each once.
DOUBLES: decimals are doubles. RELATIONS: the value may be an equation."
  (let* ((reader (archive-open-text text :doubles doubles))
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
                               "found the function ~a, which is neither one of the archive's nor ~
                                named in `functions'~a"
                               name (archive-meant-advice name))))
