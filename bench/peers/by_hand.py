# SPDX-License-Identifier: GPL-2.0-or-later
"""L of both chains written by hand for a library that has expressions and derivatives but no mechanics."""


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a[1:], b[1:])) + a[0] * b[0]


def planar(n, q, u, p, sin, cos):
    T = U = 0
    x = y = height = 0
    for k in range(n):
        m, l = p[f"m{k+1}"], p[f"l{k+1}"]
        x, y = x + l * u[k] * cos(q[k]), y + l * u[k] * sin(q[k])
        height = height - l * cos(q[k])
        T, U = T + m * (x * x + y * y) / 2, U - m * p["g"] * height
    return T + U


def spatial(n, q, u, p, sin, cos):
    """Velocities and the vertical in the axes of each body."""
    v, w, up = [0, 0, 0], [0, 0, 0], [0, 0, 1]
    L = height = 0
    for k in range(n):
        m, l, c, A, B, C = (p[f"{x}{k+1}"] for x in "mlcABC")
        (a, b), (da, db) = q[2 * k:2 * k + 2], u[2 * k:2 * k + 2]
        ca, sa, cb, sb = cos(a), sin(a), cos(b), sin(b)

        def turn(x):
            y = ca * x[1] - sa * x[0]
            return [ca * x[0] + sa * x[1], cb * y + sb * x[2], cb * x[2] - sb * y]

        v, up, w = turn(v), turn(up), turn([w[0], w[1], w[2] + da])
        w = [w[0] + db, w[1], w[2]]
        at_centre = [x + y for x, y in zip(v, cross(w, [0, 0, -c]))]
        L = L + (m * dot(at_centre, at_centre) + A * w[0] * w[0] + B * w[1] * w[1] + C * w[2] * w[2]) / 2
        L = L - m * p["g"] * (height - c * up[2])
        v = [x + y for x, y in zip(v, cross(w, [0, 0, -l]))]
        height = height - l * up[2]
    return L


def lagrangian(system, *arguments):
    return (planar if system == "planar" else spatial)(*arguments)
