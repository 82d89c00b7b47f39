;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The types of the table of keys: one function for each turns a parsed value, an expression, into
;;; what the rooms receive, or refuses it; archive-typed is the entrance. What values mean together
;;; (lengths, parents, loops) is left to the rooms.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/nearest" "archive/interpolated_laws" "archive/register" "archive/simplify"
                "archive/speller"))

(defparameter *archive-version* 1)

(defparameter *archive-types*
  `((:version archive-as-version "1")
    (:kind archive-as-kind ,(core-choice (core-kind-names)))
    (:text archive-as-text "a text in double quotes")
    (:count archive-as-count "a positive integer")
    (:names archive-as-names "a list of names, such as [phi, theta]")
    (:facts archive-as-facts "a list of names and of what is assumed of them, such as [m > 0, h]")
    (:numbers archive-as-numbers "a list of numbers by name, such as [m = 1, l = 2/5]")
    (:assignments archive-as-assignments "a list of expressions by name, such as [s2 = 2*s1]")
    (:laws archive-as-laws "a list of functions, such as [f1(u) = g1*u^3]")
    (:motion archive-as-motion "a list such as [theta = 0, theta' = 1]")
    (:span archive-as-span "two numbers, such as [0, 10]")
    (:expression archive-as-expression "an expression")
    (:combination archive-as-expression "an expression in the names of integrals")
    (:expressions archive-as-expressions "a list of expressions")
    (:vector archive-as-vector "a list of three expressions")
    (:vanishing archive-as-vanishing "a list of equations, such as [x^2 + y^2 - l^2 = 0]")
    (:rates archive-as-rates "a list such as [p' = q, q' = -p], or with algebraic 0 = p + q")
    (:field archive-as-field "none, constant or newton")
    (:sign archive-as-sign "passive or generator")
    (:tree archive-as-tree "a list of labels, such as [C1, C2], or cyclic")
    (:parent archive-as-parent "0, the number of a body, or the name of a frame")
    (:axes archive-as-axes "a list of 1, 2 and 3, such as [3, 1]")
    (:velocity archive-as-velocity "a list of three expressions, or auto")
    (:inertia archive-as-inertia "a 3 x 3 matrix, such as diag(A, B, C), or 0")
    (:spin archive-as-spin "a body axis and an angle, such as [3, chi]")
    (:rotor archive-as-rotor "free, momentum(h), speed(w) or control(Q)")
    (:pair archive-as-pair "two bodies, such as [1, 2]; 0 is the fixed axes")
    (:points archive-as-points "two points, such as [[0, 0, 0], [0, 0, l]]")
    (:node archive-as-node "an integer or a name")
    (:nodes archive-as-nodes "a list of nodes and what they were called, such as [n_in = \"in\"]")
    (:states archive-as-assignments "a list of states by label, such as [i1 = L1, u3 = C3]")
    (:graph archive-as-graph "a list of branches, such as {{{1, 2}, L1}, {{2, 3}, C1, u1}}")
    (:skew archive-as-skew "a square matrix that is skew, such as [[0, 1], [-1, 0]]")
    (:algebra archive-as-algebra "so(4), e(3) or so(3,1)"))
  "Type, the function below that checks a value of it, and what such a value is.")

(defun archive-type-phrase (type)
  (third (assoc type *archive-types*)))

(defun archive-unfit (&optional (control "") &rest arguments)
  "Leave archive-typed: the value is not of its type; CONTROL may say which part of it."
  (throw 'archive-unfit (apply #'format nil control arguments)))

(defun archive-typed (type value)
  "VALUE as TYPE wants it and nil, or nil and a text, possibly empty, on the part at fault."
  (let* ((converted nil)
         (trouble (catch 'archive-unfit
                    (setf converted (funcall (archive-type-function type) value))
                    nil)))
    (if trouble (values nil trouble) (values converted nil))))

(defun archive-type-function (type)
  (second (assoc type *archive-types*)))

(defun archive-value-shown (value)
  "VALUE as the archive's writer spells it, a form that it does not know as Maxima does; cut after
sixty letters."
  (core-cut (if (stringp value) (format nil "~s" value)
                (or (first (core-attempt (lambda () (archive-spell value))))
                    (core-words (list value))))))

;; What expressions are

(defun archive-head-p (value &rest heads)
  (and (consp value) (consp (car value)) (member (caar value) heads) t))

(defun archive-list-p (value) (archive-head-p value 'mlist))

(defun archive-equation-p (value) (archive-head-p value 'mequal))

(defun archive-relation-p (value)
  (archive-head-p value 'mgreaterp 'mlessp 'mgeqp 'mleqp '$notequal '$equal))

(defun archive-symbol-p (value)
  "A plain name: no constant such as %pi, inf, true."
  (and (symbolp value)
       (not (member value '(nil t $inf $minf)))
       (let ((name (symbol-name (or (get value 'reversealias) value))))  ; %gamma inside is gamma
         (and (> (length name) 1) (char= (char name 0) #\$) (char/= (char name 1) #\%)))))

(defun archive-velocity-p (value)
  "'diff(name, t)."
  (and (archive-head-p value '%derivative)
       (archive-symbol-p (second value))
       (equal (cddr value) '($t 1))))

(defun archive-expression-p (value)
  (not (or (stringp value) (member value '(nil t)) (archive-list-p value)
           (archive-equation-p value)
           (archive-relation-p value) (archive-head-p value '$matrix '$diag 'mand 'mor 'mnot))))

(defun archive-names-in (value)
  "The names that stand in VALUE, heads of functions aside."
  (cond ((archive-symbol-p value) (list value))
        ((atom value) '())
        (t (reduce #'union (mapcar #'archive-names-in (cdr value)) :initial-value '()))))

(defun archive-items (value)
  (if (archive-list-p value) (cdr value) (archive-unfit)))

(defun archive-list (items) (cons '(mlist simp) items))
(defun archive-equation (left right) (list '(mequal simp) left right))

(defun archive-each (function value)
  "The list of what FUNCTION makes of each item of the list VALUE."
  (archive-list (mapcar function (archive-items value))))

(defun archive-check-distinct (items)
  "ITEMS, refused when one stands twice."
  (let ((twice (find-if (lambda (item) (> (count item items :test #'equal) 1)) items)))
    (if twice (archive-unfit "~a stands twice" (archive-value-shown twice)) items)))

(defun archive-a-name (value)
  (cond ((eq value '$t) (archive-unfit "t is time"))
        ((archive-symbol-p value) value)
        (t (archive-unfit "~a is not a name" (archive-value-shown value)))))

(defun archive-an-expression (value)
  (if (archive-expression-p value) value
      (archive-unfit "~a is not an expression" (archive-value-shown value))))

(defun archive-a-number (value)
  (cond ((archive-names-in value)
         (archive-unfit "~a is not a number" (archive-value-shown value)))
        (t (archive-an-expression value))))

;; Single values

(defun archive-as-version (value) (if (eql value *archive-version*) value (archive-unfit)))

(defun archive-as-text (value) (if (stringp value) value (archive-unfit)))

(defun archive-as-count (value) (if (and (integerp value) (plusp value)) value (archive-unfit)))
(defun archive-as-expression (value) (if (archive-expression-p value) value (archive-unfit)))

(defun archive-as-node (value)
  (if (or (integerp value) (archive-symbol-p value)) value (archive-unfit)))

(defun archive-as-parent (value)
  "A name in quotes, or a whole head of a section, is refused with what to write."
  (cond ((or (and (integerp value) (>= value 0)) (archive-symbol-p value)) value)
        ((stringp value)
         (archive-unfit "write it without quotes: parent = ~a"
                        (subseq value (1+ (or (position #\Space value :from-end t) -1)))))
        (t (archive-unfit))))

(defun archive-one-of (value words)
  "VALUE, a symbol spelled as one of WORDS; the nearest word is named otherwise."
  (let ((word (if (and (symbolp value) value) (core-spelling value) "")))
    (if (member word words :test #'string=)
        value
        (let ((near (core-nearest word words)))
          (if near (archive-unfit "did you mean ~a?" near) (archive-unfit))))))

(defun archive-as-kind (value) (archive-one-of value (core-kind-names)))

(defun archive-as-field (value) (archive-one-of value '("none" "constant" "newton")))

(defun archive-as-sign (value) (archive-one-of value '("passive" "generator")))

(defun archive-as-rotor (value)
  (cond ((eq value '$free) value)
        ((and (archive-head-p value '$momentum '$speed '$control) (= (length value) 2))
         (list (list (caar value) 'simp) (archive-an-expression (second value))))
        (t (archive-unfit))))

(defun archive-as-algebra (value)
  (if (and (archive-head-p value '$so '$e)
           (member (cons (caar value) (cdr value)) '(($so 4) ($e 3) ($so 3 1)) :test #'equal))
      value
      (archive-unfit)))

;; Lists

(defun archive-as-names (value)
  (archive-list (archive-check-distinct (mapcar #'archive-a-name (archive-items value)))))

(defun archive-as-expressions (value) (archive-each #'archive-an-expression value))

(defun archive-as-vector (value)
  (if (= (length (archive-items value)) 3)
      (archive-as-expressions value)
      (archive-unfit "it has ~d" (length (archive-items value)))))

(defun archive-as-velocity (value)
  (if (eq value '$auto) value (archive-as-vector value)))

(defun archive-both (function value)
  "The list of what FUNCTION makes of both items of VALUE."
  (if (= (length (archive-items value)) 2) (archive-each function value) (archive-unfit)))

(defun archive-as-points (value) (archive-both #'archive-as-vector value))

(defun archive-as-pair (value) (archive-both #'archive-as-parent value))

(defun archive-an-axis (value)
  (if (member value '(1 2 3)) value (archive-unfit "~a is no axis" (archive-value-shown value))))

(defun archive-as-axes (value) (archive-each #'archive-an-axis value))

(defun archive-as-spin (value)
  (let ((items (archive-items value)))
    (if (= (length items) 2)
        (archive-list (list (archive-an-axis (first items)) (archive-a-name (second items))))
        (archive-unfit))))

(defun archive-as-span (value) (archive-both #'archive-a-number value))

;; Matrices

(defun archive-rows (value)
  "The rows of a matrix, lists of expressions."
  (mapcar #'archive-items (if (archive-head-p value '$matrix) (cdr value) (archive-items value))))

(defun archive-matrix (rows) (cons '($matrix simp) (mapcar #'archive-list rows)))

(defun archive-diagonal (entries)
  (loop for entry in entries
        for i from 0
        collect (loop for j below (length entries) collect (if (= i j) entry 0))))

(defun archive-as-inertia (value)
  (let ((rows (cond ((eql value 0) (archive-diagonal '(0 0 0)))
                    ((archive-head-p value '$diag) (archive-diagonal (cdr value)))
                    (t (archive-rows value)))))
    (unless (and (= (length rows) 3) (every (lambda (row) (= (length row) 3)) rows))
      (archive-unfit))
    (archive-matrix (mapcar (lambda (row) (mapcar #'archive-an-expression row)) rows))))

(defun archive-as-skew (value)
  (let* ((rows (archive-rows value)) (n (length rows)))
    (unless (and (plusp n) (every (lambda (row) (= (length row) n)) rows))
      (archive-unfit))
    (loop for i below n
          do (loop for j from 0 to i
                   do (when (archive-clearly-unequal-p (nth j (nth i rows)) (nth i (nth j rows)))
                        (archive-unfit "rows ~d and ~d disagree" (1+ j) (1+ i)))))
    (archive-matrix rows)))

(defun archive-clearly-unequal-p (x y)
  "Whether X is not -Y, where both are small; what reading would have to multiply out is left to
those who compute with it."
  (let ((sum (add x y)))
    (not (or (eql sum 0)
             (not (archive-modest-p sum))
             (eql 0 (sratsimp sum))))))

;; Lists of equations

(defun archive-checked-equations (value check-left check-right)
  "Equations of the list VALUE, both sides checked, no left side twice but 0."
  (let ((equations (mapcar (lambda (item)
                             (unless (archive-equation-p item)
                               (archive-unfit "~a is not an equation" (archive-value-shown item)))
                             (archive-equation (funcall check-left (second item))
                                               (funcall check-right (third item))))
                           (archive-items value))))
    (archive-check-distinct (remove 0 (mapcar #'second equations)))
    (archive-list equations)))

(defun archive-as-assignments (value)
  (archive-checked-equations value #'archive-a-name #'archive-an-expression))

(defun archive-as-numbers (value)
  (archive-checked-equations value #'archive-a-name #'archive-a-number))

(defun archive-as-nodes (value)
  (archive-checked-equations value #'archive-a-name #'archive-as-text))

(defun archive-as-tree (value) (if (eq value '$cyclic) value (archive-as-names value)))

(defun archive-a-law (value)
  "f(u, ..), its arguments names; a prescribed function has the argument t."
  (unless (and (consp value) (consp (car value)) (cdr value) (archive-symbol-p (caar value)))
    (archive-unfit "~a is not f(u)" (archive-value-shown value)))
  (archive-check-distinct (mapcar #'archive-a-name (remove '$t (cdr value))))
  value)

(defun archive-as-laws (value)
  (archive-laws-as-formulas (archive-checked-equations
                             value #'archive-a-law (archive-points-or #'archive-an-expression))))

(defun archive-a-state (value)
  (if (archive-velocity-p value) value (archive-a-name value)))

(defun archive-as-motion (value)
  (archive-checked-equations value #'archive-a-state #'archive-an-expression))

(defun archive-a-velocity (value)
  (if (archive-velocity-p value) value
      (archive-unfit "~a is not a velocity" (archive-value-shown value))))

(defun archive-as-rates (value)
  (archive-checked-equations value (lambda (left) (if (eql left 0) 0 (archive-a-velocity left)))
                             #'archive-an-expression))

(defun archive-as-vanishing (value)
  "Equations e = 0; f = g is f - g = 0."
  (archive-each (lambda (item)
                  (unless (archive-equation-p item)
                    (archive-unfit "~a is not an equation" (archive-value-shown item)))
                  (archive-equation (if (eql (third item) 0) (second item)
                                        (sub (second item) (third item))) 0))
                value))

(defun archive-a-fact (value)
  (cond ((archive-relation-p value) value)
        ((archive-equation-p value)
         (archive-unfit "~a is no inequality; numbers stand in `values'"
                        (archive-value-shown value)))
        (t (archive-a-name value))))

(defun archive-as-facts (value) (archive-each #'archive-a-fact value))

;; The list of a graph
(defparameter *archive-graph-types*
  '((#\L . "L") (#\C . "C") (#\R . "R") (#\E . "E") (#\I . "I")
    (#\f . "RU") (#\g . "RU") (#\h . "RI"))
  "Type of a branch by the first letter of its value.")

(defun archive-graph-row (branch)
  "The row [n1, n2, type, value(, state)] of {{n1, n2}, value(, state)}."
  (let* ((items (archive-items branch))
         (nodes (if (<= 2 (length items) 3) (archive-items (first items)) '()))
         (value (second items))
         (type (and (archive-symbol-p value)
                    (cdr (assoc (char (core-spelling value) 0) *archive-graph-types*)))))
    (unless (= (length nodes) 2)
      (archive-unfit "~a is not {{node, node}, value}" (archive-value-shown branch)))
    (unless type
      (archive-unfit "~a does not begin with L, C, R, E, I, f, g or h"
                     (archive-value-shown value)))
    (archive-list (append (mapcar #'archive-as-node nodes) (list (core-symbol type) value)
                          (mapcar #'archive-a-name (cddr items))))))

(defun archive-as-graph (value) (archive-each #'archive-graph-row value))
