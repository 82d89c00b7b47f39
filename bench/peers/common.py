# SPDX-License-Identifier: GPL-2.0-or-later
"""What the peers share: the point at which results are compared, the CPU limit and the line of a result.

A result is one line: PEER SYSTEM N SECONDS OPERATIONS VALUE. SECONDS is the CPU time of the derivation alone, from
the geometry to M and f in M q'' = f; the imports, the count and the value are outside it. VALUE is the sum of all
elements of M and f at the point, the same for every peer that is right.
"""
import math
import resource
import signal
import sys
import time


def parameters(system, n):
    """The names of the parameters in their order: masses, lengths, moments of inertia."""
    letters = "ml" if system == "planar" else "mlcABC"
    return [f"{letter}{k}" for letter in letters for k in range(1, n + 1)] + ["g"]


def degrees(system, n):
    return n if system == "planar" else 2 * n


def point(system, n):
    """Values of coordinates, velocities and parameters: name -> number."""
    values = {}
    for i in range(1, degrees(system, n) + 1):
        values[f"q{i}"] = (3 * i % 7 + 1) / 10
        values[f"u{i}"] = (5 * i % 9 - 4) / 10
    for i, name in enumerate(parameters(system, n), 1):
        values[name] = (i * i % 11 + 5) / 10
    return values


def measured_seconds(seconds, work):
    """The clock is coarse: what is over at once is done again for a fifth of a second."""
    if seconds > 0.05:
        return seconds
    count, start = 0, time.process_time()
    while time.process_time() < start + 0.2:
        work()
        count += 1
    return (time.process_time() - start) / count


def run(derive, finish):
    """derive(system, n) is measured; finish(result, system, n) gives (operations, value)."""
    peer = sys.argv[0].rsplit("/", 1)[-1].removesuffix(".py")
    system, n, limit = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])

    def over(*_):
        print(peer, system, n, f">{limit:g}", "-", "-", flush=True)
        sys.exit(0)

    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
    sys.setrecursionlimit(20000)
    signal.signal(signal.SIGPROF, over)
    signal.setitimer(signal.ITIMER_PROF, limit)
    start = time.process_time()
    try:
        result = derive(system, n)
    except MemoryError:
        print(peer, system, n, "memory", "-", "-")
        return
    seconds = measured_seconds(time.process_time() - start, lambda: derive(system, n))
    signal.setitimer(signal.ITIMER_PROF, 0)
    print(peer, system, n, f"{seconds:.5f}", end=" ", flush=True)
    operations, value = finish(result, system, n)
    assert math.isfinite(value)
    print(operations, f"{value:.12g}")
