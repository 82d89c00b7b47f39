# SPDX-License-Identifier: GPL-2.0-or-later
"""What the peers in Python share: lines of the standard input are answered as ours.lisp says."""
import sys
import time


def serve(run, prepare=None):
    """run(scene, method, tolerance, scale) gives evaluations and the state at the end, None where it does not end.
    prepare(scene, method, tolerance) is outside of the seconds."""
    for line in sys.stdin:
        scene, method, tolerance, scale, repeats = line.split()
        if prepare:
            prepare(scene, method, float(tolerance))
        begin = time.process_time()
        for _ in range(int(repeats)):
            answer = run(scene, method, float(tolerance), float(scale))
        seconds = (time.process_time() - begin) / int(repeats)
        evaluations, state = answer if answer else (0, [])
        print("bench", seconds if answer else -1, evaluations, *map(repr, map(float, state)), flush=True)
