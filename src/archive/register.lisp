;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The kinds of archive, each one form: what it describes, its keys and sections, the quantities
;;; that it has; and the options of every call. Data only. A row is (name type default help
;;; question), as src/archive/keys.lisp explains. What makes a quantity of a kind is stated in the
;;; register of the room that makes it, unless it is a key.

(in-package :maxima)

(core-option :truth "save" "verbose" "progress")
(core-option :seconds "limit")
(core-option :factor "size")
(core-option :file "result")
(core-option '("auto" "canonical" "factored" "program") "form")

(defparameter *archive-action-rows*
  '(("rayleigh" :expression "0" "Rayleigh's function of dissipation" "Rayleigh's function")
    ("forces" :expressions "[]"
     "generalized forces Q_i, in the order of the coordinates" "Generalized forces")
    ("momenta" :assignments "[]"
     "names or values of momenta by coordinate, such as [phi = p]; some or all"
     "Momenta by coordinate")
    ("constraints" :vanishing "[]" "holonomic constraints, on coordinates and time"
     "Holonomic constraints")
    ("nonholonomic" :vanishing "[]"
     "constraints linear in the velocities" "Nonholonomic constraints"))
  "Keys of what acts beside Lagrange's function.")

(defparameter *archive-integral-rows*
  '(("integrals" :assignments "[]" "known first integrals, by name" "First integrals")))

(defparameter *archive-combination-rows*
  '(("K" :combination nil
     "the function of the integrals that the method of Routh and Lyapunov takes, ~
      such as H + mu*V1^2; their linear combination unless given"
     "Function of the integrals, if it is not linear")))

(core-kind "mechanical" "rigid bodies, with springs, dampers and forces"
  :first
  '(("bodies" :count :required "number of bodies: exactly the sections [body 1] to [body n]"
     "Number of bodies")
    ("coordinates" :names :required "generalized coordinates" "Coordinates"))
  :keys
  `(("prescribed" :assignments "[]" "functions of time that the user gives, such as [sg = n*t]"
     "Prescribed functions of time")
    ("field" :field "none" "field of force" "Field of force")
    ("gravity" :vector (:when "field" "constant") "acceleration of gravity, in axes 0"
     "Acceleration of gravity, in axes 0")
    ("nu" :expression (:when "field" "newton")
     "strength of the Newtonian centre, its gravitational parameter"
     "Strength nu of the attracting centre")
    ("distance" :expression (:when "field" "newton") "distance from the attracting centre to O_1"
     "Distance from the attracting centre to O_1")
    ("direction" :vector (:when "field" "newton")
     "unit vector from the attracting centre to O_1, in axes 0"
     "Unit vector from the attracting centre to O_1, in axes 0")
    ("force_function" :expression "0"
     "added to U, the force function of the field" "Further force function")
    ,@*archive-action-rows*)
  :sections
  '((("body" :counted "one body; [body 1] to [body n]" "bodies")
     ("parent" :parent "0" "body or frame that carries this body; 0 is the fixed axes" "Parent")
     ("axes" :axes "[]"
      "axes of the turns in their order, each carried by the turns before it; ~
       [] for a body that only slides"
      "Axes of the turns")
     ("angles" :expressions "[]"
      "angles of the turns, right-handed, one for each axis" "Angles of the turns")
     ("joint" :vector "[0, 0, 0]" "from the parent's origin to this body's, in the parent's axes"
      "Position of the joint, in the parent's axes")
     ("velocity" :velocity "auto"
      "velocity of the joint relative to the parent, in the parent's axes; auto is d/dt of joint"
      "Velocity of the joint, in the parent's axes")
     ("centre" :vector "[0, 0, 0]"
      "centre of mass, in the body's axes" "Centre of mass, in the body's axes")
     ("mass" :expression :required "mass of the body; 0 for axes that carry others" "Mass")
     ("inertia" :inertia nil
      "tensor of inertia about the joint, in the body's axes; ~
       a point mass at the centre unless given"
      "Inertia about the joint")
     ("inertia_centre" :inertia nil
      "tensor of inertia about the centre of mass, instead" "Inertia about the centre of mass")
     ("momentum" :vector nil "constant relative momentum of rotors inside, in the body's axes"
      "Constant momentum of rotors inside")
     ("own_spin" :spin nil
      "turn of a body of revolution about an axis of its own, which the body's axes do not follow"
      "Own spin")
     ("rotor" :rotor nil
      "for a body of one axis whose angle is no coordinate: ~
       of given momentum h, speed w or torque Q"
      "Rotor"))
    (("frame" :named "axes without mass")
     ("parent" :parent "0" "body or frame that carries these axes; 0 is the fixed axes" "Parent")
     ("axes" :axes "[]" "axes of the turns in their order, each carried by the turns before it"
      "Axes of the turns")
     ("angles" :expressions "[]" "angles of the turns, right-handed, one for each axis"
      "Angles of the turns")
     ("joint" :vector "[0, 0, 0]" "from the parent's origin to this one, in the parent's axes"
      "Position of the origin, in the parent's axes")
     ("velocity" :velocity "auto"
      "velocity of the origin relative to the parent; auto is d/dt of joint"
      "Velocity of the origin, in the parent's axes"))
    (("spring" :numbered "a spring, a damper, or both")
     ("angle" :expression nil
      "the angle it acts on, for a spring that turns" "Angle that it acts on, if it turns")
     ("between" :pair (:unless "angle" nil)
      "the two bodies; 0 is the fixed axes" "Bodies that it joins")
     ("points" :points (:with "between" "[[0, 0, 0], [0, 0, 0]]")
      "its ends, each in the axes of its body" "Ends, in the bodies' axes")
     ("stiffness" :expression "0" "force over elongation, or torque over angle" "Stiffness")
     ("length" :expression (:with "between" "0") "length of the unloaded spring" "Length at rest")
     ("rest" :expression (:with "angle" "0") "angle of the unloaded spring" "Angle at rest")
     ("damping" :expression "0"
      "adds damping*(rate of length or angle)^2/2 to Rayleigh's function" "Damping"))
    (("force" :numbered "a force on a body")
     ("body" :parent :required "the body it acts on" "Body that it acts on")
     ("point" :vector "[0, 0, 0]" "where it acts, in the body's axes" "Point, in the body's axes")
     ("vector" :vector :required "components of the force" "Components")
     ("axes" :parent "0"
      "the axes of its components: 0, a body, a frame" "Axes of its components"))
    (("torque" :numbered "a torque on a body")
     ("body" :parent :required "the body it acts on" "Body that it acts on")
     ("vector" :vector :required "components of the torque" "Components")
     ("axes" :parent "0"
      "the axes of its components: 0, a body, a frame" "Axes of its components")))
  :gives '("Lagrangian"))

(core-kind "lagrangian" "Lagrange's function of generalized coordinates"
  :first
  '(("coordinates" :names :required "generalized coordinates" "Coordinates"))
  :keys
  `(("lagrangian" :expression (:unless "hamiltonian" nil)
     "Lagrange's function of coordinates and velocities"
     "Lagrangian")
    ("hamiltonian" :expression nil
     "Hamilton's function of coordinates and momenta, instead; it needs `momenta`"
     "Hamiltonian")
    ,@*archive-action-rows*
    ,@*archive-integral-rows*)
  :agreement '("archive/names" archive-check-coordinates)
  :gives '(("Lagrangian" "lagrangian")))

(core-kind "circuit" "the branches of a circuit"
  :keys
  '(("sign" :sign "passive"
     "passive: a positive resistance takes energy; generator: it feeds energy; ~
      a graph implies generator"
     "Sign convention")
    ("graph" :graph nil
     "the branches as a list of pairs of nodes, instead of [branches]" "Graph as a list")
    ("states" :states "[]"
     "names of currents and voltages, by label; without branches inductances and capacitances"
     "Names of states, by label")
    ("potential" :expression nil
     "mixed potential P(i, u), if it is not to be found from the branches; ~
      with states it may stand without them"
     "Mixed potential, if it is given")
    ("datum" :node nil "node of zero potential; the first node of the first branch unless given"
     "Node of zero potential")
    ("nodes" :nodes "[]"
     "what nodes were called in the netlist that the archive was read from" nil)
    ("tree" :tree nil
     "labels of the branches of the proper tree, such as [C1, C2]; found unless given; ~
      cyclic: loop charges of which as many as may be are cyclic"
     "Labels of the tree's branches"))
  :sections
  '((("branches" :rows "[label:] node -> node  type  value  [state]"
      ("archive/circuit_rows" archive-parse-branch)))
    (("couplings" :rows "label label  M, or label label  k = number"
      ("archive/circuit_rows" archive-parse-coupling)))
    (("transformers" :rows "node -> node : node -> node  ratio n"
      ("archive/circuit_rows" archive-parse-transformer))))
  :instead "graph"
  :completed '("archive/circuit_names" archive-circuit-completed)
  :gives '("Lagrangian" ("state_equations" "StateEquations") "structure_graph"))

(core-kind "equations" "equations of motion of the first order"
  :first
  '(("variables" :names :required "the variables" "Variables"))
  :keys
  `(("equations" :rates :required "equations of motion" "Equations")
    ("integrals" :assignments "[]" "known first integrals, by name" "First integrals")
    ("level" :vanishing "[]"
     "the integrals hold only where these vanish" "Where the integrals hold")
    ("multipliers" :names nil
     "names of the multipliers mu_j; mu0, mu1, ... unless given" "Names of the multipliers")
    ,@*archive-combination-rows*)
  :agreement '("archive/names" archive-check-equations)
  :gives '(("state_equations" "rated_equations") ("known_integrals" "integrals")))

(core-kind "poisson" "Hamilton's function and the brackets of its variables"
  :first
  '(("algebra" :algebra nil
     "a Lie algebra; its variables are those below, in this order" "Lie algebra")
    ("bracket" :skew (:unless "algebra" nil)
     "the matrix of brackets {x_i, x_j}, instead of an algebra" "Matrix of brackets")
    ("variables" :names (:unless "algebra" "[M1, M2, M3, g1, g2, g3]")
     "the variables" "Variables"))
  :keys
  `(("hamiltonian" :expression :required "Hamilton's function" "Hamiltonian")
    ,@*archive-integral-rows*
    ,@*archive-combination-rows*)
  :gives '(("state_equations" "poisson_equations") ("known_integrals" "poisson_integrals")))

;;; SPICE netlists

(core-option :truth "replace")
(core-public "ReadNetlist" :forms '(("netlist" "netlist" "archive")) :options '("replace"))
(core-rule "ReadNetlist" '("netlist") "archive/read_netlist" "archive_read_netlist"
  "netlist" "archive" '("replace" nil))
