# SPDX-License-Identifier: GPL-2.0-or-later
"""A peer: heyoka's Taylor series, compiled by LLVM; its compiling is outside the seconds.
Methods `taylor', and `drift': the largest drift of the energy of the double pendulum in the place of the state."""
from math import cos as real_cos, pi
import heyoka
from heyoka import cos, sin
from served import serve

g = 9.81


def pendulum():
    a, b, u, v = heyoka.make_vars("a", "b", "u", "v")
    s, c = sin(a - b), cos(a - b)
    A, B, d = -s * v * v - 2 * g * sin(a), s * u * u - g * sin(b), 2.0 - c * c
    return [(a, u), (b, v), (u, (A - c * B) / d), (v, (2.0 * B - c * A) / d)]


def pleiades():
    x, y, u, v = (heyoka.make_vars(*[f"{letter}{k}" for k in range(1, 8)]) for letter in "xyuv")
    along_x, along_y = [[] for _ in range(7)], [[] for _ in range(7)]
    for i in range(7):
        for j in range(i):
            dx, dy = x[j] - x[i], y[j] - y[i]
            pull = (dx * dx + dy * dy) ** -1.5
            for along, d in ((along_x, dx), (along_y, dy)):
                force = d * pull
                along[i].append((j + 1.0) * force)
                along[j].append(-(i + 1.0) * force)
    return (list(zip(x, u)) + list(zip(y, v)) + list(zip(u, map(heyoka.sum, along_x))) +
            list(zip(v, map(heyoka.sum, along_y))))


scenes = {
    "pendulum": (pendulum, [pi / 2, pi / 2, 0, 0], 10),
    "small_pendulum": (pendulum, [0.3, 0.2, 0, 0], 1e4),
    "tumbling_pendulum": (pendulum, [pi / 2, pi / 2, 0, 0], 300),
    "pleiades": (pleiades, [3, 3, -1, -3, 2, -2, 2, 3, -3, 2, 0, 0, -4, 4.0] +
                 [0, 0, 0, 0, 0, 1.75, -1.5, 0, 0, 0, -1.25, 1, 0, 0], 3),
}
made = {}
most_steps = 2000000  # at tolerances of 1e-6 it never leaves a start at rest


def energy(x):
    kinetic = x[2] ** 2 + x[3] ** 2 / 2 + x[2] * x[3] * real_cos(x[0] - x[1])
    potential = -g * (2 * real_cos(x[0]) + real_cos(x[1]))
    return kinetic + potential, kinetic + abs(potential)


class Drift:
    def __init__(self, state):
        self.first = energy(state)[0]
        self.drift, self.size = 0, abs(self.first)

    def __call__(self, integrator):
        value, size = energy(integrator.state)
        self.drift, self.size = max(self.drift, abs(value - self.first)), max(self.size, size)
        return True


def prepare(scene, _, tolerance):
    if (scene, tolerance) not in made:
        equations, start, _ = scenes[scene]
        made[scene, tolerance] = heyoka.taylor_adaptive(equations(), start, tol=tolerance)


def run(scene, method, tolerance, scale):
    _, start, end = scenes[scene]
    integrator = made[scene, tolerance]
    integrator.time, integrator.state[:] = 0.0, start
    look = Drift(start) if method == "drift" else None
    status, _, _, steps, *_ = integrator.propagate_until(end, callback=look, max_steps=most_steps)
    if status != heyoka.taylor_outcome.time_limit:
        return None
    return (0, [look.drift / look.size]) if look else (steps, integrator.state)


serve(run, prepare)
