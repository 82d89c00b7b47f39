;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The dialog: asks for the keys of an archive in the order of the table of keys, the system
;;; first, then section by section. Every answer goes through the parser and the checks that read
;;; archives. `?' explains, Enter takes the default, `.' takes the defaults of the rest of a
;;; section. At the end: the echo, changes, the file. End of input leaves nothing behind.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/keys" "archive/check" "archive/store"))

(defvar *archive-asked* '() "The questions asked in this dialog.")
(defvar *archive-fresh-input* nil
  "True until the first line is read: what is left of the line that called us is passed over.")

(defstruct archive-item section key text)

;;; Asking a line, as Maxima itself asks

(defun archive-input-stream ()
  #+sbcl *standard-input*
  #-sbcl *query-io*)

(defun archive-prompt (question)
  "QUESTION as Maxima's own read() prints it, so that a worksheet shows it as a prompt."
  (format-prompt nil "~a"
                 (string-right-trim '(#\Newline #\Space)
                                    (with-output-to-string (*standard-output*)
                                      (mfuncall '$print question)))))

(defun archive-numbered-question (question)
  "QUESTION, numbered when it is asked again: worksheets fill in the old answer to a question of
the same text."
  (push question *archive-asked*)
  (let ((times (count question *archive-asked* :test #'string=)))
    (if (= times 1) question (format nil "(~d) ~a" times question))))

(defun archive-ask-line (question)
  "The person's answer to QUESTION, without blanks around it and without a closing semicolon."
  (fresh-line)
  (write-string (archive-prompt (archive-numbered-question question)))
  (terpri)
  (finish-output)
  (let ((line (archive-read-line)))
    (when (null line)
      (core-error "the input ended before the description was complete; nothing was written"))
    (archive-trimmed-answer line)))

(defun archive-filled (text)
  "TEXT on lines of less than 79 letters, broken at blanks; the lines it has already stay."
  (with-output-to-string (out)
    (let ((column 0))
      (loop for start = 0 then (1+ end)
            for end = (position-if (lambda (c) (member c '(#\Space #\Newline))) text :start start)
            for word = (subseq text start end)
            for newline = (and (> start 0) (char= (char text (1- start)) #\Newline))
            do (cond ((= start 0))
                     (newline (terpri out) (setq column 0))
                     ((> (+ column 1 (length word)) 78) (format out "~%    ") (setq column 4))
                     (t (write-char #\Space out) (incf column)))
               (write-string word out)
               (incf column (length word))
            while end))))

(defun archive-say (control &rest arguments)
  (core-say (archive-filled (apply #'format nil control arguments))))

(defun archive-read-line ()
  (let ((line (core-waiting (lambda () (read-line (archive-input-stream) nil nil)))))
    (if (and *archive-fresh-input* line (string= "" (string-trim '(#\Space #\Tab #\Return) line)))
        (progn (setq *archive-fresh-input* nil) (archive-read-line))
        (progn (setq *archive-fresh-input* nil) line))))

(defun archive-trimmed-answer (line)
  (let ((answer (string-trim '(#\Space #\Tab #\Return #\Newline) line)))
    (if (and (plusp (length answer)) (char= (char answer (1- (length answer))) #\;))
        (string-right-trim '(#\Space #\Tab) (subseq answer 0 (1- (length answer))))
        answer)))

(defun archive-yes-p (question)
  (let ((answer (string-downcase (archive-ask-line question))))
    (member answer '("y" "yes") :test #'string=)))

;;; One key

(defun archive-question-text (key section required)
  (format nil "~@[~a: ~]~a~a" (and (string/= section "top") section) (archive-key-question key)
          (cond (required " (needed; ? explains)")
                ((archive-default key) (format nil " [~a]" (archive-default key)))
                (t " [Enter: none]"))))

(defun archive-explain (key)
  (archive-say "  ~a: ~a. Type ~a.~@[ Enter takes ~a.~]" (archive-key-name key)
               (archive-key-help key) (archive-type-phrase (archive-key-type key))
               (archive-default key)))

(defun archive-quoted-text (text)
  "TEXT as a string of the archive, if it is not one yet."
  (if (char= (char text 0) #\") text (format nil "\"~a\"" (substitute #\' #\" text))))

(defun archive-answer-for-archive (key answer)
  (if (and (eq (archive-key-type key) :text) (plusp (length answer)))
      (archive-quoted-text answer)
      answer))

(defun archive-ask-key (key section required)
  "The text of the value of KEY; nil for its default, :rest where the person takes all defaults
that follow."
  (loop
    (let* ((answer (archive-ask-line (archive-question-text key section required)))
           (text (archive-answer-for-archive key answer)))
      (cond ((string= answer "?") (archive-explain key))
            ((and (string= answer ".") (not required)) (return :rest))
            ((and (member answer '("" ".") :test #'string=) required)
             (archive-say "  ~a is needed: ~a." (archive-key-name key)
                          (archive-type-phrase (archive-key-type key))))
            ((string= answer "") (return nil))
            (t (let ((trouble (archive-value-trouble key text)))
                 (if trouble (archive-say "  ~a" trouble) (return text))))))))

;;; Sections

(defun archive-answered (answers section name)
  "The text given for the key NAME of SECTION, or nil."
  (let ((answer (find-if (lambda (a) (and (string= section (archive-item-section a))
                                          (string= name (archive-key-name (archive-item-key a)))))
                         answers)))
    (and answer (archive-item-text answer))))

(defun archive-key-needed (key answers section)
  "Three-valued: :needed, :open, or nil where the key has no place beside the answers so far."
  (let ((default (archive-key-default key)))
    (cond ((eq default :required) :needed)
          ((atom default) :open)
          ((eq (first default) :when)
           (and (equal (archive-answered answers section (second default)) (third default))
                :needed))
          ((eq (first default) :with)
           (and (archive-answered answers section (second default)) :open))
          ((archive-answered answers section (second default)) (and (third default) :open))
          (t :needed))))

(defun archive-ask-section (kind word section)
  "Answers to the keys of one SECTION, in their order."
  (let ((answers '()) (rest nil))
    (dolist (key (archive-keys kind word) (nreverse answers))
      (let ((need (archive-key-needed key answers section)))
        (when (and need (or (eq need :needed) (not rest)))
          (let ((text (archive-ask-key key section (eq need :needed))))
            (cond ((eq text :rest) (setq rest t))
                  (text
                   (push (make-archive-item :section section :key key :text text) answers)))))))))

(defun archive-ask-count (row)
  "How many sections of the sort ROW there are."
  (loop
    (let ((answer (archive-ask-line (format nil "Number of sections [~a k], ~a [0]"
                                            (first row) (fourth row)))))
      (cond ((string= answer "") (return 0))
            ((and (every #'digit-char-p answer) (< (length answer) 4))
             (return (parse-integer answer)))
            (t (archive-say "  [~a k]: ~a. Type how many there are, such as 1; Enter takes 0."
                            (first row) (fourth row)))))))

(defun archive-ask-names (row)
  "Names of the sections of the sort ROW, one after another, until an empty answer."
  (let ((names '()))
    (loop
      (let ((name (archive-ask-line (format nil "Name of a [~a], ~a [Enter: no more]"
                                            (first row) (fourth row)))))
        (cond ((string= name "") (return (nreverse names)))
              ((member name names :test #'string=)
               (archive-say "  There is a [~a ~a] already." (first row) name))
              ((archive-plain-name-p name) (push name names))
              (t (archive-say "  [~a]: ~a. Type a name, such as ~a1; Enter ends."
                              (first row) (fourth row) (first row))))))))

(defun archive-plain-name-p (text)
  (and (null (archive-trouble (lambda () (archive-parse-value text))))
       (archive-symbol-p (archive-parse-value text))))

(defun archive-ask-rows (section)
  "The rows of SECTION, one a line, until an empty answer."
  (archive-say "  [~a]: one row a line, ~a; Enter ends." section
               (fourth (archive-section-row section)))
  (loop for n from 1
        for row = (archive-ask-good-row section n)
        until (string= row "")
        collect (make-archive-item :section section :key nil :text row)))

(defun archive-ask-good-row (section n)
  (loop
    (let* ((row (archive-ask-line (format nil "~a: row ~d [Enter: no more]" section n)))
           (trouble (and (string/= row "") (string/= row "?") (archive-row-trouble section row))))
      (cond ((string= row "?") (archive-say "  ~a" (fourth (archive-section-row section))))
            (trouble (archive-say "  ~a" trouble))
            (t (return row))))))

(defun archive-section-names (row answers)
  "Names of the sections of one sort, as ROW of *archive-sections* says there are."
  (let ((word (first row)))
    (ecase (third row)
      (:one (list word))
      (:counted (loop for k from 1 to (parse-integer (archive-answered answers "system" "bodies"))
                      collect (format nil "~a ~d" word k)))
      (:numbered (loop for k from 1 to (archive-ask-count row)
                       collect (format nil "~a ~d" word k)))
      (:named (mapcar (lambda (name) (format nil "~a ~a" word name))
                      (archive-ask-names row))))))

(defun archive-ask-title (kind)
  (let* ((key (archive-find-key kind "top" "title"))
         (text (archive-ask-key key "top" nil)))
    (when (stringp text) (list (make-archive-item :section "top" :key key :text text)))))

(defun archive-ask-sections (kind)
  "All answers but the title, in the order of the table."
  (let ((answers '()))
    (dolist (row (archive-sections-of kind) answers)
      (cond ((string= (first row) "top"))
            ((eq (third row) :rows)
             (unless (archive-answered answers "system" "graph")
               (setq answers (append answers (archive-ask-rows (first row))))))
            (t (dolist (section (archive-section-names row answers))
                 (setq answers (append answers
                                       (archive-ask-section kind (first row) section)))))))))

(defun archive-ask-kind (kinds)
  (if (null (cdr kinds))
      (car kinds)
      (loop
        (let ((answer (archive-ask-line (format nil "Kind of system (~{~a~^, ~})" kinds))))
          (when (member answer kinds :test #'string=) (return answer))
          (archive-say "  Type one of ~{~a~^, ~}." kinds)))))
