;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Where a constant M is singular, l M = 0 and M r = 0, the equations l.X = 0 have to determine the
;;; states along r: the matrix of the derivatives of l.X along r is regular, the index is 1.
;;; (E. Hairer, G. Wanner, Solving ordinary differential equations II, VI.1.)
;;; See numerics-checked-index first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "forms/fixed" "forms/judge" "forms/program_judge"
                "forms/rates" "forms/value" "numerics/mass_rank" "numerics/rate_mass"))

(defun numerics-checked-index (rates old values)
  "RATES, whose M is regular or of index 1. OLD are the rates before the exchange of VALUES, for the
message."
  (let* ((rows (forms-rates-mass rates))
         (kernels (loop for group in (numerics-groups rows)
                        for numbers = (numerics-number-rows (numerics-group-rows group rows))
                        for kernel = (and numbers (numerics-kernel-of group numbers))
                        when kernel collect kernel)))
    (when kernels (numerics-check-index rates kernels old values))
    rates))

(defun numerics-check-index (rates kernels old values)
  (let* ((point (forms-new-point t))
         (columns (catch 'forms-no-value (numerics-index-columns rates kernels point)))
         (n (length columns)))
    (when (and columns (member nil (forms-echelon columns n)))
      (let ((names (numerics-vanished-values kernels old values)))
        (core-error "~@[with ~{~a = 0~^, ~} ~]the matrix of ~{~a~^, ~} is singular, and the ~
                     equations that remain do not determine what it leaves open"
                    (mapcar (lambda (name) (core-words (list name))) names)
                    (mapcar (lambda (name) (core-words (list name)))
                            (numerics-kernel-states rates kernels)))))))

(defun numerics-kernel-states (rates kernels)
  (loop for kernel in kernels
        append (loop for i in (numerics-kernel-group kernel)
                     collect (nth i (forms-rates-states rates)))))

(defun numerics-index-columns (rates kernels point)
  "For each r the derivatives of all l.X along it."
  (let ((right (numerics-right-sides rates)))
    (loop for kernel in kernels
          append (loop for r in (numerics-kernel-right kernel)
                       collect (numerics-index-column rates kernels kernel r right point)))))

(defun numerics-index-column (rates kernels kernel r right point)
  (let* ((direction (loop for i in (numerics-kernel-group kernel)
                          for x in r
                          collect (cons (nth i (forms-rates-states rates)) x)))
         (places (loop for kernel in kernels append (numerics-kernel-group kernel)))
         (elements (mapcar (lambda (i) (nth i right)) places))
         (slopes (numerics-slopes elements point direction)))
    (loop for other in kernels
          for own = (loop for nil in (numerics-kernel-group other) collect (pop slopes))
          append (loop for l in (numerics-kernel-left other) collect (forms-fixed-dot l own)))))

(defun numerics-slopes (elements point direction)
  "The derivatives of ELEMENTS along the DIRECTION, by a quotient of differences."
  (flet ((values-after (step)
           (forms-program-values elements (forms-point-along point direction step))))
    (let ((step (forms-step forms-slope-digits)))
      (mapcar (lambda (after before)
                (forms-quotient-of-differences after before forms-slope-digits))
              (values-after step) (values-after (- step))))))

(defun numerics-vanished-values (kernels old values)
  "The names of VALUES that are 0 and stood in the rows of the KERNELS."
  (let ((inputs (algebra-inputs-of
                 (loop for kernel in kernels
                       append (loop for i in (numerics-kernel-group kernel)
                                    append (mapcar #'cdr (nth i (forms-rates-mass old))))))))
    (loop for (name . element) in values
          when (and (eql element 0) (member name inputs)) collect name)))
