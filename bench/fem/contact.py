# SPDX-License-Identifier: MIT
"""Frictionless contact by penalty: rigid level plates, and level faces of two bodies whose nodes match."""

import numpy as np
from scipy import sparse

# Pressure [N/m] per px of penetration. The greatest pressures in the scenes are some 1e3, so that the penetration
# stays below 1e-4 R; every scene reports its own.
PENALTY = 4e5


class Plate:
    """A rigid plate on the line y = `height` with free space above it (side = 1, a floor) or below it (side = -1).

    y points down. The energy is the sum over border nodes of w k/2 max(0, penetration)^2 with Simpson's weights w.
    """

    def __init__(self, mesh, height=0.0, side=1, penalty=PENALTY, nodes=None):
        self.nodes = mesh.border_nodes()
        self.weights = penalty * mesh.border_weights()
        if nodes is not None:
            keep = np.isin(self.nodes, nodes)
            self.nodes, self.weights = self.nodes[keep], self.weights[keep]
        self.height, self.side = height, side

    def penetration(self, x):
        """Returns the depth of each border node behind the plate; 0 outside."""
        return np.maximum(0.0, self.side * (x[self.nodes, 1] - self.height))

    def energy(self, x):
        return 0.5 * float((self.weights * self.penetration(x) ** 2).sum())

    def forces(self, x):
        slope = np.zeros_like(x)
        slope[self.nodes, 1] = self.side * self.weights * self.penetration(x)
        return slope

    def stiffness(self, x):
        diagonal = np.zeros(x.size)
        diagonal[2 * self.nodes + 1] = self.weights * (self.penetration(x) > 0)
        return sparse.diags(diagonal, format="csc")

    def total_force(self, x):
        """Returns the force on the plate."""
        return float((self.weights * self.penetration(x)).sum())


class MatchedFaces:
    """Two faces whose nodes lie opposite each other, pressed together along given normals.

    The gap of a pair is n . (x_upper - x_lower), where n is a unit normal that the caller renews between solutions;
    so pairs may slide by much less than an element. n points out of the lower body.
    """

    def __init__(self, upper, lower, weights, penalty=PENALTY):
        self.upper, self.lower, self.weights = np.asarray(upper), np.asarray(lower), penalty * np.asarray(weights)
        self.normal = np.tile((0.0, -1.0), (len(self.upper), 1))

    def penetration(self, x):
        """Returns how deep each pair overlaps."""
        return np.maximum(0.0, -(self.normal * (x[self.upper] - x[self.lower])).sum(axis=1))

    def energy(self, x):
        return 0.5 * float((self.weights * self.penetration(x) ** 2).sum())

    def forces(self, x):
        slope = np.zeros_like(x)
        push = (self.weights * self.penetration(x))[:, None] * self.normal
        slope[self.upper] -= push
        slope[self.lower] += push
        return slope

    def stiffness(self, x):
        active = self.penetration(x) > 0
        n = self.normal[active]
        row = np.concatenate([n, -n], axis=1)
        dofs = np.concatenate([2 * self.upper[active, None] + (0, 1), 2 * self.lower[active, None] + (0, 1)], axis=1)
        blocks = self.weights[active, None, None] * row[:, :, None] * row[:, None, :]
        return sparse.csc_matrix((blocks.ravel(), (np.repeat(dofs, 4, axis=1).ravel(), np.tile(dofs, (1, 4)).ravel())),
                                 shape=(x.size, x.size))

    def renew_normals(self, x):
        """Sets each normal across the lower face as it is deformed; the nodes are in order along +x."""
        along = np.gradient(x[self.lower], axis=0)
        normal = np.stack([along[:, 1], -along[:, 0]], axis=1)
        self.normal = normal / np.linalg.norm(normal, axis=1)[:, None]

    def total_force(self, x):
        """Returns the vertical force between the faces."""
        return float((self.weights * self.penetration(x) * -self.normal[:, 1]).sum())
