# SPDX-License-Identifier: GPL-2.0-or-later
"""SymPy's KanesMethod with the speeds u = q' in the angular velocities, mass_matrix and forcing."""
from sympy.physics.mechanics import KanesMethod
from common import run
from sympy_chains import Chain, finish


def derive(system, n):
    chain = Chain(system, n, kane=True)
    relations = [u - v for u, v in zip(chain.u, chain.velocities)]
    method = KanesMethod(chain.N, q_ind=chain.q, u_ind=chain.u, kd_eqs=relations)
    method.kanes_equations(chain.bodies, chain.loads)
    return chain, method.mass_matrix, method.forcing


run(derive, finish)
