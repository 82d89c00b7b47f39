;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of a circuit put together: the matrices B^T L B and B^T C B, sparse, what varying sources
;;; force, and the right sides. See circuits-rates first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_from_expressions"
                "algebra/program_nodes" "circuits/elements" "circuits/rates_balance"
                "circuits/rates_by_branches" "circuits/rates_judge" "forms/rates_impulses"
                "forms/rates"))

;;; What stores energy: branches of one sort, independent ones first. A shift is (row . rate): how
;;; the state of a branch follows from the independent ones, B, and what sources add to its rate.

(defun circuits-shifts (run independent dependent row-of quantity sign)
  "(number . shift) of all branches; ROW-OF gives the loop or cut of a branch, QUANTITY what is
known at the others, SIGN is that of the sum."
  (let ((places (make-hash-table)))
    (loop for k in independent for place from 0 do (setf (gethash k places) place))
    (append
     (loop for k in independent for place from 0 collect (list k (list (cons place 1))))
     (loop for k in dependent
           collect (circuits-dependent-shift k (funcall row-of run k) places quantity sign)))))

(defun circuits-dependent-shift (number row places quantity sign)
  (list* number
         (loop for (other . value) in row
               for place = (gethash other places)
               when place collect (cons place (algebra-program-multiply sign value)))
         (algebra-program-multiply
          sign (circuits-time-slope
                (circuits-row-sum row (lambda (k) (and (not (gethash k places))
                                                       (funcall quantity k))))))))

(defun circuits-time-slope (element)
  (first (algebra-program-rates (list element) (list (cons (algebra-program-input '$t) 1)))))

(defun circuits-storage-entries (run numbers)
  "((one other element) ..): values of the branches NUMBERS, and mutual inductances twice."
  (append
   (loop for k in numbers
         collect (list k k (circuits-value run (circuits-run-branch run k))))
   (loop for coupling in (circuits-numbers run couplings)
         for one = (circuits-coupling-one coupling)
         for other = (circuits-coupling-other coupling)
         for mutual = (circuits-element run (circuits-coupling-mutual coupling))
         when (member one numbers)
           append (list (list one other mutual) (list other one mutual)))))

(defun circuits-reduced-storage (entries shifts n)
  "Two lists: the N sparse rows of B^T S B, and B^T S b'."
  (let ((rows (make-array n :initial-element '())) (forced (make-array n :initial-element 0)))
    (flet ((shift (number) (cdr (assoc number shifts))))
      (loop for (one other element) in entries
            do (loop for (i . weight) in (car (shift one))
                     for product = (algebra-program-multiply weight element)
                     do (setf (aref forced i)
                              (algebra-program-add
                               (aref forced i)
                               (algebra-program-multiply product (or (cdr (shift other)) 0))))
                        (loop for (j . value) in (car (shift other))
                              do (setf (aref rows i)
                                       (circuits-entry-added
                                        (aref rows i) j
                                        (algebra-program-multiply product value)))))))
    (values (coerce rows 'list) (coerce forced 'list))))

;;; Both halves.

(defun circuits-half (run readers row-of quantity sign right)
  "Two lists, rows of the matrix and right sides, of the branches that READERS give, (independent
dependent); RIGHT gives what Kirchhoff's laws leave for a branch."
  (destructuring-bind (independent dependent)
      (mapcar (lambda (reader) (cdr (funcall reader (circuits-run-network run))))
              readers)
    (multiple-value-bind (rows forced)
        (circuits-reduced-storage
         (circuits-storage-entries run (append independent dependent))
         (circuits-shifts run independent dependent row-of quantity sign)
         (length independent))
      (values rows
              (loop for k in independent
                    for f in forced
                    collect (algebra-program-subtract
                             (funcall right run k (circuits-run-sign run)) f))))))

(defun circuits-shifted-rows (rows places)
  (loop for row in rows
        collect (loop for (j . element) in row collect (cons (+ j places) element))))

(defun circuits-rates (network)
  (let ((run (circuits-new-run network)))
    (circuits-set-states run)
    (circuits-set-resistors run)
    (multiple-value-bind (i-rows i-right)
        (circuits-half run '(circuits-network-inductors circuits-network-dependent_inductors)
                       #'circuits-cut-row
                       (lambda (k) (circuits-current run k)) -1
                       #'circuits-along-loop)
      (multiple-value-bind (u-rows u-right)
          (circuits-half run '(circuits-network-capacitors circuits-network-dependent_capacitors)
                         #'circuits-loop-row
                         (lambda (k) (circuits-voltage run k)) 1
                         #'circuits-through-cut)
        (let ((mass (append i-rows (circuits-shifted-rows u-rows (length i-rows))))
              (right (append i-right u-right)))
          (circuits-rates-record run mass right))))))

(defun circuits-rates-record (run mass right)
  (let* ((network (circuits-run-network run))
         (states (append (cdr (circuits-network-currents network))
                         (cdr (circuits-network-voltages network)))))
    (multiple-value-bind (balance untold) (circuits-balance run states)
      (circuits-check-rates run mass right balance)
      (make-forms-rates
       :program *algebra-program* :states states :mass mass
       :outputs (list (cons '$rates (cons :list right)))
       :angles (forms-angles states right)
       :integrals (and balance (list balance)) :untold (and untold (list untold))))))

;;; For Maxima.

(defun $circuits_rates_of_network (network)
  (with-algebra-program (forms-with-impulses (circuits-rates network))))
