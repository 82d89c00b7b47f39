;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a rule gave, with what was said meanwhile: checks, what is left out, warnings, the form to
;;; which the derivation came. Whoever takes a middle quantity repeats them. Those that the register
;;; marks as kept (circuit, network, scene) stay for the calls that follow, the last few of them,
;;; under what they depend on, the facts that hold and the version. Look first at archive-derive.

(in-package :maxima)

(defstruct archive-derived
  value
  (checks '()) (left-out '()) (warnings '())   ; newest first
  (report '())                                 ; (key . value) that stand with it, newest first
  (level '$canonical))

(defparameter *archive-kept-most* 8)

(defvar *archive-kept* '() "(key . archive-derived) of quantities that are kept, newest first.")

(defun archive-derive (rule inputs said)
  "The archive-derived of RULE's pure function applied to INPUTS, of which SAID, a list of
archive-derived, was said before."
  (let ((*core-checks* '()) (*core-left-out* '()) (*core-level* '$canonical)
        (*core-warnings-now* '()) (*core-report* '()))
    (mapc #'archive-say-again said)
    (let ((value (core-apply-rule rule inputs)))
      (make-archive-derived :value value :checks *core-checks* :left-out *core-left-out*
                            :warnings *core-warnings-now* :level *core-level*
                            :report *core-report*))))

(defun archive-say-again (derived)
  "Repeats what was said when a part was DERIVED; a warning once in a call."
  (dolist (text (reverse (archive-derived-checks derived)))
    (pushnew text *core-checks* :test #'string=))
  (dolist (text (reverse (archive-derived-left-out derived)))
    (pushnew text *core-left-out* :test #'string=))
  (dolist (text (reverse (archive-derived-warnings derived))) (core-warn "~a" text))
  (unless (eq (archive-derived-level derived) '$canonical) (core-factored)))

(defun archive-kept-key (name sources options facts)
  "The key of the quantity NAME that depends on SOURCES, OPTIONS and FACTS."
  (list name sources options facts *core-version*))

(defun archive-kept (key make)
  "The archive-derived kept under KEY, else that which the function MAKE gives, kept from now on."
  (let ((found (assoc key *archive-kept* :test #'equal)))
    (unless found (setq found (cons key (funcall make))))
    (setq *archive-kept*
          (cons found (remove found *archive-kept*)))
    (when (nthcdr *archive-kept-most* *archive-kept*)
      (setq *archive-kept* (butlast *archive-kept*)))
    (cdr found)))

(defun archive-own-lists (value)
  "VALUE with lists and matrices of its own: a person may write into what a call returned, and must
not reach what is kept."
  (if (and (consp value) (consp (car value)) (member (caar value) '(mlist $matrix mequal)))
      (cons (car value) (mapcar #'archive-own-lists (cdr value)))
      value))
