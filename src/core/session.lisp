;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A clean session: while we compute, Maxima is as it was born. Options have their defaults; the
;;; user's values, functions, rules, arrays, aliases, operators and properties are out of sight,
;;; also those of share packages that he loaded; afterwards, errors included, all is as it was.
;;; Facts are not looked at here. Look first at core-clean.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/born_symbols" "core/mended"))

(defvar *core-clean* nil "True in the clean session.")
(defvar *core-kept-values* nil
  "Variables that share packages bound in the clean session, with their values: seen there only.")
(defvar *core-kept-functions* nil
  "Functions and macros that share packages defined there: (name indicator definition).")

(defparameter *core-kept-variables*
  '($linenum $labels $inchar $outchar $linechar $context $contexts $activecontexts $error
    $error_syms $errormsg $load_pathname $file_search_maxima $file_search_lisp $file_search_demo
    $file_search_tests $file_search_usage $maxima_userdir $maxima_tempdir $maxima_objdir
    $features $% $%% $_ $__ $infolists $prompt $linel $stdin $stdout $transcript $debugmode
    $showtime $lasttime $plot_options $gnuplot_command $gnuplot_view_args $gnuplot_term
    $gnuplot_out_file $wxplot_size $wxplot_usesvg $random $version $build_info $ttyoff $gensumnum
    $testsuite_files $share_testsuite_files $factor_max_degree_print_warning $ratprint)
  "Variables that are not options of a computation, or whose change must last.")

(defparameter *core-lisp-options*
  '((modulus) (tellratlist) (varlist) (genvar) (genpairs) (greatorder) (lessorder) (checkfactors)
    (*ratweights) (*alphabet* #\_ #\%) (*read-base* . 10) (*print-base* . 10) (fpprec . 56)
    (bfhalf (bigfloat simp 56) #.(expt 2 55) 0) (bfmhalf (bigfloat simp 56) #.(- (expt 2 55)) 0)
    (bigfloatone (bigfloat simp 56) #.(expt 2 55) 1) (bigfloatzero (bigfloat simp 56) 0 0))
  "What Maxima's options, tellrat and the orders of names keep in variables of Lisp, as born.")

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

;;; Options

(defun core-other-value-p (name default)
  "Whether the variable NAME has another value than DEFAULT. (Most have the very same.)"
  (and (boundp name)
       (not (eq (symbol-value name) default))
       (not (equal (symbol-value name) default))))

(defun core-default-options ()
  "Two lists: option variables that differ from Maxima's defaults, and the defaults; and those whose
default is to print a line."
  (let ((names (mapcar #'car *core-lisp-options*)) (defaults (mapcar #'cdr *core-lisp-options*))
        (kept (append *core-kept-variables* (cdr $infolists))))
    (maphash (lambda (name default)
               (when (and (core-other-value-p name default)
                          (char= (char (string name) 0) #\$)
                          (not (constantp name))
                          (not (member name kept)))
                 (push name names)
                 (push default defaults)))
             *variable-initial-values*)
    (values (list* '$factor_max_degree_print_warning '$ratprint names) (list* nil nil defaults))))

(defun core-information-lists ()
  "The lists that Maxima keeps of what the user made: functions, rules, options set, ..."
  (remove-if-not #'boundp (set-difference (cdr $infolists) '($labels $contexts $activecontexts))))

(defun core-born-list (name)
  "An information list as it was at birth. (Maxima adds to these lists in place.)"
  (case name
    ($props (copy-list *builtin-$props*))
    ($rules (copy-list *builtin-$rules*))
    ($let_rule_packages (list '(mlist) '$default_let_rule_package))
    (t (list '(mlist simp)))))

;;; Operators: what the tokenizer takes for one, and the symbol it becomes

(defun core-token (text)
  "The symbol by which the parser knows the operator TEXT."
  (intern (concatenate 'string "$" (maybe-invert-string-case text)) :maxima))

(defun core-born-operator (text symbol)
  "What the operator TEXT, now SYMBOL, was at birth, or nil. (A user's becomes a name with $.)"
  (if (or (char/= (char (symbol-name symbol) 0) #\$)
          (equal (getf (core-born-properties symbol) 'op) text))
      symbol
      (car (getf (core-born-properties (core-token text)) 'mheader))))

(defun core-foreign-operators ()
  "Operators that the user made or changed: (text born now)."
  (let ((found '()))
    (maphash (lambda (text symbol)
               (let ((born (core-born-operator text symbol)))
                 (unless (eq born symbol) (push (list text born symbol) found))))
             *opr-table*)
    found))

(defun core-set-operators (operators key)
  (dolist (operator operators)
    (if (funcall key operator)
        (setf (gethash (car operator) *opr-table*) (funcall key operator))
        (remhash (car operator) *opr-table*))))

(defun core-with-born-operators (operators function)
  "Calls FUNCTION while the tokenizer knows none of OPERATORS but as at birth."
  (let* ((foreign (loop for (text born) in operators unless born collect text))
         (known (remove-if (lambda (item) (member item foreign :test #'equal)) symbols-defined)))
    (unwind-protect
         (progn
           (core-set-operators operators #'second)
           (if foreign
               (core-with-values '(symbols-defined macsyma-operators)
                                 (list known (cstrsetup known)) function)
               (funcall function)))
      (core-set-operators operators #'third))))

;;; Properties

;;; Words of results are scalars, though lists stand in them: else their products with lists and
;;; matrices stay undone. (mputprop would note them among the person's own properties.)
(dolist (word '(|$RealRoot| $piecewise))
  (setf (get word 'mprops) (list nil '$scalar t)))

(defun core-property-subset (plist test)
  (loop for (key value) on plist by #'cddr when (funcall test key) append (list key value)))

(defun core-own-properties (plist)
  (core-property-subset plist (complement #'core-lasting-p)))

(defun core-internal-p (symbol)
  "Whether SYMBOL is one of Maxima's own that its table of properties at birth leaves out: the
inside of abs, [..], lambda, true, ..."
  (and (not (find (char (symbol-name symbol) 0) "$%"))
       (not (nth-value 1 (core-born-properties symbol)))))

(defun core-internal-properties (symbol)
  "The properties of a core-internal-p SYMBOL without what the user gave it: those that kill()
removes, rules before their simplifier, the derivative of abs."
  (let ((plist (core-property-subset
                (symbol-plist symbol)
                (lambda (key) (not (or (member key opers)
                                       (member key '(mprops bindtest nonarray evfun evflag special
                                                     mode mainvar)))))))
        (rules (mget symbol 'oldrules)))
    (cond ((car (last rules)) (setf (getf plist 'operators) (car (last rules))))
          (rules (remf plist 'operators)))
    (when (eq symbol 'mabs) (setf (getf plist 'grad) '((x) ((mtimes) x ((mexpt) ((mabs) x) -1)))))
    plist))

(defun core-clean-properties (symbol)
  (if (core-internal-p symbol)
      (core-internal-properties symbol)
      (copy-tree (core-born-properties symbol))))

(defun core-named-symbols (item)
  "The symbols whose properties an entry ITEM of an information list stands for. (wxMaxima puts
strings that are no operators there.)"
  (cond ((stringp item) (list (core-token item) (getopr0 item)))
        ((consp item) (core-named-symbols (if (consp (car item)) (caar item) (car item))))
        ((symbolp item)
         (remove nil (list item (get item 'reversealias) (ruleof item) (get item 'match))))))

(defun core-touched-symbols (operators)
  "Symbols whose properties the user changed."
  (let ((named (append (mapcan (lambda (l) (mapcan #'core-named-symbols
                                                   (copy-list (cdr (symbol-value l)))))
                               (set-difference (core-information-lists)
                                               '($values $myoptions $let_rule_packages)))
                       (loop for (text nil now) in operators
                             append (list now (core-token text))))))
    (remove-duplicates
     (append (remove-if (lambda (s) (or (null s) (nth-value 1 (core-born-properties s))))
                        (append named (mapcar (lambda (s) (get s 'noun)) named)))
             (core-changed-symbols)))))

;;; Functions. Maxima forgets its own one when the user defines one of the same name or traces it.

(defun core-lisp-functions ()
  "Maxima's functions that are there now: (symbol . function)."
  (loop for symbol in *builtin-symbols*
        append (loop for name in (list symbol (getf (core-born-properties symbol) 'impl-name))
                     when (and name (fboundp name) (not (macro-function name))
                               (functionp (symbol-function name)))
                       collect (cons name (or (mget name 'trace-oldfun)
                                              (symbol-function name))))))

(defvar *core-born-functions* (core-lisp-functions) "As they were when the packages were loaded.")

(defun core-say-lost-functions ()
  "One line where the user had replaced functions of Maxima before the packages were loaded."
  (let ((lost (loop for symbol in *builtin-symbols*
                    when (and (getf (core-born-properties symbol) 'translated)
                              (not (fboundp symbol)))
                      collect (core-spelling symbol))))
    (when lost
      (core-say (format nil "dynarch: ~{~a~^, ~}: defined anew in this session, which Maxima ~
                             cannot undo; results may fail. Load the packages first" lost)))))

(defun core-with-functions (functions function)
  "Calls FUNCTION while each (symbol . definition) of FUNCTIONS holds; a symbol without a definition
has none."
  (let ((saved (loop for (name) in functions
                     collect (cons name (and (fboundp name) (symbol-function name))))))
    (flet ((put (functions)
             (loop for (name . definition) in functions
                   do (if definition
                          (setf (symbol-function name) definition)
                          (fmakunbound name)))))
      (unwind-protect (progn (put functions) (funcall function)) (put saved)))))

(defun core-replaced-functions ()
  (loop for (name . definition) in *core-born-functions*
        unless (and (fboundp name) (eq (symbol-function name) definition))
          collect (cons name definition)))

(defun core-callable-p (symbol)
  "Whether SYMBOL is the name of a rule or of a translated function of the user, functions of
Lisp."
  (and (fboundp symbol) (not (macro-function symbol))
       (not (nth-value 1 (core-born-properties symbol)))
       (or (member symbol (cdr $rules)) (get symbol 'translated))))

(defun core-merge-properties (symbol plist)
  "Gives SYMBOL the properties PLIST, but the lasting ones as they are."
  (setf (symbol-plist symbol)
        (append (core-own-properties plist)
                (core-property-subset (symbol-plist symbol) #'core-lasting-p))))

(defun core-put-kept-functions ()
  (loop for (name indicator definition) in *core-kept-functions*
        do (mputprop name definition indicator)))

(defun core-keep-functions ()
  "Notes the functions and macros that share packages have defined in the clean session."
  (loop for (list indicator) in '(($functions mexpr) ($macros mmacro)) do
    (loop for ((name)) in (cdr (symbol-value list)) do
      (when (mget name indicator)
        (setq *core-kept-functions*
              (cons (list name indicator (mget name indicator))
                    (remove name *core-kept-functions* :key #'car)))))))

(defun core-with-born-symbols (operators function)
  "Calls FUNCTION while no symbol has a property or function that the user gave it."
  (let* ((touched (core-touched-symbols operators))
         (saved (mapcar (lambda (s) (cons s (symbol-plist s))) touched))
         (functions (append *core-mended-functions* (core-replaced-functions)
                            (mapcar #'list (remove-if-not #'core-callable-p touched)))))
    (unwind-protect
         (progn (dolist (s touched) (core-merge-properties s (core-clean-properties s)))
                (core-put-kept-functions)
                (core-with-functions functions function))
      (loop for (s . plist) in saved do (core-merge-properties s plist)))))

;;; Orders of names: ordergreat and orderless read a name as another one, which sorts first or last

(defun core-typed-names (e)
  (cond ((consp e)
         (let* ((copy (list nil)) (end copy))
           (loop while (consp e)
                 do (setf (cdr end) (list (core-typed-names (pop e))) end (cdr end)))
           (setf (cdr end) (core-typed-names e))
           (cdr copy)))
        ((and (symbolp e) e (char/= (char (symbol-name e) 0) #\$)
              (member e (cdr $aliases)) (get e 'reversealias)))
        (t e)))

;;; Values

(defun core-put-away (name)
  "Keeps the value of NAME for the next clean session, and unbinds it."
  (setq *core-kept-values* (acons name (symbol-value name)
                                  (remove name *core-kept-values* :key #'car)))
  (makunbound name))

(defun core-with-clean-values (function)
  "Calls FUNCTION while no variable of the user has a value; those that come into being are put away
for the next time."
  (let ((lists (core-information-lists))
        (users (append (set-difference (cdr $values) *core-kept-variables*)
                       (remove-if-not #'boundp (cdr $arrays)))))
    (core-with-values
     (append lists users (mapcar #'car *core-kept-values*))
     (mapcar #'core-born-list lists)
     (lambda ()
       (unwind-protect
            (progn (loop for (name . value) in *core-kept-values* do (set name value))
                   (funcall function))
         (core-keep-functions)
         (dolist (name (cdr $values))
           (when (and (boundp name) (not (member name users))) (core-put-away name))))))))

(defun core-clean (function)
  "The value of FUNCTION in the clean session."
  (if *core-clean*
      (funcall function)
      (let ((*core-clean* t) (operators (core-foreign-operators)) (piece $piece))
        (multiple-value-bind (names defaults) (core-default-options)
          (unwind-protect
               (core-with-born-symbols
                operators
                (lambda ()
                  (core-with-born-operators
                   operators
                   (lambda ()
                     (core-with-values names defaults
                                       (lambda () (core-with-clean-values function)))))))
            (setq $piece piece)
            (core-reset-options names))))))

(defun core-reset-options (names)
  "Defaults for options other than NAMES, those that the user changed: a stop may have come between
a binding of Maxima's and its end."
  (multiple-value-bind (changed defaults) (core-default-options)
    (loop for name in changed
          for default in defaults
          unless (member name names) do (set name default))))

(defun core-clean-call (function arguments)
  "FUNCTION applied to ARGUMENTS in the clean session. Where names were ordered the arguments have
them as typed, and are simplified anew."
  (let ((ordered (or greatorder lessorder)) (typed (mapcar #'core-typed-names arguments)))
    (core-clean (lambda ()
                  (apply function (if ordered (mapcar #'resimplify typed) arguments))))))

(setq *core-reading* #'core-clean)
