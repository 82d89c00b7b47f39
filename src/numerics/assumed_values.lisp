;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Numbers for parameters against what is assumed of these, as l > 0: the equations may rest on
;;; it, where the root of l^2 was taken. At the border, l = 0, they hold too, or divide by zero,
;;; which is said elsewhere. See numerics-check-assumed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_from_expressions" "forms/fixed"
                "forms/program_judge" "forms/value" "numerics/element_words"))

(defun numerics-check-assumed (pairs)
  "An error where the values PAIRS, ((name . element) ..), are against a relation that is assumed."
  (dolist (fact (core-facts))
    (multiple-value-bind (difference sign) (core-fact-difference fact)
      (let* ((element (car (core-attempt (lambda () (algebra-program-element difference)))))
             (value (and element (numerics-value-with element pairs))))
        (when (and value (not (forms-negligible-p value))
                   (or (eq sign '$zero) (and (member sign '($pos $pz)) (minusp value))))
          (core-error "~{~a = ~a~^, ~}: against ~a, which is assumed and on which the ~
                       equations rest"
                      (numerics-words-of-values element pairs) (core-words (list fact))))))))

(defun numerics-value-with (element pairs)
  "The value of ELEMENT with PAIRS, a fixed-point number; nil where a name is left."
  (let ((new (first (algebra-exchanged (list element) (algebra-exchange-by pairs)))))
    (unless (algebra-open-inputs-of (list new))
      (first (catch 'forms-no-value
               (forms-program-values (list new) (forms-new-point nil)))))))

(defun numerics-words-of-values (element pairs)
  "Names and values, as texts, of those of PAIRS that stand in ELEMENT."
  (loop for name in (algebra-inputs-of (list element))
        for pair = (assoc name pairs :test #'algebra-same-name-p)
        when pair append (list (core-words (list name)) (numerics-value-text (cdr pair)))))
