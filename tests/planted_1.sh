#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# The first, fifth, .. fault that an adversary must find: see tests/planted_faults.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
part=1
. "$here/planted_faults"
