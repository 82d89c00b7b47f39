# SPDX-License-Identifier: GPL-2.0-or-later
"""Contenders in processes of their own, and what is measured of them: the tolerance with which an error is reached, and
times side by side, in turn, a slice each."""
import os
import statistics
import subprocess


class Gone(Exception):
    """A contender that cannot be had, or whose process ended."""


class Worker:
    """A process that answers lines."""

    def __init__(self, command, folder=None):
        settings = {name: value for name, value in os.environ.items() if not name.startswith("OPENBLAS")}
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=folder,
                                        env=dict(settings, OPENBLAS_NUM_THREADS="1"))

    def ask(self, *words):
        """The words of the answer."""
        try:
            self.process.stdin.write(" ".join(map(str, words)) + "\n")
            self.process.stdin.flush()
            while True:
                line = self.process.stdout.readline()
                if not line:
                    raise Gone(" ".join(map(str, words)))
                if line.startswith("bench "):
                    return line.split()[1:]
        except OSError as fault:
            raise Gone(str(fault))

    def end(self):
        self.process.stdin.close()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()


class Contender:
    """A method of a worker on a scene; NAMES are its states where their order is not that of the reference."""

    def __init__(self, title, worker, scene, method, tolerances, scales=(1.0,), names=None):
        self.title, self.worker, self.scene, self.method = title, worker, scene, method
        self.tolerances, self.scales, self.names = tolerances, scales, names
        self.tolerance, self.scale, self.error, self.seconds, self.evaluations = 0.0, 1.0, 0.0, 0.0, 0

    def run(self, tolerance, scale, repeats=1):
        seconds, evaluations, *state = self.worker.ask(self.scene, self.method, tolerance, scale, repeats)
        return float(seconds), int(float(evaluations)), [float(x) for x in state]

    def slice(self, repeats):
        return self.run(self.tolerance, self.scale, repeats)[0]

    def error_of(self, state, reference):
        """max |e_i|/(1 + |x_i|)"""
        if self.names:
            state = [dict(zip(self.names, state))[name] for name in reference]
        values = list(reference.values()) if isinstance(reference, dict) else reference
        return max(abs(x - r) / (1 + abs(r)) for x, r in zip(state, values, strict=True))

    def reach(self, reference, most):
        """The quickest setting whose error is at most MOST, as is that of the next stricter tolerance."""
        found = []
        for scale in self.scales:
            before = None
            for tolerance in self.tolerances:
                seconds, evaluations, state = self.run(tolerance, scale)
                error = self.error_of(state, reference) if seconds >= 0 else float("inf")
                if before and error <= most:
                    found.append(before)
                    break
                before = (seconds, tolerance, scale, error, evaluations) if error <= most else None
            else:
                found += [before] if before else []
        if not found:
            return False
        self.seconds, self.tolerance, self.scale, self.error, self.evaluations = min(found)
        return True


def quartiles(numbers):
    return statistics.quantiles(numbers, n=4, method="inclusive")


def repeats_for(contender, slice_seconds):
    """How many runs take a slice of time; the first run warms up."""
    contender.slice(1)
    return max(1, round(slice_seconds / max(1e-7, contender.slice(1))))


def side_by_side(one, other, seconds=10.0, slice_seconds=0.06):
    """Quartiles of the time of ONE over that of OTHER, run in turn for about SECONDS; both keep their middle time."""
    counts = [repeats_for(contender, slice_seconds) for contender in (one, other)]
    turn = sum(count * contender.slice(1) for count, contender in zip(counts, (one, other)))
    pairs = [[contender.slice(count) for count, contender in zip(counts, (one, other))]
             for _ in range(max(5, min(41, int(seconds / turn))))]
    one.seconds, other.seconds = (statistics.median(times) for times in zip(*pairs))
    return quartiles([a / b for a, b in pairs])
