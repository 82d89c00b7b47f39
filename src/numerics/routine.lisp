;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Which of the two runs a plan: the register machine costs nothing before the first call, compiled
;;; code takes about 30 us a node to make and then saves 0.6 ns a node and call. So a
;;; routine begins on the machine and is compiled once it has been called often enough to have paid
;;; for it; where many calls are expected it is compiled at once. Both give the same bits, so that a
;;; run does not depend on when that happens.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/compile" "numerics/machine" "numerics/native" "numerics/plan"))

(defparameter *numerics-calls-worth-compiling* 40000)

(defvar *numerics-compile-seconds* 0d0
  "The time that all programs took to be made ready, those that were compiled during a run too.")

(defun numerics-routine (program elements &key (how :auto) (calls 0))
  "The function (time x out) that puts the values of ELEMENTS of PROGRAM into OUT. HOW is :machine,
:compiled or :auto, by the number of CALLS that are expected and by those that come."
  (numerics-routine-of-plan
   (numerics-new-plan program (loop for element in elements
                                    for k from 0 collect (cons k element))
                      (length elements))
   how calls))

(defun numerics-made (make plan)
  "What MAKE makes of PLAN; the time counts."
  (let ((start (numerics-working-seconds)))
    (unwind-protect (funcall make plan)
      (incf *numerics-compile-seconds* (- (numerics-working-seconds) start)))))

(defun numerics-routine-of-plan (plan how calls)
  "Two functions, (time x out), and (seed out) for plans with seeds."
  #-sbcl (progn how calls (numerics-made #'numerics-machine plan))
  #+sbcl
  (cond ((or (eq how :machine) (not (numerics-compilable-p plan)))
         (numerics-made #'numerics-machine plan))
        ((or (eq how :compiled) (>= calls *numerics-calls-worth-compiling*))
         (numerics-made #'numerics-compiled plan))
        (t (numerics-compiled-later plan))))

#+sbcl
(defun numerics-compiled-later (plan)
  (let ((calls *numerics-calls-worth-compiling*) (compiled nil))
    (declare (fixnum calls))
    (multiple-value-bind (first second) (numerics-made #'numerics-machine plan)
      (declare (type function first))
      (values
       (lambda (time x out)
         (when (and (< (decf calls) 0) (not compiled))
           (multiple-value-setq (first second) (numerics-made #'numerics-compiled plan))
           (setq compiled t))
         (funcall first time x out))
       (and second
            (lambda (seed out)
              (decf calls)
              (funcall (the function second) seed out)))))))
