;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What stands in arguments that have the right shape: spellings that cannot mean what they say,
;;; as x(t) for a coordinate, Cos[th], inf; names that do not occur in what they belong to, where
;;; equations 0 = 0 would come. Descriptions are looked at for the spellings too.
;;; Look first at archive-check-arguments.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/argument_types" "archive/function_values" "archive/groups"
                "archive/names" "archive/types"))

(defun archive-map-parts (function value)
  "Calls FUNCTION on VALUE and all its parts."
  (funcall function value)
  (unless (atom value)
    (dolist (part (cdr value)) (archive-map-parts function part))))

(defun archive-occurs-p (x value)
  (or (equal x value)
      (and (consp value)
           (or (and (consp x) (archive-head-p value (caar x)) (equal (cdr x) (cdr value)))
               (some (lambda (part) (archive-occurs-p x part)) (cdr value))))))

;;; Names that move

(defun archive-differentiated-names (value)
  (let ((names '()))
    (archive-map-parts (lambda (part)
                         (when (archive-time-derivative-p part)
                           (pushnew (second part) names :test #'equal)))
                       value)
    names))

(defun archive-moving-arguments (given)
  "The names that move in a call: coordinates, variables, what is differentiated or has a motion."
  (let ((names '()))
    (maphash (lambda (name value)
               (setq names
                     (append (cond ((member name '("coordinates" "variables") :test #'string=)
                                    (cdr value))
                                   ((member name '("motion" "solution" "inductances"
                                                   "capacitances")
                                            :test #'string=)
                                    (archive-lefts value)))
                             (archive-differentiated-names value)
                             names)))
             given)
    (remove-if-not #'archive-variable-p names)))

;;; Spellings

(defun archive-strange-part (part moving)
  "What to say of a PART that cannot mean what it says where the names MOVING move, or nil."
  (cond ((member part '($inf $minf $infinity $und $ind)) "is no number")
        ((atom part) nil)
        ((archive-head-p part '%derivative) (archive-strange-derivative part moving))
        ((archive-head-p part '%sum '%product '%lsum)
         "has no definite number of terms; give whole numbers as its limits, or a function f(x)")
        ((and (member (caar part) moving) (cdr part) (not (member 'array (cdar part))))
         (format nil "has no place here: write ~a for the coordinate and 'diff(~:*~a,t) for its ~
                      velocity"
                 (core-spelling (caar part))))
        ((archive-meant-function part)
         (format nil "is no function of Maxima; ~a?" (archive-meant-text part)))
        ((member 'array (cdar part))
         (and (some (lambda (x) (archive-occurs-p x (cons '(mlist) (cdr part)))) moving)
              "is a name with a subscript, and constant; a function is written with ( )"))))

;; 'diff(q,t) is a velocity, that of a formula is none: what moves in it would be taken as constant

(defun archive-explicit-time-p (e)
  "Whether t occurs in E, velocities aside."
  (cond ((atom e) (eq e '$t))
        ((archive-time-derivative-p e) nil)
        (t (some #'archive-explicit-time-p (cdr e)))))

(defun archive-partial-in-time-p (e)
  "Whether 'diff(E,t) is a partial derivative that is not carried out, as of f(x,t) and max(x,t)."
  (and (archive-explicit-time-p e)
       (not (member (caar e) '(mplus mtimes mexpt mnctimes)))
       (not (get (caar e) 'grad))))

(defun archive-strange-derivative (part moving)
  (destructuring-bind (e x &optional order &rest others) (cdr part)
    (let ((inside (remove-if-not (lambda (x) (archive-occurs-p x e))
                                 (remove-duplicates moving :test #'equal))))
      (cond ((member e moving :test #'equal)
             (unless (and (eq x '$t) (integerp order) (plusp order) (null others))
               (format nil "is no derivative of ~a by the time t" (archive-argument-shown e))))
            ((and inside (member '$t (cddr part)) (not (archive-variable-p e))
                  (not (archive-partial-in-time-p e)))
             (format nil "is the derivative of a formula; write it in velocities, as ~
                          TimeDerivative(~a, [~{~a~^, ~}]) does" (archive-argument-shown e)
                     (mapcar #'archive-argument-shown inside)))))))

(defun archive-check-spellings (value moving fault)
  "Calls FAULT with a text for the first strange part of VALUE."
  (archive-map-parts
   (lambda (part)
     (let ((trouble (archive-strange-part part moving)))
       (when trouble
         (funcall fault (format nil "~a ~a" (archive-argument-shown part) trouble)))))
   value))

(defun archive-check-description-spellings (description)
  "An error for the first strange spelling in a DESCRIPTION; its own functions are its own."
  (let ((own (append (cdr ($core_get description '$functions '((mlist))))
                     (mapcar #'caar (archive-lefts ($core_get description '$laws '((mlist)))))))
        (moving (mapcar #'car (archive-moving-names description))))
    (labels ((check (section equations)
               (loop for (nil key value) in equations
                     do (if (stringp key)
                            (check key (cdr value))
                            (look section key value))))
             (look (section key value)
               (when (archive-occurs-p '$%i value)
                 (core-fault section key "~a: ~a" (archive-key-text key) *archive-wanted-real*))
               (archive-check-spellings
                (archive-without-functions own value) moving
                (lambda (text) (core-fault section key "~a: ~a" (archive-key-text key) text)))))
      (check "system" (cdr description))
      (archive-check-special-case ($core_get description '$where '((mlist))) moving
                                  (lambda (text) (core-fault "system" '$where "where: ~a" text))))))

(defun archive-without-functions (own value)
  "VALUE with the arguments alone of the functions OWN."
  (cond ((atom value) value)
        ((member (caar value) own)
         (cons '(mlist) (mapcar (lambda (part) (archive-without-functions own part))
                                (cdr value))))
        (t (cons (car value) (mapcar (lambda (part) (archive-without-functions own part))
                                     (cdr value))))))

;;; Names that do not occur

(defparameter *archive-functions-of*
  '(("Lagrangian" "coordinates" "rayleigh" "forces" "constraints" "nonholonomic")
    ("K" "variables")
    ("equations" "variables"))
  "Arguments in which all the names of another one should occur, and others where they may.")

(defun archive-of-integrals-p (function given)
  "Whether FUNCTION is one of first integrals of equations, in their names."
  (and (string= function "K") (nth-value 1 (gethash "equations" given))))

(defun archive-check-occurrence (given)
  "An error where none of the names occurs in what they belong to, a warning where some do not."
  (loop for (function list . others) in *archive-functions-of*
        for names = (cdr (gethash list given))
        for value = (gethash function given)
        do (when (and names value (not (archive-of-integrals-p function given)))
             (let* ((all (cons value (mapcar (lambda (name) (gethash name given)) others)))
                    (absent (remove-if (lambda (x) (archive-occurs-p x (cons '(mlist) all)))
                                       names)))
               (cond ((= (length absent) (length names))
                      (archive-fault-constant function value names))
                     (absent
                      (core-warn "not in ~a: ~{~a~^, ~}" function
                                 (mapcar #'archive-argument-shown absent))))))))

;; diff(x,t) without the quote is 0 before any function sees it

(defun archive-check-velocities (given)
  "A warning where L has no velocity at all."
  (multiple-value-bind (L there) (gethash "Lagrangian" given)
    (let ((x (car (last (gethash "coordinates" given)))))
      (when (and there x (null (archive-differentiated-names L)))
        (core-warn "no velocity in Lagrangian; it is written 'diff(~a,t), without the quote it is 0"
                   (archive-argument-shown x))))))

(defun archive-fault-constant (name value variables)
  (if (symbolp value)
      (core-error "~a is the name ~a, which has no value; give it one, or type the function" name
                  (archive-argument-shown value))
      (core-error "~a contains none of ~{~a~^, ~}, found ~a" name
                  (mapcar #'archive-argument-shown variables) (archive-argument-shown value))))

(defun archive-check-derivatives (given kind)
  "Only variables are differentiated in equations, and nothing in a function of variables."
  (let* ((variables (cdr (gethash "variables" given)))
         (name (if (string= kind "function") "K" "equations"))
         (other (and variables
                     (set-difference (archive-differentiated-names (gethash name given))
                                     (if (string= name "K") '() variables) :test #'equal))))
    (when other
      (core-error "~a: found 'diff(~a,t)~a" name (archive-argument-shown (car other))
                  (if (string= name "K")
                      " in a function of the variables"
                      (format nil "; add ~a to the variables"
                              (archive-argument-shown (car other))))))))

(defun archive-check-potential (given)
  "A potential that is a name alone, which no state has."
  (let ((P (gethash "MixedPotential" given)))
    (when (and (archive-symbol-p P)
               (loop for name in '("inductances" "capacitances")
                     never (member P (archive-lefts (gethash name given)))))
      (archive-fault-constant "MixedPotential" P '()))))

(defun archive-check-integrals (given)
  "A constant is no integral."
  (let ((variables (cdr (gethash "variables" given))))
    (dolist (item (and variables (cdr (gethash "integrals" given))))
      (let ((e (archive-right-side item)))
        (unless (some (lambda (x) (archive-occurs-p x e)) variables)
          (core-error "integrals: ~a is a constant" (archive-argument-shown item)))))))

(defun archive-check-options-used (given)
  "Unknowns and special cases are of names that occur: `none' and `no solution' would be said of
others."
  (let ((function (find-if (lambda (name) (nth-value 1 (gethash name given)))
                           '("equations" "K" "Lagrangian"))))
    (when function
      (loop for (option . names) in (list (cons "unknowns" (cdr (gethash "unknowns" given)))
                                          (cons "where" (archive-lefts (gethash "where" given))))
            for absent = (find-if-not (lambda (x) (archive-used-elsewhere-p x option given)) names)
            do (when absent
                 (core-error "~a: ~a does not occur in ~a" option
                             (archive-argument-shown absent) function))))))

(defun archive-used-elsewhere-p (x option given)
  "Whether X occurs in an argument or option other than OPTION, or on the right of it."
  (loop for name being the hash-keys of given using (hash-value value)
        thereis (archive-occurs-p x (cond ((string/= name option) value)
                                          ((string= name "where")
                                           (archive-list (archive-rights value)))))))

;;; All of a call

(defparameter *archive-complex-arguments*
  '("expression" "motion" "program" "file" "language" "polynomial" "A" "M" "S" "W")
  "Arguments that may be complex, or are no formulas; functions of matrices and of polynomials say
themselves what they take.")

(defparameter *archive-wanted-real* "found %i; real expressions are wanted")

(defun archive-given-pairs (given)
  "The table GIVEN as a list (name . value), in one order on every Lisp."
  (sort (loop for name being the hash-keys of given using (hash-value value)
              collect (cons name value))
        #'string< :key #'car))

;; A special case is one of parameters: it is put in after the derivatives have been taken

(defun archive-check-special-case (where moving fault)
  "Calls FAULT with a text where the list WHERE says that something is what moves."
  (dolist (equation (cdr where))
    (destructuring-bind (left value) (cdr equation)
      (let ((x (find-if (lambda (x) (archive-occurs-p x value)) moving)))
        (when x
          (funcall fault (format nil "the value of ~a contains ~a, which moves; write it into the ~
                                      equations" (archive-argument-shown left)
                                 (archive-argument-shown x))))))))

;; Signs and zeros are those of real names

(defun archive-complex-p (x)
  "Whether the session says that the name X is complex, and does not say that it is real."
  (and (archive-symbol-p x) (kindp x '$complex) (not (kindp x '$real))))

(defun archive-check-names-real (name value)
  (archive-map-parts
   (lambda (part)
     (when (archive-complex-p part)
       (core-error "~a: ~a is declared complex or imaginary; real names are wanted" name
                   (archive-argument-shown part))))
   value))

(defun archive-check-real (name value)
  (when (and (not (member name *archive-complex-arguments* :test #'string=))
             (archive-occurs-p '$%i value))
    (core-error "~a: ~a: ~a" name *archive-wanted-real* (archive-argument-shown value))))

(defun archive-check-arguments (given kind &optional moving)
  "An error for the first of the arguments and options GIVEN, a table, that a call of KIND cannot
take; MOVING are the names that move in the archive of the call."
  (let ((pairs (archive-given-pairs given)))
    (loop for (name . value) in pairs do (archive-check-argument name value kind))
    (setq moving (append moving (archive-moving-arguments given)))
    (loop for (name . value) in pairs
          do (archive-check-spellings value
                                      ;; u(R) is a voltage, though u be a state too
                                      (if (eq (archive-argument-type name kind) :quantity)
                                          '()
                                          moving)
                                      (lambda (text) (core-error "~a: ~a" name text)))
             (when (string= name "where")
               (archive-check-special-case value moving
                                           (lambda (text) (core-error "~a: ~a" name text))))
             (archive-check-names-real name value)
             (archive-check-real name value)))
  (archive-check-derivatives given kind)
  (archive-check-occurrence given)
  (archive-check-velocities given)
  (archive-check-potential given)
  (archive-check-integrals given)
  (archive-check-options-used given))

;;; What the session makes depend on the time

(defun archive-listed-names (arguments)
  "Names that stand in lists, by themselves or on the left of an equation: what moves is one."
  (loop for argument in arguments
        for value = (archive-right-side argument)
        when (archive-list-p value)
          append (loop for item in (cdr value)
                       collect (if (archive-equation-p item) (cadr item) item))))

(defun archive-check-depends (arguments)
  "An error for a name of expressions among ARGUMENTS that depends(name, t) makes move: derivatives
are taken without that, and its terms would be missing. Coordinates may have it; for an archive it
does not count."
  (unless (stringp (car arguments)) (archive-check-typed-depends arguments)))

(defun archive-check-typed-depends (arguments)
  (let ((moving (append (archive-listed-names arguments)
                        (loop for argument in arguments
                              append (archive-differentiated-names argument)))))
    (dolist (argument arguments)
      (archive-map-parts
       (lambda (part)
         (when (and (archive-symbol-p part) (member '$t (mget part 'depends))
                    (not (member part moving)))
           (core-error "~a depends on t by depends(~a, t), which is not used here; write ~a(t) for ~
                        a function of the time" (archive-argument-shown part)
                       (archive-argument-shown part) (archive-argument-shown part))))
       argument))))
