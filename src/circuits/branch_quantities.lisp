;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What each branch does: voltages and currents of all branches, potentials of all nodes, in the
;;; independent states, the sources and their rates. A winding that others determine (k = 1) and the
;;; inductor that magnetizes it, a resistor of an affine law and the source beside it, are here the
;;; branches that the description has. See circuits_branch_quantities first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/coefficients" "circuits/elements" "circuits/graph"
                "circuits/tableau" "circuits/tableau_equations"
                "circuits/tableau_reduction"))

(defun $circuits_branch_quantities (circuit solution)
  "[voltages = [label = .., ..], currents = .., potentials = [node = .., ..]]"
  (when (circuits-solution-states solution) (circuits-find-rates solution))
  (let ((branches (circuits-described-branches circuit)))
    (flet ((part (name keys rows)
             (list '(mequal simp) name
                   (circuits-equations-of keys (circuits-expressed solution rows)))))
      (list '(mlist simp)
            (part '$voltages (mapcar #'circuits-branch-label branches)
                  (loop for branch in branches
                        collect (circuits-branch-voltage-row solution branch)))
            (part '$currents (mapcar #'circuits-branch-label branches)
                  (loop for branch in branches
                        collect (circuits-branch-current-row solution branch)))
            (let ((nodes (circuits-described-nodes circuit)))
              (part '$potentials nodes
                    (loop for node in nodes
                          collect (circuits-potential-row solution node))))))))

(defun circuits-described-branches (circuit)
  "All but the sources of affine laws."
  (remove-if #'circuits-of-a-law-p (cdr (circuits-circuit-branches circuit))))

(defun circuits-described-nodes (circuit)
  (cdr ($circuits_nodes
        (cons '(mlist simp)
              (append (mapcar #'$circuits_ends (cdr (circuits-circuit-branches circuit)))
                      (loop for transformer in (cdr (circuits-circuit-transformers circuit))
                            collect (circuits-transformer-pair transformer)
                            collect (circuits-transformer-driven transformer)))))))

(defun circuits-potential-row (solution node)
  (let ((row (circuits-new-row))
        (column (gethash (list :potential node)
                         (circuits-tableau-columns (circuits-solution-tableau solution)))))
    (when column (circuits-add-solved row column 1 (circuits-solution-solved solution)))
    (circuits-final-row solution row)))

(defun circuits-law-direction (tableau branch)
  "1 where the voltage counts along the arrow, -1 where the other way."
  (if (circuits-type-in-p branch '|$l| '|$c| '|$r| '|$ru| '|$ri|)
      (circuits-tableau-sign tableau)
      1))

(defun circuits-branch-voltage-row (solution branch)
  (circuits-difference-row-of
   solution ($circuits_ends branch)
   (circuits-law-direction (circuits-solution-tableau solution) branch)))

(defun circuits-branch-current-row (solution branch)
  (let* ((tableau (circuits-solution-tableau solution)) (row (circuits-new-row))
         (result (circuits-new-row)))
    (circuits-add-current tableau row
                          (circuits-branch-at tableau (circuits-branch-number branch)) 1)
    (maphash (lambda (column x)
               (circuits-add-solved result column x (circuits-solution-solved solution)))
             row)
    (circuits-final-row solution result)))

(defun $circuits_tableau_windings (solution)
  "[i_k = i_km - sum w*i_j, .., i_j = ..]: the currents of windings with k = 1 and of those that
magnetize them."
  (let ((tableau (circuits-solution-tableau solution)))
    (append (circuits-circuit-magnetizing (circuits-tableau-circuit tableau))
            (cdr (circuits-equations-of
                  (loop for branch in (circuits-shorted-windings tableau)
                        collect (circuits-branch-state branch))
                  (circuits-expressed solution
                                      (loop for branch in (circuits-shorted-windings tableau)
                                            collect (circuits-branch-current-row
                                                     solution branch))))))))

(defun circuits-shorted-windings (tableau)
  (loop for branch across (circuits-tableau-branches tableau)
        when (and (eq (circuits-branch-type branch) '|$e|) (circuits-branch-state branch))
          collect branch))

(defun $circuits_tableau_determines (solution)
  "Whether the states alone determine all currents and voltages."
  (null (circuits-solution-free solution)))
