# SPDX-License-Identifier: GPL-2.0-or-later
# Tables of seconds, ratios and operations, and the verdicts on the targets, from lines PEER SYSTEM N SECONDS OPERATIONS VALUE.

function seconds(p, s, n) { return time[p, s, n] == "" ? "" : time[p, s, n] }
function number(t) { sub(/^>/, "", t); return t + 0 }

# seconds of p over those of o; ">" where p was stopped; 0 for unknown
function ratio(p, o, s, n) {
  if (!((p, s, n) in time) || number(time[o, s, n]) == 0 || time[o, s, n] ~ />/) return 0
  return number(time[p, s, n]) / number(time[o, s, n])
}
function shown(p, o, s, n,   r) {
  r = ratio(p, o, s, n)
  return r == 0 ? "" : sprintf("%s%.*f", time[p, s, n] ~ />/ ? ">" : "", r < 1 ? 3 : r < 10 ? 1 : 0, r)
}

function table(title, chain, columns, cell,   i, n, row, some, names, count) {
  count = split(columns, names, " ")
  printf "\n## %s\n\n| n |", title
  for (i = 1; i <= count; i++) printf " %s |", label(names[i])
  printf "\n|--:|"
  for (i = 1; i <= count; i++) printf "--:|"
  print ""
  for (n = 1; n <= 100; n++) {
    row = ""; some = 0
    for (i = 1; i <= count; i++) { row = row " " value(cell, names[i], chain, n) " |"; some += value(cell, names[i], chain, n) != "" }
    if (some) printf "| %d |%s\n", n, row
  }
}

function value(cell, name, s, n,   pair) {
  if (cell == "seconds") return seconds(name, s, n)
  if (cell == "operations") return operations[name, s, n]
  split(name, pair, ":")
  return shown(pair[1], pair[2], s, n)
}

function label(name,   pair) {
  if (split(name, pair, ":") == 2) return label(pair[1]) " / " label(pair[2])
  return name in called ? called[name] : name
}

function target(met, text) { printf "* %s: %s\n", met ? "met" : "not met", text }
function at_least(r, p, o, s, n) {
  target(ratio(p, o, s, n) >= r, sprintf("%s %d, %s at least %dx %s: %sx", s, n, label(o), r, label(p), shown(p, o, s, n)))
}
function at_most(what, x, limit) { target(x != "" && number(x) > 0 && number(x) <= limit && x !~ />/, sprintf("%s at most %s: %s", what, limit, x)) }

function growth(p, n) { return operations[p, "spatial", n] - operations[p, "spatial", n / 2] }

BEGIN {
  called["sympy_lagrange"] = "LagrangesMethod"; called["sympy_kane"] = "KanesMethod"
  called["symengine_lagrange"] = "symengine"; called["casadi_program"] = "CasADi"
  called["linmodel_factored"] = "factored"; called["linmodel_canonical"] = "canonical"; called["linmodel_program"] = "program"
  called["linmodel_solved"] = "q''"; called["linmodel_inverse"] = "inverse dynamics"
}

{ time[$1, $2, $3] = $4; operations[$1, $2, $3] = $5 }

NF == 6 && $6 != "-" && $1 ~ /^(sympy|symengine|casadi|linmodel_(factored|canonical|program))/ {
  if (!(($2, $3) in first)) first[$2, $3] = $6
  compared++
  d = $6 - first[$2, $3]; if (d < 0) d = -d
  size = first[$2, $3]; if (size < 0) size = -size
  if (d > 1e-9 * (1 + size)) { print "\nDIFFERENT VALUE: " $0; different++ }
}

END {
  all = "sympy_lagrange sympy_kane symengine_lagrange linmodel_factored linmodel_canonical casadi_program linmodel_program"
  ratios = "sympy_lagrange:linmodel_factored sympy_kane:linmodel_factored symengine_lagrange:linmodel_factored " \
           "sympy_lagrange:linmodel_canonical sympy_kane:linmodel_canonical linmodel_program:casadi_program"
  split("planar spatial", systems, " ")
  for (k = 1; k <= 2; k++) {
    s = systems[k]
    table(s " chain, seconds of CPU", s, all, "seconds")
    table(s " chain, ratios of seconds", s, ratios, "ratios")
    table(s " chain, operations in M and f", s, all, "operations")
  }
  table("programs of many bodies, seconds of CPU", "spatial", "linmodel_solved linmodel_inverse", "seconds")
  table("programs of many bodies, operations", "spatial", "linmodel_solved linmodel_inverse", "operations")

  print "\n![seconds of CPU over n](bench.svg)"
  print "\nEvery result of this package is tested against quotients of differences of L in fixed axes, and that is in its seconds;"
  print "the peers do no such test."
  printf "\n## Targets\n\n"
  at_least(100, "sympy_lagrange", "linmodel_factored", "planar", 10)
  at_least(10, "sympy_kane", "linmodel_factored", "planar", 10)
  at_least(25, "sympy_lagrange", "linmodel_canonical", "planar", 10)
  at_most("planar 10, operations of the canonical form", operations["linmodel_canonical", "planar", 10], 4100)
  at_least(1000, "sympy_lagrange", "linmodel_factored", "spatial", 3)
  at_least(100, "sympy_kane", "linmodel_factored", "spatial", 3)
  at_least(100, "sympy_lagrange", "linmodel_canonical", "spatial", 3)
  if (ratio("linmodel_program", "casadi_program", "spatial", 5))
    at_most("spatial 5, time of the program over CasADi's", sprintf("%.2f", ratio("linmodel_program", "casadi_program", "spatial", 5)), 3)
  at_most("spatial 5, operations of the program (CasADi's number is the limit)", operations["linmodel_program", "spatial", 5], operations["casadi_program", "spatial", 5])
  at_most("spatial 100, seconds for q''", time["linmodel_solved", "spatial", 100], 5)
  at_most("spatial 100, seconds for inverse dynamics", time["linmodel_inverse", "spatial", 100], 5)
  if (operations["linmodel_solved", "spatial", 25])
    target(growth("linmodel_solved", 100) == 2*growth("linmodel_solved", 50) &&
           growth("linmodel_inverse", 100) == 2*growth("linmodel_inverse", 50),
           "operations of q'' and of inverse dynamics linear in n (25, 50, 100)")
  at_most("planar 5, seconds for Hamilton's function", time["linmodel_Hamiltonian", "planar", 5], 0.2)
  split("Lagrangian LagrangeEquations MassForm Hamiltonian", functions, " ")
  for (k = 1; k <= 4; k++) {
    p = "refused_" functions[k]
    target(operations[p, "spatial", 8] == "refused" && number(time[p, "spatial", 8]) < 10,
           sprintf("spatial 8, canonical forced: %s refuses within seconds: %s s", functions[k], time[p, "spatial", 8]))
  }
  printf "\n%d results compared at a rational point, %d different.\n", compared, different
}
