;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a circuit consists of, as records: branches, transformers, mutual inductances; the circuit
;;; itself and what is derived of it. A branch is known by its number, its place in the list of
;;; branches.

(in-package :maxima)

(core-record circuits-branch
  "Types L C R RU RI E I EV G F H O (ARCHIVE: kind = circuit). `state' is the name of the current
of an L, of the voltage of a C, else false; `control' the nodes or the label that control a source,
the two inputs of an O."
  label tail head type value number (state nil) (control '((mlist simp))))

(core-record circuits-transformer
  "Of nodes pair = [a, b], driven = [c, d]: u_ab = ratio*u_cd, i_cd = -ratio*i_ab."
  pair driven ratio)

(core-record circuits-coupling
  "Inductors numbered `one' and `other'; mutual inductance M, and k where that was given, else
false."
  one other mutual k)

(core-record circuits-winding
  "The inductor of that number where others determine it, u = sum w*u_k, by the sparse row of the
weights, [k, w]."
  number weights)

;;; What is derived of a circuit, each from the one above with more known of it: the circuit as it
;;; was read, the same with a tree, the network.

(core-record circuits-circuit
  "Branches; sign 1, passive, or -1, generator; the section of the branches, for messages; laws
[f(u) = .., ..]. `windings' are those that others determine; made ideal, they stand in `ideal', and
`magnetizing' gives the currents of the inductors that magnetize them,
`datum' is the node of zero potential, `potential' a given P, else false. `named_states' are those
that the key `states' names, in its order."
  branches sign section laws
  (couplings '((mlist simp))) (transformers '((mlist simp))) (windings '((mlist simp)))
  (ideal '((mlist simp)))
  (magnetizing '((mlist simp))) (chosen_tree '((mlist simp))) (datum '$none) (potential nil)
  (named_states '((mlist simp))))

(core-record (circuits-structure circuits-circuit)
  "With a tree: numbers of the branches in it, of the links outside; for each branch its loop, a
sparse row [tree branch, K], [] for tree branches, and its cut, the [link, K] of the links whose
loops hold it."
  tree links loops cuts)

(core-record (circuits-network circuits-structure)
  "Kirchhoff's laws solved. Numbers of the branches by what they are in the tree; names of the
independent states, `currents' and `voltages'; what links carry and tree branches bear as it is, and
with all states zero; dependent states as equations; the matrices of the independent states and the
potentials of what varying sources force, once they are derived."
  (inductors nil) (dependent_inductors nil) (capacitors nil) (dependent_capacitors nil)
  (tree_resistors nil) (link_resistors nil) (mesh_tree nil) (mesh_links nil)
  (voltage_sources nil) (current_sources nil)
  (currents nil) (voltages nil)
  (link_currents nil) (link_currents_at_rest nil) (tree_voltages nil) (tree_voltages_at_rest nil)
  (dependent_currents nil) (dependent_voltages nil)
  (inductance nil) (forced_voltages nil) (capacitance nil) (forced_currents nil))

(core-record circuits-stores
  "What equations are made from: the states with their matrices of inductance and capacitance."
  currents inductance voltages capacitance)

(defun $circuits_ends (branch)
  "[tail, head]"
  (list '(mlist simp) (circuits-branch-tail branch) (circuits-branch-head branch)))

(defun $circuits_all_ends (branches transformers)
  "The same of all BRANCHES, then of both windings of each of TRANSFORMERS."
  (cons '(mlist simp)
        (append (mapcar #'$circuits_ends (cdr branches))
                (loop for transformer in (cdr transformers)
                      collect (circuits-transformer-pair transformer)
                      collect (circuits-transformer-driven transformer)))))
