#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# No page and no message names a function that is not there: every CamelCase name with a parenthesis behind it, in the
# manual, the README, the page of archives, the examples and the strings of the sources, is in one of the three faces; in the
# pages also every name of two capitals without one.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
root=$here/..
. "$here/check"

sed -n 's/"\([A-Z][A-Za-z]*\)"/\n\1\n/gp' "$root"/linmodel.mac "$root"/circuits.mac "$root"/analysis.mac |
  grep -x '[A-Z][A-Za-z]*' | sort -u >faces
pages() { cat "$root"/doc/*.texi "$root/doc/archive.md" "$root/README.md"; }
# strings of one line, and of several: the quotes are counted over the whole file
strings() {
  for file in "$root"/src/*/*.lisp "$root"/src/*/*.mac; do
    sed 's/\\"//g; s/#\\"//g' "$file" | tr '\n' ' ' | tr '"' '\n' | awk 'NR % 2 == 0'
  done
}
called() { grep -o '[A-Z][A-Za-z]*[a-z][A-Za-z]*\( (\)\?[(]' | tr -d ' (' | sort -u; }
called_in_strings() { grep -o '[A-Z][A-Za-z]*[a-z][A-Za-z]*[(]' | tr -d '(' | sort -u; }
unknown() { grep -vxF -f faces | grep -vx RealRoot; } # a constant, in results

humps() { grep -o '\b[A-Z][a-z]*[A-Z][a-z][A-Za-z]*\b' | sort -u; }

check "the faces name LagrangeEquations, MixedPotential, Stability" \
  "$(grep -cx 'LagrangeEquations\|MixedPotential\|Stability' faces)" 3
check "functions named in the pages" "$(pages | called | unknown | tr '\n' ' ')" ""
check "functions named in messages" "$(strings | called_in_strings | unknown | tr '\n' ' ')" ""
check "functions named in the examples" "$(cat "$root"/examples/*.mac "$root"/examples/*.txt | called_in_strings | unknown | tr '\n' ' ')" ""
check "names of two capitals in the pages" "$(pages | humps | unknown | grep -vx 'LinModel\|DeBra' | tr '\n' ' ')" ""
check "names of two capitals in messages" "$(strings | humps | unknown | tr '\n' ' ')" ""
# every function of the faces has its entry, and a name that is not there is found
check "functions without an entry in the manual" \
  "$(while read -r name; do grep -q "@deffnx* {Function} $name " "$root"/doc/*.texi || printf '%s ' "$name"; done <faces)" ""
check "a planned function would be found" "$(echo 'see @code{NewtonEuler(A, B)}' | called | unknown)" NewtonEuler

summary
