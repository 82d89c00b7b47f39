;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A program built anew with other elements for its inputs: numbers for parameters, so that what
;;; vanishes for these numbers vanishes from the program, or elements. Every node comes again out of
;;; the constructors of program_nodes.lisp. A constant that would be longer than 200 binary digits
;;; stays an operation on its parts. See algebra-exchanged first; then which values make something
;;; vanish, algebra-vanishing-values.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"))

(defparameter *algebra-exchanged-constant* 200 "Binary digits of a constant that is worked out.")

(defun algebra-exchanged (elements exchange &optional (fault #'algebra-fault-division))
  "ELEMENTS in the current program; EXCHANGE gives the element for the name of an input, FAULT is
called on a denominator of ELEMENTS that became 0."
  (let ((new (make-hash-table)) (*algebra-longest-constant* *algebra-exchanged-constant*))
    (flet ((now (element)
             (if (algebra-node-p element) (gethash (algebra-node-index element) new) element)))
      (dolist (node (algebra-live-nodes elements))
        (let ((left (algebra-node-left node)) (right (algebra-node-right node)))
          (setf (gethash (algebra-node-index node) new)
                (cond ((algebra-input-p node) (funcall exchange left))
                      ((and (eq (algebra-node-operation node) :divide) (eql (now right) 0))
                       (funcall fault right))
                      (t (algebra-rebuilt (algebra-node-operation node)
                                          (now left) (now right)))))))
      (mapcar #'now elements))))

(defun algebra-fault-division (denominator)
  (declare (ignore denominator))
  (core-error "a program divides by zero"))

(defun algebra-rebuilt (operation x y)
  "The node of OPERATION on X and Y, or what it is for these. (A product of two numbers would be
taken for a multiple of the second.)"
  (let ((found (and (numberp x) (numberp y) (algebra-constant-value operation x y))))
    (cond ((null found) (algebra-operation operation x y))
          ((algebra-short-p found) found)
          ((eq operation :multiply) (algebra-make-node :divide x (/ y)))
          (t (algebra-make-node operation x y)))))

(defun algebra-constant-value (operation x y)
  "The rational value of OPERATION on numbers, or nil."
  (case operation
    (:add (+ x y))
    (:subtract (- x y))
    (:negate (- x))
    (:multiply (* x y))
    (:divide (/ x y))
    (:absolute (abs x))
    (:sign (signum x))
    (:root (algebra-rational-root x))))

(defun algebra-rational-root (x)
  (let ((root (and (>= x 0) (/ (isqrt (numerator x)) (isqrt (denominator x))))))
    (and root (= (* root root) x) root)))

(defun algebra-operation (operation x y)
  (case operation
    (:add (algebra-program-add x y))
    (:subtract (algebra-program-subtract x y))
    (:negate (algebra-program-negate x))
    (:multiply (algebra-program-multiply x y))
    (:divide (algebra-program-divide x y))
    (:sine (algebra-program-sine x))
    (:cosine (algebra-program-cosine x))
    (:root (algebra-program-root x))
    (:power (algebra-program-general-power x y))
    (:polar-angle (algebra-program-polar-angle x y))
    (t (algebra-program-function operation x))))

(defun algebra-exchange-by (pairs)
  "The function for algebra-exchanged that gives the elements of PAIRS, (name . element), and other
inputs as they are."
  (lambda (name)
    (let ((pair (assoc name pairs :test #'algebra-same-name-p)))
      (if pair (cdr pair) (algebra-program-input name)))))

(defun algebra-same-name-p (a b)
  (or (eq a b) (and (consp a) (consp b) (alike1 a b))))

;;; What an element depends on.

(defun algebra-inputs-of (elements)
  "Names of the inputs that ELEMENTS depend on."
  (mapcar #'algebra-node-left (remove-if-not #'algebra-input-p (algebra-live-nodes elements))))

(defun algebra-open-inputs-of (elements)
  "Those that are no numbers by themselves, as %pi is."
  (remove-if (lambda (name) (member name '($%pi $%e))) (algebra-inputs-of elements)))

;;; Which values are at fault where something vanishes: each without which it would not, or, where
;;; there is none, a smallest list of those without which together it would not.

(defun algebra-vanishing-values (element pairs vanishes)
  "Those of PAIRS, (name . element), at fault where ELEMENT vanishes; VANISHES is a function of the
new element."
  (let ((present (algebra-inputs-of (list element))))
    (flet ((present-p (pair) (member (car pair) present :test #'algebra-same-name-p))
           (vanishes-without (open)
             (funcall vanishes
                      (first (algebra-exchanged
                              (list element)
                              (algebra-exchange-by (set-difference pairs open)))))))
      (let ((guilty (remove-if-not #'present-p pairs)))
        (or (remove-if (lambda (pair) (vanishes-without (list pair))) guilty)
            (dolist (pair guilty guilty)
              (unless (vanishes-without (remove pair guilty))
                (setq guilty (remove pair guilty)))))))))
