;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The dialog: asks for the keys of an archive in the order of the table of keys, the system
;;; first, then section by section; then the description is shown, tried, changed until the person
;;; is content, and written. An item is changed by its number, one that was passed over by its key.
;;; End of input leaves nothing behind. Look first at archive-dialog, at the end.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/keys" "archive/open" "archive/parser" "archive/questions" "archive/store"
                "archive/types"))

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
          (t (let ((answered (archive-answered answers section (archive-beside-other default)))
                   (word (archive-beside-word default)))
               (ecase (archive-beside-how default)
                 (:when (and (equal answered word) :needed))
                 (:with (and answered :open))
                 (:unless (if answered (and word :open) :needed))))))))

(defun archive-ask-section (kind word section)
  "Answers to the keys of one SECTION, in their order."
  (let ((answers '()) (rest nil))
    (dolist (key (archive-keys kind word) (nreverse answers))
      (let ((need (archive-key-needed key answers section)))
        (when (and need (archive-key-question key) (or (eq need :needed) (not rest)))
          (let ((text (archive-ask-key key section (eq need :needed))))
            (cond ((eq text :rest) (setq rest t))
                  (text
                   (push (make-archive-item :section section :key key :text text) answers)
                   (archive-say-implied key answers)))))))))

(defun archive-say-implied (key answers)
  "Says what an answer to KEY implies beside the other ANSWERS."
  (when (and (eq (archive-key-type key) :graph) (not (archive-answered answers "system" "sign")))
    (archive-say "  A graph as a list implies sign = generator: a positive resistance feeds ~
                  energy. Give sign = passive where it takes energy.")))

(defun archive-ask-count (sort)
  "How many sections of the SORT there are."
  (loop
    (let ((answer (archive-ask-line (format nil "Number of sections [~a k], ~a [0]"
                                            (archive-sort-name sort) (archive-sort-meaning sort)))))
      (cond ((string= answer "") (return 0))
            ((and (every #'digit-char-p answer) (< (length answer) 4))
             (return (parse-integer answer)))
            (t (archive-say "  [~a k]: ~a. Type how many there are, such as 1; Enter takes 0."
                            (archive-sort-name sort) (archive-sort-meaning sort)))))))

(defun archive-ask-names (sort)
  "Names of the sections of the SORT, one after another, until an empty answer."
  (let ((word (archive-sort-name sort)) (meaning (archive-sort-meaning sort)) (names '()))
    (loop
      (let ((name (archive-ask-line (format nil "Name of a [~a], ~a [Enter: no more]" word
                                            meaning))))
        (cond ((string= name "") (return (nreverse names)))
              ((member name names :test #'string=)
               (archive-say "  There is a [~a ~a] already." word name))
              ((archive-plain-name-p name) (push name names))
              (t (archive-say "  [~a]: ~a. Type a name, such as ~a1; Enter ends." word meaning
                              word)))))))

(defun archive-plain-name-p (text)
  (and (null (archive-trouble (lambda () (archive-parse-value text))))
       (archive-symbol-p (archive-parse-value text))))

(defun archive-row-form (section) (archive-sort-meaning (archive-find-sort nil section)))

(defun archive-ask-rows (section)
  "The rows of SECTION, one a line, until an empty answer."
  (archive-say "  [~a]: one row a line, ~a; Enter ends." section (archive-row-form section))
  (loop for n from 1
        for row = (archive-ask-good-row section n)
        until (string= row "")
        collect (make-archive-item :section section :key nil :text row)))

(defun archive-ask-good-row (section n)
  (archive-ask-row section (format nil "row ~d [Enter: no more]" n) '("")))

(defun archive-ask-row (section what plain)
  "A row of SECTION, or one of the PLAIN answers."
  (loop
    (let* ((row (archive-ask-line (format nil "~a: ~a" section what)))
           (trouble (and (string/= row "?") (not (member row plain :test #'string=))
                         (archive-row-trouble section row))))
      (cond ((string= row "?") (archive-say "  ~a" (archive-row-form section)))
            (trouble (archive-say "  ~a" trouble))
            (t (return row))))))

(defun archive-section-names (sort answers)
  "Names of the sections of one SORT."
  (let ((word (archive-sort-name sort)))
    (ecase (archive-sort-form sort)
      (:one (list word))
      (:counted (loop for k from 1 to (parse-integer (archive-answered answers "system"
                                                                       (archive-sort-detail sort)))
                      collect (format nil "~a ~d" word k)))
      (:numbered (loop for k from 1 to (archive-ask-count sort)
                       collect (format nil "~a ~d" word k)))
      (:named (mapcar (lambda (name) (format nil "~a ~a" word name))
                      (archive-ask-names sort))))))

(defun archive-ask-title (kind)
  (let* ((key (archive-find-key kind "top" "title"))
         (text (archive-ask-key key "top" nil)))
    (when (stringp text) (list (make-archive-item :section "top" :key key :text text)))))

(defun archive-ask-sort (kind sort answers)
  "Answers to all sections of one SORT, after ANSWERS."
  (let ((word (archive-sort-name sort)) (instead (core-kind-instead (core-find-kind kind))))
    (cond ((string= word "top") '())
          ((not (eq (archive-sort-form sort) :rows))
           (loop for section in (archive-section-names sort answers)
                 append (archive-ask-section kind word section)))
          ((and instead (archive-answered answers "system" instead)) '())
          (t (archive-ask-rows word)))))

(defun archive-ask-sections (kind)
  "All answers but the title, in the order of the table."
  (let ((answers '()))
    (dolist (sort (archive-sorts kind) answers)
      (setq answers (append answers (archive-ask-sort kind sort answers))))))

(defun archive-ask-kind (kinds)
  (if (null (cdr kinds))
      (car kinds)
      (loop
        (let ((answer (archive-ask-line (format nil "Kind of system (~{~a~^, ~})" kinds))))
          (when (member answer kinds :test #'string=) (return answer))
          (archive-say "  Type one of ~{~a~^, ~}." kinds)))))

;;; The description as it stands

(defun archive-text-of-answers (kind answers)
  "The archive that ANSWERS make."
  (with-output-to-string (out)
    (format out "dynarch = 1~%kind = ~a~%" kind)
    (let ((section "top"))
      (dolist (answer answers)
        (unless (equal section (archive-item-section answer))
          (setq section (archive-item-section answer))
          (format out "~%[~a]~%" section))
        (format out "~a~%" (archive-item-line answer))))))

(defun archive-item-line (item)
  "ITEM as it stands in an archive."
  (format nil "~@[~a = ~]~a"
          (and (archive-item-key item) (archive-key-name (archive-item-key item)))
          (archive-item-text item)))

(defun archive-echo (items)
  (archive-say "The description:")
  (loop for item in items for n from 1
        do (archive-say "~3d  ~@[~a: ~]~a" n
                        (and (string/= (archive-item-section item) "top")
                             (archive-item-section item))
                        (archive-item-line item))))

;;; Changes

(defun archive-new-text (item)
  "What the person wants instead of the text of ITEM; that text where no answer is given, nil where
it is to go."
  (let* ((key (archive-item-key item)) (section (archive-item-section item))
         (present (archive-item-text item))
         (text (if key
                   (archive-ask-key key section nil present)
                   (archive-new-row section present))))
    (cond ((eq text :none) nil)
          ((stringp text) text)
          (t present))))

(defun archive-new-row (section present)
  (let ((row (archive-ask-row section (format nil "row ~a" (archive-present-text present))
                              '("" "-"))))
    (cond ((string= row "") nil)
          ((string= row "-") :none)
          (t row))))

(defun archive-changed-item (items item)
  "ITEMS after the person has changed ITEM among them."
  (setf (archive-item-text item) (archive-new-text item))
  (if (archive-item-text item) items (remove item items)))

(defun archive-named-key (kind answer items)
  "Section and key that ANSWER names, `field', `title' or `body 1: inertia', or nil."
  (let* ((colon (position #\: answer))
         (name (string-trim " " (if colon (subseq answer (1+ colon)) answer)))
         (section (cond (colon (string-trim " " (subseq answer 0 colon)))
                        ((string= name "title") "top")
                        (t "system")))
         (key (and (or (member section '("system" "top") :test #'string=)
                       (find section items :key #'archive-item-section :test #'string=))
                   (archive-find-key kind (archive-section-word section) name))))
    (and key (values section key))))

(defun archive-item-of (items section key)
  (find-if (lambda (item)
             (and (string= section (archive-item-section item)) (eq key (archive-item-key item))))
           items))

(defun archive-with-item (items new)
  "ITEMS with NEW behind the last one of its section, or first of all."
  (let ((last (position (archive-item-section new) items :key #'archive-item-section
                        :test #'string= :from-end t)))
    (append (subseq items 0 (if last (1+ last) 0)) (list new)
            (nthcdr (if last (1+ last) 0) items))))

(defun archive-change-named (items section key)
  "ITEMS after the person has given a value to KEY of SECTION."
  (let ((item (or (archive-item-of items section key)
                  (make-archive-item :section section :key key :text nil))))
    (if (member item items)
        (archive-changed-item items item)
        (archive-changed-item (archive-with-item items item) item))))

(defun archive-change (kind items answer)
  "ITEMS after the change that ANSWER asks for: a number of the echo, or a key."
  (let ((number (and (plusp (length answer)) (every #'digit-char-p answer) (< (length answer) 5)
                     (parse-integer answer))))
    (multiple-value-bind (section key) (archive-named-key kind answer items)
      (cond ((and number (<= 1 number (length items)))
             (archive-changed-item items (nth (1- number) items)))
            (key (archive-change-named items section key))
            (t (archive-say "  Type a number from 1 to ~d, a key such as field, or a section and ~
                             its key such as body 1: inertia."
                            (length items))
               items)))))

(defun archive-ask-changes (kind items trial)
  "Shows the description until the person is content and it passes all checks; returns its text.
What the function that was called finds wrong with it is shown too, and may be kept."
  (loop
    (archive-echo items)
    (let* ((text (archive-text-of-answers kind items))
           (fault (archive-text-trouble text))
           (trouble (or fault (funcall trial text))))
      (when trouble (archive-say "  ~a" trouble))
      (let ((answer (archive-ask-line
                     (format nil
                             "Number or key of an item to change~:[ ~
                              [Enter: ~:[all is right~;keep it so~]]~;~]"
                             fault trouble))))
        (if (and (string= answer "") (not fault))
            (return text)
            (setq items (archive-change kind items answer)))))))

;;; The file

(defun archive-ask-file (kind)
  "The file to write; one that is there is replaced only after `yes'."
  (loop
    (let* ((answer (archive-ask-line (format nil "File [~a.txt]" kind)))
           (file (if (string= answer "") (format nil "~a.txt" kind) (string-trim "\"" answer))))
      (when (or (not (core-existing-file file))
                (archive-yes-p (format nil "~a exists; replace it? (yes or no)" file)))
        (return file)))))

(defun archive-dialog (name kinds trial)
  "Asks for the description of a system of one of KINDS for the function NAME; returns the path of
the archive written. TRIAL tells what is wrong with a text, or nil."
  (let ((*archive-fresh-input* (null $load_pathname)) (*archive-asked* '()))
    (archive-say "~a: description of a system. ? explains a question, Enter takes the answer in ~
                  [ ], . takes them all to the end of a section."
                 name)
    (let* ((kind (archive-ask-kind kinds))
           (sections (archive-ask-sections kind))
           (text (archive-ask-changes kind (append (archive-ask-title kind) sections) trial))
           (file (archive-ask-file kind)))
      (archive-write-new file text)
      (archive-say "The description is in ~a. The same again without questions:~%~a(\"~a\");"
                   file name file)
      file)))
