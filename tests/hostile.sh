#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Every public function on the example archives, in a clean session and in the one of tests/hostile.mac: the answers
# (errors too: not every function is for every archive) and the archives with their results must be the same.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
root=$here/..
. "$here/check"

# minutes of solving in general parameters, or half a minute that others of their kind stand for
long='^Equilibria("\(coupled_pendulums\|satellite_rotor_\|satellite_two\)\|^StationarySolutions("satellite_rotor_'
long="$long"'\|^QuadraticIntegrals("satellite_two'
timed='^ErrorAgainstTime$\|^ReferenceSolution$' # their answers depend on the time that runs take: called below

public_functions() {
  cat "$root/linmodel.mac" "$root/circuits.mac" "$root/analysis.mac" | tr ',' '\n' |
    sed -n 's/.*"\([A-Z][A-Za-z]*\)".*/\1/p' | sort -u | grep -v "$timed"
}

calls() {
  (cd "$root/examples" && ls ./*.txt | sed 's|^\./||') | while read -r archive; do
    public_functions | sed "s/\$/(\"$archive\", progress = false)/" # its lines come when they come
  done | grep -v "$long"
  cat <<'END'
LagrangeEquations("spherical_pendulum.txt", simplify = true, progress = false)
InvariantManifolds("spherical_pendulum.txt", extend = [theta], progress = false)
Equilibria("equilibria.txt", where = [], progress = false)
ErrorAgainstTime("coupled_pendulums.txt", tolerances = [1e-30], progress = false)
ReferenceSolution("coupled_pendulums.txt", progress = false)
END
}

# session FOLDER BEGINNING: makes all calls on copies in FOLDER; what is said and answered to the n-th call is in FOLDER/n.
session() {
  mkdir "$1" && cp "$root"/examples/*.txt "$1"
  {
    printf 'display2d: false$ load("linmodel")$ load("circuits")$ load("analysis")$ load("%s/plainly.lisp")$\n%s\n' "$here" "$2"
    calls | awk '{ printf "plainly(\"%d\", errcatch(%s))$\n", NR, $0 }'
  } >"$1/session.mac"
  (cd "$1" && "$root/tools/maxima" --very-quiet <session.mac >answers 2>&1)
  (cd "$1" && awk '/^== [0-9]+$/ { printf "%s", text >$2; text = ""; next }
                         { text = text $0 "\n" }' answers)
}

session clean '' &
session hostile "load(\"$here/hostile.mac\")\$"
wait

check "the hostile session is made" "$(grep -c 'debugmode(true)' hostile/answers)" 0
check "the sessions reach their end" "$(calls | wc -l) $(grep -c '^== ' hostile/answers)" \
  "$(grep -c '^== ' clean/answers) $(grep -c '^== ' clean/answers)"
check "the archives are read without warnings" \
  "$(grep -h 'warning: free symbols\|unknown key\|unknown section' clean/answers | sort -u)" ""
number=0
calls >calls
while read -r call; do
  number=$((number + 1))
  check "$call" "$(cat "hostile/$number")" "$(cat "clean/$number")"
done <calls
for archive in clean/*.txt; do
  grep -v 'seconds = ' "$archive" >plain
  check "$archive with its results" "$(grep -v 'seconds = ' "hostile/${archive#*/}" | diff plain -)" ""
done

summary
