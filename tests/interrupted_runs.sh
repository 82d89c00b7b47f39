#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# A run that is interrupted by Ctrl-C, or whose time is up, ends with a sentence; its rows so far stand in the archive as a
# part, and the session goes on. A progress line says where it is. So does a table of errors against run time.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
root=$here/..
. "$here/check"
. "$here/session"

case $(echo 'build_info()@lisp_name;' | "$root/tools/maxima" --very-quiet 2>&1) in
  *SBCL*) ;;
  *) check "not on SBCL: nothing to see" 0 0; summary; exit ;;
esac

archive() {
  cat >"$1" <<'END'
dynarch = 1
kind = equations

[system]
variables = [x, v]
equations = [x' = v, v' = -x]
start = [x = 1, v = 0]
time = [0, 1000000000]
END
}

archive ctrl_c.txt
archive limit.txt
session_begins
type_in 'display2d: false$ load("linmodel")$' 'print(">> ready")$' \
  'Simulate("ctrl_c.txt", points = makelist(10*k, k, 1, 2000), limit = 0);'
until_said 'Simulate: t = '
interrupt_session
type_in "print(\">> after\", RateProgram(['diff(x, t) = -x]))$" \
  'errcatch(Simulate("limit.txt", points = makelist(10*k, k, 1, 2000), limit = 15))$' 'print(">> at the end")$'
session_ends

# rows FILE: how many numbers of time the rows of the part have that lie on the motion
rows() { tr '[' '\n' <"$1" | grep -c '^[0-9.]*, -\{0,1\}[0-9]'; }

check "a progress line" "$(grep -c 'Simulate: t = .* of 1' output | sed 's/^[1-9].*/some/')" some
check "Ctrl-C is told" "$(grep -c 'Simulate: interrupted.*the rows so far are kept as a part' output)" 1
check "the session goes on" "$(grep -c '>> after' output)" 1
check "the limit of time is told" "$(grep -c 'Simulate: stopped after .*the limit of time' output)" 1
check "the session goes on after it" "$(grep -c '>> at the end' output)" 1
for file in ctrl_c.txt limit.txt; do
  check "$file holds a part" "$(grep -c '^partial = true' $file)" 1
  check "$file says how it ended" "$(grep -c 'status = "interrupted\|status = "stopped after' $file)" 1
  check "$file holds rows" "$([ "$(rows $file)" -gt 1000 ] && echo many)" many
done

# --- the table of ErrorAgainstTime: its lines of progress tell of t in the runs that are measured, after what is measured
# against was made ---

cat >stiff.txt <<'END'
dynarch = 1
kind = equations

[system]
variables = [x, y]
equations = [x' = y, y' = 1000*(1 - x^2)*y - x]
start = [x = 2, y = 0]
time = [0, 20000]
END

session_begins
type_in 'display2d: false$ load("linmodel")$' 'ReferenceSolution("stiff.txt")$' 'print(">> ready")$'
until_said '>> ready'
type_in 'ErrorAgainstTime("stiff.txt", methods = [radau, gauss, dop853], tolerances = [1e-4], cell = 500);'
until_said 't = .* of 20000' '>> ready'
interrupt_session
type_in 'print(">> after", 1 + 1)$'
session_ends
check "the call ends in a sentence" \
  "$(grep -c 'ErrorAgainstTime: interrupted; the rows so far are kept as a part' output)" 1
check "the session goes on" "$(grep -c '>> after 2' output)" 1
check "what there is, is a part" "$(grep -c '^partial = true' stiff.txt)" 1
check "a row of each method that began" \
  "$(sed -n '/^rows = \[\[radau, 0.0001/,$p' stiff.txt | tr '\n' ' ' | grep -o '\[\(radau\|gauss\|dop853\), ' | tr -d '\n')" \
  "[radau, [gauss, "
check "the row says when it was interrupted" "$(grep -c '"interrupted at t = .* of 20000"' stiff.txt)" 1

summary
