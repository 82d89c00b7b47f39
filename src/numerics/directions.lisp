;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The matrix dX_i/dx_j by directional derivatives: one program gives the rates of all X_i for
;;; given rates of the states, its seeds, at about three times the nodes, and runs once for each
;;; colour of columns; what depends on time and states alone is computed once. Which X_i depend on
;;; which x_j is seen in the program. See numerics-directional-jacobian first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_from_expressions"
                "algebra/program_nodes" "numerics/colouring" "numerics/linear_rows"
                "numerics/plan" "numerics/problem" "numerics/program" "numerics/routine"
                "numerics/routine_entry"))

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
