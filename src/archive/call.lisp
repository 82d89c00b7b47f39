;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A call taken apart: what is the system, what are the arguments, which of the forms of the
;;; function it is. Everything given becomes a named quantity in the table `given', on a level with
;;; the keys of the archive, which it overrules; options are looked at in archive/options.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/argument_types" "archive/bare_graph" "archive/groups" "archive/names"
                "archive/open" "archive/patterns" "archive/types"))

(defstruct archive-call
  public archive kind
  (overruled '())                           ; (key . value): keys of [system] given in the call
  (given (make-hash-table :test #'equal))   ; name -> value: arguments and options
  (values (make-hash-table :test #'equal))  ; name -> value computed or read in this call
  (derived (make-hash-table :test #'equal)) ; name -> archive-derived of what is no public step
  (needs (make-hash-table :test #'equal))   ; name -> archive-need
  (sources '())                             ; (keys . values): what they stand for in the archive
  (new '())                                 ; steps computed, newest first
  (facts '()))

(defparameter *archive-common-options* '("save" "verbose" "progress" "limit" "size")
  "Options of every call.")

(defun archive-split-arguments (arguments)
  "Two values: the leading arguments, and the options, equations at the end."
  (let ((first-option (or (position-if #'archive-equation-p arguments) (length arguments))))
    (when (some #'archive-holds-set-p arguments)
      (core-error "an argument holds a set { }, in which order and equal items are lost; use [ ]"))
    (dolist (late (nthcdr first-option arguments))
      (unless (archive-equation-p late)
        (core-error "options such as save = false come after all other arguments; found ~a after ~
                     ~a"
                    (core-words (list late)) (core-words (list (nth first-option arguments))))))
    (values (subseq arguments 0 first-option) (nthcdr first-option arguments))))

(defun archive-system-p (argument public)
  "Whether ARGUMENT is a path or a description list."
  (and (or (core-public-kinds public) (core-public-trailing public))
       (or (stringp argument)
           (archive-graph-argument-p argument public)
           (and (archive-list-p argument)
                (some (lambda (e) (and (archive-equation-p e) (member (cadr e) '($kind $dynarch))))
                      (cdr argument))))))

(defun archive-graph-argument-p (argument public)
  "Whether ARGUMENT is the list of a circuit's graph, for a function of circuits."
  (and (member "circuit" (core-public-kinds public) :test #'string=)
       (archive-graph-list-p argument)))

(defun archive-open-system (system)
  "The archive of a path, as given or found by Maxima's file_search, of a description list, or of
the list of a graph."
  (cond ((archive-graph-list-p system) (archive-open-list (archive-graph-description system)))
        ((not (stringp system)) (archive-open-list system))
        ((core-existing-file system) (archive-open system))
        (t (archive-open-found system))))

(defun archive-open-found (path)
  (let ((found (car (core-attempt (lambda () ($file_search path))))))
    (if (stringp found)
        (let ((archive (archive-open found)))
          (setf (archive-found archive) t)
          archive)
        (archive-open path))))

(defun archive-new-call (public archive kind)
  (let ((call (make-archive-call :public public :archive archive :kind kind)))
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

(defun archive-matching-form (public values)
  (or (find-if (lambda (form) (archive-form-fits form values)) (core-public-forms public))
      (core-error "call it as ~{~a~^, or as ~}~a" (archive-call-patterns public)
                  (archive-needless-names public values))))

(defun archive-needless-names (public values)
  "What to say where VALUES are equations and what belongs to them, and a list of names too much."
  (let ((names (find-if #'archive-list-of-names-p (cdr values))))
    (if (and names (archive-rates-p (car values))
             (archive-equations-form public (1- (length values))))
        (format nil "; the names ~a follow from the equations: leave the list out"
                (archive-argument-shown names))
        "")))

(defun archive-option (call name default)
  (gethash name (archive-call-given call) default))
