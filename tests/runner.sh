#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# The runner can fail: it is given the suites of tests/runner, each of which ends in its own bad way.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"
DYNARCH_TEST_LIMIT=20
DYNARCH_TEST_HEAP=512
export DYNARCH_TEST_LIMIT DYNARCH_TEST_HEAP

run_tests() { # FOLDER SUITE..: sets log and status
  folder=$1
  shift
  log=$(DYNARCH_TESTS=$folder "$here/../tools/test" "$@" 2>&1)
  status=$?
}

outcome() { # SUITE MODE: `passed failed` of a suite that ran
  printf '%s\n' "$log" | awk -v suite="$1" -v mode="$2" '$1 == suite && $2 == mode { print $3, $5 }'
}

reason() { # SUITE MODE: the first line of what is said of it
  printf '%s\n' "$log" | awk -v head="== $1 on $2" 'found { print; exit } $0 == head { found = 1 }'
}

run_tests "$here/runner"
check "bad suites give a bad exit status" "$status" 1
check "cases that pass" "$(outcome rtest_good.mac sbcl)" "2 0"
check "one case of two fails" "$(outcome rtest_fails.mac sbcl)" "1 1"
check "a Maxima error is no answer" "$(outcome rtest_error.mac sbcl)" "1 1"
check "a Lisp error is no answer" "$(outcome rtest_lisp_error.mac sbcl)" "1 1"
check "shell test that passes" "$(outcome sh_good.sh sh)" "2 0"
check "shell test with a failing case" "$(outcome sh_fails.sh sh)" "1 1"

ends_badly() { # SUITE MODE PASSED [REASON]: it counts as one failure more than its cases
  check "$1 fails" "$(outcome "$1" "$2")" "$3 1"
  [ $# = 3 ] || check "$1 says why" "$(reason "$1" "$2")" "$4"
}

ends_badly rtest_crashes.mac sbcl 1 "it ended with exit status 3"
ends_badly rtest_quits.mac sbcl 1 "there is no summary at its end: it stopped before"
ends_badly rtest_hangs.mac sbcl 1 "it did not end within 20 s"
ends_badly rtest_asks.mac sbcl 1
ends_badly rtest_heap.mac sbcl 1
ends_badly rtest_endless.mac sbcl 1 "it writes without end (more than 4000000 bytes)"
ends_badly rtest_no_answer.mac sbcl 1 "there is no summary at its end: it stopped before"
ends_badly rtest_truncated.mac sbcl 1 "there is no summary at its end: it stopped before"
ends_badly rtest_cut_string.mac sbcl 2 "there is no summary at its end: it stopped before"
ends_badly rtest_cut_comment.mac sbcl 1 "there is no summary at its end: it stopped before"
ends_badly rtest_syntax.mac sbcl 1 "there is no summary at its end: it stopped before"
ends_badly rtest_empty.mac sbcl 0 "it holds no test"
ends_badly rtest_nothing.mac sbcl 0 "it holds no test"
ends_badly sh_crashes.sh sh 0 "it ended with exit status 139"
ends_badly sh_silent.sh sh 0 "there is no summary at its end: it stopped before"
ends_badly sh_hangs.sh sh 1 "it did not end within 20 s"
ends_badly sh_ignores.sh sh 1 "it did not end within 20 s"

run_tests "$here/runner" no_such_suite
check "a missing file fails" "$status $(printf '%s\n' "$log" | tail -n 1)" "1 0 passed, 1 failed"
mkdir nothing
run_tests "$PWD/nothing"
check "a folder without tests fails" "$status $(printf '%s\n' "$log" | tail -n 1)" "1 0 passed, 1 failed"
run_tests "$here/runner" good sh_good
check "good suites alone give a good exit status" "$status" 0
check "a suite leaves nothing behind" "$(ls "$here/runner" | grep -c ERR)" 0

summary
