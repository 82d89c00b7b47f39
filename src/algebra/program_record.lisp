;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A program as a record of Maxima, which can be shown and saved:
;;;     [inputs = [..], assignments = [z1 = .., z2 = .., ..], outputs = [M = .., f = ..],
;;;      operations = n],
;;; each assignment one operation on inputs, constants and earlier names; and back again.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common" "algebra/program_evaluation" "algebra/program_from_expressions"
                "algebra/program_nodes"))

;;; Outputs are a list of (name . value), value an element, a list (:list ..) or (:matrix row ..).

(defun algebra-output-elements (value)
  (cond ((or (numberp value) (algebra-node-p value)) (list value))
        ((eq (car value) :list) (cdr value))
        (t (apply #'append (cdr value)))))

(defun algebra-all-outputs (outputs)
  (loop for (nil . value) in outputs append (algebra-output-elements value)))

(defun algebra-constant-input-p (node)
  (member (algebra-node-left node) '($%pi $%e)))

(defun algebra-program-record (inputs outputs)
  "The record of OUTPUTS; INPUTS are expressions that come first, whether they are used or not."
  (let* ((nodes (algebra-live-nodes (algebra-all-outputs outputs)))
         (used (remove-if #'algebra-constant-input-p (remove-if-not #'algebra-input-p nodes)))
         (computed (remove-if #'algebra-input-p nodes))
         (parameters (sort (remove-if (lambda (e) (member e inputs :test #'alike1))
                                      (mapcar #'algebra-node-left used))
                           #'algebra-name-before-p))
         (all (append inputs parameters))
         (names (algebra-node-names nodes computed (algebra-free-stem all))))
    (flet ((written (element) (algebra-written-element element names)))
      (algebra-list
       (algebra-field '$inputs (cons '(mlist simp) all))
       (algebra-field '$assignments
                      (cons '(mlist simp)
                            (loop for node in computed
                                  collect (algebra-field (written node)
                                                         (algebra-written-node node #'written)))))
       (algebra-field '$outputs
                      (cons '(mlist simp)
                            (loop for (name . value) in outputs
                                  collect (algebra-field
                                           name (algebra-written-output value #'written)))))
       (algebra-field '$operations (length computed))))))

(defun algebra-name-before-p (a b) (and (great b a) t))

(defun algebra-list (&rest elements) (cons '(mlist simp) elements))
(defun algebra-field (name value) (list '(mequal simp) name value))

(defun algebra-free-stem (inputs)
  "z, zz, .. so that no input is spelled like a name of an assignment."
  (let ((spellings (mapcar #'core-spelling (remove-if-not #'symbolp inputs))))
    (loop for stem = "z" then (concatenate 'string stem "z")
          while (some (lambda (spelling)
                        (and (> (length spelling) (length stem))
                             (string= stem (subseq spelling 0 (length stem)))
                             (every #'digit-char-p (subseq spelling (length stem)))))
                      spellings)
          finally (return stem))))

(defun algebra-node-names (nodes computed stem)
  "Index of a node -> symbol or input."
  (let ((names (make-hash-table)) (stem (symbol-name (core-symbol stem))))
    (dolist (node nodes)
      (when (algebra-input-p node)
        (setf (gethash (algebra-node-index node) names) (algebra-node-left node))))
    (loop for node in computed
          for k from 1
          do (setf (gethash (algebra-node-index node) names) (algebra-numbered-symbol stem k)))
    names))

(defun algebra-numbered-symbol (stem k)
  (let ((digits '()))
    (loop do (push (code-char (+ 48 (mod k 10))) digits)
             (setq k (floor k 10))
          until (= k 0))
    (intern (concatenate 'string stem digits) :maxima)))

(defun algebra-written-element (element names)
  (if (algebra-node-p element)
      (gethash (algebra-node-index element) names)
      (algebra-maxima-rational element)))

(defun algebra-written-node (node written)
  (let ((x (funcall written (algebra-node-left node)))
        (y (funcall written (algebra-node-right node))))
    (case (algebra-node-operation node)
      (:add (algebra-written-pair 'mplus x y))
      (:subtract (algebra-written-pair 'mplus x (mul -1 y)))
      (:negate (mul -1 x))
      (:multiply (algebra-written-pair 'mtimes x y))
      (:divide (algebra-written-pair 'mtimes x (power y -1)))
      (:sine (list '(%sin simp) x))
      (:cosine (list '(%cos simp) x))
      (:root (power x '((rat simp) 1 2)))
      (:exponential (power '$%e x))
      (:power (power x y))
      (:polar-angle (mfuncall '$atan2 x y))
      (t (simplifya (list (list (algebra-function-operator
                                 (algebra-function-of (algebra-node-operation node)))) x) nil)))))

(defun algebra-written-pair (operator x y)
  "X and Y under OPERATOR. Two different names or their opposites need Maxima's order only."
  (cond ((or ($constantp x) ($constantp y) (eq (algebra-written-base x) (algebra-written-base y)))
         (simplifya (list (list operator) x y) nil))
        ((great x y) (list (list operator 'simp) y x))
        (t (list (list operator 'simp) x y))))

(defun algebra-written-base (x)
  "The name in X, which is a name, -1*name or 1/name."
  (cond ((atom x) x)
        ((eq (caar x) 'mexpt) (second x))
        ((eq (caar x) 'mtimes) (third x))
        (t x)))

(defun algebra-written-output (value written)
  (cond ((or (numberp value) (algebra-node-p value)) (funcall written value))
        ((eq (car value) :list) (cons '(mlist simp) (mapcar written (cdr value))))
        (t (cons '($matrix simp)
                 (loop for row in (cdr value) collect (cons '(mlist simp) (mapcar written row)))))))

;;; Back.

(defun algebra-record-part (record key)
  (or (and ($listp record)
           (third (find-if (lambda (e)
                             (and (consp e) (eq (caar e) 'mequal) (eq (second e) key)))
                           (cdr record))))
      (core-error "a program is a record with inputs, assignments, outputs and operations; ~a is ~
                   missing"
                  (core-spelling key))))

(defun algebra-read-program (record)
  "(inputs outputs) of RECORD, built in the current program; inputs are expressions."
  (let ((known (make-hash-table :test #'eq)))
    (dolist (assignment (cdr (algebra-record-part record '$assignments)))
      (setf (gethash (second assignment) known) (algebra-read-element (third assignment) known)))
    (list (cdr (algebra-record-part record '$inputs))
          (loop for output in (cdr (algebra-record-part record '$outputs))
                collect (cons (second output) (algebra-read-output (third output) known))))))

(defun algebra-read-element (e known)
  (cond ((symbolp e) (or (gethash e known) (algebra-program-element e)))
        ((or (atom e) (algebra-subscripted-p e) (member (caar e) '(rat %derivative)))
         (algebra-program-element e))
        (t (algebra-converted-operation e (lambda (part) (algebra-read-element part known))))))

(defun algebra-read-output (e known)
  (flet ((row (list) (mapcar (lambda (part) (algebra-read-element part known)) (cdr list))))
    (cond (($matrixp e) (cons :matrix (mapcar #'row (cdr e))))
          (($listp e) (cons :list (row e)))
          (t (algebra-read-element e known)))))

;;; For Maxima.

(defun $algebra_program (inputs outputs)
  "The program of OUTPUTS, a list of name = expression, list or matrix."
  (with-algebra-program
    (algebra-program-record
     (cdr inputs)
     (loop for output in (cdr outputs)
           collect (cons (second output) (algebra-read-output (third output) (make-hash-table)))))))

(defun algebra-point (equations)
  (loop for equation in (cdr equations)
        collect (cons (second equation)
                      (let ((value (third equation)))
                        (cond ((floatp value) (rational value))
                              ((algebra-rational-number value))
                              (t (core-error "a value is a number, found ~a"
                                             (mfuncall '$string value))))))))

(defun algebra-evaluated-program (record point exactly)
  (with-algebra-program
    (destructuring-bind (inputs outputs) (algebra-read-program record)
      (declare (ignore inputs))
      (let ((values (algebra-program-values (algebra-all-outputs outputs) (algebra-point point)
                                            exactly)))
        (flet ((next (element) (declare (ignore element))
                 (let ((x (pop values))) (if (rationalp x) (algebra-maxima-rational x) x))))
          (cons '(mlist simp)
                (loop for (name . value) in outputs
                      collect (algebra-field name (algebra-written-output value #'next)))))))))

(defun $algebra_program_value (record point)
  "[M = .., ..] exactly at POINT, [x = 1/2, sin(x) = 3/5, cos(x) = 4/5, ..]."
  (algebra-evaluated-program record point t))

(defun $algebra_program_float (record point)
  "[M = .., ..] in double-float numbers at POINT, [x = 1/2, ..]."
  (algebra-evaluated-program record point nil))
