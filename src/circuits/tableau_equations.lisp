;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the tableau says, as expressions in the independent states, the sources and their rates:
;;; state equations L*i' = .., C*u' = .., and currents, voltages and potentials. Where states depend
;;; on others, x = B*y + b, the equations are B^T S (B*y + b)' = B^T (voltages, currents), S the
;;; matrix of all inductances and capacitances. Laws of resistors are put in at the end.
;;; See circuits-balances first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/factoring" "algebra/normal"
                "circuits/coefficients" "circuits/element_laws" "circuits/elements"
                "circuits/tableau" "circuits/tableau_reduction"))

;;; Rows in what is given

(defun circuits-final-row (solution row)
  "ROW with what was left open, and dependent states, put in."
  (let ((others (circuits-solution-others solution)))
    (if (zerop (hash-table-count others))
        row
        (let ((result (circuits-new-row)))
          (maphash (lambda (column x) (circuits-add-solved result column x others)) row)
          result))))

(defun circuits-current-row (solution branch)
  (let ((row (circuits-new-row)))
    (circuits-add-solved row (circuits-current-column (circuits-solution-tableau solution) branch)
                         1 (circuits-solution-solved solution))
    (circuits-final-row solution row)))

(defun circuits-difference-row-of (solution pair factor)
  (circuits-final-row solution
                      (circuits-voltage-row (circuits-solution-tableau solution) pair factor
                                            (circuits-solution-solved solution))))

(defun circuits-force-row (solution k)
  "The voltage of an inductor, the current of a capacitor in the direction of its voltage."
  (let* ((tableau (circuits-solution-tableau solution)) (branch (circuits-branch-at tableau k)))
    (if (eq (circuits-branch-type branch) '|$c|)
        (let ((row (circuits-new-row)))
          (circuits-add-multiple row (circuits-tableau-sign tableau)
                                 (circuits-current-row solution branch))
          row)
        (circuits-difference-row-of solution ($circuits_ends branch) 1))))

;;; The balances of the independent states, rows that vanish: what is stored less what flows in

(defun circuits-balances (solution)
  "((number stored . forces) ..), rows: in the first the rates of the independent states."
  (let ((table (circuits-shares solution)))
    (loop for k in (circuits-solution-states solution)
          collect (let ((stored (circuits-new-row)) (forces (circuits-new-row)))
                    (loop for (j . share) in (gethash k table)
                          do (circuits-add-stored solution stored j share)
                             (circuits-add-multiple forces share (circuits-force-row solution j)))
                    (circuits-move-forced solution stored forces)
                    (list* k stored forces)))))

(defun circuits-shares (solution)
  "Table: independent state -> ((state . how it counts there) ..)."
  (let ((table (make-hash-table)) (tableau (circuits-solution-tableau solution)))
    (dolist (k (circuits-solution-states solution)) (setf (gethash k table) (list (cons k 1))))
    (loop for (d . row) in (circuits-solution-dependents solution)
          do (maphash (lambda (column x)
                        (destructuring-bind (sort k &rest rest)
                            (circuits-descriptor tableau column)
                          (declare (ignore rest))
                          (when (eq sort :state) (push (cons d x) (gethash k table)))))
                      row))
    table))

(defun circuits-add-stored (solution row j share)
  (loop for (m . x) in (circuits-stored (circuits-solution-tableau solution) j)
        do (circuits-add-multiple row (circuits-times share (circuits-value-now solution x))
                                  (circuits-rate-of-state solution m))))

(defun circuits-value-now (solution x)
  "The inductance or capacitance X, dependent states in it put in."
  (if (rationalp x)
      x
      (loop for (k . row) in (circuits-solution-dependents solution)
            for name = (circuits-branch-state
                        (circuits-branch-at (circuits-solution-tableau solution) k))
            do (unless (freeof name x)
                 (setq x (circuits-put-value (circuits-row-expression solution row) name x)))
            finally (return (circuits-inside x)))))

(defun circuits-rate-of-state (solution k)
  "The rate of a state by those of the independent ones, as a row."
  (let ((dependent (assoc k (circuits-solution-dependents solution))))
    (if dependent
        (circuits-rate-of-row solution (cdr dependent))
        (let ((row (circuits-new-row)))
          (setf (gethash (circuits-rate-column solution k) row) 1)
          row))))

(defun circuits-move-forced (solution stored forces)
  "What is no rate of a state in STORED goes to FORCES."
  (loop for (column . x) in (circuits-row-entries stored)
        do (unless (eq :rate (car (circuits-descriptor (circuits-solution-tableau solution)
                                                       column)))
             (remhash column stored)
             (circuits-add-entry forces column (circuits-negative x)))))

;;; Laws: the argument of each in what is given, those first on which others depend

(defun circuits-laws-resolved (solution)
  "((name . f(argument)) ..) of the nonlinear resistors."
  (let ((tableau (circuits-solution-tableau solution)) (resolved '())
        (waiting (circuits-law-arguments solution)))
    (loop while waiting
          do (let ((ready (find-if (lambda (item) (circuits-ready-p tableau item waiting))
                                   waiting)))
               (unless ready (circuits-refuse-circle (mapcar #'car waiting)))
               (setq waiting (remove ready waiting))
               (push (cons (circuits-open-law (first ready))
                           (circuits-law-of solution (first ready)
                                            (circuits-laws-put resolved
                                              (circuits-row-expression solution (second ready)))))
                     resolved)))
    resolved))

(defun circuits-law-arguments (solution)
  "((branch row) ..): the arguments of the nonlinear resistors, the last branch first."
  (let ((found '()))
    (loop for branch across (circuits-tableau-branches (circuits-solution-tableau solution))
          do (when (circuits-type-in-p branch '|$ru| '|$ri|)
               (push (list branch (circuits-argument-row solution branch)) found)))
    found))

(defun circuits-ready-p (tableau item waiting)
  "Whether the argument of ITEM depends on no law that is still WAITING."
  (loop for column being the hash-keys of (second item)
        for (sort k) = (circuits-descriptor tableau column)
        never (and (eq sort :law)
                   (find k waiting :key (lambda (other) (circuits-branch-number (first other)))))))

(defun circuits-argument-row (solution branch)
  (if (eq (circuits-branch-type branch) '|$ri|)
      (circuits-current-row solution branch)
      (circuits-difference-row-of
       solution ($circuits_ends branch)
       (circuits-tableau-sign (circuits-solution-tableau solution)))))

(defun circuits-law-of (solution branch argument)
  (mfuncall '$circuits_law (circuits-branch-value branch) argument
            (circuits-circuit-laws (circuits-tableau-circuit
                                    (circuits-solution-tableau solution)))))

(defun circuits-laws-put (resolved e)
  (if resolved (circuits-names-replaced resolved e) e))

(defun circuits-names-replaced (pairs e)
  (resimplify (sublis pairs e :test #'eq)))

(defun circuits-refuse-circle (branches)
  (core-error "the circuit is not complete: neither inductor currents nor capacitor voltages ~
               determine ~a, and not all of them are linear"
              (core-words (list (cons '(mlist simp)
                                      (sort (mapcar #'circuits-branch-label branches)
                                            #'string< :key #'symbol-name))))))

;;; Expressions

(defun circuits-expressed (solution rows)
  "The list ROWS as expressions, laws put in, coefficients in factors."
  (let ((laws (circuits-laws-resolved solution)))
    (loop for row in rows
          collect (circuits-laws-put laws (circuits-row-expression
                                           solution (circuits-factored-row row))))))

(defun circuits-factored-row (row)
  (let ((result (circuits-new-row)))
    (maphash (lambda (column x)
               (setf (gethash column result)
                     (if (or (rationalp x) (not (circuits-sum-in-p x)))
                         x
                         (circuits-inside (algebra-in-factors x 2000)))))
             row)
    result))

(defun circuits-sum-in-p (e)
  (and (consp e) (or (mplusp e) (some #'circuits-sum-in-p (cdr e)))))

;;; For Maxima

(defun $circuits_tableau (circuit) (circuits-solution-of circuit))

(defun $circuits_tableau_states (solution)
  "Names of the independent states."
  (circuits-state-names solution (circuits-solution-states solution)))

(defun $circuits_tableau_dependence (solution)
  "[dependent state = what it is, ..]"
  (cons '(mlist simp)
        (loop for (k . row) in (circuits-solution-dependents solution)
              for branch = (circuits-branch-at (circuits-solution-tableau solution) k)
              collect (list '(mequal simp) (circuits-branch-state branch)
                            (first (circuits-expressed solution (list row)))))))

(defun $circuits_tableau_equations (solution)
  "[L1*'diff(i1,t) = .., ..]"
  (let* ((balances (circuits-balances solution))
         (stored (mapcar #'cadr balances)) (forces (mapcar #'cddr balances)))
    (dolist (row forces) (circuits-refuse-higher-rates solution row 1))
    (circuits-equations-of
     (loop for row in stored collect (circuits-row-expression solution row))
     (circuits-expressed solution forces))))

(defun circuits-equations-of (left right)
  (cons '(mlist simp)
        (loop for x in left for y in right collect (list '(mequal simp) x y))))

(defun circuits-rate-rows (solution)
  "The rates of the independent states in what is given."
  (circuits-find-rates solution)
  (loop for k in (circuits-solution-states solution)
        collect (gethash (circuits-rate-column solution k) (circuits-solution-others solution))))

(defun $circuits_tableau_rates (solution)
  "['diff(i1,t) = .., ..]"
  (let ((rows (circuits-rate-rows solution)))
    (dolist (row rows) (circuits-refuse-higher-rates solution row 1))
    (circuits-equations-of
     (loop for k in (circuits-solution-states solution)
           collect (circuits-given solution (circuits-rate-column solution k)))
     (circuits-expressed solution rows))))

(defun circuits-refuse-higher-rates (solution row most)
  (loop for column being the hash-keys of row
        for (sort k n) = (circuits-descriptor (circuits-solution-tableau solution) column)
        do (when (and (eq sort :source) (> n most))
             (core-error "the equations contain the ~:r derivative of the source ~a, which is ~
                          differentiated more than once; ask for BranchQuantities, or give the ~
                          source's value"
                         n (first (circuits-labels-of solution (list column)))))))

;;; The balances as what is stored and the forces, for what is made from both

(defun $circuits_tableau_forces (solution)
  "[X, ..], the right sides M x' = X."
  (cons '(mlist simp)
        (circuits-expressed solution (mapcar #'cddr (circuits-balances solution)))))

(defun $circuits_tableau_stores (solution)
  "The circuits-stores of SOLUTION; an error where a current and a voltage are stored together."
  (let ((balances (circuits-balances solution)))
    (flet ((of-type (type)
             (remove-if-not (lambda (k)
                              (eq type (circuits-branch-type
                                        (circuits-branch-at (circuits-solution-tableau solution)
                                                            k))))
                            (circuits-solution-states solution))))
      (let ((currents (of-type '|$l|)) (voltages (of-type '|$c|)))
        (when (or (circuits-stored-across-p solution balances currents voltages)
                  (circuits-stored-across-p solution balances voltages currents))
          (core-error "currents and voltages store energy together in this circuit; it has no ~
                       matrices of inductances and capacitances apart"))
        (make-circuits-stores
         :currents (circuits-state-names solution currents)
         :inductance (circuits-stored-matrix solution balances currents)
         :voltages (circuits-state-names solution voltages)
         :capacitance (circuits-stored-matrix solution balances voltages))))))

(defun circuits-state-names (solution numbers)
  (cons '(mlist simp)
        (loop for k in numbers
              collect (circuits-branch-state
                       (circuits-branch-at (circuits-solution-tableau solution) k)))))

(defun circuits-stored-entry (solution balances k j)
  "What the rate of the state of J counts in the balance of K."
  (gethash (circuits-rate-column solution j) (cadr (assoc k balances)) 0))

(defun circuits-stored-across-p (solution balances numbers others)
  (loop for k in numbers
        thereis (loop for j in others
                      thereis (not (circuits-nothing-p
                                    (circuits-stored-entry solution balances k j))))))

(defun circuits-stored-matrix (solution balances numbers)
  (cons '($matrix simp)
        (loop for k in numbers
              collect (cons '(mlist simp)
                            (loop for j in numbers
                                  collect (circuits-outside
                                           (circuits-stored-entry solution balances k j)))))))
