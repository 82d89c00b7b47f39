# SPDX-License-Identifier: GPL-2.0-or-later
# Tables in Markdown from the lines family;title;exponent;contender;said;truth;outcome;milliseconds of verdicts.mac and
# eigenvalues.py, and from `truths` (the first file): title;parameter;border;three of the linear system;three of the motion;source.

BEGIN {
  FS = ";"
  contenders = split("eigenvalues, doubles;roots, doubles;Routh, doubles;roots, 20 digits;Routh, 20 digits;roots, 40 digits;" \
                     "Routh, 40 digits;exact, polynomial;exact, system", contender, ";")
  margins = split("-6 -9 -12 -15 -18 -24 24 18 15 12 9 6", margin, " ")
  mark["right"] = "+"; mark["wrong"] = "**x**"; mark["open"] = "?"
}

FNR == NR { named[++names] = $1; truths[$1] = $0; next }

{
  outcomes[$1, $2, $3, $4] = $7; said[$1, $2, $3, $4] = $5; known[$4] = 1
  times[$1, $2, $4, ++count[$1, $2, $4]] = $8
  tally[$4, $7]++
  if ($4 == "exact, motion") tally_motion[$7]++
}

function middle(family, title, c,   k, n, i, x, sorted) {
  n = count[family, title, c]
  for (k = 1; k <= n; k++) {
    x = times[family, title, c, k] + 0
    for (i = k - 1; i > 0 && sorted[i] > x; i--) sorted[i + 1] = sorted[i]
    sorted[i + 1] = x
  }
  x = sorted[int((n + 1) / 2)]
  return x < 0.1 ? sprintf("%.3f", x) : x < 10 ? sprintf("%.2f", x) : sprintf("%.0f", x)
}

function rows(family, title, heading,   c, k, line) {
  printf "\n### %s\n\n| | -1e-6 | -1e-9 | -1e-12 | -1e-15 | -1e-18 | -1e-24 | 1e-24 | 1e-18 | 1e-15 | 1e-12 | 1e-9 | 1e-6 | ms |\n", heading
  print "|:--|" dashes(13)
  for (c = 1; c <= contenders; c++) {
    if (!known[contender[c]]) continue
    line = "| " contender[c] " |"
    for (k = 1; k <= margins; k++) line = line " " mark[outcomes[family, title, margin[k], contender[c]]] " |"
    print line " " middle(family, title, contender[c]) " |"
  }
}

function dashes(n,   text) { while (n-- > 0) text = text "--:|"; return text }

# how small a margin may be, on both sides and from 1e-6 on
function reach(title, c,   k, best) {
  best = "none"
  for (k = 1; k <= 6; k++) {
    if (outcomes["named", title, margin[k], c] != "right" || outcomes["named", title, -margin[k], c] != "right") return best
    best = "1e" margin[k]
  }
  return best
}

function reaches(   i, c, line) {
  printf "\n### Systems with a name: the smallest margin down to which both sides are right\n\n| |"
  for (c = 1; c <= contenders; c++) if (known[contender[c]]) printf " %s |", contender[c]
  print "\n|:--|" dashes(contenders)
  for (i = 1; i <= names; i++) {
    line = "| " named[i] " |"
    for (c = 1; c <= contenders; c++) if (known[contender[c]]) line = line " " reach(named[i], contender[c]) " |"
    print line
  }
  line = "| ms, middle of all |"
  for (c = 1; c <= contenders; c++) if (known[contender[c]]) line = line " " middle_named(contender[c]) " |"
  print line
}

function middle_named(c,   i, k) {
  for (i = 1; i <= names; i++)
    for (k = 1; k <= count["named", named[i], c]; k++) times["all", "all", c, ++count["all", "all", c]] = times["named", named[i], c, k]
  return middle("all", "all", c)
}

# one word where all margins of a side agree
function side(title, c, from, to,   k, word) {
  word = said["named", title, margin[from], c]
  for (k = from; k <= to; k++) if (said["named", title, margin[k], c] != word) return "differs"
  return word
}

function verdicts(heading, c, first,   i, part) {
  printf "\n### %s\n\n| system | at | below | true | at | true | above | true | source of the truth |\n", heading
  print "|:--|:--|:--|:--|:--|:--|:--|:--|:--|"
  for (i = 1; i <= names; i++) {
    split(truths[named[i]], part, ";")
    printf "| %s | %s = %s | %s | %s | %s | %s | %s | %s | %s |\n", named[i], part[2], part[3], side(named[i], c, 1, 6), part[first],
      said["named", named[i], 0, c], part[first + 1], side(named[i], c, 7, 12), part[first + 2], part[10]
  }
}

function sums(   c) {
  printf "\n### All %d\n\n| | right | wrong | no verdict |\n|:--|--:|--:|--:|\n", tally["exact, polynomial", "right"] + \
    tally["exact, polynomial", "wrong"] + tally["exact, polynomial", "open"]
  for (c = 1; c <= contenders; c++)
    if (known[contender[c]])
      printf "| %s | %d | %d | %d |\n", contender[c], tally[contender[c], "right"], tally[contender[c], "wrong"], tally[contender[c], "open"]
}

END {
  sums()
  for (n = 1; n <= 5; n++) { split("6 10 20 30 40", degree, " "); rows("products", degree[n], "(s^2 + e*s + 1)*(s + 1)*..*(s + " degree[n] - 2 "), degree " degree[n]) }
  rows("pair", "gyroscopic pair", "z1'' - g*z2' - z1 = 0, z2'' + g*z1' - z2/4 = 0, g = 3/2 + e")
  reaches()
  verdicts("What this package says of the linear systems", "exact, system", 4)
  verdicts("What it says of the motions", "exact, motion", 7)
}
