;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; An expression in factors over the integers, as far as that takes no longer than seconds:
;;; Maxima's factor is quick for long products, but a sum of high degree, such as x^1000-x-1, keeps
;;; it busy for ever.  Of such a sum the powers come out that all its terms have.  Large numbers
;;; under roots keep it busy for as long: within factor (5.46) they are factored without limit.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/memory" "algebra/size" "core/watch"))

(defparameter *algebra-factored-degree* 300 "The degree up to which a sum is factored.")

(defun $algebra_in_factors (e size) (algebra-in-factors e size))

(defun algebra-in-factors (e size)
  "E as a product; what is longer than SIZE, or of high degree, is one factor."
  (cond ((or (atom e) (> (algebra-size e) size)) e)
        ((<= (algebra-degree-at-most e) *algebra-factored-degree*)
         (or (algebra-quietly (lambda () (algebra-factored-in-time e))) e))
        ((mtimesp e) (muln (loop for part in (cdr e) collect (algebra-in-factors part size)) nil))
        ((and (mexptp e) (typep (caddr e) '(integer 2)))
         (power (algebra-in-factors (cadr e) size) (caddr e)))
        ((mplusp e) (algebra-monomial-in-front e))
        (t e)))

(defparameter *algebra-factored-at-once* 300
  "The size up to which a sum is factored whatever it takes.")
(defparameter *algebra-factoring-time* 1/40 "of the time left, for a longer one, 4 s at most")

(defun algebra-factored-in-time (e)
  "nil where that takes too long."
  (if (<= (algebra-size e) *algebra-factored-at-once*)
      ($algebra_factor e)
      (values (core-within-at-most 4 *algebra-factoring-time* (lambda () ($algebra_factor e))))))

(defun $algebra_factor (e)
  "Maxima's factor, to which roots of large numbers are names."
  (cond ((symbolp e) e)
        ((algebra-plain-p e) (algebra-kept 'factor e (lambda () ($factor e))))
        (t (algebra-factor-without-roots e))))

(defun algebra-factor-without-roots (e)
  (let ((roots '()))
    (labels ((named (e)
               (cond ((atom e) e)
                     ((and (mexptp e) (ratnump (caddr e)) (algebra-large-number-in-p (cadr e)))
                      (power (name (cadr e) (caddr (caddr e))) (cadr (caddr e))))
                     (t (simplifya (cons (list (caar e)) (mapcar #'named (cdr e))) t))))
             (name (base degree)
               (let ((root (power base (algebra-maxima-rational (/ degree)))))
                 (or (car (rassoc root roots :test #'alike1))
                     (caar (push (cons (gensym "ROOT") root) roots))))))
      (let ((hidden (named e)))
        (if roots
            (resimplify (sublis roots ($ratdisrep ($factor hidden))))
            ($factor e))))))

(defun algebra-large-number-in-p (e)
  (if (atom e)
      (and (integerp e) (> (abs e) (expt 10 14)))
      (some #'algebra-large-number-in-p (cdr e))))

(defun algebra-degree-at-most (e)
  "Not less than the degree of E in names, functions and exponentials together."
  (cond (($constantp e) 0)
        ((atom e) 1)
        ((mplusp e) (reduce #'max (cdr e) :key #'algebra-degree-at-most))
        ((or (mtimesp e) (eq (caar e) 'rat))
         (loop for part in (cdr e) sum (algebra-degree-at-most part)))
        ((mexptp e) (* (algebra-exponent-size (caddr e)) (max 1 (algebra-degree-at-most (cadr e)))))
        (t 1)))

(defun algebra-exponent-size (n)
  "What N adds to a degree: exp(1000*x) is a power of exp(x), x^(500/3) one of x^(1/3)."
  (let ((number (algebra-rational-number n)))
    (cond (number (max (abs (numerator number)) (denominator number)))
          ((mplusp n) (reduce #'max (cdr n) :key #'algebra-exponent-size))
          ((mtimesp n) (loop with size = 1
                             for part in (cdr n)
                             do (setq size (* size (algebra-exponent-size part)))
                             finally (return size)))
          (t 1))))

(defun algebra-monomial-in-front (e)
  "The sum E as a product of the powers that all of its terms have and the rest."
  (let ((common (loop for (base . nil) in (algebra-plain-powers (cadr e))
                      for n = (loop for term in (cdr e)
                                    minimize (or (cdr (assoc base (algebra-plain-powers term)
                                                             :test #'alike1))
                                                 0))
                      unless (zerop n) collect (power base n))))
    (if (null common)
        e
        (let ((monomial (muln common nil)))
          (mul monomial (addn (loop for term in (cdr e) collect (div term monomial)) nil))))))

(defun algebra-plain-powers (term)
  "((base . exponent) ..) of the factors of TERM that are no numbers, whole positive powers only."
  (loop for factor in (if (mtimesp term) (cdr term) (list term))
        for (base exponent) = (if (mexptp factor) (cdr factor) (list factor 1))
        when (and (typep exponent '(integer 1)) (not ($constantp base)))
          collect (cons base exponent)))
