;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; From a target down to the keys: each quantity is given, or stands in a result section that is
;;; still good, or follows from a rule of the register, or is a key of the archive. What a step
;;; needs is known before anything is computed, so a result that is up to date costs one reading.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/call" "archive/derived" "archive/groups" "archive/keys" "archive/needs"
                "archive/results" "archive/sections" "archive/speller" "core/bound_names"))

;;; Values

(defun archive-value (call name &optional (default nil default-given))
  "The value of the quantity NAME, in this order: given, known, stored, by rule, a key, the
default."
  (multiple-value-bind (value given) (gethash name (archive-call-given call))
    (if given
        (archive-unassumed name value)
        (multiple-value-bind (value known) (gethash name (archive-call-values call))
          (if known
              value
              (multiple-value-bind (value found) (archive-find-value call name)
                (cond (found (setf (gethash name (archive-call-values call)) value))
                      (default-given default)
                      (t (archive-missing call name)))))))))

(defun archive-unassumed (name value)
  "The VALUE of the quantity NAME as it was given, nothing being assumed of names bound in it."
  (core-unassumed value (equal name "laws")))

(defun archive-find-value (call name)
  "Two values: the value of NAME from the archive or by a rule, and whether there is one."
  (let ((rule (archive-rule call name)))
    (cond ((equal name "description") (values (archive-structure call) t))
          ((archive-own-section call name) (archive-stored-value call name rule))
          (rule (archive-rule-value call name rule))
          (t (multiple-value-bind (value found) (archive-key-value call name)
               (values (archive-unassumed name value) found))))))

(defun archive-structure (call)
  "The description without the keys of the analysis. `values' stay for remarks about results, such
as the size of what is neglected, and count in no digest: a formula must not depend on them."
  (let ((hidden (mapcar #'core-symbol (remove "values" *archive-analysis-keys* :test #'equal))))
    (cons (car (archive-description (archive-call-archive call)))
          (loop for e in (cdr (archive-description (archive-call-archive call)))
                unless (member (cadr e) hidden)
                  collect (core-unassumed e (eq (cadr e) '$laws))))))

(defun archive-stored-value (call name rule)
  "The stored result NAME where it is still good, else a new one; other limits may give more."
  (multiple-value-bind (value state)
      (archive-result (archive-call-archive call) name (archive-digest-of call name)
                      (archive-options-of call name))
    (ecase state
      (:fresh (if (or (archive-option call "result" nil) (archive-option call "size" nil))
                  (archive-rule-value call name rule)
                  (values (core-unassumed (archive-in-full call name value)) t)))
      (:edited
       (core-note "using [~a] as it was edited by hand"
                  (section-name (archive-own-section call name)))
       (values (core-unassumed (archive-in-full call name value)) t))
      (:stale
       (core-note "the description has changed since [~a] was computed; computing it again"
                  (section-name (archive-own-section call name)))
       (archive-rule-value call name rule)))))

(defun archive-rule-value (call name rule)
  (cond ((rule-same rule) (values (archive-value call (rule-same rule)) t))
        ((rule-record rule)
         (values (archive-field (archive-value call (rule-record rule)) (rule-field rule)) t))
        ((rule-tried rule) (values (archive-tried-value call (rule-tried rule)) t))
        ((rule-later rule) (values (lambda () (archive-value call (rule-later rule))) t))
        (t (values (archive-compute call name rule) t))))

(defparameter *archive-trying-time* 10 "Seconds for what is only tried.")

(defun archive-tried-value (call name)
  "[value] of the quantity NAME, or the text of the error or stop that ends it."
  (multiple-value-bind (value text)
      (core-caught
       (lambda ()
         (multiple-value-bind (value stop)
             (core-within *archive-trying-time* (lambda () (archive-value call name)))
           (if stop (core-signal stop) value))))
    (or text (list '(mlist simp) value))))

(defun archive-field (record field)
  "A part of a record by its name, or of a list by its number."
  (if (integerp field) (nth field record) ($core_get record (core-symbol field))))

(defun archive-inputs (call rule)
  "The values of the inputs of RULE, in their order."
  (mapcar (lambda (input)
            (if (consp input)
                (archive-value call (car input) (cadr input))
                (archive-value call input)))
          (rule-inputs rule)))

(defun archive-compute (call name rule)
  "Applies the rule's pure function to its inputs; a public step is noted for saving, what was said
of another is kept for those that take it."
  (let* ((began (get-internal-real-time))
         (derived (if (and (rule-kept rule) (archive-call-archive call))
                      (archive-kept (archive-kept-key name (archive-sources-of call name)
                                                      (archive-options-of call name)
                                                      (archive-copied (core-facts)))
                                    (lambda () (archive-derive-now call name rule)))
                      (archive-derive-now call name rule))))
    (cond ((gethash name *core-publics*)
           (archive-note-step call name derived (archive-form-taken call rule derived))
           (archive-report-time call name began derived))
          (t (setf (gethash name (archive-call-derived call)) derived)))
    (archive-derived-value derived)))

(defun archive-derive-now (call name rule)
  (let ((inputs (archive-inputs call rule)))
    (core-progress "computing ~a" (substitute #\Space #\_ name))
    (archive-assuming call name
                      (lambda ()
                        (mapc #'core-judge-divisors inputs)
                        (let ((derived (archive-derive rule inputs (archive-said call rule))))
                          (core-judge-divisors (archive-derived-value derived))
                          derived)))))

(defun archive-assuming (call name function)
  "Calls FUNCTION, which derives NAME; of a public step what its kind of archive assumes holds, the
quantity `assumptions'."
  (let ((assumed (and (gethash name *core-publics*) (archive-rule call "assumptions")
                      (cdr (archive-value call "assumptions")))))
    (if assumed
        (core-with-facts (append assumed (core-facts)) function)
        (funcall function))))

(defun archive-said (call rule)
  "What was said when the inputs of RULE that are no public steps were derived."
  (loop for input in (rule-inputs rule)
        for derived = (gethash (archive-input-name input) (archive-call-derived call))
        when derived collect derived))

;;; Abbreviations are names for the person: results are saved and returned in them, and computed
;;; without them

(defun archive-abbreviations (call)
  (cdr (archive-value call "abbreviations" '((mlist simp)))))

(defun archive-abbreviated (call value)
  "VALUE in the archive's abbreviations."
  (let ((abbreviations (archive-abbreviations call)))
    (cond ((or (null abbreviations) (null *core-abbreviator*)) value)
          (t (core-require (car *core-abbreviator*))
             (mfuncall (cdr *core-abbreviator*) value (cons '(mlist simp) abbreviations))))))

(defun archive-in-full (call name value)
  "VALUE, the stored result NAME, without the abbreviations it was written in, the last defined
first: those that its section states, else the archive's."
  (let* ((stated (archive-section-abbreviations (archive-own-section call name)))
         (abbreviations (or stated (archive-abbreviations call))))
    (dolist (equation (reverse abbreviations) value)
      (setq value ($substitute (caddr equation) (cadr equation) value)))))

(defun archive-report-time (call name began derived)
  (when (eq (archive-option call "verbose" nil) t)
    (core-note "~a took ~,3f s~@[; ~{~a~^; ~}~]" name
               (/ (- (get-internal-real-time) began) (float internal-time-units-per-second 1d0))
               (archive-derived-left-out derived))
    (loop for (key . value) in (reverse (archive-derived-report derived))
          do (core-note "~a: ~a" key (archive-spell value)))))

(defun archive-form-taken (call rule derived)
  "The form of what RULE gave, as text: the one asked for, or that to which the derivation came; nil
where there is only one."
  (let ((form (archive-value call "form" '$auto)))
    (cond ((equal (rule-given rule) *archive-program-form*) "program")
          ((notany (lambda (input) (archive-takes-form-p call input)) (rule-inputs rule)) nil)
          (t (core-spelling (if (eq form '$auto) (archive-derived-level derived) form))))))

(defun archive-takes-form-p (call input)
  "Whether INPUT is the form asked for, or a record of options that has it."
  (let* ((name (archive-input-name input))
         (rule (and (not (gethash name *core-publics*)) (archive-rule call name))))
    (or (equal name "form")
        (and rule (some (lambda (input) (equal (archive-input-name input) "form"))
                        (rule-inputs rule))))))

(defun archive-note-step (call name derived form)
  (when (and (archive-call-archive call) (archive-path (archive-call-archive call)))
    (let* ((value (archive-derived-value derived)) (short (archive-abbreviated call value)))
      (push (make-archive-step
             :name name :value short :from (archive-digest-of call name)
             :passed (string/= name (core-public-name (archive-call-public call)))
             :options (archive-options-of call name) :form form
             :checks (reverse (archive-derived-checks derived))
             :left-out (reverse (archive-derived-left-out derived))
             :report (reverse (archive-derived-report derived))
             :abbreviations (unless (equal short value) (archive-abbreviations call)))
            (archive-call-new call)))))

(defun archive-save-default (call)
  "What file_search found is not the user's to write in, unless he says so."
  (or (archive-option call "result" nil) (not (archive-found (archive-call-archive call)))))

(defun archive-saves-p (call)
  "Whether new steps are written to a file."
  (let ((archive (archive-call-archive call)))
    (and archive
         (or (archive-path archive) (archive-option call "result" nil))
         (archive-option call "save" (archive-save-default call)))))

(defun archive-save-steps (call)
  "Writes the sections of all steps computed in this call, unless save = false."
  (when (and (archive-call-new call) (archive-saves-p call))
    (archive-save (archive-call-archive call) (reverse (archive-call-new call))
                  (archive-option call "result" nil))))
