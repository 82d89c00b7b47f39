;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A description before it is checked: groups of statements, from the sections of a file or from
;;; a description list. A group is a section, a statement one key with its value, or one row; both
;;; know their lines where there is a file.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/keys" "archive/parser" "archive/circuit_rows" "archive/sections"
                "archive/types"))

(defstruct archive
  path         ; as the user gave it, or as file_search found it; nil for a description list
  found        ; true where file_search found it
  text         ; the file's text
  parts        ; its sections, as archive-split returns them
  kind         ; "mechanical", ...
  groups       ; list of archive-group
  description) ; the checked Maxima list

(defstruct archive-group
  section      ; "archive" (before the first header), "system", "body 2", ...
  line         ; of the header; nil without file
  statements)

(defstruct archive-statement
  key          ; text; nil for a row
  value
  line)

;;; Places

(defun archive-file-name (path)
  (subseq path (1+ (or (position #\/ path :from-end t) -1))))

(defun archive-find-group (groups section)
  (find section groups :key #'archive-group-section :test #'string=))

(defun archive-find-statement (group key)
  (and group
       (find key (archive-group-statements group) :key #'archive-statement-key :test #'equal)))

(defun archive-find-row (group key)
  "The statement of the row with the number KEY, or with the label or value KEY."
  (and group key
       (if (integerp key)
           (nth (1- key) (archive-group-statements group))
           (find-if (lambda (statement)
                      (archive-row-called-p (archive-statement-value statement) key))
                    (archive-group-statements group)))))

(defun archive-right-side (item)
  "Of an equation, or of a row with a label; ITEM where it is none."
  (if (archive-equation-p item) (third item) item))

(defun archive-row-called-p (row name)
  "Whether NAME is the label or a field of ROW."
  (let ((symbol (core-symbol name)))
    (and (consp row)
         (if (archive-equation-p row) (eq (second row) symbol)
             (and (member symbol (cdr row)) t)))))

(defun archive-line (groups section key)
  "The line of KEY (a name, or the number or label of a row) in SECTION, or of the section's
header, or nil."
  (let* ((group (archive-find-group groups section))
         (statement (or (archive-find-statement group key)
                        (and (archive-row-parser section) (archive-find-row group key)))))
    (cond (statement (archive-statement-line statement))
          (group (archive-group-line group))
          ((string= section "branches") (archive-line groups "system" "graph")))))

(defun archive-line-place (path line)
  (and path line (format nil "~a, line ~d" (archive-file-name path) line)))

(defun archive-key-text (key)
  (if (and key (symbolp key)) (core-spelling key) key))

(defun archive-place (archive section key)
  "\"pendulum.txt, line 14\" for a key of a section, nil where there is no file."
  (archive-line-place (archive-path archive)
                      (archive-line (archive-groups archive) section (archive-key-text key))))

(defun archive-with-places (path groups function)
  "Calls FUNCTION while faults find their places in GROUPS of the file PATH."
  (let ((*core-place* (lambda (section key)
                        (archive-line-place path (archive-line groups section
                                                               (archive-key-text key))))))
    (funcall function)))

(defun archive-statement-place (statement)
  "\" (pendulum.txt, line 7)\", or nothing where there is no file."
  (let ((line (archive-statement-line statement)))
    (if line (format nil " (line ~d)" line) "")))

;;; From the sheet of a file

(defun archive-entry-statement (entry)
  (make-archive-statement :key (entry-key entry) :line (entry-line entry)
                          :value (archive-entry-parsed entry)))

(defun archive-groups-of-sheet (sheet)
  "The groups of all sections of SHEET but results."
  (loop for section in (sheet-sections sheet)
        unless (archive-result-section-p section)
          collect (make-archive-group
                   :section (section-name section) :line (section-line section)
                   :statements (mapcar #'archive-entry-statement (section-entries section)))))

(defparameter *archive-words-of-keys*
  '(("rotor" "momentum" "speed" "control") ("algebra" "so" "e"))
  "Words that look like functions and that a key defines.")

(defun archive-known-functions (sheet)
  "Names of the functions that the archive may call: the keys `functions' and `laws' name them."
  (let ((system (archive-find-section sheet "system")))
    (flet ((names (key)
             (let* ((entry (and system (archive-find-entry system key)))
                    (value (and entry (entry-value entry))))
               (if (archive-list-p value) (cdr value) '()))))
      (append (mapcar #'core-spelling (remove-if-not #'archive-symbol-p (names "functions")))
              (loop for law in (names "laws")
                    when (and (archive-equation-p law) (consp (second law)))
                      collect (core-spelling (caar (second law))))))))

(defun archive-check-calls (sheet)
  "An error for the first function that is neither the archive's nor the user's."
  (let ((known (archive-known-functions sheet)))
    (dolist (section (sheet-sections sheet))
      (unless (archive-result-section-p section)
        (dolist (entry (section-entries section))
          (archive-check-functions (entry-calls entry)
                                   (append (cdr (assoc (entry-key entry) *archive-words-of-keys*
                                                       :test #'equal)) known)
                                   (sheet-file sheet)))))))

;;; From a description list

(defun archive-holds-set-p (value)
  (and (consp value) (consp (car value))
       (or (eq (caar value) '$set) (some #'archive-holds-set-p (cdr value)))))

(defun archive-check-no-set (equation)
  (when (archive-holds-set-p equation)
    (core-error "~a holds a set { }, in which the order and equal items are lost; use [ ]"
                (archive-key-text (second equation)))))

(defun archive-list-key (equation)
  "The key of an item of a description list, as text."
  (unless (archive-equation-p equation)
    (core-error "a description is a list of equations such as mass = m, found ~a"
                (archive-value-shown equation)))
  (let ((left (second equation)))
    (cond ((stringp left) left)
          ((archive-symbol-p left) (archive-key-text left))
          (t (core-error "a description is a list of key = value, found ~a; ~
                          if the key has a value in the session, quote it"
                         (archive-value-shown equation))))))

(defun archive-list-statement (equation)
  (make-archive-statement :key (archive-list-key equation) :value (third equation)))

(defun archive-list-items (section value)
  (if (archive-list-p value)
      (cdr value)
      (core-fault section nil "it must be a list, found ~a" (archive-value-shown value))))

(defun archive-section-key-p (name)
  "Whether NAME, the key of an item of a description list, names a section."
  (and (position #\Space name) t))

(defun archive-list-group (equation)
  "The group of a section or of rows in a description list."
  (let ((name (archive-list-key equation)))
    (make-archive-group
     :section name
     :statements (mapcar (if (archive-row-parser name)
                             (lambda (row) (make-archive-statement :value row))
                             #'archive-list-statement)
                         (archive-list-items name (third equation))))))

(defun archive-top-keys ()
  (mapcar #'archive-key-name (archive-keys nil "top")))

(defun archive-with-version (statements)
  "STATEMENTS; a description list may leave out the version."
  (if (find "dynarch" statements :key #'archive-statement-key :test #'string=)
      statements
      (cons (make-archive-statement :key "dynarch" :value *archive-version*) statements)))

(defun archive-groups-of-list (list)
  "The groups of a description list: what is not a section stands in [system], or before it."
  (mapc #'archive-check-no-set (cdr list))
  (let ((top '()) (system '()) (groups '()))
    (dolist (equation (cdr list))
      (let ((name (archive-list-key equation)))
        (cond ((or (archive-section-key-p name) (archive-row-parser name))
               (push (archive-list-group equation) groups))
              ((member name (archive-top-keys) :test #'string=)
               (push (archive-list-statement equation) top))
              (t (push (archive-list-statement equation) system)))))
    (list* (make-archive-group :section "archive"
                               :statements (archive-with-version (nreverse top)))
           (make-archive-group :section "system" :statements (nreverse system))
           (nreverse groups))))
