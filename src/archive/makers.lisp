;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions whose arguments have a form of their own: diff, integrate, at, matrix, diag, notequal,
;;; piecewise. Each takes the arguments and their places and makes a noun or a matrix, or says what
;;; it expects.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/shapes"))

(defun archive-expect-count (reader name from arguments &rest counts)
  (unless (member (length arguments) counts)
    (archive-fault reader from "~a has ~d argument~:p, expected ~{~d~^ or ~}" name
                   (length arguments) counts)))

(defun archive-expect-name (reader position e what)
  (unless (and (symbolp e) (not (member e '(t nil $%pi $%e $%i $inf))))
    (archive-fault reader position "expected a name: ~a" what))
  e)

(defun archive-make-derivative (reader name from arguments places)
  "diff(e, name) or diff(e, name, n)"
  (archive-expect-count reader name from arguments 2 3)
  (destructuring-bind (e variable &optional (order 1)) arguments
    (archive-expect-scalar reader (car places) e)
    (archive-expect-name reader (cadr places) variable "the variable of a derivative")
    (unless (and (integerp order) (<= 1 order *archive-nesting*))
      (archive-fault reader (caddr places)
                     "expected the order of a derivative, an integer from 1 to ~d"
                     *archive-nesting*))
    (when (mnump e)
      (archive-fault reader (car places) "the derivative of a number"))
    (archive-derivative e variable order)))

(defun archive-derivative (e variable order)
  "The noun of a derivative; derivatives of derivatives are one, as in Maxima."
  (cond ((and (consp e) (eq (caar e) '%derivative))
         (archive-simplified (list '(%derivative) e variable order)))
        ((eq e variable) (archive-refuse "the derivative of a name by itself"))
        (t (list '(%derivative simp) e variable order))))

(defun archive-make-integral (reader name from arguments places)
  "integrate(e, name) or integrate(e, name, a, b)"
  (archive-expect-count reader name from arguments 2 4)
  (archive-expect-name reader (cadr places) (cadr arguments) "the variable of an integral")
  (loop for e in arguments for place in places do (archive-expect-scalar reader place e))
  (archive-inert '%integrate arguments))

(defun archive-make-at (reader name from arguments places)
  "at(e, name = v) or at(e, [name = v, ..])"
  (archive-expect-count reader name from arguments 2)
  (destructuring-bind (e where) arguments
    (archive-expect-scalar reader (car places) e)
    (unless (or (archive-substitution-p where)
                (and (eq (archive-form-kind where) :list) (cdr where)
                     (every #'archive-substitution-p (cdr where))))
      (archive-fault reader (cadr places)
                     "expected name = value, or a list of these, as second argument of at"))
    (archive-inert '%at
                   (list e (if (and (eq (archive-form-kind where) :list) (null (cddr where)))
                               (cadr where) where)))))

(defun archive-substitution-p (e)
  "True for name = value, where the name may be a derivative."
  (and (consp e) (eq (caar e) 'mequal) (eq (archive-form-kind (caddr e)) :scalar)
       (or (symbolp (cadr e)) (and (consp (cadr e)) (eq (caar (cadr e)) '%derivative)))))

(defun archive-make-matrix (reader name from arguments places)
  (declare (ignore name from))
  (loop for row in arguments for place in places
        do (archive-expect-kind reader place row "a row, [..]," :list)
           (unless (and (cdr row) (= (length row) (length (car arguments))))
             (archive-fault reader place "a row of ~d elements in a matrix whose first row has ~d"
                            (length (cdr row)) (length (cdar arguments))))
           (unless (archive-all-scalar-p (cdr row))
             (archive-fault reader place "the elements of a matrix are expressions")))
  (archive-inert '$matrix arguments))

(defun archive-make-diagonal (reader name from arguments places)
  "The square matrix with ARGUMENTS on its diagonal."
  (declare (ignore name))
  (loop for e in arguments for place in places do (archive-expect-scalar reader place e))
  (when (> (length arguments) *archive-nesting*)
    (archive-fault reader from "a diagonal of more than ~d elements" *archive-nesting*))
  (archive-inert '$matrix
                 (loop for e in arguments for i from 0
                       collect (archive-inert 'mlist
                                              (loop for j below (length arguments) collect
                                                (if (= i j) e 0))))))

(defun archive-make-notequal (reader name from arguments places)
  (archive-expect-count reader name from arguments 2)
  (loop for e in arguments for place in places do (archive-expect-scalar reader place e))
  (archive-inert '$notequal arguments))

(defun archive-make-piecewise (reader name from arguments places)
  "piecewise([condition, value], ...)"
  (declare (ignore name from))
  (loop for case in arguments for place in places
        unless (and (eq (archive-form-kind case) :list) (= (length case) 3)
                    (member (archive-form-kind (cadr case)) '(:relation :truth-value))
                    (eq (archive-form-kind (caddr case)) :scalar))
          do (archive-fault reader place "expected [condition, value] in piecewise"))
  (archive-inert '$piecewise arguments))
