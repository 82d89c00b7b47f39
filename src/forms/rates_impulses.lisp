;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Impulses that rates do not show: where a function that was differentiated jumps, as a potential
;;; signum(x) does at x = 0, its derivative is an impulse there, and 0 everywhere else. While rates
;;; are derived the derivative of a sign is an operation of its own, of value 0; then it is taken
;;; out of them, and what stood at it is kept beside: lists (u gap ..), u the argument of the sign,
;;; the gaps what the rates would be with 1 for the impulse at u, less what they are. Where u
;;; changes its sign and a gap is not 0 the state jumps. See forms-with-impulses first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/branch_slopes" "algebra/impulses" "algebra/program_derivative"
                "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "algebra/program_record" "forms/equations_as_program"
                "forms/program_judge" "forms/rates" "forms/value"))

(defmacro forms-with-impulses (&body body)
  "The rates that BODY gives, without impulses, these beside them."
  `(forms-impulses-apart (let ((*algebra-impulses* t)) ,@body)))

(defun forms-impulses-apart (rates)
  (let ((arguments (forms-impulse-arguments
                    (append (forms-rates-elements rates)
                            (loop for (nil . elements) in (forms-rates-integrals rates)
                                  append elements)))))
    (if arguments (forms-rates-beside-impulses rates arguments) rates)))

(defun forms-impulse-arguments (elements)
  (loop for node in (algebra-live-nodes elements)
        when (algebra-operation-p :impulse node) collect (algebra-node-left node)))

(defun forms-rates-beside-impulses (rates arguments)
  "RATES with 0 for impulses, which are known by their ARGUMENTS. What is no integral in the sense
that a number stays the same across an impulse is none of theirs."
  (let ((new (copy-forms-rates rates)))
    (setf (forms-rates-integrals new)
          (remove-if (lambda (integral) (forms-impulse-arguments (cdr integral)))
                     (forms-rates-integrals rates)))
    (let ((*algebra-impulses* (forms-impulse-values nil 0 nil)))
      (setq new (forms-exchanged-rates new #'algebra-program-input #'algebra-fault-division)))
    (setf (forms-rates-impulses new)
          (forms-impulses-in (forms-moving-elements rates) arguments))
    new))

(defun forms-impulses-in (elements arguments)
  "Lists (u gap ..) for those of ARGUMENTS whose impulses change ELEMENTS."
  (loop for u in arguments
        for gaps = (forms-impulse-gaps elements u)
        when gaps collect (cons u gaps)))

(defun forms-moving-elements (rates)
  "The elements of X, of the cyclic velocities, and of M."
  (append (loop for (name . value) in (forms-rates-outputs rates)
                when (member name '($rates $quadratures)) append (algebra-output-elements value))
          (loop for row in (forms-rates-mass rates) append (mapcar #'cdr row))))

(defun forms-impulse-values (u impulse sign)
  "What gives the IMPULSE and the SIGN of U, and 0 for other impulses."
  (lambda (operation x)
    (cond ((eq operation :impulse) (if (eq x u) impulse 0))
          ((eq x u) sign))))

(defun forms-impulse-gaps (elements u)
  "By how much ELEMENTS change with 1 for the impulse at U, on both sides of it, without those that
do not."
  (flet ((at (impulse sign)
           (let ((*algebra-impulses* (forms-impulse-values u impulse sign)))
             (algebra-exchanged elements #'algebra-program-input))))
    (remove-if (lambda (gap) (forms-nought-p (list gap) (forms-new-point t)))
               (loop for sign in '(1 -1)
                     append (mapcar #'algebra-program-subtract (at 1 sign) (at 0 sign))))))

;;; For Maxima. Equations x' = J dH/dx were derived without them.

(defun $forms_rates_with_impulses (rates function bracket variables)
  "RATES of x' = J dH/dx, VARIABLES x, with the impulses of the FUNCTION H; BRACKET is J."
  (if (algebra-branched-p function)
      (forms-rates-with-slopes (copy-forms-rates rates) function bracket variables)
      rates))

(defun forms-rates-with-slopes (rates function bracket variables)
  (let* ((*algebra-program* (forms-rates-program rates))
         (slopes (let ((*algebra-impulses* t))
                   (algebra-program-gradient (algebra-program-element function)
                                             (mapcar #'algebra-program-input (cdr variables)))))
         (elements (loop for row in (cdr bracket)
                         collect (forms-program-product
                                  (mapcar #'algebra-program-element (cdr row)) slopes))))
    (setf (forms-rates-impulses rates)
          (forms-impulses-in elements (forms-impulse-arguments elements)))
    rates))
