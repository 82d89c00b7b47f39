;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Equations as a run takes them: M x' = X(t, x), X elements of a program. Every room makes such a
;;; record of its systems, numerics takes it. Which states are angles is seen in the program, too:
;;; what occurs in sines and cosines alone is known up to whole turns.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "algebra/program_record"))

(core-record forms-rates
  "PROGRAM is what the elements belong to. STATES and PAIRS, (inside . outside), are names; the
OUTPUTS ((name . value) ..) have X as `rates'. MASS: nil for the identity, else a sparse row
((j . element) ..) for each state, j from 0. A guard is (name pivot . whole): a pivot of a
factorisation, what is divided by, and the size that it is of where it is not small. SPLIT: nil, or
the number n where x = (q, v), q' = v. CYCLIC: coordinates whose velocities are the output
`quadratures'; MOMENTA: those of the states that are parameters in other forms. INERTIA: elements
that depend on states that are no velocities, or on the time, where M does. IMPULSES: see
rates_impulses.lisp. INTEGRALS: a list of forms-first-integral; UNTOLD: what is not given of such,
sentences."
  program states pairs outputs (mass nil) (guards nil) (angles nil) (split nil) (cyclic nil)
  (momenta nil) (inertia nil) (impulses nil) (integrals nil) (untold nil))

(defun forms-first-integral (name value size &optional (power 0))
  "VALUE plus the integral of POWER over the time is constant along every motion; VALUE is a sum,
perhaps a small one, of parts as large as SIZE. A list, for what is done to all elements alike."
  (list name value size power))

(defun forms-first-integral-name (integral) (first integral))
(defun forms-first-integral-value (integral) (second integral))
(defun forms-first-integral-size (integral) (third integral))
(defun forms-first-integral-power (integral) (fourth integral))

(defun $forms_start_of_others (rates start)
  "The equations of the list START for names that are no states of RATES."
  (cons '(mlist simp)
        (and ($listp start)
             (remove-if (lambda (equation)
                          (or (atom equation) (not (eq (caar equation) 'mequal))
                              (member (second equation) (forms-rates-states rates)
                                      :test #'alike1)))
                        (cdr start)))))

(defun forms-put (elements pairs)
  "ELEMENTS with other elements for some inputs, PAIRS (name . element)."
  (algebra-exchanged elements (algebra-exchange-by pairs)))

(defun forms-rates-elements (rates)
  "All elements of RATES but its integrals."
  (append (algebra-all-outputs (forms-rates-outputs rates))
          (loop for row in (forms-rates-mass rates) append (mapcar #'cdr row))
          (loop for (nil pivot . whole) in (forms-rates-guards rates)
                append (list pivot whole))
          (forms-rates-inertia rates)
          (loop for (u . gaps) in (forms-rates-impulses rates)
                append (cons u (mapcar #'cdr gaps)))))

(defun forms-right-sides (rates)
  "The elements of X."
  (algebra-output-elements (cdr (assoc '$rates (forms-rates-outputs rates)))))

(defun forms-set-right-sides (rates elements)
  (setf (forms-rates-outputs rates)
        (acons '$rates (cons :list elements)
               (remove '$rates (forms-rates-outputs rates) :key #'car))))

(defun forms-exchanged-rates (rates exchange fault)
  "RATES in the current program, with EXCHANGE and FAULT as algebra-exchanged takes them."
  (let ((copy (copy-forms-rates rates))
        (found (algebra-exchanged (forms-rates-elements rates) exchange fault)))
    (flet ((next (element) (declare (ignore element)) (pop found)))
      (setf (forms-rates-program copy) *algebra-program*
            (forms-rates-outputs copy) (forms-mapped-outputs #'next (forms-rates-outputs rates))
            (forms-rates-mass copy) (loop for row in (forms-rates-mass rates)
                                          collect (loop for (j . element) in row
                                                        collect (cons j (next element))))
            (forms-rates-guards copy) (loop for (name pivot . whole) in (forms-rates-guards rates)
                                            collect (list* name (next pivot) (next whole)))
            (forms-rates-inertia copy) (mapcar #'next (forms-rates-inertia rates))
            (forms-rates-impulses copy) (loop for (u . gaps) in (forms-rates-impulses rates)
                                              collect (cons (next u)
                                                            (loop for (i . gap) in gaps
                                                                  collect (cons i (next gap)))))
            (forms-rates-integrals copy) (forms-exchanged-integrals rates exchange)))
    copy))

(defun forms-exchanged-integrals (rates exchange)
  "The integrals of RATES; without those that have no value then."
  (loop for (name . elements) in (forms-rates-integrals rates)
        for found = (catch 'forms-no-integral
                      (algebra-exchanged elements exchange
                                         (lambda (denominator)
                                           (declare (ignore denominator))
                                           (throw 'forms-no-integral nil))))
        when found collect (cons name found)))

(defun forms-mapped-outputs (function outputs)
  (loop for (name . value) in outputs
        collect (cons name
                      (cond ((or (numberp value) (algebra-node-p value)) (funcall function value))
                            ((eq (car value) :list) (cons :list (mapcar function (cdr value))))
                            (t (cons :matrix (loop for row in (cdr value)
                                                   collect (mapcar function row))))))))

;;; Angles.

(defun forms-angles (names elements)
  "Those of NAMES that occur in ELEMENTS, and there in sines and cosines alone: by themselves, or in
sums with whole or fractional multiples."
  (let ((plain (make-hash-table)) (turned (make-hash-table)) (nodes (algebra-live-nodes elements)))
    (flet ((mark (element table)
             (when (algebra-node-p element)
               (setf (gethash (algebra-node-index element) table) t))))
      (dolist (element elements) (mark element plain))
      (dolist (node (reverse nodes))
        (forms-mark-parts node (gethash (algebra-node-index node) plain)
                          (gethash (algebra-node-index node) turned)
                          (lambda (part) (mark part plain)) (lambda (part) (mark part turned))))
      (remove-if-not (lambda (name)
                       (let ((index (algebra-node-index (algebra-program-input name))))
                         (and (gethash index turned) (not (gethash index plain)))))
                     names))))

(defun forms-mark-parts (node plain turned mark-plain mark-turned)
  "Marks the parts of NODE, which is used PLAIN, or TURNED as an angle."
  (let ((parts (algebra-node-parts node)))
    (case (algebra-node-operation node)
      ((:sine :cosine) (mapc mark-turned parts))
      (t (let ((linear (or (member (algebra-node-operation node) '(:add :subtract :negate))
                           (algebra-scaled-p node))))
           (when (and turned linear) (mapc mark-turned parts))
           (when (or plain (not linear)) (mapc mark-plain parts)))))))
