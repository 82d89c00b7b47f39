;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Names of a description: which are declared, which are free, and what is assumed of the
;;; parameters. A name that nothing declares is a free symbol; one warning lists them all, since a
;;; misprint looks just so. A key's type says what its value declares (left sides, lists of names)
;;; and what it uses.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/keys" "archive/types" "archive/circuit_names"))

(defun archive-lefts (equations) (mapcar #'second (cdr equations)))

(defun archive-rights (equations) (mapcar #'third (cdr equations)))

(defun archive-fact-names (facts)
  (archive-each-once (loop for fact in (cdr facts) append (archive-names-in fact))))

(defun archive-each-once (names &optional others)
  "NAMES, thousands perhaps, each once; those among OTHERS left out."
  (if (or others (nthcdr 30 names))
      (let ((met (make-hash-table :test #'eq)))
        (dolist (name others) (setf (gethash name met) t))
        (loop for name in names
              unless (gethash name met)
                collect (progn (setf (gethash name met) t) name)))
      (remove-duplicates names :from-end t)))

(defun archive-law-names (laws)
  "Names that the right sides of laws use, their arguments aside."
  (loop for law in (cdr laws)
        append (set-difference (archive-used-names (third law)) (cdr (second law)))))

(defun archive-used-names (value)
  "The names that VALUE uses: not the variable of an integral, which is bound in its integrand."
  (cond ((archive-symbol-p value) (list value))
        ((atom value) '())
        ((archive-head-p value '%integrate '$integrate)
         (union (remove (third value) (archive-used-names (second value)))
                (reduce #'union (mapcar #'archive-used-names (cdddr value)) :initial-value '())))
        (t (archive-each-once (loop for part in (cdr value) append (archive-used-names part))))))

(defun archive-used-by (type value)
  "The names that a key's VALUE uses."
  (case type
    ((:expression :expressions :vector :vanishing :rates :skew :inertia :points)
     (archive-used-names value))
    (:velocity (if (eq value '$auto) '() (archive-used-names value)))
    (:assignments (archive-used-names (archive-list (archive-rights value))))
    (:motion (archive-used-names (archive-list (archive-rights value))))
    (:laws (archive-law-names value))
    (:rotor (if (atom value) '() (archive-used-names value)))
    (t '())))

(defun archive-declared-by (type value)
  "The names that a key's VALUE declares."
  (case type
    (:names (cdr value))
    (:facts (archive-fact-names value))
    (:assignments (archive-lefts value))
    (:states (archive-lefts value))
    (:laws (mapcar #'caar (archive-lefts value)))
    (:spin (cddr value))
    (:algebra (mapcar #'core-symbol '("M1" "M2" "M3" "g1" "g2" "g3")))
    (t '())))

(defun archive-momentum-names (description)
  "Names p_q that momenta have unless the user names them."
  (append (mapcar (lambda (q) (core-symbol (format nil "p_~a" (core-spelling q))))
                  (remove-if-not #'archive-symbol-p
                                 (cdr ($core_get description '$coordinates nil))))
          (archive-used-names (archive-list (archive-rights ($core_get description '$momenta
                                                                       nil))))))

(defun archive-rotor-angles (description)
  "The angles of bodies with a rotor: names that are no coordinates."
  (loop for equation in (cdr description)
        when (and (stringp (second equation)) ($core_get (third equation) '$rotor nil))
          append (archive-used-names ($core_get (third equation) '$angles '((mlist))))))

;; All names

(defun archive-branch-names (description states-of-row)
  "Two values: names that the branches declare, and names that their values use; `states' give
labels of branches, or values where there are none. STATES-OF-ROW tells the names of its state."
  (let ((rows (cdr ($core_get description '$branches '((mlist)))))
        (stated (archive-rights ($core_get description '$states '((mlist))))))
    (values (append (loop for row in rows append (funcall states-of-row row))
                    (and rows (copy-list stated))
                    (loop for row in rows when (archive-equation-p row) collect (second row)))
            (archive-used-names
             (archive-list (append (mapcan #'archive-branch-value rows)
                                   (and (null rows) (copy-list stated))
                                   (archive-last-fields ($core_get description '$couplings nil))
                                   (archive-last-fields
                                    ($core_get description '$transformers nil))))))))

(defun archive-typed-values (kind description)
  "((type . value) ..) of every key of DESCRIPTION."
  (flet ((section (word equations)
           (loop for (nil name value) in equations
                 for key = (and (symbolp name) (archive-find-key kind word (core-spelling name)))
                 when key collect (cons (archive-key-type key) value))))
    (append (section "system" (cdr description))
            (loop for (nil name value) in (cdr description)
                  when (stringp name) append (section (archive-section-word name) (cdr value))))))

(defun archive-declared-and-used (kind description states-of-row)
  "Two values: the names that DESCRIPTION declares, and those that it uses."
  (multiple-value-bind (branch-declares branch-uses)
      (archive-branch-names description states-of-row)
    (let ((typed (archive-typed-values kind description)))
      (flet ((names-by (function)
               (loop for (type . value) in typed append (funcall function type value))))
        (values (append '($t) branch-declares (archive-momentum-names description)
                        (archive-rotor-angles description) (names-by #'archive-declared-by))
                (append branch-uses (names-by #'archive-used-by)))))))

(defun archive-known-names (kind description)
  "The names that stand in DESCRIPTION."
  (multiple-value-call #'append
    (archive-declared-and-used kind description #'archive-row-states)))

(defun archive-free-symbols (kind description)
  "The names that DESCRIPTION uses and does not declare, sorted. Names that states have by default
are looked at where something is left."
  (flet ((free (states-of-row)
           (multiple-value-bind (declared used)
               (archive-declared-and-used kind description states-of-row)
             (archive-each-once used declared))))
    (sort (mapcar #'core-spelling
                  (and (free #'archive-row-own-state) (free #'archive-row-states)))
          #'string<)))

(defun archive-warn-free-symbols (kind description)
  (let ((free (archive-free-symbols kind description)))
    (when free
      (core-warn-later "free symbols, not listed in parameters: ~{~a~^, ~}" free))))

(defun archive-facts (description)
  "A list of the relations of DESCRIPTION's parameters, as `assume' takes them."
  (remove-if-not #'archive-relation-p (cdr ($core_get description '$parameters '((mlist))))))

;; Names of what moves: they are no parameters and have no fixed value

(defun archive-moving-names (description)
  "((name . what it is) ..)"
  (flet ((called (what names) (mapcar (lambda (name) (cons name what)) names))
         (of-key (key) (archive-used-names ($core_get description key '((mlist))))))
    (append (called "a coordinate" (of-key '$coordinates))
            (called "a variable" (of-key '$variables))
            (called "the angle of a rotor" (archive-rotor-angles description))
            (called "the state of a branch"
                    (archive-lefts ($core_get description '$states '((mlist)))))
            (called "the state of a branch"
                    (loop for row in (cdr ($core_get description '$branches '((mlist))))
                          append (archive-row-own-state row))))))

(defun archive-check-laws (description moving)
  "A law depends on its arguments and parameters: derivatives of its function are taken while it is
open."
  (loop for law in (cdr ($core_get description '$laws '((mlist))))
        for names = (archive-law-names (archive-list (list law)))
        do (loop for (name . what) in (cons '($t . "the time") moving)
                 do (when (member name names)
                      (core-fault "system" '$laws "the law of ~a contains ~a, ~a; ~
                                  make it an argument of the function"
                                  (core-spelling (caar (second law))) (core-spelling name) what)))))

(defun archive-check-parameters (description)
  (let ((parameters (archive-fact-names ($core_get description '$parameters '((mlist)))))
        (fixed (archive-lefts ($core_get description '$values '((mlist)))))
        (moving (archive-moving-names description)))
    (archive-check-laws description moving)
    (loop for (name . what) in moving
          do (when (member name parameters)
               (core-fault "system" '$parameters "~a is both ~a and a parameter"
                           (core-spelling name) what))
             (when (member name fixed)
               (core-fault "system" '$values
                           "~a is ~a and has no fixed value; that at the start belongs into start"
                           (core-spelling name) what)))))

;;; What the names of a system must have: an equation for each variable, a place in L

(defun archive-derivative-names (value)
  "The names whose time derivatives are the left sides of the equations VALUE."
  (mapcar #'second (archive-lefts value)))

(defun archive-check-equations (description)
  "A variable without a rate belongs to an equation 0 = g."
  (let* ((variables (cdr ($core_get description '$variables)))
         (equations (cdr ($core_get description '$equations)))
         (rated (archive-derivative-names
                 (archive-list (remove 0 equations :key #'second)))))
    (flet ((fault (names text)
             (when names
               (core-fault "system" '$equations text
                           (mapcar #'core-spelling names)))))
      (fault (remove-if (lambda (x) (member x variables)) rated)
             "there are equations for ~{~a~^, ~}, not among the variables; add them there")
      (when (= (length rated) (length equations))
        (fault (remove-if (lambda (x) (member x rated)) variables)
               "there are no equations for ~{~a~^, ~}; a parameter is no variable"))
      (unless (= (length equations) (length variables))
        (core-fault "system" '$equations "there are ~d equations for ~d variables"
                    (length equations) (length variables))))))

(defun archive-check-coordinates (description)
  "A coordinate that occurs nowhere in what the equations are made of has the equation 0 = 0."
  (when ($core_get description '$lagrangian nil) (archive-check-occurring description)))

(defun archive-check-occurring (description)
  (let* ((used (loop for key in '($lagrangian $rayleigh $forces $constraints $nonholonomic)
                     append (archive-names-in ($core_get description key 0))))
         (coordinates (cdr ($core_get description '$coordinates)))
         (absent (remove-if (lambda (q) (member q used)) coordinates)))
    (cond ((null absent))
          ((= (length absent) (length coordinates))
           (core-fault "system" '$lagrangian
                       "lagrangian contains none of the coordinates ~{~a~^, ~}"
                       (mapcar #'core-spelling coordinates)))
          (t (core-warn "coordinates that occur nowhere else: ~{~a~^, ~}"
                        (mapcar #'core-spelling absent))))))

(defun archive-check-agreement (kind description)
  "An error where the keys of DESCRIPTION, of KIND, contradict each other."
  (archive-check-parameters description)
  (let ((agreement (core-kind-agreement (core-find-kind kind))))
    (when agreement (core-call agreement description))))

;;; Properties of Maxima's data base

(defparameter *archive-property-words*
  '($integer $noninteger $even $odd $rational $irrational $real $imaginary $complex $analytic
    $increasing $decreasing $oddfun $evenfun $posfun $constant $commutative $lassociative
    $rassociative $symmetric $antisymmetric $integervalued)
  "Names that Maxima takes for something that has the property of this name:
(-1)^(2*integer) is 1.")

(defun archive-refuse-property-words (names)
  (let ((word (find-if (lambda (name) (member name *archive-property-words*)) names)))
    (when word
      (core-error "the name ~a is a property in Maxima's data base, which takes the name for ~
                   something that has it; take another name"
                  (core-spelling word)))))
