;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What Dirac's scheme reckons with: the degenerate function it starts from, the chain of
;;; constraints, the surface on which they vanish, and rows of linear equations on it.

(in-package :maxima)

(core-record forms-degenerate
  "A degenerate Lagrange's function in canonical variables: H, the rank of d2L/dq'dq', the primary
constraints and their multipliers u1, ..; all q and p are `variables', in the order in which
constraints are solved for them."
  coordinates momenta hamiltonian rank primary multipliers variables)

(core-record forms-dirac-chain
  "The constraints found so far, the primary ones first; the surface on which they vanish; those
that were irregular, f^k = 0; the multipliers, equations, once they are determined."
  constraints surface irregular (multipliers '((mlist simp))))

(core-record forms-surface-power
  "An equation of the surface, variable^degree = value."
  variable degree value)

(core-record forms-candidate
  "A variable that a constraint can be solved for; the smaller EASE, the better. The constraint is
of this degree in it, with this leading coefficient."
  ease variable degree leading)

(core-record forms-numbered-row
  "One of the rows of equations, [C_1, .., C_m, h], by its number among them."
  number entries)

(core-record forms-pivot
  "The row of that number, solved for the unknown of its column."
  number column entries)

(core-record forms-residual
  "What is left of the row of that number when all unknowns are eliminated."
  number value)
