;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Forms as a person writes them, taken only where they are shorter.
;;; algebra_collected(e): every product of velocities and function of the angles once, with what it
;;; is multiplied by,
;;;     l1*l2*(m2 + m3)*(cos(q1)*sin(q2) - sin(q1)*cos(q2))*'diff(q2,t)^2.
;;; The angles being the lowest variables, a polynomial is a sum of monomials of the others times
;;; polynomials in sines and cosines, its leaves; the monomials of leaves that are equal up to a
;;; number are collected.
;;; algebra_beautify(e): m*l^2*(v^2+w^2)/2 - m*g*l*cos(theta), what stands over one denominator
;;; together, common factors in front, or another form that is shorter, e itself among them: its
;;; tangents and cosecants stay where they help.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/factoring" "algebra/general_form" "algebra/kernels" "algebra/normal"
                "algebra/quotient" "algebra/readable" "algebra/size"))

(defun $algebra_collected (e)
  "The canonical form of E, collected."
  (algebra-map-bags #'algebra-collected-form e))

(defun algebra-collected-form (e)
  (if (atom e)
      e
      (with-algebra-ring (algebra-collected-reduced (algebra-normal-quotient e)))))

(defun algebra-collected-reduced (quotient)
  "The collected expression of a QUOTIENT after reduction."
  (algebra-collected-quotient (algebra-readable (car quotient)) (algebra-readable (cdr quotient))))

(defun algebra-collected-quotient (n d)
  "N/D, N collected where D is a number and it is shorter so."
  (let ((groups (and (atom d) (mapcar #'algebra-group-factors (algebra-groups-of-leaves n)))))
    (if (and groups (< (algebra-size-of-groups groups) (algebra-expanded-size n)))
        (algebra-sum-of-products (mapcar (lambda (group) (algebra-group-expression group d))
                                         groups))
        (algebra-general-quotient n d))))

(defun algebra-size-of-groups (groups)
  "As algebra-expanded-size counts: one for a number in front, one for each factor."
  (loop for (nil . factors) in groups
        sum (1+ (loop for factor in factors sum (1- (algebra-expanded-size factor))))))

;;; Leaves.

(defun algebra-map-leaves (function p)
  "FUNCTION of the monomial, a polynomial, and the leaf, for each leaf of P."
  (labels ((walk (p factors)
             (if (or (atom p) (algebra-angle-variable-p (car p)))
                 (funcall function factors p)
                 (loop for (exponent coefficient) on (cdr p) by #'cddr
                       do (walk coefficient (if (zerop exponent)
                                                factors
                                                (acons (car p) exponent factors)))))))
    (walk p '())))

(defun algebra-groups-of-leaves (p)
  "A list of ((velocities . leaf) . coefficient), the leaves without numbers in common."
  (let ((groups (make-hash-table :test #'equal)) (keys '()))
    (algebra-map-leaves
     (lambda (monomial leaf)
       (let* ((number (algebra-signed-content leaf))
              (velocities (remove-if-not #'algebra-velocity-p monomial :key #'car))
              (key (cons velocities (pquotient leaf number))))
         (unless (gethash key groups) (push key keys))
         (push (ptimes number (algebra-monomial-polynomial (set-difference monomial velocities)))
               (gethash key groups))))
     p)
    (loop for key in (nreverse keys)
          collect (cons key (algebra-polynomial-sum (gethash key groups))))))

(defvar *algebra-velocities* '() "Plain names of velocities and accelerations.")

(defun algebra-velocity-p (variable)
  (let ((e (get variable 'disrep)))
    (if (symbolp e)
        (member e *algebra-velocities* :test #'eq)
        (and (consp e) (eq (caar e) '%derivative)))))

(defun algebra-signed-content (p)
  (let ((content (algebra-number-content p)))
    (if (pminusp p) (- content) content)))

;;; Expressions.

(defun algebra-group-factors (group)
  "The number, the monomial, what is left of the coefficient, the leaf and the velocities."
  (destructuring-bind ((velocities . leaf) . coefficient) group
    (let* ((number (algebra-signed-content coefficient))
           (monomial (algebra-monomial-polynomial (algebra-monomial coefficient)))
           (rest (pquotient (pquotient coefficient number) monomial))
           (opposite (and (minusp number) (algebra-mixed-signs-p rest))))
      (list (if opposite (- number) number)
            monomial
            (if opposite (pminus rest) rest)
            leaf
            (algebra-monomial-polynomial velocities)))))

(defun algebra-mixed-signs-p (p)
  "Whether P, whose first coefficient is positive, has a negative one."
  (if (atom p)
      (minusp p)
      (loop for (nil coefficient) on (cdr p) by #'cddr
            thereis (algebra-mixed-signs-p coefficient))))

(defun algebra-group-expression (factors d)
  "The list of expressions of the FACTORS that are not 1, the number over D."
  (remove 1 (cons (div (car factors) d) (mapcar #'algebra-general (cdr factors))) :test #'eql))

(defun algebra-sum-of-products (groups)
  (let ((terms (loop for factors in groups append (algebra-terms-of-product factors))))
    (cond ((null terms) 0)
          ((null (cdr terms)) (car terms))
          (t (cons '(mplus simp) (sort terms #'algebra-term-before-p))))))

(defun algebra-terms-of-product (factors)
  (let ((product (muln factors nil)))
    (if (mplusp product) (copy-list (cdr product)) (list product))))

(defun algebra-term-before-p (x y)
  "Maxima's order of the terms of a sum, which does not look at numbers in front."
  (great (algebra-without-number y) (algebra-without-number x)))

(defun algebra-without-number (term)
  (cond ((not (and (mtimesp term) (mnump (cadr term)))) term)
        ((cdddr term) (cons '(mtimes simp) (cddr term)))
        (t (caddr term))))

;;; Of several forms the shortest.

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
      ($algebra_factor (algebra-general p))
      (algebra-content-in-front p)))
