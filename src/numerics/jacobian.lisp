;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The matrix dX_i/dx_j of a program as a program of its own: the derivatives of all nodes by the
;;; states forward, sparse, on the nodes that are there (Griewank, Walther: Evaluating derivatives,
;;; 2nd ed., chapters 3 and 7). Where that would take more than 20 times the nodes it is given up,
;;; while it is built, and directional derivatives serve instead. Entries that are constant are kept
;;; and not computed again. See numerics-add-jacobian first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_from_expressions"
                "algebra/program_nodes" "numerics/colouring" "numerics/directions" "numerics/plan"
                "numerics/problem" "numerics/program" "numerics/routine"))

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
