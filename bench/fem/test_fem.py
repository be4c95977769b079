# SPDX-License-Identifier: MIT
"""Proves the finite-element reference by claims with known answers; run as `python bench/fem/test_fem.py`."""

import sys
import traceback

import numpy as np
from scipy.optimize import brentq
from scipy.special import jv, jvp

import scenes
from contact import PENALTY, Plate
from mesh import _border_distance, make_outline, mesh_polygon, polygon_area
from solid import Loads, Material, Solid, settle

TESTS = []


def claim(text):
    """Registers a test under the sentence that it proves."""
    def register(function):
        TESTS.append((text, function))
        return function
    return register


def expect(value, wanted, tolerance, name="value"):
    """Fails unless value is within a tolerance of what is wanted."""
    if not abs(value - wanted) <= tolerance:
        raise AssertionError("%s is %.9g, not %.9g +- %.2g" % (name, value, wanted, tolerance))


def make_square(young=200.0, poisson=0.45, law="stable", side=80.0, spacing=13.0):
    half = side / 2
    mesh = mesh_polygon([(-half, -half), (half, -half), (half, half), (-half, half)], spacing)
    return Solid(mesh, Material(young, poisson, law), 1.0)


@claim("a linear displacement of the border gives the same strain in every element (patch test)")
def _():
    for law in ("stable", "log"):
        solid = make_square(law=law)
        nodes = solid.mesh.nodes
        wanted = nodes @ np.array([[1.2, 0.1], [-0.05, 0.8]])
        loads = Loads(solid)
        loads.fix(solid.mesh.border_nodes())
        start = wanted + np.random.default_rng(1).normal(0, 0.2, nodes.shape)
        start[solid.mesh.border_nodes()] = wanted[solid.mesh.border_nodes()]
        x = settle(solid, loads, start, 1, 1e-11)
        # The tolerance on forces, 1e-11 of the scale, over a stiffness of some 100 N/m.
        expect(np.abs(x - wanted).max(), 0.0, 1e-8, "displacement")


@claim("a small uniaxial stretch shows E / (1 - nu^2) and nu / (1 - nu), the plane-strain values of E and nu")
def _():
    for law in ("stable", "log"):
        for poisson in (0.0, 0.3, 0.45, 0.49):
            solid = make_square(poisson=poisson, law=law)
            nodes, strain = solid.mesh.nodes, 1e-5
            right, left = nodes[:, 0] > 39.999, nodes[:, 0] < -39.999
            loads = Loads(solid)
            loads.fix(np.flatnonzero(right | left), 0)
            loads.fix(solid.mesh.find(0, 0)[0], 1)
            start = nodes.copy()
            start[right, 0] += strain * 80.0
            x = settle(solid, loads, start, 1, 1e-11)
            force = solid.forces(x)[right, 0].sum()
            # Second-order terms are of the size of the strain.
            expect(force / 80.0 / strain * (1 - poisson**2) / 200.0, 1.0, 1e-4, "E ratio")
            top, bottom = nodes[:, 1] < -39.999, nodes[:, 1] > 39.999
            thinner = 1.0 - (x[bottom, 1].mean() - x[top, 1].mean()) / 80.0
            expect(thinner / strain, poisson / (1 - poisson), 1e-4, "transverse strain ratio")


@claim("a uniform compression costs A0 K/2 (s^2 - 1)^2, with K = E / (2 (1 + nu) (1 - 2 nu))")
def _():
    solid = make_square()
    bulk = 200.0 / (2 * 1.45 * 0.1)
    for s in (0.5, 0.9, 1.2):
        expect(solid.energy(s * solid.mesh.nodes) / (6400 * bulk / 2 * (s * s - 1) ** 2), 1.0, 1e-10, "energy ratio")


@claim("turning and moving the solid costs nothing and takes no force")
def _():
    for law in ("stable", "log"):
        solid = make_square(law=law)
        x = solid.mesh.nodes @ np.array([[np.cos(2.0), np.sin(2.0)], [-np.sin(2.0), np.cos(2.0)]]) + (30.0, -7.0)
        expect(solid.energy(x), 0.0, 1e-8, "energy")
        expect(np.abs(solid.forces(x)).max(), 0.0, 1e-9, "force")


@claim("forces are the slope of the energy, and the stiffness is the slope of the forces")
def _():
    random = np.random.default_rng(1)
    for law in ("stable", "log"):
        solid = make_square(law=law, spacing=30.0)
        x = solid.mesh.nodes * (1.1, 0.8) + random.normal(0, 0.5, solid.mesh.nodes.shape)
        d = random.normal(0, 1, x.shape)
        h = 1e-4
        by_energy = (solid.energy(x + h * d) - solid.energy(x - h * d)) / (2 * h)
        expect(by_energy / float((solid.forces(x) * d).sum()), 1.0, 1e-6, "force ratio")
        by_force = (solid.forces(x + h * d) - solid.forces(x - h * d)).ravel() / (2 * h)
        exact = solid.stiffness(x) @ d.ravel()
        expect(np.abs(by_force - exact).max() / np.abs(exact).max(), 0.0, 1e-6, "stiffness error")


@claim("the mass matrix holds the mass, its center and its moment of inertia, m R^2 / 2 of a disc")
def _():
    solid = scenes.make_disc(64)
    ones = np.tile((0.0, 1.0), len(solid.mesh.nodes))
    expect(ones @ (solid.mass @ ones), 1.0, 1e-12, "mass")
    turn = np.stack([-solid.mesh.nodes[:, 1], solid.mesh.nodes[:, 0]], axis=1).ravel()
    # The curved border is replaced by parabolas; their area is right to 2e-7.
    expect(turn @ (solid.mass @ turn) / (0.5 * 50.0**2), 1.0, 1e-6, "moment ratio")


def disc_frequencies(order, young, poisson, radius, density, count=2):
    """Returns the lowest frequencies [Hz] of a free disc in plane strain whose displacement has `order` waves around.

    With potentials A J_n(a r) cos(n t) and B J_n(b r) sin(n t), a = w / c_p, b = w / c_s, both tractions vanish at
    r = R where the determinant of their coefficients does (Love 1927, art. 199; Holland 1966).
    """
    mu = young / (2 * (1 + poisson))
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    n, r = order, radius

    def determinant(omega):
        a, b = omega * np.sqrt(density / (lame + 2 * mu)), omega * np.sqrt(density / mu)
        Ja, da, dda = jv(n, a * r), a * jvp(n, a * r), a * a * jvp(n, a * r, 2)
        Jb, db, ddb = jv(n, b * r), b * jvp(n, b * r), b * b * jvp(n, b * r, 2)
        radial = (-lame * a * a * Ja + 2 * mu * dda, 2 * mu * n * (db / r - Jb / r**2))
        shear = (2 * n * (Ja / r**2 - da / r), db / r - ddb - n * n * Jb / r**2)
        return radial[0] * shear[1] - radial[1] * shear[0]

    step = 0.02 * np.sqrt(mu / density) / r
    omegas = step * np.arange(10, 1000)
    values = np.array([determinant(omega) for omega in omegas])
    roots = [brentq(determinant, omegas[k], omegas[k + 1], xtol=1e-12)
             for k in np.flatnonzero(values[:-1] * values[1:] < 0)[:count]]
    return np.array(roots) / (2 * np.pi)


@claim("the frequencies of a free disc are the roots of the Bessel equation for 2, 1 and 3 waves around, within 1e-4")
def _():
    for young, poisson in ((200.0, 0.45), (500.0, 0.3)):
        solid = scenes.make_disc(96, young=young, poisson=poisson)
        density = 1.0 / (np.pi * 2500.0)
        exact = sorted(f for n in (1, 2, 3) for f in disc_frequencies(n, young, poisson, 50.0, density))
        got = solid.frequencies(8)
        got = got[::2]
        for k in range(3):
            expect(min(abs(got[k] / f - 1) for f in exact), 0.0, 1e-4, "distance to the nearest root")
        expect(got[0] / disc_frequencies(2, young, poisson, 50.0, density)[0], 1.0, 1e-4, "ratio of the lowest")


@claim("the error of the disc's frequency falls with the fourth power of the element size")
def _():
    exact = disc_frequencies(2, scenes.YOUNG, 0.45, 50.0, 1.0 / (np.pi * 2500.0))[0]
    errors = [scenes.make_disc(n).frequencies(2).mean() / exact - 1 for n in (24, 48, 96)]
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    # Two orders per power of the shape functions; meshes are not similar to each other, hence the room.
    if not (min(errors) > 0 and 3.3 < np.mean(orders) < 5.0):
        raise AssertionError("errors %s, orders %s" % (errors, orders))


@claim("a square on a floor carries its weight, and each level the weight above it")
def _():
    solid = make_square()
    floor = Plate(solid.mesh, 40.0)
    loads = Loads(solid, 980.0, [floor])
    loads.fix(scenes._axis_nodes(solid.mesh), 0)
    x = settle(solid, loads, solid.mesh.nodes + (0.0, 1e-3))
    expect(floor.total_force(x) / 980.0, 1.0, 1e-6, "floor force ratio")
    F, cof, J = solid.deformation(x)
    material = solid.material
    P = material.mu * F + material.volume_energy(J)[1][..., None, None] * cof
    # The mean of P22 times the height is the weight times half the height: the virtual work of a uniform stretch.
    mean = float((solid.weight * P[..., 1, 1]).sum()) / solid.area
    expect(mean / (-0.5 * 980.0 / 80.0), 1.0, 1e-4, "mean vertical stress ratio")


@claim("the resting disc's floor carries m g within 0.1 %, the disc is symmetric, and penetrates less than 1e-4 R")
def _():
    result = scenes.rest(64)
    expect(result["floor_force"] / 980.0, 1.0, 1e-3, "floor force ratio")
    expect(result["penetration"], 0.0, 1e-4 * 50.0, "penetration")
    outline = result["outline"]
    # Point 50 of 200 is the lowest; point 50 + k mirrors point 50 - k.
    mirrored = outline[(100 - np.arange(200)) % 200] * (-1.0, 1.0)
    expect(np.abs(outline - mirrored).max(), 0.0, 1e-6, "asymmetry")


@claim("a lightly pressed disc has the width and the force of Hertz's line contact")
def _():
    # Two-dimensional modulus E / (1 - nu^2) against a rigid plate: b^2 = 4 F R / (pi E'), Johnson 1985, eq. 4.43.
    solid = scenes.make_disc(256)
    share = 0.99
    _, x, floor = next(scenes.squeeze(solid, (share,), 0.0025, scenes._axis_nodes(solid.mesh)))
    force, plane = floor.total_force(x), scenes.YOUNG / (1 - 0.45**2)
    # Greatest pressure p0 = 2 F / (pi b) at the middle, from the penalty's own penetration.
    b = np.sqrt(4 * force * 50.0 / (np.pi * plane))
    peak = PENALTY * floor.penetration(x).max()
    expect(peak / (2 * force / (np.pi * b)), 1.0, 0.08, "greatest pressure ratio")
    # Approach of the center to one plate: F / (pi E') (2 ln(4 R / b) - 1), Johnson 1985, eq. 5.56.
    approach = force / (np.pi * plane) * (2 * np.log(4 * 50.0 / b) - 1)
    expect(approach / (50.0 * (1 - share)), 1.0, 0.02, "approach ratio")


@claim("the pressed disc is symmetric about both axes and pushes on both plates alike")
def _():
    result = scenes.press(64, targets=(0.75, 0.5))["press_0.5"]
    outline = result["outline"]
    for mirror, order in (((-1.0, 1.0), 100), ((1.0, -1.0), 200)):
        mirrored = outline[(order - np.arange(200)) % 200] * mirror
        expect(np.abs(outline - mirrored).max(), 0.0, 1e-5, "asymmetry")
    expect(result["penetration"], 0.0, 1e-4 * 50.0, "penetration")


@claim("the hanging disc's pin carries m g")
def _():
    solid = scenes.make_disc(64)
    border = solid.mesh.border_nodes()
    held = border[np.abs(np.arctan2(solid.mesh.nodes[border, 0], -solid.mesh.nodes[border, 1])) <= np.pi / 16 + 1e-9]
    loads = Loads(solid, 980.0)
    loads.fix(held)
    x = settle(solid, loads, solid.mesh.nodes)
    expect((loads.force - solid.forces(x))[held, 1].sum() / 980.0, 1.0, 1e-6, "pin force ratio")


@claim("the column's floor carries three weights, and its faces slide by less than 0.1 px")
def _():
    result = scenes.column(12.5)
    expect(result["floor_force"] / (3 * 980.0), 1.0, 1e-6, "floor force ratio")
    expect(result["slide"], 0.0, 0.1, "slide")


@claim("every outline has its points and its area, is its own mirror image (but L), and can be meshed")
def _():
    for kind in scenes.KINDS:
        for count in scenes.COUNTS:
            polygon = make_outline(kind, count)
            expect(len(polygon), count, 0, kind)
            mesh_polygon(polygon, 6.0)
            if kind != "L":
                # Points on straight sides need not mirror each other, sides must.
                gap = _border_distance(polygon * (-1.0, 1.0), polygon).max()
                expect(gap, 0.0, 1e-9, "asymmetry of %s %d" % (kind, count))
            area = {"circle": 0.5 * count * 2500 * np.sin(2 * np.pi / count), "box": 6400.0, "L": 6400.0}.get(kind)
            if area:
                expect(abs(polygon_area(polygon)), area, 1e-8, "area of %s %d" % (kind, count))


@claim("the dropped disc obeys the impulse law, and the time step costs less than 2 % of its energy")
def _():
    result = scenes.drop(32, 1 / 1000)
    times, forces = np.array([(row[0], row[4]) for row in result["history"]]).T
    inside = times <= result["contact_time"] + 1e-9
    impulse = forces[inside].sum() / 1000 - 980.0 * result["contact_time"]
    # The impulse of the floor less that of gravity turns the speed around.
    expect(impulse / (300.0 * (1 + result["rebound_speed_ratio"])), 1.0, 1e-5, "impulse ratio")
    if not 0.0 < result["energy_lost_percent"] < 2.0:
        raise AssertionError("energy lost: %g %%" % result["energy_lost_percent"])


def main():
    failed = 0
    for text, test in TESTS:
        try:
            test()
            print("ok    " + text, flush=True)
        except Exception:
            failed += 1
            print("FAIL  " + text)
            traceback.print_exc(file=sys.stdout)
    print("%d passed, %d failed" % (len(TESTS) - failed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
