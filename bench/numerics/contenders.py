# SPDX-License-Identifier: GPL-2.0-or-later
"""Contenders in processes of their own, and what is measured of them: curves of error against time, and times at equal
error side by side, in turn, a slice each."""
import math
import os
import statistics
import subprocess
from collections import namedtuple


class Gone(Exception):
    """A contender that cannot be had, or whose process ended."""


class Worker:
    """A process that answers lines."""

    def __init__(self, command, folder=None):
        settings = {name: value for name, value in os.environ.items() if not name.startswith("OPENBLAS")}
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=folder,
                                        env=dict(settings, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1"))

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


Point = namedtuple("Point", "tolerance scale error seconds evaluations")
patience = 25.0  # seconds; a curve that has taken more ends, a run that takes more is not repeated
long = 3.0  # seconds; of a run that takes more only the stricter neighbour is timed again


class Contender:
    """A method of a worker on a scene; NAMES are its states where their order is not that of the reference."""

    def __init__(self, title, worker, scene, method, tolerances=(), scales=(1.0,), names=None):
        self.title, self.worker, self.scene, self.method = title, worker, scene, method
        self.tolerances, self.scales, self.names = tolerances, scales, names
        self.curves, self.ends, self.share, self.counts, self.seconds = [], [Point(0, 1, 0, 0, 0)], 0.0, [1], 0.0

    def run(self, tolerance, scale, repeats=1):
        seconds, evaluations, *state = self.worker.ask(self.scene, self.method, tolerance, scale, repeats)
        return float(seconds), int(float(evaluations)), [float(x) for x in state]

    def error_of(self, state, reference, floor):
        """max |e_i|/(floor + |x_i|)"""
        if self.names:
            state = [dict(zip(self.names, state))[name] for name in reference]
        values = list(reference.values()) if isinstance(reference, dict) else reference
        return max(abs(x - r) / (floor + abs(r)) for x, r in zip(state, values, strict=True))

    def sweep(self, error_of_state, least):
        """Curves of points, one a scale, from the loosest tolerance until two errors are at most LEAST."""
        self.curves = []
        for scale in self.scales:
            curve = []
            for tolerance in self.tolerances:
                seconds, evaluations, state = self.run(tolerance, scale)
                if seconds >= 0:
                    curve.append(Point(tolerance, scale, error_of_state(self, tolerance, scale, state), seconds, evaluations))
                if sum(point.seconds for point in curve) > patience or sum(point.error <= least for point in curve[-2:]) == 2:
                    break
            self.curves.append(curve)

    def stand_at(self, error):
        """Takes the two neighbours of a curve between which ERROR lies, the quickest of all scales; false if none has it."""
        found = [ends for ends in (bracket(curve, error) for curve in self.curves) if ends]
        if not found:
            return False
        self.ends, self.share = min(found, key=lambda ends: between(ends[1], *(point.seconds for point in ends[0])))
        self.seconds = between(self.share, *(point.seconds for point in self.ends))
        self.counts = [1, 1]
        return True

    def best(self):
        """The point of the least error."""
        return min((point for curve in self.curves for point in curve), key=lambda point: point.error, default=None)

    def long_p(self):
        """Whether its time ended a curve."""
        return any(sum(point.seconds for point in curve) > patience for curve in self.curves)

    def slow(self):
        return max(point.seconds for point in self.ends) > patience

    def timed(self):
        """The ends that are timed in each pair."""
        return self.ends[-1:] if self.ends[-1].seconds > long else self.ends

    def warm(self, slice_seconds):
        """Finds how many runs take a slice of time, and gives the seconds of a slice of all ends."""
        self.counts, turn = [], 0.0
        for point in self.timed():
            repeats, seconds = 1, point.seconds
            while seconds * repeats < slice_seconds / 4:
                repeats *= 4
                seconds = self.run(point.tolerance, point.scale, repeats)[0]
            self.counts.append(max(1, round(slice_seconds / seconds)))
            turn += self.counts[-1] * seconds
        return turn

    def slice(self):
        """Seconds of a run with the error at which it stands."""
        times = [self.run(point.tolerance, point.scale, count)[0] for point, count in zip(self.timed(), self.counts)]
        if len(times) < len(self.ends):
            return times[0] * between(self.share, *(point.seconds for point in self.ends)) / self.ends[-1].seconds
        return between(self.share, *times)

    def evaluations(self):
        return round(between(self.share, *(max(1, point.evaluations) for point in self.ends)))


def between(share, first, last=None):
    """In logarithms."""
    return first if last is None else math.exp((1 - share) * math.log(first) + share * math.log(last))


def bracket(curve, error):
    """Two neighbours with ERROR between theirs, and its share of the way, in logarithms; None where the curve has it not.
    An error counts for no less than those of stricter tolerances: luck is no accuracy."""
    sure, worst = [], 0.0
    for point in reversed(curve):
        worst = max(worst, point.error)
        sure.insert(0, point._replace(error=worst))
    for loose, strict in zip(sure, sure[1:]):
        if loose.error > error >= strict.error > 0:
            return (loose, strict), math.log(loose.error / error) / math.log(loose.error / strict.error)
    return None


def quartiles(numbers):
    return statistics.quantiles(numbers, n=4, method="inclusive")


def side_by_side(one, other, seconds=10.0, slice_seconds=0.05):
    """Quartiles of the time of ONE over that of OTHER, run in turn for about SECONDS but seven pairs at least; both keep
    their middle time. The number of pairs comes last."""
    turn = sum(contender.warm(slice_seconds) for contender in (one, other))
    pairs = [[contender.slice() for contender in (one, other)] for _ in range(max(7, min(41, int(seconds / turn))))]
    one.seconds, other.seconds = (statistics.median(times) for times in zip(*pairs))
    return *quartiles([a / b for a, b in pairs]), len(pairs)
