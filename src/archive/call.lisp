;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A call taken apart: what is the system, what are the arguments and options, which of the forms
;;; of the function it is. Everything given becomes a named quantity in the table `given', on a
;;; level with the keys of the archive, which it overrules.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/check" "archive/results"))

(defstruct archive-call
  public archive kind
  (given (make-hash-table :test #'equal))   ; name -> value: arguments and options
  (values (make-hash-table :test #'equal))  ; name -> value computed or read in this call
  (needs (make-hash-table :test #'equal))   ; name -> archive-need
  (new '())                                 ; steps computed, newest first
  (facts '()))

(defparameter *archive-common-options* '("save" "verbose" "progress" "limit" "form" "result"))

(defun archive-split-arguments (arguments)
  "Two values: the leading arguments, and the options, equations at the end."
  (let ((first-option (or (position-if #'archive-equation-p arguments) (length arguments))))
    (when (some #'archive-holds-set-p arguments)
      (core-error "an argument holds a set { }, in which order and equal items are lost; use [ ]"))
    (dolist (late (nthcdr first-option arguments))
      (unless (archive-equation-p late)
        (core-error "options such as save = false come after all other arguments; found ~a after ~
                     one"
                    (core-words (list late)))))
    (values (subseq arguments 0 first-option) (nthcdr first-option arguments))))

(defun archive-system-p (argument public)
  "Whether ARGUMENT is a path or a description list."
  (and (or (core-public-kinds public) (core-public-trailing public))
       (or (stringp argument)
           (and (archive-list-p argument)
                (some (lambda (e) (and (archive-equation-p e) (member (cadr e) '($kind $dynarch))))
                      (cdr argument))))))

(defun archive-open-system (system)
  "The archive of a path, as given or found by Maxima's file_search, or of a description list."
  (if (stringp system)
      (archive-open (archive-found-path system))
      (archive-check-list system)))

(defun archive-found-path (path)
  (if (core-existing-file path)
      path
      (let ((found (core-attempt (lambda () ($file_search path)))))
        (if (stringp (car found)) (car found) path))))

(defun archive-new-call (public archive kind)
  (let ((call (make-archive-call :public public :archive archive :kind kind)))
    (setq *core-archive* archive)
    (when archive (setf (archive-call-facts call) (archive-facts (archive-description archive))))
    call))

(defun archive-give (call name value)
  (setf (gethash name (archive-call-given call)) value))

(defun archive-give-positional (call names values)
  (loop for name in (remove "&optional" names :test #'equal)
        for value in values
        do (archive-give call name value)))

(defun archive-give-trailing (call values)
  (let ((names (core-public-trailing (archive-call-public call))))
    (when (> (length values) (length names))
      (core-error "after the system ~:[only options~;~:*~{~a~^, ~} and options~] may follow, ~
                   found ~a"
                  names (core-words (list (nth (length names) values)))))
    (archive-give-positional call names values)))

(defun archive-form-fits (form values)
  "Whether the number of VALUES fits FORM = (kind name .. &optional name ..)."
  (let* ((names (cdr form)) (optional (position "&optional" names :test #'equal))
         (least (or optional (length names)))
         (most (if optional (1- (length names)) least)))
    (<= least (length values) most)))

(defun archive-matching-form (public values)
  (or (find-if (lambda (form) (archive-form-fits form values)) (core-public-forms public))
      (core-error "call it as ~{~a~^, or as ~}" (archive-call-patterns public))))

(defun archive-call-patterns (public)
  "The ways of calling PUBLIC, as a person types them."
  (let ((name (core-public-name public)))
    (append
     (when (core-public-kinds public)
       (list (format nil "~a(\"archive.txt\"~{, ~a~})" name (core-public-trailing public))))
     (loop for form in (core-public-forms public)
           collect (format nil "~a(~{~a~^, ~})" name
                           (remove "&optional" (cdr form) :test #'equal))))))

(defun archive-option-name (equation)
  "The name of an option. `verbose', `functions' and `values' are variables of Maxima's own and
arrive as their values."
  (let ((left (cadr equation)))
    (cond ((stringp left) left)
          ((member left '(nil t)) "verbose")
          ((eq left $functions) "functions")
          ((eq left $values) "values")
          ((symbolp left) (core-spelling left))
          (t (core-error "an option has the form name = value, found ~a; if the name has a value ~
                          in your session, quote it: 'name = value"
                         (core-words (list equation)))))))

(defparameter *archive-option-types*
  '((:truth "true or false" "save" "verbose" "progress" "simplify" "expanded" "eliminate" "solved"
     "matrices")
    (:seconds "a number of seconds, 0 for no limit" "limit")
    (:form "auto, canonical, factored or program" "form")
    (:function "lagrange, routh or hamilton" "function")
    (:file "a file name in double quotes" "result"))
  "What the value of an option may be, and the options of which that holds; other values are looked
at where they are used.")

(defun archive-option-fits (type value)
  (ecase type
    (:truth (member value '(nil t)))
    (:seconds (and (mnump value) (not (mnegp value))))
    (:form (member value '($auto $canonical $factored $program)))
    (:function (member value '($lagrange $routh $hamilton)))
    (:file (stringp value))))

(defun archive-check-option (option value)
  (let ((row (find-if (lambda (row) (member option (cddr row) :test #'string=))
                      *archive-option-types*)))
    (unless (or (null row) (archive-option-fits (first row) value))
      (core-error "the option ~a is ~a, found ~a" option (second row) (core-words (list value))))))

(defparameter *archive-program-form* '("form" $program))

(defun archive-check-program-form (call)
  "An error unless there is a program of what is called."
  (let* ((name (core-public-name (archive-call-public call)))
         (rule (core-find-rule name (archive-call-kind call)
                               (lambda (condition) (equal condition *archive-program-form*)))))
    (unless (and rule (equal (rule-given rule) *archive-program-form*))
      (core-error "form = program is for ~{~a~^, ~}; this function has none"
                  (archive-program-names)))))

(defun archive-option-of (condition)
  "The option that CONDITION, (name value), asks for, as an equation."
  (list '(mequal) (core-symbol (first condition)) (second condition)))

(defun archive-program-serves-p (name arguments)
  "Whether NAME has a program too, and the form is left to us."
  (and arguments
       (member name (archive-program-names) :test #'string=)
       (loop for equation in (nth-value 1 (archive-split-arguments arguments))
             never (and (eq (cadr equation) (core-symbol "form"))
                        (not (eq (caddr equation) '$auto))))))

(defun archive-program-names ()
  (sort (loop for name being the hash-keys of *core-rules* using (hash-value rules)
              when (find *archive-program-form* rules :key #'rule-given :test #'equal)
                collect name)
        #'string<))

(defun archive-overrulable-keys (kind)
  "Names of the keys of [system] that a call may overrule."
  (mapcar #'archive-key-name (archive-option-keys kind)))

(defun archive-overruled-groups (groups name value)
  "GROUPS with the statement NAME = VALUE in [system] instead of their own."
  (mapcar (lambda (group)
            (if (string= (archive-group-section group) "system")
                (let ((copy (copy-archive-group group)))
                  (setf (archive-group-statements copy)
                        (append (remove name (archive-group-statements group)
                                        :key #'archive-statement-key :test #'equal)
                                (list (make-archive-statement :key name :value value))))
                  copy)
                group))
          groups))

(defun archive-overruled (archive name value)
  "ARCHIVE as if its [system] had NAME = VALUE, checked like any other."
  (archive-check-groups (archive-path archive) (archive-text archive) (archive-parts archive)
                        (archive-overruled-groups (archive-groups archive) name value)))

(defun archive-known-options (call)
  (append (core-public-options (archive-call-public call))
          *archive-common-options*
          (archive-overrulable-keys (archive-call-kind call))))

(defun archive-give-options (call options)
  "Options become quantities; a key of [system] among them overrules the archive's."
  (let ((known (archive-known-options call)))
    (dolist (equation options)
      (let ((name (archive-option-name equation)))
        (unless (member name known :test #'equal)
          (core-error "there is no option ~a; the options are ~{~a~^, ~}" name
                      (sort (copy-list known) #'string<)))
        (archive-check-option name (caddr equation))
        (when (and (string= name "form") (eq (caddr equation) '$program))
          (archive-check-program-form call))
        (archive-give-option call name (caddr equation))))
    (when (eq (gethash "progress" (archive-call-given call) t) nil) (setq *core-progress* nil))))

(defun archive-give-option (call name value)
  "A key that a rule builds on, as rayleigh where there are dampers, is given to the rule only."
  (let* ((kind (archive-call-kind call))
         (key (and (archive-call-archive call)
                   (member name (archive-overrulable-keys kind) :test #'equal))))
    (when key (archive-overrule call name value))
    (unless (and key (core-find-rule name kind (constantly nil)))
      (archive-give call name value))))

(defun archive-overrule (call name value)
  (setf (archive-call-archive call) (archive-overruled (archive-call-archive call) name value)
        (archive-call-facts call)
        (archive-facts (archive-description (archive-call-archive call)))))

(defun archive-option (call name default)
  (gethash name (archive-call-given call) default))
