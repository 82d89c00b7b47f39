;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Lists of conditions that hold together: whether they contradict each other, which of them are
;;; needless, whether one list implies another. Cases are compared with each other this way.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/points_of_facts" "algebra/sign" "algebra/size"
                "analysis/known_conditions"))

(defmacro analysis-where (conditions &body body)
  "The value of BODY where CONDITIONS, a list of Maxima's, hold too."
  `(let ((*core-facts* (append (core-plain-relations (cdr ,conditions)) (core-facts))))
     ,@body))

(defun $analysis_too_many (lists)
  "Whether the size of LISTS times their comparisons is so large that nothing is judged of them."
  (> (* (length (cdr lists)) (algebra-size lists)) (core-sized 40000)))

(defun $analysis_short (conditions)
  "Those of which it is worth while to reason."
  (cons '(mlist simp) (remove-if #'$analysis_too_long (cdr conditions))))

(defun $analysis_impossible (conditions)
  "They compare real numbers: what stands under a square root is not negative."
  (let ((short ($analysis_short conditions)))
    ($algebra_contradictory (append short (cdr ($analysis_radicands short))))))

(defun $analysis_necessary (conditions)
  "Without those that follow from the others: 15 - 2*a > 0 where 6 - a > 0."
  (let ((kept (cdr conditions)))
    (when (and (cdr kept) (not ($analysis_too_many conditions)))
      (dolist (c (cdr conditions))
        (let ((others (remove c kept :test #'alike1)))
          (when (analysis-where (cons '(mlist) others) ($analysis_known c))
            (setq kept others)))))
    (cons '(mlist simp) kept)))

(defun $analysis_narrower (conditions others)
  "Whether all of OTHERS hold where CONDITIONS do; of long ones only those are compared at sight."
  (if (> (+ 1 (algebra-size conditions) (algebra-size others)) 400)
      (subsetp (cdr others) (cdr conditions) :test #'alike1)
      (analysis-where conditions
        (every (lambda (c) (or ($analysis_beyond c conditions) ($analysis_known c)))
               (cdr others)))))

(defun $analysis_all_surely (others conditions)
  "The same, = too, of conditions of any length."
  (analysis-where conditions
    (every (lambda (c) (or (member c (cdr conditions) :test #'alike1) (analysis-surely-p c)))
           (cdr others))))

(defun $analysis_seen_outside (conditions others)
  "Whether a point was seen at which CONDITIONS hold and none of OTHERS, lists of them."
  (analysis-where conditions
    (algebra-point-outside-p (core-facts)
                             (mapcar (lambda (other) (core-plain-relations (cdr other)))
                                     (cdr others)))))

(defun analysis-surely-p (c)
  (or ($analysis_known c)
      (and (mequalp c) (eq ($algebra_sign ($analysis_difference c)) '$zero))))

(defun $analysis_zeros_among (conditions)
  "Those that say x = 0 of a name x."
  (cons '(mlist simp)
        (remove-if-not (lambda (c) (and (mequalp c) (symbolp (cadr c)))) (cdr conditions))))
