;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of names by what is assumed: of equal(a,b), with a - b linear in a name whose coefficient
;;; is a number, that name follows. Names that move have no such value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/facts" "forms/exchange"))

(defun forms-assumed-equation (difference moving)
  "name = value where DIFFERENCE is 0, or nil; neither holds one of the names MOVING."
  (let ((names (cdr ($listofvars difference))))
    (unless (intersection names moving)
      (loop for name in names
            for slope = (sdiff difference name)
            when (and (mnump slope) (not (zerop1 slope)))
              return (list '(mequal simp) name
                           ($expand (sub name (div difference slope))))))))

(defun forms-assumed-values (facts moving)
  "(name = value ..) that follow from FACTS; no value holds one of the names on the left."
  (let ((values '()))
    (dolist (fact facts values)
      (multiple-value-bind (difference sign) (core-fact-difference fact)
        (let ((equation (and (eq sign '$zero)
                             (forms-assumed-equation
                              (forms-exchange ($expand difference) (forms-read-pairs values))
                              moving))))
          (when equation
            (let ((pair (forms-read-pairs (list equation))))
              (setq values
                    (cons equation
                          (loop for (nil name value) in values
                                collect (list '(mequal simp) name
                                              ($expand (forms-exchange value pair)))))))))))))

(defun $forms_assumed_values (moving)
  (cons '(mlist simp) (forms-assumed-values (core-facts) (cdr moving))))
