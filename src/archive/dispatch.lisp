;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The dispatcher: turns a call such as Lagrangian("pendulum.txt", save = false) into quantities,
;;; follows the register's rules from the target down to the keys of the archive, runs each pure
;;; function in the guard, saves the steps, returns the result. Look first at archive-dispatch,
;;; then at archive-value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/argument_checks" "archive/argument_types" "archive/bound_arguments"
                "archive/call"
                "archive/derived" "archive/exact" "archive/groups" "archive/names"
                "archive/needs" "archive/open" "archive/options" "archive/steps" "archive/types"))

(defun archive-dispatch (name arguments)
  "What a public function does: NAME applied to ARGUMENTS, errors reported in its name."
  (let ((*core-function* name) (*core-place* nil) (*core-warnings* '())
        (*core-progress* *core-progress*) (*core-too-large* nil) (*core-names* '())
        (*core-free-names* '())
        (*core-has-parameters* t) (*core-unsaved* nil)
        (*core-cheaper* nil) (*core-later* '()) (*core-size* *core-size*)
        (*core-partial* nil) (*core-afterwards* '()))
    (setq arguments (archive-arguments-taken arguments)
          *core-cheaper* (archive-cheaper name arguments)
          *core-size* (archive-size-factor arguments))
    (multiple-value-bind (value text)
        (core-caught (lambda ()
                       (archive-check-depends arguments)
                       (archive-check-bound arguments)
                       (archive-in-time name arguments)))
      (when text (merror "~A" text))
      (core-warn-now)
      (core-do-afterwards)
      value)))

(defun archive-in-time (name arguments)
  "The value within the call's limit of time; the dialog, which waits for the person, has none."
  (flet ((answer () (archive-value-or-program name arguments)))
    (if (archive-asks-p name arguments)
        (answer)
        (archive-watched arguments #'answer))))

(defun archive-asks-p (name arguments)
  "Whether the call begins with the dialog."
  (and (core-public-kinds (gethash name *core-publics*)) (every #'archive-equation-p arguments)))

(defun archive-cheaper (name arguments)
  "What would be cheaper than the call of NAME, as a phrase."
  (and (archive-program-serves-p name arguments) "take form = program"))

(defun archive-watched (arguments function)
  "FUNCTION, watched as the options among ARGUMENTS say."
  (let ((*core-progress* (and *core-progress* (archive-early-option arguments '$progress t))))
    (core-watched (archive-limit arguments)
                  (lambda () (core-progress "reading") (funcall function)))))

(defun archive-early-option (arguments option default)
  "The value of OPTION before the options are checked."
  (let ((equation (find-if (lambda (e) (and (archive-equation-p e) (eq (cadr e) option)))
                           arguments)))
    (if equation (caddr equation) default)))

(defun archive-limit (arguments)
  "The limit of a call in seconds, nil for none; inside another call only one that is given."
  (let ((limit (archive-early-option arguments '$limit nil)))
    (cond ((or (null limit) (not (archive-option-fits :seconds limit)))
           (if *core-deadlines* nil *core-limit*))
          ((zerop1 limit) nil)
          (t (core-time limit)))))

(defun archive-size-factor (arguments)
  "How many times the limits of size hold; inside another call as there, unless it is given."
  (let ((size (archive-early-option arguments '$size nil)))
    (if (and size (archive-option-fits :factor size)) (core-time size) *core-size*)))

(defun archive-value-or-program (name arguments)
  (multiple-value-bind (value text) (archive-tried name arguments)
    (when (and text *core-too-large* (archive-program-serves-p name arguments))
      (multiple-value-setq (value text) (archive-program-instead name arguments text)))
    (if text (merror "~A" text) value)))

(defun archive-option-of (condition)
  "The option that CONDITION, (name value), asks for, as an equation."
  (list '(mequal) (core-symbol (first condition)) (second condition)))

(defun archive-form-option-p (argument)
  (and (archive-equation-p argument) (eq (cadr argument) (core-symbol "form"))))

(defun archive-program-serves-p (name arguments)
  "Whether NAME has a program too, and the form is left to us."
  (and arguments
       (archive-program-rule-p (gethash name *core-rules*))
       (loop for argument in arguments
             never (and (archive-form-option-p argument)
                        (not (eq (caddr argument) '$auto))))))

(defun archive-program-instead (name arguments text)
  "As core-caught: the program of what would be too long; TEXT, the first error, where there is
none."
  (multiple-value-bind (program refusal)
      (archive-tried name (append (remove-if #'archive-form-option-p arguments)
                                  (list (archive-option-of *archive-program-form*))))
    (cond (refusal (values nil text))
          (t (core-note "as an expression it would be too long: the result is a program, ~
                         as with form = program")
             (values program nil)))))

(defun archive-tried (name arguments)
  "The call; one that fills the memory ends here, so that its program can be tried."
  (core-caught
   (lambda ()
     (core-watched nil (lambda () (core-clean-call #'archive-called (cons name arguments)))))))

(defun archive-called (name &rest arguments)
  (let ((public (gethash name *core-publics*)))
    (multiple-value-bind (positional options)
        (archive-split-arguments (archive-exact-decimals (archive-sums-written-out arguments)
                                                         (core-public-numerical public)))
      (cond ((and (null positional) (core-public-kinds public))
             (archive-ask public options))
            ((archive-system-p (car positional) public)
             (archive-call-system public positional options))
            (t (archive-call-expressions public positional options))))))

(defun archive-ask (public options)
  "The dialog, which ends in a path; then the call on it."
  (core-require "archive/dialog")
  (let ((path (funcall 'archive-dialog (core-public-name public) (core-public-kinds public)
                       (lambda (text) (archive-trial-trouble public text options)))))
    (archive-watched options (lambda () (archive-call-system public (list path) options)))))

(defun archive-trial-trouble (public text options)
  "What is wrong with the archive TEXT when PUBLIC is called on it, or nil; nothing is saved."
  (archive-trouble
   (lambda ()
     (let ((archive (archive-of-text "the description" text)))
       (setf (archive-path archive) nil)
       (archive-watched
        options (lambda () (archive-run (archive-call-on public archive '() options) t)))))))

(defun archive-call-system (public positional options)
  (archive-run (archive-call-on public (archive-open-system (car positional)) (cdr positional)
                                options)))

(defun archive-call-on (public archive trailing options)
  "The call of PUBLIC on ARCHIVE with what follows the system."
  (let ((call (archive-new-call public archive (archive-kind archive))))
    (archive-give-trailing call trailing)
    (archive-give-options call options)
    (archive-check-arguments (archive-call-given call) (archive-call-kind call)
                             (mapcar #'car (archive-moving-names (archive-description archive))))
    (setq *core-place* (lambda (section key) (archive-place archive section key)))
    call))

(defun archive-call-expressions (public positional options)
  (let* ((form (archive-matching-form public positional))
         (call (archive-new-call public nil (car form))))
    (archive-give-positional call (cdr form) positional)
    (archive-give-options call options)
    (archive-check-arguments (archive-call-given call) (car form))
    (archive-run call)))

(defun archive-call-names (call)
  "All names in what CALL was given and in its description, heads of functions too; the variables
that a solution names are no names of its own."
  (let ((names '()))
    (labels ((note (part)
               (cond ((archive-symbol-p part) (pushnew part names))
                     ((and (consp part) (consp (car part)) (archive-symbol-p (caar part)))
                      (pushnew (caar part) names))))
             (note-all (key value)
               (cond ((archive-word-key-p key))
                     ((and (equal key "solution") (archive-list-p value))
                      (dolist (part (cdr value))
                        (archive-map-parts #'note (if (archive-equation-p part)
                                                      (third part)
                                                      part))))
                     (t (archive-map-parts #'note value)))))
      (loop for name being the hash-keys of (archive-call-given call) using (hash-value value)
            do (note-all name value))
      (when (archive-call-archive call)
        (dolist (entry (cdr (archive-description (archive-call-archive call))))
          (note-all (archive-key-text (second entry)) (third entry)))))
    names))

(defun archive-free-names (call)
  "The names that are free in what CALL was given and in its description."
  (let ((names '()))
    (flet ((note (key value)
             (setq names (union (core-free-names value (equal key "laws")) names))))
      (loop for key being the hash-keys of (archive-call-given call) using (hash-value value)
            do (note key value))
      (when (archive-call-archive call)
        (dolist (entry (cdr (archive-description (archive-call-archive call))))
          (note (archive-key-text (second entry)) (third entry)))))
    names))

(defun archive-has-parameters-p (call)
  "Whether the system of CALL has names that are given no motion."
  (let ((archive (archive-call-archive call)))
    (if archive
        (let ((description (archive-description archive)))
          (or (archive-used-names ($core_get description '$parameters '((mlist))))
              (archive-free-symbols (archive-kind archive) description)))
        (archive-argument-parameters (archive-call-given call)))))

(defun archive-argument-parameters (given)
  "Names in the arguments GIVEN that none of them lists, differentiates or has on its left side."
  (let ((used '()) (listed '($t)))
    (loop for value being the hash-values of given
          do (if (archive-equation-p value) (push (second value) listed))
             (dolist (part (if (archive-list-p value) (cdr value) (list value)))
               (cond ((symbolp part) (push part listed))
                     ((and (archive-equation-p part) (symbolp (second part)))
                      (push (second part) listed)
                      (setq used (union used (archive-used-names (third part)))))
                     (t (setq used (union used (archive-used-names part)))))))
    (loop for value being the hash-values of given
          do (setq listed (append (archive-differentiated-names value) listed)))
    (set-difference used listed)))

(defun archive-word-key-p (name)
  "Whether the value of the key NAME is a word of ours, such as field = constant, and no name."
  (member name '("kind" "field" "sign" "algebra") :test #'equal))

(defun archive-run (call &optional trial)
  "The value of the call's target, computed in the guard; new steps are saved, and what the call
does is done. A TRIAL does not."
  (setq *core-names* (archive-call-names call)
        *core-free-names* (archive-free-names call)
        *core-has-parameters* (lambda () (archive-has-parameters-p call))
        *core-unsaved* (not (archive-saves-p call)))
  (archive-refuse-property-words *core-names*)
  (core-guarded (archive-call-facts call)
                (lambda ()
                  (let ((act (archive-act call)))
                    (archive-own-lists
                     (if act
                         (archive-acted call act trial)
                         (prog1 (archive-abbreviated
                                 call (archive-value
                                       call (core-public-name (archive-call-public call))))
                           (archive-save-all call))))))))

(defun archive-save-all (call)
  "Saves the new steps of CALL; one of which there is only a part is an error then."
  (archive-save-steps call)
  (when *core-partial* (core-signal *core-partial*)))

(defun archive-acted (call act trial)
  "The value of the rule ACT; what it is applied to is saved before."
  (let ((inputs (archive-inputs call act)))
    (archive-save-all call)
    (unless trial (core-apply-rule act inputs))))

(setq *core-dispatcher* #'archive-dispatch)
