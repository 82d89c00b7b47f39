#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# A run that is interrupted by Ctrl-C, or whose time is up, ends with a sentence; its rows so far stand in the archive as a
# part, and the session goes on. A progress line says where it is.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
root=$here/..
. "$here/check"

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
mkfifo input
timeout -k 5 300 "$root/tools/maxima" --very-quiet <input >output 2>&1 &
maxima_pid=$!
exec 3>input
printf 'display2d: false$ load("linmodel")$\nprint(">> ready")$\n' >&3
printf 'Simulate("ctrl_c.txt", points = makelist(10*k, k, 1, 2000), limit = 0);\n' >&3
until grep -q 'Simulate: t = ' output || ! kill -0 "$maxima_pid" 2>/dev/null; do sleep 0.1; done
pkill -INT -P "$maxima_pid" 2>/dev/null || kill -INT "$maxima_pid"
printf 'print(">> after", RateProgram(['"'"'diff(x, t) = -x]))$\n' >&3
printf 'errcatch(Simulate("limit.txt", points = makelist(10*k, k, 1, 2000), limit = 15))$\nprint(">> at the end")$\nquit();\n' >&3
exec 3>&-
wait "$maxima_pid"

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

summary
