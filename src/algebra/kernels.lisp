;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; A general expression as a quotient of polynomials in kernels.
;;; Kernels are symbols, opaque functions, nouns, roots, exponentials exp(u) and, for each angle u,
;;; the pair c = cos(u), s = sin(u), bound by s^2 + c^2 = 1 (hyperbolic: c^2 - s^2 = 1).
;;; Angles are sums of rational multiples of base angles: sin(a+b), 2*theta and theta/2 all become
;;; polynomials in the pairs of a, b, theta/2.  First the scan names the kernels of an expression,
;;; then they are put in order, then the expression is evaluated in Maxima's polynomials.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size"))

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
  (denominator 1) ; multiples of base/denominator occur
  cosine          ; its kernels
  sine)           ; an exponential has only one, in cosine

(defstruct (algebra-ring (:conc-name algebra-ring-))
  (symbols (make-hash-table :test #'eq))
  (opaque nil)
  (units nil)
  (kernels nil))

(defvar *algebra-ring* nil "the kernels of the expressions at hand")
(defvar *algebra-exponential-form* nil "true: sinh and cosh become exponentials")
(defvar *algebra-roots-apart* nil "true: roots of products become products of roots where allowed")

(defmacro with-algebra-ring (&body body)
  `(let ((*algebra-ring* (make-algebra-ring))
         (varlist nil) (genvar nil) (modulus nil)
         ($ratfac nil) ($algebraic nil) ($keepfloat nil) ($ratprint nil) ($ratexpand nil)
         ($gcd '$spmod) ($ratwtlvl nil) ($ratvars '((mlist simp))))
     (declare (special varlist genvar modulus $ratfac $algebraic $keepfloat $ratprint $ratexpand
                       $gcd $ratwtlvl $ratvars))
     ,@body))

;;; The scan: an expression becomes a skeleton of numbers, kernels, (+ ..), (* ..), (^ base n),
;;; (cosine terms), (sine terms), (power terms), terms being a list of (rational . unit).

(defun algebra-scan (e)
  (cond ((symbolp e) (algebra-scan-symbol e))
        ((numberp e) (algebra-rational-number e))
        ((atom e) (algebra-outside e))
        (t (case (caar e)
             (rat (/ (cadr e) (caddr e)))
             (bigfloat (let ((ratio ($rationalize e))) (algebra-scan ratio)))
             (mplus (cons '+ (mapcar #'algebra-scan (cdr e))))
             (mtimes (cons '* (mapcar #'algebra-scan (cdr e))))
             (mminus (list '* -1 (algebra-scan (cadr e))))
             (mquotient (list '* (algebra-scan (cadr e)) (list '^ (algebra-scan (caddr e)) -1)))
             (mexpt (algebra-scan-power (cadr e) (caddr e)))
             (%sqrt (algebra-scan-power (cadr e) '((rat simp) 1 2)))
             (mrat (algebra-scan (ratdisrep e)))
             ((mlist $matrix $set mequal mnotequal mgreaterp mlessp mgeqp mleqp mand mor mnot msetq
               mdefine mcond mprog mprogn)
              (algebra-outside e))
             (mabs (algebra-absolute (cadr e)))
             (t (algebra-scan-function e))))))

(defun algebra-outside (e)
  (core-error "a formula was expected, found ~A" (algebra-short-text e)))

(defun algebra-least (items measure)
  (let ((least (car items)) (smallest (funcall measure (car items))))
    (dolist (item (cdr items) least)
      (let ((size (funcall measure item)))
        (when (< size smallest) (setq least item smallest size))))))

(defun algebra-short-text (e)
  (let ((text (coerce (mstring e) 'string)))
    (if (> (length text) 60)
        (concatenate 'string (subseq text 0 57) "...")
        text)))

(defun algebra-scan-symbol (e)
  (case e
    ($%i (algebra-root -1 2))
    ($%e (algebra-scan-power '$%e 1))
    ($%phi (list '* 1/2 (list '+ 1 (algebra-root 5 2))))
    (($inf $minf $infinity $und $ind nil t) (algebra-outside e))
    (t (or (gethash e (algebra-ring-symbols *algebra-ring*))
           (setf (gethash e (algebra-ring-symbols *algebra-ring*))
                 (algebra-new-kernel e 2 (not ($constantp e))))))))

(defun algebra-new-kernel (expression class sure)
  (let ((kernel (make-algebra-kernel :variable (gensym) :expression expression :class class
                                     :sure sure)))
    (push kernel (algebra-ring-kernels *algebra-ring*))
    kernel))

(defun algebra-scan-function (e)
  (case (caar e)
    (%sin (algebra-scan-sine (cadr e) 'circular))
    (%cos (algebra-scan-cosine (cadr e) 'circular))
    (%tan (algebra-over (algebra-scan-sine (cadr e) 'circular)
                        (algebra-scan-cosine (cadr e) 'circular)))
    (%cot (algebra-over (algebra-scan-cosine (cadr e) 'circular)
                        (algebra-scan-sine (cadr e) 'circular)))
    (%sec (algebra-over 1 (algebra-scan-cosine (cadr e) 'circular)))
    (%csc (algebra-over 1 (algebra-scan-sine (cadr e) 'circular)))
    (%sinh (algebra-scan-hyperbolic-sine (cadr e)))
    (%cosh (algebra-scan-hyperbolic-cosine (cadr e)))
    (%tanh (algebra-over (algebra-scan-hyperbolic-sine (cadr e))
                         (algebra-scan-hyperbolic-cosine (cadr e))))
    (%coth (algebra-over (algebra-scan-hyperbolic-cosine (cadr e))
                         (algebra-scan-hyperbolic-sine (cadr e))))
    (%sech (algebra-over 1 (algebra-scan-hyperbolic-cosine (cadr e))))
    (%csch (algebra-over 1 (algebra-scan-hyperbolic-sine (cadr e))))
    (t (algebra-scan-opaque e))))

(defun algebra-over (numerator denominator)
  (list '* numerator (list '^ denominator -1)))

(defun algebra-scan-hyperbolic-sine (u)
  (if *algebra-exponential-form*
      (algebra-half-sum u -1)
      (algebra-scan-sine u 'hyperbolic)))

(defun algebra-scan-hyperbolic-cosine (u)
  (if *algebra-exponential-form*
      (algebra-half-sum u 1)
      (algebra-scan-cosine u 'hyperbolic)))

(defun algebra-half-sum (u sign)
  "(exp(u) + sign*exp(-u))/2"
  (let ((growing (algebra-scan-power '$%e u)))
    (list '* 1/2 (list '+ growing (list '* sign (list '^ growing -1))))))

;;; Angles and exponents: sums of rational multiples of units.

(defun algebra-scan-sine (angle kind)
  (if (eql angle 0) 0 (list 'sine (algebra-terms angle kind))))

(defun algebra-scan-cosine (angle kind)
  (if (eql angle 0) 1 (list 'cosine (algebra-terms angle kind))))

(defun algebra-terms (angle kind)
  (let ((sum (if (symbolp angle) angle ($expand (algebra-normal-form angle)))))
    (loop for term in (if (mplusp sum) (cdr sum) (list sum))
          collect (algebra-term term kind))))

(defun algebra-term (term kind)
  (or (and (eq kind 'circular) (algebra-known-angle term))
      (multiple-value-bind (factor base) (algebra-numeric-factor term)
        (let ((unit (algebra-find-unit base kind)))
          (setf (algebra-unit-denominator unit)
                (lcm (algebra-unit-denominator unit) (denominator factor)))
          (cons factor unit)))))

(defun algebra-known-angle (term)
  "(known cosine sine) for multiples of %pi whose sines Maxima knows by roots."
  (when (and (not (symbolp term)) (among '$%pi term) ($constantp term))
    (let ((cosine (simplify (list '(%cos) term)))
          (sine (simplify (list '(%sin) term))))
      (unless (or (among '$%pi cosine) (among '$%pi sine))
        (list 'known (algebra-scan cosine) (algebra-scan sine))))))

(defun algebra-numeric-factor (term)
  "The number and the base of an angle; large multiples stay angles of their own."
  (let* ((product (mtimesp term))
         (number (algebra-rational-number (if product (cadr term) term))))
    (cond ((or (null number) (> (abs (numerator number)) 60)) (values 1 term))
          ((not product) (values number 1))
          ((cdddr term) (values number (cons '(mtimes simp) (cddr term))))
          (t (values number (caddr term))))))

(defun algebra-rational-number (e)
  (cond ((rationalp e) e)
        ((ratnump e) (/ (cadr e) (caddr e)))
        ((floatp e) (let (($ratprint nil) (ratio (maxima-rationalize e)))
                      (/ (car ratio) (cdr ratio))))))

(defun algebra-find-unit (base kind)
  (or (find-if (lambda (unit)
                 (and (alike1 base (algebra-unit-base unit)) (alike1 kind (algebra-unit-kind unit))))
               (algebra-ring-units *algebra-ring*))
      (let ((unit (make-algebra-unit :base base :kind kind)))
        (push unit (algebra-ring-units *algebra-ring*))
        unit)))

;;; Powers.

(defun algebra-scan-power (base exponent)
  (let ((number (algebra-rational-number exponent)))
    (cond ((eq base '$%e) (list 'power (algebra-terms exponent '$%e)))
          ((integerp number) (list '^ (algebra-scan base) number))
          (number (list '^ (algebra-root base (denominator number)) (numerator number)))
          (t (list 'power (algebra-terms exponent (algebra-normal-form base)))))))

;;; Opaque kernels: functions without a law here, derivatives, integrals.

(defun algebra-scan-opaque (e)
  (let ((canonical (algebra-canonical-noun e)))
    (or (algebra-find-opaque canonical)
        (let ((kernel (algebra-new-kernel canonical (if (eq (caar e) '%derivative) 4 3)
                                          (algebra-open-p e))))
          (push (cons canonical kernel) (algebra-ring-opaque *algebra-ring*))
          kernel))))

(defun algebra-find-opaque (expression)
  (cdr (assoc expression (algebra-ring-opaque *algebra-ring*) :test #'alike1)))

(defun algebra-open-p (e)
  "An open function or noun: nothing is known that could bind it to other kernels."
  (let ((operator (caar e)))
    (or (member operator '(%derivative %integrate %at mqapply))
        (member 'array (car e))
        (not (or (get operator 'operators) (get operator 'grad))))))

(defun algebra-canonical-noun (e)
  "E with normal arguments; an integral with its dummy variable renamed."
  (case (caar e)
    (%derivative e)
    ((%integrate %sum %product)
     (if (and (cdddr e) (symbolp (caddr e)))
         (algebra-rename-dummy e)
         e))
    (t (cons (car e) (mapcar #'algebra-normal-argument (cdr e))))))

(defun algebra-normal-argument (argument)
  (cond ((atom argument) argument)
        ((mbagp argument) (cons (car argument) (mapcar #'algebra-normal-argument (cdr argument))))
        ((member (caar argument) '(mequal lambda mgreaterp mgeqp mlessp mleqp mand mor mcond))
         argument)
        (t (algebra-normal-form argument))))

(defun algebra-rename-dummy (e)
  "The dummy variable becomes s, or s1, s2, .. where the rest of the noun has s."
  (destructuring-bind (integrand variable . limits) (cdr e)
    (let ((dummy (algebra-free-dummy variable (cons '(mlist) (cons integrand limits)))))
      (list* (car e)
             (algebra-normal-argument (maxima-substitute dummy variable integrand))
             dummy
             (mapcar #'algebra-normal-argument limits)))))

(defun algebra-free-dummy (variable e)
  (loop for name in '($s $s1 $s2 $s3 $s4 $s5)
        when (or (eq name variable) (not (among name e))) return name
        finally (return variable)))

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

(defun algebra-order-kernels ()
  "Make the kernels of the units, number all kernels, put the radicands into polynomials."
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
        finally (setq genvar variables varlist expressions))
  (dolist (kernel (algebra-ring-kernels *algebra-ring*))
    (when (algebra-kernel-degree kernel)
      (setf (algebra-kernel-radicand kernel)
            (algebra-evaluate (algebra-kernel-radicand kernel))))))

(defun algebra-unit-kernels (unit)
  (let ((step (div (algebra-unit-base unit) (algebra-unit-denominator unit)))
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
        (t (algebra-open-p factor))))

;;; Evaluation of a skeleton in Maxima's quotients (numerator . denominator).

(defun algebra-evaluate (skeleton)
  (cond ((rationalp skeleton) (cons (numerator skeleton) (denominator skeleton)))
        ((algebra-kernel-p skeleton) (cons (algebra-variable skeleton) 1))
        (t (ecase (car skeleton)
             (+ (algebra-sum (mapcar #'algebra-evaluate (cdr skeleton))))
             (* (algebra-product (mapcar #'algebra-evaluate (cdr skeleton))))
             (^ (algebra-power (algebra-evaluate (cadr skeleton)) (caddr skeleton)))
             (cosine (car (algebra-angle (cadr skeleton))))
             (sine (cdr (algebra-angle (cadr skeleton))))
             (power (algebra-exponential (cadr skeleton)))))))

(defun algebra-variable (kernel)
  (list (algebra-kernel-variable kernel) 1 1))

(defun algebra-sum (terms)
  "Halves are added to halves: intermediate sums stay short."
  (cond ((null terms) (cons 0 1))
        ((null (cdr terms)) (car terms))
        (t (let ((half (floor (length terms) 2)))
             (ratplus (algebra-sum (subseq terms 0 half)) (algebra-sum (nthcdr half terms)))))))

(defun algebra-product (factors)
  (let ((product (cons 1 1)))
    (dolist (factor factors product)
      (algebra-guard-product (car product) (car factor))
      (setq product (rattimes product factor t)))))

(defun algebra-power (base n)
  (when (and (minusp n) (algebra-vanishes-p (car base)))
    (core-error "division by zero"))
  (algebra-guard-power (car base) n)
  (algebra-guard-power (cdr base) n)
  (ratexpt base n))

(defun algebra-exponential (terms)
  (algebra-product
   (loop for (factor . unit) in terms
         collect (ratexpt (cons (algebra-variable (algebra-unit-cosine unit)) 1)
                          (* factor (algebra-unit-denominator unit))))))

(defun algebra-angle (terms)
  "The quotients (cosine . sine) of a sum of angles, by the theorem of addition."
  (let ((first (algebra-term-angle (car terms))))
    (if (null (cdr terms))
        first
        (algebra-add-angles first (algebra-angle (cdr terms)) (algebra-angle-sign (car terms))))))

(defun algebra-angle-sign (term)
  "cos(a+b) = cos(a)*cos(b) + sign*sin(a)*sin(b), hyperbolic or not."
  (if (and (not (eq (car term) 'known)) (eq (algebra-unit-kind (cdr term)) 'hyperbolic)) 1 -1))

(defun algebra-term-angle (term)
  (if (eq (car term) 'known)
      (cons (algebra-evaluate (cadr term)) (algebra-evaluate (caddr term)))
      (algebra-multiple-angle (cdr term)
                              (* (car term) (algebra-unit-denominator (cdr term))))))

(defun algebra-add-angles (a b sign)
  (flet ((times (x y) (rattimes x y t)))
    (cons (ratplus (times (car a) (car b)) (times (cons sign 1) (times (cdr a) (cdr b))))
          (ratplus (times (cdr a) (car b)) (times (car a) (cdr b))))))

(defun algebra-multiple-angle (unit n)
  (let ((cosine (algebra-variable (algebra-unit-cosine unit)))
        (sine (algebra-variable (algebra-unit-sine unit))))
    (cond ((minusp n)
           (let ((positive (algebra-multiple-angle unit (- n))))
             (cons (car positive) (ratminus (cdr positive)))))
          ((> n 500) (core-error "sin(~A*u) and sin(u) in one formula are too much to expand" n))
          (t (algebra-chebyshev cosine sine n)))))

(defun algebra-chebyshev (cosine sine n)
  "cos(n u) = T_n(c) and sin(n u) = s U_(n-1)(c); the same recurrence serves cosh and sinh."
  (let ((t0 1) (t1 cosine) (u0 0) (u1 1) (twice (ptimes 2 cosine)))
    (if (zerop n)
        (cons (cons 1 1) (cons 0 1))
        (loop repeat (1- n)
              do (psetq t0 t1
                        t1 (pdifference (ptimes twice t1) t0)
                        u0 u1
                        u1 (pdifference (ptimes twice u1) u0))
              finally (return (cons (cons t1 1) (cons (ptimes sine u1) 1)))))))
