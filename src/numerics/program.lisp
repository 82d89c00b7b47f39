;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A program whose inputs are the time and the states, M x' = X(t, x): the elements of X, of its
;;; guards, and the constant matrix M. It comes from a record, in which all parameters have become
;;; numbers, or from rates. Whoever adds elements to it does so inside with-numerics-program, so
;;; that what is shared is computed once.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "algebra/program_record" "forms/rates"))

(defstruct numerics-program
  algebra  ; the program in which the elements were made
  names    ; the states, expressions
  rates    ; elements X_i
  mass     ; nil for the identity, else rows ((column . element) ..) of constants, columns from 0
  guards   ; elements
  (slopes :unknown)) ; rows ((j . dX_i/dx_j) ..), or nil where they would be too long

(defmacro with-numerics-program (program &body body)
  `(let ((*algebra-program* (numerics-program-algebra ,program))) ,@body))

(defun numerics-program-states (program)
  "The nodes of the states."
  (with-numerics-program program
    (mapcar #'algebra-program-input (numerics-program-names program))))

;;; From rates, in whose program they were made.

(defun numerics-program-of (rates)
  (make-numerics-program
   :algebra (forms-rates-program rates) :names (forms-rates-states rates)
   :rates (forms-right-sides rates)
   :mass (forms-rates-mass rates)
   :guards (loop for (nil pivot . whole) in (forms-rates-guards rates)
                 collect (algebra-program-divide pivot whole))))

;;; From a record with the outputs rates, mass and guards, the last two where there are such.

(defun numerics-read-program (record names)
  (let ((*algebra-program* (make-algebra-program)))
    (destructuring-bind (inputs outputs) (algebra-read-program record)
      (declare (ignore inputs))
      (flet ((output (name) (cdr (assoc name outputs))))
        (make-numerics-program
         :algebra *algebra-program* :names names
         :rates (numerics-checked-rates (output '$rates) (length names))
         :mass (numerics-mass-rows (output '$mass) (length names))
         :guards (and (output '$guards) (algebra-output-elements (output '$guards))))))))

(defun numerics-checked-rates (output n)
  (let ((rates (and output (algebra-output-elements output))))
    (unless (= (length rates) n)
      (core-error "a program of rates has an output rates with one element for each of its ~d ~
                   states, found ~d" n (length rates)))
    rates))

(defun numerics-mass-rows (output n)
  "The rows of the matrix OUTPUT without zeros; nil for none and for the identity."
  (let ((rows (and output
                   (loop for row in (cdr output)
                         collect (loop for element in row
                                       for j from 0
                                       unless (eql element 0) collect (cons j element))))))
    (unless (or (null rows) (= (length rows) n))
      (core-error "the matrix mass has ~d rows for ~d states" (length rows) n))
    (if (loop for row in rows
              for i from 0
              always (and (null (cdr row)) (eql (caar row) i) (eql (cdar row) 1)))
        nil
        rows)))
