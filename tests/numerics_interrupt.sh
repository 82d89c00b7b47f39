#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# A table of errors against run time that the person interrupts keeps the rows so far, marked as a part; the session goes on.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
root=$here/..
. "$here/check"

case $(echo 'build_info()@lisp_name;' | "$root/tools/maxima" --very-quiet 2>&1) in
  *SBCL*) ;;
  *) check "not on SBCL: nothing to see" 0 0; summary; exit ;;
esac

cat >stiff.txt <<'END'
dynarch = 1
kind = equations

[system]
variables = [x, y]
equations = [x' = y, y' = 1000*(1 - x^2)*y - x]
start = [x = 2, y = 0]
time = [0, 20000]
END

# Lines of progress tell of t in the runs that are measured, after what is measured against was made.
interrupt() {
  mkfifo input
  timeout -k 5 300 "$root/tools/maxima" --very-quiet <input >output 2>&1 &
  maxima_pid=$!
  exec 3>input
  printf 'display2d: false$ load("linmodel")$\nReferenceSolution("stiff.txt")$\nprint(">> ready")$\n' >&3
  until grep -q '>> ready' output || ! kill -0 "$maxima_pid" 2>/dev/null; do sleep 0.1; done
  printf 'ErrorAgainstTime("stiff.txt", methods = [radau, gauss, dop853], tolerances = [1e-4], cell = 500);\n' >&3
  until sed '1,/>> ready/d' output | grep -q 't = .* of 20000' || ! kill -0 "$maxima_pid" 2>/dev/null; do sleep 0.1; done
  pkill -INT -P "$maxima_pid" 2>/dev/null || kill -INT "$maxima_pid"
  printf 'print(">> after", 1 + 1)$\nquit();\n' >&3
  exec 3>&-
  wait "$maxima_pid"
}
interrupt
check "the call ends in a sentence" \
  "$(grep -c 'ErrorAgainstTime: interrupted; the rows so far are kept as a part' output)" 1
check "the session goes on" "$(grep -c '>> after 2' output)" 1
check "what there is, is a part" "$(grep -c '^partial = true' stiff.txt)" 1
check "a row of each method that began" \
  "$(sed -n '/^rows = \[\[radau, 0.0001/,$p' stiff.txt | tr '\n' ' ' | grep -o '\[\(radau\|gauss\|dop853\), ' | tr -d '\n')" \
  "[radau, [gauss, "
check "the row says when it was interrupted" "$(grep -c '"interrupted at t = .* of 20000"' stiff.txt)" 1

summary
