;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_taylor.mac: series and rows of many digits of expressions.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/taylor" "numerics/taylor_expansion" "numerics/taylor_numbers"
                "numerics/program" "algebra/program_record"))

(defun taylor-list (items) (cons '(mlist simp) items))

(defun taylor-program (names rates &optional mass)
  "The program of MASS*names' = RATES, expressions of t and NAMES."
  (numerics-read-program
   ($algebra_program (taylor-list (cons '$t (cdr names)))
                     (taylor-list (cons (algebra-field '$rates rates)
                                        (and mass (list (algebra-field '$mass mass))))))
   (cdr names)))

(defun $test_series (e start order digits)
  "The Taylor coefficients of E, an expression of t, at START."
  (let* ((bits (core-bits-of-digits (+ digits 20)))
         (expansion (numerics-expansion-of (taylor-program (taylor-list (list '$x))
                                                           (taylor-list (list e)))
                                           bits (1+ order)))
         (fault (catch 'numerics-series-fault
                  (numerics-expand expansion (numerics-fixed start bits) (list 0) (ash 1 bits))
                  nil)))
    (or fault
        (taylor-list
         (loop for k from 0 to order
               for x = (* (1+ k) (svref (first (numerics-expansion-states expansion)) (1+ k)))
               collect (numerics-bigfloat-of-fixed x bits digits))))))

(defun taylor-status (outcome)
  (intern (substitute #\_ #\- (format nil "$~a" (numerics-outcome-status outcome))) :maxima))

(defun $test_taylor (names rates start times digits &rest more)
  "[status, rows, about, time]; MORE is the matrix mass, and the greatest number of steps."
  (let ((outcome (numerics-taylor (taylor-program names rates (first more)) (cdr start) (cdr times)
                                  digits :most-steps (or (second more) 10000))))
    (taylor-list (list (taylor-status outcome)
                       (taylor-list (mapcar #'taylor-list (numerics-taylor-outcome-rows outcome)))
                       (numerics-outcome-about outcome)
                       (aref (numerics-outcome-moment outcome) 0)))))
