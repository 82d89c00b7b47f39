#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# The second of every two examples in a hostile session: see tests/hostile_calls.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
chosen() { [ $(($1 % 2)) = 0 ]; }
. "$here/hostile_calls"
