;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; algebra_normal(e): the canonical form of an expression, in general form, fit to be read:
;;; sin(theta)^2*v^2 and not (1-cos(theta)^2)*v^2.  algebra_ratio(e): [numerator, denominator].
;;; The quotient is reduced modulo the relations of the kernels (relations.lisp); below the line
;;; the form of each angle is chosen that cancels most.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/scan" "algebra/evaluate"
                "algebra/readable" "algebra/general_form" "algebra/memory" "algebra/nouns"
                "algebra/zero" "algebra/quotient" "algebra/relations"))

(defun $algebra_normal (e)
  (algebra-map-bags #'algebra-normal-form e))

(defun $algebra_ratio (e)
  (if (algebra-plain-p e)
      (algebra-kept 'ratio e (lambda () (algebra-new-ratio e)))
      (algebra-new-ratio e)))

(defun algebra-new-ratio (e)
  (with-algebra-ring
    (let ((quotient (algebra-normal-quotient e)))
      (list '(mlist simp)
            (algebra-general (algebra-readable (car quotient)))
            (algebra-general (algebra-readable (cdr quotient)))))))

(defun algebra-map-bags (f e)
  "F of an expression, of both sides of an equation, of the elements of lists and matrices."
  (cond ((mbagp e) (cons (car e) (mapcar (lambda (part) (algebra-map-bags f part)) (cdr e))))
        ((and (consp e) (member (caar e) '(mnotequal mgreaterp mlessp mgeqp mleqp)))
         (cons (car e) (mapcar (lambda (part) (algebra-map-bags f part)) (cdr e))))
        (t (funcall f e))))

(defun algebra-normal-form (e)
  (if (atom e)
      e
      (with-algebra-ring
        (let ((quotient (algebra-normal-quotient e)))
          (algebra-general-quotient (algebra-readable (car quotient))
                                    (algebra-readable (cdr quotient)))))))

(setq *algebra-argument-form* 'algebra-normal-form)

(defun algebra-normal-quotient (e)
  (let ((*algebra-exponential-form* (algebra-exponentials-p e)))
    (let ((skeleton (algebra-scan e)))
      (algebra-order-kernels)
      (algebra-cancel (algebra-evaluate skeleton)))))

(defun algebra-exponentials-p (e)
  (and (not (atom e))
       (or (and (mexptp e) (eq (cadr e) '$%e))
           (some #'algebra-exponentials-p (cdr e)))))

(defun algebra-cancel (quotient)
  "Reduce numerator and denominator modulo the relations and cancel."
  (destructuring-bind (n . d) quotient
    (let ((above (algebra-zeros-left-out (algebra-reduce n)))
          (below (algebra-zeros-left-out (algebra-reduce d))))
      (cond ((pzerop (car below)) (core-error "division by zero"))
            ((pzerop (car above)) (cons 0 1))
            ((eql d 1) above)
            ((algebra-long-p d) (algebra-shortest-angles (algebra-ratio-of above below)))
            (t (algebra-settle
                (algebra-shortest-angles
                 (algebra-ratio-of above
                                   (algebra-zeros-left-out (algebra-reduce-roots d))))))))))

(defun algebra-zeros-left-out (quotient)
  (cons (algebra-without-zero-terms (car quotient)) (cdr quotient)))

(defun algebra-long-p (d)
  (> (algebra-monomials d) 12))

(defun algebra-settle (quotient)
  "Cancel again what the readable form shows, until nothing changes: the form is its own form."
  (if (algebra-angles-below-p quotient)
      (loop repeat 4
            for again = (algebra-shortest-angles
                         (algebra-ratio-of (algebra-reduce (algebra-readable (car quotient)))
                                           (algebra-reduce-roots
                                            (algebra-readable (cdr quotient)))))
            until (equal again quotient)
            do (setq quotient again)
            finally (return quotient))
      quotient))

(defun algebra-angles-below-p (quotient)
  (some (lambda (unit)
          (and (algebra-pair-p unit) (algebra-unit-occurs-p unit (cdr quotient))))
        (algebra-ring-units *algebra-ring*)))

(defun algebra-reduce-roots (d)
  (let ((quotient (cons d 1)))
    (dolist (kernel (reverse (algebra-ring-kernels *algebra-ring*)) quotient)
      (when (algebra-kernel-degree kernel)
        (setq quotient (algebra-reduce-root quotient kernel))))))

(defun algebra-ratio-of (above below)
  (algebra-quotient-of (ptimes (car above) (cdr below)) (ptimes (car below) (cdr above))))

(defun algebra-shortest-angles (quotient)
  "For each angle below the line write it in sines or in cosines, whichever cancels more."
  (dolist (unit (algebra-ring-units *algebra-ring*) quotient)
    (when (and (algebra-pair-p unit)
               (algebra-unit-occurs-p unit (cdr quotient))
               (or (not (algebra-long-p (cdr quotient)))
                   (algebra-sine-divides-p unit (cdr quotient))
                   (algebra-cosine-divides-p unit (cdr quotient))))
      (setq quotient (algebra-shorter-angle quotient unit)))))

(defun algebra-sine-divides-p (unit p)
  "P vanishes with s, where c^2 = 1."
  (let* ((cosine (algebra-kernel-variable (algebra-unit-cosine unit)))
         (without (algebra-parity-part (algebra-at-zero p (algebra-unit-sine unit)) cosine 0))
         (odd (algebra-parity-part (algebra-at-zero p (algebra-unit-sine unit)) cosine 1)))
    (and (pzerop (algebra-at-one without cosine))
         (pzerop (algebra-at-one odd cosine)))))

(defun algebra-cosine-divides-p (unit p)
  "P vanishes with c, where s^2 = 1."
  (and (eq (algebra-unit-kind unit) 'circular)
       (let* ((sine (algebra-kernel-variable (algebra-unit-sine unit)))
              (without (algebra-at-zero p (algebra-unit-cosine unit))))
         (and (pzerop (algebra-at-one (algebra-parity-part without sine 0) sine))
              (pzerop (algebra-at-one (algebra-parity-part without sine 1) sine))))))

(defun algebra-at-zero (p kernel)
  (pcsubsty 0 (algebra-kernel-variable kernel) p))

(defun algebra-at-one (p variable)
  (pcsubsty 1 variable p))

(defun algebra-shorter-angle (quotient unit)
  (destructuring-bind (n . d) quotient
    (let* ((n-sine (algebra-eliminate-sine n unit))
           (n-cosine (algebra-eliminate-cosine n unit))
           (d-sine (algebra-eliminate-sine d unit))
           (d-cosine (algebra-eliminate-cosine d unit))
           (forms (loop for (above below) in (list (list n-sine d-sine) (list n-cosine d-cosine)
                                                   (list n-sine d-cosine) (list n-cosine d-sine)
                                                   (list n-sine d) (list n-cosine d))
                        collect (algebra-quotient-of above below))))
      (algebra-least forms (lambda (form) (+ (algebra-poly-size (car form))
                                             (* 2 (algebra-poly-size (cdr form)))))))))

(defun algebra-general-reduced (quotient)
  "The readable expression of a quotient after reduction."
  (let ((reduced (algebra-cancel quotient)))
    (algebra-general-quotient (algebra-readable (car reduced)) (algebra-readable (cdr reduced)))))

(defun algebra-expanded-reduced (quotient)
  "The same expanded over its denominator."
  (let ((reduced (algebra-cancel quotient)))
    (algebra-expanded-quotient (algebra-readable (car reduced))
                               (algebra-readable (cdr reduced)))))

(defun algebra-expanded-quotient (n d)
  "The terms of N, each over D and cancelled against it."
  (let ((expanded (algebra-expanded n)))
    (cond ((eql d 1) expanded)
          ((algebra-one-term-p d) ($expand (div expanded (algebra-general d)) 1 1))
          (t (algebra-general-quotient n d)))))
