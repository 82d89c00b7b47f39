#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Where the program Singular is installed it judges the components of systems of equations: the union of what is found is where
# all equations vanish and what is apart from zero does not, no prime of this set is missing, dimensions are as said. Systems of
# mechanics and random ones (fuzz_ideals.mac); without Singular there is nothing to try.
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
  timeout -k 2 20 Singular -q --no-rc --no-warn judged.sing </dev/null 2>&1 | grep -v '^//' >said
  [ -s said ] || echo "too long" >said
  cat said
}

if ! command -v Singular >/dev/null; then
  check "without the program Singular there is nothing to try" "" ""
else
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
