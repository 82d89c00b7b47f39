;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The register of who can compute what. A QUANTITY has a name: a public function ("Lagrangian") or a key ("coordinates").
;;; A RULE says how a quantity of a kind of archive comes about: a pure function of a part applied to other quantities, a
;;; key of the description, or a part of a record. Each room states its rules as data in register.lisp; the dispatcher follows them.

(in-package :maxima)

(defvar *core-publics* (make-hash-table :test #'equal) "Name -> core-public.")
(defvar *core-rules* (make-hash-table :test #'equal) "Name of a quantity -> list of core-rule.")

(defstruct core-public
  name
  forms      ; list of (kind quantity ..): calls on expressions; &optional may stand among the quantities
  trailing   ; quantities that may follow a system: FirstApproximation(system, solution)
  options    ; names of the options besides the common ones
  kinds      ; kinds of archive the dialog may ask for
  numerical) ; t where `values', `start' and `time' count

(defstruct core-rule kinds part function inputs key record field)

(defun core-public (name &key forms trailing options kinds numerical)
  "States a public function. FORMS of calls on expressions; TRAILING arguments after a system."
  (setf (gethash name *core-publics*)
        (make-core-public :name name :forms forms :trailing trailing :options options :kinds kinds :numerical numerical)))

(defun core-add-rule (name rule)
  (setf (gethash name *core-rules*)
        (append (remove (core-rule-kinds rule) (gethash name *core-rules*) :key #'core-rule-kinds :test #'equal)
                (list rule))))

(defun core-rule (name kinds part function &rest inputs)
  "NAME is FUNCTION of PART applied to INPUTS: names, or (name default). KINDS is a list of kinds or :any."
  (core-add-rule name (make-core-rule :kinds kinds :part part :function (core-symbol function) :inputs inputs)))

(defun core-rule-key (name kinds key)
  "NAME is the value of KEY in the description."
  (core-add-rule name (make-core-rule :kinds kinds :key key)))

(defun core-rule-field (name kinds record field)
  "NAME is the part FIELD of the quantity RECORD."
  (core-add-rule name (make-core-rule :kinds kinds :record record :field field)))

(defun core-symbol (name)
  "The Maxima symbol that a person spells NAME."
  (intern (maybe-invert-string-case (concatenate 'string "$" name)) :maxima))

(defun core-spelling (symbol)
  "How a person spells SYMBOL."
  (let ((name (maybe-invert-string-case (string symbol))))
    (if (and (plusp (length name)) (char= (char name 0) #\$)) (subseq name 1) name)))

(defun core-find-rule (name kind)
  "The rule for quantity NAME of an archive of KIND, the special before the general."
  (let ((rules (gethash name *core-rules*)))
    (or (find-if (lambda (r) (and (listp (core-rule-kinds r)) (member kind (core-rule-kinds r) :test #'equal))) rules)
        (find :any rules :key #'core-rule-kinds))))

(defun core-kinds-of (name)
  "The kinds of archive that have a rule of their own for NAME."
  (remove-duplicates (loop for r in (gethash name *core-rules*)
                           when (listp (core-rule-kinds r)) append (core-rule-kinds r))
                     :test #'equal :from-end t))
