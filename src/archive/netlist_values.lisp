;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of a netlist, exact: 4.7k, 10MEGohm, {2*R0 + sqrt(x)}. A value becomes a text of the
;;; archive's grammar, numbers with their suffixes put in, and parameters with their values; the
;;; archive's own parser makes an expression of it, with its guards on nesting, digits and powers.
;;; Scopes of parameters: a table of name -> text, then value; that of a call of a subcircuit stands
;;; in the one where it is defined.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/netlist_lines" "archive/parser" "archive/speller" "archive/suffixes"
                "archive/tokens"))

(defparameter *archive-net-functions*
  '(("abs" . "abs") ("sqrt" . "sqrt") ("exp" . "exp") ("ln" . "log") ("log" . "log")
    ("sin" . "sin") ("cos" . "cos") ("tan" . "tan") ("asin" . "asin") ("acos" . "acos")
    ("atan" . "atan") ("arctan" . "atan") ("sinh" . "sinh") ("cosh" . "cosh") ("tanh" . "tanh")
    ("min" . "min") ("max" . "max") ("sgn" . "signum")
    ("u" . "unit_step") ("stp" . "unit_step"))
  "Functions of expressions, and what the archive calls them.")

;;; Numbers

(defun archive-net-number-end (text from end)
  "The place behind the digits, point and exponent at FROM, or nil where there is no number."
  (let* ((whole (archive-digits-end text from end))
         (point (and (< whole end) (char= (char text whole) #\.)))
         (to (if point (archive-digits-end text (1+ whole) end) whole)))
    (unless (= (if point (1- to) to) from)
      (archive-net-exponent-end text to end))))

(defun archive-net-exponent-end (text position end)
  "The place behind an exponent that begins at POSITION; POSITION where there is none."
  (flet ((digit-p (k) (and (< k end) (digit-char-p (char text k)))))
    (if (and (< position end) (char-equal (char text position) #\e))
        (let ((from (if (and (< (1+ position) end) (find (char text (1+ position)) "+-"))
                        (+ position 2)
                        (1+ position))))
          (if (digit-p from) (archive-digits-end text from end) position))
        position)))

(defun archive-net-number (digits exponent)
  "The text of the number that DIGITS spell, 4.7e3, times ten to EXPONENT."
  (let* ((mark (or (position #\e digits :test #'char-equal) (length digits)))
         (mantissa (subseq digits 0 mark))
         (size (if (< mark (length digits))
                   (parse-integer digits :start (1+ mark) :junk-allowed t)
                   0))
         (point (or (position #\. mantissa) (length mantissa)))
         (places (max 0 (- (length mantissa) point 1))))
    (when (or (> (abs size) *archive-decimal-exponent*) (> (length mantissa) *archive-digits*))
      (archive-net-fault "the number ~a is too long or too large" (archive-shown digits)))
    (let ((value (* (parse-integer (remove #\. mantissa)) (expt 10 (- (+ size exponent) places)))))
      (if (integerp value)
          (format nil "~d" value)
          (format nil "(~d/~d)" (numerator value) (denominator value))))))

(defun archive-net-suffix (letters)
  "The power of ten of the suffix with which LETTERS begin, 0 where a unit follows."
  (let ((found (find-if (lambda (pair)
                          (let ((n (length (car pair))))
                            (and (>= (length letters) n)
                                 (string-equal (car pair) letters :end2 n))))
                        *archive-suffixes*)))
    (cond ((and (>= (length letters) 3) (string-equal "mil" letters :end2 3))
           (archive-net-fault "the suffix mil is not read; write 25.4e-6"))
          ((and (plusp (length letters)) (char-equal (char letters 0) #\a))
           (archive-net-fault "the suffix ~a means 1e-18 to some programs and nothing to others; ~
                               write the power of ten" letters))
          (found (cdr found))
          (t 0))))

;;; Expressions, token by token

(defun archive-net-expression (text scope)
  "TEXT, an expression without its { }, as a text of the archive's grammar; SCOPE, a function of a
name in small letters, gives the text of its value."
  (let* ((text (archive-simple-text text)) (mark (archive-net-outside text "?")))
    (if mark
        (archive-net-choice text mark scope)
        (archive-net-plain-expression text scope))))

(defun archive-net-plain-expression (text scope)
  (let ((position 0) (end (length text)) (pieces '()))
    (loop
      (setq position (or (position-if-not #'archive-net-blank-p text :start position) end))
      (when (>= position end)
        (return (format nil "~{~a~}" (nreverse pieces))))
      (multiple-value-bind (piece after) (archive-net-piece text position end scope)
        (when (archive-net-would-grow-together-p (first pieces) piece) (push " " pieces))
        (push piece pieces)
        (setq position after)))))

(defun archive-net-would-grow-together-p (before piece)
  "Whether BEFORE and PIECE side by side would be one word: 1 2 is not 12."
  (flet ((word-p (c) (or (archive-word-p c) (char= c #\.))))
    (and before (word-p (char before (1- (length before)))) (word-p (char piece 0)))))

(defun archive-net-piece (text from end scope)
  "Two values: the token at FROM in the archive's words, and where it ends."
  (let ((c (char text from)))
    (cond ((archive-net-number-end text from end) (archive-net-number-piece text from end))
          ((archive-letter-p c) (archive-net-name-piece text from end scope))
          ((and (char= c #\*) (< (1+ from) end) (char= (char text (1+ from)) #\*))
           (archive-net-power-piece text (+ from 2) end))
          ((char= c #\^) (archive-net-power-piece text (1+ from) end))
          ((archive-net-choice-inside-p text from end)
           (let ((close (archive-net-closing text from end)))
             (values (archive-net-expression (subseq text (1+ from) close) scope) (1+ close))))
          ((find c "+-*/(),") (values (string c) (1+ from)))
          (t (archive-net-fault "found `~a' in an expression; + - * / ^ ** ( ), numbers, ~
                                 parameters and functions are read" (archive-shown (string c)))))))

(defvar *archive-net-even-powers* nil
  "Whether exponents are even numbers: programs differ on other powers of what may be negative.")

(defun archive-net-power-piece (text after end)
  (archive-net-refuse-chain text after end)
  (when *archive-net-even-powers*
    (archive-net-check-exponent
     (subseq text after (archive-digits-end text (archive-skip-blanks text after end) end))))
  (values "^" after))

(defun archive-net-refuse-chain (text after end)
  "An error where another power follows the exponent that begins AFTER."
  (let* ((behind (archive-net-operand-end text after end))
         (next (position-if-not #'archive-net-blank-p text :start behind)))
    (when (and next (or (char= (char text next) #\^)
                        (eql next (search "**" text :start2 next))))
      (archive-net-fault "a^b^c is not read: programs differ on which power comes first; write ~
                          parentheses"))))

(defun archive-net-operand-end (text after end)
  "The place behind the number, name, call or parenthesis that begins AFTER, perhaps with a sign."
  (let* ((from (or (position-if-not (lambda (c) (or (archive-net-blank-p c) (find c "+-"))) text
                                    :start after)
                   end))
         (word (if (and (< from end) (archive-word-p (char text from)))
                   (archive-word-end text (or (archive-net-number-end text from end) from) end)
                   from))
         (open (position-if-not #'archive-net-blank-p text :start word)))
    (if (and open (char= (char text open) #\())
        (1+ (archive-net-closing text open end))
        word)))

(defun archive-net-check-exponent (exponent)
  (let ((number (parse-integer exponent :junk-allowed t)))
    (unless (and number (evenp number))
      (archive-net-fault "a power whose exponent is no even number is not read here: programs ~
                          differ on it where its base is negative; write products"))))

(defun archive-net-number-piece (text from end)
  (let* ((digits-end (archive-net-number-end text from end))
         (after (archive-word-end text digits-end end))
         (letters (subseq text digits-end after)))
    (when (find-if-not #'archive-letter-p letters)
      (archive-net-fault "`~a' is no number" (archive-shown (subseq text from after))))
    (values (archive-net-number (subseq text from digits-end) (archive-net-suffix letters))
            after)))

(defun archive-net-name-piece (text from end scope)
  (let* ((to (archive-word-end text from end))
         (name (string-downcase (subseq text from to)))
         (next (position-if-not #'archive-net-blank-p text :start to))
         (called (and next (char= (char text next) #\())))
    (cond ((and called (assoc name *archive-net-functions* :test #'string=))
           (values (cdr (assoc name *archive-net-functions* :test #'string=)) to))
          (called (archive-net-call-piece name text next end scope))
          ((string= name "pi") (values "%pi" to))
          (t (values (funcall scope name) to)))))

(defun archive-net-call-piece (name text open end scope)
  "pow(x, y), log10(x), and what SCOPE knows, such as v(1,2)."
  (let* ((close (archive-net-closing text open end))
         (inside (subseq text (1+ open) close)))
    (flet ((inner (part) (archive-net-expression part scope)))
      (values
       (cond ((string= name "log10") (format nil "(log(~a)/log(10))" (inner inside)))
             ((string= name "uramp") (format nil "max(0, ~a)" (inner inside)))
             ((string= name "pow")
              (destructuring-bind (base exponent) (archive-net-two-parts inside)
                (when *archive-net-even-powers* (archive-net-check-exponent exponent))
                (format nil "((~a)^(~a))" (inner base) (inner exponent))))
             (t (funcall scope (list name inside))))
       (1+ close)))))

(defun archive-net-closing (text open end)
  (loop with depth = 0
        for position from open below end
        do (case (char text position)
             (#\( (incf depth))
             (#\) (when (zerop (decf depth)) (return position))))
        finally (archive-net-fault "a parenthesis without its end")))

;;; Choices, condition ? value : other

(defun archive-net-outside (text characters &optional (start 0))
  "The place of the first of CHARACTERS outside of parentheses from START on, or nil."
  (let ((depth 0))
    (position-if (lambda (c)
                   (case c (#\( (incf depth)) (#\) (decf depth)))
                   (and (zerop depth) (find c characters)))
                 text :start start)))

(defun archive-net-choice-inside-p (text from end)
  "Whether a parenthesis with a choice in it begins at FROM."
  (and (char= (char text from) #\() (find #\? text :start from)
       (archive-net-outside (subseq text (1+ from) (archive-net-closing text from end)) "?")))

(defun archive-net-choice (text mark scope)
  "The choice whose `?' stands at MARK, as piecewise."
  (when (archive-net-outside text ",")
    (archive-net-fault "a choice c ? a : b among arguments stands in parentheses of its own"))
  (format nil "piecewise(~{~a~^, ~})" (archive-net-pieces text mark scope)))

(defun archive-net-pieces (text mark scope)
  "[condition, value] of the choice whose `?' stands at MARK and of those behind its colon."
  (let* ((colon (archive-net-colon text mark))
         (other (archive-net-bared (subseq text (1+ colon))))
         (next (archive-net-outside other "?")))
    (cons (format nil "[~a, ~a]" (archive-net-condition (subseq text 0 mark) scope)
                  (archive-net-expression (subseq text (1+ mark) colon) scope))
          (if next
              (archive-net-pieces other next scope)
              (list (format nil "[true, ~a]" (archive-net-expression other scope)))))))

(defun archive-net-bared (text)
  "TEXT without blanks at its ends and parentheses around all of it."
  (let* ((text (archive-net-trimmed text)) (end (length text)))
    (if (and (plusp end) (char= (char text 0) #\()
             (= (archive-net-closing text 0 end) (1- end)))
        (archive-net-bared (subseq text 1 (1- end)))
        text)))

(defun archive-net-colon (text mark)
  "The place of the colon of the choice whose `?' stands at MARK."
  (loop with depth = 1
        for place = (archive-net-outside text "?:" (1+ mark))
          then (archive-net-outside text "?:" (1+ place))
        while place
        do (if (char= (char text place) #\?) (incf depth) (decf depth))
           (when (zerop depth) (return place))
        finally (archive-net-fault "`?' without its colon")))

(defun archive-net-condition (text scope)
  "A relation, perhaps in parentheses."
  (let* ((text (archive-net-bared text)) (end (length text))
         (sign (archive-net-outside text "<>")))
    (cond ((and sign (not (find-if (lambda (c) (find c "&|!")) text)))
           (let ((after (if (and (< (1+ sign) end) (char= (char text (1+ sign)) #\=))
                            (+ 2 sign)
                            (1+ sign))))
             (format nil "~a ~a ~a" (archive-net-expression (subseq text 0 sign) scope)
                     (subseq text sign after)
                     (archive-net-expression (subseq text after) scope))))
          (t (archive-net-fault "the condition ~a is not read; < <= > >= are"
                                (archive-shown text))))))

(defun archive-net-two-parts (text)
  "The parts before and after the comma of TEXT outside of parentheses."
  (let* ((depth 0)
         (comma (position-if (lambda (c)
                               (case c (#\( (incf depth)) (#\) (decf depth)))
                               (and (char= c #\,) (zerop depth)))
                             text)))
    (unless comma (archive-net-fault "pow takes two numbers"))
    (list (subseq text 0 comma) (subseq text (1+ comma)))))

;;; Values

(defun archive-net-parsed (text)
  "The expression that TEXT spells in the archive's grammar."
  (multiple-value-bind (value trouble)
      (let ((*core-function* nil)) (core-caught (lambda () (archive-parse-value text))))
    (when trouble (archive-net-fault "~a" trouble))
    value))

(defun archive-net-text (field scope)
  "The value of FIELD, a word or an expression in { }, as a text that needs no parentheses."
  (let* ((inside (if (char= (char field 0) #\{) (subseq field 1 (1- (length field))) field))
         (value (archive-net-parsed (archive-net-expression inside scope))))
    (archive-net-spelled value)))

(defun archive-net-spelled (value)
  "VALUE as one field of a row."
  (let ((text (archive-spell value)))
    (if (find #\Space text) (format nil "(~a)" text) text)))

(defun archive-net-value (field scope)
  "As archive-net-text, of a field that must begin like a value."
  (let ((bare (string-left-trim "+" field)))
    (unless (and (plusp (length bare))
                 (or (find (char bare 0) "{-.") (digit-char-p (char bare 0))
                     (archive-letter-p (char bare 0))))
      (archive-net-fault "found `~a', expected a value" (archive-shown field)))
    (archive-net-text bare (lambda (name) (archive-net-parameter name scope)))))

;;; Parameters

(defvar *archive-net-depth* 0 "How many parameters ask for each other.")

(defstruct (archive-net-scope (:conc-name net-scope-))
  (table (make-hash-table :test #'equal))   ; name -> (text . scope), or the text of its value
  (above nil))

(defun archive-net-parameter (name scope)
  "The text of the value of the parameter NAME, in parentheses."
  (when (consp name)
    (archive-net-fault "the function ~a is not read in expressions" (first name)))
  (loop for place = scope then (net-scope-above place)
        while place
        do (let ((entry (gethash name (net-scope-table place))))
             (when entry
               (return (format nil "(~a)" (archive-net-entry-text name entry place)))))
        finally (archive-net-fault "~a is no number and no parameter" (archive-shown name))))

(defun archive-net-entry-text (name entry place)
  (cond ((stringp entry) entry)
        ((eq entry :asked) (archive-net-fault "the parameter ~a leads back to itself" name))
        ((> *archive-net-depth* 100)
         (archive-net-fault "the parameter ~a rests on more than 100 others, one on the other"
                            name))
        (t (destructuring-bind (line field . scope) entry
             (setf (gethash name (net-scope-table place)) :asked)
             (setf (gethash name (net-scope-table place))
                   (let ((*archive-net-line* line)
                         (*archive-net-depth* (1+ *archive-net-depth*)))
                     (archive-net-value field scope)))))))

(defun archive-net-define (scope name field where)
  "The parameter NAME of SCOPE is FIELD, in which the names of the scope WHERE stand."
  (setf (gethash (string-downcase name) (net-scope-table scope))
        (list* *archive-net-line* field where)))

(defun archive-net-pairs (fields)
  "((name value) ..) of FIELDS name = value name = value .."
  (loop while fields
        collect (destructuring-bind (name &optional sign value &rest more) fields
                  (unless (and value (string= sign "=") (archive-name-p name))
                    (archive-net-fault "found `~{~a~^ ~}', expected name = value"
                                       (loop for field in fields repeat 3 collect field)))
                  (setq fields more)
                  (list name value))))
