;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Questions of the dialog: asking a line as Maxima itself asks, and asking for the value of one
;;; key until it fits. Every answer goes through the parser and the checks that read archives. `?'
;;; explains, Enter takes the default, `.' takes the defaults of the rest of a section. Look first
;;; at archive-ask-line and archive-ask-key.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/bare_graph" "archive/keys" "archive/open" "archive/types" "core/messages"))

(defvar *archive-asked* '() "The questions asked in this dialog.")
(defvar *archive-fresh-input* nil
  "True until the first line is read: what is left of the line that called us is passed over.")

(defstruct archive-item section key text)

;;; Asking a line, as Maxima itself asks

(defun archive-input-stream ()
  #+sbcl *standard-input*
  #-sbcl *query-io*)

(defun archive-prompt (question)
  "QUESTION as read() of Maxima prints it, so that a worksheet shows it as a prompt; on one line."
  (let (($linel 100000) (linel 100000))
    (format-prompt nil "~a"
                   (string-right-trim '(#\Newline #\Space)
                                      (with-output-to-string (*standard-output*)
                                        (mfuncall '$print question))))))

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

;;; The list of a graph, pasted on several lines

(defun archive-open-brackets (text)
  "How many brackets of TEXT are not closed."
  (- (count-if (lambda (c) (find c "[{(")) text) (count-if (lambda (c) (find c "]})")) text)))

(defun archive-whole-answer (key answer)
  "ANSWER, for the key of a graph with the lines that close its brackets, without a full stop."
  (if (or (not (eq (archive-key-type key) :graph)) (member answer '("" "." "?") :test #'string=))
      answer
      (loop while (plusp (archive-open-brackets answer))
            for more = (archive-read-line)
            while (and more (string/= "" (archive-trimmed-answer more)))
            do (setq answer (format nil "~a ~a" answer (archive-trimmed-answer more)))
            finally (return (archive-without-stop answer)))))

;;; One key

(defun archive-question-text (key section required present)
  (format nil "~@[~a: ~]~a ~a" (and (string/= section "top") section) (archive-key-question key)
          (cond (present (archive-present-text present))
                (required "(needed; ? explains)")
                ((archive-said-default key) (format nil "[~a]" (archive-said-default key)))
                (t "[Enter: none]"))))

(defun archive-present-text (present)
  (format nil "(now ~a; Enter keeps it, - removes it)" (core-cut present)))

(defun archive-said-default (key)
  "The default of KEY where there is one to be told: an empty list is none."
  (let ((default (archive-default key)))
    (and (not (equal default "[]")) default)))

(defun archive-explain (key)
  (archive-say "  ~a: ~a. Type ~a.~@[ Enter takes ~a.~]" (archive-key-name key)
               (archive-help-text key) (archive-type-phrase (archive-key-type key))
               (archive-said-default key)))

(defun archive-quoted-text (text)
  "TEXT as a string of the archive, if it is not one yet."
  (if (char= (char text 0) #\") text (format nil "\"~a\"" (substitute #\' #\" text))))

(defun archive-answer-for-archive (key answer)
  (if (and (eq (archive-key-type key) :text) (plusp (length answer)))
      (archive-quoted-text answer)
      answer))

(defun archive-ask-key (key section required &optional present)
  "The text of the value of KEY; nil for its default, or for the PRESENT text where there is one,
:rest where the person takes all defaults that follow, :none where that text is to go."
  (loop
    (let* ((answer (archive-whole-answer
                    key (archive-ask-line (archive-question-text key section required present))))
           (text (archive-answer-for-archive key answer)))
      (cond ((string= answer "?") (archive-explain key))
            ((and present (string= answer "-")) (return :none))
            ((and (string= answer ".") (not required)) (return :rest))
            ((and (member answer '("" ".") :test #'string=) required)
             (archive-say "  ~a is needed: ~a." (archive-key-name key)
                          (archive-type-phrase (archive-key-type key))))
            ((string= answer "") (return nil))
            (t (let ((trouble (archive-value-trouble key text)))
                 (if trouble (archive-say-trouble key trouble) (return text))))))))

(defun archive-say-trouble (key trouble)
  "Says TROUBLE, and what KEY wants where that does not."
  (let ((phrase (archive-type-phrase (archive-key-type key))))
    (archive-say "  ~a~:[. Type ~a.~;~]" trouble (search phrase trouble) phrase)))
