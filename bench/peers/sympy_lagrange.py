# SPDX-License-Identifier: GPL-2.0-or-later
"""SymPy's LagrangesMethod: Lagrangian(N, *bodies), form_lagranges_equations, mass_matrix and forcing."""
from sympy.physics.mechanics import LagrangesMethod
from common import run
from sympy_chains import Chain, finish


def derive(system, n):
    chain = Chain(system, n, kane=False)
    method = LagrangesMethod(chain.lagrangian(), chain.q)
    method.form_lagranges_equations()
    return chain, method.mass_matrix, method.forcing


run(derive, finish)
