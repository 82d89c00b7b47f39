# SPDX-License-Identifier: GPL-2.0-or-later
"""The rows of bench/circuits/run by Lcapy: the matrix A of a ladder's state equations, as far as it comes in LIMIT seconds of CPU.
Lines as of circuits.mac."""
import signal
import sys
import time
from lcapy import Circuit
from sympy import Matrix, Symbol


def ladder(n):
    rows = ["V0 1 0 {u(t)}"]
    for k in range(1, n + 1):
        rows += [f"R{k} {2*k-1} {2*k}", f"L{k} {2*k} {2*k+1}", f"C{k} {2*k+1} 0"]
    return "\n".join(rows)


def invariants(A, n):
    numbers = {name: k + more for k in range(1, n + 1) for name, more in ((f"R{k}", 0), (f"L{k}", 1), (f"C{k}", 2))}
    M = Matrix(A).subs({symbol: numbers[symbol.name] for symbol in A.free_symbols})
    return f"{M.trace()},{M.det()}"


def over(*_):
    raise TimeoutError


signal.signal(signal.SIGPROF, over)
limit = int(sys.argv[1])
Circuit(ladder(1)).ss.A
for n in (4, 8, 16):
    signal.setitimer(signal.ITIMER_PROF, limit)
    start = time.process_time()
    try:
        A = Circuit(ladder(n)).ss.A
    except TimeoutError:
        print("lcapy ladder", n, f">{limit}", "-", flush=True)
        break
    signal.setitimer(signal.ITIMER_PROF, 0)
    print("lcapy ladder", n, f"{time.process_time() - start:.5f}", invariants(A, n), flush=True)
