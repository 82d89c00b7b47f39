;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The judge of a circuit's rates, in numbers at a random point with random rates r of the states,
;;; by the rows as they were typed: each element obeys its law, and Kirchhoff's laws hold for all
;;; nodes and branches but for what M r - X leaves in the inductors and capacitors that have states
;;; of their own. The rates of dependent states are quotients of differences.
;;; See circuits-check-rates first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/element_laws" "circuits/elements" "circuits/graph"
                "circuits/rates_by_branches" "circuits/tree" "forms/agreement" "forms/fixed"
                "forms/judge" "forms/program_judge" "forms/rates" "forms/value"))

(defstruct circuits-trial
  run point   ; a random point, with the values of dependent states under their names
  rates       ; name of a state -> rate
  left        ; number of a branch -> what X - M r leaves in it
  currents voltages) ; vectors of numbers: those of the branches, voltages along their arrows

(defun circuits-check-rates (run mass right balance)
  "BALANCE: the integral of energy, or nil."
  (let* ((point (forms-new-point t))
         (pairs (catch 'forms-no-value
                  (let ((trial (circuits-new-trial run point mass right)))
                    (circuits-set-flows trial)
                    (append (circuits-law-pairs trial) (circuits-kirchhoff-pairs trial)
                            (and balance (circuits-balance-pairs trial balance)))))))
    (forms-verdict-of (format nil "Kirchhoff's laws~:[~;, the balance of energy~] and the laws of ~
                                   the elements at a random point" balance)
                      (or pairs '((nil))) point)))

(defun circuits-own-branches (run)
  "Numbers of the branches with states of their own, in the order of the states."
  (append (circuits-numbers run inductors) (circuits-numbers run capacitors)))

(defun circuits-state-name (run number) (circuits-branch-state (circuits-run-branch run number)))

(defun circuits-new-trial (run point mass right)
  (let ((trial (make-circuits-trial :run run :point point :rates (make-hash-table :test #'eq)
                                    :left (make-hash-table))))
    (dolist (k (circuits-own-branches run))
      (let ((x (circuits-state-name run k)))
        (setf (gethash x (circuits-trial-rates trial))
              (forms-random-value (list '(mtimes) 7 x)))))
    (circuits-set-dependent-states trial)
    (circuits-set-left trial mass right)
    trial))

(defun circuits-set-dependent-states (trial)
  "Values and rates of the states that depend on others."
  (let ((point (circuits-trial-point trial)) (rates (circuits-trial-rates trial)))
    (loop for (name . element) in (circuits-known-states (circuits-trial-run trial))
          for function = (circuits-value-function element)
          for slope = (first (forms-slopes-along (list function) point
                                                 (circuits-direction trial)))
          collect (list name (funcall function point) (or slope (forms-no-value name))) into found
          finally (loop for (name value slope) in found
                        do (forms-set-place name value point)
                           (setf (gethash name rates) slope)))))

(defun circuits-known-states (run)
  (loop for name being the hash-keys of (circuits-run-known run) using (hash-value element)
        collect (cons name element)))

(defun circuits-value-function (element)
  (lambda (point) (first (forms-program-values (list element) point))))

(defun circuits-direction (trial)
  "((name . rate) ..) of the time and the independent states."
  (acons '$t (ash 1 forms-digits)
         (loop for x being the hash-keys of (circuits-trial-rates trial) using (hash-value rate)
               collect (cons x rate))))

(defun circuits-set-left (trial mass right)
  (let* ((run (circuits-trial-run trial)) (point (circuits-trial-point trial))
         (numbers (circuits-own-branches run))
         (rates (coerce (mapcar (lambda (k) (circuits-rate-of trial k)) numbers) 'vector))
         (values (forms-program-values
                  (append right (loop for row in mass append (mapcar #'cdr row))) point))
         (left (loop for nil in right collect (pop values))))
    (loop for k in numbers
          for row in mass
          for x in left
          do (loop for (j) in row
                   do (decf x (forms-fixed-times (pop values) (aref rates j))))
             (setf (gethash k (circuits-trial-left trial)) x))))

(defun circuits-rate-of (trial number)
  (gethash (circuits-state-name (circuits-trial-run trial) number) (circuits-trial-rates trial)))

;;; Currents and voltages of all branches.

(defun circuits-set-flows (trial)
  "Those that the run knows, and those of sources, inductors and capacitors."
  (let ((run (circuits-trial-run trial)))
    (setf (circuits-trial-currents trial) (circuits-numbers-of trial (circuits-run-currents run) 1)
          (circuits-trial-voltages trial)
          (circuits-numbers-of trial (circuits-run-voltages run) (circuits-run-sign run)))
    (loop for branch across (circuits-run-branches run)
          for k = (circuits-branch-number branch)
          do (case (circuits-branch-type branch)
               (|$l| (circuits-put trial #'circuits-trial-voltages k
                                 (circuits-induced-voltage trial branch)))
               (|$c| (circuits-put trial #'circuits-trial-currents k
                                 (circuits-charging-current trial branch)))))
    (dolist (k (circuits-numbers run current_sources))
      (circuits-put trial #'circuits-trial-voltages k
                    (circuits-sum-along trial (circuits-loop-row run k)
                                        (circuits-trial-voltages trial))))
    (dolist (k (circuits-numbers run voltage_sources))
      (circuits-put trial #'circuits-trial-currents k
                    (- (circuits-sum-along trial (circuits-cut-row run k)
                                           (circuits-trial-currents trial)))))))

(defun circuits-put (trial reader number value)
  (setf (aref (funcall reader trial) (1- number)) value))

(defun circuits-numbers-of (trial elements factor)
  "The vector ELEMENTS in numbers, times FACTOR; 0 where there is none."
  (let ((values (forms-program-values (remove nil (coerce elements 'list))
                                      (circuits-trial-point trial))))
    (map 'vector (lambda (element) (if element (* factor (pop values)) 0)) elements)))

(defun circuits-sum-along (trial row numbers)
  (let ((weights (forms-program-values (mapcar #'cdr row) (circuits-trial-point trial))))
    (loop for (k) in row
          for weight in weights
          sum (forms-fixed-times weight (aref numbers (1- k))))))

(defun circuits-number (trial e) (forms-fixed-value e (circuits-trial-point trial)))

(defun circuits-left-in (trial number) (gethash number (circuits-trial-left trial) 0))

(defun circuits-induced-voltage (trial branch)
  (let* ((number (circuits-branch-number branch)) (run (circuits-trial-run trial))
         (voltage (forms-fixed-times (circuits-number trial (circuits-branch-value branch))
                                     (circuits-rate-of trial number))))
    (dolist (coupling (circuits-numbers run couplings))
      (let ((pair (list (circuits-coupling-one coupling) (circuits-coupling-other coupling))))
        (when (member number pair)
          (incf voltage (forms-fixed-times
                         (circuits-number trial (circuits-coupling-mutual coupling))
                         (circuits-rate-of trial (first (remove number pair))))))))
    (+ voltage (circuits-left-in trial number))))

(defun circuits-charging-current (trial branch)
  (let ((number (circuits-branch-number branch)))
    (* (circuits-run-sign (circuits-trial-run trial))
       (+ (forms-fixed-times (circuits-number trial (circuits-branch-value branch))
                             (circuits-rate-of trial number))
          (circuits-left-in trial number)))))

;;; What must agree.

(defun circuits-law-pairs (trial)
  "(found . expected) of each resistor and source."
  (loop for branch across (circuits-run-branches (circuits-trial-run trial))
        for k from 0
        for current = (aref (circuits-trial-currents trial) k)
        for voltage = (aref (circuits-trial-voltages trial) k)
        for pair = (circuits-law-pair trial branch current
                                      (* (circuits-run-sign (circuits-trial-run trial)) voltage)
                                      voltage)
        when pair collect pair))

(defun circuits-law-pair (trial branch current voltage along)
  "VOLTAGE in the direction of the states, ALONG the arrow."
  (flet ((value () (circuits-number trial (circuits-branch-value branch))))
    (case (circuits-branch-type branch)
      (|$r| (cons voltage (forms-fixed-times (value) current)))
      (|$ru| (cons current (circuits-law-number trial branch voltage)))
      (|$ri| (cons voltage (circuits-law-number trial branch current)))
      (|$e| (cons along (value)))
      (|$i| (cons current (value))))))

(defun circuits-law-number (trial branch argument)
  (circuits-number trial
                   (mfuncall '$circuits_law (circuits-branch-value branch)
                             (div argument (ash 1 forms-digits))
                             (circuits-network-laws
                              (circuits-run-network (circuits-trial-run trial))))))

(defun circuits-kirchhoff-pairs (trial)
  (let* ((network (circuits-run-network (circuits-trial-run trial)))
         (ends (mfuncall '$map '$circuits_ends (circuits-network-branches network))))
    (flet ((zeros (numbers) (mapcar (lambda (x) (cons x 0)) (cdr numbers)))
           (list-of (vector) (cons '(mlist simp) (coerce vector 'list))))
      (if (cdr (circuits-network-transformers network))
          (circuits-winding-pairs trial network)
          (append (zeros ($circuits_current_sums
                          ends (list-of (circuits-trial-currents trial))))
                  (zeros ($circuits_voltage_gaps
                          ends (list-of (circuits-trial-voltages trial)))))))))

;;; What is stored grows by what M r - X leaves, and by what the other branches feed.

(defun circuits-balance-pairs (trial balance)
  (let ((value (forms-first-integral-value balance)) (power (forms-first-integral-power balance)))
    (list (cons (first (forms-slopes-along (list (circuits-value-function value))
                                           (circuits-trial-point trial)
                                           (circuits-direction trial)))
                (- (+ (first (forms-program-values (list power) (circuits-trial-point trial)))
                      (circuits-left-power trial)))))))

(defun circuits-left-power (trial)
  (loop for k in (circuits-own-branches (circuits-trial-run trial))
        sum (forms-fixed-times (circuits-left-in trial k)
                               (forms-variable-value
                                (circuits-state-name (circuits-trial-run trial) k)
                                (circuits-trial-point trial)))))

;;; With transformers: are there currents of the windings, and potentials of the nodes, with which
;;; the laws hold?

(defun circuits-winding-pairs (trial network)
  (let* ((branches (circuits-network-branches network))
         (transformers (circuits-network-transformers network))
         (rows (circuits-number-rows
                trial (mfuncall '$circuits_node_rows branches transformers)
                (+ (length (cdr branches)) (length (cdr transformers)))))
         (count (length (cdr branches)))
         (sums (mapcar (lambda (row)
                         (forms-fixed-dot row (coerce (circuits-trial-currents trial) 'list)))
                       rows))
         (voltages (append (coerce (circuits-trial-voltages trial) 'list)
                           (mapcar (constantly 0) (cdr transformers)))))
    (list (circuits-in-span (forms-transposed (mapcar (lambda (row) (nthcdr count row)) rows)) sums)
          (circuits-in-span rows voltages))))

(defun circuits-number-rows (trial rows length)
  (loop for row in (cdr rows)
        collect (let ((numbers (make-list length :initial-element 0)))
                  (loop for (nil place value) in (cdr row)
                        do (incf (nth (1- place) numbers) (circuits-number trial value)))
                  numbers)))

(defun circuits-in-span (rows item)
  "(0 . 0) where ITEM is a combination of ROWS, else a pair that differs."
  (cons 0 (if (forms-in-echelon-p item (values (forms-echelon rows (length item))))
              0
              (forms-fixed 1))))
