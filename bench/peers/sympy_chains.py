# SPDX-License-Identifier: GPL-2.0-or-later
"""Both chains as the documentation of sympy.physics.mechanics builds them: frames, points, v2pt_theory."""
import sympy
from sympy.physics.mechanics import (Lagrangian, Particle, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia)
from common import degrees, parameters, point


class Chain:
    """bodies, loads (weights) and coordinates; speeds u with q' = u where kane, else the velocities q'."""

    def __init__(self, system, n, kane):
        count = degrees(system, n)
        self.q = list(dynamicsymbols(f"q1:{count + 1}"))
        self.velocities = list(dynamicsymbols(f"q1:{count + 1}", 1))
        self.u = list(dynamicsymbols(f"u1:{count + 1}")) if kane else self.velocities
        self.p = {name: sympy.Symbol(name) for name in parameters(system, n)}
        self.N = ReferenceFrame("N")
        self.origin = Point("O")
        self.origin.set_vel(self.N, 0)
        self.bodies, self.loads = [], []
        (self.planar if system == "planar" else self.spatial)(n, kane)

    def planar(self, n, kane):
        joint, down = self.origin, -self.N.y
        for k in range(n):
            frame = self.N.orientnew(f"F{k}", "Axis", [self.q[k], self.N.z])
            if kane:
                frame.set_ang_vel(self.N, self.u[k] * self.N.z)
            end = joint.locatenew(f"P{k}", -self.p[f"l{k+1}"] * frame.y)
            end.v2pt_theory(joint, self.N, frame)
            self.add(Particle(f"B{k}", end, self.p[f"m{k+1}"]), end, k, down)
            joint = end

    def spatial(self, n, kane):
        joint, parent, down = self.origin, self.N, -self.N.z
        for k in range(n):
            a, b = self.q[2 * k:2 * k + 2]
            between = parent.orientnew(f"E{k}", "Axis", [a, parent.z])
            frame = between.orientnew(f"F{k}", "Axis", [b, between.x])
            if kane:
                between.set_ang_vel(parent, self.u[2 * k] * parent.z)
                frame.set_ang_vel(between, self.u[2 * k + 1] * between.x)
            centre = joint.locatenew(f"C{k}", -self.p[f"c{k+1}"] * frame.z)
            end = joint.locatenew(f"P{k}", -self.p[f"l{k+1}"] * frame.z)
            centre.v2pt_theory(joint, self.N, frame)
            end.v2pt_theory(joint, self.N, frame)
            tensor = inertia(frame, *(self.p[f"{x}{k+1}"] for x in "ABC"))
            body = RigidBody(f"B{k}", centre, frame, self.p[f"m{k+1}"], (tensor, centre))
            self.add(body, centre, k, down)
            joint, parent = end, frame

    def add(self, body, centre, k, down):
        weight = self.p[f"m{k+1}"] * self.p["g"]
        body.potential_energy = -weight * centre.pos_from(self.origin).dot(down)
        self.bodies.append(body)
        self.loads.append((centre, weight * down))

    def lagrangian(self):
        return Lagrangian(self.N, *self.bodies)


def finish(result, system, n):
    chain, M, f = result
    symbols = sympy.symbols(f"u1:{len(chain.q) + 1}") + sympy.symbols(f"q1:{len(chain.q) + 1}")
    plain = dict(zip(list(chain.u) + list(chain.q), symbols))
    elements = [e.xreplace(plain) for e in list(M) + list(f)]
    values = point(system, n)
    value = sum(sympy.lambdify(list(map(sympy.Symbol, values)), elements, "math", cse=True)(*values.values()))
    return sum(sympy.count_ops(e) for e in elements), value
