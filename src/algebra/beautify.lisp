;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; algebra_beautify(e): the form a person would write, m*l^2*(v^2+w^2)/2 - m*g*l*cos(theta): what
;;; stands over one denominator together, common factors in front.  Of several forms the shortest;
;;; the input itself is one of them, so that its tangents and cosecants stay where they help.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal"))

(defun $algebra_beautify (e)
  (algebra-map-bags #'algebra-beautiful e))

(defun algebra-beautiful (e)
  (if (atom e)
      e
      (car (algebra-least (algebra-beautiful-forms e) #'cdr))))

(defun algebra-beautiful-forms (e)
  "(form . weight), ..: sizes, with some favour for sums of short products."
  (with-algebra-ring
    (let* ((quotient (algebra-normal-quotient e))
           (above (algebra-readable (car quotient)))
           (below (algebra-readable (cdr quotient))))
      (flet ((weighed (form favour) (cons form (* favour (algebra-size form)))))
        (list (weighed (algebra-grouped-quotient above below) 4/5)
              (weighed e (if (algebra-reciprocals-p e) 3/4 1))
              (weighed (algebra-general-quotient above below) 1)
              (weighed (div (algebra-factored above) (algebra-factored below)) 1))))))

(defun algebra-reciprocals-p (e)
  "Tangents and their kin occur."
  (and (not (atom e))
       (or (member (caar e) '(%tan %cot %sec %csc))
           (some #'algebra-reciprocals-p (cdr e)))))

(defun algebra-grouped-quotient (n d)
  "Like algebra-general-quotient, the content of each part in front."
  (if (and (algebra-one-term-p d) (< (algebra-monomials n) 1500))
      (addn (loop for (denominator . terms) in (algebra-parts n d)
                  collect (div (algebra-content-in-front (algebra-polynomial-sum terms))
                               (algebra-general denominator)))
            nil)
      (div (algebra-content-in-front n) (algebra-content-in-front d))))

(defun algebra-content-in-front (p)
  (let ((content (algebra-content p)))
    (mul (algebra-general content) (algebra-general (pquotient p content)))))

(defun algebra-factored (p)
  (if (< (algebra-monomials p) 300)
      ($factor (algebra-general p))
      (algebra-content-in-front p)))
