;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The guard around every computation: option variables at Maxima's own defaults, the user's
;;; variables and dependencies out of sight, facts in a context of their own, no question asked;
;;; and everything as it was afterwards, errors included. Maxima's variables are global, so setting
;;; and restoring their values does nearly all of it.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/facts"))

(defvar *core-guarded* nil "True inside the guard.")
(defvar *core-kept-values* nil
  "Variables that share packages bound while guarded, with their values: seen inside the guard
only.")

(defparameter *core-kept-variables*
  '($linenum $labels $inchar $outchar $linechar $context $contexts $activecontexts $error
    $error_syms $errormsg $load_pathname $file_search_maxima $file_search_lisp $file_search_demo
    $file_search_tests $file_search_usage $maxima_userdir $maxima_tempdir $maxima_objdir
    $features $% $%% $_ $__ $infolists $prompt $linel $stdin $stdout $transcript $debugmode
    $showtime $lasttime $plot_options $gnuplot_command $gnuplot_view_args $gnuplot_term
    $gnuplot_out_file $random $version $build_info $ttyoff $gensumnum $testsuite_files
    $share_testsuite_files $factor_max_degree_print_warning)
  "Variables that are not options of a computation, or whose change must last.")

(defun core-with-values (names values function)
  "Calls FUNCTION while NAMES have VALUES, or none where VALUES run out. (GCL cannot load a
compiled progv.)"
  (let ((saved (mapcar (lambda (name)
                         (if (boundp name) (list name (symbol-value name)) (list name)))
                       names)))
    (unwind-protect
         (progn
           (loop for name in names
                 do (if values (set name (pop values)) (makunbound name)))
           (funcall function))
      (loop for (name . value) in saved
            do (if value (set name (car value)) (makunbound name))))))

(defun core-information-lists ()
  "The lists that Maxima keeps of what the user made: functions, rules, options set, ...; and the
last `piece' of an expression."
  (remove-if-not #'boundp (cons '$piece (set-difference (cdr $infolists)
                                                        '($labels $contexts $activecontexts)))))

(defun core-default-options ()
  "Two lists: option variables that differ from Maxima's defaults, and the defaults; and one whose
default is to print a line."
  (let ((names '()) (defaults '()) (kept (append *core-kept-variables* (cdr $infolists))))
    (maphash (lambda (name default)
               (when (and (char= (char (string name) 0) #\$) (boundp name)
                          (not (eq (symbol-value name) default))
                          (not (equal (symbol-value name) default))
                          (not (constantp name))
                          (not (member name kept)))
                 (push name names)
                 (push default defaults)))
             *variable-initial-values*)
    (values (cons '$factor_max_degree_print_warning names) (cons nil defaults))))

(defun core-refuse-question (message &rest ignored)
  (declare (ignore ignored))
  (merror "~A" (format nil "undecided question: ~a"
                       (remove #\Newline (core-words (if (and (consp message) (consp (car message)))
                                                         (cdr message)
                                                         (list message)))))))

(defun core-without-questions (function)
  "Calls FUNCTION; where Maxima would ask the person something, an error is signalled instead."
  (let ((asking (symbol-function 'retrieve)))
    (unwind-protect (progn (setf (symbol-function 'retrieve) #'core-refuse-question)
                           (funcall function))
      (setf (symbol-function 'retrieve) asking))))

(defun core-without-dependencies (function)
  "Calls FUNCTION while no symbol depends on another."
  (let ((saved (loop for entry in (cdr $dependencies)
                     collect (cons (caar entry) (mget (caar entry) 'depends)))))
    (unwind-protect (progn (loop for (name) in saved do (mremprop name 'depends))
                           (funcall function))
      (loop for (name . list) in saved do (mputprop name list 'depends)))))

(defun core-put-away (name)
  "Keeps the value of NAME for the next use of the guard, and unbinds it."
  (setq *core-kept-values* (acons name (symbol-value name)
                                  (remove name *core-kept-values* :key #'car)))
  (makunbound name))

(defun core-hide-new-values (before)
  "Variables that came into being inside the guard are put away for its next use."
  (dolist (name (cdr $values))
    (when (and (boundp name) (not (member name before))) (core-put-away name))))

(defun core-guarded (facts function)
  "The value of FUNCTION in a clean session with FACTS."
  (if *core-guarded*
      (funcall function)
      (let ((*core-guarded* t) (lists (core-information-lists)) (users (copy-list (cdr $values))))
        (flet ((clean-values ()
                 (core-with-values
                  (append lists users (mapcar #'car *core-kept-values*))
                  (mapcar (lambda (l) (if (listp (symbol-value l))
                                          (copy-list (symbol-value l))
                                          (symbol-value l)))
                          lists)
                  (lambda ()
                    (unwind-protect
                         (progn
                           (loop for (name . value) in *core-kept-values* do (set name value))
                           (core-without-questions (lambda () (core-with-facts facts function))))
                      (core-hide-new-values users))))))
          (multiple-value-bind (names defaults) (core-default-options)
            (core-with-values names defaults
                              (lambda () (core-without-dependencies #'clean-values))))))))

(defun core-failure-text (condition)
  "What to tell the person of a Lisp error."
  (format nil
          "~@[~a: ~]the computation failed inside (~a); please report it with the input that ~
           shows it"
          *core-function*
          (remove #\Newline (princ-to-string condition))))

(defun core-caught (function)
  "Two values: what FUNCTION returns, and nil or the text of the error that ended it. Maxima's own
bindings are undone."
  (let ((text nil) (values nil) (*merror-signals-$error-p* t) (errcatch (cons bindlist loclist)))
    (declare (special errcatch))
    (handler-case
        (setq values (catch 'core-throw (with-errcatch-tag-$errors (funcall function))))
      (maxima-$error () (setq text (core-error-text)))
      #+sbcl (sb-sys:interactive-interrupt (c) (errlfun1 errcatch) (error c))
      #+sbcl (storage-condition ()
               (setq text (format nil "~@[~a: ~]memory is exhausted; give Maxima a larger heap, ~
                                       or a smaller system" *core-function*)))
      (error (condition) (setq text (core-failure-text condition))))
    (when text (errlfun1 errcatch))
    (values values text)))

(defun core-error-text ()
  "The text of Maxima's last error, with the name of the function before it."
  (let* ((text (if (and (cdr $error) (stringp (cadr $error)))
                   (if (and (equal (cadr $error) "~A") (stringp (caddr $error)))
                       (caddr $error)
                       (string-right-trim '(#\Newline #\Space)
                                          (with-output-to-string (*standard-output*) ($errormsg))))
                   "unknown error"))
         (prefix (and *core-function* (concatenate 'string *core-function* ": "))))
    (if (and prefix (not (eql (search prefix text) 0))) (concatenate 'string prefix text) text)))
