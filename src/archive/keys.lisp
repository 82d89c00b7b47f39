;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The table of keys: every section and key of an archive, once, with kind of system, type,
;;; default, help and question. The check, the dialog, the messages and the table in
;;; doc/archive.md all come from here; plain data, no Maxima in it. A row is (name type default
;;; help question), the help a format's control without arguments. The default is text as it
;;; would stand in the archive; nil where the key may be absent; :required; (:when key value)
;;; required if that key has that value; (:unless key [text]) required if that is absent, else of
;;; the default text; (:with key text) a default that makes sense beside that key only.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/types" "core/nearest"))

(defparameter *archive-analysis-keys*
  '("title" "where" "abbreviations" "unknowns" "solution" "values" "start" "time")
  "Keys that are no part of the structure of a system.")

(defparameter *archive-sections*
  '(("top" :all :one "the lines before the first header")
    ("system" :all :one "the whole system")
    ("body" ("mechanical") :counted "one body; [body 1] to [body n]")
    ("frame" ("mechanical") :named "axes without mass")
    ("spring" ("mechanical") :numbered "a spring, a damper, or both")
    ("force" ("mechanical") :numbered "a force on a body")
    ("torque" ("mechanical") :numbered "a torque on a body")
    ("branches" ("circuit") :rows "[label:] node -> node  type  value  [state]")
    ("couplings" ("circuit") :rows "label label  M, or label label  k = number")
    ("transformers" ("circuit") :rows "node -> node : node -> node  ratio n"))
  "Name, kinds, how many there are, meaning.")

(defparameter *archive-key-rows*
  '((("top" :all)
     ("dynarch" :version :required "version of the format" "Version of the format")
     ("kind" :kind :required "kind of system" "Kind of system")
     ("title" :text nil "a line about the system, for the reader" "Title"))

    (("system" ("mechanical"))
     ("bodies" :count :required "number of bodies: exactly the sections [body 1] to [body n]"
      "Number of bodies")
     ("coordinates" :names :required "generalized coordinates" "Coordinates"))
    (("system" ("lagrangian"))
     ("coordinates" :names :required "generalized coordinates" "Coordinates"))
    (("system" ("equations"))
     ("variables" :names :required "the variables" "Variables"))
    (("system" ("poisson"))
     ("algebra" :algebra nil
      "a Lie algebra; its variables are those below, in this order" "Lie algebra")
     ("bracket" :skew (:unless "algebra")
      "the matrix of brackets {x_i, x_j}, instead of an algebra" "Matrix of brackets")
     ("variables" :names (:unless "algebra" "[M1, M2, M3, g1, g2, g3]")
      "the variables" "Variables"))

    (("system" :all)
     ("parameters" :facts "[]"
      "names with what is assumed of them; names not listed are free symbols, with a warning"
      "Parameters, with what is assumed of them")
     ("functions" :names "[]" "functions left open" "Names of functions left open")
     ("laws" :laws "[]" "formulas of such functions, where known" "Formulas of these functions"))

    (("system" ("mechanical"))
     ("prescribed" :assignments "[]" "functions of time that the user gives, such as [sg = n*t]"
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
      "added to U, the force function of the field" "Further force function"))

    (("system" ("lagrangian"))
     ("lagrangian" :expression (:unless "hamiltonian")
      "Lagrange's function of coordinates and velocities"
      "Lagrangian")
     ("hamiltonian" :expression nil
      "Hamilton's function of coordinates and momenta, instead; it needs `momenta`"
      "Hamiltonian"))

    (("system" ("mechanical" "lagrangian"))
     ("rayleigh" :expression "0" "Rayleigh's function of dissipation" "Rayleigh's function")
     ("forces" :expressions "[]"
      "generalized forces Q_i, in the order of the coordinates" "Generalized forces")
     ("momenta" :assignments "[]"
      "names or values of momenta by coordinate, such as [phi = p]; some or all"
      "Momenta by coordinate")
     ("constraints" :vanishing "[]" "holonomic constraints, on coordinates and time"
      "Holonomic constraints")
     ("nonholonomic" :vanishing "[]"
      "constraints linear in the velocities" "Nonholonomic constraints"))

    (("system" ("circuit"))
     ("sign" :sign "passive"
      "passive: a positive resistance takes energy; generator: it feeds energy; ~
       a graph implies generator"
      "Sign convention")
     ("graph" :graph nil
      "the branches as a list of pairs of nodes, instead of [branches]" "Graph as a list")
     ("states" :states "[]"
      "names of currents and voltages, by label" "Names of states, by label")
     ("potential" :expression nil
      "mixed potential P(i, u), if it is not to be found from the branches"
      "Mixed potential, if it is given")
     ("datum" :node nil "node of zero potential; the first node of the first branch unless given"
      "Node of zero potential")
     ("tree" :names nil
      "labels of the branches of the proper tree, such as [C1, C2]; found unless given"
      "Labels of the tree's branches"))

    (("system" ("equations"))
     ("equations" :rates :required "equations of motion" "Equations")
     ("integrals" :assignments "[]" "known first integrals, by name" "First integrals")
     ("level" :vanishing "[]"
      "the integrals hold only where these vanish" "Where the integrals hold")
     ("multipliers" :names nil
      "names of the multipliers mu_j; mu0, mu1, ... unless given" "Names of the multipliers"))
    (("system" ("poisson"))
     ("hamiltonian" :expression :required "Hamilton's function" "Hamiltonian"))
    (("system" ("lagrangian" "poisson"))
     ("integrals" :assignments "[]" "known first integrals, by name" "First integrals"))

    (("system" :all)
     ("values" :numbers "[]"
      "numbers for runs; symbolic functions ignore them" "Numbers for runs")
     ("where" :assignments "[]"
      "special case for the analysis, put into the equations after they are formed"
      "Special case for the analysis")
     ("abbreviations" :assignments "[]"
      "names for printing results, such as [rho = 4*g1*s1^2]" "Abbreviations")
     ("unknowns" :names nil
      "what equilibria and stationary motions are solved for; the rest stays free"
      "What is solved for")
     ("solution" :motion nil
      "the motion to be judged, perhaps as x = r*W*t; velocities and momenta not named are 0"
      "Motion to be judged")
     ("start" :motion nil "start values of a run" "Start values of a run")
     ("time" :span nil "span of a run" "Span of a run"))

    (("body" ("mechanical"))
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

    (("frame" ("mechanical"))
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

    (("spring" ("mechanical"))
     ("angle" :expression nil
      "the angle it acts on, for a spring that turns" "Angle that it acts on, if it turns")
     ("between" :pair (:unless "angle")
      "the two bodies; 0 is the fixed axes" "Bodies that it joins")
     ("points" :points (:with "between" "[[0, 0, 0], [0, 0, 0]]")
      "its ends, each in the axes of its body" "Ends, in the bodies' axes")
     ("stiffness" :expression "0" "force over elongation, or torque over angle" "Stiffness")
     ("length" :expression (:with "between" "0") "length of the unloaded spring" "Length at rest")
     ("rest" :expression (:with "angle" "0") "angle of the unloaded spring" "Angle at rest")
     ("damping" :expression "0"
      "adds damping*(rate of length or angle)^2/2 to Rayleigh's function" "Damping"))

    (("force" ("mechanical"))
     ("body" :parent :required "the body it acts on" "Body that it acts on")
     ("point" :vector "[0, 0, 0]" "where it acts, in the body's axes" "Point, in the body's axes")
     ("vector" :vector :required "components of the force" "Components")
     ("axes" :parent "0"
      "the axes of its components: 0, a body, a frame" "Axes of its components"))
    (("torque" ("mechanical"))
     ("body" :parent :required "the body it acts on" "Body that it acts on")
     ("vector" :vector :required "components of the torque" "Components")
     ("axes" :parent "0"
      "the axes of its components: 0, a body, a frame" "Axes of its components"))))

;; The table as records

(defstruct archive-key section kinds name type default help question)

(defparameter *archive-keys*
  (loop for ((section kinds) . rows) in *archive-key-rows*
        append (loop for (name type default help question) in rows
                     collect (make-archive-key :section section :kinds kinds :name name :type type
                                               :default default :help (format nil help)
                                               :question question))))

(defun archive-serves-p (kinds kind)
  (or (eq kinds :all) (member kind kinds :test #'string=)))

(defun archive-keys (kind section)
  "The keys of SECTION (its first word) in archives of KIND, in the order in which they are
asked."
  (remove-if-not (lambda (key) (and (string= section (archive-key-section key))
                                    (archive-serves-p (archive-key-kinds key) kind)))
                 *archive-keys*))

(defun archive-find-key (kind section name)
  "The record of the key NAME of SECTION in archives of KIND, or nil."
  (find name (archive-keys kind section) :key #'archive-key-name :test #'string=))

(defun archive-key-kinds-of (section name)
  "The kinds of archive that have the key NAME in SECTION."
  (remove-if-not (lambda (kind) (archive-find-key kind section name)) *archive-kinds*))

(defun archive-default (key)
  "The default of KEY as text, or nil."
  (let ((default (archive-key-default key)))
    (cond ((stringp default) default)
          ((and (consp default) (member (first default) '(:with :unless))) (third default)))))

(defun archive-overrulable-p (key)
  "Whether an option of a call may overrule KEY: all of [system] but the count of sections."
  (and (string= (archive-key-section key) "system")
       (not (string= (archive-key-name key) "bodies"))))

(defun archive-option-keys (kind)
  "The keys that an option of a call may overrule in archives of KIND."
  (remove-if-not #'archive-overrulable-p (archive-keys kind "system")))

(defun archive-sections-of (kind)
  "The sections of an archive of KIND, rows of *archive-sections*."
  (remove-if-not (lambda (section) (archive-serves-p (second section) kind)) *archive-sections*))

(defun archive-section-row (word)
  (find word *archive-sections* :key #'first :test #'string=))

(defun archive-section-word (section)
  "The first word of a section's name: \"body\" of \"body 2\"."
  (subseq section 0 (position #\Space section)))

;; A value that does not fit

(defun archive-mismatch (key value trouble)
  "The sentence for a VALUE that is not what KEY wants."
  (format nil "~a must be ~a, found ~a~:[; ~a~;~]" (archive-key-name key)
          (archive-type-phrase (archive-key-type key)) (archive-value-shown value)
          (string= trouble "") trouble))

;; The table as text, for the manual

(defun archive-kinds-text (kinds)
  (if (eq kinds :all) "all" (format nil "~{~a~^, ~}" kinds)))

(defun archive-default-text (key)
  (let ((default (archive-key-default key)))
    (cond ((null default) "")
          ((eq default :required) "required")
          ((stringp default) (format nil "`~a`" default))
          ((eq (first default) :when)
           (format nil "required if `~a = ~a`" (second default) (third default)))
          ((eq (first default) :with)
           (format nil "`~a`, beside `~a`" (third default) (second default)))
          (t (format nil "required without `~a`~@[, else `~a`~]" (second default)
                     (third default))))))

(defun archive-print-keys-table (stream)
  "The table in markdown, a part for each section."
  (dolist (section *archive-sections*)
    (format stream "### ~a~%~%~a~%~%"
            (if (string= (first section) "top") "Before the first header"
                (format nil "`[~a]`" (archive-heading section)))
            (if (eq (third section) :rows) (format nil "Rows: `~a`" (fourth section))
                (archive-capital (fourth section))))
    (unless (eq (third section) :rows) (archive-print-section-table (first section) stream))))

(defun archive-capital (text)
  (format nil "~a~a." (string-upcase (subseq text 0 1)) (subseq text 1)))

(defun archive-heading (section)
  (case (third section)
    ((:counted :numbered) (format nil "~a k" (first section)))
    (:named (format nil "~a name" (first section)))
    (t (first section))))

(defun archive-print-section-table (section stream)
  (format stream "| key | kinds | value | default | meaning |~%|---|---|---|---|---|~%")
  (dolist (key *archive-keys*)
    (when (string= section (archive-key-section key))
      (format stream "| `~a` | ~a | ~a | ~a | ~a |~%" (archive-key-name key)
              (archive-kinds-text (archive-key-kinds key))
              (archive-type-phrase (archive-key-type key)) (archive-default-text key)
              (archive-key-help key))))
  (terpri stream))
