;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Options of a call: their names, what their values may be, and whether they do anything. Beside
;;; the common ones an option must occur among what the target needs: an input or a condition of
;;; one of the rules by which it is computed, or a key of [system] that one of them reads. Any
;;; other would be without effect, silently, and is refused; a misspelt one with the nearest name.
;;; Look first at archive-give-options, then at archive-taken-options.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/argument_types" "archive/call" "archive/groups" "archive/keys"
                "archive/names" "archive/needs" "archive/open" "archive/results"
                "archive/types" "core/nearest"))

(defun archive-option-name (equation)
  (let ((left (cadr equation)))
    (cond ((stringp left) left)
          ((and left (symbolp left) (not (eq left t))) (core-spelling left))
          (t (core-error "an option has the form name = value, found ~a; if the name has a value ~
                          in your session, quote it: 'name = value~:[~; (`on' is true in Maxima, ~
                          `off' and `verbose' are false; the option verbose is true or false)~]"
                         (core-words (list equation)) (member left '(nil t)))))))

(defparameter *archive-option-phrases*
  '((:truth . "true or false")
    (:seconds . "a number of seconds, 0 for no limit")
    (:factor . "a number from 1 to 100: how many times the usual limits of size hold")
    (:file . "a file name in double quotes"))
  "What a value of each type of option is.")

(defun archive-option-fits (type value)
  "Whether VALUE is of TYPE, as core-option states it."
  (case type
    (:truth (member value '(nil t)))
    (:seconds (and (mnump value) (not (mnegp value))))
    (:factor (and (mnump value) (not (mnegp (sub value 1))) (not (mnegp (sub 100 value)))))
    (:file (stringp value))
    (t (member value (mapcar #'core-symbol type)))))

(defun archive-check-option (option value)
  (let ((type (gethash option *core-options*)))
    (unless (or (null type) (archive-option-fits type value))
      (core-error "the option ~a is ~a, found ~:[~a~;\"~a\"~]~@[; did you mean ~a?~]" option
                  (if (consp type) (core-choice type) (cdr (assoc type *archive-option-phrases*)))
                  (stringp value) (core-words (list value))
                  (and (consp type) (core-nearest (core-words (list value)) type))))))

(defun archive-check-program-form (call)
  "An error unless there is a program of what is called."
  (let* ((name (core-public-name (archive-call-public call)))
         (rule (core-find-rule name (archive-call-kind call)
                               (lambda (condition) (equal condition *archive-program-form*)))))
    (unless (and rule (equal (rule-given rule) *archive-program-form*))
      (core-error "form = program is for ~{~a~^, ~}; this function has none"
                  (archive-program-names)))))

(defun archive-program-rule-p (rules)
  "Whether one of RULES gives a program."
  (and (find *archive-program-form* rules :key #'rule-given :test #'equal) t))

(defun archive-program-names ()
  (sort (loop for name being the hash-keys of *core-rules* using (hash-value rules)
              when (archive-program-rule-p rules) collect name)
        #'string<))

;;; Which options there are

(defun archive-overrulable-keys (kind)
  "Names of the keys of [system] that a call may overrule."
  (mapcar #'archive-key-name (archive-option-keys kind)))

(defun archive-rules-for (name kind)
  "The rules for NAME in archives of KIND, whatever their conditions."
  (remove-if-not (lambda (rule) (core-rule-fits rule kind (constantly t)))
                 (gethash name *core-rules*)))

(defun archive-walk (name next)
  "NAME and all names that one comes to from it by NEXT, a function of a name."
  (let ((seen '()))
    (labels ((walk (name)
               (unless (member name seen :test #'equal)
                 (push name seen)
                 (mapc #'walk (mapcar #'archive-input-name (funcall next name))))))
      (walk name))
    seen))

(defun archive-reachable (call name)
  "Names of the quantities, options and keys that may count for NAME, whatever the options say."
  (archive-walk name (lambda (name)
                       (unless (archive-argument-p call name)
                         (loop for rule in (archive-rules-for name (archive-call-kind call))
                               append (archive-rule-sources rule))))))

(defun archive-touched (call name)
  "Names of the quantities, options and keys that count for NAME in this CALL: by the rules that
its options choose, and the conditions of those that they do not."
  (archive-walk name (lambda (name) (archive-next-touched call name))))

(defun archive-touched-by (call)
  "The same for CALL, with what it does at its end."
  (let ((act (archive-act call)))
    (append (archive-touched call (core-public-name (archive-call-public call)))
            (when act
              (loop for source in (archive-rule-sources act)
                    append (archive-touched call (archive-input-name source)))))))

(defun archive-next-touched (call name)
  (unless (nth-value 1 (gethash name (archive-call-given call)))
    (let ((rule (archive-rule call name)))
      (append (when rule (archive-rule-sources rule))
              (loop for other in (archive-rules-for name (archive-call-kind call))
                    append (archive-condition-sources (rule-given other)))))))

(defun archive-option-counts-p (call option names)
  "Whether OPTION counts where the quantities NAMES do. `values' count for the remark on what is
neglected in a field."
  (or (member option (archive-always-options call) :test #'string=)
      (member option names :test #'equal)
      (and (archive-call-archive call)
           (member "description" names :test #'equal)
           (or (and (string= option "values") (eq (archive-key-value call "field") '$newton))
               (archive-counts-p "system" option (archive-call-kind call) '("*"))))))

(defun archive-always-options (call)
  "Options that every call takes."
  (append *archive-common-options* '("parameters" "abbreviations")
          (when (archive-call-archive call)
            (append '("functions") (when (archive-path (archive-call-archive call)) '("result"))))))

(defun archive-known-options (call)
  (remove-duplicates
   (append (core-public-options (archive-call-public call)) '("form")
           (archive-always-options call)
           (archive-overrulable-keys (archive-call-kind call)))
   :test #'string=))

(defun archive-taken-options (call)
  "Names of the options that the function takes in archives of this kind, or in this form, sorted."
  (let ((names (archive-reachable call (core-public-name (archive-call-public call)))))
    (sort (remove-if-not (lambda (option)
                           (and (archive-option-counts-p call option names)
                                (not (archive-argument-p call option))))
                         (archive-known-options call))
          #'string<)))

(defun archive-argument-p (call name)
  "Whether NAME is an argument of the call, given before the options."
  (and (null (archive-call-archive call)) (nth-value 1 (gethash name (archive-call-given call)))))

;;; Options given

(defun archive-check-name (call name)
  "An error unless the call takes an option NAME."
  (unless (archive-always-taken-p call name)
    (let ((taken (archive-taken-options call)))
      (unless (member name taken :test #'string=)
        (core-error "~a; the options are ~{~a~^, ~}"
                    (archive-refused-option call name taken) taken)))))

(defun archive-always-taken-p (call name)
  (and (member name (archive-always-options call) :test #'string=)
       (not (archive-argument-p call name))))

(defun archive-refused-option (call name taken)
  "What to say of an option NAME that is not one of those TAKEN."
  (let ((near (core-nearest name taken)))
    (cond ((archive-argument-p call name) (format nil "~a is an argument already" name))
          ((archive-option-elsewhere-p call name)
           (format nil "the option ~a has no effect in this call" name))
          (near (format nil "there is no option ~a; did you mean ~a?" name near))
          (t (format nil "there is no option ~a" name)))))

(defun archive-option-elsewhere-p (call name)
  "Whether NAME is an option of the function in other calls, or a key of [system]."
  (member name (append (core-public-options (archive-call-public call))
                       *archive-common-options* '("form" "result")
                       (loop for kind in (core-kind-names)
                             append (archive-overrulable-keys kind)))
          :test #'string=))

(defun archive-give-options (call options)
  "Options become quantities; a key of [system] among them overrules the archive's."
  (let ((names (mapcar #'archive-option-name options)))
    (loop for equation in options
          for (name . later) on names
          do (when (member name later :test #'string=)
               (core-error "the option ~a is given twice" name))
             (archive-check-name call name)
             (archive-check-option name (caddr equation))
             (when (and (string= name "form") (eq (caddr equation) '$program))
               (archive-check-program-form call)))
    (archive-give-all call (archive-numbers-over-values
                            call (loop for equation in options
                                       for name in names
                                       collect (cons name (archive-option-value
                                                           name (caddr equation))))))
    (archive-check-effects call names))
  (when (eq (gethash "progress" (archive-call-given call) t) nil) (setq *core-progress* nil)))

(defun archive-option-value (name value)
  "VALUE of the option NAME; a span of time may begin with the name of time, as among arguments."
  (if (and (string= name "time") (archive-list-p value) (eq (second value) '$t))
      (archive-list (cddr value))
      value))

(defun archive-check-effects (call names)
  "An error for the first of the options NAMES that nothing in this call asks for."
  (when (set-difference names (archive-always-options call) :test #'string=)
    (let ((touched (archive-touched-by call)))
      (dolist (name names)
        (unless (archive-option-counts-p call name touched)
          (core-error "the option ~a has no effect beside the others; leave it out" name))))))

(defun archive-give-all (call pairs)
  "PAIRS, (name . value) each, as quantities. Keys of an archive are overruled at one stroke, since
one may need the other; a key that a rule builds on, as rayleigh where there are dampers, is given
to the rule only."
  (let* ((kind (archive-call-kind call)) (archive (archive-call-archive call))
         (keys (and archive (remove-if-not (lambda (pair)
                                             (member (car pair) (archive-overrulable-keys kind)
                                                     :test #'string=))
                                           pairs))))
    (when keys (archive-overrule call keys))
    (loop for (name . value) in pairs
          do (when (and (null archive) (string= name "parameters"))
               (archive-give-facts call value))
             (unless (and (assoc name keys :test #'string=)
                          (core-find-rule name kind (constantly nil)))
               (archive-give call name value)))))

(defun archive-give-facts (call value)
  "What is assumed of parameters in a call on expressions."
  (archive-check-argument "parameters" value (archive-call-kind call))
  (setf (archive-call-facts call) (remove-if-not #'archive-relation-p (cdr value))))

;;; A run takes numbers: parameters = [m = 2] beside the values of the archive

(defun archive-numbers-p (pair)
  "Whether PAIR, (name . value), gives numbers to parameters."
  (and (string= (car pair) "parameters") (archive-list-p (cdr pair)) (cddr pair)
       (every #'archive-equation-p (cddr pair))))

(defun archive-numbers-over-values (call pairs)
  "PAIRS where numbers given to parameters of a run stand in `values', over those of the archive."
  (let ((numbers (find-if #'archive-numbers-p pairs))
        (given (cdr (assoc "values" pairs :test #'string=))))
    (when (and (core-public-numerical (archive-call-public call))
               (or (null given) (archive-list-p given)))
      (archive-check-numbered-names
       call (append (cdr numbers) (cdr given))
       (archive-names-beside-numbers call pairs)))
    (if (and numbers (core-public-numerical (archive-call-public call))
             (or (null given) (archive-list-p given)))
        (let* ((values (or given (archive-key-value call "values")))
               (kept (remove-if (lambda (equation)
                                  (member (second equation) (archive-lefts (cdr numbers))))
                                (cdr values))))
          (acons "values" (archive-list (append kept (cddr numbers)))
                 (remove-if (lambda (pair) (or (eq pair numbers) (string= (car pair) "values")))
                            pairs)))
        pairs)))

;;; A number for a name that nothing contains would change nothing: it is a misprint

(defun archive-names-beside-numbers (call pairs)
  "The names that CALL contains, PAIRS being its options; left sides of `values' that are given in
it aside."
  (let ((archive (archive-call-archive call)))
    (append
     (loop for value being the hash-values of (archive-call-given call)
           append (archive-names-in value))
     (loop for (name . value) in pairs
           unless (member name '("values" "parameters") :test #'string=)
             append (archive-names-in value))
     (archive-momentum-names (archive-list (list (archive-equation
                                                  '$coordinates
                                                  (gethash "coordinates" (archive-call-given call)
                                                           '((mlist)))))))
     (and archive (archive-known-names (archive-call-kind call) (archive-description archive))))))

(defun archive-check-numbered-names (call equations known)
  "An error for an equation name = number among EQUATIONS whose name is not KNOWN in CALL."
  (dolist (name (mapcar #'second (remove-if-not #'archive-equation-p equations)))
    (unless (or (member name known) (not (archive-symbol-p name)))
      (let* ((word (core-spelling name))
             (words (mapcar #'core-spelling (archive-parameters call known)))
             (near (if (= (length word) 1)
                       (find word words :test #'string-equal)
                       (core-nearest word words))))
        (core-error "~a is given a number and does not occur in this system~@[; did you mean ~a?~]"
                    word near)))))

(defun archive-parameters (call known)
  "Those of the names KNOWN that may have a number."
  (let ((archive (archive-call-archive call)))
    (set-difference known (and archive (mapcar #'car (archive-moving-names
                                                      (archive-description archive)))))))

;;; Keys that are overruled

(defun archive-overruled-group (group pairs)
  "GROUP with the statements key = value of PAIRS instead of its own."
  (let ((copy (copy-archive-group group)))
    (setf (archive-group-statements copy)
          (append (remove-if (lambda (statement)
                               (assoc (archive-statement-key statement) pairs :test #'equal))
                             (archive-group-statements group))
                  (loop for (name . value) in pairs
                        collect (make-archive-statement :key name :value value))))
    copy))

(defun archive-overruled (archive pairs)
  "ARCHIVE as if its [system] had the keys and values of PAIRS, checked like any other."
  (let ((other (archive-of-groups
                (archive-path archive) (archive-text archive) (archive-parts archive)
                (mapcar (lambda (group)
                          (if (string= (archive-group-section group) "system")
                              (archive-overruled-group group pairs)
                              group))
                        (archive-groups archive)))))
    (setf (archive-found other) (archive-found archive))
    other))

(defun archive-overrule (call pairs)
  (let ((archive (archive-overruled (archive-call-archive call) pairs)))
    (setf (archive-call-overruled call) pairs
          (archive-call-archive call) archive
          (archive-call-facts call) (archive-facts (archive-description archive)))))
