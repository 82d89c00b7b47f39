# SPDX-License-Identifier: GPL-2.0-or-later
"""The rows of bench/analysis/run by python-flint: minors and determinants by expansion along a row, each minor kept; roots of a
polynomial in certified balls, counted by the signs of their real parts. Lines as of analysis.mac."""
import time
from fractions import Fraction
from flint import fmpz_mpoly_ctx, Ordering, fmpz_poly, ctx


def seconds(work):
    work()
    start, count = time.process_time(), 0
    while time.process_time() < start + 1 / 3:
        work()
        count += 1
    return (time.process_time() - start) / count


def line(work, n, call, result):
    print("flint", work, n, f"{seconds(call):.5f}", result, flush=True)


def minors(entry, one, n):
    """The function of a number of first rows and a set of columns."""
    known = {}

    def minor(row, columns):
        if row == 0:
            return one
        if columns not in known:
            total, sign = 0 * one, 1 if row % 2 else -1
            for j in range(n):
                if columns >> j & 1:
                    factor = entry(row - 1, j)
                    if factor != 0:
                        total = total + sign * factor * minor(row - 1, columns & ~(1 << j))
                    sign = -sign
            known[columns] = total
        return known[columns]

    return minor


def hurwitz(n):
    ring = fmpz_mpoly_ctx.get([f"a{k}" for k in range(n + 1)], Ordering.lex)
    a, zero = ring.gens(), ring.constant(0)
    entry = lambda i, j: a[2 * j + 1 - i] if 0 <= 2 * j + 1 - i <= n else zero
    minor = minors(entry, ring.constant(1), n)
    return [minor(k, (1 << k) - 1) for k in range(1, n + 1)]


def pencil(n):
    names = ["x"] + [f"m{i}{j}" for i in range(n) for j in range(i, n)] + [f"{c}{i}{j}" for c in "sw" for i in range(n) for j in range(n)]
    ring = fmpz_mpoly_ctx.get(names, Ordering.lex)
    v = dict(zip(names, ring.gens()))
    x = v["x"]
    rows = [[v[f"m{min(i, j)}{max(i, j)}"] * x * x + v[f"s{i}{j}"] * x + v[f"w{i}{j}"] for j in range(n)] for i in range(n)]
    return minors(lambda i, j: rows[i][j], ring.constant(1), n)(n, (1 << n) - 1)


def product(n):
    p = [Fraction(1)]
    for k in range(1, n // 2 + 1):
        b = Fraction((37 * k * k + 11 * k) % 201 - 100, 1 + 7 * k % 20)
        c = Fraction(1 + (53 * k * k + 3 * k) % 400, 1 + 11 * k % 20)
        q = [Fraction(0)] * (len(p) + 2)
        for i, y in enumerate(p):
            q[i] += c * y
            q[i + 1] += b * y
            q[i + 2] += y
        p = q
    common = 1
    for y in p:
        common = common * y.denominator // __import__("math").gcd(common, y.denominator)
    return fmpz_poly([int(y * common) for y in p])


def places(p):
    """Where a ball contains 0, as that of a root on the axis, nothing is proved: it counts as on the axis."""
    left = axis = right = 0
    for root, multiplicity in p.complex_roots():
        real = root.real
        if real < 0:
            left += multiplicity
        elif real > 0:
            right += multiplicity
        else:
            axis += multiplicity
    return f"{left},{axis},{right}"


for n in (8, 10, 12, 13):
    line("minors", n, lambda: hurwitz(n), len(hurwitz(n)[n - 2]))
for n in (3, 4, 5):
    line("charpoly", n, lambda: pencil(n), len(pencil(n)))
for n in (40, 60, 100):
    p = product(n)
    line("roots", n, lambda: places(p), places(p))
