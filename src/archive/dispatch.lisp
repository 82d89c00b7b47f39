;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The dispatcher: turns a call such as Lagrangian("pendulum.txt", save = false) into quantities,
;;; follows the register's rules from the target down to the keys of the archive, runs each pure
;;; function in the guard, saves the steps, returns the result. Look first at archive-dispatch,
;;; then at archive-value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/call" "archive/steps"))

(defun archive-dispatch (name arguments)
  "What a public function does: NAME applied to ARGUMENTS, errors reported in its name."
  (let ((*core-function* name) (*core-archive* nil) (*core-place* nil) (*core-warnings* '())
        (*core-started* nil) (*core-progress* t) (*core-too-large* nil))
    (multiple-value-bind (value text) (archive-tried name arguments)
      (when (and text *core-too-large* (archive-program-serves-p name arguments))
        (multiple-value-setq (value text) (archive-program-instead name arguments text)))
      (if text (merror "~A" text) value))))

(defun archive-program-instead (name arguments text)
  "As core-caught: the program of what would be too long; TEXT, the first error, where there is none."
  (multiple-value-bind (program refusal)
      (archive-tried name (append arguments (list (archive-option-of *archive-program-form*))))
    (cond (refusal (values nil text))
          (t (core-note "as an expression it would be too long: the result is a program, ~
                         as with form = program")
             (values program nil)))))

(defun archive-tried (name arguments)
  (core-caught (lambda () (core-clean-call #'archive-called (cons name arguments)))))

(defun archive-called (name &rest arguments)
  (multiple-value-bind (positional options) (archive-split-arguments arguments)
    (let ((public (gethash name *core-publics*)))
      (cond ((and (null positional) (core-public-kinds public))
             (archive-ask public options))
            ((archive-system-p (car positional) public)
             (archive-call-system public positional options))
            (t (archive-call-expressions public positional options))))))

(defun archive-ask (public options)
  "The dialog, which ends in a path; then the call on it."
  (core-require "archive/dialog_end")
  (let ((path (funcall 'archive-dialog (core-public-name public) (core-public-kinds public)
                       (lambda (text) (archive-trial-trouble public text options)))))
    (archive-call-system public (list path) options)))

(defun archive-trial-trouble (public text options)
  "What is wrong with the archive TEXT when PUBLIC is called on it, or nil; nothing is saved."
  (archive-trouble
   (lambda ()
     (let ((archive (archive-of-text "the description" text)))
       (setf (archive-path archive) nil)
       (archive-run (archive-call-on public archive '() options))))))

(defun archive-call-system (public positional options)
  (archive-run (archive-call-on public (archive-open-system (car positional)) (cdr positional)
                                options)))

(defun archive-call-on (public archive trailing options)
  "The call of PUBLIC on ARCHIVE with what follows the system."
  (let ((call (archive-new-call public archive (archive-kind archive))))
    (archive-give-trailing call trailing)
    (archive-give-options call options)
    (setq *core-place* (lambda (section key) (archive-place archive section key)))
    call))

(defun archive-call-expressions (public positional options)
  (let* ((form (archive-matching-form public positional))
         (call (archive-new-call public nil (car form))))
    (archive-give-positional call (cdr form) positional)
    (archive-give-options call options)
    (archive-run call)))

(defun archive-run (call)
  "The value of the call's target, computed in the guard; new steps are saved."
  (setq *core-started* (get-internal-real-time))
  (core-guarded (archive-call-facts call)
                (lambda ()
                  (let ((target (core-public-name (archive-call-public call))))
                    (prog1 (archive-abbreviated call (archive-value call target))
                      (archive-save-steps call))))))

(setq *core-dispatcher* #'archive-dispatch)
