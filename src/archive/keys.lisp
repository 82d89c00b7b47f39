;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The table of keys: every section and key of an archive, by kind, with type, default, help and
;;; question. Those of all kinds stand here, the others in the forms of the kinds, in register.lisp
;;; beside this file. The check, the dialog, the messages and the table in doc/archive.md all come
;;; from here; plain data, no Maxima in it. A row is (name type default help question), the help a
;;; format's control without arguments. The default is text as it would stand in the archive; nil
;;; where the key may be absent; :required; (:when key value) required if that key has that value;
;;; (:unless key text) required if that is absent, else of the default text or nil; (:with key
;;; text) a default that makes sense beside that key only.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/types"))

(defparameter *archive-analysis-keys*
  '("title" "where" "abbreviations" "unknowns" "solution" "values" "start" "time")
  "Keys that are no part of the structure of a system.")

(defparameter *archive-top-rows*
  '(("dynarch" :version :required "version of the format" "Version of the format")
    ("kind" :kind :required "kind of system" "Kind of system")
    ("title" :text nil "a line about the system, for the reader" "Title")))

(defparameter *archive-name-rows*
  '(("parameters" :facts "[]"
     "names with what is assumed of them; names not listed are free symbols, with a warning"
     "Parameters, with what is assumed of them")
    ("functions" :names "[]" "functions left open" "Names of functions left open")
    ("laws" :laws "[]" "formulas of such functions, where known" "Formulas of these functions"))
  "Keys of [system] in all kinds, behind the names of what moves.")

(defparameter *archive-analysis-rows*
  '(("values" :numbers "[]"
     "numbers for runs; symbolic functions ignore them" "Numbers for runs")
    ("where" :assignments "[]"
     "special case for the analysis, put into the equations after they are formed"
     "Special case for the analysis")
    ("abbreviations" :assignments "[]"
     "names for printing results, such as [rho = 4*g1*s1^2]" "Abbreviations")
    ("unknowns" :names nil
     "what equilibria and stationary motions are solved for; the rest stays free"
     "What is solved for")
    ("solution" :motion nil
     "the motion to be judged, perhaps as x = r*W*t; velocities and momenta not named are 0"
     "Motion to be judged")
    ("start" :motion nil "start values of a run" "Start values of a run")
    ("time" :span nil "span of a run" "Span of a run"))
  "The last keys of [system] in all kinds.")

;; The table as records

(defstruct archive-key section name type default help question)

;; A default that depends on another key: (how other word), how :when (required where the other is
;; that word), :with (has a place beside the other only, by default the word) or :unless (required
;; without the other, else the word, or nothing).

(defun archive-beside-how (default) (first default))
(defun archive-beside-other (default) (second default))
(defun archive-beside-word (default) (third default))

(defstruct archive-sort
  "A sort of section: its NAME or the first word of it; its FORM, :one, :counted, :numbered, :named
or :rows; its MEANING; as DETAIL the key that counts it, or what parses a row; its KEYS."
  name form meaning detail keys)

(defun archive-sort-of (rows name form meaning &optional detail)
  (make-archive-sort
   :name name :form form :meaning meaning :detail detail
   :keys (loop for (key type default help question) in rows
               collect (make-archive-key :section name :name key :type type :default default
                                         :help help :question question))))

(defun archive-help-text (key) (format nil (archive-key-help key)))

(defun archive-stated-sorts (kind)
  "The sorts of section of KIND, a core-kind, in the order in which they are asked."
  (list* (archive-sort-of *archive-top-rows* "top" :one "the lines before the first header")
         (archive-sort-of (append (core-kind-first kind) *archive-name-rows* (core-kind-keys kind)
                                  *archive-analysis-rows*)
                          "system" :one "the whole system")
         (loop for (head . rows) in (core-kind-sections kind)
               collect (apply #'archive-sort-of rows head))))

(defparameter *archive-sorts*
  (loop for kind in *core-kinds* collect (cons (core-kind-name kind) (archive-stated-sorts kind)))
  "(kind sort ..) for each kind of archive.")

;; Index: a call asks for a key by its name some thousand times

(defvar *archive-index* (make-hash-table :test #'equal)
  "(section) -> the first archive-sort of that name; (kind section) -> that of the kind; with the
name of a key behind, the archive-key.")

(defun archive-note-in-index (place item)
  (unless (gethash place *archive-index*) (setf (gethash place *archive-index*) item)))

(loop for (kind . sorts) in *archive-sorts*
      do (dolist (sort sorts)
           (let ((section (archive-sort-name sort)))
             (archive-note-in-index (list nil section) sort)
             (archive-note-in-index (list kind section) sort)
             (dolist (key (archive-sort-keys sort))
               (archive-note-in-index (list nil section (archive-key-name key)) key)
               (archive-note-in-index (list kind section (archive-key-name key)) key)))))

(defun archive-find-sort (kind word)
  "The sort of section WORD in archives of KIND, of any kind where that is nil; or nil."
  (values (gethash (list kind word) *archive-index*)))

(defun archive-find-key (kind section name)
  "The record of the key NAME of SECTION (its first word) in archives of KIND, of any kind where
that is nil; or nil."
  (values (gethash (list kind section name) *archive-index*)))

(defun archive-sorts (kind)
  "The sorts of section of an archive of KIND, in the order in which they are asked."
  (cdr (assoc kind *archive-sorts* :test #'equal)))

(defun archive-keys (kind section)
  "The keys of SECTION in archives of KIND, in the order in which they are asked."
  (let ((sort (archive-find-sort kind section)))
    (and sort (archive-sort-keys sort))))

(defun archive-kinds-with (section &optional name)
  "The kinds of archive that have SECTION, and the key NAME in it."
  (let ((place (cons section (and name (list name)))))
    (remove-if-not (lambda (kind) (gethash (cons kind place) *archive-index*))
                   (core-kind-names))))

(defun archive-all-sorts ()
  "The sorts of section of all kinds, each once."
  (remove-duplicates (loop for (nil . sorts) in *archive-sorts* append sorts)
                     :key #'archive-sort-name :test #'string= :from-end t))

(defun archive-all-keys (section)
  "The keys of SECTION in all kinds, those that are the same in several once."
  (remove-duplicates (loop for kind in (core-kind-names) append (archive-keys kind section))
                     :test #'equalp :from-end t))

(defun archive-default (key)
  "The default of KEY as text, or nil."
  (let ((default (archive-key-default key)))
    (cond ((stringp default) default)
          ((and (consp default) (member (archive-beside-how default) '(:with :unless)))
           (archive-beside-word default)))))

(defun archive-overrulable-p (key)
  "Whether an option of a call may overrule KEY: all of [system] but the count of sections."
  (and (string= (archive-key-section key) "system")
       (not (string= (archive-key-name key) "bodies"))))

(defun archive-option-keys (kind)
  "The keys that an option of a call may overrule in archives of KIND."
  (remove-if-not #'archive-overrulable-p (archive-keys kind "system")))

(defun archive-section-word (section)
  "The first word of a section's name: \"body\" of \"body 2\"."
  (subseq section 0 (position #\Space section)))

;; A value that does not fit

(defun archive-mismatch (key value trouble)
  "The sentence for a VALUE that is not what KEY wants."
  (format nil "~a must be ~a, found ~a~:[; ~a~;~]" (archive-key-name key)
          (archive-type-phrase (archive-key-type key)) (archive-value-shown value)
          (string= trouble "") trouble))

;; The table as text, for the manual

(defun archive-kinds-text (kinds)
  (if (equal kinds (core-kind-names)) "all" (format nil "~{~a~^, ~}" kinds)))

(defun archive-default-text (key)
  (let ((default (archive-key-default key)))
    (cond ((null default) "")
          ((eq default :required) "required")
          ((stringp default) (format nil "`~a`" default))
          (t (let ((other (archive-beside-other default)) (word (archive-beside-word default)))
               (ecase (archive-beside-how default)
                 (:when (format nil "required if `~a = ~a`" other word))
                 (:with (format nil "`~a`, beside `~a`" word other))
                 (:unless (format nil "required without `~a`~@[, else `~a`~]" other word))))))))

(defun archive-print-keys-table (stream)
  "The kinds and the table in markdown, a part for each section."
  (format stream "| kind | describes |~%|---|---|~%")
  (dolist (kind *core-kinds*)
    (format stream "| `~a` | ~a |~%" (core-kind-name kind) (core-kind-about kind)))
  (terpri stream)
  (dolist (sort (archive-all-sorts))
    (let ((rows (eq (archive-sort-form sort) :rows)) (meaning (archive-sort-meaning sort)))
      (format stream "### ~a~%~%~a~%~%"
              (if (string= (archive-sort-name sort) "top") "Before the first header"
                  (format nil "`[~a]`" (archive-heading sort)))
              (if rows (format nil "Rows: `~a`" meaning) (archive-capital meaning)))
      (unless rows (archive-print-section-table (archive-sort-name sort) stream)))))

(defun archive-capital (text)
  (format nil "~a~a." (string-upcase (subseq text 0 1)) (subseq text 1)))

(defun archive-heading (sort)
  (case (archive-sort-form sort)
    ((:counted :numbered) (format nil "~a k" (archive-sort-name sort)))
    (:named (format nil "~a name" (archive-sort-name sort)))
    (t (archive-sort-name sort))))

(defun archive-key-kinds (key)
  "The kinds of archive that have KEY just so."
  (remove-if-not (lambda (kind)
                   (equalp key (archive-find-key kind (archive-key-section key)
                                                 (archive-key-name key))))
                 (core-kind-names)))

(defun archive-print-section-table (section stream)
  (format stream "| key | kinds | value | default | meaning |~%|---|---|---|---|---|~%")
  (dolist (key (archive-all-keys section))
    (format stream "| `~a` | ~a | ~a | ~a | ~a |~%" (archive-key-name key)
            (archive-kinds-text (archive-key-kinds key))
            (archive-type-phrase (archive-key-type key)) (archive-default-text key)
            (archive-help-text key)))
  (terpri stream))
