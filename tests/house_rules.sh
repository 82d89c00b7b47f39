#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# tools/house-rules says what the table of rooms means: the rooms of which the scan of tests/uses.lisp finds uses forbidden.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"

"$here/../tools/house-rules" >rules
timeout -k 5 300 "$here/../tools/maxima" --very-quiet --batch-string='load("linmodel")$
  map(lambda([file], load(core_path(sconcat("tests/", file)))), ["definitions.lisp", "uses.lisp"])$
  for rule in uses_closed_rooms() do print(rule)$' </dev/null 2>/dev/null | sed -n 's/^\(never [^ ]* [^ ]*\) *$/\1/p' | sort >closed

check "the same pairs of rooms" "$(cut -d' ' -f1-3 rules | sort | diff - closed)" ""
check "packages meet in the register" "$(grep -c '^never src/linmodel src/circuits  packages meet' rules)" 1
check "forms may use algebra" "$(grep -c '^never src/forms src/algebra' rules)" 0
check "a reason stands in each line" "$(grep -vc '^never src/[a-z]* src/[a-z]*  [a-z]' rules)" 0

summary
