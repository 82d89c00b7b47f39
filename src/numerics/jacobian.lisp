;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The matrix dX_i/dx_j of a program as a program of its own: the derivatives of all nodes by the
;;; states forward, sparse, on the nodes that are there (Griewank, Walther: Evaluating derivatives,
;;; 2nd ed., chapters 3 and 7). Where that would take more than 20 times the nodes it is given up,
;;; while it is built, and directional derivatives serve instead. Entries that are constant are kept
;;; and not computed again. See numerics-add-jacobian first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_from_expressions"
                "algebra/program_nodes" "numerics/linear_rows" "numerics/plan"
                "numerics/problem" "numerics/program" "numerics/routine" "numerics/routine_entry"
                "numerics/sparse"))

(defparameter *numerics-jacobian-growth* 20)

(defun numerics-add-jacobian (problem &key (how :auto) (calls 0))
  "PROBLEM with jacobian, pattern and time-slope from its program, in place."
  (let* ((program (numerics-problem-program problem))
         (rows (numerics-known-slopes program)))
    (multiple-value-bind (jacobian pattern)
        (if rows
            (numerics-exact-jacobian program rows how calls)
            (numerics-directional-jacobian program how calls))
      (setf (numerics-problem-jacobian problem) jacobian
            (numerics-problem-pattern problem) pattern
            (numerics-problem-time-slope problem)
            (numerics-routine program (numerics-time-slopes program) :how how :calls calls)))
    problem))

(defun numerics-time-slopes (program)
  (with-numerics-program program
    (algebra-program-rates (numerics-program-rates program)
                           (list (cons (algebra-program-input '$t) 1)))))

;;; Forward: the slopes of a node are ((j . element) ..), j increasing.

(defun numerics-known-slopes (program)
  "The slopes of all rates, nil where they take too many nodes; built once."
  (when (eq (numerics-program-slopes program) :unknown)
    (setf (numerics-program-slopes program)
          (with-numerics-program program (numerics-jacobian-rows program))))
  (numerics-program-slopes program))

(defun numerics-jacobian-rows (program)
  (let* ((rates (numerics-program-rates program)) (slopes (make-hash-table))
         (nodes (algebra-live-nodes rates))
         (limit (+ (algebra-program-count *algebra-program*)
                   (* *numerics-jacobian-growth* (max 50 (length nodes))))))
    (loop for state in (numerics-program-states program)
          for j from 0
          do (setf (gethash (algebra-node-index state) slopes) (list (cons j 1))))
    (flet ((slopes-of (element)
             (and (algebra-node-p element) (gethash (algebra-node-index element) slopes))))
      (dolist (node nodes)
        (when (> (algebra-program-count *algebra-program*) limit)
          (return-from numerics-jacobian-rows nil))
        (unless (algebra-input-p node)
          (setf (gethash (algebra-node-index node) slopes)
                (numerics-node-slopes node #'slopes-of))))
      (mapcar #'slopes-of rates))))

(defun numerics-node-slopes (node slopes-of)
  (let ((sum '()))
    (when (some slopes-of (algebra-node-parts node))
      (loop for (part . derivative) in (algebra-partial-derivatives node)
            do (setq sum (numerics-slopes-plus sum derivative (funcall slopes-of part)))))
    sum))

(defun numerics-slopes-plus (a factor b)
  "The slopes A + FACTOR*B."
  (let ((sum '()))
    (flet ((note (j element) (unless (eql element 0) (push (cons j element) sum)))
           (times (element) (algebra-program-multiply factor element)))
      (loop while (or a b)
            do (cond ((or (null b) (and a (< (caar a) (caar b)))) (push (pop a) sum))
                     ((or (null a) (< (caar b) (caar a)))
                      (destructuring-bind (j . element) (pop b) (note j (times element))))
                     (t (destructuring-bind (j . element) (pop b)
                          (note j (algebra-program-add (cdr (pop a)) (times element))))))))
    (nreverse sum)))

;;; Its function.

(defun numerics-exact-jacobian (program rows how calls)
  "The function (time x values), and the pattern."
  (let* ((entries (sort (loop for row in rows
                              for i from 0
                              append (loop for (j . element) in row collect (list j i element)))
                        #'numerics-entry-before-p))
         (pattern (numerics-pattern-of (length rows) entries))
         (outputs (loop for (nil nil element) in entries
                        for place from 0 collect (cons place element))))
    (values (numerics-routine-of-plan (numerics-new-plan program outputs (length entries))
                                      how calls)
            pattern)))

;;; By directional derivatives: one program gives the rates of all X_i for given rates of the
;;; states, its seeds, at about three times the nodes, and runs once for each colour of columns;
;;; what depends on time and states alone is computed once. Which X_i depend on which x_j is seen in
;;; the program.

(defun numerics-directional-jacobian (program how calls)
  "The function (time x values), and the pattern."
  (let* ((n (length (numerics-program-names program)))
         (constants (numerics-constant-slopes program))
         (entries (sort (loop for set in (numerics-dependences program)
                              for i from 0
                              append (loop for j from 0 below (integer-length set)
                                           when (logbitp j set) collect (list j i)))
                        #'numerics-entry-before-p)))
    (multiple-value-bind (colours count) (numerics-colours-of-moving n entries constants)
      (multiple-value-bind (first second)
          (numerics-routine-of-plan (numerics-direction-plan program n) how (* count calls))
        (values (numerics-direction-function first second n
                                             (numerics-groups-of-entries entries colours constants
                                                                         count)
                                             (numerics-kept-entries entries constants))
                (numerics-pattern-of n entries))))))

(defun numerics-direction-plan (program n)
  "The plan of the derivatives of all rates along the seeds."
  (with-numerics-program program
    (let* ((states (numerics-program-states program))
           (seeds (loop for nil in states collect (algebra-program-input (gensym)))))
      (numerics-new-plan program
                         (loop for element in (algebra-program-rates
                                               (numerics-program-rates program)
                                               (mapcar #'cons states seeds))
                               for k from 0 collect (cons k element))
                         n seeds))))

;;; What depends on what: sets of states as bits.

(defun numerics-dependences (program)
  "For each rate the set of the states that it depends on."
  (let ((sets (make-hash-table)) (rates (numerics-program-rates program)))
    (numerics-spread-dependences program (algebra-live-nodes rates) sets)
    (loop for rate in rates
          collect (if (algebra-node-p rate) (gethash (algebra-node-index rate) sets) 0))))

(defun numerics-spread-dependences (program nodes sets)
  (loop for state in (numerics-program-states program)
        for j from 0
        do (setf (gethash (algebra-node-index state) sets) (ash 1 j)))
  (dolist (node nodes)
    (unless (gethash (algebra-node-index node) sets)
      (setf (gethash (algebra-node-index node) sets)
            (reduce #'logior (algebra-node-parts node) :initial-value 0
                    :key (lambda (part) (gethash (algebra-node-index part) sets)))))))

(defun numerics-constant-slopes (program)
  "(i j) -> rational, for the states that stand in a rate by themselves, with a constant factor."
  (let* ((rates (numerics-program-rates program)) (nodes (algebra-live-nodes rates))
         (forms (numerics-forms nodes (lambda (e) (and (rationalp e) e))))
         (sets (make-hash-table)) (places (make-hash-table))
         (slopes (make-hash-table :test #'equal)))
    (numerics-spread-dependences program nodes sets)
    (loop for state in (numerics-program-states program)
          for j from 0 do (setf (gethash (algebra-node-index state) places) j))
    (loop for rate in rates
          for i from 0
          do (when (algebra-node-p rate)
               (let* ((terms (cdr (gethash (algebra-node-index rate) forms)))
                      (others (numerics-other-dependences terms places sets)))
                 (loop for (node . coefficient) in terms
                       for j = (gethash (algebra-node-index node) places)
                       do (when (and j (not (logbitp j others)))
                            (setf (gethash (list i j) slopes) coefficient))))))
    slopes))

(defun numerics-other-dependences (terms places sets)
  (loop with others = 0
        for (node) in terms
        for index = (algebra-node-index node)
        do (unless (gethash index places) (setq others (logior others (gethash index sets))))
        finally (return others)))

;;; Colours are given to columns that have entries which are not constant; a constant entry counts
;;; for them, too, since the derivative shows it.

(defun numerics-constant-entry (entry constants)
  (gethash (list (second entry) (first entry)) constants))

(defun numerics-colours-of-moving (n entries constants)
  (let ((columns (make-array n :initial-element '())) (moving (make-array n :initial-element nil)))
    (dolist (entry entries)
      (push (second entry) (aref columns (first entry)))
      (unless (numerics-constant-entry entry constants) (setf (aref moving (first entry)) t)))
    (dotimes (j n) (unless (aref moving j) (setf (aref columns j) '())))
    (numerics-colours n columns)))

(defun numerics-groups-of-entries (entries colours constants count)
  "For each colour (columns places rows): which seeds are 1, and where which derivatives belong."
  (let ((groups (make-array count :initial-element '())))
    (loop for entry in entries
          for place from 0
          for colour = (aref colours (first entry))
          do (unless (numerics-constant-entry entry constants)
               (push (cons place (second entry)) (aref groups colour))))
    (loop for group across groups
          for colour from 0
          collect (list (numerics-index-vector (loop for j from 0 below (length colours)
                                                     when (eql colour (aref colours j)) collect j))
                        (numerics-index-vector (mapcar #'car group))
                        (numerics-index-vector (mapcar #'cdr group))))))

(defun numerics-kept-entries (entries constants)
  "((place . double) ..)."
  (loop for entry in entries
        for place from 0
        for value = (numerics-constant-entry entry constants)
        when value collect (cons place (numerics-constant-double value))))

(defun numerics-direction-function (first second n groups kept)
  "GROUPS are (columns places rows), KEPT are ((place . double) ..)."
  (declare (type function first second))
  (let ((seed (numerics-zeros n)) (out (numerics-zeros n)) (fill (numerics-filler kept))
        (length (+ (length kept) (loop for (nil places) in groups sum (length places)))))
    (declare (type numerics-vector seed out) (type function fill) (fixnum length))
    (lambda (time x values)
      (declare (type numerics-vector time x values) (optimize speed))
      (unless (= (length values) length) (numerics-wrong-length))
      (funcall first time x out)
      (loop for (columns places rows) in groups
            do (numerics-set-seeds columns seed 1d0)
               (funcall second seed out)
               (numerics-set-seeds columns seed 0d0)
               (numerics-scatter-elements out rows values places))
      (funcall fill x out values)
      values)))

(defun numerics-set-seeds (columns seed value)
  (declare (type numerics-indices columns) (type numerics-vector seed) (double-float value)
           (optimize speed))
  (loop for j across columns do (setf (aref seed j) value)))

(defun numerics-scatter-elements (from rows to places)
  "The elements of FROM in ROWS to the PLACES of the vector TO."
  (declare (type numerics-vector from to) (type numerics-indices rows places) (optimize speed))
  (dotimes (k (length rows))
    (setf (aref to (aref places k)) (aref from (aref rows k)))))
