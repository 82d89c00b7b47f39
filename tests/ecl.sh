#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Where there is a Maxima on ECL (DYNARCH_ECL=/path/to/maxima) the packages load there, the examples run, and archives
# get the results that they get on SBCL, byte for byte.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"

calls='load("linmodel")$ load("circuits")$ load("analysis")$
  (RouthEquations("spherical_pendulum.txt"), StateEquations("nonlinear_circuit.txt"), Stability("equilibria.txt"))$'
archives() { # FOLDER: copies of the examples with their results
  mkdir "$1" && cp "$here"/../examples/*.txt "$1" && (cd "$1" && "$here/../tools/maxima" --very-quiet --batch-string="$calls" </dev/null >log 2>&1)
}

if [ -z "${DYNARCH_ECL-}" ]; then
  check "without a Maxima on ECL there is nothing to try" "" ""
else
  archives sbcl
  MAXIMA=$DYNARCH_ECL MAXIMA_LISP=ecl
  export MAXIMA MAXIMA_LISP
  archives ecl
  for archive in sbcl/*.txt; do
    check "$archive" "$(cat "$archive")" "$(cat "ecl/${archive#*/}")"
  done
  "$here/../tools/demo" >demo.log 2>&1
  check "the examples run" "$? $(grep -c 'not saved\|Lisp error' demo.log)" "0 0"
fi
summary
