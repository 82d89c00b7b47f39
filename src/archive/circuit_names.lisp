;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What an archive says of a circuit: its branches, from their section or from the list of a graph,
;;; and the names that rows declare and use: labels, states, and the values of branches. A branch is
;;; [n1, n2, type, value] with the name of its state behind, or label = this list.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/types" "archive/groups"))

;;; Branches that stand in a graph

(defun archive-graph-group (rows)
  "The branches of a graph as a group."
  (make-archive-group :section "branches"
                      :statements (mapcar (lambda (row) (make-archive-statement :value row))
                                          (cdr rows))))

(defun archive-without-graph (equations sign-given)
  "The equations of [system] with `graph' taken out; it implies sign = generator."
  (loop for equation in equations
        unless (eq (second equation) '$graph)
          collect (if (and (eq (second equation) '$sign) (not sign-given))
                      (archive-equation '$sign '$generator)
                      equation)))

(defun archive-circuit-completed (system groups)
  "Two values: the equations of SYSTEM without graph, and GROUPS with the branches, whether these
stand in [branches] or in graph."
  (let ((graph (find '$graph system :key #'second))
        (branches (archive-find-group groups "branches"))
        (given (archive-find-group groups "system")))
    (cond ((and graph branches)
           (core-fault "system" "graph"
                       "the branches stand twice, in graph and in [branches]; leave one of them ~
                        out"))
          (graph (values (archive-without-graph system
                                                (and (archive-find-statement given "sign") t))
                         (cons (archive-graph-group (third graph)) groups)))
          (branches (values system groups))
          (t (archive-check-potential-alone system)
             (values system groups)))))

(defun archive-check-potential-alone (system)
  "An error unless SYSTEM gives a potential and its states where there are no branches."
  (flet ((given (key) (third (find key system :key #'second))))
    (cond ((not (given '$potential))
           (core-fault "system" nil "a circuit has branches; add a section [branches], the key ~
                                     graph, or a potential with its states"))
          ((null (cdr (given '$states)))
           (core-fault "system" "states" "a potential without branches needs its states with ~
                                          their inductances and capacitances, such as states = ~
                                          [i1 = L1, u3 = C3]")))))

;;; Names

(defparameter *archive-row-value-field* 3
  "Place of the value in a branch's fields: n1, n2, type, value.")

(defun archive-row-fields (row)
  (cdr (archive-right-side row)))

(defun archive-row-type (row) (third (archive-row-fields row)))

(defun archive-branch-value (row)
  "The value of a branch, in a list; nil where it has none, as an operational amplifier."
  (let ((fields (nthcdr *archive-row-value-field* (archive-row-fields row))))
    (and fields (not (eq (archive-row-type row) '|$o|)) (list (first fields)))))

(defun archive-row-labels (row)
  "What the branch may be called by: its label, or its value when that is a name."
  (remove-if-not #'archive-symbol-p
                 (if (archive-equation-p row) (list (second row)) (archive-branch-value row))))

(defun archive-row-states (row)
  "The state that the row names, and the names it would have by default."
  (append (archive-row-own-state row)
          (loop for label in (archive-row-labels row)
                append (list (core-symbol (format nil "i_~a" (core-spelling label)))
                             (core-symbol (format nil "u_~a" (core-spelling label)))))))

(defun archive-last-fields (rows)
  "The values of couplings and transformers: M, the right side of k = 0.9, the ratio."
  (loop for row in (cdr rows)
        for value = (car (last (archive-row-fields row)))
        collect (archive-right-side value)))

(defun archive-row-own-state (row)
  "The state that the row of an inductor or a capacitor names, in a list."
  (let ((fields (archive-row-fields row)))
    (and (member (third fields) '(|$l| |$c|))
         (remove-if-not #'archive-symbol-p (nthcdr (1+ *archive-row-value-field*) fields)))))
