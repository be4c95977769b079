# SPDX-License-Identifier: MIT
"""The independent reference: moves a described body by SciPy's DOP853 to twelve digits.

It knows the core only by the JSON description that `work_precision.cpp` writes: points, masses, springs and the
coefficients of shape matching, pressure and gravity. The forces below are written from their formulas.
"""

import hashlib
import json
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

RELATIVE_TOLERANCE = 1e-12
ABSOLUTE_TOLERANCE = 1e-14


class Network:
    """Accelerations of a spring network with its area and shape terms, for state arrays of shape (points, 2)."""

    def __init__(self, description):
        springs = description["springs"]
        self.masses = np.array(description["masses"], dtype=float)[:, None]
        count = len(self.masses)
        # One row a spring: -1 at its first end, +1 at its second; the row times the positions is the vector between.
        self.between = np.zeros((len(springs), count))
        for row, spring in enumerate(springs):
            self.between[row, [spring["a"], spring["b"]]] = -1, 1
        self.rest_lengths, self.stiffness, self.damping = (
            np.array([spring[key] for spring in springs], dtype=float)
            for key in ("rest_length", "stiffness", "damping")
        )
        self.hull_count = description["hull_count"]
        self.pressure_stiffness = description["pressure_stiffness"]
        self.inflation = description["inflation"]
        self.gravity = np.array(description["gravity"], dtype=float)

        self.total_mass = self.masses.sum()
        rest = np.array(description["rest_positions"], dtype=float)
        self.rest_area = self.area(rest[: self.hull_count])
        self.rest = rest - (self.masses * rest).sum(axis=0) / self.total_mass
        # A point of mass m is drawn to its goal with k_s m / mean(m): an acceleration of k_s / mean(m) a meter.
        mean = self.total_mass / count
        self.shape_rate = description["shape_stiffness"] / mean
        self.shape_damping_rate = description["shape_damping"] / mean

    @staticmethod
    def area(hull):
        """Signed area by the trapezoids under the edges."""
        x, y = hull.T
        return 0.5 * np.sum((x - np.roll(x, -1)) * (y + np.roll(y, -1)))

    def accelerations(self, x, v):
        d = self.between @ x
        lengths = np.sqrt((d * d).sum(axis=1))
        directions = d / lengths[:, None]
        rates = (directions * (self.between @ v)).sum(axis=1)
        tensions = self.stiffness * (lengths - self.rest_lengths) + self.damping * rates
        result = self.between.T @ (directions * -tensions[:, None]) / self.masses + self.gravity
        if self.pressure_stiffness:
            hull = x[: self.hull_count]
            pressure = self.pressure_stiffness * (self.inflation - self.area(hull) / self.rest_area)
            chord = np.roll(hull, -1, axis=0) - np.roll(hull, 1, axis=0)
            outward = 0.5 * np.stack((chord[:, 1], -chord[:, 0]), axis=1)
            result[: self.hull_count] += pressure * outward / self.masses[: self.hull_count]
        if self.shape_rate or self.shape_damping_rate:
            result += self.shape_accelerations(x, v)
        return result

    def shape_accelerations(self, x, v):
        """Towards the rigid copy of the rest shape that fits best, and against motion relative to a rigid one."""
        center = (self.masses * x).sum(axis=0) / self.total_mass
        drift = (self.masses * v).sum(axis=0) / self.total_mass
        arms = x - center
        # As complex numbers the best rotation is the phase of sum m conj(rest) arm.
        rest, arm, motion = (np.ascontiguousarray(a).view(complex)[:, 0] for a in (self.rest, arms, v - drift))
        weights = self.masses[:, 0]
        turn = np.sum(weights * rest.conj() * arm)
        goal = rest * (turn / abs(turn))
        spin = np.sum(weights * (arm.conj() * motion).imag) / np.sum(weights * abs(arm) ** 2)
        rigid = 1j * spin * arm
        pull = self.shape_rate * (goal - arm) + self.shape_damping_rate * (rigid - motion)
        return np.stack((pull.real, pull.imag), axis=1)


def solve(description, times, relative_tolerance=RELATIVE_TOLERANCE):
    """Positions of all points at the given times [s], as an array of shape (times, points, 2)."""
    network = Network(description)
    start = np.array([description["positions"], description["velocities"]], dtype=float)

    def slope(_, state):
        x, v = state.reshape(start.shape)
        return np.concatenate((v.ravel(), network.accelerations(x, v).ravel()))

    # The solver is stopped at each time, as its interpolation in between has fewer digits than its steps.
    state, states, now = start.ravel(), [], 0.0
    step = None
    for time in times:
        solution = solve_ivp(
            slope,
            (now, time),
            state,
            method="DOP853",
            rtol=relative_tolerance,
            atol=ABSOLUTE_TOLERANCE,
            first_step=None if step is None else min(step, time - now),
        )
        if not solution.success:
            raise RuntimeError(f"the reference solution failed: {solution.message}")
        step = np.max(np.diff(solution.t))
        state, now = solution.y[:, -1], time
        states.append(state.reshape(start.shape)[0])
    return np.array(states)


def solve_cached(description, times, folder):
    """As `solve`, but remembered in the folder under a hash of the question and of this program."""
    question = json.dumps([description, list(times), RELATIVE_TOLERANCE, ABSOLUTE_TOLERANCE], sort_keys=True)
    key = hashlib.sha256((question + Path(__file__).read_text(encoding="utf-8")).encode()).hexdigest()[:24]
    file = Path(folder) / f"{key}.npy"
    if file.is_file():
        return np.load(file)
    answer = solve(description, times)
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_suffix(f".{key}.part.npy")
    np.save(part, answer)
    part.replace(file)
    return answer
