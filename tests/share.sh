#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Maxima compiles draw at its first load. Files of it that another session has written by half are no obstacle: then those of
# an own folder are taken, of which nothing stays.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"
MAXIMA_USERDIR=$PWD/user
TMPDIR=$PWD/temporary
export MAXIMA_USERDIR TMPDIR
mkdir temporary

drawn() { # whether a picture comes
  rm -f picture.svg
  "$here/../tools/maxima" --very-quiet --batch-string='load("circuits")$
    DrawStructure(core_path("examples/equilibria.txt"), file = "picture.svg", progress = false)$' </dev/null >log 2>&1
  grep -c '</svg>' picture.svg
}
check "a picture" "$(drawn)" 1
find user -name '*.fasl' >compiled
check "draw has been compiled" "$(grep -c '/gnuplot[.]fasl$' compiled)" 1
while read -r file; do
  head -c 900 "$file" >half && cat half >"$file"
done <compiled
check "a picture beside half files" "$(drawn)" 1
check "nothing stays" "$(ls temporary)" ""

summary
