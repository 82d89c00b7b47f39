;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Open functions f(u), their derivatives, values at a point and integrals as kernels.  Which of
;;; them are independent: values of an open function at places that differ, its derivatives there,
;;; integrals of such products as s*f(s)^2.  What has no open function in it is a number or a
;;; formula that is only not carried out: never independent (noun_values.lisp).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "core/bound_names"))

(defvar *algebra-zero-judge* nil "true, false or unknown for an expression; set by zero.lisp")

;;; What a noun binds

(defun algebra-call-p (e)
  (and (consp e) (consp (car e))))

(defun algebra-with-parts (e parts)
  (if (every #'eq parts (cdr e))
      e
      (simplifya (cons (remove 'simp (car e)) parts) nil)))

(defun algebra-bound-name (e)
  "The dummy variable of a definite integral, sum or product, of a limit; else nil."
  (and (algebra-call-p e)
       (or (and (member (caar e) '(%integrate %sum %product)) (cdddr e))
           (eq (caar e) '%limit))
       (symbolp (caddr e))
       (caddr e)))

(defun algebra-equations-at (e)
  "The equations of the noun 'at(body, ..)."
  (let ((where (caddr e)))
    (if (mbagp where)
        (if (mequalp where) (list where) (cdr where))
        '())))

(defun algebra-constant-p (e &optional (bound '()))
  "Whether E is a number: no name in it is free, no function open."
  (cond ((atom e) (or (and (member e bound) t) (and ($constantp e) t)))
        ((member 'rat (car e)) t)
        ((algebra-bound-name e)
         (and (algebra-constant-p (cadr e) (cons (caddr e) bound))
              (every (lambda (part) (algebra-constant-p part bound)) (cdddr e))))
        ((eq (caar e) '%at)
         (let ((equations (algebra-equations-at e)))
           (and (every (lambda (equation) (algebra-constant-p (caddr equation) bound)) equations)
                (algebra-constant-p (cadr e) (append (mapcar #'cadr equations) bound)))))
        ((or (member 'array (car e)) (algebra-open-operator-p (caar e))) ($constantp e))
        (t (every (lambda (part) (algebra-constant-p part bound)) (cdr e)))))

(defun $algebra_constantp (e) (algebra-constant-p e))

;;; Open functions

(defun algebra-open-operator-p (operator)
  "A function of the user: Maxima has no rule, derivative or program of that name."
  (let ((verb (or (get operator 'noun) operator)))
    (and (char= (char (symbol-name verb) 0) #\$)
         (not (eq verb '$piecewise))
         (loop for name in (list operator verb)
               never (or (get name 'operators) (get name 'grad) (get name 'specsimp)
                         (get name 'mfexpr*) (fboundp name))))))

(defun algebra-open-call-p (e)
  "f(u), f[i](u) or x[i] of the user."
  (and (algebra-call-p e)
       (let ((head (if (eq (caar e) 'mqapply) (cadr e) e)))
         (and (algebra-call-p head)
              (or (member 'array (car head)) (not (eq head e)) (cdr e))
              (algebra-open-operator-p (caar head))))))

(defun algebra-has-open-p (e)
  (and (algebra-call-p e)
       (or (algebra-open-call-p e)
           (some #'algebra-has-open-p (cdr e)))))

(defun algebra-distinct-symbols-p (list)
  (and (every (lambda (x) (and (symbolp x) (not ($constantp x)))) list)
       (= (length list) (length (remove-duplicates list)))))

(defun algebra-plain-jet-p (e)
  "A derivative of q, or of f(x, y) with respect to x, y."
  (and (algebra-call-p e)
       (eq (caar e) '%derivative)
       (let ((body (cadr e)))
         (or (symbolp body)
             (and (algebra-open-call-p body)
                  (not (member (caar body) '(mqapply)))
                  (algebra-distinct-symbols-p (cdr body))
                  (loop for (x) on (cddr e) by #'cddr always (member x (cdr body))))))))

(defun algebra-value-of-jet-p (e)
  "'at(derivative, [x = u, ..]), in which each argument of f gets its value."
  (and (algebra-call-p e)
       (eq (caar e) '%at)
       (algebra-plain-jet-p (cadr e))
       (let ((names (mapcar #'cadr (algebra-equations-at e))) (body (cadr (cadr e))))
         (and names
              (if (symbolp body)
                  (equal names (loop for (x) on (cddr (cadr e)) by #'cddr collect x))
                  (equal names (cdr body)))))))

;;; Independent by itself

(defun algebra-independent-noun-p (e)
  "Whether nothing binds the noun E to names or functions outside of it."
  (case (caar e)
    (%derivative (algebra-plain-jet-p e))
    (%at (algebra-value-of-jet-p e))
    (%integrate (algebra-open-integral-p e))
    (t (algebra-open-call-p e))))

(defun algebra-open-integral-p (e)
  "An open function, no derivative, under the integral."
  (labels ((derived (e)
             (and (algebra-call-p e)
                  (or (member (caar e) '(%derivative %at %integrate %sum %product %limit))
                      (some #'derived (cdr e))))))
    (and (algebra-has-open-p (cadr e))
         (not (derived (cadr e)))
         (algebra-open-depends-p (cadr e) (caddr e)))))

(defun algebra-open-depends-p (e s)
  "Whether an open function in E depends on S."
  (and (algebra-call-p e)
       (or (and (algebra-open-call-p e) (among s (cdr e)))
           (some (lambda (part) (algebra-open-depends-p part s)) (cdr e)))
       t))

;;; Two nouns, each independent by itself

(defun algebra-bound-nouns-p (a b)
  "Whether the nouns A and B, not written alike, may be bound to each other."
  (and (algebra-call-p a)
       (algebra-call-p b)
       (if (and (eq (caar a) '%integrate) (eq (caar b) '%integrate))
           (algebra-bound-integrals-p a b)
           (multiple-value-bind (family-a places-a) (algebra-noun-family a)
             (multiple-value-bind (family-b places-b) (algebra-noun-family b)
               (and family-a family-b
                    (alike1 family-a family-b)
                    (not (algebra-distinct-places-p places-a places-b))))))))

(defun algebra-noun-family (e)
  "Two values for a value of an open function or of its derivative: which function, which place."
  (flet ((family (&rest parts) (cons '(mlist) parts)))
    (cond ((algebra-open-call-p e)
           (if (eq (caar e) 'mqapply)
               (values (family (caar (cadr e)) (length (cdr e)))
                       (append (cdr (cadr e)) (cddr e)))
               (values (family (caar e) (length (cdr e))) (cdr e))))
          ((algebra-value-of-jet-p e)
           (let ((jet (cadr e)))
             (values (and (algebra-call-p (cadr jet)) (algebra-jet-family jet))
                     (mapcar #'caddr (algebra-equations-at e)))))
          ((and (algebra-plain-jet-p e) (algebra-call-p (cadr e)))
           (values (algebra-jet-family e) (cdr (cadr e)))))))

(defun algebra-jet-family (jet)
  "The function and the order in each argument."
  (list* '(mlist) '%derivative (caar (cadr jet))
         (loop for x in (cdr (cadr jet)) collect (getf (cddr jet) x 0))))

(defun algebra-distinct-places-p (as bs)
  "Whether the arguments AS are surely not those of BS, as functions of what is free in them."
  (or (/= (length as) (length bs))
      (and (every #'algebra-transparent-p as) (every #'algebra-transparent-p bs))
      (loop for a in as
            for b in bs
            thereis (null (funcall *algebra-zero-judge* (sub a b))))))

(defun algebra-transparent-p (e)
  "Whether the normal form of E is no one else's: no roots, constants, functions but open ones."
  (cond ((algebra-rational-number e) t)
        ((symbolp e) (or (eq e '$%pi) (not ($constantp e))))
        ((atom e) nil)
        (t (case (caar e)
             ((mplus mtimes) (every #'algebra-transparent-p (cdr e)))
             (mexpt (and (integerp (caddr e)) (algebra-transparent-p (cadr e))))
             ((%sin %cos) (and (symbolp (cadr e)) (not ($constantp (cadr e)))))
             (%derivative (algebra-plain-jet-p e))
             (t (and (algebra-open-call-p e) (every #'algebra-transparent-p (cdr e))))))))

;;; Integrals: over monomials that differ they are independent; over the same one, from one point to
;;; places that differ.

(defun algebra-bound-integrals-p (a b)
  (destructuring-bind (body-a s-a . limits-a) (cdr a)
    (destructuring-bind (body-b s-b . limits-b) (cdr b)
      (cond ((and (eq s-a s-b) (alike1 body-a body-b))
             (not (and (equal (car limits-a) (car limits-b))
                       (algebra-distinct-places-p (cdr limits-a) (cdr limits-b)))))
            (t (not (and (algebra-integral-monomial-p body-a s-a)
                         (algebra-integral-monomial-p body-b s-b))))))))

(defun algebra-integral-monomial-p (body s)
  "A product of powers of S and of open functions of S itself."
  (loop for factor in (if (mtimesp body) (cdr body) (list body))
        for base = (if (and (mexptp factor) (integerp (caddr factor))) (cadr factor) factor)
        always (or (eq base s)
                   (and (algebra-open-call-p base)
                        (among s base)
                        (every (lambda (x) (or (eq x s) (not (among s x)))) (cdr base))))))

;;; As kernels are written: with normal arguments, dummy variables renamed:
;;; 'integrate(g(z), z, 0, u) is 'integrate(g(s), s, 0, u).

(defvar *algebra-argument-form* 'identity "the normal form of arguments, set by normal.lisp")

(defun algebra-argument-form (e)
  (funcall *algebra-argument-form* e))

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
        (t (algebra-argument-form argument))))

(defun algebra-rename-dummy (e)
  "The dummy variable becomes s, or s1, s2, .. where the rest of the noun has s, bound too, where
something is assumed of it, which would hold of the variable, or s is free in the call."
  (destructuring-bind (integrand variable . limits) (cdr e)
    (let* ((own (gensym "$S"))
           (integrand (maxima-substitute own variable
                                         (if (algebra-binds-p integrand)
                                             (algebra-normal-argument integrand)
                                             integrand)))
           (dummy (algebra-free-dummy variable (cons '(mlist) (cons integrand limits)))))
      (list* (car e)
             (algebra-normal-argument (maxima-substitute dummy own integrand))
             dummy
             (mapcar #'algebra-normal-argument limits)))))

(defun algebra-binds-p (e)
  "Whether a noun in E binds a name."
  (and (algebra-call-p e)
       (or (and (algebra-bound-name e) t) (some #'algebra-binds-p (cdr e)))))

(defun algebra-free-dummy (variable e)
  (loop for name in '($s $s1 $s2 $s3 $s4 $s5)
        unless (algebra-taken-p name e) return name
        finally (return (if (algebra-taken-p variable e)
                            ($core_unused_name '$s e)
                            variable))))

(defun algebra-taken-p (name e)
  (or (among name e) ($core_assumed name) (member name *core-free-names*)))
