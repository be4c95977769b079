# SPDX-License-Identifier: MIT
"""A hyperelastic plane-strain solid of quadratic triangles: energy, forces, stiffness, mass, and Newton's method."""

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import eigsh, splu

# Six-point rule of degree 4 on the triangle (Dunavant 1985): barycentric coordinates and weights that sum to 1.
_A, _B = 0.445948490915965, 0.091576213509771
_POINTS = np.array([(_A, _A), (_A, 1 - 2 * _A), (1 - 2 * _A, _A), (_B, _B), (_B, 1 - 2 * _B), (1 - 2 * _B, _B)])
_WEIGHTS = np.array([0.223381589678011] * 3 + [0.109951743655322] * 3)


def _shapes(points):
    """Returns the six shape functions and their derivatives by the two reference coordinates."""
    s, t = points.T
    r = 1.0 - s - t
    zero = np.zeros_like(s)
    values = np.stack([r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * r * s, 4 * s * t, 4 * t * r], axis=1)
    by_s = np.stack([1 - 4 * r, 4 * s - 1, zero, 4 * (r - s), 4 * t, -4 * t], axis=1)
    by_t = np.stack([1 - 4 * r, zero, 4 * t - 1, -4 * s, 4 * s, 4 * (r - t)], axis=1)
    return values, np.stack([by_s, by_t], axis=2)


class Material:
    """Neo-Hookean, W(F) = mu/2 (F:F - 2) + U(J), J = det F, per rest area.

    "stable": U = -mu (J - 1) + K/2 (J - 1)^2. In the plane, dcof(F) is linear in F, so at F = I the stress rate is
    mu (dF + dF^T) + (K - mu) tr(dF) I. The small-strain Lame parameters are thus mu and K - mu, and K must be
    lambda + mu, the plane-strain bulk modulus. In singular values W = mu/2 (s1 - s2)^2 + K/2 (J - 1)^2. This is
    Smith, De Goes and Kim 2018, eq. 14 in 2D without its constant.
    "log": U = -mu ln J + lambda/2 (ln J)^2 (Bonet and Wood 2008, eq. 6.27), whose small-strain Lame parameters are
    mu and lambda. Its energy is infinite at J = 0.
    """

    def __init__(self, young, poisson, law="stable"):
        self.young, self.poisson, self.law = young, poisson, law
        self.mu = young / (2.0 * (1.0 + poisson))
        self.lame = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
        self.bulk = self.lame + self.mu

    def volume_energy(self, J):
        """Returns U, dU/dJ and d2U/dJ2."""
        if self.law == "stable":
            return (-self.mu * (J - 1) + 0.5 * self.bulk * (J - 1) ** 2, self.bulk * (J - 1) - self.mu,
                    np.full_like(J, self.bulk))
        with np.errstate(invalid="ignore", divide="ignore"):
            log = np.where(J > 0, np.log(np.where(J > 0, J, 1.0)), np.inf)
            energy = np.where(J > 0, -self.mu * log + 0.5 * self.lame * log**2, np.inf)
            return energy, (self.lame * log - self.mu) / J, (self.lame * (1 - log) + self.mu) / J**2


class Solid:
    """One or several bodies of one mesh and one material, with unit thickness and evenly spread mass."""

    def __init__(self, mesh, material, mass):
        self.mesh, self.material = mesh, material
        nodes, elements = mesh.nodes, mesh.elements
        values, slopes = _shapes(_POINTS)
        jacobian = np.einsum("eai,qaj->eqij", nodes[elements], slopes)
        det = jacobian[..., 0, 0] * jacobian[..., 1, 1] - jacobian[..., 0, 1] * jacobian[..., 1, 0]
        if det.min() <= 0:
            raise ValueError("solid: an element is inverted at rest")
        self.gradient = np.einsum("qaj,eqji->eqai", slopes, np.linalg.inv(jacobian))
        self.weight = 0.5 * det * _WEIGHTS
        self.area = float(self.weight.sum())
        self.density = mass / self.area
        self.size = 2 * len(nodes)

        self._dofs = (2 * elements[:, :, None] + np.arange(2)).reshape(len(elements), 12)
        rows = np.repeat(self._dofs, 12, axis=1).ravel()
        columns = np.tile(self._dofs, (1, 12)).ravel()
        keys, self._slot = np.unique(columns.astype(np.int64) * self.size + rows, return_inverse=True)
        self._slot = self._slot.ravel()
        self._rows = (keys % self.size).astype(np.int32)
        self._starts = np.searchsorted(keys // self.size, np.arange(self.size + 1)).astype(np.int32)

        # Constant parts of the stiffness: G_a.G_b times the identity, and G_a x G_b times the quarter turn.
        G = self.gradient
        self._dots = np.einsum("eq,eqai,eqbi->eab", self.weight, G, G)
        self._crosses = G[..., :, None, 0] * G[..., None, :, 1] - G[..., :, None, 1] * G[..., None, :, 0]

        scalar = np.einsum("eq,qa,qb->eab", self.weight * self.density, values, values)
        block = np.zeros((len(elements), 6, 2, 6, 2))
        block[:, :, 0, :, 0] = block[:, :, 1, :, 1] = scalar
        self.mass = self._assemble(block)
        self.node_mass = np.bincount(elements.ravel(), np.einsum("eab->ea", scalar).ravel(), len(nodes))

    def _assemble(self, blocks):
        data = np.bincount(self._slot, blocks.ravel(), len(self._rows))
        return sparse.csc_matrix((data, self._rows, self._starts), shape=(self.size, self.size))

    def deformation(self, x):
        """Returns F, its cofactors and J at every quadrature point; x: positions (N, 2)."""
        F = np.matmul(x[self.mesh.elements].transpose(0, 2, 1)[:, None], self.gradient)
        cof = np.empty_like(F)
        cof[..., 0, 0], cof[..., 0, 1] = F[..., 1, 1], -F[..., 1, 0]
        cof[..., 1, 0], cof[..., 1, 1] = -F[..., 0, 1], F[..., 0, 0]
        return F, cof, F[..., 0, 0] * F[..., 1, 1] - F[..., 0, 1] * F[..., 1, 0]

    def energy(self, x):
        """Returns the elastic energy."""
        F, _, J = self.deformation(x)
        W = 0.5 * self.material.mu * ((F * F).sum((-1, -2)) - 2.0) + self.material.volume_energy(J)[0]
        return float((self.weight * W).sum())

    def forces(self, x):
        """Returns the gradient of the energy: nodal forces that hold the solid in x."""
        F, cof, J = self.deformation(x)
        P = self.material.mu * F + self.material.volume_energy(J)[1][..., None, None] * cof
        local = np.einsum("eqaj,eqij->eai", self.gradient * self.weight[..., None, None], P)
        return np.bincount(self._dofs.ravel(), local.ravel(), self.size).reshape(-1, 2)

    def stiffness(self, x):
        """Returns the second derivative: with c = cof F, mu I + U'' c c^T + U' dc/dF, dc_ij/dF_kl = e_ik e_jl."""
        _, cof, J = self.deformation(x)
        _, slope, curvature = self.material.volume_energy(J)
        c = np.matmul(self.gradient, cof.swapaxes(-1, -2)).reshape(len(J), -1, 12)
        block = np.matmul((c * (self.weight * curvature)[..., None]).swapaxes(1, 2), c).reshape(-1, 6, 2, 6, 2)
        dots = self.material.mu * self._dots
        turn = np.einsum("eq,eqab->eab", self.weight * slope, self._crosses)
        block[:, :, 0, :, 0] += dots
        block[:, :, 1, :, 1] += dots
        block[:, :, 0, :, 1] += turn
        block[:, :, 1, :, 0] -= turn
        return self._assemble(block)

    def current_area(self, x):
        """Returns the deformed area."""
        return float((self.weight * self.deformation(x)[2]).sum())

    def mean_position(self, x):
        """Returns the center of mass (also the mean velocity, if x is a velocity)."""
        return (self.node_mass[:, None] * x).sum(axis=0) / self.node_mass.sum()

    def frequencies(self, count):
        """Returns the lowest natural frequencies [Hz] of the free solid at rest, without the three rigid modes."""
        K = self.stiffness(self.mesh.nodes)
        scale = self.material.mu / (self.density * self.area)
        values = eigsh(K, count + 3, M=self.mass, sigma=-0.1 * scale, which="LM", return_eigenvectors=False,
                       v0=np.cos(np.arange(self.size)))
        values = np.sort(values)
        if abs(values[2]) > 1e-5 * values[3]:
            raise RuntimeError("frequencies: more or fewer than three rigid modes")
        return np.sqrt(values[3:]) / (2.0 * np.pi)


class Loads:
    """What acts on the solid: even gravity, fixed coordinates, and terms such as `contact.Plate`."""

    def __init__(self, solid, gravity=0.0, terms=()):
        self.force = np.zeros((solid.size // 2, 2))
        self.force[:, 1] = gravity * solid.node_mass
        self.terms = list(terms)
        self.fixed = np.zeros((solid.size // 2, 2), bool)

    def fix(self, nodes, axis=None):
        """Holds nodes where they are, in one axis or in both."""
        if axis is None:
            self.fixed[nodes] = True
        else:
            self.fixed[nodes, axis] = True


class NewtonFailure(RuntimeError):
    """Newton's method found no equilibrium."""


class Potential:
    """Elastic energy, loads and terms as one function of the positions, for `minimize`."""

    def __init__(self, solid, loads, share=1.0):
        self.solid, self.loads, self.share = solid, loads, share

    def value(self, x):
        total = self.solid.energy(x) - self.share * float((self.loads.force * x).sum())
        return total + sum(term.energy(x) for term in self.loads.terms)

    def slope(self, x):
        total = self.solid.forces(x) - self.share * self.loads.force
        for term in self.loads.terms:
            total += term.forces(x)
        return total

    def curvature(self, x):
        total = self.solid.stiffness(x)
        for term in self.loads.terms:
            total = total + term.stiffness(x)
        return total


def minimize(potential, x, fixed, tolerance, shift, most=200):
    """Finds a minimum by Newton's method with a line search on the energy; returns positions and iterations.

    tolerance: largest nodal force [kg px/s^2] left over. shift: a matrix added to the stiffness in growing shares
    where Newton's direction is not downhill (Levenberg 1944).
    """
    free = np.flatnonzero(~fixed.ravel())
    x = x.copy()
    value, slope = potential.value(x), potential.slope(x)
    damping = 0.0
    for iteration in range(most):
        residual = slope.ravel()[free]
        if np.abs(residual).max() <= tolerance:
            return x, iteration
        K = potential.curvature(x)
        while True:
            matrix = (K + damping * shift if damping > 0 else K)
            if len(free) < len(slope.ravel()):
                matrix = matrix[:, free][free]
            direction = None
            try:
                factor = splu(sparse.csc_matrix(matrix), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
                              options=dict(SymmetricMode=True))
                # A negative pivot is a direction of negative curvature, which would lead to a saddle.
                if factor.U.diagonal().min() > 0:
                    direction = -factor.solve(residual)
            except RuntimeError:
                pass
            if direction is not None and np.isfinite(direction).all() and residual @ direction < 0:
                break
            damping = max(10.0 * damping, 1e-4)
            if damping > 1e8:
                raise NewtonFailure("no downhill direction")
        step = np.zeros(slope.size)
        step[free] = direction
        step = step.reshape(slope.shape)
        downhill = residual @ direction
        length = 1.0
        while True:
            trial = x + length * step
            trial_value = potential.value(trial)
            if np.isfinite(trial_value):
                if trial_value <= value + 1e-4 * length * downhill:
                    break
                # Near the minimum the energy is lost in rounding; there the forces judge.
                if abs(length * downhill) < 1e-11 * (abs(value) + abs(trial_value) + 1.0):
                    if np.abs(potential.slope(trial).ravel()[free]).max() < 1.01 * np.abs(residual).max():
                        break
            length *= 0.5
            if length < 1e-8:
                raise NewtonFailure("line search ended at a force of %g" % np.abs(residual).max())
        x, value, slope = trial, trial_value, potential.slope(trial)
        damping = damping * 0.1 if damping > 1e-4 and length == 1.0 else (damping if length < 1.0 else 0.0)
    raise NewtonFailure("force %g left after %d iterations" % (np.abs(slope.ravel()[free]).max(), most))


def settle(solid, loads, x, steps=4, tolerance=1e-7):
    """Finds the equilibrium under the loads, applied in equal steps; tolerance: force left over the total load."""
    scale = max(float(np.abs(loads.force).sum()), 0.01 * solid.material.mu * np.sqrt(solid.area))
    for step in range(1, steps + 1):
        x, _ = minimize(Potential(solid, loads, step / steps), x, loads.fixed, tolerance * scale,
                        solid.mass * (solid.material.mu / (solid.density * solid.area)))
    return x
