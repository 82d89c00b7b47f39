;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates with numbers for parameters: what vanishes for these numbers vanishes from the program.
;;; The new program is shown to have the values of the old one at a random point. The record is that
;;; of a program with the fields that a run needs. See $numerics_rate_program first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "algebra/program_record" "forms/agreement"
                "forms/program_judge" "forms/rates" "forms/value"))

;;; Values.

(defun numerics-value-pairs (values)
  "((name . element) ..) in the current program, VALUES being equations."
  (loop for (nil name value) in (cdr values)
        collect (cons name (numerics-value-element name value))))

(defun numerics-value-element (name value)
  (let ((element (algebra-program-element value)))
    (when (remove-if (lambda (input) (member input '($%pi $%e)))
                     (algebra-inputs-of (list element)))
      (core-error "the value of ~a is a number, found ~a" (core-words (list name))
                  (core-words (list value))))
    element))

(defun numerics-refuse-state-values (pairs states)
  (loop for (name) in pairs
        do (when (or (eq name '$t) (member name states :test #'alike1))
             (core-error "~a moves and has no fixed value; that at the start belongs into start"
                         (core-words (list name))))))

;;; Exchange. What vanishes below a line is told with the values that make it vanish.

(defun numerics-exchanged-rates (rates values)
  "RATES in the current program, with their names outside and VALUES, ((name . element) ..)."
  (let* ((copy (copy-forms-rates rates))
         (exchange (algebra-exchange-by (append (numerics-outside-pairs rates) values)))
         (found (algebra-exchanged
                 (forms-rates-elements rates) exchange
                 (lambda (denominator)
                   (numerics-fault-division denominator rates values)))))
    (flet ((next (element) (declare (ignore element)) (pop found)))
      (setf (forms-rates-program copy) *algebra-program*
            (forms-rates-pairs copy) '()
            (forms-rates-outputs copy) (numerics-mapped-outputs #'next (forms-rates-outputs rates))
            (forms-rates-mass copy) (loop for row in (forms-rates-mass rates)
                                          collect (loop for (j . element) in row
                                                        collect (cons j (next element))))
            (forms-rates-guards copy) (loop for (name pivot . whole) in (forms-rates-guards rates)
                                            collect (list* name (next pivot) (next whole)))))
    copy))

(defun numerics-outside-pairs (rates)
  (loop for (inside . outside) in (forms-rates-pairs rates)
        collect (cons inside (algebra-program-input outside))))

(defun numerics-mapped-outputs (function outputs)
  (loop for (name . value) in outputs
        collect (cons name
                      (cond ((or (numberp value) (algebra-node-p value)) (funcall function value))
                            ((eq (car value) :list) (cons :list (mapcar function (cdr value))))
                            (t (cons :matrix (loop for row in (cdr value)
                                                   collect (mapcar function row))))))))

(defun numerics-fault-division (denominator rates values)
  (let ((guilty (algebra-vanishing-values denominator values (lambda (element) (eql element 0))))
        (guard (find denominator (forms-rates-guards rates) :key #'second)))
    (core-error "with ~{~a = ~a~^, ~} the program divides by zero~@[: the pivot of ~a in the mass ~
                 matrix vanishes~]"
                (loop for (name . element) in guilty
                      append (list (core-words (list name)) (numerics-value-text element)))
                (and guard (core-words (list (first guard)))))))

(defun numerics-value-text (element)
  (if (numberp element) (core-words (list (algebra-maxima-rational element))) "its value"))

;;; The check.

(defun numerics-check-exchange (rates new values)
  "The values of NEW against those of RATES at a random point."
  (let ((point (forms-new-point t)))
    (loop for (inside . outside) in (forms-rates-pairs rates)
          do (forms-set-place inside (forms-variable-value outside point) point))
    (loop for (name . element) in values
          do (forms-set-place name (first (forms-program-values (list element) point)) point))
    (flet ((numbers (rates)
             (catch 'forms-no-value
               (forms-program-values (forms-rates-elements rates) point))))
      (forms-verdict-of "values put in: against the program without them"
                        (or (mapcar #'cons (numbers rates) (numbers new)) '((nil)))
                        point))))

;;; The record.

(defun numerics-guard-outputs (rates)
  (let ((guards (forms-rates-guards rates)))
    (when guards
      (list (cons '$pivots (cons :list (mapcar #'second guards)))
            (cons '$guards (cons :list (loop for (nil pivot . whole) in guards
                                             collect (algebra-program-divide pivot whole))))))))

(defun numerics-program-record (rates more)
  "The record of RATES, whose names are those outside; MORE are further fields."
  (let ((record (algebra-program-record
                 (cons '$t (forms-rates-states rates))
                 (append (forms-rates-outputs rates) (numerics-guard-outputs rates)))))
    (flet ((field (name list) (algebra-field name (cons '(mlist simp) list))))
      (append record
              (list (field '$states (forms-rates-states rates))
                    (field '$angles (forms-rates-angles rates))
                    (algebra-field '$split (or (forms-rates-split rates) 0))
                    (field '$guarded (mapcar #'first (forms-rates-guards rates))))
              more))))

(defun numerics-operations (rates)
  (count-if-not #'algebra-input-p
                (algebra-live-nodes (algebra-all-outputs (forms-rates-outputs rates)))))

;;; For Maxima.

(defun $numerics_rate_program (rates values)
  "The record of RATES with VALUES, equations name = number."
  (with-algebra-program
    (let ((pairs (numerics-value-pairs values)))
      (numerics-refuse-state-values pairs (forms-rates-states rates))
      (let ((new (numerics-exchanged-rates rates pairs)))
        (numerics-check-exchange rates new pairs)
        (numerics-program-record
         new
         (list (algebra-field '$operations_before (numerics-operations rates))
               (algebra-field '$operations_after (numerics-operations new))
               (algebra-field '$zero
                              (cons '(mlist simp)
                                    (loop for (name . element) in pairs
                                          when (eql element 0) collect name)))))))))
