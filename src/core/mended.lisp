;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions of Maxima that answer wrongly, and ours, which hold in their place while we compute.
;;;
;;; eztestdivide (5.46): whether the polynomial y divides x. It asks first whether the last
;;; coefficient of y divides that of x, which says something where both have one main variable.
;;; Else gcd((d - b)*(c*e^2 + d), (d - b)*(e^2 + 1)) is 1: -b does not divide d^2 - b*d.

(in-package :maxima)

(defun core-tested-quotient (x y)
  "x/y, or nil where y does not divide x."
  (when (or (pcoefp x) (pcoefp y) (not (eq (p-var x) (p-var y)))
            (ignore-rat-err (pquotient (car (last x)) (car (last y)))))
    (ignore-rat-err (pquotient x y))))

(defvar *core-mended-functions* (list (cons 'eztestdivide #'core-tested-quotient))
  "(symbol . definition), ..")
