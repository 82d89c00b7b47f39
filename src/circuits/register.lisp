;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the room of circuits can compute from a circuit archive, or from a potential typed in the
;;; session. Data only. The kind "potential" stands for calls on a potential: P, [i1 = L1, ..], [u3
;;; = C3, ..].

(in-package :maxima)

;;; The middle: the circuit as described, its branches checked; the network, sorted by a tree, with
;;; its matrices. A circuit whose network is refused is still checked.

(core-middle "open_circuit" '("circuit") "circuits/circuit" "circuits_read_open_circuit"
  "description")
(core-middle "circuit" '("circuit") "circuits/circuit" "circuits_closed_circuit" "open_circuit")
(core-middle "network" '("circuit") "circuits/network" "circuits_whole_network" "circuit")

;;; A potential without branches

(defparameter *circuits-alone* '(:without "branches"))

(dolist (whole '("circuit" "open_circuit"))
  (core-rule-given *circuits-alone* whole '("circuit") "circuits/potential_alone"
    "circuits_alone_branches"))
(core-rule-given *circuits-alone* "assumptions" '("circuit") "circuits/potential_alone"
  "circuits_alone_assumptions")
(core-rule-given *circuits-alone* "MixedPotential" '("circuit") "circuits/potential_alone"
  "circuits_alone_potential" "potential" '("laws" ((mlist simp))))
(core-rule-given *circuits-alone* "StateEquations" '("circuit") "circuits/potential_alone"
  "circuits_alone_equations" "potential" "MixedPotential" "states" '("laws" ((mlist simp)))
  '("solved" nil))
(core-rule-given *circuits-alone* "PotentialRate" '("circuit") "circuits/potential_alone"
  "circuits_alone_rate" "potential" "MixedPotential" "states" '("laws" ((mlist simp))))
(core-rule-given *circuits-alone* "potential_stores" '("circuit") "circuits/potential_alone"
  "circuits_alone_stores" "potential" "states")

;;; The sparse tableau, solved for independent states

(core-middle "tableau" '("circuit") "circuits/solved_tableau" "circuits_solved_tableau" "circuit")

(core-argument :formula "MixedPotential")
(core-argument :branches "inductances" "capacitances")

(core-rule "assumptions" '("circuit") "circuits/couplings" "circuits_assumptions"
  "open_circuit")
(core-rule "own_parts" '("circuit") "circuits/potential" "circuits_own_parts" "network")

(core-option :truth "pairs")
(core-public "PotentialParts" :options '("pairs") :kinds '("circuit"))
(core-rule "PotentialParts" '("circuit") "circuits/potential" "circuits_potential_parts"
  "circuit" "network" "own_parts")
(core-rule-given '("pairs" t) "PotentialParts" '("circuit") "circuits/potential"
  "circuits_parts_by_pairs" "circuit" "network" "own_parts")

(core-public "MixedPotential" :kinds '("circuit"))
(core-rule "MixedPotential" '("circuit") "circuits/blocks" "circuits_potential_answer"
  "circuit" "network" "own_parts")

(core-option :truth "solved" "matrices")
(core-public "StateEquations"
  :forms '(("potential" "MixedPotential" "inductances" "capacitances"))
  :options '("solved" "matrices") :kinds '("circuit"))
(core-middle "state_system" '("circuit") "circuits/blocks" "circuits_state_system" "circuit")
(core-rule "StateEquations" '("circuit") "circuits/blocks" "circuits_state_answer"
  "state_system" '("solved" nil) '("matrices" nil))
(loop for given in '("potential" (:edited "MixedPotential"))
      do (core-rule-given given "StateEquations" '("circuit") "circuits/state"
           "circuits_system_equations" "tableau" "network" "own_parts" "MixedPotential"
           '("solved" nil) '("matrices" nil)))
(core-rule "variables" '("circuit") "circuits/blocks" "circuits_determined_names"
  "StateEquations" "state_system")
(dolist (given '("potential" (:edited "MixedPotential")))
  (core-rule-given given "variables" '("circuit") "circuits/state" "circuits_rated_names"
    "StateEquations"))
(core-rule "StateEquations" '("potential") "circuits/state" "circuits_state_equations"
  "MixedPotential" "inductances" "capacitances" '("solved" nil))

;;; What each branch does

(core-public "BranchQuantities" :kinds '("circuit"))
(core-middle "opened_tableau" '("circuit") "circuits/open_laws" "circuits_opened_tableau"
  "circuit")
(core-rule "BranchQuantities" '("circuit") "circuits/open_laws" "circuits_opened_quantities"
  "circuit" "opened_tableau")

(core-public "PotentialRate"
  :forms '(("potential" "MixedPotential" "inductances" "capacitances")) :kinds '("circuit"))
(core-rule "PotentialRate" '("circuit") "circuits/state" "circuits_system_rate" "circuit"
  "network" "own_parts" "MixedPotential")
(core-rule "PotentialRate" '("potential") "circuits/state" "circuits_potential_rate"
  "MixedPotential" "inductances" "capacitances")

(core-rule "potential_stores" '("circuit") "circuits/state" "circuits_stores_listed" "circuit"
  "network")

(core-rule "PortHamiltonian" '("circuit") "circuits/ports" "circuits_port_hamiltonian" "circuit")

(core-public "CheckCircuit" :kinds '("circuit"))
(core-rule "CheckCircuit" '("circuit") "circuits/check" "circuits_check" "circuit")

;;; Transfer functions; `poles' gives a record with poles and zeros

(core-option :truth "poles")
(core-argument :quantity "output")
(core-argument :variable "input")
(loop for (name quantity function . trailing)
        in '(("TransferFunction" "response" "circuits_transfer_function" "output" "input")
             ("Impedance" "driving_point" "circuits_impedance" "from_node" "to_node"))
      do (core-public name :trailing trailing :options '("poles") :kinds '("circuit"))
         (dolist (made (list name quantity))
           (apply #'core-rule made '("circuit") "circuits/transfer" function "open_circuit"
                  trailing))
         (core-rule-given '("poles" t) name '("circuit") "circuits/transfer"
           "circuits_poles_and_zeros" quantity))

;;; Rates of a run; where a potential is given, by its equations; Routh's and Hamilton's forms of a
;;; linear circuit are those in loop charges

(core-middle "rates" '("circuit") "circuits/rates_of_circuits" "circuits_circuit_rates" "circuit")
(core-rule-given "potential" "rates" '("circuit") "forms/rates_of_systems" "forms_equation_rates"
  "StateEquations" '("laws" ((mlist simp))) '("variables" ((mlist simp)))
  '("integrals" ((mlist simp))) '("level" ((mlist simp))))
(core-rule "run_start" '("circuit") "circuits/start" "circuits_run_start" "circuit" "rates"
  '("values" ((mlist simp))) "start" "time")
(core-rule-same-as "run_start" '("circuit") "start" :given *circuits-alone*)
(core-rule-same-as "rates" '("circuit") "routh_rates" :given '("function" $routh))
(core-rule-same-as "rates" '("circuit") "hamilton_rates" :given '("function" $hamilton))

;;; Linear circuits have Lagrange's function, and with it every form of equations: in loop charges

;; With `eliminate' in the variables that have inertia, dissipation and potential energy both

(loop for (name quantity function)
        in '(("LoopLagrangian" "loop_form" "circuits_loop_lagrangian")
             ("NodeLagrangian" "node_form" "circuits_node_lagrangian"))
      do (core-public name :options '("eliminate") :kinds '("circuit"))
         (core-rule quantity '("circuit") "circuits/lagrangian" function "circuit")
         (core-rule-same-as name '("circuit") quantity)
         (core-rule-given '("eliminate" t) name '("circuit") "circuits/eliminated_variables"
           "circuits_without_inertialess" quantity))

(loop for (quantity field) in '(("Lagrangian" "L") ("coordinates" "variables") ("rayleigh" "R")
                                ("forces" "Q"))
      do (core-rule-field quantity '("circuit") "LoopLagrangian" field))

;;; What a picture of the graph shows

(core-rule "structure_graph" '("circuit") "circuits/structure_graph" "circuits_structure_graph"
  "circuit")

;;; SPICE netlists: written in each call

(core-option :truth "replace")
(core-rule "netlist_text" '("circuit") "circuits/write_netlist" "circuits_netlist_text" "circuit"
  '("values" ((mlist simp))) '("where" ((mlist simp))) '("nodes" ((mlist simp)))
  "whole_start" '("time" ((mlist simp))))
(core-rule "whole_start" '("circuit") "circuits/start" "circuits_whole_start" "circuit"
  '("values" ((mlist simp))) '("where" ((mlist simp))) '("start" ((mlist simp)))
  '("time" ((mlist simp))))
(core-public "WriteNetlist"
  :trailing '("netlist") :options '("values" "where" "start" "time" "replace")
  :kinds '("circuit"))
(core-act "WriteNetlist" nil '("circuit") "circuits/write_netlist" "circuits_write_netlist"
  "netlist_text" "netlist" '("replace" nil) '("title" ""))
