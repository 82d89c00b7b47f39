#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Where the program Singular is installed it judges the components of systems of equations: the union of what is found is where
# all equations vanish and what is apart from zero does not, no prime of this set is missing, dimensions are as said. Systems of
# mechanics and random ones (fuzz_ideals.mac); without Singular there is nothing to judge. What Singular says of components that
# are kept is believed where it is proved alone: programs of its name that say something else change nothing.
#   tests/singular.sh [COUNT [SEED]]

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"
work=$(mktemp -d) && cd "$work" || exit 1
trap 'rm -rf "$work"' EXIT
count=${1:-48}
seed=${2:-1}

cases() { # writes them; how many there are
  timeout -k 5 600 "$here/../tools/maxima" --very-quiet \
    --batch-string="load(\"$here/fuzz_ideals.mac\")\$ print(\"cases:\", fuzz_ideals($count, $seed))\$" </dev/null 2>&1 |
    sed -n 's/^cases: \([0-9]*\) *$/\1/p'
}

judge() { # CASE: what Singular says in its time, or that it says nothing
  cat "$here/ideals_judge.sing" "case_$1.sing" >judged.sing
  timeout -k 2 20 Singular -q --no-rc --no-warn judged.sing </dev/null 2>&1 | grep -v '^//\|^halt \|^ *$' >said
  [ -s said ] || echo "too long" >said
  cat said
}

merged() { # what becomes of a parabola through space and a line that are one component
  PATH=$1$PATH timeout -k 5 120 "$here/../tools/maxima" --very-quiet --batch-string="load(\"analysis\")\$
    (core_require(\"analysis/merged_components\"), analysis_taken: [], display2d: false, 0)\$
    print(\"merged:\", core_within(60, analysis_merged([[[x*z - y^2 = 0, x^3 - y*z = 0], 1]], [x, y, z])))\$" </dev/null 2>&1 |
    sed -n 's/^merged: *//p' | tr -d ' '
}
said() { # LINES..: the same where a program of that name says so
  mkdir -p bin && printf '%s\n' "$@" >bin/lines &&
    printf '#!/bin/sh\ncat >/dev/null\ncat %s\n' "$PWD/bin/lines" >bin/Singular && chmod +x bin/Singular && merged "$PWD/bin:"
}
as_it_is='[[[[x*z-y^2=0,x^3-y*z=0],1]]]'
in_two='[[[[y=0,x=0],1],[[x*z-y^2=0,x^2*y-z^2=0,x^3-y*z=0],1]]]'
curve='x2^5-x3^4 -x2^2+x1*x3 x1*x2^3-x3^3 x1^2*x2-x3^2 x1^3-x2*x3'

# shellcheck disable=SC2086
check "two primes, proved" "$(said prime x1 x2 prime $curve end)" "$in_two"
check "one prime is missing" "$(said prime x1 x2 end)" "$as_it_is"
# shellcheck disable=SC2086
check "a prime that does not lie there" "$(said prime x1 x2 prime $curve prime x1 x3 end)" "$as_it_is"
check "an error is told" "$(said '? wrong' prime x1 x2 end)" "$as_it_is"
check "what cannot be read" "$(said prime 'system("x")' end)" "$as_it_is"

if ! command -v Singular >/dev/null; then
  check "without the program Singular there is nothing to try" "" ""
else
  check "Singular finds the two primes" "$(merged "")" "$in_two"
  written=$(cases)
  for k in $(seq "$written"); do
    judge "$k" >"said_$k"
    check "seed $seed, case $k" "$(sed 's/^held.*/held/; s/^too long/held/' "said_$k")" held
  done
  few=$((written / 5))
  check "most were judged in time" "$([ "$(cat said_* | grep -c '^too long')" -lt "$few" ] && echo yes)" yes
  check "many fall into several components" "$([ "$(cat said_* | grep -c 'held, [2-9]')" -gt "$few" ] && echo yes)" yes
fi
summary
