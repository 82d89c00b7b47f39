;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The problem that a program of rates poses to a method of integration.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "algebra/program_record" "numerics/sparse"
                "numerics/jacobian" "numerics/plan" "numerics/problem" "numerics/program"
                "numerics/routine"))

(defun numerics-problem-of-program (record names &rest options)
  "The problem of RECORD, whose states are NAMES, or nil where the record has them as `states';
OPTIONS are those of numerics-problem-of."
  (apply #'numerics-problem-of
         (numerics-read-program record
                                (or names (cdr (algebra-record-part record '$states))))
         options))

(defun numerics-problem-of (program &key (jacobian t) (how :auto) (calls 0))
  "JACOBIAN nil leaves the jacobian for numerics-add-jacobian. HOW is :machine, :compiled or :auto,
by the number of CALLS of the rates that are expected."
  (let ((problem (make-numerics-problem
                  :size (length (numerics-program-names program))
                  :rates (numerics-routine program (numerics-program-rates program)
                                           :how how :calls calls)
                  :mass (numerics-mass-matrix program)
                  :names (numerics-program-names program)
                  :timed (numerics-timed-p program)
                  :split (numerics-split program) :program program)))
    (if jacobian
        (numerics-add-jacobian problem :how how)
        problem)))

;;; M by columns.

(defun numerics-mass-matrix (program)
  (let* ((rows (numerics-program-mass program))
         (entries (sort (loop for row in rows
                              for i from 0
                              append (loop for (j . element) in row collect (list j i element)))
                        #'numerics-entry-before-p)))
    (when rows
      (make-numerics-matrix
       :pattern (numerics-pattern-of (length rows) entries)
       :values (coerce (numerics-constant-doubles (mapcar #'third entries)) 'numerics-vector)))))

(defun numerics-constant-doubles (elements)
  "The double-float numbers of ELEMENTS, which are constant."
  (let ((values (numerics-constant-values (algebra-live-nodes elements) elements)))
    (loop for element in elements
          collect (numerics-constant-double
                   (if (algebra-node-p element)
                       (or (gethash (algebra-node-index element) values)
                           (core-error "the matrix mass depends on the state or the time"))
                       element)))))

(defun numerics-timed-p (program)
  (some (lambda (node) (and (algebra-input-p node) (eq (algebra-node-left node) '$t)))
        (algebra-live-nodes (numerics-program-rates program))))

;;; x = (q, v) with q' = v.

(defun numerics-split (program)
  "Half the number of states where the rates of the first half are the states of the second."
  (let* ((states (numerics-program-states program)) (k (floor (length states) 2)))
    (and (evenp (length states))
         (every #'eq (subseq (numerics-program-rates program) 0 k) (nthcdr k states))
         (loop for row in (numerics-program-mass program)
               for i from 0
               always (or (equal row (list (cons i 1)))
                          (and (>= i k) (loop for (j) in row always (>= j k)))))
         k)))
