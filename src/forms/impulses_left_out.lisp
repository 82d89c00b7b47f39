;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Impulses that equations leave out: where a function that they are derivatives of jumps, as a
;;; potential signum(x) does at x = 0, its derivative is an impulse there and 0 beside it. One whose
;;; factor vanishes at the jump, or is odd in the sign that jumps, moves nothing: the mean of the
;;; factor while the sign goes from -1 to 1 is 0 (forms/rates_impulses).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/branch_slopes" "algebra/impulses" "algebra/nouns" "algebra/zero"
                "forms/piecewise"))

(defun $forms_impulse_of_lagrangian (l q v)
  "u where Lagrange's equations of L have an impulse at u = 0; else false."
  (and (forms-kinked-p l)
       (or ($forms_impulse_of l q)
           (some (lambda (velocity)
                   ($forms_impulse_of ($algebra_diff l velocity) (list* '(mlist) '$t (cdr q))))
                 (cdr v)))))

(defun $forms_impulse_of (e names)
  "u where the derivative of E by one of NAMES is an impulse at u = 0; else false."
  (and (algebra-jumping-p e)
       (let ((e (forms-signs-of-one (algebra-with-signs e) (cdr names))))
         (some (lambda (name)
                 (let ((slope (let ((*algebra-impulses* t)) ($algebra_diff e name))))
                   (find-if-not (lambda (u) (forms-impulse-moves-nothing-p slope u (cdr names)))
                                (forms-impulse-arguments-in slope '()))))
               (cdr names)))))

(defun forms-signs-of-one (e names)
  "E where signs and unit steps of multiples of one u are written with signum(u)."
  (if (atom e)
      e
      (let ((e (algebra-with-parts e (mapcar (lambda (part) (forms-signs-of-one part names))
                                             (cdr e)))))
        (cond ((atom e) e)
              ((eq (caar e) '%signum) (forms-sign-of-one (second e) names))
              ((eq (caar e) '$unit_step)
               (div (add 1 (forms-sign-of-one (second e) names)) 2))
              (t e)))))

(defun forms-sign-of-one (u names)
  (let* ((u ($expand u))
         (slope (loop for name in names
                      for slope = ($algebra_diff u name)
                      when (and (mnump slope) (not (zerop1 slope))) return slope)))
    (if slope
        (mul (take '(%signum) slope) (take '(%signum) ($expand (div u slope))))
        (take '(%signum) u))))

(defun forms-impulse-arguments-in (e found)
  (cond ((atom e) found)
        ((eq (caar e) 'algebra-impulse) (adjoin (second e) found :test #'alike1))
        (t (dolist (part (cdr e) found)
             (setq found (forms-impulse-arguments-in part found))))))

(defun forms-impulse-moves-nothing-p (slope u names)
  "Whether the mean of the factor that the impulse at U has in SLOPE is surely 0."
  (let* ((impulse (gensym)) (sign (gensym))
         (factor ($diff (maxima-substitute impulse (list '(algebra-impulse simp) u) slope) impulse))
         (by-sign (maxima-substitute sign (take '(%signum) u) factor))
         (place (forms-place-of-zero u names)))
    (and place
         (core-attempt
          (lambda ()
            (when (forms-jumps-there-p by-sign place) (core-error "more jumps there"))
            (let ((there (maxima-substitute (cdr place) (car place) by-sign)))
              (or (eq t ($algebra_zero_at_samples
                         (add there (maxima-substitute (neg sign) sign there))))
                  (core-error "the impulse moves")))))
         t)))

(defun forms-jumps-there-p (e place)
  "Whether the argument of a sign in E may vanish at PLACE too, (name . value)."
  (and (algebra-call-p e)
       (or (some (lambda (part) (forms-jumps-there-p part place)) (cdr e))
           (and (member (caar e) '(%signum $unit_step $piecewise))
                (not (eq nil ($algebra_zero_at_samples
                              (maxima-substitute (cdr place) (car place) (second e)))))))))

(defun forms-place-of-zero (u names)
  "(name . value) where U is 0, all of it: the slope in the name does not change; or nil."
  (loop for name in names
        for slope = ($algebra_diff u name)
        when (and (notany (lambda (other) (among other slope)) names)
                  (eq ($algebra_zerop slope) nil))
          return (cons name (sub name (div u slope)))))
