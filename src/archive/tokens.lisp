;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; From characters to tokens of the archive's grammar, one at a time, each with its place;
;;; nothing is evaluated and the Lisp reader never sees the text. A text is a native string:
;;; Unicode characters on SBCL, the bytes of UTF-8 on GCL, so that what goes back to the
;;; terminal shows as it was typed. Numbers are exact (17.76 is 444/25) unless the reader wants
;;; doubles, or long decimals, bigfloats of as many digits as are written. Look first at
;;; archive-next-token!.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/suffixes" "core/bigfloats"))

(deftype archive-text-string ()
  #+sbcl '(simple-array character (*))
  #-sbcl 'simple-string)

(defvar *archive-digits* 10000 "The most digits that a number may have.")
(defvar *archive-decimal-exponent* 308 "The largest size of a decimal exponent.")

(defstruct (archive-stretch (:conc-name stretch-))
  "What is read of a text: from START to END (nil: the whole rest); its first character stands in
FILE (nil: it was typed) at LINE and COLUMN."
  (text "") (start 0) (end nil) (file nil) (line 1) (column 1))

(defstruct (archive-reader (:conc-name reader-))
  "A text from START to END whose first character stands in FILE at LINE and COLUMN, and the
token that the reader stands on."
  (text "") (position 0) (start 0) (end 0) (file nil) (line 1) (column 1) (doubles nil)
  ;; the token: kind, value, primes after a name, where it begins and ends
  (kind :end) (value nil) (primes 0) (from 0) (to 0)
  ;; what the parser keeps
  (depth 0) (calls '()))

(defun archive-simple-text (text)
  #+sbcl (coerce text '(simple-array character (*)))
  #-sbcl (coerce text 'simple-string))

(defun archive-open-text (text &key doubles)
  "A reader that stands on the first token of TEXT, a string or an archive-stretch of one."
  (let* ((stretch (if (stringp text) (make-archive-stretch :text text) text))
         (whole (stretch-text stretch))
         (start (stretch-start stretch))
         (reader (make-archive-reader
                  :text (archive-simple-text whole)
                  :position start :start start :from start :to start
                  :end (or (stretch-end stretch) (length whole))
                  :file (stretch-file stretch) :line (stretch-line stretch)
                  :column (stretch-column stretch) :doubles doubles)))
    (archive-next-token! reader)
    reader))

;; Places and faults

(defun archive-characters-between (text from to)
  "The number of characters a person sees in TEXT from FROM to TO."
  #+sbcl (declare (ignore text))
  #+sbcl (- to from)
  #-sbcl (count-if-not (lambda (c) (= 2 (ash (char-code c) -6))) text :start from :end to))

(defun archive-reader-place (reader position)
  "Two values: line and column of POSITION."
  (let* ((text (reader-text reader))
         (start (reader-start reader))
         (newline (position #\Newline text :start start :end position :from-end t)))
    (if newline
        (values (+ (reader-line reader) (count #\Newline text :start start :end position))
                (1+ (archive-characters-between text (1+ newline) position)))
        (values (reader-line reader)
                (+ (reader-column reader) (archive-characters-between text start position))))))

(defun archive-fault-at (file line column control &rest arguments)
  "An error at a place of a file, or of an answer where FILE is nil."
  (let ((what (apply #'format nil control arguments)))
    (if file
        (core-error "~a:~d:~d: ~a" file line column what)
        (core-error "~@[line ~d, ~]column ~d: ~a" (and (> line 1) line) column what))))

(defun archive-fault (reader position control &rest arguments)
  "An error at POSITION of what READER reads."
  (multiple-value-bind (line column) (archive-reader-place reader position)
    (apply #'archive-fault-at (reader-file reader) line column control arguments)))

(defun archive-shown (text)
  "TEXT as a message may show it: short, and without control characters."
  (let ((clean (substitute-if #\? (lambda (c) (< (char-code c) 32)) text)))
    (if (> (length clean) 40) (concatenate 'string (subseq clean 0 37) "...") clean)))

(defun archive-token-shown (reader)
  "The token that READER stands on, for a message."
  (case (reader-kind reader)
    (:end "the end of the value")
    (:string "a string")
    (t (format nil "`~a'"
               (archive-shown (subseq (reader-text reader) (reader-from reader)
                                      (reader-to reader)))))))

;; Characters

(declaim (inline archive-letter-p archive-digit-p archive-word-p))

(defun archive-letter-p (c) (or (char<= #\a c #\z) (char<= #\A c #\Z)))

(defun archive-digit-p (c) (char<= #\0 c #\9))

(defun archive-word-p (c) (or (archive-letter-p c) (archive-digit-p c) (char= c #\_)))

(defun archive-name-p (text)
  "True when TEXT is a name."
  (and (plusp (length text)) (archive-letter-p (char text 0)) (every #'archive-word-p text)))

(defun archive-skip-blanks (text position end)
  "Where the next token of TEXT begins: blanks, line ends and comments are passed over."
  (declare (type archive-text-string text) (type fixnum position end))
  (loop while (< position end)
        do (let ((c (schar text position)))
             (cond ((or (char= c #\Space) (char= c #\Tab) (char= c #\Newline) (char= c #\Return))
                    (incf position))
                   ((char= c #\#)
                    (setq position (or (position #\Newline text :start position :end end) end)))
                   (t (return)))))
  position)

(defun archive-word-end (text position end)
  (declare (type archive-text-string text) (type fixnum position end))
  (loop while (and (< position end) (archive-word-p (schar text position))) do (incf position))
  position)

(defun archive-digits-end (text position end)
  (declare (type archive-text-string text) (type fixnum position end))
  (loop while (and (< position end) (archive-digit-p (schar text position))) do (incf position))
  position)

;; Numbers

(defun archive-nearest-double (number)
  "The double nearest to the rational NUMBER (ties to even), or nil when it is too large."
  (if (minusp number)
      (let ((double (archive-nearest-double (- number)))) (and double (- double)))
      (let* ((size (- (integer-length (numerator number)) (integer-length (denominator number))))
             (scale (max (- size 53) -1074))
             (mantissa (round (/ number (expt 2 scale)))))
        ;; the mantissa has 53 bits, or 54 when the estimate of the size was one too small
        (when (> (integer-length mantissa) 53)
          (incf scale)
          (setq mantissa (round (/ number (expt 2 scale)))))
        (cond ((zerop mantissa) 0d0)
              ((> (+ scale (integer-length mantissa)) 1024) nil)
              (t (scale-float (coerce mantissa 'double-float) scale))))))

(defun archive-maxima-number (number)
  "NUMBER, an integer or a ratio, as Maxima holds it."
  (if (integerp number) number (list '(rat simp) (numerator number) (denominator number))))

(defun archive-decimal (reader digits places exponent)
  "The number DIGITS/10^PLACES*10^EXPONENT; DIGITS is an integer."
  (let ((number (* digits (expt 10 (- exponent places)))))
    (if (reader-doubles reader)
        (or (archive-nearest-double number)
            (archive-fault reader (reader-from reader) "the number is too large for a double"))
        (archive-maxima-number number))))

(defun archive-read-exponent (reader position)
  "Three values: the decimal exponent that begins at POSITION (0 if there is none), where it ends,
and whether it is one of a long decimal, 1.50b0, which tables of numerical results may hold."
  (let* ((text (reader-text reader)) (end (reader-end reader))
         (long (and (reader-doubles reader) (< position end) (char= (char text position) #\b))))
    (if (not (or long (and (< position end) (char-equal (char text position) #\e))))
        (values 0 position nil)
        (let* ((sign (and (< (1+ position) end) (find (char text (1+ position)) "+-")))
               (from (+ position (if sign 2 1)))
               (to (archive-digits-end text from end)))
          (when (= from to)
            (archive-fault reader position
                           "`~a' after a number: the digits of an exponent are missing; write * ~
                            for a product"
                           (char text position)))
          (let ((size (if (> (- to from) 9) most-positive-fixnum
                          (parse-integer text :start from :end to))))
            (when (> size (if long *archive-digits* *archive-decimal-exponent*))
              (archive-fault reader position "the exponent is larger than ~d"
                             (if long *archive-digits* *archive-decimal-exponent*)))
            (values (if (eql sign #\-) (- size) size) to long))))))

(defun archive-read-number! (reader)
  "Takes the integer or decimal at the reader's position."
  (let* ((text (reader-text reader)) (end (reader-end reader)) (from (reader-position reader))
         (whole (archive-digits-end text from end))
         (point (and (< whole end) (char= (char text whole) #\.)))
         (to (if point (archive-digits-end text (1+ whole) end) whole)))
    (when (and point (= to (1+ whole)))
      (archive-fault reader whole "found a point, expected digits after it"))
    (when (> (- to from) *archive-digits*)
      (archive-fault reader from "a number of ~d digits; at most ~d are read" (- to from)
                     *archive-digits*))
    (multiple-value-bind (exponent after long) (archive-read-exponent reader to)
      (let ((digits (remove #\. (subseq text from to))) (places (if point (- to whole 1) 0)))
        (setf (reader-value reader)
              (cond (long (core-bigfloat (* (parse-integer digits) (expt 10 (- exponent places)))
                                         (length digits)))
                    ((and (not point) (= after to)) (parse-integer digits))
                    (t (archive-decimal reader (parse-integer digits) places exponent)))))
      (when (and (< after end) (let ((c (char text after))) (or (archive-word-p c) (char= c #\.))))
        (archive-fault reader after
                       "found `~a' directly after a number, expected an operator; write * for a ~
                        product~@[; ~a~]"
                       (archive-shown (string (char text after)))
                       (archive-suffix-advice (subseq text from after)
                                              (subseq text after (archive-word-end text after end))
                                              (reader-value reader))))
      (archive-token! reader :number after))))

;; Strings and names

(defun archive-read-string! (reader)
  "Takes the string at the reader's position; inside it \\\" is a quotation mark and \\\\ a
backslash."
  (let* ((text (reader-text reader)) (end (reader-end reader)) (from (reader-position reader))
         (at (1+ from)))
    (setf (reader-value reader)
          (with-output-to-string (out)
            (loop
              (when (or (>= at end) (find (char text at) '(#\Newline #\Return)))
                (archive-fault reader from
                               "a string without its closing quotation mark on the same line"))
              (let ((c (char text at)))
                (incf at)
                (case c
                  (#\" (return))
                  (#\\ (unless (and (< at end) (find (char text at) "\\\""))
                         (archive-fault reader (1- at)
                                        "found a backslash in a string, expected \\\" or \\\\"))
                   (write-char (char text at) out)
                   (incf at))
                  (t (write-char c out)))))))
    (archive-token! reader :string at)))

(defun archive-primes-end (text position end)
  (declare (type archive-text-string text) (type fixnum position end))
  (loop while (and (< position end) (char= (schar text position) #\')) do (incf position))
  position)

(defun archive-read-name! (reader)
  "Takes the name at the reader's position with the primes that stand directly after it."
  (let* ((text (reader-text reader)) (end (reader-end reader)) (from (reader-position reader))
         (to (archive-word-end text from end))
         (after (archive-primes-end text to end)))
    (setf (reader-value reader) (subseq text from to))
    (archive-token! reader :name to)
    (setf (reader-primes reader) (- after to)
          (reader-to reader) after
          (reader-position reader) after)))

(defun archive-read-constant! (reader)
  "Takes %pi, %e or %i."
  (let* ((text (reader-text reader)) (from (reader-position reader))
         (to (archive-word-end text (1+ from) (reader-end reader)))
         (name (subseq text from to)))
    (unless (member name '("%pi" "%e" "%i") :test #'string=)
      (archive-fault reader from "found `~a'; of the names with % only %pi, %e and %i are known"
                     (archive-shown name)))
    (setf (reader-value reader) name)
    (archive-token! reader :constant to)))

;; Tokens

(defun archive-token! (reader kind to)
  "The reader's token is of KIND and ends at TO."
  (setf (reader-kind reader) kind
        (reader-from reader) (reader-position reader)
        (reader-to reader) to
        (reader-primes reader) 0
        (reader-position reader) to)
  kind)

(defparameter *archive-signs*
  '((#\< . :less) (#\> . :greater) (#\= . :equal) (#\+ . :plus) (#\- . :minus) (#\* . :times)
    (#\/ . :over) (#\^ . :power) (#\' . :quote) (#\( . :open) (#\) . :close) (#\[ . :open-list)
    (#\] . :close-list) (#\{ . :open-brace) (#\} . :close-brace) (#\, . :comma) (#\: . :colon))
  "Signs of one character.")

(defun archive-long-sign (first second)
  "The kind of the sign of two characters FIRST and SECOND, or nil."
  (cond ((char= second #\=) (case first (#\< :less-or-equal) (#\> :greater-or-equal)))
        ((char= second #\>) (and (char= first #\-) :arrow))))

(defun archive-sign-advice (c)
  "What to write instead of a character that the grammar does not know."
  (case c
    ((#\; #\$) "an entry ends where its line ends")
    (#\! "there is no factorial")
    (#\? "Lisp is not read")
    (#\@ "a name has letters, digits and _ only")
    (#\. "a decimal has a digit before and after its point")
    (#\\ "a backslash stands in strings only")
    (t "a name has the letters a to z, A to Z, digits and _ only")))

(defun archive-read-sign! (reader)
  (let* ((text (reader-text reader)) (from (reader-position reader)) (end (reader-end reader))
         (first (char text from))
         (long (and (< (1+ from) end) (archive-long-sign first (char text (1+ from)))))
         (kind (or long (cdr (assoc first *archive-signs*)))))
    (unless kind
      (archive-fault reader from "found `~a', expected a value: ~a"
                     (archive-character-shown text from end) (archive-sign-advice first)))
    (archive-token! reader kind (+ from (if long 2 1)))))

(defun archive-character-shown (text position end)
  "The character at POSITION, whole where characters are bytes."
  (let ((to (1+ position)))
    #-sbcl
    (when (>= (char-code (char text position)) 128)
      (loop while (and (< to end) (= 2 (ash (char-code (char text to)) -6))) do (incf to)))
    (archive-shown (subseq text position (min to end)))))

(defun archive-next-token! (reader)
  "Moves READER to the next token and returns its kind."
  (let* ((text (reader-text reader)) (end (reader-end reader))
         (from (archive-skip-blanks text (reader-position reader) end)))
    (declare (type archive-text-string text) (type fixnum from end))
    (setf (reader-position reader) from)
    (if (= from end)
        (archive-token! reader :end end)
        (let ((c (schar text from)))
          (cond ((archive-letter-p c) (archive-read-name! reader))
                ((archive-digit-p c) (archive-read-number! reader))
                ((and (char= c #\.) (< (1+ from) end) (archive-digit-p (schar text (1+ from))))
                 (archive-read-number! reader))
                ((char= c #\") (archive-read-string! reader))
                ((char= c #\%) (archive-read-constant! reader))
                (t (archive-read-sign! reader)))
          (reader-kind reader)))))
