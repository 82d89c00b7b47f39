;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Whether two sides agree at a point: every symbol has a rational value there, every function left
;;; open is a polynomial, and both sides are evaluated to 150 digits. The verdict of every check:
;;; agreement goes into the result's check, disagreement stops with the point, which is found again
;;; since random values are decided by names.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/fixed" "forms/value"))

(defvar *forms-share-of-rounding* (forms-fixed (expt 10 -30)))

(defun forms-differ-p (x y)
  (> (abs (- x y))
     (forms-fixed-times *forms-share-of-rounding* (+ (ash 1 forms-digits) (abs x) (abs y)))))

(defconstant forms-most-digits-in-sums 200
  "Binary digits before the point: of two larger values of functions, as exp(1000) - exp(999), the
difference may hold nothing but rounding.")

(defun forms-drowned-p (point)
  "Whether a function has so large a value at POINT."
  (loop for value being the hash-values of (forms-point-known point)
          thereis (> (integer-length value) (+ forms-digits forms-most-digits-in-sums))))

(defun forms-agreement (sides point)
  "Whether the numbers of SIDES, pairs, agree; unknown where there is no number, or rounding alone
may tell them apart at POINT."
  (cond ((some (lambda (pair) (not (and (car pair) (cdr pair)))) sides) 'unknown)
        ((notany (lambda (pair) (forms-differ-p (car pair) (cdr pair))) sides) t)
        ((forms-drowned-p point) 'unknown)))

(defun forms-point-text (point)
  "The values of POINT, for a report."
  (let ((equations '()))
    (maphash (lambda (name value)
               (push (list '(mequal simp) name (div value (ash 1 forms-digits))) equations))
             (forms-point-names point))
    (coerce (mstring (cons '(mlist simp) equations)) 'string)))

(defun forms-verdict-of (how sides point)
  "Notes HOW it was checked that the numbers of SIDES agree, or stops."
  (case (forms-agreement sides point)
    (unknown ($core_checked "not checked (" how "): no number at a random point"))
    ((nil)
     (core-error "the result fails its check (~a) at ~a; please report this with the input"
                 how (forms-point-text point)))
    (t ($core_checked how))))

(defun forms-verdict (how found expected point)
  "The same of two numbers; nil where there is none."
  (forms-verdict-of how (list (cons found expected)) point))

(defun forms-sides-at (found expected point)
  "Pairs of values of the lists FOUND and EXPECTED."
  (flet ((value (e) (catch 'forms-no-value (forms-fixed-value e point))))
    (mapcar (lambda (x y) (cons (value x) (value y))) (cdr found) (cdr expected))))

;;; For Maxima.

(defun $forms_check (how found expected)
  "The lists FOUND and EXPECTED at a random point."
  (let ((point (forms-new-point t)))
    (forms-verdict-of how (forms-sides-at found expected point) point)))

(defun $forms_check_at (how found expected point)
  "The same at a given POINT, [x = rational, ..]."
  (let ((point (forms-given-point point)))
    (forms-verdict-of how (forms-sides-at found expected point) point)))

(defun $forms_agree_at (found expected point)
  "Whether they agree there, without a note."
  (let ((point (forms-given-point point)))
    (eq t (forms-agreement (forms-sides-at found expected point) point))))

(defun $forms_random_point (names)
  "[x = rational, ..], each once."
  (let ((point (forms-new-point t)))
    (cons '(mlist simp)
          (loop for name in (remove-duplicates (cdr names) :test #'alike1 :from-end t)
                collect (list '(mequal simp) name
                              (div (forms-variable-value name point) (ash 1 forms-digits)))))))
