;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Sums, products and quotients of expressions, lists and matrices: what is not plain arithmetic is
;;; done here, element by element.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/shapes"))

(defun archive-minus (reader position e)
  (archive-expect-kind reader position e "an expression" :scalar :list :matrix)
  (archive-computed (reader position) (archive-over-elements #'archive-negative e)))

(defun archive-over-elements (function e)
  "FUNCTION of E, or of each element of a list or matrix E."
  (if (member (archive-form-kind e) '(:list :matrix))
      (cons (car e) (mapcar (lambda (part)
                              (unless (member (archive-form-kind part) '(:scalar :list :matrix))
                                (archive-refuse "arithmetic with a list that holds more than ~
                                                 expressions"))
                              (archive-over-elements function part))
                            (cdr e)))
      (funcall function e)))

(defun archive-over (reader position e)
  (archive-expect-scalar reader position e)
  (archive-computed (reader position)
    (if (reader-doubles reader) (list '(archive-over) e) (archive-inverse e))))

(defun archive-multiply (reader places factors)
  "The product of FACTORS, of which one may be a list or a matrix."
  (loop for place in places for factor in factors
        unless (archive-divisor-p factor)
          do (archive-expect-kind reader place factor "an expression" :scalar :list :matrix))
  (let ((composite (remove-if-not (lambda (f) (member (archive-form-kind f) '(:list :matrix)))
                                  factors)))
    (when (cdr composite)
      (archive-fault reader (car places) "a product of lists or matrices; write it out"))
    (archive-computed (reader (car places))
      (if composite
          (archive-over-elements (lambda (e)
                                   (archive-multiply-scalars (substitute e (car composite)
                                                                         factors)))
                                 (car composite))
          (archive-multiply-scalars factors)))))

(defun archive-divisor-p (factor) (and (consp factor) (eq (caar factor) 'archive-over)))

(defun archive-multiply-scalars (factors)
  "The product of FACTORS; a divisor is still a divisor where results are doubles, so that 1.0/3
is rounded once."
  (if (loop for factor in factors never (archive-divisor-p factor))
      (archive-product factors)
      (let ((product (car factors)))
        (dolist (factor (cdr factors) product)
          (setq product
                (cond ((not (archive-divisor-p factor)) (archive-product (list product factor)))
                      ((and (mnump product) (mnump (cadr factor))
                            (or (floatp product) (floatp (cadr factor))))
                       (archive-quotient-of-numbers product (cadr factor)))
                      (t (archive-product (list product (archive-inverse (cadr factor)))))))))))

(defun archive-add (reader places terms)
  "The sum of TERMS: of expressions, or of lists or matrices of one shape."
  (loop for place in places for term in terms
        do (archive-expect-kind reader place term "an expression" :scalar :list :matrix))
  (archive-computed (reader (car places))
    (if (archive-all-scalar-p terms)
        (archive-sum terms)
        (archive-add-elements terms))))

(defun archive-add-elements (terms)
  (if (archive-all-scalar-p terms)
      (archive-sum terms)
      (let ((first (car terms)))
        (unless (and (member (archive-form-kind first) '(:list :matrix))
                     (loop for term in terms
                           always (and (eq (archive-form-kind term) (archive-form-kind first))
                                       (= (length term) (length first)))))
          (archive-refuse "a sum of lists or matrices that differ in shape"))
        (cons (car first)
              (apply #'mapcar (lambda (&rest parts) (archive-add-elements parts))
                     (mapcar #'cdr terms))))))
