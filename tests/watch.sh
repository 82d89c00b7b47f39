#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# What fills the memory is stopped in a small heap before the Lisp dies, again and again, without a line of the collector;
# a call that is interrupted by Ctrl-C, or stopped, leaves a session that goes on.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
root=$here/..
. "$here/check"
. "$here/session"

maxima() { # HEAP: a session in a heap of so many megabytes; what it says. The time allowed only ends a hang
  MAXIMA_LISP_OPTIONS="--dynamic-space-size $1 --disable-ldb" timeout -k 5 1000 "$root/tools/maxima" --very-quiet 2>&1
}

case $(echo 'build_info()@lisp_name;' | maxima 512) in
  *SBCL*) ;;
  *) check "not on SBCL: nothing to see" 0 0; summary; exit ;;
esac

# Grow(kind), a public function for this test: lists, long numbers, a table, polynomials grow; garbage only passes.
cat >grow.lisp <<'END'
(in-package :maxima)
(defun grow (kind)
  (let ((kept '()) (table (make-hash-table :test #'equal)))
    (loop for i from 0 until (and (string= kind "garbage") (= i 20000000))
          do (cond ((string= kind "lists") (push (list i i) kept))
                   ((string= kind "numbers") (push (ash 1 (+ 1000 (mod i 1000))) kept))
                   ((string= kind "table") (setf (gethash (list i) table) (list i)))
                   ((string= kind "polynomials") (push ($expand (power (list '(mplus) '$a '$b i) 12)) kept))
                   (t (setq kept (list* i i (if (zerop (mod i 1000000)) '() kept))))))
    '$ended))
(defun $grow_kind (kind) (grow kind))
(core-public "Grow" :forms '(("expressions" "growth")))
(setf (gethash "core/grow" *core-loaded*) t)
(core-rule "Grow" :any "core/grow" "grow_kind" "growth")
(core-install "Grow")
END

growth() {
  printf 'display2d: false$ load("analysis")$ load("%s")$\n' "$PWD/grow.lisp"
  for kind in lists numbers table polynomials garbage lists; do
    printf 'block([answer: errcatch(Grow("%s", progress = false))], print(">>", answer))$\n' "$kind"
  done
  printf 'print(">>", RootCount(x^2 - 3*x + 1, x))$\n'
}

sentence='Grow: stopped while computing Grow: NN % of Maxima'"'"'s memory of HEAP MB is in use; start Maxima with a larger heap'
for heap in 512 1024; do
  expected=$(printf '%s\n' "$sentence" | sed "s/HEAP/$heap/")
  log=$(growth | maxima $heap)
  check "growth is stopped in $heap MB, the session goes on" \
    "$(printf '%s\n' "$log" | grep '^Grow: stopped\|^>>' | sed 's/: [4-9][0-9] %/: NN %/; s/ *$//')" \
    "$(for kind in 1 2 3 4; do printf '%s\n' "$expected" '>> []'; done
       printf '%s\n' '>> [ended]' "$expected" '>> []' '>> [left = 0,axis = 0,right = 2]')"
  check "the collector is silent in $heap MB" "$(printf '%s\n' "$log" | grep -c -i 'exhausted\|GC control\|Gen ')" 0
done

# Ctrl-C in the middle of a call: the session goes on and no timer is left
session_begins
type_in 'display2d: false$ load("analysis")$' 'K: genmatrix(lambda([i, j], concat(a, min(i, j), max(i, j))), 12, 12)$' \
  'print(">> ready")$' 'CharacteristicPolynomial(K, x);'
until_said 'computing Char'
interrupt_session
type_in 'print(">> after", RootCount(x^2 - 3*x + 1, x))$' ':lisp (format t ">> timers ~a~%" (sb-ext:list-all-timers))'
session_ends
check "Ctrl-C ends the call and the session goes on" "$(grep -c '>> after \[left = 0,axis = 0,right = 2\]' output)" 1
check "Ctrl-C leaves no timer" "$(grep -c '>> timers NIL' output)" 1

summary
