;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The shapes of arguments and options in calls on expressions. What a function is given it
;;; computes with: a list where a formula is due, or a name that stands twice, would give an answer
;;; to another question, silently. What does not fit is refused here, in one sentence that says
;;; which argument, what was found and what to type. Look first at archive-check-argument.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/groups" "archive/keys" "archive/names" "archive/patterns"
                "archive/simplify" "archive/types"))

(defun archive-arguments-taken (arguments)
  "ARGUMENTS as the session gave them: what `rat' and `taylor' made in general form, and keys that
are variables of Maxima's by their names."
  (mapcar (lambda (argument)
            (archive-keys-by-name
             (if (archive-contains-p argument 'mrat) ($totaldisrep argument) argument)))
          arguments))

(defun archive-keys-by-name (argument)
  "ARGUMENT with the names of keys, of an option or of a description list, that arrive as values."
  (cond ((archive-equation-p argument) (archive-key-by-name argument))
        ((archive-list-p argument)
         (cons (car argument) (mapcar #'archive-key-by-name (cdr argument))))
        (t argument)))

(defun archive-key-by-name (e)
  "The equation E with its key by name: `functions', `values' and `verbose' are variables of Maxima
and always have values."
  (if (archive-equation-p e)
      (let ((left (cadr e)))
        (cond ((eq left $functions) (archive-equation '$functions (caddr e)))
              ((eq left $values) (archive-equation '$values (caddr e)))
              ((and (member left '(nil t)) (eq left $verbose) (member (caddr e) '(nil t)))
               (archive-equation '$verbose (caddr e)))
              (t e)))
      e))

;;; Types

(defparameter *archive-argument-types*
  '((:formula archive-as-formula "a formula")
    (:quantity archive-as-formula "a state, u(label), i(label) or v(node)")
    (:shape archive-as-shape "a formula, or a list, equation or matrix of formulas")
    (:variables archive-as-variables "a list of names, such as [phi, theta]")
    (:variable archive-as-variable "a name, such as lambda")
    (:motion archive-as-movement "a list such as [theta = 0, 'diff(theta,t) = w]")
    (:solution archive-as-solution "a list such as [theta = 0, 'diff(theta,t) = w]")
    (:rates archive-as-system "a list of equations such as ['diff(x,t) = y, 'diff(y,t) = -x]")
    (:integrals archive-as-integrals "a list of integrals such as [V0 = x^2 + y^2]")
    (:conditions archive-as-conditions "a list of conditions such as [a - mu^2 > 0]")
    (:branches archive-as-branches "a list such as [i1 = L1, i2 = L2]")
    (:interval archive-as-interval "a span of time, such as [t, 0, 10]")
    (:window archive-as-window
     "a variable or a velocity with the ends of its axis, such as [theta, -3, 3]")
    (:square archive-as-square "a matrix, such as matrix([1, 0], [0, 2])"))
  "As *archive-types*, for what is typed in the session: velocities are 'diff(q,t), names may have
subscripts, and a formula may stand for a law of its own.")

(defun archive-argument-type (name kind)
  "The type of the argument or option NAME in a call of KIND, or nil."
  (or (gethash (list name kind) *core-arguments*)
      (gethash name *core-arguments*)
      (let ((key (archive-find-key nil "system" name)))
        (and key (archive-key-type key)))))

(defun archive-argument-row (type)
  (or (assoc type *archive-argument-types*) (assoc type *archive-types*)))

(defun archive-check-argument (name value kind)
  "An error unless VALUE can be the argument or option NAME in a call of KIND."
  (let ((row (archive-argument-row (archive-argument-type name kind))))
    (when row
      (let ((trouble (catch 'archive-unfit (funcall (second row) value) nil)))
        (when trouble
          (when (archive-rates-p value) (setq trouble (archive-advice-on-rates trouble)))
          (core-error "~a must be ~a, found ~a~:[; ~a~;~]" name (third row)
                      (archive-argument-shown value) (string= trouble "") trouble))))))

(defun archive-rates-p (value)
  "Whether VALUE is a list of equations of motion."
  (and (archive-list-p value)
       (every #'archive-equation-p (cdr value))
       (null (catch 'archive-unfit (archive-as-system value) nil))))

(defun archive-list-of-names-p (value)
  (and (archive-list-p value) (cdr value) (every #'archive-variable-p (cdr value))))

(defun archive-advice-on-rates (trouble)
  "TROUBLE with equations of motion, or what the function called does with such."
  (let ((public (gethash *core-function* *core-publics*)))
    (if (and public (string= trouble "")) (archive-equations-advice public) trouble)))

(defun archive-argument-shown (value)
  "VALUE as Maxima spells it, cut after sixty letters."
  (core-cut (if (stringp value) (format nil "~s" value) (core-words (list value)))))

(defun archive-formula-p (value)
  (and (archive-expression-p value)
       (not (archive-head-p value 'lambda 'mqapply '$set 'mcond))
       (not (member value '($inf $minf $infinity $und $ind)))))

(defun archive-as-formula (value)
  (cond ((archive-formula-p value) value)
        ((archive-equation-p value) (archive-unfit "write it without ="))
        (t (archive-unfit))))

(defun archive-as-shape (value)
  (if (or (archive-list-p value) (archive-equation-p value) (archive-head-p value '$matrix))
      (mapc #'archive-as-shape (cdr value))
      (archive-as-formula value)))

(defun archive-variable-p (value)
  "A name, plain or with subscripts."
  (or (and (archive-symbol-p value) (not (eq value '$t)))
      (and (consp value) (consp (car value)) (member 'array (cdar value)) t)))

(defun archive-as-variable (value)
  (if (and (archive-variable-p value) (atom value)) value (archive-unfit)))

(defun archive-a-variable (value)
  (cond ((archive-variable-p value) value)
        ((eq value '$t) (archive-unfit "t is the time"))
        ((and (archive-equation-p value) (archive-variable-p (second value)))
         (archive-unfit "give the name alone"))
        (t (archive-unfit "~a is not a name" (archive-argument-shown value)))))

(defun archive-as-variables (value)
  (unless (archive-items value) (archive-unfit))
  (archive-check-distinct (mapcar #'archive-a-variable (archive-items value))))

(defun archive-time-derivative-p (value)
  (and (archive-head-p value '%derivative) (archive-variable-p (second value))
       (eq (third value) '$t) (null (cddddr value))))

(defun archive-as-conditions (value)
  (unless (archive-list-p value) (archive-unfit))
  (mapc #'archive-a-condition (cdr value)))

(defun archive-a-condition (value)
  (cond ((member value '(t nil)))
        ((archive-head-p value 'mand 'mor 'mnot) (mapc #'archive-a-condition (cdr value)))
        ((and (archive-head-p value 'mgreaterp 'mlessp 'mgeqp 'mleqp 'mequal '$equal 'mnotequal
                              '$notequal)
              (cddr value))
         (mapc #'archive-formula-inside (cdr value)))
        (t (archive-unfit "~a is no condition" (archive-argument-shown value)))))

(defun archive-as-movement (value)
  "Equations for coordinates and derivatives of coordinates, none twice."
  (archive-require-solved (archive-items value))
  (dolist (item (archive-items value))
    (unless (archive-equation-p item)
      (archive-unfit "~a is not an equation" (archive-argument-shown item)))
    (unless (archive-time-derivative-p (second item)) (archive-a-variable (second item)))
    (archive-formula-inside (third item)))
  (archive-check-distinct (archive-lefts value)))

(defun archive-require-solved (items)
  "[x = .., e = 0, dimension = d] of Equilibria is a set, of which one point may be named."
  (when (and (member '$dimension items :test #'eq :key (lambda (e) (and (consp e) (second e))))
             (member-if (lambda (e) (and (archive-equation-p e) (eql (third e) 0)
                                         (consp (second e))
                                         (not (archive-time-derivative-p (second e)))))
                        items))
    (archive-unfit "its equations e = 0 are not solved: give values to the parameters by where = ~
                    [..] in Equilibria, or name one solution, [x = .., ..]")))

(defun archive-as-solution (value)
  (cond ((archive-items value) (archive-as-movement value))
        ((and (archive-list-p value) (archive-may-be-emptied-p "solution")) value)
        (t (archive-unfit))))

(defun archive-may-be-emptied-p (option)
  "Whether OPTION = [] sets aside what the archive says, in the function that is called."
  (member option (gethash *core-function* *core-emptied*) :test #'string=))

(defun archive-formula-inside (value)
  (unless (archive-formula-p value)
    (archive-unfit "~a is not a formula" (archive-argument-shown value))))

(defun archive-as-system (value)
  "Equations, or formulas that vanish, some with derivatives."
  (unless (archive-items value) (archive-unfit))
  (dolist (item (archive-items value))
    (mapc #'archive-formula-inside (if (archive-equation-p item) (cdr item) (list item))))
  (unless (archive-contains-p value '%derivative)
    (archive-unfit "there is no derivative 'diff(x,t) in them")))

(defun archive-as-integrals (value)
  (dolist (item (archive-items value))
    (archive-formula-inside (archive-right-side item))))

(defun archive-as-interval (value)
  "Two ends, after the name of the time or without it."
  (let ((items (archive-items value)))
    (unless (= (length (if (eq (first items) '$t) (cdr items) items)) 2) (archive-unfit))
    (mapc #'archive-formula-inside items)))

(defun archive-as-window (value)
  "What an axis shows, and its two ends."
  (let ((items (archive-items value)))
    (unless (= (length items) 3) (archive-unfit))
    (unless (archive-time-derivative-p (first items)) (archive-a-variable (first items)))
    (mapc #'archive-formula-inside (rest items))))

(defun archive-as-branches (value)
  "Names of currents or voltages with their inductances or capacitances."
  (dolist (item (archive-items value))
    (unless (archive-equation-p item)
      (archive-unfit "~a is not an equation" (archive-argument-shown item)))
    (archive-a-variable (second item))
    (archive-formula-inside (third item)))
  (archive-check-distinct (archive-lefts value)))

(defun archive-as-square (value)
  (unless (and (archive-head-p value '$matrix) (cdr value)) (archive-unfit))
  (dolist (row (cdr value)) (mapc #'archive-formula-inside (cdr row))))
