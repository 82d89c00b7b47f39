;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; From polynomials in kernels to general expressions, expanded or nested, whichever is shorter.
;;; Maxima's simplifier takes quadratic time for long sums; here the terms of an expanded
;;; polynomial are put into Maxima's order directly: its order of monomials is the lexicographic
;;; one, the greatest variable first.  Kernels that are powers themselves (roots, exponentials)
;;; are left to the simplifier, which joins x*sqrt(x).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/quotient"))

(defun algebra-general (p)
  "The expression of the polynomial P."
  (cond ((atom p) p)
        ((<= (algebra-expanded-size p) (* 5/4 (algebra-nested-size p))) (algebra-expanded p))
        (t (simplify (let (($ratexpand nil)) (pdisrep p))))))

(defun algebra-general-quotient (n d)
  "N/D; over a single term each part of N that cancels alike stands over its own denominator."
  (let* ((sign (if (pminusp d) -1 1))
         (above (ptimes sign n))
         (below (ptimes sign d))
         (whole (div (algebra-general above) (algebra-general below))))
    (if (and (not (eql below 1)) (algebra-one-term-p below)
             (< 1 (algebra-monomials above) 1500))
        (let ((parts (algebra-sum-of-parts (algebra-parts above below))))
          (if (<= (algebra-size parts) (* 6/5 (algebra-size whole))) parts whole))
        whole)))

(defun algebra-one-term-p (p)
  (or (atom p) (and (null (cdddr p)) (algebra-one-term-p (caddr p)))))

(defun algebra-parts (n d)
  "N/D as a list of (denominator . terms): quotients of single terms with one denominator."
  (let ((parts nil))
    (dolist (term (algebra-single-terms n) parts)
      (let* ((quotient (algebra-quotient-of term d))
             (part (assoc (cdr quotient) parts :test #'equal)))
        (if part
            (push (car quotient) (cdr part))
            (push (list (cdr quotient) (car quotient)) parts))))))

(defun algebra-single-terms (p)
  (if (atom p)
      (list p)
      (loop for (exponent coefficient) on (cdr p) by #'cddr
            append (loop for term in (algebra-single-terms coefficient)
                         collect (ptimes (list (car p) exponent 1) term)))))

(defun algebra-sum-of-parts (parts)
  (addn (loop for (denominator . terms) in parts
              collect (div (algebra-general
                            (car (algebra-sum (mapcar (lambda (term) (cons term 1)) terms))))
                           (algebra-general denominator)))
        nil))

;;; Sizes, counted without expanding.

(defun algebra-nested-size (p)
  (if (atom p)
      1
      (loop for (exponent coefficient) on (cdr p) by #'cddr
            sum (+ (algebra-nested-size coefficient)
                   (case exponent (0 0) (1 2) (t 4))))))

(defun algebra-expanded-size (p)
  (nth-value 1 (algebra-count-terms p)))

(defun algebra-count-terms (p)
  "Number of terms, and number of nodes, of the expanded P."
  (if (atom p)
      (values 1 1)
      (let ((terms 0) (nodes 0))
        (loop for (exponent coefficient) on (cdr p) by #'cddr
              do (multiple-value-bind (inner-terms inner-nodes) (algebra-count-terms coefficient)
                   (incf terms inner-terms)
                   (incf nodes (+ inner-nodes
                                  (* inner-terms (case exponent (0 0) (1 1) (t 3)))))))
        (values terms nodes))))

;;; Expanded sums in Maxima's order.

(defun algebra-expanded (p)
  (let ((variables (algebra-variables p)))
    (cond ((atom p) p)
          ((every #'algebra-plain-kernel-p variables) (algebra-sorted-sum p variables))
          (t (let (($ratexpand t)) (simplify (pdisrep p)))))))

(defun algebra-variables (p)
  (let ((variables nil))
    (labels ((walk (p)
               (unless (atom p)
                 (unless (member (car p) variables :test #'eq) (push (car p) variables))
                 (loop for (nil coefficient) on (cdr p) by #'cddr do (walk coefficient)))))
      (walk p))
    variables))

(defun algebra-plain-kernel-p (variable)
  "Its powers and products are simple as they stand."
  (let ((e (get variable 'disrep)))
    (if (atom e)
        (and (symbolp e) (not ($constantp e)))
        (not (or (member (caar e) '(mexpt mtimes mplus mabs)) ($constantp e))))))

(defun algebra-sorted-sum (p variables)
  (let* ((sorted (sort variables (lambda (a b) (great (get b 'disrep) (get a 'disrep)))))
         (terms (if (algebra-variables-in-order-p sorted)
                    (algebra-ordered-terms p)
                    (algebra-terms-to-sort p sorted))))
    (if (cdr terms) (cons '(mplus simp) terms) (car terms))))

(defun algebra-variables-in-order-p (sorted)
  "Whether the polynomials' own order of variables is Maxima's."
  (loop for (a b) on sorted
        always (or (null b) (< (symbol-value a) (symbol-value b)))))

(defun algebra-ordered-terms (p)
  "Its terms in order: the greatest variable is outermost, terms share the factors behind."
  (let ((terms '()) (tables (make-hash-table :test #'eq)))
    (labels ((table (variable)
               (or (gethash variable tables)
                   (setf (gethash variable tables) (algebra-factor-table variable))))
             (walk (p behind)
               (if (atom p)
                   (push (algebra-monomial-expression p behind) terms)
                   (loop with table = (table (car p))
                         for (exponent coefficient) on (cdr p) by #'cddr
                         do (walk coefficient
                                  (if (eql exponent 0)
                                      behind
                                      (cons (algebra-factor table exponent) behind)))))))
      (walk p '()))
    terms))

(defun algebra-monomial-expression (coefficient factors)
  (cond ((null factors) coefficient)
        ((not (eql coefficient 1)) (list* '(mtimes simp) coefficient factors))
        ((cdr factors) (cons '(mtimes simp) factors))
        (t (car factors))))

(defun algebra-terms-to-sort (p sorted)
  (let ((factors (mapcar #'algebra-factor-table sorted)))
    (loop for (exponents . coefficient) in (sort (algebra-flat-terms p sorted)
                                                 #'algebra-monomial-before :key #'car)
          collect (algebra-term-expression exponents coefficient factors))))

(defun algebra-flat-terms (p sorted)
  "A list of (exponents . number), the exponents a vector in the order of SORTED."
  (let ((n (length sorted)) (terms nil))
    (labels ((walk (p exponents)
               (if (atom p)
                   (push (cons exponents p) terms)
                   (loop with place = (position (car p) sorted :test #'eq)
                         for (exponent coefficient) on (cdr p) by #'cddr
                         for extended = (copy-seq exponents)
                         do (setf (svref extended place) exponent)
                            (walk coefficient extended)))))
      (walk p (make-array n :initial-element 0)))
    terms))

(defun algebra-monomial-before (a b)
  "Lexicographic, the last variable weighing most."
  (loop for k from (1- (length a)) downto 0
        do (let ((i (svref a k)) (j (svref b k)))
             (cond ((< i j) (return t))
                   ((> i j) (return nil))))))

(defun algebra-factor-table (variable)
  "Variable and its powers, each made once."
  (cons (get variable 'disrep) (make-hash-table)))

(defun algebra-factor (table exponent)
  (destructuring-bind (base . powers) table
    (if (= exponent 1)
        base
        (or (gethash exponent powers)
            (setf (gethash exponent powers) (list '(mexpt simp) base exponent))))))

(defun algebra-term-expression (exponents coefficient factors)
  (algebra-monomial-expression
   coefficient
   (loop for table in factors
         for k from 0
         for exponent = (svref exponents k)
         unless (zerop exponent) collect (algebra-factor table exponent))))
