#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# doc/archive.md against the code: the table of keys is the one in keys.lisp, and the archives shown there are read.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

check "the table of keys" "$("$here/../tools/keys-table" check 2>&1)" ""

# Each indented block that begins with the version is an archive; one that begins with a call is Maxima's.
awk '
  /^    dynarch = 1$/ { n++; file = "page" n ".txt" }
  /^    Lagrangian\(\[/ { file = "call.mac" }
  /^    / && file { print substr($0, 5) > file; next }
  /^$/ && file ~ /txt$/ { print "" > file; next }
  { file = "" }
' "$here/../doc/archive.md"

check "archives on the page" "$(ls page*.txt | wc -l)" 3
timeout -k 5 120 "$here/../tools/maxima" --very-quiet --batch-string='
  load("linmodel")$ load("circuits")$ display2d: false$ linel: 1000$
  print("pendulum", Lagrangian("page1.txt", save = false))$
  print("given", RouthFunction("page2.txt", save = false))$
  print("potential", MixedPotential("page3.txt", save = false))$
  batch("call.mac")$' </dev/null >log 2>&1
check "the pendulum" "$(grep -c '^pendulum .*cos(theta)' log)" 1
check "the Lagrangian" "$(grep -c '^given .*p^2' log)" 1
check "the circuit" "$(grep -c '^potential .*i1.*u6' log)" 1
check "the description list" "$(grep -cF "(m*('diff(q,t,1))^2)" log)" 1
check "no error and no warning" "$(grep -ci 'error\|warning' log)" 0
[ "$failed" = 0 ] || cat log

summary
