;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials in unknowns, parameters in general position: the set where all of them vanish, taken
;;; apart into components.  Of a Groebner basis by degrees the least element with several factors is
;;; taken: there the first factor vanishes, or the second and not the first, and so on (the algorithm
;;; of Buchberger with factors: Czapor; Graebe).  What does not vanish has an inverse, one variable z
;;; with 1 - z*product = 0 that stays in the basis and is greater than all, so that the elements
;;; without z are the ideal of the closure of the component: all of it solves the equations.  Where a
;;; basis would cost too much the equations are left as they are.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common_roots" "algebra/general_form" "algebra/groebner"
                "algebra/kernels" "algebra/size"))

(defparameter *algebra-most-components* 400 "how many branches are looked at")
(defparameter *algebra-most-factored* 60 "terms of an element up to which it is factored")

(defvar *algebra-factors-found* nil "the factors of elements that were met, by their terms")

(defstruct (algebra-branch (:conc-name algebra-branch-))
  basis           ; elements without z
  inverse         ; those with z
  product         ; what does not vanish
  new)            ; polynomials that vanish as well

(defun $algebra_components (polynomials names apart)
  "[[[[e, ..], dimension], ..], taken]: components where POLYNOMIALS vanish and none of APART does,
and the parameters that were taken as not zero; the dimension is false where no basis was found.
false where there are roots or functions of NAMES, a sentence where there is too much."
  (algebra-with-polynomials `((mlist) ,@(cdr polynomials) ,@(cdr apart)) names
    (lambda (terms numbers kernels)
      (declare (ignore numbers))
      (let* ((*algebra-taken* nil)
             (*algebra-degree-order* 'first)
             (*algebra-factors-found* (make-hash-table :test #'equal))
             (of-apart (length (cdr apart)))
             (components (algebra-components-of (butlast terms of-apart) (last terms of-apart)
                                                kernels)))
        (flet ((expressions (basis)
                 (cons '(mlist simp) (loop for p in basis collect (algebra-expression-of p kernels)))))
          (list '(mlist simp)
                (cons '(mlist simp)
                      (loop for (basis . dimension) in components
                            collect (list '(mlist simp) (expressions (algebra-without-z basis))
                                          dimension)))
                (cons '(mlist simp) (mapcar #'algebra-general *algebra-taken*))))))))

(defun algebra-components-of (polynomials apart kernels)
  "A list of (basis . dimension)."
  (let ((waiting (list (algebra-first-branch polynomials apart (length kernels))))
        (count 0)
        (components '()))
    (loop while waiting
          do (let* ((branch (algebra-with-basis (pop waiting)))
                    (parts (algebra-branch-parts branch kernels)))
               (when (> (incf count) (core-sized *algebra-most-components*))
                 (throw 'algebra-too-large 'too-large))
               (cond ((algebra-everywhere-nonzero-p (algebra-branch-basis branch)))
                     (parts (setq waiting (append parts waiting)))
                     (t (push (cons (algebra-ideal-generators (algebra-branch-basis branch))
                                    (algebra-dimension (algebra-branch-basis branch)))
                              components)))))
    (nreverse components)))

(defun algebra-first-branch (polynomials apart count)
  (let ((one (list (cons (make-list (1+ count) :initial-element 0) 1))))
    (make-algebra-branch :new (mapcar #'algebra-with-z polynomials)
                         :product (reduce #'algebra-terms-product (mapcar #'algebra-with-z apart)
                                          :initial-value one))))

(defun algebra-with-z (terms)
  (loop for (exponents . a) in terms collect (cons (cons 0 exponents) a)))

(defun algebra-without-z (basis)
  (loop for p in basis collect (loop for (exponents . a) in p collect (cons (cdr exponents) a))))

(defun algebra-free-of-z-p (p) (zerop (first (algebra-lead p))))

(defun algebra-with-basis (branch)
  "The BRANCH with the basis of what is new in it."
  (let* ((inverse (or (algebra-branch-inverse branch)
                      (list (algebra-inverse-equation (algebra-branch-product branch)))))
         (new (algebra-sorted-polynomials (algebra-branch-new branch)))
         (known (append (algebra-branch-basis branch) (algebra-branch-inverse branch)))
         (basis (algebra-basis-of (if (algebra-branch-inverse branch) new (append new inverse))
                                  known)))
    (make-algebra-branch :basis (remove-if-not #'algebra-free-of-z-p basis)
                         :inverse (remove-if #'algebra-free-of-z-p basis)
                         :product (algebra-branch-product branch))))

(defun algebra-inverse-equation (product)
  "z*PRODUCT - 1"
  (append (loop for (exponents . a) in product collect (cons (cons 1 (cdr exponents)) a))
          (list (cons (make-list (length (algebra-lead product)) :initial-element 0) -1))))

(defun algebra-everywhere-nonzero-p (basis)
  (some (lambda (p) (every #'zerop (algebra-lead p))) basis))

(defun algebra-branch-parts (branch kernels)
  "Branches by the factors of the least element that has several; nil where none has."
  (let* ((basis (algebra-branch-basis branch))
         (product (algebra-branch-product branch))
         (factors (loop for p in (reverse basis) thereis (algebra-element-factors p kernels))))
    (loop for factor in factors
          for first = t then nil
          while product
          collect (make-algebra-branch :basis basis
                                       :inverse (and first (algebra-branch-inverse branch))
                                       :product product
                                       :new (list factor))
          do (setq product (values (algebra-divided-rest (algebra-terms-product product factor)
                                                         basis))))))

;;; Generators: elements of a basis that follow from lower ones are left out, as far as pairs up to
;;; their degrees show.

(defun algebra-ideal-generators (basis)
  (let* ((waiting (sort (copy-list basis)
                        (lambda (p q) (algebra-greater-degree-p (algebra-lead q)
                                                                (algebra-lead p)))))
         (generators '())
         (of-generators '()))
    (dolist (p waiting (nreverse generators))
      (when (algebra-divided-rest p of-generators)
        (push p generators)
        (setq of-generators (algebra-basis-of (list p) of-generators
                                              (reduce #'+ (algebra-lead
                                                           (car (last waiting))))))))))

;;; Factors

(defun algebra-element-factors (p kernels)
  "The different factors of P with unknowns in them; nil where P is one of them."
  (multiple-value-bind (found known) (gethash p *algebra-factors-found*)
    (if known
        found
        (setf (gethash p *algebra-factors-found*)
              (and (<= (length p) *algebra-most-factored*)
                   (algebra-new-element-factors p kernels))))))

(defun algebra-new-element-factors (p kernels)
  (let ((factors (loop for (factor nil) on (pfactor (algebra-polynomial-of-terms p kernels))
                       by #'cddr
                       for terms = (algebra-factor-terms factor kernels)
                       unless (algebra-everywhere-nonzero-p (list terms)) collect terms)))
    (if (and (null (cdr factors))
             (equal (algebra-lead (car factors)) (algebra-lead p)))
        nil
        (algebra-sorted-polynomials factors))))

(defun algebra-polynomial-of-terms (p kernels)
  "P, free of z, as a polynomial of Maxima."
  (let ((sum 0))
    (loop for ((nil . exponents) . a) in p
          do (let ((term a))
               (loop for exponent in exponents
                     for kernel in kernels
                     unless (zerop exponent)
                       do (setq term (ptimes term (list (algebra-kernel-variable kernel)
                                                        exponent 1))))
               (setq sum (pplus sum term))))
    sum))

(defun algebra-factor-terms (factor kernels)
  (sort (algebra-with-z (algebra-monomial-terms factor (mapcar #'algebra-kernel-variable kernels)))
        #'algebra-greater-monomial-p :key #'car))

(defun algebra-terms-product (p q)
  (let ((sum nil))
    (loop for (shift . a) in q
          do (setq sum (algebra-combined 1 sum a shift p)))
    sum))

;;; Dimension: the most unknowns of which no first term is made.

(defun algebra-dimension (basis)
  (let ((supports (loop for p in basis
                        collect (loop for exponent in (cdr (algebra-lead p))
                                      for k from 0
                                      unless (zerop exponent) sum (ash 1 k))))
        (n (length (cdr (algebra-lead (first basis))))))
    (loop for unknowns below (ash 1 n)
          unless (some (lambda (support) (zerop (logandc2 support unknowns))) supports)
            maximize (logcount unknowns))))
