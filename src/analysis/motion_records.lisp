;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The records of the analysis. A motion is what everything is asked about: the first
;;; approximation, the structure of forces, stability. It is derived once, in given_solution.mac.

(in-package :maxima)

(core-record analysis-special-cases
  "What is put into equations, special cases `where' and laws of open functions, and what of them is
sought, [] being the variables."
  where laws (unknowns '((mlist simp))))

(core-record analysis-motion
  "A stationary motion. `equations' are expressions e that vanish, in plain symbols, laws put in,
the constraints last; `variables' their unknowns, multipliers of the constraints among them, and
`coordinates' these without the multipliers. `values' are [x'' = .., x' = .., x = ..], with those of
parameters that the solution names, and `where' is put in after them. Coordinates that are
`ignorable' do not count in a verdict. Of a linear system that is `moved' from outside the variables
are deviations from any motion."
  equations variables coordinates values where (ignorable '((mlist simp))) (moved nil))

(core-record analysis-found
  "What solving gives: solutions [x = .., ..], sentences on what is left, factors taken as
not zero, components that were too long to be solved: [[[e = 0, ..], dimension], ..]."
  solutions left taken (components '((mlist simp))))

(core-record analysis-sorted
  "Stationary sets [x = .., mu = ..] by what they are for fixed multipliers, see stationary.mac."
  points families manifolds)

(core-record analysis-routh-function
  "Routh's function R = a*v^2/2 + b*v + R0 of one coordinate q, v = q': `square' is a, `linear' is
b, `rest' is R0."
  whole coordinate velocity square linear rest)

(core-record analysis-jacobi-case
  "A case of Jacobi's rule: expressions that are positive, the number of negative squares, the sign
of the last minor, what is left of the conditions."
  positive negative sign conditions)

(core-record analysis-alternative
  "One of the alternatives that a step of solving leaves: what is found, [x = value] or [];
conditions, which vanish; what is apart from zero."
  found conditions (apart '((mlist simp))))

(core-record analysis-naming
  "Conditions in which sines, cosines and roots have names; what these are bound by, and mean:
[name = .., ..], a meaning with other names before theirs."
  conditions unknowns relations meanings)

(core-record analysis-root
  "A root of a polynomial, and what must vanish for it."
  value (conditions '((mlist simp))))

(core-record analysis-judgement
  "What a method, or a theorem, says: cases [[condition, ..], place], see conditions.mac."
  method cases)

(core-record analysis-mixed
  "A mixed potential P(i, u) with L*i' = P_i, C*u' = -P_u: names of the currents and voltages, lists
of the slopes P_i, P_u; as lists of rows the matrices of inductances and capacitances, `resistance'
A = -P_ii, `conductance' B = P_uu, gamma = P_iu."
  whole currents voltages i_slopes u_slopes inductance capacitance resistance conductance gamma)

(core-record analysis-search
  "What the method of Routh and Lyapunov is asked of: the RATES x' of the variables, integrals V_j
with their names and multipliers, among them those of a LEVEL that vanish, and the CONDITIONS that
vanish where sum mu_j*V_j is stationary, or the COMBINATION K(V0, V1, ..) that was given instead
(false where none was). UNITS vanish in each motion of bodies: of unit vectors what
their squares exceed 1, and their product."
  variables rates integrals names multipliers level conditions (units '((mlist simp)))
  (combination nil))

(core-record analysis-manifold
  "A stationary manifold: the SET [x = .., mu = ..], the DEVIATIONS e that vanish on it, and the
RADICANDS that must not be negative."
  set deviations radicands)
