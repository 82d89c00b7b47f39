;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; piecewise whose conditions share relations, as t < 2 and t >= 2: with h 1 where d > 0 and else 0
;;; it is h*f_1 + (1 - h)*f_0, f_1 and f_0 what it is in the two cases. So its jump at d = 0 is
;;; f_1 - f_0, where a step for each condition would make two of one. Each relation is d > 0 or its
;;; contrary, so that values at borders stay. See algebra-pieces-expanded first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/nouns"))

(defparameter *algebra-most-relations* 6)

(defun algebra-pieces-expanded (pieces leaf join)
  "(JOIN d f_1 f_0) of what LEAF gives for the values of PIECES, [condition, value], ..; nil where
no relation stands twice in them, they are many, or there are cases without a piece."
  (let* ((all (loop for (nil condition nil) in pieces append (algebra-relations-in condition)))
         (distinct (remove-duplicates all :test #'alike1)))
    (and (< (length distinct) (length all))
         (<= (length distinct) *algebra-most-relations*)
         (catch 'no-piece (algebra-pieces-under pieces '() leaf join)))))

(defun algebra-pieces-under (pieces known leaf join)
  "KNOWN: (d . whether d > 0), .."
  (unless pieces (throw 'no-piece nil))
  (destructuring-bind (condition value) (cdar pieces)
    (let ((truth (algebra-condition-under condition known)))
      (flet ((in-case (above)
               (algebra-pieces-under pieces (acons truth above known) leaf join)))
        (case truth
          (:holds (funcall leaf value))
          (:fails (algebra-pieces-under (cdr pieces) known leaf join))
          (t (funcall join truth (in-case t) (in-case nil))))))))

(defun algebra-relation-parts (relation)
  "Two values: d, and whether RELATION is d > 0, else its contrary."
  (destructuring-bind (x y) (cdr relation)
    (ecase (caar relation)
      (mgreaterp (values (sub x y) t))
      (mlessp (values (sub y x) t))
      (mgeqp (values (sub y x) nil))
      (mleqp (values (sub x y) nil)))))

(defun algebra-relations-in (condition)
  (cond ((not (algebra-call-p condition)) '())
        ((member (caar condition) '(mgreaterp mgeqp mlessp mleqp))
         (list (values (algebra-relation-parts condition))))
        ((member (caar condition) '(mand mor mnot))
         (loop for part in (cdr condition) append (algebra-relations-in part)))))

(defun algebra-condition-under (condition known)
  ":holds, :fails, or a difference on whose sign it depends."
  (flet ((parts () (mapcar (lambda (part) (algebra-condition-under part known)) (cdr condition))))
    (cond ((member condition '(t $otherwise)) :holds)
          ((null condition) :fails)
          ((atom condition) (throw 'no-piece nil))
          (t (case (caar condition)
               ((mgreaterp mgeqp mlessp mleqp) (algebra-relation-under condition known))
               (mand (algebra-truth-of-all (parts) :fails :holds))
               (mor (algebra-truth-of-all (parts) :holds :fails))
               (mnot (algebra-contrary (car (parts))))
               (t (throw 'no-piece nil)))))))

(defun algebra-contrary (truth)
  (case truth (:holds :fails) (:fails :holds) (t truth)))

(defun algebra-relation-under (relation known)
  (multiple-value-bind (d plain) (algebra-relation-parts relation)
    (let ((entry (assoc d known :test #'alike1)))
      (cond ((null entry) d)
            ((eq plain (cdr entry)) :holds)
            (t :fails)))))

(defun algebra-truth-of-all (truths decisive otherwise)
  "DECISIVE where one of TRUTHS is, else a difference among them, else OTHERWISE."
  (cond ((member decisive truths) decisive)
        ((find-if-not #'keywordp truths))
        (t otherwise)))
