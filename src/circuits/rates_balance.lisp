;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The balance of energy of a circuit: what inductors and capacitors store, sum L i^2/2 + C u^2/2 +
;;; M i1 i2, and what all other branches take, sum u i, as resistors do, or feed, as sources may.
;;; The first and the integral of the second over the time stay constant (B. D. H. Tellegen, A
;;; general network theorem, 1952). See circuits-balance first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "circuits/elements" "circuits/labels"
                "circuits/rates_by_branches" "forms/dynamics" "forms/rates"
                "forms/rates_integrals"))

(defun circuits-balance (run states)
  "Two values: the integral of RUN as forms-rates has it, and nil; or nil and why it is not given."
  (let ((terms (circuits-stored-terms run)) (fault (circuits-balance-fault run states)))
    (if fault
        (values nil (format nil "energy: ~a" fault))
        (forms-first-integral '$energy (algebra-program-sum terms) (forms-size-of terms)
                              (circuits-taken-power run)))))

(defun circuits-stored-terms (run)
  (flet ((half-square (value x)
           (algebra-program-multiply (algebra-program-multiply 1/2 value)
                                     (algebra-program-multiply x x))))
    (append
     (loop for branch across (circuits-run-branches run)
           for k = (circuits-branch-number branch)
           append (case (circuits-branch-type branch)
                    (|$l| (list (half-square (circuits-value run branch)
                                             (circuits-current run k))))
                    (|$c| (list (half-square (circuits-value run branch)
                                             (circuits-voltage run k))))))
     (loop for coupling in (circuits-numbers run couplings)
           collect (algebra-program-multiply
                    (circuits-element run (circuits-coupling-mutual coupling))
                    (algebra-program-multiply
                     (circuits-current run (circuits-coupling-one coupling))
                     (circuits-current run (circuits-coupling-other coupling))))))))

(defun circuits-balance-fault (run states)
  (loop for branch across (circuits-run-branches run)
        for label = (core-words (list (circuits-branch-label branch)))
        do (if (circuits-store-p branch)
               (when (forms-depends-p (list (circuits-value run branch)) states)
                 (return (format nil "what ~a stores is not L*i^2/2 or C*u^2/2" label)))
               (unless (circuits-flow run branch)
                 (return (format nil "the power of ~a depends on rates" label))))))

;;; What a branch takes that stores nothing. Its current or voltage may still be unknown: of a
;;; source it is a sum over its cut or loop.

(defun circuits-flow (run branch)
  "(voltage . current) of BRANCH in the direction of the states, nil where they are not known."
  (let* ((k (circuits-branch-number branch))
         (voltage (or (circuits-voltage run k)
                      (and (circuits-row-known-p (circuits-loop-row run k) #'circuits-voltage run)
                           (circuits-along-loop run k))))
         (current (or (circuits-current run k)
                      (and (circuits-row-known-p (circuits-cut-row run k) #'circuits-current run)
                           (circuits-through-cut run k)))))
    (and voltage current (cons voltage current))))

(defun circuits-row-known-p (row quantity run)
  (loop for (k) in row always (funcall quantity run k)))

(defun circuits-taken-power (run)
  (algebra-program-multiply
   (circuits-run-sign run)
   (algebra-program-sum
    (loop for branch across (circuits-run-branches run)
          unless (circuits-store-p branch)
            collect (destructuring-bind (voltage . current) (circuits-flow run branch)
                      (algebra-program-multiply voltage current))))))
