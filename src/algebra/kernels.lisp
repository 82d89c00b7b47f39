;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The kernels in which expressions are polynomials: symbols, opaque functions, nouns, roots,
;;; exponentials exp(u) and, for each angle u, the pair c = cos(u), s = sin(u), bound by
;;; s^2 + c^2 = 1 (hyperbolic: c^2 - s^2 = 1).  Angles are sums of rational multiples of units, so
;;; that sin(a+b), 2*theta and theta/2 are polynomials in the pairs of a, b, theta/2.  Of angles
;;; 30*t, 60*t alone the pair is that of 30*t: evaluate.lisp.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/nouns"))

(defstruct (algebra-kernel (:conc-name algebra-kernel-))
  variable        ; the polynomials' own symbol
  expression      ; what it stands for
  class           ; its place in the order of variables, see algebra-kernel-before
  sure            ; true if it is algebraically independent of all the others
  (depth 0)       ; roots under roots
  degree          ; a root satisfies kernel^degree = radicand
  radicand)       ; skeleton, later a quotient

(defstruct (algebra-unit (:conc-name algebra-unit-))
  base            ; the base angle or exponent
  kind            ; circular, hyperbolic, or the base of a power
  (denominator 1) ; rational: multiples of base/denominator occur
  (terms nil)     ; the (factor . unit) that were met
  (apart nil)     ; (factor . unit): multiples that have a unit of their own
  cosine          ; its kernels
  sine)           ; an exponential has only one, in cosine

(defstruct (algebra-ring (:conc-name algebra-ring-))
  (symbols (make-hash-table :test #'eq))
  (opaque nil)
  (units nil)
  (kernels nil))

(defvar *algebra-ring* nil "the kernels of the expressions at hand")

(defmacro with-algebra-ring (&body body)
  `(let ((*algebra-ring* (make-algebra-ring))
         (varlist nil) (genvar nil) (modulus nil)
         ($ratfac nil) ($algebraic nil) ($keepfloat nil) ($ratprint nil) ($ratexpand nil)
         ($gcd '$spmod) ($ratwtlvl nil) ($ratvars '((mlist simp))))
     (declare (special varlist genvar modulus $ratfac $algebraic $keepfloat $ratprint $ratexpand
                       $gcd $ratwtlvl $ratvars))
     ,@body))

(defun algebra-new-kernel (expression class sure)
  (let ((kernel (make-algebra-kernel :variable (gensym) :expression expression :class class
                                     :sure sure)))
    (push kernel (algebra-ring-kernels *algebra-ring*))
    kernel))

(defun algebra-find-opaque (expression)
  (cdr (assoc expression (algebra-ring-opaque *algebra-ring*) :test #'alike1)))

(defun algebra-find-unit (base kind)
  (or (find-if (lambda (unit)
                 (and (alike1 base (algebra-unit-base unit))
                      (alike1 kind (algebra-unit-kind unit))))
               (algebra-ring-units *algebra-ring*))
      (let ((unit (make-algebra-unit :base base :kind kind)))
        (push unit (algebra-ring-units *algebra-ring*))
        unit)))

(defun algebra-variable (kernel)
  (list (algebra-kernel-variable kernel) 1 1))

(defun algebra-pair-p (unit)
  (member (algebra-unit-kind unit) '(circular hyperbolic)))

(defun algebra-over (numerator denominator)
  "The skeleton of a quotient of skeletons."
  (list '* numerator (list '^ denominator -1)))

;;; Order of variables, low to high: pairs of angles, exponentials, symbols, functions,
;;; derivatives, roots.  Relations then reduce leaf by leaf.

(defun algebra-kernel-before (a b)
  (let ((class-a (algebra-kernel-class a))
        (class-b (algebra-kernel-class b))
        (depth-a (algebra-kernel-depth a))
        (depth-b (algebra-kernel-depth b)))
    (cond ((/= class-a class-b) (< class-a class-b))
          ((/= depth-a depth-b) (< depth-a depth-b))
          (t (great (algebra-kernel-expression b) (algebra-kernel-expression a))))))

(defun algebra-number-kernels ()
  "Make the kernels of the units, then give every kernel its place."
  (mapc #'algebra-unit-kernels (algebra-ring-units *algebra-ring*))
  (setf (algebra-ring-kernels *algebra-ring*)
        (stable-sort (algebra-ring-kernels *algebra-ring*) #'algebra-kernel-before))
  (loop for kernel in (algebra-ring-kernels *algebra-ring*)
        for variable = (algebra-kernel-variable kernel)
        for place from 1
        do (setf (symbol-value variable) place)
           (putprop variable (algebra-kernel-expression kernel) 'disrep)
        collect variable into variables
        collect (algebra-kernel-expression kernel) into expressions
        finally (setq genvar variables varlist expressions)))

(defun algebra-unit-kernels (unit)
  (let ((step (div (mul (algebra-unit-base unit) (denominator (algebra-unit-denominator unit)))
                   (numerator (algebra-unit-denominator unit))))
        (kind (algebra-unit-kind unit))
        (sure (algebra-independent-p (algebra-unit-base unit))))
    (flet ((kernel (expression class sure)
             (or (algebra-find-opaque expression)
                 (algebra-new-kernel expression class sure))))
      (case kind
        (circular
         (setf (algebra-unit-cosine unit) (kernel (list '(%cos simp) step) 0 sure)
               (algebra-unit-sine unit) (kernel (list '(%sin simp) step) 0 sure)))
        (hyperbolic
         (setf (algebra-unit-cosine unit) (kernel (list '(%cosh simp) step) 0 sure)
               (algebra-unit-sine unit) (kernel (list '(%sinh simp) step) 0 sure)))
        (t (setf (algebra-unit-cosine unit)
                 (kernel (power kind step) 1 (and sure (eq kind '$%e)))))))))

;;; Independence: what makes a remainder that is not zero a proof.

(defun algebra-independent-p (base)
  "A product of symbols and open functions: sums of such terms are independent over the rationals."
  (cond ((symbolp base) (not ($constantp base)))
        ((atom base) nil)
        ((mtimesp base) (and (not (algebra-rational-number (cadr base)))
                             (every #'algebra-independent-factor-p (cdr base))
                             (notevery #'$constantp (cdr base))))
        (t (and (algebra-independent-factor-p base) (not ($constantp base))))))

(defun algebra-independent-factor-p (factor)
  (cond ((atom factor) t)
        ((mexptp factor) (and (integerp (caddr factor))
                              (algebra-independent-factor-p (cadr factor))))
        ((member (caar factor) '(mplus mtimes)) nil)
        (t (and (algebra-independent-noun-p factor)
                (every #'algebra-transparent-p (cdr factor))))))

;;; Opaque kernels: open functions f(u), derivatives, integrals, as nouns.lisp writes them.  One
;;; that may be bound to another one is no proof: both are unsure.

(defun algebra-opaque-kernel (e)
  (let ((canonical (algebra-canonical-noun e)))
    (or (algebra-find-opaque canonical)
        (let ((kernel (algebra-new-kernel canonical (if (eq (caar e) '%derivative) 4 3)
                                          (algebra-independent-noun-p canonical))))
          (algebra-mark-bound kernel)
          (push (cons canonical kernel) (algebra-ring-opaque *algebra-ring*))
          kernel))))

(defun algebra-mark-bound (kernel)
  (loop for (expression . other) in (algebra-ring-opaque *algebra-ring*)
        do (when (and (algebra-kernel-sure other)
                      (algebra-bound-nouns-p (algebra-kernel-expression kernel) expression))
             (setf (algebra-kernel-sure kernel) nil
                   (algebra-kernel-sure other) nil))))
