;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials in unknowns, parameters in general position: the set where all of them vanish, taken
;;; apart into components.  Of a Groebner basis by degrees the least element with several factors
;;; is taken: there the first factor vanishes, or the second and not the first, and so on (the
;;; algorithm of Buchberger with factors: Czapor; Graebe).  What does not vanish has an inverse, one
;;; variable z with 1 - z*product = 0 that stays in the basis and is greater than all, so that the
;;; elements without z are the ideal of the closure of the component: all of it solves the
;;; equations.  Where a basis would cost too much the equations are left as they are.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common_roots" "algebra/general_form" "algebra/groebner"
                "algebra/kernels" "algebra/size" "core/watch"))

(defparameter *algebra-most-components* 400 "how many branches are looked at")
(defparameter *algebra-most-factored* 60 "terms of an element up to which it is factored")

(defvar *algebra-whole-work* 0 "how many coefficients may be formed in all")
(defvar *algebra-splits-p* nil "whether sets without a basis are split at what was found of it")
(defvar *algebra-basis-shares* '(1) "of the work: what one basis may take, at first and at last")
(defparameter *algebra-basis-time* 1/12 "of the time left, for one basis, 15 s at most")
(defparameter *algebra-components-time* 1/2 "of the time left, for all components")

(defvar *algebra-factors-found* nil "the factors of elements that were met, by their terms")

(defstruct (algebra-branch (:conc-name algebra-branch-))
  elements        ; a basis, z in some
  product         ; what does not vanish
  new             ; polynomials that vanish as well
  split)          ; at which it was split before their basis was known

(defun $algebra_components (polynomials names apart work &optional split)
  "[[[[e, ..], dimension], ..], taken]: components where POLYNOMIALS vanish and none of APART does,
and the parameters that were taken as not zero; the dimension is false where no basis was found
within the WORK, a count of coefficients; with SPLIT such sets are split at what was found of it.
false where there are roots or functions of NAMES, a
sentence where there is too much."
  (algebra-with-polynomials `((mlist) ,@(cdr polynomials) ,@(cdr apart)) names
    (lambda (terms numbers given-kernels)
      (declare (ignore numbers))
      (let* ((order (algebra-order-by-degrees terms (length given-kernels)))
             (kernels (algebra-in-order given-kernels order))
             (*algebra-taken* nil)
             (*algebra-degree-order* 'first)
             (*algebra-work-left* (core-sized work))
             (*algebra-whole-work* *algebra-work-left*)
             (*algebra-splits-p* split)
             (*algebra-basis-shares* (if split '(1/4) '(1)))
             (*algebra-factors-found* (make-hash-table :test #'equal))
             (of-apart (length (cdr apart)))
             (ordered (algebra-terms-in-order terms order))
             (components (algebra-components-of (butlast ordered of-apart)
                                                (last ordered of-apart) kernels)))
        (flet ((expressions (basis)
                 (cons '(mlist simp)
                       (loop for p in basis collect (algebra-expression-of p kernels)))))
          (list '(mlist simp)
                (cons '(mlist simp)
                      (loop for (basis . dimension) in components
                            collect (list '(mlist simp) (expressions (algebra-without-z basis))
                                          dimension)))
                (cons '(mlist simp) (mapcar #'algebra-general *algebra-taken*))))))))

(defun algebra-order-by-degrees (polynomials n)
  "The places of N unknowns, low degrees first: the smallest, multipliers of squares among them."
  (flet ((degree (k)
           (reduce #'max (loop for p in polynomials
                               append (loop for (exponents . nil) in p collect (nth k exponents)))
                   :initial-value 0)))
    (stable-sort (loop for k below n collect k) #'< :key #'degree)))

(defun algebra-in-order (items places) (loop for k in places collect (nth k items)))

(defun algebra-terms-in-order (polynomials places)
  (loop for p in polynomials
        collect (loop for (exponents . a) in p
                      collect (cons (algebra-in-order exponents places) a))))

(defun algebra-components-of (polynomials apart kernels)
  "A list of (basis . dimension)."
  (let ((waiting (list (algebra-first-branch polynomials apart (length kernels))))
        (count 0)
        (components '())
        (seconds-kept (algebra-seconds-kept)))
    (loop while (and waiting (algebra-time-left-p seconds-kept))
          do (when (> (incf count) (core-sized *algebra-most-components*))
               (throw 'algebra-too-large 'too-large))
             (let ((branch (pop waiting)))
               (multiple-value-bind (grown factors) (algebra-grown-or-factors branch kernels)
                 (let* ((whole (or grown branch))
                        (parts (and factors (algebra-within-bounds
                                             1 (lambda () (algebra-branches-by factors whole)))))
                        (component (and grown (null factors)
                                        (algebra-component (algebra-branch-elements grown)
                                                           (length kernels)))))
                   (cond (parts (setq waiting (append parts waiting)))
                         (component (push component components))
                         ((or factors (null grown))
                          (push (algebra-without-dimension branch) components)))))))
    (mapcar #'cdr (algebra-not-contained
                   (append (reverse components) (mapcar #'algebra-without-dimension waiting))))))

(defun algebra-seconds-kept ()
  "Of the time left what is not for components; nil where there is no limit."
  (let ((left (core-seconds-left)))
    (and left (* left (- 1 *algebra-components-time*)))))

(defun algebra-time-left-p (seconds-kept)
  (or (null seconds-kept) (> (core-seconds-left) seconds-kept)))

(defun algebra-without-dimension (branch)
  "(basis generators . dimension) of a BRANCH of which no basis is known."
  (list nil (algebra-given-equations branch)))

(defun algebra-grown-or-factors (branch kernels)
  "The BRANCH with its basis, and factors in it.  Where that is too much: nil, and factors of what
was found of a basis."
  (loop for (share . more) on *algebra-basis-shares*
        for grown = (algebra-within-bounds share (lambda () (algebra-basis-of-branch branch)))
        for factors = (cond (grown (algebra-factors-in (algebra-branch-elements grown) kernels))
                            (*algebra-splits-p* (algebra-factors-so-far branch kernels)))
        unless grown do (algebra-expect-too-much)
        when (or grown factors (null more)) return (values grown factors)))

(defun algebra-expect-too-much ()
  "Where one basis was too much others will be: they get little work, and more where what was found
shows no factors."
  (when *algebra-splits-p* (setq *algebra-basis-shares* '(1/25 1/4))))

(defun algebra-within-bounds (share function)
  "What FUNCTION returns; nil where it needs more than this SHARE of the work, or of the time."
  (let* ((before *algebra-work-left*)
         (allowed (min before (floor (* share *algebra-whole-work*))))
         (answer (catch 'algebra-too-large
                   (setq *algebra-work-left* allowed)
                   (values (core-within-at-most 15 *algebra-basis-time* function)))))
    (setq *algebra-work-left* (max (floor *algebra-whole-work* 4)
                                   (- before (- allowed *algebra-work-left*))))
    (if (eq answer 'too-large) nil answer)))

(defun algebra-factors-so-far (branch kernels)
  "Of the shortest element that has several, of what was found of the basis of the BRANCH, which
was not split at it; it is noted."
  (let ((shortest (sort (set-difference (remove-if-not #'algebra-free-of-z-p
                                                       (coerce *algebra-growing-basis* 'list))
                                        (algebra-branch-split branch) :test #'equal)
                        #'< :key #'length)))
    (algebra-within-bounds
     1 (lambda () (loop for p in shortest
                        for factors = (algebra-element-factors p kernels)
                        when factors
                          do (push p (algebra-branch-split branch))
                             (return factors))))))

(defun algebra-not-contained (components)
  "(basis generators . dimension) of those that lie in no other of a higher dimension."
  (flet ((contained-p (a b)
           (and (cddr a) (cddr b) (< (cddr a) (cddr b))
                (algebra-within-bounds
                 1 (lambda () (notany (lambda (p) (algebra-divided-rest p (first a)))
                                      (second b)))))))
    (loop for a in components
          unless (some (lambda (b) (contained-p a b)) components) collect a)))

(defun algebra-given-equations (branch)
  (remove-if-not #'algebra-free-of-z-p
                 (append (algebra-branch-elements branch) (algebra-branch-new branch))))

(defun algebra-component (basis n)
  "(basis generators . dimension) of the closure; nil where it is empty."
  (let ((closure (remove-if-not #'algebra-free-of-z-p basis)))
    (unless (algebra-everywhere-nonzero-p closure)
      (list* closure
             (or (algebra-within-bounds 1 (lambda () (algebra-ideal-generators closure))) closure)
             (algebra-dimension closure n)))))

(defun algebra-first-branch (polynomials apart count)
  (let ((one (list (cons (make-list (1+ count) :initial-element 0) 1))))
    (algebra-with-product (make-algebra-branch
                           :new (algebra-sorted-polynomials (mapcar #'algebra-with-z polynomials)))
                          (reduce #'algebra-terms-product
                                  (algebra-sorted-polynomials (mapcar #'algebra-with-z apart))
                                  :initial-value one))))

(defun algebra-with-z (terms)
  (loop for (exponents . a) in terms collect (cons (cons 0 exponents) a)))

(defun algebra-without-z (basis)
  (loop for p in basis collect (loop for (exponents . a) in p collect (cons (cdr exponents) a))))

(defun algebra-free-of-z-p (p) (zerop (first (algebra-lead p))))

(defun algebra-basis-of-branch (branch)
  (let ((basis (algebra-basis-of (algebra-branch-new branch) (algebra-branch-elements branch))))
    (make-algebra-branch :elements basis :product (algebra-branch-product branch)
                         :split (algebra-branch-split branch))))

(defun algebra-factors-in (basis kernels)
  "Of the least element that has several."
  (loop for p in (reverse basis) thereis (algebra-element-factors p kernels)))

(defun algebra-inverse-equation (product)
  "z*PRODUCT - 1"
  (append (loop for (exponents . a) in product collect (cons (cons 1 (cdr exponents)) a))
          (list (cons (make-list (length (algebra-lead product)) :initial-element 0) -1))))

(defun algebra-everywhere-nonzero-p (basis)
  (some (lambda (p) (every #'zerop (algebra-lead p))) basis))

(defun algebra-branches-by (factors branch)
  "Where the first of the FACTORS vanishes, the second and not the first, and so on."
  (let ((product (algebra-branch-product branch)))
    (loop for factor in factors
          for part = (copy-algebra-branch branch)
          while product
          do (push factor (algebra-branch-new part))
          collect (if (eq product (algebra-branch-product branch))
                      part
                      (algebra-with-product part product))
          do (setq product (values (algebra-divided-rest
                                    (algebra-terms-product product factor)
                                    (algebra-branch-elements branch)))))))

(defun algebra-with-product (branch product)
  "The BRANCH where the PRODUCT does not vanish: elements with z go."
  (flet ((without-z (polynomials) (remove-if-not #'algebra-free-of-z-p polynomials)))
    (make-algebra-branch :elements (without-z (algebra-branch-elements branch))
                         :product product
                         :split (algebra-branch-split branch)
                         :new (append (without-z (algebra-branch-new branch))
                                      (list (algebra-inverse-equation product))))))

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
              (and (algebra-free-of-z-p p)
                   (<= (length p) *algebra-most-factored*)
                   (algebra-new-element-factors p kernels))))))

(defun algebra-new-element-factors (p kernels)
  (let ((factors (loop for factor in (algebra-polynomial-factors
                                      (algebra-polynomial-of-terms p kernels))
                       for terms = (algebra-factor-terms factor kernels)
                       unless (algebra-everywhere-nonzero-p (list terms)) collect terms)))
    (if (or (null factors)
            (and (null (cdr factors))
                 (equal (algebra-lead (car factors)) (algebra-lead p))))
        nil
        (algebra-sorted-polynomials (reverse factors)))))

(defun algebra-polynomial-factors (p)
  "Those of Maxima's pfactor, which ends in errors (5.46) for some P with parameters; nil there, and
unless they make P."
  (let* ((found (algebra-quietly (lambda () (pfactor p))))
         (product 1))
    (loop for (factor power) on found by #'cddr
          do (setq product (ptimes product (pexpt factor power))))
    (and (equal product p)
         (loop for (factor nil) on found by #'cddr collect factor))))

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

(defun algebra-dimension (basis n)
  (let ((supports (loop for p in basis
                        collect (loop for exponent in (cdr (algebra-lead p))
                                      for k from 0
                                      unless (zerop exponent) sum (ash 1 k)))))
    (loop for unknowns below (ash 1 n)
          unless (some (lambda (support) (zerop (logandc2 support unknowns))) supports)
            maximize (logcount unknowns))))
