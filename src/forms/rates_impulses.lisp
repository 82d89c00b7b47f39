;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Impulses that rates do not show: where a function that was differentiated jumps, as a potential
;;; signum(x) does at x = 0, its derivative is an impulse there, and 0 everywhere else. While rates
;;; are derived the derivative of a sign is an operation of its own, of value 0; then it is taken
;;; out of them, and what stood at it is kept beside: lists (u (i . gap) ..), u the argument of the
;;; sign, i the place of a rate. The gap is the mean of the factor of the impulse while the sign s
;;; of u goes from -1 to 1, as in a smooth picture of the jump: that of signum(u)^2, 2 s, is 0. All
;;; signs of multiples of u go with it. See forms-with-impulses first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/branch_slopes" "algebra/impulses" "algebra/program_derivative"
                "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "forms/equations_as_program" "forms/fixed"
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
    (let ((*algebra-sides* (lambda (operation u)
                             (declare (ignore u))
                             (and (eq operation :impulse) 0))))
      (setq new (forms-exchanged-rates new #'algebra-program-input #'algebra-fault-division)))
    (setf (forms-rates-impulses new)
          (forms-impulses-in (forms-right-sides rates) arguments))
    new))

(defun forms-impulses-in (elements arguments)
  "Lists (u (i . gap) ..) of ELEMENTS, in the places i, for ARGUMENTS that are no multiples of
others."
  (let ((marks (forms-impulse-marks elements arguments)))
    (loop for multiples in (forms-multiples arguments)
          for gaps = (loop for element in elements
                           for mark in marks
                           for i from 0
                           when (loop for (place) in multiples thereis (logbitp place mark))
                             append (forms-gap-at i element arguments multiples))
          when gaps collect (cons (nth (car (first multiples)) arguments) gaps))))

(defun forms-impulse-marks (elements arguments)
  "For each of ELEMENTS the number whose binary digits tell which of ARGUMENTS have an impulse in
it."
  (let ((marks (make-hash-table)) (places (make-hash-table :test #'eq)))
    (loop for u in arguments for place from 0 do (setf (gethash u places) place))
    (flet ((mark (element)
             (if (algebra-node-p element) (gethash (algebra-node-index element) marks 0) 0)))
      (dolist (node (algebra-live-nodes elements))
        (setf (gethash (algebra-node-index node) marks)
              (if (algebra-operation-p :impulse node)
                  (ash 1 (gethash (algebra-node-left node) places))
                  (reduce #'logior (mapcar #'mark (algebra-node-parts node)) :initial-value 0))))
      (mapcar #'mark elements))))

;;; Multiples: 1 - x and x - 1 have one border.

(defun forms-multiples (arguments)
  "Groups ((place . c) ..) of places of ARGUMENTS, each c times the first of its group; c is the
quotient at two random points."
  (let* ((points (list (forms-new-point t) (forms-other-point arguments)))
         (values (loop for u in arguments
                       collect (loop for point in points
                                     collect (forms-value-or-nil u point))))
         (groups '()))
    (loop for value in values
          for place from 0
          do (let ((group (find-if (lambda (group)
                                     (forms-multiple (nth (car (first group)) values) value))
                                   groups)))
               (if group
                   (setf (cdr (last group))
                         (list (cons place (forms-multiple (nth (car (first group)) values)
                                                           value))))
                   (push (list (cons place 1)) groups))))
    (reverse groups)))

(defun forms-other-point (elements)
  "A point with other values than the random ones for the inputs of ELEMENTS."
  (let ((point (forms-new-point t)))
    (dolist (name (algebra-inputs-of elements) point)
      (let ((value (forms-random-value name)))
        (forms-set-place name (+ (forms-fixed 5/7) (forms-fixed-times value value)) point)))))

(defun forms-value-or-nil (element point)
  (first (catch 'forms-no-value (forms-program-values (list element) point))))

(defun forms-multiple (values others)
  "The number c with OTHERS = c VALUES, at two points; nil where there is none."
  (destructuring-bind ((a b) (c d)) (list values others)
    (and a b c d (/= a 0) (/= b 0) (/= c 0)
         (forms-negligible-p (- (forms-fixed-times a d) (forms-fixed-times b c)))
         (rationalize (coerce (/ c a) 'double-float)))))

;;; Gaps

(defparameter *forms-signs-on-the-way* '((-1 . 1/8) (-1/3 . 3/8) (1/3 . 3/8) (1 . 1/8))
  "Values of a sign and weights: Simpson's rule of 3/8, without 0.")

(defun forms-gap-at (i element arguments multiples)
  "((I . gap)) of ELEMENT, or nothing where the gap vanishes."
  (let ((gap (forms-mean-gap (forms-with-open-side element arguments multiples))))
    (unless (forms-nought-p (list gap) (forms-new-point t)) (list (cons i gap)))))

(defun forms-mean-gap (open)
  "The mean of the factor of the impulse in OPEN; 1 where it has no value on the way."
  (or (first (core-attempt
              (lambda ()
                (reduce #'algebra-program-add
                        (loop for (sign . weight) in *forms-signs-on-the-way*
                              collect (algebra-program-multiply
                                       weight (algebra-program-subtract
                                               (forms-at-side open 1 sign)
                                               (forms-at-side open 0 sign))))))))
      1))

(defun forms-with-open-side (element arguments multiples)
  "ELEMENT with the names forms-impulse-factor and forms-side for the impulse and the sign of the
first argument of MULTIPLES, those of the others by these, 0 for all other impulses; the square of
a sign is 1."
  (let* ((impulse (algebra-program-input 'forms-impulse-factor))
         (side (algebra-program-input 'forms-side)) (other-side (algebra-program-negate side))
         (*algebra-sides*
           (lambda (operation u)
             (let ((c (cdr (find u multiples :key (lambda (pair) (nth (car pair) arguments))))))
               (case operation
                 (:impulse (if c (algebra-program-divide impulse (abs c)) 0))
                 (:sign (and c (if (plusp c) side other-side)))
                 (:absolute (and (member u (list side other-side)) 1)))))))
    (first (algebra-exchanged (list element) #'algebra-program-input))))

(defun forms-at-side (element impulse side)
  (first (algebra-exchanged (list element)
                            (algebra-exchange-by (list (cons 'forms-impulse-factor impulse)
                                                       (cons 'forms-side side))))))

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
