;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; From groups of statements to a checked description: kinds, sections, keys, types, defaults. An
;;; unknown key is a warning and stays in the file; a required one that is missing is an error,
;;; which names an unknown one that may have been meant.
;;; Look first at archive-checked, at the end.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/groups" "archive/keys" "archive/parser" "archive/types"))

;;; Keys of one section

(defun archive-key-names (kind word)
  (mapcar #'archive-key-name (archive-keys kind word)))

(defun archive-table-word (section)
  "The name of the section of the table for the group SECTION."
  (if (string= section "archive") "top" (archive-section-word section)))

(defun archive-check-repeated (group)
  "A key stands once in its section."
  (let ((seen '()))
    (dolist (statement (archive-group-statements group))
      (let* ((key (archive-statement-key statement))
             (first (find key seen :key #'archive-statement-key :test #'equal)))
        (when (and key first)
          (core-fault (archive-group-section group) key "~a stands twice~a; leave one of them out"
                      key
                      (if (archive-statement-line first)
                          (format nil ", in line ~d and in line ~d" (archive-statement-line first)
                                  (archive-statement-line statement))
                          "")))
        (push statement seen)))))

(defun archive-unknown-statements (kind group)
  (let ((known (archive-key-names kind (archive-table-word (archive-group-section group)))))
    (remove-if (lambda (statement) (member (archive-statement-key statement) known :test #'equal))
               (archive-group-statements group))))

(defun archive-unknown-advice (kind word name)
  "What to tell of the unknown key NAME."
  (let ((near (core-nearest name (archive-key-names kind word)))
        (kinds (archive-kinds-with word name)))
    (cond (kinds (format nil "it is a key of the kind~:[~;s~] ~{~a~^, ~}" (cdr kinds) kinds))
          (near (format nil "did you mean ~a?" near))
          (t "it is not read"))))

(defun archive-warn-unknown (kind group)
  (dolist (statement (archive-unknown-statements kind group))
    (core-warn "~a~a: unknown key ~a; ~a" (archive-group-section group)
               (archive-statement-place statement)
               (archive-statement-key statement)
               (archive-unknown-advice kind (archive-table-word (archive-group-section group))
                                       (archive-statement-key statement)))))

(defun archive-fault-missing (kind group key reason)
  "The required KEY is missing; an unknown key near to it is named."
  (let* ((word (archive-table-word (archive-group-section group)))
         (names (archive-key-names kind word))
         (meant (find-if (lambda (statement)
                           (equal (archive-key-name key)
                                  (core-nearest (archive-statement-key statement) names)))
                         (archive-unknown-statements kind group))))
    (core-fault (archive-group-section group) nil "the key ~a is missing~a; ~a"
                (archive-key-name key) reason
                (if meant
                    (format nil "is ~a~a meant for it?" (archive-statement-key meant)
                            (archive-statement-place meant))
                    (format nil "give ~a = ~a" (archive-key-name key)
                            (archive-type-phrase (archive-key-type key)))))))

(defun archive-given-p (group name)
  (and (archive-find-statement group name) t))

(defun archive-given-word (group name)
  "The value of the key NAME as text, or nil."
  (let ((statement (archive-find-statement group name)))
    (and statement (symbolp (archive-statement-value statement))
         (archive-statement-value statement)
         (core-spelling (archive-statement-value statement)))))

(defun archive-missing-reason (key group)
  "Why KEY, which is absent, must be there, or nil: \"\", or the key that asks for it."
  (let ((default (archive-key-default key)))
    (cond ((eq default :required) "")
          ((atom default) nil)
          (t (let ((other (archive-beside-other default)) (word (archive-beside-word default)))
               (ecase (archive-beside-how default)
                 (:with nil)
                 (:when (and (equal (archive-given-word group other) word)
                             (format nil ", which ~a = ~a needs" other word)))
                 (:unless (unless (archive-given-p group other)
                            (format nil ", and so is ~a" other)))))))))

(defvar *archive-default-values* (make-hash-table :test #'eq)
  "Key -> its default as a checked value: its text is read once.")

(defun archive-default-value (key)
  "The default of KEY as a checked value."
  (multiple-value-bind (value known) (gethash key *archive-default-values*)
    (if known value (setf (gethash key *archive-default-values*) (archive-read-default key)))))

(defun archive-read-default (key)
  (values (archive-typed (archive-key-type key) (archive-parse-value (archive-default key)))))

(defun archive-converted (section key value)
  (multiple-value-bind (converted trouble) (archive-typed (archive-key-type key) value)
    (if trouble
        (core-fault section (archive-key-name key) "~a" (archive-mismatch key value trouble))
        converted)))

(defun archive-default-given-p (group key)
  "Whether the value of KEY in GROUP is its default, typed."
  (alike1 (archive-statement-value (archive-find-statement group (archive-key-name key)))
          (archive-default-value key)))

(defun archive-check-companion (group key)
  "An error where KEY, given with another value than its default, would have no effect beside the
other keys of GROUP."
  (let* ((default (archive-key-default key)) (name (archive-key-name key))
         (section (archive-group-section group)))
    (destructuring-bind (&optional condition other value) (if (consp default) default '())
      (case condition
        (:when (unless (archive-given-p group other) ; else another field is meant for the time
                 (core-fault section name "~a has an effect with ~a = ~a only; write ~a = ~a, or ~
                                           leave ~a out"
                             name other value other value name)))
        (:with (unless (or (archive-given-p group other) (archive-default-given-p group key))
                 (core-fault section name "~a has an effect beside ~a only; leave it out, or give ~
                                           ~a" name other other)))
        (:unless (when (and (archive-given-p group other) (null value))
                   (core-fault section name "~a and ~a are both given; leave one of them out"
                               name other)))))))

(defun archive-key-equation (kind group key)
  "The equation key = value of the description, in a list; nil where the key is absent."
  (let* ((name (archive-key-name key))
         (statement (archive-find-statement group name))
         (reason (and (not statement) (archive-missing-reason key group))))
    (cond (statement
           (archive-check-companion group key)
           (list (archive-equation (core-symbol name)
                                   (archive-converted (archive-group-section group) key
                                                      (archive-statement-value statement)))))
          (reason (archive-fault-missing kind group key reason))
          ((archive-default key)
           (list (archive-equation (core-symbol name) (archive-default-value key))))
          (t nil))))

(defun archive-checked-keys (kind group)
  "The equations of GROUP in the order of the table."
  (archive-check-repeated group)
  (archive-warn-unknown kind group)
  (loop for key in (archive-keys kind (archive-table-word (archive-group-section group)))
        append (archive-key-equation kind group key)))

;;; Kind and version

(defun archive-checked-kind (groups)
  "The kind of system; the version is looked at before."
  (let ((top (or (archive-find-group groups "archive") (make-archive-group :section "archive"))))
    (archive-check-repeated top)
    (archive-key-equation nil top (archive-find-key nil "top" "dynarch"))
    (core-spelling (third (first (archive-key-equation nil top
                                                       (archive-find-key nil "top" "kind")))))))

;;; Which sections there are

(defun archive-section-number (section)
  "k of \"body k\", or nil."
  (let* ((blank (position #\Space section)) (digits (and blank (subseq section (1+ blank)))))
    (and digits (plusp (length digits)) (every #'digit-char-p digits) (char/= (char digits 0) #\0)
         (< (length digits) 8) (parse-integer digits))))

(defun archive-named-as-sort-p (sort section)
  "Whether SECTION is named as SORT says: \"body 2\", \"frame orbit\", \"branches\"."
  (let ((rest (subseq section (min (length section) (length (archive-section-word section))))))
    (ecase (archive-sort-form sort)
      ((:one :rows) (string= rest ""))
      ((:counted :numbered) (and (archive-section-number section) t))
      (:named (and (> (length rest) 1) (alpha-char-p (char rest 1))
                   (every (lambda (c) (or (alphanumericp c) (char= c #\_))) (subseq rest 1)))))))

(defun archive-warn-section (kind group)
  (let* ((section (archive-group-section group))
         (word (archive-section-word section))
         (sort (archive-find-sort nil word))
         (near (core-nearest word (mapcar #'archive-sort-name (archive-sorts kind)))))
    (core-warn "~@[line ~d: ~]unknown section [~a]; ~a" (archive-group-line group) section
               (cond ((and sort (archive-find-sort kind (archive-table-word section)))
                      (format nil "it is written [~a]" (archive-heading sort)))
                     (sort (format nil "it belongs to the kind ~{~a~^, ~}"
                                   (archive-kinds-with word)))
                     (near (format nil "did you mean [~a]?"
                                   (archive-heading (archive-find-sort kind near))))
                     (t "it is not read")))))

(defun archive-known-groups (kind groups)
  "The groups that an archive of KIND has; a warning for each other one."
  (remove-if-not (lambda (group)
                   (let* ((section (archive-group-section group))
                          (sort (archive-find-sort kind (archive-table-word section))))
                     (or (and sort (archive-named-as-sort-p sort section))
                         (progn (archive-warn-section kind group) nil))))
                 groups))

(defun archive-check-repeated-sections (groups)
  (loop for (group . rest) on groups
        do (let ((again (archive-find-group rest (archive-group-section group))))
             (when again
               (core-error "section [~a] stands twice~@[, in line ~d~]~@[ and in line ~d~]; ~
                            leave one of them out"
                           (archive-group-section group) (archive-group-line group)
                           (archive-group-line again))))))

(defun archive-groups-like (groups word)
  (remove-if-not (lambda (group)
                   (string= word (archive-section-word (archive-group-section group)))) groups))

(defun archive-counted-groups (groups all-groups word counting count)
  "The groups \"WORD 1\" to \"WORD COUNT\", in this order; one too few or too many is an error.
COUNTING is the key of [system] that gives the number."
  (dolist (group (archive-groups-like groups word))
    (when (> (archive-section-number (archive-group-section group)) count)
      (core-fault (archive-group-section group) nil
                  "there are ~d ~a; set ~a = ~d, or leave the section out" count counting counting
                  (archive-section-number (archive-group-section group)))))
  (loop for k from 1 to count
        collect (let ((section (format nil "~a ~d" word k)))
                  (or (archive-find-group groups section)
                      (archive-fault-section section counting count all-groups)))))

(defun archive-fault-section (section counting count groups)
  "The SECTION that the key COUNTING asks for is missing; a misspelt one is named."
  (let ((meant (core-nearest section (mapcar #'archive-group-section groups))))
    (core-fault "system" counting
                "~a = ~d, and section [~a] is missing~@[; is [~a] meant for it?~]" counting count
                section
                (and meant (not (archive-find-sort nil (archive-section-word meant))) meant))))

;;; Sections of rows

(defun archive-row-value (group k statement)
  (let* ((row (archive-statement-value statement))
         (fields (archive-right-side row)))
    (unless (archive-list-p fields)
      (core-fault (archive-group-section group) k
                  "row ~d must be a list such as [1, 2, L, L1, i1], found ~a" k
                  (archive-value-shown row)))
    row))

(defun archive-rows-equation (section group)
  (archive-equation (core-symbol section)
                    (archive-list (and group
                                       (loop for statement in (archive-group-statements group)
                                             for k from 1
                                             collect (archive-row-value group k statement))))))

;;; The whole

(defun archive-section-equation (kind group)
  "\"body 1\" = [parent = 0, ...]"
  (archive-equation (archive-group-section group)
                    (archive-list (archive-checked-keys kind group))))

(defun archive-sort-equations (kind sort known groups system)
  "The equations of the sections of SORT, one of KIND: of the KNOWN ones among GROUPS."
  (let ((word (archive-sort-name sort)) (counting (archive-sort-detail sort)))
    (flet ((equations (groups)
             (mapcar (lambda (group) (archive-section-equation kind group)) groups)))
      (ecase (archive-sort-form sort)
        (:one '())
        (:rows (list (archive-rows-equation word (archive-find-group known word))))
        ((:named :numbered) (equations (archive-groups-like known word)))
        (:counted (equations (archive-counted-groups
                              known groups word counting
                              (third (find (core-symbol counting) system :key #'second)))))))))

(defun archive-system-needed-p (kind)
  "Whether [system] has keys that an archive of KIND must state."
  (some (lambda (key) (consp (member (archive-key-default key) '(:required))))
        (archive-keys kind "system")))

(defun archive-system-group (kind groups)
  "The group [system]; an empty one where it is left out and nothing in it is required."
  (or (archive-find-group groups "system")
      (let ((meant (core-nearest "system" (mapcar #'archive-group-section groups))))
        (when (or meant (archive-system-needed-p kind))
          (core-error "there is no section [system]~@[; is [~a] meant for it?~]" meant))
        (make-archive-group :section "system"))))

(defun archive-completed (kind system groups)
  "Two values: SYSTEM and GROUPS with what the keys and sections of this KIND imply."
  (let ((completed (core-kind-completed (core-find-kind kind))))
    (if completed (core-call completed system groups) (values system groups))))

(defun archive-checked (groups)
  "The checked description of GROUPS."
  (let ((kind (archive-checked-kind groups)))
    (archive-check-repeated-sections groups)
    (let* ((known (archive-known-groups kind groups))
           (top (archive-find-group known "archive"))
           (system (archive-checked-keys kind (archive-system-group kind groups)))
           (head (remove '$dynarch (archive-checked-keys kind top) :key #'second)))
      (multiple-value-setq (system known) (archive-completed kind system known))
      (archive-list (append head system
                            (loop for sort in (archive-sorts kind)
                                  append (archive-sort-equations kind sort known groups
                                                                 system)))))))
