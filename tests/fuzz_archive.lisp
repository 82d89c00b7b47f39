;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Laws of the archive's reader and speller on random input, the same at every run: expressions
;;; that Maxima has simplified are read back as they were spelled; archives with random damage
;;; end in a value or in one message with its place, in time, and never in a Lisp error. Called
;;; by tests/rtest_archive_*.mac and, with more cases, by tools/fuzz. Look first at fuzz-read.

(in-package :maxima)

(core-require "archive/bytes" "archive/speller" "archive/sections")

(defvar *fuzz-state* 1 "State of the generator of random numbers.")
(defvar *fuzz-seconds* 5 "The time that one case may take.")

(defun fuzz-random (n)
  "A random integer from 0 below N: a linear congruence modulo 2^48, its upper bits."
  (setq *fuzz-state* (logand (+ (* *fuzz-state* 25214903917) 11) #xffffffffffff))
  (mod (ash *fuzz-state* -17) n))

(defun fuzz-choice (list) (nth (fuzz-random (length list)) list))

;; Random expressions, simplified by Maxima

(defun fuzz-integer ()
  (case (fuzz-random 6)
    (0 (- (fuzz-random 1000000) 500000))
    (t (- (fuzz-random 20) 8))))

(defun fuzz-number ()
  (if (zerop (fuzz-random 3))
      (let ((q (/ (fuzz-integer) (1+ (fuzz-random 30))))) (archive-maxima-number q))
      (fuzz-integer)))

(defun fuzz-name ()
  (getalias (fuzz-choice '($x $y $z $theta |$l1| $lambda $gamma $beta |$m| $m $e $i |$e| $psi $%pi
                              $%e $x_1 $q2 |$Lagrange| $t))))

(defun fuzz-atom ()
  (case (fuzz-random 8)
    ((0 1) (fuzz-number))
    (2 (list '(%derivative simp) (fuzz-choice '($phi $theta $q)) '$t (1+ (fuzz-random 4))))
    (t (fuzz-name))))

(defun fuzz-list (n depth) (loop repeat n collect (fuzz-expression depth)))

(defun fuzz-form (depth)
  "An expression, not simplified."
  (case (fuzz-random 12)
    ((0 1 2) (list* '(mplus) (fuzz-list (+ 2 (fuzz-random 4)) depth)))
    ((3 4 5) (list* '(mtimes) (fuzz-list (+ 2 (fuzz-random 3)) depth)))
    (6 (list '(mexpt) (fuzz-base depth)
             (fuzz-choice '(2 3 -1 -2 ((rat simp) 1 2) ((rat simp) -1 2) ((rat simp) 2 3)))))
    (7 (let ((exponent (fuzz-expression depth)))
         (list '(mexpt) (fuzz-choice (list '$x '$%e 2 (fuzz-base depth)))
               (if (fuzz-large-numbers-p exponent 1) (fuzz-name) exponent))))
    (8 (list (list (fuzz-choice '(%sin %cos %tan %cot %sec %csc %asin %acos %atan %sinh %cosh %tanh
                                       %log)))
             (fuzz-expression depth)))
    (9 (list (list (fuzz-choice '($f $g1 |$v| |$l|))) (fuzz-expression depth)))
    (10 (list '(%derivative) (list '($f) (fuzz-expression depth) '$x) (fuzz-choice '($x $y))
              (1+ (fuzz-random 3))))
    (11 (list (fuzz-choice '((mabs) (%signum))) (fuzz-expression depth)))))

(defun fuzz-base (depth)
  "An expression whose powers Maxima finds soon."
  (let ((e (fuzz-expression depth)))
    (if (fuzz-large-numbers-p e 3) (fuzz-name) e)))

(defun fuzz-expression (depth)
  "A random expression as Maxima simplifies it; an atom where it finds no value or a large one."
  (if (or (<= depth 0) (zerop (fuzz-random 5)))
      (fuzz-atom)
      (let ((value (core-attempt (lambda () (simplifya (fuzz-form (1- depth)) nil)))))
        (if (and value (fuzz-fit-p (car value))) (car value) (fuzz-atom)))))

(defun fuzz-fit-p (e)
  "True when E is of moderate size and has only functions that an archive knows."
  (and (<= (fuzz-nodes e) 300)
       (not (fuzz-large-numbers-p e 60))
       (notany (lambda (f) (archive-contains-p e f)) '(%atanh %asinh %acosh %coth %sech %csch))))

(defun fuzz-large-numbers-p (e digits)
  (if (atom e) (> (archive-digits e) digits)
      (some (lambda (part) (fuzz-large-numbers-p part digits)) (cdr e))))

(defun fuzz-nodes (e) (if (atom e) 1 (reduce #'+ (mapcar #'fuzz-nodes (cdr e)) :initial-value 1)))

(defun fuzz-settled (e)
  "E once Maxima's simplifier has come to rest on it, whose answers it does not always simplify
further; 0 if it does not."
  (loop repeat 5
        do (let ((again (core-attempt (lambda () (simplifya (fuzz-without-flags e) nil)))))
             (cond ((null again) (return 0))
                   ((alike1 e (car again)) (return e)))
             (setq e (car again)))
        finally (return 0)))

(defun fuzz-without-flags (e)
  (if (atom e) e (cons (list (caar e)) (mapcar #'fuzz-without-flags (cdr e)))))

(defun fuzz-double ()
  "A random double: any of them, small integers, powers of ten."
  (case (fuzz-random 4)
    (0 (* (fuzz-choice '(1d0 -1d0))
          (fuzz-scaled (+ (ash 1 52) (fuzz-random (ash 1 31)) (ash (fuzz-random (ash 1 21)) 31))
                                                 (- (fuzz-random 2040) 1074))))
    (1 (coerce (fuzz-integer) 'double-float))
    (2 (fuzz-scaled (1+ (fuzz-random 1000)) -1074))
    (t (archive-nearest-double (* (1+ (fuzz-random 9999)) (expt 10 (- (fuzz-random 600) 310)))))))

(defun fuzz-scaled (mantissa exponent)
  (or (archive-nearest-double (* mantissa (expt 2 exponent))) 1d0))

(defun fuzz-value (depth)
  "A random value of an entry: an expression, a list of them, equations, a matrix."
  (case (fuzz-random 6)
    (0 (archive-inert 'mlist (loop repeat (fuzz-random 5)
                                   collect (archive-inert (fuzz-choice '(mequal mlessp mgeqp mleqp
                                                                                mgreaterp))
                                                          (fuzz-list 2 depth)))))
    (1 (archive-inert 'mlist (list "a \"string\" \\ and blanks" t nil (fuzz-expression depth))))
    (2 (archive-inert '$matrix (loop repeat 2 collect (archive-inert 'mlist (fuzz-list 3 depth)))))
    (t (fuzz-expression depth))))

(defun fuzz-sorted (e)
  "E with the terms of its sums and the factors of its products in one order, as text: Maxima's own
order is not always one, that of 2^x*y*f(z) depends on which factor came first."
  (if (atom e)
      (prin1-to-string e)
      (let ((parts (mapcar #'fuzz-sorted (cdr e))))
        (format nil "(~a~{ ~a~})" (caar e)
                (if (member (caar e) '(mplus mtimes)) (sort parts #'string<) parts)))))

(defun fuzz-same-p (e other)
  (or (alike1 e other) (string= (fuzz-sorted e) (fuzz-sorted other))))

(defun fuzz-reads-back-p (e)
  "The laws: E is read back as it was spelled, and its settled text is spelled the same when it
was read."
  (let ((text (archive-settled-text e)))
    (and (fuzz-same-p e (archive-parse-value (archive-spell e) :relations t))
         (string= text (archive-spell (archive-parse-value text :relations t))))))

(defun fuzz-first-failure (count seed law)
  "[] if LAW returns nil for COUNT random cases, else a list of the case, the generator's state
and what it returned."
  (let ((*fuzz-state* seed))
    (loop for case from 1 to count
          do (let* ((state *fuzz-state*) (failure (funcall law)))
               (when failure
                 (return (list '(mlist simp) case state failure))))
          finally (return (list '(mlist simp))))))

(defun fuzz-in-time (function)
  "Two values: what FUNCTION returns, and nil or the message of the error that ended it, or that
it took too long."
  (let ((start (get-internal-run-time)))
    (multiple-value-bind (value trouble) (core-caught function)
      (let ((seconds (/ (- (get-internal-run-time) start) internal-time-units-per-second)))
        (values value
                (if (> seconds *fuzz-seconds*)
                    (format nil "took ~,1f seconds~@[; ~a~]" (float seconds) trouble) trouble))))))

(defun fuzz-foreign-p (e)
  "Whether Maxima's simplifier put a function into E that the grammar does not have."
  (and (consp e)
       (or (member (caar e) '(%imagpart %realpart $imagpart $realpart)) (some #'fuzz-foreign-p (cdr e)))))

(defun fuzz-refusal (e)
  "nil if the writer refuses E in plain words, else what happened instead."
  (let ((trouble (nth-value 1 (core-caught (lambda () (archive-spell e))))))
    (unless (and trouble (search "an archive cannot hold" trouble))
      (format nil "not refused: ~a" (core-words (list e))))))

(defun fuzz-reading-back (e)
  "nil if E is read back as it was spelled, else what happened instead."
  (multiple-value-bind (same trouble) (fuzz-in-time (lambda () (fuzz-reads-back-p e)))
    (cond (trouble (format nil "~a: ~a" trouble (core-words (list e))))
          ((not same) (archive-spell e)))))

(defun $fuzz_expressions (count seed)
  "[] if COUNT random values are read back as they were spelled, or refused where the grammar has
no word for them; else the first for which neither holds."
  (fuzz-first-failure
   count seed
   (lambda ()
     (let ((e (fuzz-settled (fuzz-value (1+ (fuzz-random 5))))))
       (if (fuzz-foreign-p e) (fuzz-refusal e) (fuzz-reading-back e))))))

(defun $fuzz_doubles (count seed)
  "[] if COUNT random doubles are read back bit for bit."
  (fuzz-first-failure
   count seed
   (lambda ()
     (let ((x (fuzz-double)))
       (unless (eql x (archive-parse-value (archive-spell x) :doubles t)) (format nil "~s" x))))))

;; Damaged archives

(defparameter *fuzz-fragments*
  '("''(system(\"id\"))" "?lisp(1)" ":lisp (quit)" "1b9999999" "2^10^10" "(10^9)!" "1e400" "9^9^9"
    "[" "]" "(" ")" "{" "}" "'" "\"" "\\" "#"
    ";" "$" "=" "<" "-" "->" ":" "^" "^-" "/0" "0^0" "log(0)" "sqrt(" "1/(x-x)" "%pi" "%i" "%e^"
"inf" "true" "and" "or" "not " "diff(" "at("
    "piecewise(" "matrix([1],[1,2])" "diag(" "max()" "abs(-1)" "atan2(0,0)" "2^x+2^(x+30000)"
"sqrt(10^300+1)" "exp(10^9*log(2))" "x^(1/3)"
    "integrate(f(x),x)" "[system]" "[body 1]" "[result Lagrangian]" "kind = circuit" "1.5e-300"
".5" "5." "theta''" "do" "lambda" "((((((((("
    "-----------" "x'" "1 -> 2 R R" "load: 1 -> 2 L 3")
  "What is put into archives.")

(defun fuzz-bytes (text) (map 'list #'char-code text))

(defun fuzz-damage (bytes)
  "BYTES, a list, with one random change."
  (let* ((n (length bytes)) (from (fuzz-random (1+ n))) (to (min n (+ from (fuzz-random 12)))))
    (case (fuzz-random 7)
      (0 (append (subseq bytes 0 from) (nthcdr to bytes)))
      (1 (append (subseq bytes 0 to) (nthcdr from bytes)))
      (2 (append (subseq bytes 0 from) (list (fuzz-random 256)) (nthcdr from bytes)))
      (3 (append (subseq bytes 0 from) (list (fuzz-random 256)) (nthcdr (min n (1+ from)) bytes)))
      (4 (append (subseq bytes 0 from) (list (fuzz-choice '(10 13 9 32 35 39 91 93 40 41)))
                 (nthcdr from bytes)))
      (t (append (subseq bytes 0 from) (fuzz-bytes (fuzz-choice *fuzz-fragments*))
                 (nthcdr from bytes))))))

(defun fuzz-read (bytes)
  "Reads BYTES as an archive and reads back what its values are spelled as; nil, or what is wrong."
  (multiple-value-bind (difference text) (fuzz-in-time (lambda () (fuzz-read-back bytes)))
    (cond ((null text) difference)
          ((or (search "failed inside" text) (search "memory is exhausted" text)
               (search "took " text)) text)
          ((not (fuzz-placed-p text)) (format nil "no place: ~a" text)))))

(defun fuzz-placed-p (text)
  "True when TEXT begins with fuzz.txt:line:column:"
  (and (eql (search "fuzz.txt:" text) 0) (>= (count #\: text) 3)))

(defun fuzz-read-back (bytes)
  (let ((sheet (archive-split (archive-text-of-bytes (coerce bytes 'archive-bytes) "fuzz.txt")
                              "fuzz.txt")))
    (dolist (section (sheet-sections sheet))
      (dolist (entry (section-entries section))
        (let ((value (archive-entry-parsed entry :relations t)))
          (unless (fuzz-same-p value (fuzz-again value))
            (return-from fuzz-read-back
                         (format nil "not read back: ~a" (archive-spell value)))))))))

(defun fuzz-again (value)
  "VALUE spelled and read; what is too large to be written counts as read back."
  (let ((text (core-attempt (lambda () (archive-spell value)))))
    (if text (archive-parse-value (fuzz-stretch (car text)) :relations t) value)))

(defun fuzz-stretch (text) (make-archive-stretch :text text :file "fuzz.txt"))

(defun fuzz-examples ()
  "The bytes of the example archives, lists."
  (mapcar (lambda (path) (coerce (archive-file-bytes (namestring path)) 'list))
          (directory (concatenate 'string *core-root* "examples/*.txt"))))

(defun $fuzz_damage (count seed)
  "[] if COUNT archives with random damage are each read or refused with a place, in time; else
the first that is not."
  (let ((examples (fuzz-examples)))
    (fuzz-first-failure
     count seed
     (lambda ()
       (let ((bytes (fuzz-choice examples)))
         (loop repeat (1+ (fuzz-random 3)) do (setq bytes (fuzz-damage bytes)))
         (fuzz-read bytes))))))

(defun $fuzz_truncations (name)
  "[] if the file NAME cut after each of its bytes is read or refused with a place, else the
first cut that is not."
  (let ((bytes (coerce (archive-file-bytes name) 'list)))
    (loop for n from 0 to (length bytes)
          do (let ((failure (fuzz-read (subseq bytes 0 n))))
               (when failure (return (list '(mlist simp) n failure))))
          finally (return (list '(mlist simp))))))

;; For tests of single values and texts

(defun $grammar_value (text)
  "The value that TEXT spells, or the message that it gets."
  (multiple-value-bind (value trouble)
    (core-caught (lambda () (list (archive-parse-value text :relations t))))
    (or trouble (car value))))

(defun $grammar_double (text)
  "The same, decimals being doubles."
  (multiple-value-bind (value trouble)
    (core-caught (lambda () (list (archive-parse-value text :doubles t))))
    (or trouble (car value))))

(defun $grammar_text (e)
  "The text of E, or the message that it gets."
  (multiple-value-bind (text trouble) (core-caught (lambda () (archive-spell e)))
    (or trouble text)))

(defun $grammar_spelled (text)
  "TEXT as the speller writes what it means, or the message that it gets."
  (multiple-value-bind (again trouble)
      (core-caught (lambda () (archive-spell (archive-parse-value text))))
    (or trouble again)))

(defun $grammar_repeated (text count)
  "TEXT, COUNT times."
  (with-output-to-string (out) (loop repeat count do (write-string text out))))

(defun $grammar_kind (text)
  "`read', or `refused' with a place, and in time; else what went wrong."
  (let ((trouble (nth-value 1
                            (fuzz-in-time (lambda ()
                                            (archive-parse-value (fuzz-stretch text)
                                                                 :relations t))))))
    (cond ((null trouble) '$read)
          ((or (search "failed inside" trouble) (not (fuzz-placed-p trouble))) trouble)
          (t '$refused))))

(defun grammar-entry (entry)
  (archive-inert 'mlist
                 (list (or (entry-key entry) '$row) (entry-line entry)
                       (archive-entry-parsed entry :relations t))))

(defun $grammar_archive (text)
  "The sections of TEXT, each a list of its name and of [key, line, value], or the message that
it gets."
  (multiple-value-bind (sheet trouble) (core-caught (lambda () (archive-split text "a.txt")))
    (or trouble
        (archive-inert 'mlist
                       (loop for section in (sheet-sections sheet)
                             when (section-entries section)
                               collect (archive-inert 'mlist (cons (section-name section)
                                                                   (mapcar #'grammar-entry
                                                                           (section-entries section)))))))))

(defun $grammar_ranges (text)
  "The text of each section from its header to its last entry."
  (let ((sheet (archive-split text "a.txt" :parse nil)))
    (archive-inert 'mlist
                   (loop for section in (sheet-sections sheet)
                         collect (subseq text (section-start section) (section-end section))))))

(defun $grammar_bytes (list)
  "The sections of the text whose bytes are LIST, or the message that it gets."
  (multiple-value-bind (text trouble)
      (core-caught (lambda () (archive-text-of-bytes (coerce (cdr list) 'archive-bytes) "a.txt")))
    (or trouble ($grammar_archive text))))

(defun $grammar_file (name)
  "The number of characters of the file NAME, or the message that it gets."
  (multiple-value-bind (text trouble) (core-caught (lambda () (archive-read-file name)))
    (or trouble (length text))))

(defun $grammar_write (name list)
  "Writes the bytes LIST into the file NAME."
  (with-open-file
    (out name :direction :output :if-exists :supersede :element-type '(unsigned-byte 8))
    (dolist (byte (cdr list) '$done) (write-byte byte out))))
