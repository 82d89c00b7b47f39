;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Transfer functions and impedances of linear circuits, exact in s: the tableau with s in place of
;;; d/dt, i = s*C*u, u = s*L*i + s*M*i'.., one source at 1 and the others at 0, all states at rest
;;; before. No states are chosen, so that sources may be differentiated.
;;; See circuits-response first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/factoring" "algebra/normal" "circuits/branch_quantities"
                "circuits/coefficients" "circuits/elements" "circuits/order" "circuits/tableau"
                "circuits/tableau_elimination" "circuits/tableau_reduction"))

(defun circuits-response (circuit source output)
  "What the row that OUTPUT(tableau) gives becomes where the source of branch number SOURCE is 1."
  (let* ((tableau (circuits-tableau-of circuit))
         (states (circuits-state-numbers tableau))
         (unknowns (append (circuits-tableau-unknowns tableau)
                           (loop for k in states collect (circuits-column tableau :state k)))))
    (circuits-refuse-for-s tableau)
    (let* ((work (circuits-eliminated-rows
                  (append (mapcar (lambda (row) (circuits-row-of-source tableau row source))
                                  (circuits-tableau-rows tableau))
                          (loop for k in states collect (circuits-row-in-s tableau k)))
                  unknowns))
           (solved (circuits-solved-unknowns work unknowns))
           (result (circuits-new-row)))
      (circuits-refuse-no-response tableau work unknowns solved)
      (maphash (lambda (column x) (circuits-add-solved result column x solved))
               (circuits-row-of-source tableau (funcall output tableau) source))
      (gethash (circuits-column tableau :source source 0) result 0))))

(defun circuits-row-of-source (tableau row source)
  "ROW where all other sources are 0."
  (let ((copy (circuits-copied-row row)))
    (loop for (column) in (circuits-row-entries row)
          for (sort k) = (circuits-descriptor tableau column)
          do (when (and (eq sort :source) (/= k source)) (remhash column copy)))
    copy))

(defun circuits-row-in-s (tableau k)
  "s*(C*u) - i of a capacitor, s*(L*i + M*i' ..) - u of an inductor."
  (let ((branch (circuits-branch-at tableau k)) (row (circuits-new-row)))
    (loop for (j . x) in (circuits-stored tableau k)
          do (circuits-add-entry row (circuits-column tableau :state j)
                                 (circuits-times '|$S| x)))
    (if (eq (circuits-branch-type branch) '|$c|)
        (circuits-add-entry row (circuits-column tableau :current k)
                            (- (circuits-tableau-sign tableau)))
        (circuits-add-difference tableau row ($circuits_ends branch) -1))
    row))

(defun circuits-refuse-value-for-s (value name)
  (unless (freeof '$t value) (core-error "the value of ~a depends on the time" name))
  (unless (freeof '|$S| value)
    (core-error "the value of ~a contains s, the variable of the transfer function; name it ~
                 otherwise" name)))

(defun circuits-refuse-for-s (tableau)
  "What is not linear with constant values."
  (let ((circuit (circuits-tableau-circuit tableau)))
    (loop for transformer in (cdr (circuits-circuit-transformers circuit))
          for k from 1
          do (circuits-refuse-value-for-s (circuits-transformer-ratio transformer)
                                          (format nil "transformer ~d" k)))
    (loop for coupling in (cdr (circuits-circuit-couplings circuit))
          for k from 1
          do (circuits-refuse-value-for-s (circuits-coupling-mutual coupling)
                                          (format nil "coupling ~d" k))))
  (loop for branch across (circuits-tableau-branches tableau)
        for label = (core-words (list (circuits-branch-label branch)))
        for value = (circuits-branch-value branch)
        do (cond ((circuits-type-in-p branch '|$ru| '|$ri|)
                  (core-error "branch ~a is not linear; FirstApproximation linearizes the circuit"
                              label))
                 ((circuits-type-in-p branch '|$e| '|$i|))
                 ((circuits-refuse-value-for-s value label))
                 ((and (circuits-branch-state branch)
                       (not (freeof (circuits-branch-state branch) value)))
                  (core-error "branch ~a is not linear; FirstApproximation linearizes the circuit"
                              label)))))

(defun circuits-refuse-no-response (tableau work unknowns solved)
  (let ((open (circuits-undetermined work unknowns)))
    (when open
      (circuits-refuse-undetermined
       (make-circuits-solution :tableau tableau :solved solved) open))))

;;; Outputs and inputs by their names

(defun circuits-branch-of-label (circuit label what)
  (or (find label (cdr (circuits-circuit-branches circuit)) :key #'circuits-branch-label)
      (core-error "~a: there is no branch ~a" what (core-words (list label)))))

(defun circuits-output-row (circuit output)
  "A function of the tableau: the row of OUTPUT, a state, u(label), i(label) or v(node), plain or
quoted."
  (let ((output (if (atom output) output (cons (list ($verbify (caar output))) (cdr output))))
        (branch (and (symbolp output)
                     (find output (cdr (circuits-circuit-branches circuit))
                           :key #'circuits-branch-state))))
    (cond (branch (circuits-quantity-row branch (if (eq (circuits-branch-type branch) '|$c|)
                                                    '$u '$i)))
          ((and (consp output) (member (caar output) '($u $i)) (null (cddr output)))
           (circuits-quantity-row (circuits-branch-of-label circuit (cadr output) "output")
                                  (caar output)))
          ((and (consp output) (eq (caar output) '$v) (null (cddr output)))
           (circuits-node-row circuit (cadr output)))
          (t (core-error "output must be a state, u(label), i(label) or v(node), found ~a"
                         (core-words (list output)))))))

(defun circuits-quantity-row (branch quantity)
  (lambda (tableau)
    (let ((row (circuits-new-row)))
      (if (eq quantity '$i)
          (circuits-add-entry row (circuits-current-column tableau branch) 1)
          (circuits-add-difference tableau row ($circuits_ends branch)
                                   (circuits-law-direction tableau branch)))
      row)))

(defun circuits-node-row (circuit node)
  (circuits-check-node-of circuit node "output")
  (circuits-say-datum circuit)
  (lambda (tableau)
    (let ((row (circuits-new-row))
          (column (gethash (list :potential node) (circuits-tableau-columns tableau))))
      (when column (circuits-add-entry row column 1))
      row)))

(defun circuits-say-datum (circuit)
  "Who calls a node 0 and names no datum may take it for that."
  (let ((first (first (circuits-described-nodes circuit))))
    (when (and (eq (circuits-circuit-datum circuit) '$none) (not (eql first 0))
               (member 0 (circuits-described-nodes circuit)))
      (core-warn "potentials are counted from node ~a, the first of the first branch, and not from ~
                  node 0; give datum = 0 for that" (core-words (list first))))))

(defun circuits-check-node-of (circuit node what)
  (unless (member node (circuits-described-nodes circuit))
    (core-error "~a: node ~a is joined to nothing" what (core-words (list node)))))

;;; For Maxima

(defun $circuits_transfer_function (circuit output input)
  (let ((branch (circuits-branch-of-label circuit input "input")))
    (unless (circuits-type-in-p branch '|$e| '|$i|)
      (core-error "input must be the label of a source (E or I); ~a is of type ~a"
                  (core-words (list input)) (core-words (list (circuits-branch-type branch)))))
    (circuits-in-powers-of-s
     (circuits-response circuit (circuits-branch-number branch)
                        (circuits-output-row circuit output)))))

(defun $circuits_impedance (circuit from to)
  "u/i of what flows in at FROM and out at TO."
  (circuits-check-node-of circuit from "the first node")
  (circuits-check-node-of circuit to "the second node")
  (let* ((number (length (circuits-circuit-branches circuit)))
         (probe (make-circuits-branch :label (gensym) :tail to :head from :type '|$i| :value 1
                                      :number number :control '((mlist simp))))
         (driven (copy-circuits-circuit circuit)))
    (setf (circuits-circuit-branches driven)
          (append (circuits-circuit-branches circuit) (list probe)))
    (if (eql from to)
        0
        (circuits-in-powers-of-s
         (circuits-response driven number
                            (lambda (tableau)
                              (let ((row (circuits-new-row)))
                                (circuits-add-difference
                                 tableau row (list '(mlist simp) from to) 1)
                                row)))))))

(defun circuits-in-powers-of-s (x)
  "X with its numerator and denominator as polynomials in s, their coefficients in factors."
  (if (rationalp x)
      (circuits-outside x)
      (destructuring-bind (above below) (cdr ($algebra_ratio x))
        (div (circuits-polynomial-in-s above) (circuits-polynomial-in-s below)))))

(defun circuits-polynomial-in-s (e)
  (let ((e ($expand e)))
    (addn (loop for k from 0 to ($hipow e '|$S|)
                collect (mul (algebra-in-factors ($coeff e '|$S| k) 2000) (power '|$S| k)))
          nil)))

;;; Poles and zeros

(defun $circuits_poles_and_zeros (e)
  "[function = .., zeros = [[zero, multiplicity], ..], poles = ..]; roots without a closed form
stand as the equation that they satisfy."
  (destructuring-bind (above below) (cdr ($algebra_ratio e))
    (list '(mlist simp)
          (list '(mequal simp) '$function e)
          (list '(mequal simp) '$zeros (circuits-roots-in-s above))
          (list '(mequal simp) '$poles (circuits-roots-in-s below)))))

(defun circuits-roots-in-s (e)
  (cons '(mlist simp)
        (loop for (factor . multiplicity) in (circuits-powers (algebra-in-factors e 5000))
              unless (freeof '|$S| factor)
                append (loop for root in (circuits-roots-of-factor factor)
                             collect (list '(mlist simp) root multiplicity)))))

(defun circuits-roots-of-factor (factor)
  (let* ((e ($expand factor)))
    (flet ((a (k) ($coeff e '|$S| k)))
      (case ($hipow e '|$S|)
        (1 (list (algebra-normal-form (div (neg (a 0)) (a 1)))))
        (2 (let ((root (power (algebra-in-factors (sub (power (a 1) 2) (mul 4 (a 0) (a 2))) 2000)
                              1//2))
                 (twice (mul 2 (a 2))))
             (list (div (sub (neg (a 1)) root) twice) (div (sub root (a 1)) twice))))
        (t (list (list '(mequal simp) e 0)))))))
