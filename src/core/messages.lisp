;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What is said to the person: errors, warnings, progress, and the notes that go into a result
;;; (how it was checked, what was left out). Every message begins with the public function that
;;; runs; the archive tells the line of a key.

(in-package :maxima)

(defvar *core-function* nil "Name of the public function that runs, a string.")
(defvar *core-place* nil
  "Function of section and key: their place, such as \"pendulum.txt, line 14\", or nil.")
(defvar *core-checks* nil "How the result was checked, newest first.")
(defvar *core-left-out* nil "What the result leaves out, newest first.")
(defvar *core-report* '() "What else is to stand with the result: (key . value), newest first.")
(defvar *core-partial* nil
  "The sentence in which the call ends once its result, which is not whole, has been saved.")
(defvar *core-level* '$canonical
  "The form of an answer where that is left to the derivation: factored once a part was too long.")
(defvar *core-progress* t "Whether progress lines are wanted.")
(defvar *core-doing* nil "What is being done, such as \"computing Lagrangian\".")
(defvar *core-warnings* nil "Warnings already given in this call.")
(defvar *core-warnings-now* '() "Warnings of what is being derived, given already or not.")

(defun core-words (items)
  "ITEMS, strings and Maxima expressions, as one string on one line, the same in all versions of
Maxima. (Since 5.47 a minus binds closer than a product, and -4*x would be written -(4*x).)"
  (let (($display2d nil) ($stringdisp nil) ($lispdisp nil) ($linel 100000)
        (bound (get 'mminus 'rbp)))
    (unwind-protect
         (progn
           (setf (get 'mminus 'rbp) 100)
           (with-output-to-string (text)
             (dolist (item items)
               (write-string (if (stringp item) item (coerce (mstring item) 'string)) text))))
      (setf (get 'mminus 'rbp) bound))))

(defun core-cut (text)
  "TEXT, cut after sixty letters."
  (if (> (length text) 60) (concatenate 'string (subseq text 0 57) "...") text))

(defun core-choice (words)
  "\"a, b or c\""
  (format nil "~{~a~^, ~}~:[~; or ~]~a" (butlast words) (cdr words) (car (last words))))

(defun core-named (text)
  "TEXT after the name of the function that runs."
  (if *core-function* (concatenate 'string *core-function* ": " text) text))

(defun core-unnamed (text)
  "TEXT of an error without that name."
  (let ((name (core-named "")))
    (if (eql (search name text) 0) (subseq text (length name)) text)))

(defun core-signal (text)
  (merror "~A" (core-named text)))

(defun core-error (control &rest arguments)
  "A Maxima error: \"FUNCTION: text\"."
  (core-signal (apply #'format nil control arguments)))

(defvar *core-undecided* nil "The text of the last error that says what is not decided.")

(defun core-undecided (control &rest arguments)
  "An error that says what is not decided; core_decided makes an answer of it."
  (setq *core-undecided* (apply #'format nil control arguments))
  (core-signal *core-undecided*))

(defun core-placed (section key)
  "\"body 2 (pendulum.txt, line 14)\", as far as it is known."
  (let ((place (and *core-place* (funcall *core-place* section key))))
    (if place (format nil "~a (~a)" section place) section)))

(defun core-fault (section key control &rest arguments)
  "An error of the description, with its place."
  (core-signal (format nil "~a: ~?" (core-placed section key) control arguments)))

(defun core-say (text)
  "One line on the terminal, on a line of its own."
  (fresh-line)
  (write-string text)
  (terpri)
  (finish-output))

(defvar *core-too-large* nil "Whether the call ended because its result would be too long.")

(defun core-note (control &rest arguments)
  (core-say (format nil "~@[~a: ~]~?" *core-function* control arguments)))

(defun core-warn (control &rest arguments)
  "One line, once in a call."
  (let ((text (apply #'format nil control arguments)))
    (pushnew text *core-warnings-now* :test #'string=)
    (unless (member text *core-warnings* :test #'string=)
      (push text *core-warnings*)
      (core-note "warning: ~a" text))))

(defvar *core-later* '() "Warnings to be given with the result, newest first.")

(defun core-warn-later (control &rest arguments)
  "A warning about a result; where the call ends in an error, the error alone is said."
  (let ((text (apply #'format nil control arguments)))
    (if *core-function* (push text *core-later*) (core-warn "~a" text))))

(defun core-warn-now ()
  "Gives the warnings that waited for the result."
  (dolist (text (reverse *core-later*)) (core-warn "~a" text))
  (setq *core-later* '()))

;;; What is shown to the person beside the result, in his own session

(defvar *core-afterwards* '() "Functions that are called once the call is over, newest first.")

(defun core-afterwards (function) (push function *core-afterwards*))

(defun core-do-afterwards ()
  (mapc #'funcall (reverse *core-afterwards*))
  (setq *core-afterwards* '()))

(defun $core_words (&rest items)
  "sconcat, but the same in all versions of Maxima and under all flags of printing."
  (core-words items))

(defun $core_error (&rest items) (core-signal (core-words items)))

(defun $core_undecided (&rest items) (core-undecided "~a" (core-words items)))

(defun core-section-name (section) (if (stringp section) section (core-words (list section))))

(defun $core_fault (section key &rest items)
  (core-fault (core-section-name section) key "~a" (core-words items)))

(defun $core_warn (&rest items) (core-warn "~a" (core-words items)) '$done)

(defun $core_checked (&rest items)
  (pushnew (core-words items) *core-checks* :test #'string=)
  '$done)

(defun $core_noted (&rest items)
  "ITEMS as a line on the terminal, and as what the section of the result says was found."
  (let ((text (core-words items)))
    (core-note "~a" text)
    ($core_checked text)))

(defun $core_left_out (&rest items)
  (pushnew (core-words items) *core-left-out* :test #'string=)
  '$done)

(defun core-report (key value)
  "VALUE stands under KEY, a string, in the section of the result; it is no part of it."
  (push (cons key value) *core-report*))

(defun $core_reported (key &rest items)
  "ITEMS as one text under KEY, a string, in the section of the result."
  (core-report key (core-words items))
  '$done)

(defun core-partial (control &rest arguments)
  "The result is only a part of what was asked: it is saved as such, and the call ends in an error
with this sentence."
  (core-report "partial" t)
  (setq *core-partial* (apply #'format nil control arguments)))

(defvar *core-unsaved* nil "Whether nothing is written that would say what was left out.")

(defun $core_left_case (condition)
  "What was left out is a case, such as \"a = 0\": a call that saves nothing says so."
  (let ((text (format nil "the case ~a" condition)))
    (when (and *core-unsaved* (not (member text *core-left-out* :test #'string=)))
      (core-warn-later "~a is left out" text))
    ($core_left_out text)))

(defun core-factored () (setq *core-level* '$factored))

(defun $core_factored () (core-factored))

(defun $core_path (name)
  "The path of a file of the repository."
  (concatenate 'string *core-root* name))

(defun core-key-equal (key other)
  (if (stringp key) (and (stringp other) (string= key other)) (eq key other)))

(defun $core_get (record key &optional (default nil given))
  "The value of KEY in RECORD, a list of equations."
  (let ((equation (find-if (lambda (e)
                             (and (consp e) (eq (caar e) 'mequal) (core-key-equal key (cadr e))))
                           (cdr record))))
    (cond (equation (caddr equation))
          (given default)
          (t (core-error "~a is missing" (core-section-name key))))))

(defun $core_appended (lists)
  "The elements of all LISTS in one. (A call has at most 64 arguments on GCL.)"
  (cons '(mlist simp)
        (loop for list in (cdr lists)
              append (if ($listp list) (cdr list) (core-error "found ~a, expected a list" list)))))

(defun $core_distinct (list)
  "LIST without what is alike an element before."
  (cons '(mlist simp) (remove-duplicates (cdr list) :test #'alike1 :from-end t)))

(defun core-attempt (function)
  "A list of the value of FUNCTION, or nil when it ends in an error; nothing is printed and `error'
keeps its value."
  (let (($errormsg nil) ($error $error) (*core-too-large* nil)) (errcatch (funcall function))))

(defmspec $core_attempt (form)
  ;; core_attempt(e): [value of e], or [] when it ends in an error or would ask a question.
  (cons '(mlist simp) (core-attempt (lambda () (meval (cadr form))))))

;;; What is not decided is an answer to some: a verdict names it.

(defun core-undecided-text (last-error)
  "The text of core-undecided in LAST-ERROR, the variable error; nil where it is another's."
  (and *core-undecided*
       (equal (cddr last-error) (list (core-named *core-undecided*)))
       *core-undecided*))

(defmspec $core_decided (form)
  ;; core_decided(e): [value of e], or the text of what is not decided. Other errors are errors.
  (let* ((last-error nil) (*core-undecided* nil)
         (value (let (($errormsg nil) ($error $error))
                  (or (errcatch (list '(mlist simp) (meval (cadr form))))
                      (progn (setq last-error $error) nil)))))
    (cond (value (car value))
          ((core-undecided-text last-error))
          (t (apply #'merror (cdr last-error))))))

;;; Texts, for Maxima code that would otherwise load a whole share package for them

(defun $core_joined (items between)
  "ITEMS as one string with BETWEEN between them."
  (core-words (loop for (item . more) on (cdr items) collect item when more collect between)))

(defun $core_first_word (text)
  (subseq text 0 (position #\Space text)))

(defun $core_first_letter (name)
  (subseq (core-words (list name)) 0 1))

(defun $core_textp (e) (stringp e))

;;; What else to do, at the end of a refusal

(defvar *core-has-parameters* t
  "Whether the system of this call has parameters, or a function that tells it.")

(defun core-number-advice ()
  "The advice to give numbers to some parameters, nil where there are none."
  (and (if (functionp *core-has-parameters*)
           (funcall *core-has-parameters*)
           *core-has-parameters*)
       "give numbers to some parameters"))

(defun $core_number_advice () (core-number-advice))

(defun core-advised (&rest phrases)
  "\"; do this, do that, or do the other\": those of PHRASES that are not nil."
  (let ((advice (remove nil phrases)))
    (format nil "~[~:;; ~]~{~#[~;~a~;~a, or ~a~:;~@{~a~#[~;, or ~:;, ~]~}~]~}" (length advice)
            advice)))

(defun $core_advised (&rest phrases) (apply #'core-advised phrases))

;;; Names that a result brings of itself must not be those of the system

(defvar *core-names* '() "All names in the arguments and the description of this call.")

(defun $core_taken (name)
  "Whether NAME stands anywhere in the system of this call."
  (and (member name *core-names*) t))
