;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A program as a record of Maxima, which can be shown and saved:
;;;     [inputs = [..], assignments = [z1 = .., z2 = .., ..], outputs = [M = .., f = ..],
;;;      operations = n],
;;; each assignment one operation on inputs, constants and earlier names; and back again.
;;; It begins with the value of a program at a point.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/program_from_expressions" "algebra/program_nodes"))

;;; The value of a program: exactly at a rational point, where the sine and cosine of an input are
;;; rational numbers of the point, sin(x) = 3/5, cos(x) = 4/5, and those of sums of whole multiples
;;; of inputs follow by the theorems of addition; and in double-float numbers.
;;; See algebra-program-values first.

(defun algebra-program-values (elements point exactly)
  "The values of ELEMENTS; POINT is a list of (expression . number)."
  (let ((values (make-hash-table)) (turns (make-hash-table)))
    (flet ((value (element)
             (cond ((not (algebra-node-p element))
                    (if exactly element (coerce element 'double-float)))
                   (t (gethash (algebra-node-index element) values)))))
      (dolist (node (algebra-live-nodes elements))
        (setf (gethash (algebra-node-index node) values)
              (algebra-node-value node #'value point exactly turns)))
      (mapcar #'value elements))))

(defun algebra-node-value (node value point exactly turns)
  (let* ((left (algebra-node-left node)) (right (algebra-node-right node)))
    (flet ((x () (funcall value left)) (y () (funcall value right)))
      (case (algebra-node-operation node)
        (:input (algebra-input-value left point exactly))
        (:add (+ (x) (y)))
        (:subtract (- (x) (y)))
        (:negate (- (x)))
        (:multiply (* (x) (y)))
        (:divide (algebra-value-quotient (x) (y)))
        (:sine (if exactly (cdr (algebra-turn left point turns)) (sin (x))))
        (:cosine (if exactly (car (algebra-turn left point turns)) (cos (x))))
        (:root (if exactly (algebra-exact-root (x)) (algebra-double-root (x))))
        (t (algebra-function-node-value node #'x #'y exactly))))))

(defun algebra-function-node-value (node x y exactly)
  (let ((operation (algebra-node-operation node)))
    (cond (exactly (core-error "the value of ~(~a~) is not rational" operation))
          ((member operation '(:power :polar-angle))
           (algebra-function-of-doubles operation (funcall x) (funcall y)))
          (t (algebra-function-of-doubles operation (funcall x))))))

(defun algebra-value-quotient (x y)
  (if (zerop y) (core-error "a program divides by zero at this point") (/ x y)))

(defun algebra-double-root (x)
  (if (minusp x) (core-error "a program takes the square root of ~a" x) (sqrt x)))

(defun algebra-exact-root (x)
  (let ((root (and (>= x 0) (/ (isqrt (numerator x)) (isqrt (denominator x))))))
    (if (and root (= (* root root) x))
        root
        (core-error "the square root of ~a is not rational" x))))

(defun algebra-at-point (expression point)
  (cdr (assoc expression point :test #'alike1)))

(defun algebra-input-value (name point exactly)
  (let ((number (algebra-at-point name point)))
    (cond (number (if exactly number (coerce number 'double-float)))
          ((and (eq name '$%pi) (not exactly)) (coerce pi 'double-float))
          ((and (eq name '$%e) (not exactly)) (exp 1d0))
          (t (core-error "the point has no value for ~a" (core-words (list name)))))))

;;; A turn is (cosine . sine) of an angle.

(defun algebra-turn (element point turns)
  (cond ((eql element 0) (cons 1 0))
        ((not (algebra-node-p element)) (core-error "the sine of ~a is not rational" element))
        ((gethash (algebra-node-index element) turns))
        (t (setf (gethash (algebra-node-index element) turns)
                 (algebra-new-turn element point turns)))))

(defun algebra-new-turn (node point turns)
  (let ((left (algebra-node-left node)) (right (algebra-node-right node)))
    (flet ((turn (angle) (algebra-turn angle point turns)))
      (case (algebra-node-operation node)
        (:input (algebra-input-turn left point))
        (:add (algebra-turned-by (turn left) (turn right)))
        (:subtract (algebra-turned-by (turn left) (algebra-turned-back (turn right))))
        (:negate (algebra-turned-back (turn left)))
        (:multiply (if (integerp left)
                       (algebra-turned-times left (turn right))
                       (core-error "the sine of a product is not rational")))
        (t (core-error "the sine of a quotient or a function is not rational"))))))

(defun algebra-input-turn (name point)
  (let ((cosine (algebra-at-point (list '(%cos simp) name) point))
        (sine (algebra-at-point (list '(%sin simp) name) point)))
    (unless (and cosine sine)
      (core-error "the point has no sine and cosine of ~a" (core-words (list name))))
    (cons cosine sine)))

(defun algebra-turned-back (turn) (cons (car turn) (- (cdr turn))))

(defun algebra-turned-by (a b)
  (cons (- (* (car a) (car b)) (* (cdr a) (cdr b)))
        (+ (* (cdr a) (car b)) (* (car a) (cdr b)))))

(defun algebra-turned-times (n turn)
  (if (minusp n)
      (algebra-turned-times (- n) (algebra-turned-back turn))
      (let ((turned (cons 1 0)))
        (dotimes (i n turned) (setq turned (algebra-turned-by turned turn))))))

;;; ---- program record

;;; Outputs are a list of (name . value), value an element, a list (:list ..) or (:matrix row ..).

(defun algebra-output-elements (value)
  (cond ((or (numberp value) (algebra-node-p value)) (list value))
        ((eq (car value) :list) (cdr value))
        (t (loop for row in (cdr value) append row))))

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
                                             (core-words (list value)))))))))

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
