;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A Maxima expression as text of the archive's grammar, with as few parentheses as the grammar
;;; allows. Two laws: what is read back is the expression again, and a text so spelled is
;;; spelled the same after it was read. Doubles are written with the fewest digits that read
;;; back the same. Look first at archive-spell-at.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/compounds" "archive/parser" "archive/simplify" "archive/tokens"
                "core/bigfloats"))

(defvar *archive-out* nil
  "What is written, the last piece first. (GCL's string streams take time in squares.)")
(defvar *archive-spelled-depth* 0 "Levels of nesting so far.")

(defvar *archive-bigfloats* nil
  "Whether bigfloats are written, as decimals of all their digits: in tables of numerical results.")

(defparameter *archive-levels*
  '(:any 0 :or 1 :and 2 :not 3 :relation 4 :sum 5 :product 6 :sign 7 :power 8 :atom 9)
  "How strongly the outermost sign of an expression binds.")

(defun archive-level (name) (getf *archive-levels* name))

(defparameter *archive-operator-names*
  '((%sin . "sin") (%cos . "cos") (%tan . "tan") (%cot . "cot") (%sec . "sec") (%csc . "csc")
    (%asin . "asin") (%acos . "acos") (%atan . "atan") ($atan2 . "atan2") (%atan2 . "atan2")
    (%sinh . "sinh") (%cosh . "cosh") (%tanh . "tanh") (%log . "log") (%sqrt . "sqrt")
    (%exp . "exp") (mabs . "abs") (%signum . "signum") ($signum . "signum")
    ($max . "max") (%max . "max") ($min . "min") (%min . "min") ($unit_step . "unit_step")
    ($integrate . "integrate") (%integrate . "integrate") ($at . "at") (%at . "at")
    ($matrix . "matrix") ($notequal . "notequal") (mnotequal . "notequal")
    ($piecewise . "piecewise") (|$RealRoot| . "RealRoot")))

(defun archive-unspellable (control &rest arguments)
  (core-error "an archive cannot hold ~?" control arguments))

(defun archive-put (text) (push text *archive-out*))

(defun archive-joined (pieces)
  "The strings PIECES as one."
  (let ((text (make-string (loop for piece in pieces sum (length piece)))) (position 0))
    (dolist (piece pieces text)
      (replace text piece :start1 position)
      (incf position (length piece)))))

;; Numbers

(defun archive-double-digits (double)
  "Two values for a positive DOUBLE: its shortest digits, and the exponent of ten of the first
one."
  (let* ((*read-default-float-format* 'double-float)
         (printed (prin1-to-string double))
         (mark (position-if (lambda (c) (find c "eEdD")) printed))
         (mantissa (subseq printed 0 mark))
         (exponent (if mark (parse-integer printed :start (1+ mark)) 0))
         (point (or (position #\. mantissa) (length mantissa)))
         (digits (remove #\. mantissa))
         (first (or (position #\0 digits :test-not #'char=) 0)))
    (values (or (string-right-trim "0" (subseq digits first)) "0")
            (+ exponent (- point first 1)))))

(defun archive-spell-double (double)
  "DOUBLE, not negative, as a decimal that reads back the same."
  (cond ((not (<= 0 double most-positive-double-float))
         (archive-unspellable "a double that is not a number"))
        ((zerop double) "0.0")
        (t (multiple-value-bind (digits exponent) (archive-double-digits double)
             (cond ((<= 0 exponent 15) (archive-decimal-with-point digits (1+ exponent)))
                   ((<= -5 exponent -1) (archive-decimal-with-point digits (1+ exponent)))
                   (t (let ((size (max exponent (- *archive-decimal-exponent*))))
                        (format nil "~ae~d"
                                (archive-decimal-with-point digits
                                                            (- (1+ exponent) size)) size))))))))

(defun archive-decimal-with-point (digits whole)
  "DIGITS with the point after the first WHOLE of them; WHOLE may be negative or beyond the end."
  (let ((n (length digits)))
    (cond ((<= whole 0)
           (concatenate 'string "0." (make-string (- whole) :initial-element #\0) digits))
          ((>= whole n) (concatenate 'string digits (make-string (- whole n) :initial-element #\0)
                                     ".0"))
          (t (concatenate 'string (subseq digits 0 whole) "." (subseq digits whole))))))

(defun archive-spell-integer (n)
  (when (> (archive-integer-digits n) (+ *archive-digits* 1))
    (archive-unspellable "an integer of more than ~d digits" *archive-digits*))
  (let ((*print-base* 10) (*print-radix* nil))
    (prin1-to-string n)))

(defun archive-negative-number-p (e)
  (cond ((floatp e) (or (minusp e) (and (zerop e) (minusp (float-sign e)))))
        (t (and (mnump e) (mnegp e)))))

(defun archive-spell-number (e)
  "The number E, not negative; a ratio as p/q."
  (cond ((floatp e) (archive-put (archive-spell-double (float e 1d0))))
        ((integerp e) (archive-put (archive-spell-integer e)))
        ((ratnump e)
         (archive-put (archive-spell-integer (cadr e)))
         (archive-put "/")
         (archive-put (archive-spell-integer (caddr e))))
        (t (archive-put (or (and *archive-bigfloats* (core-bigfloat-text e))
                            (archive-unspellable "a bigfloat"))))))

;; How an expression is seen: what is written first, and how strongly it binds

(defun archive-leading-number (e)
  "The number in front of the product E, or 1."
  (cond ((mnump e) e)
        ((and (mtimesp e) (mnump (cadr e))) (cadr e))
        (t 1)))

(defun archive-leads-minus-p (e)
  (archive-negative-number-p (archive-leading-number e)))

(defun archive-without-minus (e)
  "-E, for an E that leads with a negative number, as a form to be written."
  (flet ((opposite (number)
           (cond ((floatp number) (- number))
                 (($bfloatp number) (core-bigfloat-negative number))
                 (t (timesk -1 number)))))
    (cond ((mnump e) (opposite e))
          ((and (eql (cadr e) -1) (cdddr e)) (cons (car e) (cddr e)))
          ((eql (cadr e) -1) (caddr e))
          (t (list* (car e) (opposite (cadr e)) (cddr e))))))

(defun archive-divisor-exponent-p (e)
  (and (mexptp e) (not (eq (cadr e) '$%e)) (mnump (caddr e)) (not (floatp (caddr e)))
       (mnegp (caddr e))))

(defun archive-fraction (e)
  "Two values for a product, power or number without leading minus: lists of factors above and
below the line."
  (let ((above '()) (below '()))
    (dolist (factor (if (mtimesp e) (cdr e) (list e)))
      (cond ((ratnump factor)
             (unless (eql (cadr factor) 1) (push (cadr factor) above))
             (push (caddr factor) below))
            ((archive-divisor-exponent-p factor)
             (push (archive-inverted factor) below))
            (t (push factor above))))
    (values (nreverse above) (nreverse below))))

(defun archive-inverted (power)
  "The power with the opposite exponent, as a form to be written."
  (let ((exponent (timesk -1 (caddr power))))
    (if (eql exponent 1) (cadr power) (list '(mexpt simp) (cadr power) exponent))))

(defun archive-expression-level (e)
  (cond ((archive-leads-minus-p e)
         (if (>= (archive-expression-level (archive-without-minus e)) (archive-level :sign))
             (archive-level :sign)
             (archive-level :product)))
        ((ratnump e) (archive-level :product))
        ((atom e) (archive-level :atom))
        (t (case (caar e)
             (mor (archive-level :or))
             (mand (archive-level :and))
             (mnot (archive-level :not))
             ((mequal mlessp mleqp mgreaterp mgeqp $equal) (archive-level :relation))
             (mplus (archive-level :sum))
             (mtimes (archive-level :product))
             (mexpt (archive-power-level e))
             (t (archive-level :atom))))))

(defun archive-root-p (e) (alike1 (caddr e) '((rat simp) 1 2)))

(defun archive-power-level (e)
  (cond ((archive-divisor-exponent-p e) (archive-level :product))
        ((or (eq (cadr e) '$%e) (archive-root-p e)) (archive-level :atom))
        (t (archive-level :power))))

;; Writing

(defmacro archive-spelled-deeper (&body body)
  "BODY one level of nesting deeper."
  `(let ((*archive-spelled-depth* (1+ *archive-spelled-depth*)))
     (when (> *archive-spelled-depth* *archive-nesting*)
       (archive-unspellable "an expression of more than ~d levels" *archive-nesting*))
     ,@body))

(defun archive-spell-at (e level)
  "Writes E where what binds more weakly than LEVEL needs parentheses."
  (if (< (archive-expression-level e) level)
      (archive-spelled-deeper
        (archive-put "(")
        (archive-spell-form e)
        (archive-put ")"))
      (archive-spell-form e)))

(defun archive-spell-form (e)
  (cond ((archive-leads-minus-p e) (archive-spell-minus e))
        ((mnump e) (archive-spell-number e))
        ((atom e) (archive-spell-atom e))
        ((not (consp (car e))) (archive-unspellable "a Lisp object"))
        (t (case (caar e)
             (mplus (archive-spell-sum e))
             (mtimes (archive-spell-product e))
             (mexpt (archive-spell-power e))
             (mlist (archive-spell-bracketed "[" (cdr e) "]"))
             (%derivative (archive-spell-derivative e))
             ($derivative (archive-spell-derivative e))
             ($diff (archive-spell-derivative e))
             ((mequal $equal) (archive-spell-relation " = " e))
             (mlessp (archive-spell-relation " < " e))
             (mleqp (archive-spell-relation " <= " e))
             (mgreaterp (archive-spell-relation " > " e))
             (mgeqp (archive-spell-relation " >= " e))
             (mand (archive-spell-joined " and " (cdr e) (archive-level :not)))
             (mor (archive-spell-joined " or " (cdr e) (archive-level :and)))
             (mnot (archive-put "not ")
                   (archive-spelled-deeper (archive-spell-at (cadr e) (archive-level :not))))
             (t (archive-spell-function e))))))

(defun archive-spell-minus (e)
  "A minus, and what it stands before: a product may follow as it is, -a*b being -(a*b)."
  (archive-put "-")
  (archive-spelled-deeper
    (let ((positive (archive-without-minus e)))
      (archive-spell-at positive
                        (archive-level (if (archive-leads-minus-p positive) :power :product))))))

(defun archive-spell-atom (e)
  (cond ((stringp e) (archive-spell-string e))
        ((eq e t) (archive-put "true"))
        ((eq e nil) (archive-put "false"))
        ((symbolp e) (archive-put (archive-symbol-name e)))
        (t (archive-unspellable "a Lisp object"))))

(defun archive-symbol-name (symbol)
  "The name of the Maxima SYMBOL, if the grammar has it."
  (let* ((lisp (symbol-name (or (get symbol 'reversealias) symbol)))
         (name (and (plusp (length lisp)) (char= (char lisp 0) #\$)
                    (maybe-invert-string-case (subseq lisp 1)))))
    (cond ((member symbol '($%pi $%e $%i)) name)
          ((and name (archive-name-p name)
                (not (member name '("true" "false") :test #'string=))
                (not (member name *archive-keywords* :test #'string=)))
           name)
          (t (archive-unspellable "the name ~a" (or name lisp))))))

(defun archive-spell-string (string)
  (archive-put "\"")
  (loop for c across string
        do (when (or (and (< (char-code c) 32) (char/= c #\Tab)) (= (char-code c) 127))
             (archive-unspellable "a string with line ends or control characters"))
           (when (find c "\\\"") (archive-put "\\"))
           (archive-put (string c)))
  (archive-put "\""))

(defun archive-terms-in-order (sum)
  "Terms in the order in which Maxima shows them, but for one without minus in front if there is
one."
  (let* ((terms (reverse (cdr sum))) (first (find-if-not #'archive-leads-minus-p terms)))
    (if (or (null first) (eq first (car terms)))
        terms
        (cons first (remove first terms :test #'eq :count 1)))))

(defun archive-spell-sum (e)
  (let ((terms (archive-terms-in-order e)))
    (archive-spell-at (car terms) (archive-level :product))
    (dolist (term (cdr terms))
      (cond ((archive-leads-minus-p term)
             (archive-put "-")
             (archive-spell-at (archive-without-minus term) (archive-level :product)))
            (t (archive-put "+")
               (archive-spell-at term (archive-level :product)))))))

(defun archive-spell-factors (factors)
  (archive-spell-at (car factors) (archive-level :sign))
  (dolist (factor (cdr factors))
    (archive-put "*")
    (archive-spell-at factor (archive-level :sign))))

(defun archive-spell-product (e)
  (multiple-value-bind (above below) (archive-fraction e)
    (archive-spell-factors (or above '(1)))
    (when below
      (archive-put "/")
      (if (cdr below)
          (archive-spelled-deeper
            (archive-put "(")
            (archive-spell-factors below)
            (archive-put ")"))
          (archive-spell-at (car below) (archive-level :sign))))))

(defun archive-spell-power (e)
  (destructuring-bind (base exponent) (cdr e)
    (cond ((archive-divisor-exponent-p e) (archive-spell-product e))
          ((eq base '$%e) (archive-spell-call "exp" (list exponent)))
          ((archive-root-p e) (archive-spell-call "sqrt" (list base)))
          (t (archive-spell-at base (archive-level :atom))
             (archive-put "^")
             (archive-spelled-deeper (archive-spell-at exponent (archive-level :sign)))))))

(defun archive-spell-relation (sign e)
  (archive-spell-at (cadr e) (archive-level :sum))
  (archive-put sign)
  (archive-spell-at (caddr e) (archive-level :sum)))

(defun archive-spell-joined (word parts level)
  (archive-spell-at (car parts) level)
  (dolist (part (cdr parts))
    (archive-put word)
    (archive-spell-at part level)))

(defun archive-spell-bracketed (open elements close)
  (archive-spelled-deeper
    (archive-put open)
    (loop for (element . more) on elements
          do (archive-spell-at element (archive-level :any))
             (when more (archive-put ", ")))
    (archive-put close)))

(defun archive-spell-call (name arguments)
  (archive-put name)
  (archive-spell-bracketed "(" arguments ")"))

(defun archive-spell-derivative (e)
  "q' for time derivatives of names, else diff(e, name) or diff(e, name, n), nested for several
names."
  (destructuring-bind (function &rest pairs) (cdr e)
    (let ((n (length pairs)))
      (cond ((null pairs) (archive-unspellable "a total differential"))
            ((oddp n) (archive-spell-derivative (list* (car e) function (append pairs '(1)))))
            (t (let ((variable (nth (- n 2) pairs)) (order (nth (- n 1) pairs)))
                 (unless (and (symbolp variable) (integerp order))
                   (archive-unspellable "this derivative: ~a" (core-words (list e))))
                 (cond ((> n 2)
                        (archive-spell-diff (list* (car e) function (subseq pairs 0 (- n 2)))
                                            variable order))
                       ((and (eq variable '$t) (<= order 3) (symbolp function))
                        (archive-put (archive-symbol-name function))
                        (archive-put (make-string order :initial-element #\')))
                       (t (archive-spell-diff function variable order)))))))))

(defun archive-spell-diff (e variable order)
  (archive-spell-call "diff" (if (eql order 1) (list e variable) (list e variable order))))

(defun archive-spell-function (e)
  (let ((operator (caar e)))
    (when (member 'array (cdar e))
      (archive-unspellable "the subscripted name ~a" (core-words (list e))))
    (archive-spell-call (or (cdr (assoc operator *archive-operator-names*))
                            (archive-function-name operator e))
                        (cdr e))))

(defun archive-function-name (operator e)
  "The name of an open function, verb or noun."
  (let* ((lisp (if (symbolp operator) (symbol-name operator) " "))
         (name (maybe-invert-string-case (subseq lisp 1))))
    (cond ((and (cdr e) (find (char lisp 0) "$%") (archive-name-p name)
                (not (member name *archive-keywords* :test #'string=))
                (not (archive-maxima-function-p name)))
           name)
          ((eq operator '$set) (archive-unspellable "a set; use [ ]"))
          (t (archive-unspellable "the expression ~a" (core-words (list e)))))))

(defun archive-spell (e)
  "The text of the Maxima expression E in the archive's grammar."
  (let ((*archive-spelled-depth* 0)
        (e (if (archive-contains-p e 'mrat) ($totaldisrep e) e)))
    (let ((*archive-out* '()))
      (archive-spell-at e (archive-level :any))
      (archive-joined (nreverse *archive-out*)))))

(defun archive-settled-text (e &key doubles)
  "The text of E that is spelled the same after it was read: Maxima may order the factors of a
product anew when it is read."
  (let ((*archive-bigfloats* doubles))
    (loop with text = (archive-spell e)
          repeat 5
          do (let ((again (archive-spell (archive-parse-value text :doubles doubles :relations t))))
               (when (string= again text) (return text))
               (setq text again))
          finally (return text))))
