# SPDX-License-Identifier: GPL-2.0-or-later
# Lines PEER WORK N SECONDS RESULT -> one table a work, with the growth from row to row, and whether the results agree; then the
# targets.
{ seconds[$1, $2, $3] = $4; result[$1, $2, $3] = $5
  if (!(($2, $3) in known)) { known[$2, $3] = 1; rows[$2] = rows[$2] " " $3 } }
function of(peer, work, n) { return (peer, work, n) in seconds ? seconds[peer, work, n] : "" }
function is_number(x) { return x ~ /^[0-9.]+$/ && x + 0 > 0 }
function ratio(n,   ours, theirs) {
  ours = of("dynarch", "ladder", n); theirs = of("lcapy", "ladder", n)
  return is_number(ours) && is_number(theirs) ? sprintf("%.0f", theirs/ours) : ""
}
# s ~ n^p from one row to the next
function growth(work, before, n,   a, b) {
  a = of("dynarch", work, before); b = of("dynarch", work, n)
  return before && is_number(a) && is_number(b) ? sprintf("%.2f", log(b/a)/log(n/before)) : ""
}
function table(work, title, peer,   numbers, count, i, n) {
  printf "\n### %s\n\n| n | dynarch | growth, n to the |%s\n|--:|--:|--:|%s\n", title, peer ? " " peer " | ratio |" : "", peer ? "--:|--:|" : ""
  count = split(rows[work], numbers, " ")
  for (i = 1; i <= count; i++) {
    n = numbers[i]
    printf "| %s | %s | %s |", n, of("dynarch", work, n), growth(work, numbers[i - 1], n)
    if (peer) printf " %s | %s |", of(peer, work, n), ratio(n)
    printf "\n"
    if ((peer, work, n) in result && result[peer, work, n] != "-") {
      compared++
      if (result[peer, work, n] != result["dynarch", work, n]) different++
    }
  }
}
function target(name, found, limit) { if (found != "") printf "* %s: %s at most %s: %s\n", found + 0 <= limit + 0 ? "met" : "not met", name, limit, found }
function at_least(name, found, limit) { printf "* %s: %s at least %s: %s\n", (found + 0 >= limit + 0 ? "met" : "not met"), name, limit, found }
END {
  table("ladder", "state equations of a ladder of n sections, 2*n states, all symbols", "lcapy")
  table("branches", "what each branch of the ladder does")
  table("graph", "CheckCircuit, a connected graph of n branches at random")
  printf "\n### ring modulator\n\n| potential | state equations | their Jacobian |\n|--:|--:|--:|\n| %s | %s | %s |\n",
    of("dynarch", "potential", 15), of("dynarch", "equations", 15), of("dynarch", "jacobian", 15)
  printf "\n%d results compared with ours, %d different.\n\n", compared, different + 0
  target("ladder of 16 sections, seconds", of("dynarch", "ladder", 16), 0.03)
  target("ladder of 100 sections, seconds", of("dynarch", "ladder", 100), 0.1)
  target("ladder of 1000 sections, seconds", of("dynarch", "ladder", 1000), 1)
  target("graph of 1000 branches, seconds", of("dynarch", "graph", 1000), 0.1)
  target("graph of 10000 branches, seconds", of("dynarch", "graph", 10000), 1)
  target("ring modulator, potential, equations and Jacobian, seconds",
         of("dynarch", "potential", 15) + of("dynarch", "equations", 15) + of("dynarch", "jacobian", 15), 0.2)
  for (n = 4; n <= 16; n *= 2) if (ratio(n) != "") at_least("ladder of " n " sections, Lcapy's time over ours", ratio(n), 1000)
  exit different > 0
}
