;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Walks through formulas, each asked of every condition at every step of solving: what unknowns
;;; occur, whether there is anything but a polynomial, where a formula may have no real value.

(in-package :maxima)

(defun $analysis_present (unknowns e)
  "Those of UNKNOWNS that occur in E."
  (cons '(mlist simp) (remove-if (lambda (x) ($freeof x e)) (cdr unknowns))))

(defun $analysis_may_hide_zeros (e)
  "Whether E has roots or functions, of numbers or of parameters."
  (and (not ($mapatom e))
       (or (not (or (mplusp e) (mtimesp e) (and (mexptp e) (integerp (caddr e)))))
           (some #'$analysis_may_hide_zeros (cdr e)))))

(defun $analysis_parts_with_conditions (e)
  "The parts of E, or of a list, that have a real value under conditions alone: u^r but with whole
r > 0, logarithms, inverse functions; each before those within it."
  (cons '(mlist simp) (analysis-parts-with-conditions e)))

(defun analysis-parts-with-conditions (e)
  (unless ($mapatom e)
    (append (and (if (mexptp e)
                     (or (not (integerp (caddr e))) (minusp (caddr e)))
                     (member (caar e) '(%log %asin %acos %asec %acsc %acosh %atanh %acoth %asech)))
                 (list e))
            (mapcan #'analysis-parts-with-conditions (cdr e)))))
