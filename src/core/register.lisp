;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The register of who can compute what. A QUANTITY has a name: a public function ("Lagrangian")
;;; or a key ("coordinates"). A RULE says how a quantity of a kind of archive comes about: a pure
;;; function of a part applied to other quantities, a key of the description, or a part of a
;;; record. A KIND is a kind of archive: its sections and keys, and the quantities that it has. Each
;;; room states its own as data in register.lisp; the dispatcher follows them.

(in-package :maxima)

(defvar *core-publics* (make-hash-table :test #'equal) "Name -> core-public.")
(defvar *core-rules* (make-hash-table :test #'equal) "Name of a quantity -> list of core-rule.")

(defstruct core-public
  name
  forms      ; list of (kind quantity ..), calls on expressions; &optional may stand among them
  trailing   ; quantities that may follow a system: FirstApproximation(system, solution)
  options    ; names of the options besides the common ones
  kinds      ; kinds of archive the dialog may ask for
  numerical) ; t where `values', `start' and `time' count

(defstruct (core-rule (:conc-name rule-))
  kinds given part function inputs same record field
  kept   ; t for a middle quantity: what it gives is kept for the calls that follow
  tried  ; the quantity of which this one is [value], or the text of the error that ends it
  later  ; the quantity that this one gives when it is asked
  act)   ; t for what a call does at its end

(defun core-public (name &key forms trailing options kinds numerical)
  "States a public function. FORMS of calls on expressions; TRAILING arguments after a system."
  (setf (gethash name *core-publics*)
        (make-core-public :name name :forms forms :trailing trailing :options options :kinds kinds
                          :numerical numerical)))

(defvar *core-emptied* (make-hash-table :test #'equal) "Name of a public function -> options.")

(defun core-emptied (name &rest options)
  "States that each of OPTIONS may be [] in the public function NAME: what the archive says of it is
set aside."
  (setf (gethash name *core-emptied*) options))

;;; Options

(defvar *core-options* (make-hash-table :test #'equal) "Name -> the type of its value.")

(defun core-option (type &rest names)
  "States what the value of the options NAMES is: :truth, :seconds, :factor, :file, or one of the
words in the list TYPE. Values of other options are looked at where they are used."
  (dolist (name names) (setf (gethash name *core-options*) type)))

;;; Arguments

(defvar *core-arguments* (make-hash-table :test #'equal)
  "Name of an argument, or (name kind) -> its type.")

(defun core-argument (type &rest names)
  "States what the arguments NAMES of calls on expressions are, and options of these names: one of
the types in src/archive/argument_types.lisp. (name kind) is the argument in calls of that kind. A
key of [system] for which nothing is stated has its type there."
  (dolist (name names) (setf (gethash name *core-arguments*) type)))

;;; Rules

(defun core-same-case-p (rule other)
  (and (equal (rule-kinds rule) (rule-kinds other)) (equal (rule-given rule) (rule-given other))
       (eq (rule-act rule) (rule-act other))))

(defun core-add-rule (name rule)
  (setf (gethash name *core-rules*)
        (append (remove rule (gethash name *core-rules*) :test #'core-same-case-p) (list rule))))

(defun core-rule (name kinds part function &rest inputs)
  "NAME is FUNCTION of PART applied to INPUTS: names, or (name default). KINDS is a list of kinds
or :any."
  (core-add-rule name (make-core-rule :kinds kinds :part part :function (core-symbol function)
                                      :inputs inputs)))

(defun core-middle (name kinds part function &rest inputs)
  "The same for a middle quantity, which much is computed from and which is dear: it is kept."
  (apply #'core-rule name kinds part function inputs)
  (setf (rule-kept (core-find-rule name (if (consp kinds) (car kinds) kinds) (constantly nil))) t))

(defun core-rule-given (option name kinds part function &rest inputs)
  "The same where OPTION is given, in the call or as a key of the archive; where it is (option
value), only with that value; where it is :file, for systems that are files; where it is (:edited
name), where the archive's result NAME was edited by hand; (:without section): where SECTION has no
rows."
  (core-add-rule name (make-core-rule :kinds kinds :given option :part part
                                      :function (core-symbol function) :inputs inputs)))

(defun core-rule-same-as (name kinds other &key given)
  "NAME is the quantity or key OTHER under another name."
  (core-add-rule name (make-core-rule :kinds kinds :given given :same other)))

(defun core-rule-field (name kinds record field)
  "NAME is the part FIELD of the quantity RECORD."
  (core-add-rule name (make-core-rule :kinds kinds :record record :field field)))

(defun core-rule-tried (name kinds other)
  "NAME is [value] of the quantity OTHER, or the text of the error that ends it: for what does
without."
  (core-add-rule name (make-core-rule :kinds kinds :tried other)))

(defun core-rule-later (name kinds other)
  "NAME gives the quantity OTHER when it is asked, by core_asked(NAME): for what is dear and may not
be needed."
  (core-add-rule name (make-core-rule :kinds kinds :later other)))

(defun $core_asked (later)
  "The value of the quantity that LATER, stated by core-rule-later, gives."
  (funcall later))

(defun core-act (name given kinds part function &rest inputs)
  "States what a call of the public function NAME does at its end, such as drawing: FUNCTION of PART
applied to INPUTS, NAME itself perhaps among them, gives the value of the call. It is done in each
call; what it gives is stored nowhere. GIVEN as in core-rule-given, nil for always."
  (core-add-rule name (make-core-rule :kinds kinds :given given :part part :act t
                                      :function (core-symbol function) :inputs inputs)))

;;; Kinds of archive

(defvar *core-kinds* '() "The core-kind records, in the order in which they are named.")

(defstruct core-kind
  name
  about      ; what such an archive describes
  first      ; rows of the keys of [system] that stand before those of all kinds
  keys       ; rows of its other keys of [system]
  sections   ; its other sections: ((word form meaning detail) row ..)
  instead    ; the key of [system] that may stand instead of the sections of rows, or nil
  completed  ; part and function that make of [system] and the other sections what they imply
  agreement  ; part and function that look whether the keys of a description agree
  gives)     ; the quantities that it has: names, or (name other)

(defun core-kind (name about &rest parts)
  "States a kind of archive; PARTS are keywords and values, the other fields of the record. Rows:
see src/archive/keys.lisp. What it gives is a name, for which a rule is stated, or (name other), the
quantity or key OTHER under that name."
  (let ((kind (apply #'make-core-kind :name name :about about parts)))
    (loop for item in (core-kind-gives kind)
          when (consp item) do (core-rule-same-as (first item) (list name) (second item)))
    (setq *core-kinds*
          (append (remove name *core-kinds* :key #'core-kind-name :test #'string=) (list kind)))))

(defun core-call (place &rest arguments)
  "The value of the function of PLACE = (part function), its part loaded."
  (core-require (first place))
  (apply (second place) arguments))

(defun core-find-kind (name) (find name *core-kinds* :key #'core-kind-name :test #'equal))

(defun core-kind-names () (mapcar #'core-kind-name *core-kinds*))

(defun core-kinds-giving (quantity)
  "Names of the kinds of archive that have QUANTITY."
  (loop for kind in *core-kinds*
        when (find quantity (core-kind-gives kind)
                   :test #'string= :key (lambda (item) (if (consp item) (first item) item)))
          collect (core-kind-name kind)))

;;; Names

(defun core-read-symbol (symbol)
  "SYMBOL as Maxima's own reader gives it: gamma, zeta and lambda are %gamma, %zeta and lambda
without $ inside."
  (let ((alias (get symbol 'alias)))
    (if (and alias (char/= (char (symbol-name alias) 0) #\$)) alias symbol)))

(defun core-symbol (name)
  "The Maxima symbol that a person spells NAME."
  (core-read-symbol (intern (maybe-invert-string-case (concatenate 'string "$" name)) :maxima)))

(defun core-spelling (symbol)
  "How a person spells SYMBOL."
  (let ((name (maybe-invert-string-case (string (or (get symbol 'reversealias) symbol)))))
    (if (and (plusp (length name)) (char= (char name 0) #\$)) (subseq name 1) name)))

;;; The rule that serves

(defun core-rule-fits (rule kind given)
  "Whether RULE serves an archive of KIND; GIVEN tells whether the rule's condition holds, one of
those of core-rule-given."
  (and (or (eq (rule-kinds rule) :any) (member kind (rule-kinds rule) :test #'equal))
       (or (null (rule-given rule)) (funcall given (rule-given rule)))))

(defun core-rule-rank (rule)
  "The special before the general."
  (+ (cond ((null (rule-given rule)) 2) ((consp (rule-given rule)) 0) (t 1))
     (if (eq (rule-kinds rule) :any) 3 0)))

(defun core-find-rule (name kind given &optional act)
  "The rule for quantity NAME, or nil; with ACT that for what a call of NAME does."
  (let ((best nil))
    (dolist (rule (gethash name *core-rules*) best)
      (when (and (eq (rule-act rule) act) (core-rule-fits rule kind given)
                 (or (null best) (< (core-rule-rank rule) (core-rule-rank best))))
        (setq best rule)))))

(defun core-rule-ready-p (rule)
  "Whether the pure function that RULE names is there, its part loaded."
  (core-require (rule-part rule))
  (or (fboundp (rule-function rule)) (mget (rule-function rule) 'mexpr)))

(defun core-apply-rule (rule inputs)
  "The pure function of RULE applied to INPUTS."
  (unless (core-rule-ready-p rule)
    (core-error "~a is not in src/~a" (core-spelling (rule-function rule)) (rule-part rule)))
  (apply #'mfuncall (rule-function rule) inputs))

(defvar *core-abbreviator* nil
  "Part and function that express a result in the archive's abbreviations.")

(defun core-abbreviator (part function)
  (setq *core-abbreviator* (cons part (core-symbol function))))
