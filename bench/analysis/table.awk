# SPDX-License-Identifier: GPL-2.0-or-later
# Lines PEER WORK N SECONDS RESULT -> one table a work, and whether the results agree; then the targets.
{ seconds[$1, $2, $3] = $4; result[$1, $2, $3] = $5
  if (!(($2, $3) in known)) { known[$2, $3] = 1; rows[$2] = rows[$2] " " $3 } }
function of(peer, work, n) { return (peer, work, n) in seconds ? seconds[peer, work, n] : "" }
function table(work, title, peers,   names, count, numbers, rowcount, i, k, n) {
  count = split(peers, names, " ")
  printf "\n### %s\n\n| n |", title
  for (k = 1; k <= count; k++) printf " %s |", names[k]
  printf "\n|--:|"
  for (k = 1; k <= count; k++) printf "--:|"
  printf "\n"
  rowcount = split(rows[work], numbers, " ")
  for (i = 1; i <= rowcount; i++) {
    n = numbers[i]; printf "| %s |", n
    for (k = 1; k <= count; k++) {
      printf " %s |", of(names[k], work, n)
      if ((names[k], work, n) in result && result[names[k], work, n] != "-") {
        compared++
        if (result[names[k], work, n] != result["dynarch", work, n]) different++
      }
    }
    printf "\n"
  }
}
function target(name, found, limit) { printf "* %s: %s at most %s: %s\n", found + 0 <= limit + 0 ? "met" : "not met", name, limit, found }
END {
  table("minors", "all minors of Hurwitz, generic coefficients", "dynarch polynomials flint sympy")
  table("charpoly", "det(M x^2 + S x + W), M symmetric, S and W general", "dynarch flint sympy")
  table("roots", "where the roots lie, products of n/2 rational quadratics", "dynarch flint")
  table("chain", "verdict on a hanging planar chain of n links, from the description", "dynarch")
  table("first", "first call in a session, RouthLyapunov of an archive, verdicts included", "dynarch")
  printf "\n%d results compared with ours, %d different.\n\n", compared, different + 0
  if (seconds["flint", "minors", 13] > 0) {
    target("minors of degree 13 as polynomials, over flint", sprintf("%.1f", seconds["polynomials", "minors", 13]/seconds["flint", "minors", 13]), 3)
    target("minors of degree 13 as expressions, over flint", sprintf("%.1f", seconds["dynarch", "minors", 13]/seconds["flint", "minors", 13]), 3)
  }
  target("det(M x^2 + S x + W) of order 5, seconds", seconds["dynarch", "charpoly", 5], 0.1)
  target("roots of degree 40, seconds", seconds["dynarch", "roots", 40], 0.02)
  target("roots of degree 60, seconds", seconds["dynarch", "roots", 60], 0.05)
  target("roots of degree 100, seconds", seconds["dynarch", "roots", 100], 0.2)
  target("chain of 8 links, seconds", seconds["dynarch", "chain", 8], 1)
  target("chain of 20 links, seconds", seconds["dynarch", "chain", 20], 5)
  target("first call, kirchhoff_clebsch, seconds", seconds["dynarch", "first", "kirchhoff_clebsch"], 2)
  target("first call, clebsch_tisserand_brun, seconds", seconds["dynarch", "first", "clebsch_tisserand_brun"], 2)
  target("first call, 24 rests of a satellite, seconds", seconds["dynarch", "first", "satellite"], 2)
  exit different > 0
}
