#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# The manual as Maxima shows it: info file and index are those of the sources, `?' answers on SBCL and GCL, and Maxima's own
# help is as it is without the packages.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"

answer() { timeout -k 5 120 "$here/../tools/maxima" --very-quiet 2>&1; }

first_line() { grep -m 1 -- ' -- Function:'; }

check "info file and index fit the sources" "$("$here/../tools/doc" check 2>&1)" ""
check "a start gives no warning" "$(echo 'print(1)$' | answer | tr -d ' \n')" 1
check "? finds a function of the first package" \
  "$(printf 'load("linmodel")$\n? Lagrangian\n' | answer | first_line)" " -- Function: Lagrangian (<system>)"
check "? finds functions of a package that is not loaded" \
  "$(printf 'load("linmodel")$\n? MixedPotential\n' | answer | first_line)" " -- Function: MixedPotential (<system>)"
check "?? finds by a part of the name" \
  "$(printf 'load("analysis")$\n?? LienardCh\n' | answer | first_line)" " -- Function: LienardChipart (<p>, <lambda>)"

own_help() { # what `? sin' prints after the statement $1
  printf '%s\n? sin\n' "$1" | answer | grep -v '^$'
}

check "Maxima's own help on SBCL" "$(own_help 'load("linmodel")$')" "$(own_help 'done$')"
if [ -n "${DYNARCH_GCL-}" ]; then
  MAXIMA=$DYNARCH_GCL MAXIMA_LISP=gcl
  export MAXIMA MAXIMA_LISP
  check "? finds a function on GCL" \
    "$(printf 'load("linmodel")$\n? Lagrangian\n' | answer | first_line)" " -- Function: Lagrangian (<system>)"
  check "Maxima's own help on GCL" "$(own_help 'load("linmodel")$')" "$(own_help 'done$')"
fi
summary
