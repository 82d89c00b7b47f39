;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Sections [result NAME]: a value or a record as text, and back. `from' is the digest of what
;;; the result was computed from, `own' that of its value: the first tells a stale result, the
;;; second one edited by hand. A result edited by hand is used as it stands; one that is stale as
;;; well is an error, because nobody can tell which of the two is meant.
;;; Look first at archive-result, which reads, and archive-result-lines, which writes.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/description" "archive/digest" "archive/groups" "archive/keys"
                "archive/names" "archive/parser" "archive/sections" "archive/speller"
                "archive/store" "archive/tokens" "archive/types"))

(defparameter *archive-result-width* 96)

;; Digests

(defun archive-counts-p (section key kind keys)
  "Whether KEY of SECTION counts among KEYS; \"*\" stands for all that makes the structure of the
system."
  (let ((whole (member "*" keys :test #'string=)))
    (cond ((null key) whole)
          ((not (archive-find-key kind (archive-table-word section) key)) nil)
          ((string= section "archive") (string= key "kind"))
          ((string/= section "system") whole)
          ((member key keys :test #'string=) t)
          (whole (not (member key *archive-analysis-keys* :test #'string=))))))

(defun archive-counted-statements (archive keys)
  "The statements of the description that count, each with its section before it, in the order of
the file."
  (loop for group in (archive-groups archive)
        for section = (archive-group-section group)
        append (loop for statement in (archive-group-statements group)
                     when (archive-counts-p section (archive-statement-key statement)
                                            (archive-kind archive) keys)
                       collect (cons section statement))))

(defun archive-counted-lines (archive keys)
  "The same as texts."
  (loop for (section . statement) in (archive-counted-statements archive keys)
        collect (format nil "[~a] ~@[~a = ~]~a" section (archive-statement-key statement)
                        (core-words (list (archive-statement-value statement))))))

(defun archive-counted-values (archive keys)
  "The same as data, (section key . value) each."
  (loop for (section . statement) in (archive-counted-statements archive keys)
        collect (list* section (archive-statement-key statement)
                       (archive-statement-value statement))))

(defun archive-from-digest (archive keys extras)
  "The digest of what a result depends on: KEYS of the description, and EXTRAS, arguments and
options as texts."
  (archive-digest (format nil "~{~a~%~}" (append (archive-counted-lines archive keys) extras))))

;; Reading

(defun archive-stored-section (archive name options)
  "The section with the result NAME of OPTIONS in the file of ARCHIVE, or nil."
  (and (archive-parts archive) (archive-slot (archive-parts archive) name options)))

(defun archive-check-result-calls (archive entry)
  "Functions in a result are the user's own, or such that the derivation brought; Maxima's own
commands are none."
  (let ((functions (mapcar #'core-spelling (cdr ($core_get (archive-description archive)
                                                           '$functions '((mlist)))))))
    (loop for call in (entry-calls entry)
          unless (or (member (first call) functions :test #'string=)
                     (not (archive-maxima-function-p (first call))))
            do (archive-check-functions (list call) '() (archive-path archive)))))

(defun archive-numerical-p (name)
  (let ((public (gethash name *core-publics*)))
    (and public (core-public-numerical public))))

(defun archive-entry-result (archive name entry)
  (prog1 (archive-entry-parsed entry :relations t :doubles (archive-numerical-p name))
    (archive-check-result-calls archive entry)))

(defun archive-section-value (archive name section)
  "The value in SECTION: that of the key `value', or the record of its parts."
  (let* ((entries (archive-value-entries section))
         (single (find "value" entries :key #'entry-key :test #'string=)))
    (if single
        (archive-entry-result archive name single)
        (archive-list (mapcar (lambda (entry)
                                (archive-equation (core-symbol (entry-key entry))
                                                  (archive-entry-result archive name entry)))
                              entries)))))

(defun archive-section-abbreviations (section)
  "The abbreviations that the value in SECTION was written in, equations, or nil."
  (let* ((entry (archive-find-entry section "abbreviations"))
         (value (and entry (archive-entry-parsed entry :relations t))))
    (and (archive-list-p value) (every #'archive-equation-p (cdr value)) (cdr value))))

(defun archive-fault-edited-and-stale (archive section)
  (core-error "~a:~d: [~a] was edited by hand, and what it was computed from has changed ~
               since; delete the section, or give it back its old value"
              (archive-path archive) (section-line section) (section-name section)))

(defun archive-result (archive name from &optional (options ""))
  "Two values: the stored result NAME of OPTIONS, and :fresh, :edited, :stale or :absent. FROM is
the digest it should have."
  (let* ((section (archive-stored-section archive name options))
         (edited (and section (archive-edited-digest section)))
         (stated (and section (archive-stated-digest section "from")))
         (stale (and stated (string/= stated from))))
    (cond ((null section) (values nil :absent))
          ((null (archive-value-entries section)) (values nil :stale))
          ((and edited stale) (archive-fault-edited-and-stale archive section))
          (stale (values nil :stale))
          (t (values (archive-section-value archive name section)
                     (if (or edited (null stated)) :edited :fresh))))))

;; Writing

(defun archive-record-p (value)
  "Whether VALUE is a list of equations that can stand as one key for each part."
  (and (archive-list-p value) (cdr value)
       (every #'archive-equation-p (cdr value))
       (every #'archive-symbol-p (archive-lefts value))
       (let ((names (mapcar #'core-spelling (archive-lefts value))))
         (and (every #'archive-name-p names)
              (= (length names) (length (remove-duplicates names :test #'string=)))
              (notany (lambda (name) (member name (cons "value" *archive-result-keys*)
                                             :test #'string=)) names)))))

(defun archive-wrapped (open items close indent)
  "ITEMS, texts, in brackets: on one line where they fit, else a line for each, so that a person
can read them."
  (let ((line (format nil "~a~{~a~^, ~}~a" open items close)))
    (if (and (<= (+ indent (length line)) *archive-result-width*)
             (notany (lambda (item) (find #\Newline item)) items))
        line
        (format nil (format nil "~~a~~{~~a~~^,~~%~~~d@t~~}~~a" (+ indent 1)) open items close))))

(defun archive-filled-lines (open items close indent)
  "The same for a row of numbers and words: as many on a line as fit."
  (with-output-to-string (out)
    (write-string open out)
    (loop with column = (+ indent (length open))
          for (item . more) on items
          for text = (concatenate 'string item (if more "," close))
          for first = t then nil
          do (cond (first)
                   ((< (+ column 1 (length text)) *archive-result-width*)
                    (write-char #\Space out)
                    (incf column))
                   (t (format out "~%~v@t" (1+ indent))
                      (setq column (1+ indent))))
             (write-string text out)
             (incf column (length text)))))

(defun archive-row-p (value items)
  "Whether VALUE, whose parts are ITEMS as text, is a row of a table: it begins with a number or a
word, and nothing in it is named, or longer than a line."
  (and (atom (cadr value)) (notany #'archive-equation-p (cdr value))
       (notany (lambda (item) (find #\Newline item)) items)))

(defun archive-break-p (text position)
  "Whether a line may end before POSITION of TEXT: before a sign between two terms."
  (let ((before (char text (1- position))))
    (and (find (char text position) "+-")
         (or (alphanumericp before) (find before ")]'_"))
         (not (and (char-equal before #\e) (> position 1)
                   (digit-char-p (char text (- position 2))))))))

(defun archive-line-end (text start room)
  "Where the line of TEXT from START ends: at the last break that leaves it within ROOM letters,
or at the first."
  (let ((end nil))
    (loop for position from (1+ start) below (length text)
          until (and end (> (- position start) room))
          when (archive-break-p text position) do (setq end position)
          finally (return (and end (> (- (length text) start) room) end)))))

(defun archive-folded (text indent)
  "TEXT, a long sum, on several lines that begin in column INDENT; a text with strings is left as
it is."
  (if (find #\" text)
      text
      (with-output-to-string (out)
        (loop with start = 0
              for end = (archive-line-end text start (- *archive-result-width* indent))
              do (write-string text out :start start :end end)
              while end
              do (format out "~%~v@t" indent)
                 (setq start end)))))

(defun archive-value-text (value indent doubles)
  "VALUE as text that begins in column INDENT and reads back; with DOUBLES its decimals are
doubles."
  (if (and (archive-list-p value) (cdr value))
      (let ((items (mapcar (lambda (item) (archive-value-text item (1+ indent) doubles))
                           (cdr value))))
        (if (and doubles (archive-row-p value items))
            (archive-filled-lines "[" items "]" indent)
            (archive-wrapped "[" items "]" indent)))
      (archive-folded (archive-settled-text value :doubles doubles) indent)))

(defun archive-part (key value doubles)
  (cons key (archive-value-text value (+ 3 (length key)) doubles)))

(defun archive-value-parts (value doubles)
  "VALUE as a list of (key . text)."
  (if (archive-record-p value)
      (mapcar (lambda (equation)
                (archive-part (core-spelling (second equation)) (third equation) doubles))
              (cdr value))
      (list (archive-part "value" value doubles))))

(defun archive-note-text (notes)
  "A list of texts as one string of the archive."
  (archive-spell (substitute-if #\Space (lambda (c) (< (char-code c) 32))
                                (format nil "~{~a~^; ~}" notes))))

(defstruct archive-step
  "A result to be written: its NAME and VALUE, the digest FROM what it was computed, its OPTIONS as
text, its FORM, CHECKS and LEFT-OUT as texts, ABBREVIATIONS it is written in, a REPORT of keys that
are no part of it; whether the call PASSED it only, on the way to another."
  name value from (options "") form checks left-out abbreviations report passed)

(defun archive-partial-p (section)
  "Whether SECTION holds a part only of what was asked for."
  (and (archive-find-entry section "partial") t))

(defun archive-result-lines (step)
  "The lines of STEP below its header, without the last line end."
  (let ((parts (archive-value-parts (archive-step-value step)
                                    (archive-numerical-p (archive-step-name step))))
        (options (archive-step-options step)) (checks (archive-step-checks step))
        (left-out (archive-step-left-out step)) (abbreviations (archive-step-abbreviations step)))
    (format nil "from = ~a~%own = ~a~%~@[options = ~a~%~]~@[form = ~a~%~]~@[check = ~a~%~]~
                 ~@[left_out = ~a~%~]~@[abbreviations = ~a~%~]~{~a~%~}~{~a~^~%~}"
            (archive-step-from step) (archive-own-digest parts)
            (and (string/= options "") (archive-spell options))
            (archive-step-form step)
            (and checks (archive-note-text checks))
            (and left-out (archive-note-text left-out))
            (and abbreviations (archive-spell (archive-list abbreviations)))
            (loop for (key . value) in (archive-step-report step)
                  collect (format nil "~a = ~a" key
                                  (archive-value-text value (+ 3 (length key)) t)))
            (loop for (key . text) in parts collect (format nil "~a = ~a" key text)))))

(defun archive-save (archive steps &optional elsewhere)
  "Writes STEPS into ARCHIVE's file or ELSEWHERE, at one stroke. True when done; else a warning, and
the file is as it was."
  (archive-save-results
   archive elsewhere
   (lambda ()
     (loop for step in steps
           collect (list (archive-step-name step) :options (archive-step-options step)
                         :passed (archive-step-passed step)
                         :lines (archive-result-lines step))))))
