;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The values at which a circuit has a lower order than in general position: where the leading
;;; coefficient of its determinant vanishes (P. R. Bryant, The order of complexity of electrical
;;; networks, 1959; for controlled sources the pivots of the tableau).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/factoring" "algebra/sign" "algebra/size"
                "circuits/open_laws" "circuits/tableau_reduction"))

(defun $circuits_order_drops (solution)
  "Factors of the leading coefficient that may vanish, as a list."
  (let ((powers '()))
    (dolist (pivot (circuits-solution-determinant solution))
      (unless (rationalp pivot)
        (loop for (factor . exponent) in (circuits-powers (algebra-in-factors pivot 2000))
              do (let ((entry (or (find-if (lambda (entry) (circuits-same-factor-p (car entry)
                                                                                   factor))
                                           powers)
                                  (car (push (cons factor 0) powers)))))
                   (incf (cdr entry) exponent)))))
    (cons '(mlist simp)
          (loop for (factor . exponent) in powers
                when (and (plusp exponent) (not (eq t ($algebra_nonzero factor))))
                  collect factor))))

(defun circuits-same-factor-p (e other) (or (alike1 e other) (alike1 e (neg other))))

(defun circuits-powers (e)
  "((factor . exponent) ..) of the product E, numbers apart."
  (cond ((circuits-outside-number-p e) '())
        ((mtimesp e) (loop for part in (cdr e) append (circuits-powers part)))
        ((and (mexptp e) (integerp (caddr e)))
         (loop for (factor . exponent) in (circuits-powers (cadr e))
               collect (cons factor (* exponent (caddr e)))))
        (t (list (cons e 1)))))

(defun circuits-outside-number-p (e) (and (algebra-rational-number e) t))

;;; A circuit whose branches do not determine it has no order: then there is the reason.

(defun $circuits_solution_or_why (circuit)
  "What circuits_opened_tableau gives, or the text of the error that it ends in."
  (let* ((text nil)
         (found (let (($errormsg nil) ($error $error))
                  (or (errcatch (mfuncall '$circuits_opened_tableau circuit))
                      (progn (setq text (car (last $error))) nil)))))
    (if found (car found) (core-unnamed text))))
