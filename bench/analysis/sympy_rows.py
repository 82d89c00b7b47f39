# SPDX-License-Identifier: GPL-2.0-or-later
"""The rows of bench/analysis/run by SymPy, as far as it comes in a minute: minors of Hurwitz and determinants over its own domains of
polynomials. Lines as of analysis.mac."""
import signal
import sys
import time
from sympy import ZZ
from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import ring


def line(work, n, call):
    signal.setitimer(signal.ITIMER_PROF, 60)
    start = time.process_time()
    try:
        result = call()
    except TimeoutError:
        print("sympy", work, n, ">60", "-", flush=True)
        return False
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    print("sympy", work, n, f"{time.process_time() - start:.5f}", result, flush=True)
    return True


def over(*_):
    raise TimeoutError


def determinant(rows, R):
    return DomainMatrix(rows, (len(rows), len(rows)), R.to_domain()).charpoly()[-1] * (-1) ** len(rows)


def hurwitz(n):
    R, *a = ring([f"a{k}" for k in range(n + 1)], ZZ)
    rows = [[a[2 * j - i] if 0 <= 2 * j - i <= n else R(0) for j in range(1, n + 1)] for i in range(1, n + 1)]
    found = [determinant([row[:k] for row in rows[:k]], R) for k in range(1, n + 1)]
    return len(found[n - 2])


def pencil(n):
    names = ["x"] + [f"m{i}{j}" for i in range(n) for j in range(i, n)] + [f"{c}{i}{j}" for c in "sw" for i in range(n) for j in range(n)]
    R, *gens = ring(names, ZZ)
    v = dict(zip(names, gens))
    x = v["x"]
    rows = [[v[f"m{min(i, j)}{max(i, j)}"] * x**2 + v[f"s{i}{j}"] * x + v[f"w{i}{j}"] for j in range(n)] for i in range(n)]
    return len(determinant(rows, R))


sys.setrecursionlimit(10000)
signal.signal(signal.SIGPROF, over)
for n in (8, 10, 12):
    if not line("minors", n, lambda: hurwitz(n)):
        break
for n in (3, 4, 5):
    if not line("charpoly", n, lambda: pencil(n)):
        break
