;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; From the tableau to states that are independent. What is left of its rows when all unknowns are
;;; gone ties states and sources: such a row gives one state, the latest, by the others, and its
;;; rate by theirs; rows that lose their rates by this tie further states. Each step takes one
;;; state, so the steps end. The product of all pivots is the leading coefficient of the circuit's
;;; determinant as a polynomial in s: where it vanishes the order is lower.
;;; See circuits-solution-of first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/zero" "circuits/coefficients" "circuits/elements"
                "circuits/linear_ties" "circuits/numbers" "circuits/source_impulses"
                "circuits/tableau" "circuits/tableau_elimination" "forms/exchange"))

(defstruct circuits-solution
  tableau
  (states '())      ; numbers of the branches with independent states, currents first
  (dependents '())  ; ((number . row) ..)
  solved            ; table: unknown of the tableau -> row
  (others (make-hash-table)) ; table: undetermined at first, or rate, or dependent state -> row
  (free '())        ; unknowns that the states alone do not determine
  (rows '())        ; of the rates, as they stand
  (determinant '()) ; coefficients whose product it is
  (rated nil))      ; whether the rates are in `others'

(defun circuits-solution-of (circuit)
  (let* ((tableau (circuits-tableau-of circuit))
         (unknowns (circuits-tableau-unknowns tableau))
         (work (circuits-eliminated-rows
                (loop for row in (circuits-tableau-rows tableau)
                      collect (circuits-without-idle-sources tableau row))
                unknowns))
         (solution (make-circuits-solution
                    :tableau tableau :states (circuits-state-numbers tableau)
                    :solved (circuits-solved-unknowns work unknowns)
                    :free (circuits-undetermined work unknowns)
                    :determinant (circuits-elimination-determinant work))))
    (setf (circuits-solution-rows solution)
          (append (circuits-rows-left work)
                  (loop for k in (circuits-solution-states solution)
                        collect (circuits-rate-row solution k))))
    (when (circuits-solution-free solution) (circuits-find-rates solution))
    solution))

(defun circuits-without-idle-sources (tableau row)
  "A copy of ROW without sources whose value is 0."
  (let ((copy (circuits-copied-row row)))
    (loop for column being the hash-keys of row
          for (sort k) = (circuits-descriptor tableau column)
          do (when (and (eq sort :source)
                        (eql 0 (circuits-branch-value (circuits-branch-at tableau k))))
               (remhash column copy)))
    copy))

(defun circuits-state-numbers (tableau)
  (flet ((of-type (type)
           (loop for branch across (circuits-tableau-branches tableau)
                 when (eq (circuits-branch-type branch) type)
                   collect (circuits-branch-number branch))))
    (loop for type in '(|$l| |$c|)
          append (circuits-in-named-order (circuits-tableau-circuit tableau) (of-type type)))))

;;; Rates

(defun circuits-rate-row (solution k)
  "C*u' - i of a capacitor, L*i' + M*i' .. - u of an inductor."
  (let* ((tableau (circuits-solution-tableau solution)) (branch (circuits-branch-at tableau k))
         (solved (circuits-solution-solved solution)) (row (circuits-new-row))
         (sign (circuits-tableau-sign tableau)))
    (loop for (j . x) in (circuits-stored tableau k)
          do (circuits-add-entry row (circuits-column tableau :rate j) x))
    (if (eq (circuits-branch-type branch) '|$c|)
        (circuits-add-solved row (circuits-column tableau :current k) (- sign) solved)
        (circuits-add-multiple row -1 (circuits-voltage-row tableau ($circuits_ends branch) 1
                                                            solved)))
    row))

(defun circuits-stored (tableau k)
  "((j . L or C or M) ..): what the rate of the state of j counts in branch K."
  (cons (cons k (circuits-inside (circuits-branch-value (circuits-branch-at tableau k))))
        (loop for coupling in (cdr (circuits-circuit-couplings (circuits-tableau-circuit tableau)))
              for one = (circuits-coupling-one coupling)
              for other = (circuits-coupling-other coupling)
              for mutual = (circuits-inside (circuits-coupling-mutual coupling))
              when (eql k one) collect (cons other mutual)
                when (eql k other) collect (cons one mutual))))

(defun circuits-rate-column (solution k)
  (circuits-column (circuits-solution-tableau solution) :rate k))

(defun circuits-find-rates (solution)
  "Ties are used, until the rows determine the rates and what the states left open."
  (loop until (circuits-solution-rated solution)
        do (let* ((unknowns (append (mapcar (lambda (k) (circuits-rate-column solution k))
                                            (circuits-solution-states solution))
                                    (circuits-solution-free solution)))
                  (work (circuits-eliminated-rows
                         (mapcar #'circuits-copied-row (circuits-solution-rows solution))
                         unknowns))
                  (ties (circuits-rows-left work)))
             (circuits-add-pivots solution (circuits-elimination-determinant work))
             (if ties
                 (circuits-use-ties solution ties
                                    (mapcar #'cdr (circuits-elimination-pivots work)))
                 (circuits-finish-rates solution work unknowns)))))

(defun circuits-add-pivots (solution pivots)
  (setf (circuits-solution-determinant solution)
        (append pivots (circuits-solution-determinant solution))))

(defun circuits-finish-rates (solution work unknowns)
  (let ((open (circuits-undetermined work unknowns)))
    (when open (circuits-refuse-undetermined solution open))
    (maphash (lambda (column row) (setf (gethash column (circuits-solution-others solution)) row))
             (circuits-solved-unknowns work unknowns))
    (loop for (k . row) in (circuits-solution-dependents solution)
          do (setf (gethash (circuits-column (circuits-solution-tableau solution) :state k)
                            (circuits-solution-others solution))
                   row))
    (setf (circuits-solution-rated solution) t)))

;;; Ties

(defun circuits-use-ties (solution ties rows)
  (loop while ties
        do (let* ((tie (circuits-used-tie solution (pop ties)))
                  (k (circuits-tied-state solution tie)))
             (when (plusp (hash-table-count tie))
               (unless k (circuits-refuse-tie solution tie))
               (let ((row (circuits-tied-row solution tie k)))
                 (circuits-put-state solution k row (append ties rows))
                 (setf (circuits-solution-states solution)
                       (remove k (circuits-solution-states solution)))))))
  (setf (circuits-solution-rows solution) rows))

(defun circuits-used-tie (solution tie)
  (multiple-value-bind (row pivot) (circuits-linear-tie (circuits-solution-tableau solution) tie)
    (when pivot (circuits-add-pivots solution (list pivot)))
    row))

(defun circuits-tied-state (solution tie)
  "The number of the state that gives way in the row TIE: the latest, or nil."
  (let ((tableau (circuits-solution-tableau solution)))
    (find-if (lambda (k) (gethash (circuits-column tableau :state k) tie))
             (circuits-weakest-first solution))))

(defun circuits-weakest-first (solution)
  "The states in the order in which they give way: voltages before currents, of each the latest
branch first; last those that the person's tree keeps independent."
  (let* ((tableau (circuits-solution-tableau solution))
         (count (length (circuits-tableau-branches tableau)))
         (tree (circuits-circuit-chosen_tree (circuits-tableau-circuit tableau)))
         (chosen (and (consp tree) (cdr tree))))
    (flet ((kept-p (k)
             (let* ((branch (circuits-branch-at tableau k))
                    (in-tree (member (circuits-branch-label branch) chosen)))
               (if (eq (circuits-branch-type branch) '|$c|) in-tree (and chosen (not in-tree))))))
      (sort (copy-list (circuits-solution-states solution)) #'>
            :key (lambda (k)
                   (+ k
                      (if (eq (circuits-branch-type (circuits-branch-at tableau k)) '|$c|) count 0)
                      (if (kept-p k) (* -2 count) 0)))))))

(defun circuits-tied-row (solution tie k)
  "What the tie makes of the state of K."
  (let* ((column (circuits-column (circuits-solution-tableau solution) :state k))
         (pivot (gethash column tie)) (row (circuits-new-row)))
    (circuits-add-pivots solution (list pivot))
    (remhash column tie)
    (circuits-add-multiple row (circuits-over -1 pivot) tie)
    row))

(defun circuits-put-state (solution k row rows)
  "Puts ROW in place of the state of K, and its rate, into ROWS and into what other states are."
  (let* ((tableau (circuits-solution-tableau solution))
         (state (circuits-column tableau :state k)) (rate (circuits-column tableau :rate k))
         (rate-row (circuits-rate-of-row solution row)))
    (circuits-put-into-values solution k row rows)
    (dolist (target (append rows (mapcar #'cdr (circuits-solution-dependents solution))))
      (loop for (column . other) in (list (cons state row) (cons rate rate-row))
            for x = (gethash column target)
            do (when x
                 (remhash column target)
                 (circuits-add-multiple target x other))))
    (push (cons k row) (circuits-solution-dependents solution))))

(defun circuits-put-value (value name x)
  "X with VALUE for the state NAME."
  ($forms_exchange x (list '(mlist) (list '(mequal) name value))))

(defun circuits-put-into-values (solution k row rows)
  "An inductance or capacitance that depends on the state of K depends on what that is."
  (let ((name (circuits-branch-state (circuits-branch-at (circuits-solution-tableau solution) k))))
    (dolist (target rows)
      (loop for (column . x) in (circuits-row-entries target)
            do (unless (or (rationalp x) (freeof name x))
                 (setf (gethash column target)
                       (circuits-inside
                        (circuits-put-value (circuits-row-expression solution row) name x))))))))

;;; Rates of rows

(defun circuits-rate-of-row (solution row)
  (let ((result (circuits-new-row)))
    (maphash (lambda (column x)
               (unless (or (rationalp x) (freeof '$t x))
                 (circuits-add-entry result column
                                     (circuits-inside (mfuncall '$circuits_time_rate x))))
               (let ((rate (circuits-rate-of-column solution column)))
                 (when rate (circuits-add-entry result rate x))))
             row)
    result))

(defun circuits-rate-of-column (solution column)
  "The column of its rate, nil where that is 0."
  (let ((tableau (circuits-solution-tableau solution)))
    (destructuring-bind (sort k &optional n) (circuits-descriptor tableau column)
      (ecase sort
        (:state (circuits-column tableau :rate k))
        (:source (unless (freeof '$t (circuits-branch-value (circuits-branch-at tableau k)))
                   (circuits-column tableau :source k (1+ n))))
        (:law (circuits-refuse-law solution k))))))

;;; Expressions of what is given

(defun circuits-given (solution column)
  "The state, or the source or its rate, of COLUMN."
  (let ((tableau (circuits-solution-tableau solution)))
    (destructuring-bind (sort k &optional n) (circuits-descriptor tableau column)
      (let ((branch (and (integerp k) (circuits-branch-at tableau k))))
        (ecase sort
          (:state (circuits-branch-state branch))
          (:rate (list '(%derivative simp) (circuits-branch-state branch) '$t 1))
          (:source (if (eql n 0)
                       (circuits-branch-value branch)
                       (mfuncall '$circuits_rate_of_order (circuits-branch-value branch) n)))
          (:law (circuits-open-law branch)))))))

(defun circuits-open-law (branch)
  "A name for what the law of BRANCH gives, until its argument is known."
  (intern (format nil "$CIRCUITS_LAW_~d" (circuits-branch-number branch)) :maxima))

(defun circuits-row-expression (solution row)
  "ROW as a sum; what has the same coefficient, up to its sign, stands in one bracket."
  (let ((groups '()))
    (loop for (column . x) in (circuits-row-entries row)
          do (multiple-value-bind (factor sign) (circuits-factor-and-sign x)
               (let ((group (or (assoc factor groups :test #'alike1)
                                (car (push (list factor) groups)))))
                 (push (mul sign (circuits-given solution column)) (cdr group)))))
    (addn (loop for (factor . terms) in groups
                append (cond ((eql factor 1) terms)
                             ((and (algebra-rational-number factor)
                                   (some #'algebra-rational-number terms))
                              (mapcar (lambda (term) (mul factor term)) terms))
                             (t (list (mul factor (addn terms nil))))))
          nil)))

(defun circuits-factor-and-sign (x)
  (cond ((rationalp x) (values (circuits-outside (abs x)) (signum x)))
        ((and (mtimesp x) (algebra-rational-number (cadr x))
              (minusp (algebra-rational-number (cadr x))))
         (values (neg x) -1))
        (t (values x 1))))

;;; What is refused

(defun circuits-labels-of (solution columns)
  "Words for what COLUMNS stand for."
  (let ((tableau (circuits-solution-tableau solution)))
    (flet ((label (k) (core-words (list (circuits-branch-label (circuits-branch-at tableau k))))))
      (remove-duplicates
       (loop for column in columns
             for (sort k) = (circuits-descriptor tableau column)
             collect (ecase sort
                       (:potential (format nil "the potential of node ~a" (core-words (list k))))
                       (:current (format nil "the current of ~a" (label k)))
                       (:winding (format nil "the current of transformer ~d" k))
                       ((:state :rate) (format nil "the state of ~a" (label k)))
                       ((:source :law) (label k))))
       :test #'string= :from-end t))))

(defun circuits-refuse-undetermined (solution open)
  (core-error "the currents and voltages are not determined: ~{~a~^, ~} may be any; look for an ~
               amplifier or a controlled source without feedback, and for resistors whose values ~
               cancel"
              (circuits-labels-of solution (circuits-moved-by solution open))))

(defun circuits-moved-by (solution open)
  "The currents that depend on the undetermined columns OPEN, else these."
  (let ((tableau (circuits-solution-tableau solution)) (moved '()))
    (maphash (lambda (column row)
               (when (and (eq :current (car (circuits-descriptor tableau column)))
                          (some (lambda (free) (gethash free row)) open))
                 (push column moved)))
             (circuits-solution-solved solution))
    (if moved (sort (union moved open) #'<) open)))

(defun circuits-refuse-sources (solution sources demanded)
  (let ((labels (circuits-labels-of solution sources)))
    (if (eq t ($algebra_zerop demanded))
        (core-error "the sources ~{~a~^, ~} give the same twice, so that what flows between them ~
                     is not determined; one of them is enough" labels)
        (core-error "the sources contradict each other: the branches demand 0 = ~a (~{~a~^, ~})"
                    (core-words (list demanded)) labels))))

(defun circuits-refuse-tie (solution tie)
  (let* ((tableau (circuits-solution-tableau solution))
         (columns (loop for column being the hash-keys of tie collect column))
         (sources (remove :source columns :key (lambda (c) (car (circuits-descriptor tableau c)))
                                  :test-not #'eq)))
    (if (= (length sources) (length columns))
        (circuits-refuse-sources solution sources (circuits-row-expression solution tie))
        (core-error "neither inductor currents nor capacitor voltages determine the nonlinear ~
                     branches ~{~a~^, ~}" (circuits-labels-of solution columns)))))

(defun circuits-refuse-law (solution k)
  (core-error "a state depends on the law of ~a, and so would need its rate; write the law the ~
               other way (RU or RI), or put a capacitor beside the branch"
              (core-words (list (circuits-branch-label
                                 (circuits-branch-at (circuits-solution-tableau solution) k))))))
