;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The text of an archive as sections and entries, each with its place and with the range of
;;; characters it takes, so that one section can be replaced and everything else stays as it is.
;;; Column 1 decides: [ opens a header, # and empty lines are passed over, a blank or tab
;;; continues the entry above, anything else begins an entry. What stands before the first
;;; header is the section "archive". Values of the description are parsed at once; those of
;;; results when they are asked for, by archive-entry-parsed. Look first at archive-split.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/parser" "archive/circuit_rows" "archive/simplify" "archive/tokens"))

(defstruct (archive-sheet (:conc-name sheet-))
  "The TEXT of FILE, its line end, and its sections in their order."
  (text "") (file nil) (newline nil) (sections '()))

(defstruct (archive-section (:conc-name section-))
  "NAME without brackets; LINE of the header; characters START to END: header to last entry,
without the last line end."
  (name "") (line 1) (start 0) (end 0) (entries '()))

(defstruct (archive-entry (:conc-name entry-))
  "KEY as text (nil for a row); LINE of the entry; characters START to END of the whole entry, FROM
to TO of its value; VALUE-LINE and VALUE-COLUMN of the value; VALUE once it is parsed;
CALLS, the open functions in it (name line column)."
  (key nil) (line 1) (start 0) (end 0) (from 0) (to 0) (value-line 1) (value-column 1)
  (sheet nil)
  (value nil) (parsed nil) (calls '()))

;; Lines

(defparameter *archive-most-sections* 5000 "The most sections of an archive.")
(defparameter *archive-entries* 20000 "The most entries of an archive.")

(defstruct (archive-line-range (:conc-name line-))
  "A line of the text: its NUMBER, characters START to END without the line end, and NEXT, where
the next one begins."
  (number 1) (start 0) (end 0) (next 0))

(defun archive-line-at (text start number)
  (let* ((newline (position #\Newline text :start start))
         (end (or newline (length text))))
    (make-archive-line-range :number number :start start
                             :end (if (and (> end start) (char= (char text (1- end)) #\Return))
                                      (1- end) end)
                             :next (if newline (1+ newline) (length text)))))

(defun archive-blank-p (c) (or (char= c #\Space) (char= c #\Tab)))

(defun archive-line-content (text line)
  "Where the content of LINE begins, or nil if it is blank or a comment."
  (let ((from (position-if-not #'archive-blank-p text :start (line-start line) :end
                               (line-end line))))
    (and from (char/= (char text from) #\#) from)))

(defun archive-text-start (text)
  "Where TEXT begins after a byte order mark."
  (let ((mark #+sbcl (string (code-char #xFEFF))
              #-sbcl (map 'string #'code-char '(#xEF #xBB #xBF))))
    (if (and (>= (length text) (length mark)) (string= mark text :end2 (length mark)))
        (length mark)
        0)))

(defun archive-line-fault (sheet line position control &rest arguments)
  (apply #'archive-fault-at (sheet-file sheet) (line-number line)
         (1+ (archive-characters-between (sheet-text sheet) (line-start line)
                                         position)) control arguments))

;; Headers and entries

(defun archive-section-of-header (sheet line)
  (let* ((text (sheet-text sheet)) (start (line-start line)) (end (line-end line))
         (close (position #\] text :start start :end end))
         (name (and close (subseq text (1+ start) close))))
    (unless close
      (archive-line-fault sheet line start
                          "found a section header without its closing ]; a list continued from ~
                           the line above is indented"))
    (let ((after (position-if-not #'archive-blank-p text :start (1+ close) :end end)))
      (when (and after (char/= (char text after) #\#))
        (archive-line-fault sheet line after
                            "found `~a' after a section header, expected the end of the line"
                            (archive-shown (subseq text after end)))))
    (unless (and (plusp (length name)) (archive-letter-p (char name 0))
                 (every (lambda (c) (or (archive-word-p c) (char= c #\Space))) name))
      (archive-line-fault sheet line (1+ start)
                          "found [~a], expected the name of a section; a list continued from the ~
                           line above is indented"
                          (archive-shown name)))
    (make-archive-section :name name :line (line-number line) :start start :end end)))

(defun archive-check-section-name (sheet section line sections)
  (let ((first (find (section-name section) sections :key #'section-name :test #'string=)))
    (cond ((string= (section-name section) "archive")
           (archive-line-fault sheet line (line-start line)
                               "[archive] is not the name of a section: its keys stand before ~
                                the first header"))
          (first
           (archive-line-fault sheet line (line-start line)
                               "the section [~a] stands twice, first in line ~d"
                               (section-name section) (section-line first))))))

(defun archive-check-count (sheet line number limit what)
  (when (> number limit)
    (archive-line-fault sheet line (line-start line) "more than ~d ~a" limit what)))

(defun archive-entry-of-line (sheet section line)
  "The entry that begins in LINE of SECTION; more lines may follow."
  (if (archive-row-parser (section-name section))
      (archive-row-of-line sheet line)
      (archive-key-of-line sheet line)))

(defun archive-row-of-line (sheet line)
  (make-archive-entry :sheet sheet :line (line-number line) :start (line-start line) :end
                      (line-end line)
                      :from (line-start line) :to (line-end line) :value-line (line-number line)))

(defun archive-key-of-line (sheet line)
  (let* ((text (sheet-text sheet)) (start (line-start line)) (end (line-end line))
         (comment (or (position #\# text :start start :end end) end))
         (sign (position #\= text :start start :end comment))
         (key (string-right-trim '(#\Space #\Tab) (subseq text start (or sign comment)))))
    (unless sign
      (archive-line-fault sheet line start
                          "found `~a', expected key = value; a value continued from the line ~
                           above is indented"
                          (archive-shown key)))
    (unless (archive-name-p key)
      (archive-line-fault sheet line start
                          "found `~a', expected a key (a letter, then letters, digits and _) ~
                           before the ="
                          (archive-shown key)))
    (make-archive-entry :sheet sheet :key key :line (line-number line) :start start :end end
                        :from (1+ sign) :to end :value-line (line-number line)
                        :value-column (+ 2 (archive-characters-between text start sign)))))

(defun archive-continue-entry (entry section line)
  "LINE belongs to ENTRY, the last one of SECTION."
  (setf (entry-end entry) (line-end line)
        (entry-to entry) (line-end line)
        (section-end section) (line-end line)))

;; The whole text

(defun archive-begin-section (sheet line)
  "The section whose header is LINE; of that name there is no other."
  (let ((section (archive-section-of-header sheet line)))
    (archive-check-section-name sheet section line (sheet-sections sheet))
    (push section (sheet-sections sheet))))

(defun archive-begin-entry (sheet section line)
  (push (archive-entry-of-line sheet section line) (section-entries section))
  (setf (section-end section) (line-end line)))

(defun archive-take-line (sheet line content counts)
  "Adds LINE, which has its CONTENT from that place on, to SHEET, whose sections and entries stand
with the newest first; COUNTS are their numbers, (sections . entries)."
  (let* ((section (car (sheet-sections sheet))) (entry (car (section-entries section))))
    (cond ((and (> content (line-start line)) (null entry))
           (archive-line-fault sheet line content
                               "an indented line continues the entry above, but there is none; ~
                                begin in column 1"))
          ((> content (line-start line)) (archive-continue-entry entry section line))
          ((char= (char (sheet-text sheet) content) #\[)
           (archive-check-count sheet line (incf (car counts)) *archive-most-sections* "sections")
           (archive-begin-section sheet line))
          (t (archive-check-count sheet line (incf (cdr counts)) *archive-entries* "entries")
             (archive-begin-entry sheet section line)))))

(defun archive-split-lines (sheet)
  "Fills SHEET from its text."
  (let* ((text (sheet-text sheet)) (start (archive-text-start text)) (counts (cons 0 0)))
    (push (make-archive-section :name "archive" :start start :end start) (sheet-sections sheet))
    (loop for number from 1
          while (< start (length text))
          do (let* ((line (archive-line-at text start number))
                    (content (archive-line-content text line)))
               (when content (archive-take-line sheet line content counts))
               (setq start (line-next line))))
    (dolist (section (sheet-sections sheet))
      (setf (section-entries section) (nreverse (section-entries section))))
    (setf (sheet-sections sheet) (nreverse (sheet-sections sheet)))))

(defun archive-split (text file &key (parse t))
  "The sheet of TEXT, which messages name by FILE. With PARSE nil no value is parsed."
  (let* ((text (archive-simple-text text))
         (sheet (make-archive-sheet :text text :file file :newline (archive-line-end-of text))))
    (archive-split-lines sheet)
    (when parse (archive-parse-sheet sheet))
    sheet))

(defun archive-line-end-of (text)
  "The line end that TEXT uses, as a string."
  (let ((newline (position #\Newline text)))
    (if (and newline (plusp newline) (char= (char text (1- newline)) #\Return))
        (map 'string #'code-char '(13 10))
        (string #\Newline))))

(defun archive-find-section (sheet name)
  "The section NAME of SHEET, or nil."
  (find name (sheet-sections sheet) :key #'section-name :test #'string=))

(defun archive-find-entry (section key)
  "The entry of SECTION with KEY, or nil."
  (find key (section-entries section) :key #'entry-key :test #'equal))

(defun archive-result-section-p (section)
  (let ((name (section-name section)))
    (and (> (length name) 7) (string= "result " name :end2 7))))

(defun archive-entry-text (entry)
  "The value of ENTRY as it stands in the file, comments included."
  (string-trim '(#\Space #\Tab #\Newline #\Return)
               (subseq (sheet-text (entry-sheet entry)) (entry-from entry) (entry-to entry))))

;; Values

(defun archive-parse-sheet (sheet)
  "Parses the values of the description; results are left for later."
  (let ((*archive-work* (list 0)))
    (archive-parse-sections sheet)))

(defun archive-parse-sections (sheet)
  (dolist (section (sheet-sections sheet))
    (unless (archive-result-section-p section)
      (let ((row (archive-row-parser (section-name section))))
        (dolist (entry (section-entries section))
          (if row
              (archive-parse-row entry row)
              (archive-entry-parsed entry)))))))

(defun archive-parse-row (entry parse)
  "The row ENTRY as a Maxima list, or label = list; PARSE takes a reader on its first token."
  (let* ((sheet (entry-sheet entry))
         (reader (archive-open-text
                  (make-archive-stretch :text (sheet-text sheet) :file (sheet-file sheet)
                                        :start (entry-start entry) :end (entry-end entry)
                                        :line (entry-line entry)))))
    (archive-set-entry-value entry (list (funcall parse reader) (archive-reader-calls reader)))))

(defun archive-entry-parsed (entry &key doubles relations)
  "The value of ENTRY, parsed when it is first asked for."
  (unless (entry-parsed entry)
    (archive-set-entry-value
     entry
     (multiple-value-list
      (or (archive-digest-value entry)
          (archive-parse-value (archive-value-stretch entry)
                               :doubles doubles :relations relations)))))
  (entry-value entry))

(defun archive-value-stretch (entry)
  (let ((sheet (entry-sheet entry)))
    (make-archive-stretch :text (sheet-text sheet) :file (sheet-file sheet)
                          :start (entry-from entry) :end (entry-to entry)
                          :line (entry-value-line entry) :column (entry-value-column entry))))

(defun archive-set-entry-value (entry values)
  (setf (entry-value entry) (first values)
        (entry-calls entry) (second values)
        (entry-parsed entry) t))

(defun archive-digest-value (entry)
  "The text sha256:.. of a result's from or own, or nil."
  (and (member (entry-key entry) '("from" "own") :test #'equal)
       (let ((text (archive-entry-text entry)))
         (and (> (length text) 7) (string= "sha256:" text :end2 7)
              (every #'archive-word-p (subseq text 7))
              text))))
