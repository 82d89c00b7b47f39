#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# The manual as Maxima shows it: info file and index are those of the sources, `?' answers on SBCL and GCL, and Maxima's own
# help is as it is without the packages.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"

# Maxima 5.47 announces the file by which tools/maxima tells it where the packages are.
answer() { timeout -k 5 120 "$here/../tools/maxima" "${1---very-quiet}" 2>&1 | grep -v '^loadfile: loading .*tools/init.lisp'; }

first_line() { grep -m 1 -- ' -- Function:'; }

check "info file and index fit the sources" "$("$here/../tools/doc" check 2>&1)" ""
check "a start gives no warning" "$(echo 'print(1)$' | answer | tr -d ' \n')" 1
check "? finds a function of the first package" \
  "$(printf 'load("linmodel")$\n? Lagrangian\n' | answer | first_line)" " -- Function: Lagrangian (<system>)"
check "? finds functions of a package that is not loaded" \
  "$(printf 'load("linmodel")$\n? MixedPotential\n' | answer | first_line)" " -- Function: MixedPotential (<system>)"
check "?? finds by a part of the name" \
  "$(printf 'load("analysis")$\n?? LienardCh\n' | answer | first_line)" " -- Function: LienardChipart (<p>, <lambda>)"

check "archives of the examples are found by name" \
  "$(printf 'load("linmodel")$\nForceFunction("spherical_pendulum.txt", save = false);\n' | answer | grep . | tail -n 1 | tr -d ' ')" \
  "-glmcos(theta)"

# The session of README.md in a copy of the examples: inputs, and answers without blank lines, indent and progress lines.
readme_inputs() { sed -n 's/^    (%i[0-9]*) //p' "$here/../README.md"; }
readme_answers() { awk '/^    \(%i1\)/ { on = 1 } on && /^[^ ]/ { exit } on && !/^    \(%i/' "$here/../README.md" | sed 's/^    //'; }
in_copy_of_examples() { work=$(mktemp -d) && cp "$here"/../examples/*.txt "$work" && cd "$work"; }
readme_session() {
  in_copy_of_examples && readme_inputs | answer --quiet | sed 's/^(%i[0-9]*) //; s/ *$//; /: computing /d'
  rm -rf "$work"
}

check "the session of the README" "$(readme_session | grep .)" "$(readme_answers | grep .)"

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
