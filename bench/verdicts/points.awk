# SPDX-License-Identifier: GPL-2.0-or-later
# The points of the plot from `lines`: a file FOLDER/PANEL.CONTENDER for each panel and contender, lines place, milliseconds, outcome.
# Of the systems with a name the middle of the milliseconds, and the worst outcome.

BEGIN {
  FS = ";"
  n = split("eigenvalues, doubles;roots, doubles;Routh, doubles;roots, 20 digits;Routh, 20 digits;roots, 40 digits;" \
            "Routh, 40 digits;exact, polynomial;exact, system", contender, ";")
  for (k = 1; k <= n; k++) number[contender[k]] = k
  places = split("-6 -9 -12 -15 -18 -24 24 18 15 12 9 6", margin, " ")
  for (k = 1; k <= places; k++) place[margin[k]] = k <= 6 ? k - 7 : k - 6
  code["right"] = 1; code["open"] = 2; code["wrong"] = 0
}

$4 in number && $3 in place {
  panel = $1 == "products" ? "p" $2 : $1
  key = panel "." number[$4] ";" $3
  time[key, ++count[key]] = $8
  if (!(key in worst) || rank(code[$7]) > rank(worst[key])) worst[key] = code[$7]
}

function rank(c) { return c == 1 ? 0 : c == 2 ? 1 : 2 }

function middle(key,   k, i, x, sorted) {
  for (k = 1; k <= count[key]; k++) {
    x = time[key, k] + 0
    for (i = k - 1; i > 0 && sorted[i] > x; i--) sorted[i + 1] = sorted[i]
    sorted[i + 1] = x
  }
  return sorted[int((count[key] + 1) / 2)]
}

END {
  split("p6 p10 p20 p30 p40 pair named", panel_list, " ")
  for (p = 1; p <= 7; p++)
    for (c = 1; c <= n; c++)
      for (k = 1; k <= places; k++) {
        key = panel_list[p] "." c ";" margin[k]
        if (key in worst) print place[margin[k]], middle(key), worst[key] > (folder "/" panel_list[p] "." c)
      }
}
