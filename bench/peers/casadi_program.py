# SPDX-License-Identifier: GPL-2.0-or-later
"""CasADi: the program of M and f by its derivatives of an L written by hand, with its common subexpressions found.
OPERATIONS are its instructions without the copying of inputs, constants and outputs."""
import casadi as ca
from common import degrees, parameters, point, run
from by_hand import lagrangian


def derive(system, n):
    count = degrees(system, n)
    q, u = ca.SX.sym("q", count), ca.SX.sym("u", count)
    names = parameters(system, n)
    p = ca.SX.sym("p", len(names))
    by_name = dict(zip(names, ca.vertsplit(p)))
    L = lagrangian(system, n, ca.vertsplit(q), ca.vertsplit(u), by_name, ca.sin, ca.cos)
    M, momenta = ca.hessian(L, u)
    f = ca.gradient(L, q) - ca.jtimes(momenta, q, u)
    return ca.Function("motion", [q, u, p], ca.cse([M, f]))


def finish(program, system, n):
    count, values = degrees(system, n), point(system, n)
    copying = (ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_CONST, ca.OP_PARAMETER)
    operations = sum(program.instruction_id(i) not in copying for i in range(program.n_instructions()))
    M, f = program([values[f"q{i+1}"] for i in range(count)], [values[f"u{i+1}"] for i in range(count)],
                   [values[name] for name in parameters(system, n)])
    return operations, float(ca.sum1(ca.sum2(M)) + ca.sum1(f))


run(derive, finish)
