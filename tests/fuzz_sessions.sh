#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Random hostile sessions (tests/fuzz_sessions.lisp) against a clean one: the same answers, and archives of the same bytes.
#   tests/fuzz_sessions.sh              twenty-four      tests/fuzz_sessions.sh COUNT SEED    as many, from that seed

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
root=$here/..
. "$here/check"
count=${1:-24}
first=${2:-1}
work=$(mktemp -d) && cd "$work" || exit 1
trap 'rm -rf "$work"' EXIT

# session FOLDER SEED: the answers are in FOLDER/answers, what was done to the session in FOLDER/hostile.
session() {
  mkdir "$1" && cp "$root"/examples/*.txt "$1" &&
    (cd "$1" && timeout -k 5 200 "$root/tools/maxima" --very-quiet --batch-string="load(\"$here/plainly.lisp\")\$ load(\"$here/fuzz_sessions.lisp\")\$ fuzz_session($2)\$" \
      </dev/null >log 2>&1
    sed -n 's/^hostile: //p' log >hostile
    sed -n '/^== /,/^== end/p' log >answers)
}

fuzz_sessions() { # COUNT SEED
  session clean 0
  check "the clean session reaches its end" "$(grep -c '^== end' clean/answers)" 1
  for seed in $(seq "$2" $(($2 + $1 - 1))); do
    session "$seed" "$seed"
    difference=$(diff clean/answers "$seed/answers" | head -n 12 | cut -c 1-300)
    check "seed $seed: the answers" "$difference${difference:+
      after $(tr '\n' ';' <"$seed/hostile")}" ""
    for archive in clean/*.txt; do
      cmp -s "$archive" "$seed/${archive#*/}" || echo "${archive#*/}"
    done >"$seed/differ"
    check "seed $seed: the archives" "$(cat "$seed/differ")" ""
    rm -rf "$seed"
  done
}

fuzz_sessions "$count" "$first"
summary
