;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; T, U and L as programs: T by bodies as in kinetic.lisp, heights as in twists.lisp, each link's
;;; from its parent's. The number of operations is linear in the number of bodies.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/kinetic" "linmodel/program_equations"))

(defun linmodel-program-kinetic (a links bodies task)
  "T."
  (linmodel-energy-of-bodies a links bodies (forms-task-q task)
                             (cons 1 (mapcar #'algebra-program-input (forms-task-v task)))))

(defun linmodel-program-weight (a links bodies gravity)
  "sum m g.r_C."
  (let ((carried (linmodel-carried-vectors a links gravity)) (sum 0))
    (dolist (body (cdr bodies) sum)
      (setq sum (linmodel-plus
                 a sum (linmodel-weight a body (nth (1- (second body)) carried)))))))

;;; For Maxima.

(defun $linmodel_function_program (scene gravity potential task name kinetic)
  "The record of NAME: T where KINETIC is true, the weight's U, and the POTENTIAL beside it."
  (destructuring-bind (links bodies) (cddr scene)
    (let ((task (forms-read-task task)))
      (with-algebra-program
        (let ((a (linmodel-program-arithmetic)))
          (forms-function-program
           task name
           (algebra-program-sum
            (list (if kinetic (linmodel-program-kinetic a links bodies task) 0)
                  (linmodel-program-weight a links bodies gravity)
                  (algebra-program-element potential)))
           (lambda (point)
             (+ (funcall (linmodel-value-of scene (forms-task-v task) gravity point kinetic) point)
                (forms-fixed-value potential point)))
           "value of the program against that in fixed axes"))))))
