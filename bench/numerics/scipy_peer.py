# SPDX-License-Identifier: GPL-2.0-or-later
"""A peer: SciPy, right sides as one writes them in Python: NumPy where vectors are long, else floats. Methods: those of
solve_ivp, and ode-dop853, Hairer's program by scipy.integrate.ode.
    scipy_peer.py                              the scenes below
    scipy_peer.py LIBRARY NAME T0 T1 X1 ..     one scene, its rates those that ExportProgram wrote, called through ctypes"""
import ctypes
import sys
from math import cos, exp, pi, sin
import numpy as np
from scipy.integrate import ode, solve_ivp
from served import serve

g = 9.81


def pendulum(t, x):
    a, b, u, v = x.tolist()
    s, c = sin(a - b), cos(a - b)
    A, B, d = -s * v * v - 2 * g * sin(a), s * u * u - g * sin(b), 2 - c * c
    return [u, v, (A - c * B) / d, (2 * B - c * A) / d]


masses = np.arange(1.0, 8)


def pleiades(t, z):
    x, y = z[:7], z[7:14]
    dx, dy = x - x[:, None], y - y[:, None]
    square = dx * dx + dy * dy
    square[range(7), range(7)] = 1
    pull = masses / (square * np.sqrt(square))
    return np.concatenate([z[14:], (pull * dx).sum(1), (pull * dy).sum(1)])


C, Cs, Cp, R, Rp, Lh, Ls1, Ls2 = 1.6e-8, 2e-12, 1e-8, 25e3, 50, 4.45, 2e-3, 5e-4
Rg1, Rg2, Ri, Rc, gamma, delta = 36.3, 17.3, 50, 600, 40.67286402e-9, 17.7493332


def diode(u):
    return gamma * (exp(min(delta * u, 700)) - 1)


def ring_modulator(t, y):
    y1, y2, y3, y4, y5, y6, y7, y8, y9, y10, y11, y12, y13, y14, y15 = y.tolist()
    u1, u2 = 0.5 * sin(2000 * pi * t), 2 * sin(20000 * pi * t)
    q1, q2 = diode(y3 - y5 - y7 - u2), diode(-y4 + y6 - y7 - u2)
    q3, q4 = diode(y4 + y5 + y7 + u2), diode(-y3 - y6 + y7 + u2)
    return [(y8 - 0.5 * y10 + 0.5 * y11 + y14 - y1 / R) / C, (y9 - 0.5 * y12 + 0.5 * y13 + y15 - y2 / R) / C,
            (y10 - q1 + q4) / Cs, (-y11 + q2 - q3) / Cs, (y12 + q1 - q3) / Cs, (-y13 - q2 + q4) / Cs,
            (-y7 / Rp + q1 + q2 - q3 - q4) / Cp, -y1 / Lh, -y2 / Lh,
            (0.5 * y1 - y3 - Rg2 * y10) / Ls2, (-0.5 * y1 + y4 - Rg2 * y11) / Ls2,
            (0.5 * y2 - y5 - Rg2 * y12) / Ls2, (-0.5 * y2 + y6 - Rg2 * y13) / Ls2,
            (-y1 + u1 - (Ri + Rg1) * y14) / Ls1, (-y2 - (Rc + Rg1) * y15) / Ls1]


def van_der_pol(mu):
    def rates(t, x):
        y, v = x.tolist()
        return [v, mu * (1 - y * y) * v - y]

    return rates


def robertson(t, x):
    a, b, c = x.tolist()
    slow, middle, fast = 0.04 * a, 1e4 * b * c, 3e7 * b * b
    return [middle - slow, slow - middle - fast, fast]


def ladder(n):
    k = np.arange(1, n + 1)
    of_inductor, resistance, of_capacitor, leak = 10.0 + k % 3, 1 / (5.0 + k % 4), 20.0 + k % 5, 1 / (10.0 + k % 2)

    def rates(t, x):
        i, u, out = x[:n], x[n:], np.empty(2 * n)
        voltage, current = -u - resistance * i, i - leak * u
        voltage[0] += sin(3 * t)
        voltage[1:] += u[:-1]
        current[:-1] -= i[1:]
        np.multiply(voltage, of_inductor, out=out[:n])
        np.multiply(current, of_capacitor, out=out[n:])
        return out

    return rates, np.zeros(2 * n), 200


scenes = {
    "pendulum": (pendulum, np.array([pi / 2, pi / 2, 0, 0]), 10),
    "pleiades": (pleiades, np.array([3, 3, -1, -3, 2, -2, 2, 3, -3, 2, 0, 0, -4, 4.0] +
                                    [0, 0, 0, 0, 0, 1.75, -1.5, 0, 0, 0, -1.25, 1, 0, 0]), 3),
    "ring_modulator": (ring_modulator, np.zeros(15), 1e-3),
    "vanderpol": (van_der_pol(1e3), np.array([2.0, 0]), 2e3), "robertson": (robertson, np.array([1.0, 0, 0]), 1e11),
    "ladder100": ladder(100), "ladder1000": ladder(1000),
}


def exported(library, name, _, end, *state):
    """The scene of a routine in C, whose point is the time (from 0 on) and the states."""
    point, out = np.empty(len(state) + 1), np.empty(len(state))
    routine, places = getattr(ctypes.CDLL(library), name), [ctypes.c_void_p(array.ctypes.data) for array in (point, out)]
    routine.restype = None

    def rates(t, x):
        point[0], point[1:] = t, x
        routine(*places)
        return out.copy()

    return rates, np.array(state, float), float(end)


if sys.argv[1:]:
    scenes = {sys.argv[2]: exported(*sys.argv[1:])}
counts = {}


def with_ode(scene, tolerance, scale):
    rates, start, end = scenes[scene]

    def to_end(function):
        solver = ode(function).set_integrator("dop853", rtol=tolerance, atol=scale * tolerance, nsteps=10 ** 8)
        state = solver.set_initial_value(start, 0).integrate(end)
        return state if solver.successful() else None

    def counted(t, x):
        counts[scene, tolerance, scale] += 1
        return rates(t, x)

    if (scene, tolerance, scale) not in counts:  # it does not tell, so that a run of its own counts
        counts[scene, tolerance, scale] = 0
        to_end(counted)
    state = to_end(rates)
    return None if state is None else (counts[scene, tolerance, scale], state)


def run(scene, method, tolerance, scale):
    if method == "ode-dop853":
        return with_ode(scene, tolerance, scale)
    rates, start, end = scenes[scene]
    found = solve_ivp(rates, (0, end), start, method=method, rtol=tolerance, atol=scale * tolerance, t_eval=[end])
    return (found.nfev, found.y[:, -1]) if found.success else None


serve(run)
