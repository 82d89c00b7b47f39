;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A tie, 0 = a*x + b*y + .., gives a state and its rate by the others where a, b, .. are free of
;;; states. In a tie that is made of rows of rates stand inductances and capacitances, and with them
;;; states: a factor of all its terms goes; what is left then is no linear equation, and is refused.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal" "circuits/coefficients" "circuits/elements" "circuits/tableau"))

(defun circuits-linear-tie (tableau tie)
  "The row TIE, or it without a factor in which states stand, and that factor."
  (if (circuits-free-of-states-p tableau tie)
      tie
      (let* ((factor (cdar (circuits-row-entries tie))) (row (circuits-row-over tie factor)))
        (unless (circuits-free-of-states-p tableau row) (circuits-refuse-curved-tie tableau))
        (values row factor))))

(defun circuits-row-over (row factor)
  (let ((result (circuits-new-row)))
    (maphash (lambda (column x)
               (circuits-add-entry
                result column
                (circuits-inside (algebra-normal-form
                                  (circuits-outside (circuits-over x factor))))))
             row)
    result))

(defun circuits-free-of-states-p (tableau row)
  (loop for x being the hash-values of row never (circuits-moved-by-states-p tableau x)))

(defun circuits-moved-by-states-p (tableau x)
  "Whether a state stands in the coefficient X."
  (unless (rationalp x)
    (loop for branch across (circuits-tableau-branches tableau)
          thereis (and (circuits-type-in-p branch '|$l| '|$c|)
                       (not (freeof (circuits-branch-state branch) x))))))

(defun circuits-refuse-curved-tie (tableau)
  (core-error "a state would follow from others by an equation that is not linear in them, as the ~
               values of ~{~a~^, ~} depend on states; put a resistor in series with such a ~
               capacitor, or beside such an inductor"
              (circuits-bent-labels tableau)))

(defun circuits-bent-labels (tableau)
  "Words for inductors and capacitors whose values depend on states."
  (loop for branch across (circuits-tableau-branches tableau)
        when (and (circuits-type-in-p branch '|$l| '|$c|)
                  (circuits-moved-by-states-p tableau
                                              (circuits-inside (circuits-branch-value branch))))
          collect (core-words (list (circuits-branch-label branch)))))
