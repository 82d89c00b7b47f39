;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Which rule serves a quantity in a call, and what it depends on: keys of the description,
;;; arguments, options, results edited by hand. The digest `from' of a result is made of these, and
;;; known before anything is computed. Look first at archive-rule, then at archive-needs.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/call" "archive/groups" "archive/results" "archive/speller"
                "archive/store" "archive/types"))

(defstruct archive-need
  keys     ; keys of [system] the quantity depends on; "*" is the whole structure
  extras)  ; arguments, options and hand-edited results it depends on, as text

(defparameter *archive-program-form* '("form" $program)
  "The condition of a rule that gives a program.")

(defun archive-rule (call name)
  (core-find-rule name (archive-call-kind call)
                  (lambda (condition) (archive-meets-p call condition))))

(defun archive-act (call)
  "The rule for what CALL does at its end, or nil."
  (core-find-rule (core-public-name (archive-call-public call)) (archive-call-kind call)
                  (lambda (condition) (archive-meets-p call condition))
                  t))

(defun archive-meets-p (call condition)
  "Whether the call or the archive gives the option CONDITION, or (option value) with this value;
:file: whether the system is a file; (:edited name): whether its result NAME was edited by hand;
(:without section): whether SECTION has no rows."
  (cond ((eq condition :file)
         (and (archive-call-archive call) (archive-path (archive-call-archive call)) t))
        ((stringp condition)
         (or (nth-value 1 (gethash condition (archive-call-given call)))
             (nth-value 1 (archive-key-value call condition))))
        ((eq (first condition) :edited)
         (archive-edited-p call (second condition)))
        ((eq (first condition) :without)
         (equal (multiple-value-list (archive-key-value call (second condition)))
                '(((mlist simp)) t)))
        (t (eq (archive-option call (first condition) nil) (second condition)))))

(defun archive-key-value (call key)
  (let ((equation (and (archive-call-archive call)
                       (find (core-symbol key)
                             (cdr (archive-description (archive-call-archive call)))
                             :key (lambda (e) (and (archive-equation-p e) (cadr e)))))))
    (values (and equation (caddr equation)) (and equation t))))

(defun archive-edited-p (call name)
  "The digest of the stored result NAME when it was edited by hand, else nil."
  (let ((section (archive-own-section call name)))
    (and section (archive-edited-digest section))))

(defun archive-input-name (input) (if (consp input) (car input) input))

(defun archive-missing (call name)
  "The error for a quantity that neither the call nor the archive gives."
  (let ((archive (archive-call-archive call)) (kind (archive-call-kind call)))
    (cond ((archive-wanted-option name kind)
           (core-error "give the option ~a = .. as well" (archive-wanted-option name kind)))
          ((and archive (gethash name *core-publics*))
           (core-error "~a is for ~{~a~^, ~} archives, and ~:[this description~;~:*~a~] is of ~
                        kind ~a"
                       name (core-public-kinds (gethash name *core-publics*))
                       (archive-path archive) kind))
          (archive
           (core-error "~a is needed, and ~:[this description~;~:*~a~] does not give it; write ~
                        ~a = .. into [system] or into the call"
                       name (archive-path archive) name))
          (t (core-error "~a is needed; give it as an argument or as an option ~a = .."
                         name name)))))

(defun archive-wanted-option (name kind)
  "An option without which there is no rule for NAME in archives of KIND, or nil."
  (let ((rule (core-find-rule name kind (constantly t))))
    (and rule (null (core-find-rule name kind (constantly nil)))
         (archive-input-name (rule-given rule)))))

;;; What a quantity depends on

(defun archive-needs (call name)
  "The archive-need of the quantity NAME."
  (or (gethash name (archive-call-needs call))
      (let ((need (make-archive-need :keys '() :extras '())))
        (setf (gethash name (archive-call-needs call)) need)
        (archive-collect-needs call name need)
        need)))

(defun archive-collect-needs (call name need)
  (multiple-value-bind (value given) (gethash name (archive-call-given call))
    (let ((rule (archive-rule call name)))
      (cond (given
             (push (archive-option-text name value) (archive-need-extras need)))
            ((equal name "description") (push "*" (archive-need-keys need)))
            ((null rule) (push name (archive-need-keys need)))
            (t (dolist (input (archive-rule-sources rule))
                 (archive-add-needs call need (archive-input-name input)))
               (when (rule-function rule) (archive-add-edited call name need)))))))

(defun archive-rule-sources (rule)
  "What a quantity by RULE depends on: the condition of the rule too."
  (append (archive-condition-sources (rule-given rule))
          (cond ((rule-same rule) (list (rule-same rule)))
                ((rule-record rule) (list (rule-record rule)))
                ((rule-tried rule) (list (rule-tried rule)))
                ((rule-later rule) (list (rule-later rule)))
                (t (rule-inputs rule)))))

(defun archive-condition-sources (condition)
  (cond ((or (null condition) (eq condition :file)) '())
        ((and (consp condition) (member (first condition) '(:edited :without))) '())
        (t (list condition))))

(defun archive-add-needs (call need name)
  (let ((more (archive-needs call name)))
    (setf (archive-need-keys need)
          (union (archive-need-keys need) (archive-need-keys more) :test #'equal)
          (archive-need-extras need)
          (union (archive-need-extras need) (archive-need-extras more) :test #'equal))))

(defun archive-add-edited (call name need)
  "A result edited by hand is itself something to depend on."
  (let ((edited (archive-edited-p call name)))
    (when edited (push (format nil "~a edited ~a" name edited) (archive-need-extras need)))))

(defun archive-own-section (call name)
  "The section with the whole result NAME of this call's arguments and options, or nil."
  (and (archive-call-archive call) (archive-path (archive-call-archive call))
       (gethash name *core-publics*)
       (let ((section (archive-stored-section (archive-call-archive call) name
                                              (archive-options-of call name))))
         (and section (not (archive-partial-p section)) section))))

(defun archive-edited-extra-p (extra) (search " edited sha256:" extra))

(defun archive-options-of (call name)
  "The arguments and options of the call that NAME depends on, as one text."
  (let* ((need (archive-needs call name))
         (extras (remove-if #'archive-edited-extra-p (archive-need-extras need))))
    (format nil "~{~a~^, ~}"
            (sort (union extras (archive-overruled-texts call need) :test #'string=) #'string<))))

(defun archive-overruled-texts (call need)
  "The keys of [system] that the call overrules and that count for NEED, as texts."
  (loop with kind = (archive-call-kind call)
        for (key . value) in (archive-call-overruled call)
        when (archive-counts-p "system" key kind (archive-counted-keys need))
          collect (archive-option-text key value)))

(defun archive-option-text (name value)
  (format nil "~a = ~a" name (archive-spell value)))

(defun archive-counted-keys (need)
  "The keys of [system] that count in `from': what is assumed of the parameters always does."
  (union '("parameters") (archive-need-keys need) :test #'equal))

(defun archive-counted-extras (need name)
  "The extras of NEED that count in what NAME depends on, in one order."
  (let ((own (format nil "~a edited " name)))
    (sort (remove-if (lambda (extra) (eql 0 (search own extra)))
                     (copy-list (archive-need-extras need)))
          #'string<)))

(defun archive-digest-of (call name)
  "The digest `from' of the result NAME: what it was computed from."
  (let ((need (archive-needs call name)))
    (archive-from-digest (archive-call-archive call) (archive-counted-keys need)
                         (archive-counted-extras need name))))

(defun archive-sources-of (call name)
  "The same as data, which are quicker to compare than to spell."
  (let ((need (archive-needs call name)))
    (list (archive-values-of call (archive-counted-keys need))
          (archive-counted-extras need name))))

(defun archive-values-of (call keys)
  "What KEYS of the description stand for, copied, once in a CALL."
  (let ((known (assoc keys (archive-call-sources call) :test #'equal)))
    (unless known
      (setq known (cons keys (archive-copied (archive-counted-values (archive-call-archive call)
                                                                     keys))))
      (push known (archive-call-sources call)))
    (cdr known)))

(defun archive-copied (e)
  "E with conses of its own: a person may write into a list that he gave. Lists may be long."
  (if (atom e)
      e
      (let* ((copy (list (archive-copied (car e)))) (end copy))
        (loop while (consp (setq e (cdr e)))
              do (setf (cdr end) (list (archive-copied (car e))) end (cdr end)))
        (setf (cdr end) e)
        copy)))
