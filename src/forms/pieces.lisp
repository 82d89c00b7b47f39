;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; piecewise([condition, value], ..) after names in it got values: the first value whose condition
;;; holds. Maxima knows no such function and would leave [1 > 0, 2] as it stands.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/sign"))

(defun forms-piecewise (pieces)
  "The value of PIECES, or piecewise of those whose condition may hold."
  (let ((open '()))
    (dolist (piece pieces (forms-open-pieces open))
      (case (forms-condition-truth (second piece))
        (yes (return (if open
                         (forms-open-pieces (cons (list '(mlist simp) t (third piece)) open))
                         (third piece))))
        (unknown (push piece open))))))

(defun forms-open-pieces (pieces)
  (unless pieces (core-error "piecewise has no value where none of its conditions holds"))
  (cons '($piecewise simp) (reverse pieces)))

(defun forms-condition-truth (condition)
  "yes, no or unknown, under the facts of the call."
  (cond ((member condition '(t $otherwise)) 'yes)
        ((or (atom condition) (not (member (caar condition) '(mgreaterp mgeqp mlessp mleqp))))
         'unknown)
        (t (let ((sign ($algebra_sign (sub (second condition) (third condition)))))
             (ecase (caar condition)
               (mgreaterp (forms-truth sign '($pos) '($neg $zero $nz)))
               (mgeqp (forms-truth sign '($pos $zero $pz) '($neg)))
               (mlessp (forms-truth sign '($neg) '($pos $zero $pz)))
               (mleqp (forms-truth sign '($neg $zero $nz) '($pos))))))))

(defun forms-truth (sign holding failing)
  (cond ((member sign holding) 'yes)
        ((member sign failing) 'no)
        (t 'unknown)))
