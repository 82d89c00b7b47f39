;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Opaque kernels: open functions f(u), derivatives, integrals.  Their arguments are normal, dummy
;;; variables renamed: 'integrate(g(z), z, 0, u) is 'integrate(g(s), s, 0, u).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/kernels"))

(defvar *algebra-argument-form* 'identity "the normal form of arguments, set by normal.lisp")

(defun algebra-argument-form (e)
  (funcall *algebra-argument-form* e))

(defun algebra-opaque-kernel (e)
  (let ((canonical (algebra-canonical-noun e)))
    (or (algebra-find-opaque canonical)
        (let ((kernel (algebra-new-kernel canonical (if (eq (caar e) '%derivative) 4 3)
                                          (algebra-open-p e))))
          (push (cons canonical kernel) (algebra-ring-opaque *algebra-ring*))
          kernel))))

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
