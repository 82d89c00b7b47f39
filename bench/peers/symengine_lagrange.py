# SPDX-License-Identifier: GPL-2.0-or-later
"""symengine: M and f by its derivatives of an L written by hand."""
import symengine as se
import sympy
from common import degrees, parameters, point, run
from by_hand import lagrangian


def derive(system, n):
    count = degrees(system, n)
    q, u = ([se.Symbol(f"{x}{i}") for i in range(1, count + 1)] for x in "qu")
    p = {name: se.Symbol(name) for name in parameters(system, n)}
    L = lagrangian(system, n, q, u, p, se.sin, se.cos)
    momenta = [L.diff(x) for x in u]
    M = [momentum.diff(x) for momentum in momenta for x in u]
    f = [L.diff(x) - sum(momentum.diff(y) * v for y, v in zip(q, u)) for x, momentum in zip(q, momenta)]
    return M + f


def finish(elements, system, n):
    values = point(system, n)
    value = se.Lambdify(list(map(se.Symbol, values)), elements, cse=True)(list(values.values())).sum()
    return sum(sympy.count_ops(sympy.sympify(e)) for e in elements), float(value)


run(derive, finish)
