;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Roots as kernels: kernel^n = radicand.  Radicands are normal, freed of squares,
;;; sqrt(f^2*g) = |f|*sqrt(g), and |f| is f or -f where the facts tell its sign, else a kernel
;;; with |f|^2 = f^2.  For the zero test known positive factors are taken apart,
;;; sqrt(x*y) = sqrt(x)*sqrt(y), and sqrt(x/y) = sqrt(x*y)/|y|.  SCAN makes skeletons of radicands.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/nouns" "algebra/constant_sign"
                "algebra/factoring" "algebra/memory"))

(defvar *algebra-roots-apart* nil "true: roots of products become products of roots where allowed")
(defvar *algebra-sign-judge* nil "the sign of what is no number, by the facts; set by facts.lisp")

(defun algebra-root (base degree scan)
  "The skeleton of base^(1/degree)."
  (cond ((not (integerp base))
         (if (symbolp base)
             (algebra-root-kernel base degree scan)
             (algebra-root-of-factors (algebra-root-plan base degree) degree scan)))
        ((plusp base) (cons '* (algebra-prime-roots base degree scan)))
        ((and (= degree 2) (< base -1))
         (list '* (algebra-root-kernel -1 2 scan) (algebra-root (- base) 2 scan)))
        (t (algebra-root-kernel base degree scan))))

(defun algebra-prime-roots (n degree scan)
  "sqrt(6) is sqrt(2)*sqrt(3)."
  (cons 1 (loop for (prime power) on (algebra-prime-factors n) by #'cddr
                collect (multiple-value-bind (whole rest) (floor power degree)
                          (if (zerop rest)
                              (expt prime whole)
                              (list '^ (algebra-root-kernel prime degree scan) power))))))

;;; A radicand as a list of (factor . power), powers negative below the line.

(defun algebra-radicand-factors (base)
  (let* ((normal (algebra-argument-form base))
         (factored (algebra-take-factors normal)))
    (algebra-factor-list factored)))

(defun algebra-take-factors (e)
  "All factors for the zero test, else the squares only."
  (cond ((atom e) e)
        ((and *algebra-roots-apart* (< (algebra-size e) 400))
         (algebra-in-factors e 400))
        ((< (algebra-size e) 2000) (or (algebra-quietly (lambda () ($sqfr e))) e))
        (t e)))

(defun algebra-factor-list (e)
  (loop for factor in (if (mtimesp e) (cdr e) (list e))
        append (let ((number (algebra-rational-number factor)))
                 (cond (number (list (cons (numerator number) 1) (cons (denominator number) -1)))
                       ((and (mexptp factor) (integerp (caddr factor)))
                        (list (cons (cadr factor) (caddr factor))))
                       (t (list (cons factor 1)))))))

(defun algebra-root-of-factors (plan degree scan)
  "The skeleton by PLAN, of algebra-root-plan."
  (destructuring-bind (numbers outside apart inside expression) plan
    (list* '* (if (integerp inside)
                  (algebra-root inside degree scan)
                  (algebra-written-root expression inside degree scan))
           (append (loop for (f . power) in apart
                         collect (list '^ (algebra-root-kernel f degree scan) power))
                   (loop for (f . power) in outside
                         collect (list '^ (algebra-absolute f scan) power))
                   (loop for (f . power) in numbers
                         collect (list '^ (algebra-root f degree scan) power))))))

(defun algebra-new-root-plan (base degree)
  "(numbers outside apart inside expression): factors (f . power) of the root of BASE that are roots
of numbers, whole powers, roots of their own; the rest under one root, and that root."
  (let ((numbers nil) (outside nil) (apart nil) (inside 1))
    (loop for (f . power) in (algebra-radicand-factors base)
          for sign = (algebra-known-sign f)
          do (cond ((and (integerp f) (plusp f)) (push (cons f power) numbers))
                   ((or (= degree 2) (member sign '($pos $pz)))
                    (multiple-value-bind (whole rest) (algebra-whole-powers power degree)
                      (unless (zerop whole) (push (cons f whole) outside))
                      (cond ((zerop rest))
                            ((and *algebra-roots-apart* (member sign '($pos $pz)))
                             (push (cons f rest) apart))
                            (t (setq inside (mul inside (power f rest)))))))
                   (t (setq inside (mul inside (power f power))))))
    (unless (integerp inside) (setq inside (algebra-argument-form inside)))
    (list numbers outside apart inside
          (and (not (integerp inside)) (power inside (list '(rat simp) 1 degree))))))

(defvar *algebra-root-plans* (make-algebra-memory)
  "Plans: the same roots come again and again in the conditions of a system.")

(defun algebra-root-plan (base degree)
  (algebra-remembered *algebra-root-plans*
                      (list* degree *algebra-roots-apart* base)
                      (lambda () (algebra-new-root-plan base degree))))

(defun algebra-whole-powers (power degree)
  "In the zero test nothing stays below the line of a radicand."
  (if *algebra-roots-apart*
      (floor power degree)
      (truncate power degree)))

(defun algebra-known-sign (e)
  (if ($constantp e)
      (case (algebra-constant-verdict e) (1 '$pos) (-1 '$neg) (0 '$zero) (t '$unknown))
      (algebra-quietly (lambda ()
                         (core-require "algebra/known_signs")
                         (funcall *algebra-sign-judge* e)))))

(defun algebra-absolute (e scan)
  "The skeleton of |e|."
  (case (algebra-known-sign e)
    (($pos $pz) (funcall scan e))
    (($neg $nz) (list '* -1 (funcall scan e)))
    (t (let ((expression (simplify (list '(mabs) (algebra-argument-form e)))))
         (if (and (consp expression) (eq (caar expression) 'mabs))
             (algebra-absolute-kernel expression scan)
             (algebra-absolute-product expression scan))))))

(defun algebra-absolute-product (e scan)
  "Products and quotients of absolute values that Maxima took apart."
  (cond ((and (consp e) (eq (caar e) 'mabs)) (algebra-absolute-kernel e scan))
        ((mtimesp e)
         (cons '* (mapcar (lambda (part) (algebra-absolute-product part scan)) (cdr e))))
        ((and (mexptp e) (integerp (caddr e)))
         (list '^ (algebra-absolute-product (cadr e) scan) (caddr e)))
        (t (funcall scan e))))

(defun algebra-absolute-kernel (expression scan)
  (algebra-find-or-make-root expression 2 (lambda () (list '^ (funcall scan (cadr expression)) 2))))

(defun algebra-root-kernel (radicand degree scan)
  (algebra-written-root (power radicand (list '(rat simp) 1 degree)) radicand degree scan))

(defun algebra-written-root (root radicand degree scan)
  "The kernel of ROOT of RADICAND, or the skeleton of a root that Maxima takes apart, sqrt(x*y)
where x is positive: it must not stand beside sqrt(x) as something of its own."
  (if (mtimesp root)
      (funcall scan root)
      (algebra-find-or-make-root root degree (lambda () (funcall scan radicand)))))

(defun algebra-find-or-make-root (expression degree radicand)
  (or (algebra-find-opaque expression)
      (let* ((skeleton (funcall radicand))
             (kernel (algebra-new-kernel expression 5 nil)))
        (setf (algebra-kernel-degree kernel) degree
              (algebra-kernel-radicand kernel) skeleton
              (algebra-kernel-depth kernel) (1+ (algebra-root-depth skeleton)))
        (push (cons expression kernel) (algebra-ring-opaque *algebra-ring*))
        kernel)))

(defun algebra-root-depth (skeleton)
  (cond ((algebra-kernel-p skeleton) (algebra-kernel-depth skeleton))
        ((consp skeleton)
         (loop for part on (cdr skeleton)
               while (consp part)
               maximize (algebra-root-depth (car part))))
        (t 0)))
