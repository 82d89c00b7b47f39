;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates with numbers for parameters: what vanishes for these numbers vanishes from the program.
;;; The new program is shown to have the values of the old one at a random point. The record is that
;;; of a program with the fields that a run needs. See $numerics_rate_program first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "algebra/program_record" "algebra/size"
                "forms/agreement" "forms/fixed" "forms/program_judge" "forms/rates"
                "forms/value" "numerics/assumed_values" "numerics/element_words"
                "numerics/jacobian" "numerics/program" "numerics/rate_mass" "numerics/sparse"))

;;; Values.

(defun numerics-value-pairs (values)
  "((name . element) ..) in the current program, VALUES being equations."
  (loop for (nil name value) in (cdr values)
        collect (cons name (numerics-value-element name value))))

(defun numerics-value-element (name value)
  (let ((element (algebra-program-element value)))
    (when (or (algebra-open-inputs-of (list element))
              (null (catch 'forms-no-value
                      (forms-program-values (list element) (forms-new-point nil)))))
      (core-error "the value of ~a is a number, found ~a" (core-words (list name))
                  (core-words (list value))))
    element))

(defun numerics-parameter-pairs (values rates)
  "The pairs of VALUES, equations, without those of momenta that are states here; other states have
no fixed value."
  (loop for pair in (numerics-value-pairs values)
        for name = (car pair)
        do (when (and (or (eq name '$t) (member name (forms-rates-states rates) :test #'alike1))
                      (not (member name (forms-rates-momenta rates))))
             (core-error "~a moves and has no fixed value; that at the start belongs into start"
                         (core-words (list name))))
        unless (member name (forms-rates-momenta rates)) collect pair))

;;; Exchange. What vanishes below a line is told with the values that make it vanish.

(defun numerics-exchanged-rates (rates values)
  "RATES in the current program, with their names outside and VALUES, ((name . element) ..)."
  (let ((new (forms-exchanged-rates
              rates
              (algebra-exchange-by (append (numerics-outside-pairs rates) values))
              (lambda (denominator) (numerics-fault-division denominator rates values)))))
    (setf (forms-rates-pairs new) '())
    new))

(defun numerics-outside-pairs (rates)
  (loop for (inside . outside) in (forms-rates-pairs rates)
        collect (cons inside (algebra-program-input outside))))

(defun numerics-fault-division (denominator rates values)
  "The error for a DENOMINATOR of RATES that vanishes with VALUES."
  (let ((guilty (algebra-vanishing-values
                 denominator values
                 (lambda (element) (forms-nought-p (list element) (forms-new-point t)))))
        (guard (find denominator (forms-rates-guards rates) :key #'second)))
    (core-error "~@[with ~{~a~^, ~} ~]the program divides by zero~@[: the pivot of ~a in the mass ~
                 matrix vanishes~]"
                (loop for (name . element) in guilty
                      collect (format nil "~a = ~a" (core-words (list name))
                                      (numerics-value-text element)))
                (and guard (core-words (list (first guard)))))))

;;; The check.

(defun numerics-check-exchange (rates new values)
  "The values of NEW against those of RATES at a random point."
  (let* ((point (numerics-point-with rates values))
         (numbers (numerics-numbers (forms-rates-elements rates) point)))
    (unless numbers (numerics-check-denominators rates values point))
    (forms-verdict-of "values put in: against the program without them"
                      (or (append (mapcar #'cons numbers
                                          (numerics-numbers (forms-rates-elements new) point))
                                  (numerics-integral-pairs rates new point))
                          '((nil)))
                      point)))

(defun numerics-integral-pairs (rates new point)
  "The values of the integrals that NEW has, those of RATES beside them, where they have any."
  (loop for (name . elements) in (forms-rates-integrals new)
        for before = (numerics-numbers (cdr (assoc name (forms-rates-integrals rates))) point)
        for after = (numerics-numbers elements point)
        when (and before after) append (mapcar #'cons before after)))

(defun numerics-numbers (elements point)
  (catch 'forms-no-value (forms-program-values elements point)))

(defun numerics-point-with (rates values)
  "A random point where states have one value under both of their names, and parameters VALUES."
  (let ((point (forms-new-point t)))
    (loop for (inside . outside) in (forms-rates-pairs rates)
          do (forms-set-place inside (forms-variable-value outside point) point))
    (loop for (name . element) in values
          do (forms-set-place name (first (forms-program-values (list element) point)) point))
    point))

(defun numerics-check-denominators (rates values point)
  "An error for the first denominator of RATES that vanishes at the POINT with VALUES, though not at
sight."
  (dolist (node (algebra-live-nodes (forms-rates-elements rates)))
    (when (eq (algebra-node-operation node) :divide)
      (let ((value (first (numerics-numbers (list (algebra-node-right node)) point))))
        (cond ((null value) (return nil))
              ((forms-negligible-p value)
               (numerics-fault-division (algebra-node-right node) rates values)))))))

;;; The record.

(defun numerics-mass-outputs (rates)
  (let ((rows (forms-rates-mass rates)))
    (when rows
      (list (cons '$mass
                  (cons :matrix (numerics-full-rows rows)))))))

(defun numerics-full-rows (rows)
  (loop with n = (length rows)
        for row in rows
        collect (let ((full (make-array n :initial-element 0)))
                  (loop for (j . element) in row do (setf (aref full j) element))
                  (coerce full 'list))))

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
                 (append (forms-rates-outputs rates) (numerics-mass-outputs rates)
                         (numerics-guard-outputs rates)))))
    (flet ((field (name list) (algebra-field name (cons '(mlist simp) list))))
      (append record
              (list (field '$states (forms-rates-states rates))
                    (field '$angles (forms-rates-angles rates))
                    (algebra-field '$split (or (forms-rates-split rates) 0))
                    (field '$cyclic (forms-rates-cyclic rates))
                    (field '$guarded (mapcar #'first (forms-rates-guards rates))))
              more))))

(defun numerics-operations (rates)
  (count-if-not #'algebra-input-p
                (algebra-live-nodes (forms-right-sides rates))))

(defun numerics-entry-fields (rates)
  "How many entries dX_i/dx_j of RATES there are, and [i, j, value] of those that are constant."
  (let* ((program (numerics-program-of rates)) (constants (numerics-constant-slopes program)))
    (list (algebra-field '$entries (loop for set in (numerics-dependences program)
                                         sum (logcount set)))
          (algebra-field
           '$constant_entries
           (cons '(mlist simp)
                 (loop for (i j) in (sort (loop for place being the hash-keys of constants
                                                collect place)
                                          #'numerics-entry-before-p)
                       collect (algebra-list (1+ i) (1+ j)
                                             (algebra-maxima-rational
                                              (gethash (list i j) constants)))))))))

(defun numerics-constant-mass-p (rates)
  (let ((moving (if (forms-rates-split rates)
                    (subseq (forms-rates-states rates) 0 (forms-rates-split rates))
                    (forms-rates-states rates))))
    (numerics-constant-p (append (forms-rates-inertia rates)
                                 (loop for row in (forms-rates-mass rates)
                                       append (mapcar #'cdr row)))
                         moving)))

;;; Rates as a run takes them.

(defun numerics-run-rates (rates pairs solved)
  "RATES in the current program with the values of PAIRS, ((name . element) ..), put in, divided by
M as far as it goes; and whether M is constant."
  (let ((new (numerics-exchanged-rates rates pairs)))
    (numerics-check-exchange rates new pairs)
    (numerics-check-assumed pairs)
    (values (numerics-checked-index (numerics-settled-rates new solved) rates pairs)
            (numerics-constant-mass-p new))))

(defun numerics-operations-without (rates solved)
  "Operations of RATES without values."
  (with-algebra-program
    (numerics-operations (numerics-settled-rates (numerics-exchanged-rates rates '()) solved))))

;;; For Maxima.

(defun $numerics_rate_program (rates values solved)
  "The record of RATES with VALUES, equations name = number."
  (with-algebra-program
    (let ((pairs (numerics-parameter-pairs values rates)))
      (multiple-value-bind (new constant) (numerics-run-rates rates pairs solved)
        (numerics-program-record
         new
         (list* (algebra-field '$mass_constant constant)
                (algebra-field '$operations_before (numerics-operations-without rates solved))
                (algebra-field '$operations_after (numerics-operations new))
                (algebra-field '$zero
                               (cons '(mlist simp)
                                     (loop for (name . element) in pairs
                                           when (eql element 0) collect name)))
                (numerics-entry-fields new)))))))
