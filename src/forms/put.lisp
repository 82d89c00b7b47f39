;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Substitution for names alone, all at once: an operator of the same name stays, and so does a
;;; variable of integration within its integral. With [x = y, y = x] the two change places.

(in-package :maxima)

(defun forms-put (table e)
  (cond ((symbolp e) (gethash e table e))
        ((atom e) e)
        ((and (eq (caar e) '%integrate) (cddr e)) (forms-put-integral table e))
        (t (forms-put-parts table e))))

(defun forms-put-integral (table e)
  "The integrand with its variable kept; the variable itself; the limits like any expression."
  (let* ((variable (third e)) (value (gethash variable table variable)) (integrand nil))
    (setf (gethash variable table) variable)
    (setq integrand (forms-put table (second e)))
    (setf (gethash variable table) value)
    (simplifya (list* '(%integrate) integrand variable
                      (mapcar (lambda (limit) (forms-put table limit)) (cdddr e)))
               nil)))

(defun forms-put-parts (table e)
  (simplifya (cons (remove 'simp (car e))
                   (mapcar (lambda (part) (forms-put table part)) (cdr e)))
             nil))

(defun $forms_put (equations e)
  "E with the right sides of EQUATIONS [name = value, ..] for the names."
  (let ((table (make-hash-table :test #'eq)))
    (dolist (equation (cdr equations) (forms-put table e))
      (setf (gethash (second equation) table) (third equation)))))
