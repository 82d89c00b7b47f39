;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The mixed potential of a circuit with controlled sources, where it has one. With the balances
;;; M x' = X of the tableau, M of the energy stored, there is P with X = (P_i, -P_u) if and only if
;;; the matrix of s_j dX_j/dx_k is symmetric, s = 1 for currents, -1 for voltages: then
;;;     P = (x, S X_x x)/2 + (x, S sources) + sum over laws of c times the integral of the law.
;;; A law of the argument (a, x) + .. enters X_j as s_j c a_j. See circuits_symmetric_potential.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/factoring" "circuits/coefficients" "circuits/element_laws"
                "circuits/elements" "circuits/source_impulses" "circuits/tableau"
                "circuits/tableau_equations" "circuits/tableau_reduction" "forms/exchange"))

(defun $circuits_symmetric_potential (solution)
  (let* ((states (circuits-solution-states solution))
         (forces (loop for (k nil . row) in (circuits-balances solution)
                       collect (circuits-signed-row solution k row)))
         (laws (circuits-law-branches solution)))
    (circuits-refuse-varying solution forces)
    (dolist (row forces) (circuits-refuse-higher-rates solution row 1))
    (circuits-refuse-asymmetric solution states forces laws)
    (addn (append (circuits-quadratic-terms solution states forces)
                  (circuits-linear-terms solution states forces)
                  (loop for branch in laws
                        append (circuits-law-terms solution states forces branch)))
          nil)))

(defun circuits-signed-row (solution k row)
  "The derivative of P by the state of K: X of a current, -X of a voltage."
  (if (circuits-voltage-state-p solution k)
      (let ((turned (circuits-new-row)))
        (circuits-add-multiple turned -1 row)
        turned)
      row))

(defun circuits-voltage-state-p (solution k)
  (eq (circuits-branch-type (circuits-branch-at (circuits-solution-tableau solution) k)) '|$c|))

(defun circuits-law-branches (solution)
  (loop for branch across (circuits-tableau-branches (circuits-solution-tableau solution))
        when (circuits-type-in-p branch '|$ru| '|$ri|) collect branch))

(defun circuits-state-entry (solution row k)
  (gethash (circuits-column (circuits-solution-tableau solution) :state k) row 0))

(defun circuits-law-entry (solution row branch)
  (gethash (circuits-column (circuits-solution-tableau solution) :law
                            (circuits-branch-number branch))
           row 0))

;;; Symmetry

(defun circuits-refuse-varying (solution forces)
  (let ((names (circuits-all-state-names solution)))
    (dolist (row forces)
      (maphash (lambda (column x)
                 (declare (ignore column))
                 (unless (or (rationalp x) (every (lambda (name) (freeof name x)) names))
                   (core-error "an inductance or a capacitance varies with states that others ~
                                determine; StateEquations serves this circuit")))
               row))))

(defun circuits-all-state-names (solution)
  (let ((tableau (circuits-solution-tableau solution)))
    (loop for k in (circuits-state-numbers tableau)
          collect (circuits-branch-state (circuits-branch-at tableau k)))))

(defun circuits-refuse-asymmetric (solution states forces laws)
  (loop for (k . later) on states
        for (row . later-rows) on forces
        do (loop for j in later
                 for other in later-rows
                 do (circuits-refuse-unequal solution k j
                                             (circuits-state-entry solution row j)
                                             (circuits-state-entry solution other k))
                    (dolist (branch laws)
                      (let ((argument (circuits-argument-row solution branch)))
                        (circuits-refuse-unequal
                         solution k j
                         (circuits-times (circuits-law-entry solution row branch)
                                         (circuits-state-entry solution argument j))
                         (circuits-times (circuits-law-entry solution other branch)
                                         (circuits-state-entry solution argument k))))))))

(defun circuits-refuse-unequal (solution k j x y)
  (unless (circuits-nothing-p (circuits-plus x (circuits-negative y)))
    (flet ((label (number)
             (core-words (list (circuits-branch-label
                                (circuits-branch-at (circuits-solution-tableau solution)
                                                    number))))))
      (core-error "the circuit has no mixed potential: the branches ~a and ~a act on each other ~
                   asymmetrically, the derivatives of P would be ~a and ~a; StateEquations ~
                   serves it"
                  (label k) (label j) (core-words (list (circuits-outside x)))
                  (core-words (list (circuits-outside y)))))))

;;; Terms

(defun circuits-state-now (solution k)
  (circuits-branch-state (circuits-branch-at (circuits-solution-tableau solution) k)))

(defun circuits-shown (x) (if (rationalp x) (circuits-outside x) (algebra-in-factors x 2000)))

(defun circuits-quadratic-terms (solution states forces)
  (loop for (k . later) on states
        for row in forces
        collect (mul 1//2 (circuits-shown (circuits-state-entry solution row k))
                     (power (circuits-state-now solution k) 2))
        append (loop for j in later
                     collect (mul (circuits-shown (circuits-state-entry solution row j))
                                  (circuits-state-now solution k)
                                  (circuits-state-now solution j)))))

(defun circuits-linear-terms (solution states forces)
  (loop for k in states
        for row in forces
        append (loop for (column . x) in (circuits-row-entries row)
                     when (eq :source (car (circuits-descriptor
                                            (circuits-solution-tableau solution) column)))
                       collect (mul (circuits-shown x) (circuits-given solution column)
                                    (circuits-state-now solution k)))))

(defun circuits-law-terms (solution states forces branch)
  "c times the integral of the law, or, where its argument does not move, its value times states."
  (let* ((argument (circuits-argument-row solution branch))
         (k (find-if-not (lambda (k) (circuits-nothing-p (circuits-state-entry solution argument
                                                                               k)))
                         states)))
    (circuits-refuse-nested solution argument)
    (if k
        (let ((c (circuits-over (circuits-law-entry solution (nth (position k states) forces)
                                                    branch)
                                (circuits-state-entry solution argument k)))
              (now (circuits-row-expression solution argument)))
          (list (mul (circuits-shown c)
                     (circuits-integral-of-law solution branch now))))
        (loop for k in states
              for row in forces
              collect (mul (circuits-shown (circuits-law-entry solution row branch))
                           (circuits-state-now solution k)
                           (circuits-law-of solution branch
                                            (circuits-row-expression solution argument)))))))

(defun circuits-refuse-nested (solution argument)
  (loop for column being the hash-keys of argument
        do (when (eq :law (car (circuits-descriptor (circuits-solution-tableau solution) column)))
             (core-error "the mixed potential is not formed where one nonlinear branch is the ~
                          argument of another; StateEquations serves this circuit"))))

(defun circuits-integral-of-law (solution branch now)
  "From the argument with all states zero."
  (let ((at-rest now))
    (dolist (name (circuits-all-state-names solution))
      (setq at-rest ($forms_exchange at-rest `((mlist) ((mequal) ,name 0)))))
    (mfuncall '$circuits_law_integral (circuits-branch-value branch) at-rest now
              (circuits-circuit-laws (circuits-tableau-circuit
                                      (circuits-solution-tableau solution))))))

;;; dP/dt along the equations

(defun $circuits_rate_along (solution potential)
  (let ((rates (cdr ($circuits_tableau_rates solution))))
    (mfuncall '$circuits_refuse_squared_impulses (cons '(mlist) rates))
    (addn (cons (mfuncall '$circuits_time_rate potential)
                (loop for (nil left right) in rates
                      collect (mul (mfuncall '$circuits_slope potential (cadr left)) right)))
          nil)))
