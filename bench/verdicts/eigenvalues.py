# SPDX-License-Identifier: GPL-2.0-or-later
"""Verdicts by eigenvalues in doubles, LAPACK's dgeev as NumPy calls it, on the lines of `matrices`
(family;title;kind;exponent;truth;n;entries, as fractions of doubles); adds lines like those of verdicts.mac.
A conservative system: a real part of at most 1e-8 of the largest eigenvalue counts as 0, as in contenders.mac."""
import sys
import time
from fractions import Fraction

import numpy


def verdict(matrix, kind):
    values = numpy.linalg.eigvals(matrix)
    width = 1e-8 * abs(values).max() if kind == "conservative" else 0.0
    right = values.real.max()
    if right > width:
        return "unstable"
    if kind == "conservative":
        return "stable"
    return "asymptotically stable" if right < 0 else "not decided"


def outcome(said, truth):
    if said == truth:
        return "right"
    return "open" if said == "not decided" or (said, truth) == ("stable", "asymptotically stable") else "wrong"


def timed(matrix, kind):
    said, count, start, spent = verdict(matrix, kind), 0, time.process_time(), 0.0
    while spent < 0.02:
        verdict(matrix, kind)
        count += 1
        spent = time.process_time() - start
    return said, 1000 * spent / count


def main(folder):
    with open(folder + "/matrices") as matrices, open(folder + "/lines", "a") as lines:
        for line in matrices:
            family, title, kind, exponent, truth, n, *entries = line.strip().split(";")
            matrix = numpy.array([float(Fraction(e)) for e in entries]).reshape(int(n), int(n))
            said, milliseconds = timed(matrix, kind)
            print(family, title, exponent, "eigenvalues, doubles", said, truth, outcome(said, truth),
                  f"{milliseconds:.4f}", sep=";", file=lines)


main(sys.argv[1])
