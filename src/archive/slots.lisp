;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Results of one function with different options stand beside each other: [result NAME] without
;;; options, [result NAME 2], [result NAME 3], .. The key `options' says which a slot is; the
;;; number is only a name, so an old [result NAME] with `options' is that slot. There are at most
;;; eight; where a ninth is due the oldest goes, which is the first in the file, but never the one
;;; without options and never one edited by hand. Look first at archive-slot, then at
;;; archive-room-for.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/sections" "archive/digest"))

(defparameter *archive-most-slots* 8 "The most results of one function in an archive.")

(defparameter *archive-result-keys*
  '("from" "own" "options" "form" "check" "left_out" "abbreviations" "partial")
  "Keys of a result section that are no part of its value.")

;; The value of a section, and whether a person changed it

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

;; Slots

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

;; Room for a new one

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
