;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_reference.mac, with numerics_problems.lisp.

(in-package :maxima)

(defun reference-method (name)
  (ecase name ($dop853 #'numerics-dopri) ($radau #'numerics-radau) ($gauss #'numerics-gauss)))

(defun $test_conditioning (name problem span start &rest settings)
  "[floor in units of rounding, time since when]"
  (let ((controls (test-controls (third span) 1e-8 settings)))
    (multiple-value-bind (floor since)
        (numerics-with-masked-traps
          (numerics-conditioning (reference-method name) problem controls
                                 (numerics-moment (coerce ($float (second span)) 'double-float))
                                 (test-vector start)))
      (test-list (and floor (/ floor numerics-unit-roundoff)) since))))

(defun $test_error (name problem span start tolerance exact)
  "The distance of the end from EXACT."
  (let* ((controls (test-controls (third span) tolerance '())) (state (test-vector start)))
    (numerics-with-masked-traps
      (numerics-distance
       (numerics-outcome-state
        (funcall (reference-method name) problem controls
                 (numerics-moment (coerce ($float (second span)) 'double-float)) state (constantly nil)))
       (test-vector exact) (numerics-full-scales controls (length state))))))

(defun $test_reference (problem start times &rest more)
  "[states or false, floor, method]; MORE is the greatest number of steps of Taylor series."
  (let ((reference (numerics-with-masked-traps
                     (numerics-reference-of problem (test-controls (car (last times)) 1e-8 '())
                                            (cdr start) (cdr times)
                                            :most-steps (or (first more) 5000)))))
    (let ((rows (numerics-reference-rows reference)))
      (test-list (and rows (test-numbers (rest (first (last rows)))))
                 (and rows (numerics-reference-floor reference
                                                     (test-vector (mapcar (constantly 1) (cdr start)))))
                 (numerics-reference-method reference)))))

(defun $test_problem_of_program (names rates)
  "The problem names' = RATES with its program."
  (numerics-problem-of-program
   ($algebra_program (cons '(mlist simp) (cons '$t (cdr names)))
                     (test-list (algebra-field '$rates rates)))
   (cdr names)))

(defun $test_without_jacobian (problem)
  (setf (numerics-problem-jacobian problem) nil (numerics-problem-pattern problem) nil)
  problem)
