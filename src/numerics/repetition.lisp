;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Long programs repeat themselves: a chain of bodies does the same for each of them, with other
;;; places and other constants. Their code would be larger than the caches of a processor, and then
;;; it takes more time to fetch than to run. So a program is cut where it repeats, and parts that
;;; differ in places and constants alone become one function, which takes these from tables that
;;; are read from the first to the last element. Look first at numerics-repeated-parts, then at
;;; numerics-shared-form.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "numerics/native"
                "numerics/problem"))

;;; Cuts. Two statements are alike where their operations and the kinds of their operands are. A
;;; window of statements that was met before makes a period likely; a run is as long as statements
;;; are like those a period later.

(defparameter *numerics-window* 48 "Statements in a row that are compared.")
(defparameter *numerics-shortest-period* 120 "Shorter periods are taken several times.")

(defun numerics-statement-kind (statement)
  "A whole number, the same for statements that are alike."
  (flet ((kind (element)
           (cond ((not (algebra-node-p element)) 1)
                 ((algebra-input-p element) 2)
                 (t 3))))
    (if (algebra-node-p statement)
        (+ (* 16 (sxhash (algebra-node-operation statement)))
           (* 4 (kind (algebra-node-left statement))) (kind (algebra-node-right statement)))
        (sxhash (first statement)))))

(defun numerics-likely-periods (kinds)
  "A vector: at each place the distance to the last window that was the same, or nil."
  (let* ((count (length kinds)) (periods (make-array count :initial-element nil))
         (last (make-hash-table)) (hash 0) (bits (1- (ash 1 50)))
         (power (logand bits (expt 31 *numerics-window*))))
    (dotimes (end count periods)
      (setq hash (logand bits (+ (* 31 hash) (aref kinds end))))
      (when (>= end *numerics-window*)
        (setq hash (logand bits (- hash (* power (aref kinds (- end *numerics-window*)))))))
      (let ((before (gethash hash last)) (place (- end *numerics-window* -1)))
        (when (>= place 0)
          (when before (setf (aref periods before) (- place before)))
          (setf (gethash hash last) place))))))

(defun numerics-run-length (kinds start period)
  "How many statements from START on are like those a PERIOD later."
  (loop for k from start below (- (length kinds) period)
        while (= (aref kinds k) (aref kinds (+ k period)))
        count t))

(defun numerics-repeated-parts (statements length)
  "STATEMENTS as a list of parts of at most LENGTH, cut where they repeat."
  (let* ((statements (coerce statements 'simple-vector)) (count (length statements))
         (kinds (map 'vector #'numerics-statement-kind statements))
         (periods (numerics-likely-periods kinds)) (place 0) (from 0) (parts '()))
    (flet ((cut (from to)
             (loop for k from from below to by length
                   do (push (coerce (subseq statements k (min to (+ k length))) 'list) parts))))
      (loop while (< place count)
            do (multiple-value-bind (period times) (numerics-repetition kinds place
                                                                        (aref periods place))
                 (cond (period
                        (cut from place)
                        (loop repeat times
                              do (cut place (+ place period))
                                 (incf place period))
                        (setq from place))
                       (t (incf place)))))
      (cut from count)
      (nreverse parts))))

(defun numerics-repetition (kinds place period)
  "The period, not a short one, and how many times it fits from PLACE on; nil for less than thrice."
  (when period
    (let* ((length (+ period (numerics-run-length kinds place period)))
           (long (* period (ceiling *numerics-shortest-period* period)))
           (times (floor length long)))
      (and (>= times 3) (values long times)))))

;;; One function for parts that are alike.

(defstruct numerics-sharing
  "What a form is while it is changed: the places and constants that were found, the last first."
  (variables (make-hash-table :test #'eq)) (places (make-hash-table :test #'equal))
  (place-list '()) (constant-list '()))

(defun numerics-shared-place (sharing vector place)
  "The form that stands for PLACE of VECTOR."
  (let* ((key (cons vector place)) (places (numerics-sharing-places sharing))
         (number (or (gethash key places)
                     (progn (push place (numerics-sharing-place-list sharing))
                            (setf (gethash key places) (hash-table-count places))))))
    `(numerics-table-place ,number)))

(defun numerics-shared-constant (sharing value)
  (prog1 `(numerics-table-constant ,(length (numerics-sharing-constant-list sharing)))
    (push value (numerics-sharing-constant-list sharing))))

(defun numerics-shared-variable (sharing variable)
  (let ((variables (numerics-sharing-variables sharing)))
    (or (gethash variable variables)
        (setf (gethash variable variables)
              (intern (format nil "NUMERICS-N~d" (hash-table-count variables)) :maxima)))))

(defun numerics-shared-text (sharing form)
  (flet ((text (form) (numerics-shared-text sharing form))
         (place (vector place) (numerics-shared-place sharing vector place)))
    (cond ((floatp form) (numerics-shared-constant sharing form))
          ((and form (symbolp form)) (if (symbol-package form)
                                         form
                                         (numerics-shared-variable sharing form)))
          ((atom form) form)
          (t (case (first form)
               (numerics-element
                `(numerics-element ,(second form) ,(place (second form) (third form))))
               (numerics-set-element
                (let ((value (text (fourth form))))
                  `(numerics-set-element ,(second form) ,(place (second form) (third form))
                                         ,value)))
               (let (destructuring-bind (((variable value)) &rest body) (rest form)
                      (let ((value (text value)))
                        `(let ((,(text variable) ,value)) ,@(mapcar #'text body)))))
               (t (if (eq (second form) 'w) ; a function that puts its value there
                      `(,(first form) w ,@(loop for place in (cddr form)
                                                collect (place 'w place)))
                      (cons (first form) (mapcar #'text (rest form))))))))))

(defun numerics-shared-form (body)
  "A form that is the same for all parts that are alike, made of BODY, statements that use x, w and
out; the places, and the constants, that stand in its tables."
  (let* ((sharing (make-numerics-sharing))
         (body (loop for form in body collect (numerics-shared-text sharing form))))
    (values `(lambda (x w out places constants place constant)
               (declare (type numerics-vector x w out constants) (type numerics-indices places)
                        (type (unsigned-byte 31) place constant)
                        (ignorable x w out places constants place constant)
                        (optimize (speed 1) (safety 0) (debug 0)))
               (macrolet ((numerics-table-place (k)
                            `(the (unsigned-byte 31)
                                  (numerics-element places (+ place ,k))))
                          (numerics-table-constant (k)
                            `(numerics-element constants (+ constant ,k))))
                 ,@body))
            (reverse (numerics-sharing-place-list sharing))
            (reverse (numerics-sharing-constant-list sharing)))))

(defun numerics-form-text (form)
  (with-standard-io-syntax (let ((*package* (find-package :maxima))) (prin1-to-string form))))

(defun numerics-shared-routine (bodies)
  "The function (x w out) that does BODIES, lists of statements, one after the other; nil where less
than half of them are like another."
  (let* ((shared (loop for body in bodies
                       collect (multiple-value-list (numerics-shared-form body))))
         (texts (mapcar (lambda (one) (numerics-form-text (first one))) shared))
         (forms (make-hash-table :test #'equal)))
    (loop for text in texts
          for (form) in shared do (setf (gethash text forms) form))
    (when (< (* 2 (hash-table-count forms)) (length bodies))
      (maphash (lambda (text form) (setf (gethash text forms) (compile nil form))) forms)
      (numerics-table-caller
       (map 'simple-vector (lambda (text) (gethash text forms)) texts)
       (coerce (loop for (nil places) in shared append places) 'numerics-indices)
       (coerce (loop for (nil nil constants) in shared append constants) 'numerics-vector)
       (numerics-table-starts (mapcar #'cdr shared))))))

(defun numerics-table-starts (tables)
  "Where each part begins in both tables: a vector of place, constant, place, ..."
  (let ((place 0) (constant 0))
    (coerce (loop for (places constants) in tables
                  append (list place constant)
                  do (incf place (length places))
                     (incf constant (length constants)))
            'numerics-indices)))

(defun numerics-table-caller (functions places constants starts)
  (declare (type simple-vector functions) (type numerics-indices starts))
  (lambda (x w out)
    (declare (optimize speed))
    (dotimes (k (length functions))
      (funcall (the function (svref functions k)) x w out places constants
               (aref starts (* 2 k)) (aref starts (1+ (* 2 k)))))))
