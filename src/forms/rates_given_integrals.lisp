;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; First integrals that are given, as programs beside the rates: V is constant along M x' = X
;;; where, at a random point, (grad V, -dV/dt) is a combination of the rows (M, X). What is not so
;;; is left out with a warning. See forms-with-given-integrals first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_from_expressions"
                "algebra/program_nodes" "forms/fixed" "forms/program_judge" "forms/rates"
                "forms/rates_integrals" "forms/value"))

(defparameter *forms-most-judged-states* 60 "With M the judgement of more states takes long.")

(defun forms-with-given-integrals (rates given everywhere)
  "RATES with the integrals GIVEN, equations in the current program; EVERYWHERE: they are said to
be constant along all motions, and not on some of them only."
  (loop for (nil name e) in (cdr given)
        for element = (first (core-attempt (lambda () (algebra-program-element e))))
        for integral = (and element
                            (forms-first-integral name element
                                                  (forms-size-of-expression e element)))
        do (cond ((null integral)
                  (push (format nil "~a: it has no program" (core-words (list name)))
                        (forms-rates-untold rates)))
                 ((assoc name (forms-rates-integrals rates)))
                 ((and everywhere (not (forms-stays-constant-p rates element)))
                  (core-warn "~a of the integrals is not constant along the equations; its drift ~
                              is not looked at"
                             (core-words (list name))))
                 (t (setf (forms-rates-integrals rates)
                          (append (forms-rates-integrals rates) (list integral))))))
  rates)

(defun forms-size-of-expression (e element)
  "The sum of the sizes of the terms of E."
  (forms-size-of (if (and (consp e) (eq (caar e) 'mplus))
                     (mapcar #'algebra-program-element (cdr e))
                     (list element))))

(defun forms-stays-constant-p (rates element)
  "Whether ELEMENT is constant along RATES at a random point, as far as that can be told."
  (or (assoc '$velocities (forms-rates-outputs rates))
      (> (length (forms-rates-states rates)) *forms-most-judged-states*)
      (let ((found (forms-program-values-on-all-sides
                    (append (forms-integral-row rates element)
                            (loop for row in (forms-full-mass rates)
                                  for x in (forms-right-sides rates)
                                  append row collect x))
                    (forms-new-point t)))
            (width (1+ (length (forms-rates-states rates)))))
        (or (null found)
            (forms-in-rows-p (subseq found 0 width)
                             (loop for row on (nthcdr width found) by (lambda (l) (nthcdr width l))
                                   collect (subseq row 0 width)))))))

(defun forms-integral-row (rates element)
  "(dV/dx_1, .., -dV/dt)"
  (flet ((input (name) (algebra-program-input (or (car (rassoc name (forms-rates-pairs rates)
                                                               :test #'alike1))
                                                  name))))
    (let ((gradient (algebra-program-gradient
                     element (mapcar #'input (append (forms-rates-states rates) '($t))))))
      (append (butlast gradient) (list (algebra-program-negate (car (last gradient))))))))

(defun forms-full-mass (rates)
  "The rows of M."
  (let ((n (length (forms-rates-states rates))))
    (loop for i below n
          for sparse = (if (forms-rates-mass rates)
                           (nth i (forms-rates-mass rates))
                           (list (cons i 1)))
          collect (loop for j below n collect (or (cdr (assoc j sparse)) 0)))))

(defun forms-in-rows-p (item rows)
  (forms-in-echelon-p item (values (forms-echelon rows (length item)))))

;;; For Maxima.

(defun $forms_with_given_integrals (rates given everywhere)
  (let ((*algebra-program* (forms-rates-program rates)))
    (forms-with-given-integrals rates given everywhere)))
