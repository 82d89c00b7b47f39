;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Results in the file of an archive: their slots, and writing. Results of one function with
;;; different options stand beside each other: [result NAME] without options, [result NAME 2],
;;; [result NAME 3], .. The key `options' says which a slot is; the number is only a name, so an old
;;; [result NAME] with `options' is that slot. Results are replaced where they stand, new ones go to
;;; the end, everything else stays byte for byte. The file is read again just before; if its
;;; description changed meanwhile nothing is written. A result that cannot be written is still
;;; returned: all troubles end in one warning. Look first at archive-slot and, at the end, at
;;; archive-save-results.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/bytes" "archive/digest" "archive/disk" "archive/groups"
                "archive/circuit_rows" "archive/sections" "archive/types"))

(defparameter *archive-write-tries* 20
  "How often a write begins anew when another process wrote in between.")

(defparameter *archive-most-slots* 8 "The most results of one function in an archive.")

(defparameter *archive-result-keys*
  '("from" "own" "options" "form" "check" "left_out" "abbreviations" "run" "partial")
  "Keys of a result section that are no part of its value.")

;;; The value of a section, and whether a person changed it

(defun archive-bare-text (text)
  "TEXT without comments and without blanks outside strings: what counts of a value."
  (let ((end (length text)) (position 0))
    (with-output-to-string (out)
      (loop while (< position end)
            do (let ((c (char text position)))
                 (case c
                   (#\" (let ((close (min (1- end) (archive-string-end text position end))))
                          (write-string text out :start position :end (1+ close))
                          (setq position close)))
                   (#\# (setq position (1- (or (position #\Newline text :start position) end))))
                   ((#\Space #\Tab #\Newline #\Return))
                   (t (write-char c out)))
                 (incf position))))))

(defun archive-own-digest (parts)
  "The digest of the value whose PARTS are (key . text)."
  (archive-digest (format nil "~{~a~%~}"
                          (loop for (key . text) in parts
                                collect (format nil "~a=~a" key (archive-bare-text text))))))

(defun archive-value-entries (section)
  "The entries of a result SECTION that make its value."
  (remove-if (lambda (entry) (member (entry-key entry) *archive-result-keys* :test #'string=))
             (section-entries section)))

(defun archive-section-own (section)
  "The digest of the value that stands in SECTION."
  (archive-own-digest (mapcar (lambda (entry) (cons (entry-key entry) (archive-entry-text entry)))
                              (archive-value-entries section))))

(defun archive-stated-digest (section key)
  (let ((entry (archive-find-entry section key)))
    (and entry (archive-entry-text entry))))

(defun archive-edited-digest (section)
  "The digest of the value in SECTION when it was edited by hand, else nil."
  (let ((own (archive-section-own section)))
    (and (not (equal own (archive-stated-digest section "own"))) own)))

;;; Slots

(defun archive-slot-header (name number)
  (format nil "result ~a~[~;~:;~:* ~d~]" name number))

(defun archive-slot-number (section name)
  "Which slot of the results NAME the SECTION is: 1 for [result NAME], k for [result NAME k]; nil
where it is none."
  (let* ((header (section-name section)) (first (archive-slot-header name 1))
         (end (length first)))
    (cond ((string= header first) 1)
          ((and (> (length header) (1+ end)) (string= first header :end2 end)
                (char= (char header end) #\Space)
                (every #'digit-char-p (subseq header (1+ end))))
           (parse-integer header :start (1+ end))))))

(defun archive-slots (sheet name)
  "The sections of SHEET that are results NAME, the oldest first."
  (remove-if-not (lambda (section) (archive-slot-number section name)) (sheet-sections sheet)))

(defun archive-slot-options (section)
  "The options that the result in SECTION was made with, as text; \"\" for none."
  (let* ((entry (archive-find-entry section "options"))
         (value (if entry (archive-entry-parsed entry) "")))
    (if (stringp value)
        value
        (core-error "~a:~d: options must be a text in double quotes"
                    (sheet-file (entry-sheet entry)) (entry-line entry)))))

(defun archive-slot (sheet name options)
  "The section of SHEET with the result NAME of OPTIONS, or nil."
  (find options (archive-slots sheet name) :key #'archive-slot-options :test #'string=))

;;; Room for a new one. There are at most eight; where a ninth is due the oldest goes, which is the
;;; first in the file, but never the one without options and never one edited by hand.

(defun archive-free-number (slots name options)
  "The least number that no slot has, or nil; the first is kept for the result without options."
  (loop for number from (if (string= options "") 1 2) to *archive-most-slots*
        unless (find number slots :key (lambda (section) (archive-slot-number section name)))
          return number))

(defun archive-may-drop-p (section)
  (and (string/= (archive-slot-options section) "") (not (archive-edited-digest section))))

(defun archive-room-for (sheet name options)
  "Two values: the header of a new section for the result NAME of OPTIONS, and the old one that
goes for it, or nil."
  (let* ((slots (archive-slots sheet name))
         (number (and (< (length slots) *archive-most-slots*)
                      (archive-free-number slots name options)))
         (oldest (and (null number) (find-if #'archive-may-drop-p slots))))
    (cond (number (values (archive-slot-header name number) nil))
          (oldest (values (section-name oldest) oldest))
          (t (core-error "it has ~d results ~a already, all of them edited by hand or without ~
                          options; delete one of the sections ~{[~a]~^, ~}"
                         (length slots) name (mapcar #'section-name slots))))))

;;; Text with results in it

(defun archive-file-lines (text newline)
  "TEXT, whose lines end in a newline, with the line ends of the file."
  (with-output-to-string (out)
    (loop for c across text
          do (if (char= c #\Newline) (write-string newline out) (write-char c out)))))

(defun archive-ends-with-p (text end)
  (and (>= (length text) (length end)) (string= end text :start2 (- (length text) (length end)))))

(defun archive-with-new-section (text section newline)
  "TEXT with SECTION at its end, a blank line before it."
  (let ((open (if (archive-ends-with-p text (string #\Newline)) "" newline)))
    (concatenate 'string text open
                 (if (archive-ends-with-p text (concatenate 'string newline newline)) "" newline)
                 section newline)))

(defun archive-section-text (header lines newline)
  "The section HEADER with LINES below it, with the line ends of the file."
  (archive-file-lines (format nil "[~a]~%~a" header lines) newline))

(defun archive-without-section (text section)
  "TEXT without SECTION, its last line end, and the blank line before it with which it came."
  (let* ((newline (position #\Newline text :start (section-end section)))
         (end (if newline (1+ newline) (length text)))
         (before (subseq text 0 (section-start section)))
         (line-end (archive-line-end-of text)))
    (concatenate 'string
                 (if (archive-ends-with-p before (concatenate 'string line-end line-end))
                     (subseq before 0 (- (length before) (length line-end)))
                     before)
                 (subseq text end))))

(defun archive-with-result (text result file)
  "TEXT of FILE with RESULT, (name :options :lines :passed), in its slot: where it stands, or at
the end. A step passed through takes no new slot but the one without options."
  (destructuring-bind (name &key (options "") lines passed) result
    (let* ((sheet (archive-split text file :parse nil))
           (newline (sheet-newline sheet))
           (old (archive-slot sheet name options)))
      (cond (old (concatenate 'string (subseq text 0 (section-start old))
                              (archive-section-text (section-name old) lines newline)
                              (subseq text (section-end old))))
            ((and passed (string/= options "")) text)
            (t (multiple-value-bind (header oldest) (archive-room-for sheet name options)
                 (archive-with-new-section
                  (if oldest (archive-without-section text oldest) text)
                  (archive-section-text header lines newline) newline)))))))

(defun archive-with-results (text results file)
  "TEXT with all RESULTS."
  (dolist (result results text)
    (setq text (archive-with-result text result file))))

;;; Has the description changed meanwhile?

(defun archive-description-lines (sheet)
  "What counts of the description in SHEET: sections, keys and values without comments and
blanks; not the title."
  (loop for section in (sheet-sections sheet)
        unless (archive-result-section-p section)
          append (cons (section-name section)
                       (loop for entry in (section-entries section)
                             unless (equal (entry-key entry) "title")
                               collect (cons (entry-key entry)
                                             (archive-bare-text (archive-entry-text entry)))))))

(defun archive-check-same-description (archive text)
  (unless (equal (archive-description-lines (archive-parts archive))
                 (archive-description-lines (archive-split text (archive-path archive)
                                                           :parse nil)))
    (core-error "its description changed while the result was computed; call the function again")))

;;; One write

(defun archive-text-with-results (archive text results target)
  "The new text of TARGET, whose text is TEXT."
  (when (equal target (archive-path archive))
    (archive-check-same-description archive text))
  (archive-with-results text results target))

(defun archive-fresh-text (archive)
  "The text of a new file for the results of ARCHIVE."
  (format nil "# results of ~a~%dynarch = ~d~%kind = ~a~%"
          (archive-file-name (archive-path archive))
          *archive-version* (archive-kind archive)))

(defun archive-write-once (archive target results)
  "Writes RESULTS into TARGET; nil when another process changed it in the meantime."
  (let* ((file (archive-followed target))
         (old (and (archive-exists-p file) (archive-file-bytes file)))
         (text (if old (archive-text-of-bytes old target) (archive-fresh-text archive)))
         (new (archive-text-with-results archive text results target)))
    (when (archive-replace-file file (archive-utf8 new)
                                (lambda () (if old (equalp old (archive-file-bytes file))
                                               (not (archive-exists-p file)))))
      (archive-take-text archive target new)
      t)))

(defun archive-take-text (archive target text)
  "ARCHIVE has TEXT from now on, when TARGET is its own file."
  (when (equal target (archive-path archive))
    (setf (archive-text archive) text
          (archive-parts archive) (archive-split text target :parse nil))))

(defun archive-write-results (archive target results)
  (archive-with-lock ((archive-followed target))
    (or (loop repeat *archive-write-tries* thereis (archive-write-once archive target results))
        (core-error "another program keeps changing it"))))

;;; Troubles become a warning

(defun archive-failure (function)
  "The text of the error in which FUNCTION ends, or nil."
  (let ((*core-function* nil) (*merror-signals-$error-p* t) ($errormsg nil))
    (handler-case (progn (funcall function) nil)
      (maxima-$error () (core-error-text))
      (error (condition) (remove #\Newline (princ-to-string condition))))))

(defun archive-save-results (archive elsewhere results)
  "Writes what the function RESULTS returns, a list as archive-with-result takes them, into
ARCHIVE's file or ELSEWHERE. True when done."
  (let ((target (or elsewhere (archive-path archive))))
    (when target
      (let ((trouble (archive-failure (lambda () (archive-write-results archive target
                                                                        (funcall results))))))
        (when trouble (core-warn "the result is not saved in ~a: ~a" target trouble))
        (not trouble)))))

(defun archive-write-new (file text)
  "Makes FILE an archive of TEXT; an error where that cannot be done."
  (let ((trouble (archive-failure
                  (lambda ()
                    (let ((name (archive-followed file)))
                      (archive-with-lock (name)
                        (archive-replace-file name (archive-utf8 text))))))))
    (when trouble (core-error "~a cannot be written: ~a" file trouble))
    file))
