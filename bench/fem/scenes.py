# SPDX-License-Identifier: MIT
"""The scenes whose truth is wanted: a disc at rest, pressed, hung, wobbling and dropped; an arm, a column, outlines."""

import numpy as np
from scipy.sparse.linalg import splu

from contact import MatchedFaces, Plate
from mesh import L_CORNERS, Mesh, graded, make_outline, mesh_disc, mesh_polygon, polygon_area, polygon_centroid
from solid import Loads, Material, Potential, Solid, minimize, settle

RADIUS = 50.0
MASS = 1.0
GRAVITY = 980.0
YOUNG = 300.0
POISSON = 0.45
DROP_SPEED = 300.0
DROP_STEP = 1.0 / 2000.0
# The height stays near its least for long, with two minima; an outline at a fixed time compares better.
DROP_OUTLINE_TIME = 0.1
PRESSED_TO = (0.9, 0.75, 0.5, 0.3)
UNSEEN_SHARE = 0.6
OUTLINE_POINTS = 200
BOX_SIDE = 100.0
LIGHT_GRAVITY = 245.0
KINDS = ("circle", "box", "capsule", "L", "star")
COUNTS = (8, 12, 16, 24, 32, 64, 128)


def make_disc(border_count, law="stable", young=YOUNG, poisson=POISSON):
    """Returns the solid disc about the origin."""
    return Solid(mesh_disc(RADIUS, border_count), Material(young, poisson, law), MASS)


def _axis_nodes(mesh, x=0.0):
    """Returns the highest and the lowest node on the vertical line through x, or none if there are not two."""
    on_line = np.flatnonzero(np.abs(mesh.nodes[:, 0] - x) < 1e-6)
    if len(on_line) < 2:
        return on_line
    y = mesh.nodes[on_line, 1]
    return on_line[[int(np.argmin(y)), int(np.argmax(y))]]


def _extents(mesh, x):
    """Returns the width and the height of the outline."""
    points = mesh.outline(x, 4000)
    nodes = x[mesh.border_nodes()]
    both = np.concatenate([points, nodes])
    return np.ptp(both[:, 0]), np.ptp(both[:, 1])


def _state(solid, x, shift=(0.0, 0.0)):
    """Returns the outline of a state beside that at rest, and its widths and area over those at rest."""
    mesh = solid.mesh
    width, height = _extents(mesh, x)
    rest_width, rest_height = _extents(mesh, mesh.nodes)
    return {"outline": mesh.outline(x, OUTLINE_POINTS) + shift,
            "rest_outline": mesh.outline(mesh.nodes, OUTLINE_POINTS) + shift,
            "width_ratio": width / rest_width, "height_ratio": height / rest_height,
            "area_ratio": solid.current_area(x) / solid.area}


def rest(border_count, law="stable"):
    """The disc on a frictionless floor at y = 0 under its weight."""
    solid = make_disc(border_count, law)
    floor = Plate(solid.mesh, RADIUS)
    loads = Loads(solid, GRAVITY, [floor])
    loads.fix(_axis_nodes(solid.mesh), 0)
    x = settle(solid, loads, solid.mesh.nodes + (0.0, 1e-3))
    result = _state(solid, x, (0.0, -RADIUS))
    result.update(floor_force=floor.total_force(x), penetration=floor.penetration(x).max())
    return result


def press(border_count, law="stable", targets=PRESSED_TO, step=0.0125):
    """Returns, for each share of its height, the disc pressed between frictionless plates about the origin."""
    solid = make_disc(border_count, law)
    results = {}
    for target, x, floor in squeeze(solid, targets, step, _axis_nodes(solid.mesh)):
        result = _state(solid, x)
        result.update(plate_force=floor.total_force(x), penetration=floor.penetration(x).max())
        results["press_%g" % target] = result
    return results


def squeeze(solid, targets, step, axis):
    """Closes two plates evenly about the middle; yields (target, positions, lower plate) at each target share.

    Each step starts from the last positions, scaled towards the new height: a start near the solution that puts
    the same nodes in contact.
    """
    nodes = solid.mesh.nodes
    low, high = nodes[:, 1].min(), nodes[:, 1].max()
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    floor, ceiling = Plate(solid.mesh, high), Plate(solid.mesh, low, -1)
    loads = Loads(solid, 0.0, [floor, ceiling])
    loads.fix(axis, 0)
    x, share = nodes, 1.0
    for target in targets:
        count = max(1, int(np.ceil((share - target) / step - 1e-9)))
        for k in range(1, count + 1):
            now = share + (target - share) * k / count
            before = share + (target - share) * (k - 1) / count
            floor.height, ceiling.height = middle + half * now, middle - half * now
            x = settle(solid, loads, np.stack([x[:, 0], middle + (x[:, 1] - middle) * now / before], axis=1), 1)
        share = target
        yield target, x, floor


def hang(border_count, least=0.2, law="stable"):
    """The disc held at its top by the part of the outline within pi/16 and hanging under its weight.

    The stress is singular at the ends of the held part; there the elements have edges of length `least`.
    """
    mesh = mesh_disc(RADIUS, border_count, (-np.pi / 2 - np.pi / 16, -np.pi / 2 + np.pi / 16), least)
    solid = Solid(mesh, Material(YOUNG, POISSON, law), MASS)
    border = mesh.border_nodes()
    angle = np.arctan2(mesh.nodes[border, 0], -mesh.nodes[border, 1])
    held = border[np.abs(angle) <= np.pi / 16 + 1e-9]
    loads = Loads(solid, GRAVITY)
    loads.fix(held)
    x = settle(solid, loads, mesh.nodes)
    result = _state(solid, x)
    result["center_drop"] = solid.mean_position(x)[1]
    return result


def wobble(border_count, law="stable"):
    """The six lowest flexible natural frequencies of the free disc [Hz]."""
    return {"frequencies": make_disc(border_count, law).frequencies(6)}


def drop(border_count, step=DROP_STEP, law="stable", longest=1.5):
    """The undamped disc meets a frictionless floor at y = 0 with DROP_SPEED, under gravity.

    The elastic forces follow the implicit midpoint rule. The contact follows backward Euler, so that a node that
    meets the floor stays there instead of bouncing each step (Kane, Repetto, Ortiz and Marsden 1999). With the
    elastic energy W, the contact energy V and the even force g, the new positions x1 minimize
    |x1 - x0 - dt v0|^2_M / (2 dt^2) + W((x0 + x1)/2) - g.x1 / 2 + V(x1),
    and v1 = v0 - dt M^-1 (grad W - g + grad V).
    """
    solid = make_disc(border_count, law)
    mesh = solid.mesh
    floor = Plate(mesh, RADIUS)
    loads = Loads(solid, GRAVITY, [floor])
    loads.fix(_axis_nodes(mesh), 0)
    free = np.flatnonzero(~loads.fixed.ravel())
    mass_factor = splu(solid.mass[:, free][free].tocsc())
    scale = 1e-7 * MASS * GRAVITY

    class Step(Potential):
        """The function that a time step minimizes."""

        def value(self, x):
            d = (x - self.guess).ravel()
            return (d @ (solid.mass @ d) / (2 * step**2) + solid.energy((self.start + x) / 2)
                    - 0.5 * float((loads.force * x).sum()) + floor.energy(x))

        def slope(self, x):
            d = solid.mass @ (x - self.guess).ravel() / step**2
            return d.reshape(x.shape) + 0.5 * (solid.forces((self.start + x) / 2) - loads.force) + floor.forces(x)

        def curvature(self, x):
            return solid.mass / step**2 + 0.25 * solid.stiffness((self.start + x) / 2) + floor.stiffness(x)

    def total_energy(x, v):
        v = v.ravel()
        return 0.5 * v @ (solid.mass @ v) + solid.energy(x) - float((loads.force * x).sum()) + floor.energy(x)

    potential = Step(solid, loads)
    x, v = mesh.nodes.copy(), np.tile((0.0, DROP_SPEED), (len(mesh.nodes), 1))
    kinetic, energy_at_start = 0.5 * MASS * DROP_SPEED**2, total_energy(x, v)
    least = 2 * RADIUS
    result, history, off_since = None, [], None
    for k in range(1, int(longest / step) + 1):
        potential.start, potential.guess = x, x + step * v
        start = potential.guess.copy()
        start[:, 1] = np.minimum(start[:, 1], np.maximum(x[:, 1], RADIUS))
        new, _ = minimize(potential, start, loads.fixed, scale, solid.mass / step**2)
        push = np.zeros(x.size)
        pull = (loads.force - solid.forces((x + new) / 2) - floor.forces(new)).ravel()
        push[free] = mass_factor.solve(pull[free])
        x, v = new, v + step * push.reshape(v.shape)
        force = floor.total_force(x)
        width, height = _extents(mesh, x)
        least = min(least, height)
        speed = solid.mean_position(v)[1]
        history.append((k * step, float(solid.mean_position(x)[1]) - RADIUS, height / (2 * RADIUS),
                        width / (2 * RADIUS), force))
        if height == least:
            least_time = k * step
        if abs(k * step - DROP_OUTLINE_TIME) < 0.5 * step:
            squashed = _state(solid, x, (0.0, -RADIUS))
            squashed["time"] = k * step
        if force > 0:
            off_since = None
        elif speed < 0:
            if off_since is None:
                off_since = k * step
                result = {"contact_time": off_since, "greatest_squash": 1 - least / (2 * RADIUS),
                          "greatest_squash_time": least_time,
                          "rebound_speed_ratio": -speed / DROP_SPEED,
                          "energy_lost_percent": 100 * (1 - (total_energy(x, v) - energy_at_start + kinetic) / kinetic)}
            # The disc has left the floor when it has not come back in 10 ms.
            if k * step - off_since >= 0.01:
                break
    else:
        raise RuntimeError("drop: the disc does not leave the floor")
    result["squashed"] = squashed
    result["history"] = history
    return result


def arm(spacing, least=None, gravity=GRAVITY, law="stable", fillet=0.0):
    """The L held by its edge at x = 0, bent by its weight.

    least: length of the edges at the inner corner and at the ends of the held edge, where the stress is singular
    (default: `spacing`). fillet: radius that rounds the inner corner.
    Under full gravity the surface in the inner corner is compressed beyond 35 %, where a neo-Hookean surface folds
    into a crease (Hong, Zhao and Suo 2009). Without contact of the surface with itself the crease has no limit as
    the mesh is refined; so this scene has a mesh without refinement, and `arm_light` shows a converged solution.
    """
    corners, marks = L_CORNERS, L_CORNERS[[0, 3, 5]]
    if fillet > 0:
        angle = -0.5 * np.pi * (1.0 + np.arange(13) / 12)
        corner = 40.0 + fillet + fillet * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        corners, marks = (np.concatenate([L_CORNERS[keep], corner, L_CORNERS[end]])
                          for keep, end in (([0, 1, 2], [4, 5]), ([0], [5])))
    mesh = mesh_polygon(corners, spacing, size=graded(spacing, least, marks) if least else None)
    solid = Solid(mesh, Material(YOUNG, POISSON, law), MASS)
    loads = Loads(solid, gravity)
    loads.fix(np.flatnonzero(mesh.nodes[:, 0] < 1e-9))
    x = settle(solid, loads, mesh.nodes, 10)
    result = _state(solid, x)
    tip, _ = mesh.find(100.0, 0.0)
    result["tip_drop"] = x[tip, 1] - mesh.nodes[tip, 1]
    return result


def column(spacing, law="stable"):
    """Three square boxes on a floor at y = 0, one on the other, without friction; lowest box first.

    The faces between boxes have nodes opposite each other. They press along the deformed face's normal and slide
    freely; `slide` says how far, and `renewals` of the normals have made the answer stop changing.
    """
    half = BOX_SIDE / 2
    one = mesh_polygon([(-half, -BOX_SIDE), (half, -BOX_SIDE), (half, 0), (-half, 0)], spacing)
    count = len(one.nodes)
    lift = [np.array((0.0, -BOX_SIDE * k)) for k in range(3)]
    mesh = Mesh(np.concatenate([one.nodes + d for d in lift]),
                np.concatenate([one.elements + count * k for k in range(3)]),
                np.concatenate([one.border + count * k for k in range(3)]))
    solid = Solid(mesh, Material(YOUNG, POISSON, law), 3 * MASS)
    border, weights = one.border_nodes(), one.border_weights()

    def face(y):
        nodes = border[np.abs(one.nodes[border, 1] - y) < 1e-9]
        return nodes[np.argsort(one.nodes[nodes, 0])]

    top, bottom = face(-BOX_SIDE), face(0.0)
    if np.abs(one.nodes[top, 0] - one.nodes[bottom, 0]).max() > 1e-9:
        raise RuntimeError("column: the faces do not match")
    edge = np.diff(one.nodes[bottom[::2], 0])
    share = np.zeros(len(bottom))
    share[1::2] = edge * 4 / 6
    share[0:-1:2] += edge / 6
    share[2::2] += edge / 6
    joints = [MatchedFaces(bottom + count * (k + 1), top + count * k, share) for k in range(2)]
    floor = Plate(mesh, 0.0, nodes=bottom)
    loads = Loads(solid, GRAVITY, [floor] + joints)
    axis = _axis_nodes(one)
    loads.fix(np.concatenate([axis + count * k for k in range(3)]), 0)
    # Each box starts a little inside the one below, so that the first stiffness holds all of them.
    x = settle(solid, loads, mesh.nodes + np.repeat([(0.0, 1e-3 * (k + 1)) for k in range(3)], count, axis=0), 5)
    renewals = 0
    while True:
        before = x
        for joint in joints:
            joint.renew_normals(x)
        x = settle(solid, loads, x, 1)
        renewals += 1
        if np.abs(x - before).max() < 1e-4 or renewals == 20:
            break

    boxes = []
    for k in range(3):
        part = x[count * k:count * (k + 1)]
        boxes.append({"outline": one.outline(part, OUTLINE_POINTS),
                      "rest_outline": one.outline(one.nodes + lift[k], OUTLINE_POINTS)})
    slide = max(float(np.abs((x[j.upper] - x[j.lower])[:, 0]).max()) for j in joints)
    return {"boxes": boxes, "height_ratio": (0.0 - x[:, 1].min()) / (3 * BOX_SIDE), "slide": slide,
            "renewals": renewals, "last_change": float(np.abs(x - before).max()),
            "floor_force": floor.total_force(x),
            "penetration": max([float(floor.penetration(x).max())] + [float(j.penetration(x).max()) for j in joints])}


def egg(border_count, spacing, law="stable"):
    """An egg on its side, pressed to UNSEEN_SHARE of its height. No model was tuned with it: outline, share and state are new."""
    angle = 2.0 * np.pi * np.arange(border_count) / border_count
    x, y = 60.0 * np.cos(angle), 38.0 * np.sin(angle) * (1.0 - 0.25 * np.cos(angle))
    mesh = mesh_polygon(np.stack([x, y], axis=1), spacing, split=False)
    solid = Solid(mesh, Material(YOUNG, POISSON, law), MASS)
    held = np.array([mesh.find(0.0, 0.0)[0]])
    for _, x, floor in squeeze(solid, (UNSEEN_SHARE,), 0.0125, held):
        result = _state(solid, x)
    result.update(pressed_to=UNSEEN_SHARE, rest_height=float(np.ptp(mesh.nodes[:, 1])), plate_force=floor.total_force(x),
                  penetration=floor.penetration(x).max())
    return result


def outline_case(kind, count, spacing=5.0, law="stable"):
    """Returns frequency [Hz], width ratio at 0.75 of the height, and sag of one polygon of the mesh family."""
    polygon = make_outline(kind, count)
    # Refined at the inner corners of L and star, where the stress is singular.
    before, after = (polygon - np.roll(polygon, k, axis=0) for k in (1, -1))
    turn = (before[:, 1] * after[:, 0] - before[:, 0] * after[:, 1]) * np.sign(polygon_area(polygon))
    inner = polygon[turn < -1e-6]
    mesh = mesh_polygon(polygon, spacing, size=graded(spacing, 0.3 * spacing, inner) if len(inner) else None)
    solid = Solid(mesh, Material(YOUNG, POISSON, law), MASS)
    # The state of a symmetric outline is symmetric: its axis stays straight, which also keeps stars on a tip from
    # toppling. L stands on its own; one node stops it from gliding.
    if kind == "L":
        held = np.array([mesh.find(*polygon_centroid(polygon))[0]])
    else:
        held = np.flatnonzero(np.abs(mesh.nodes[:, 0]) < 1e-6)
        if len(held) < 2:
            raise RuntimeError("outline: no nodes on the axis")
    width = None
    for _, x, _ in squeeze(solid, (0.75,), 0.025, held):
        width = _extents(mesh, x)[0] / _extents(mesh, mesh.nodes)[0]

    floor = Plate(mesh, mesh.nodes[:, 1].max())
    loads = Loads(solid, GRAVITY, [floor])
    loads.fix(held, 0)
    x = settle(solid, loads, mesh.nodes + (0.0, 1e-3))
    sag = 1.0 - _extents(mesh, x)[1] / _extents(mesh, mesh.nodes)[1]
    return {"kind": kind, "points": count, "frequency": float(solid.frequencies(1)[0]), "width": float(width),
            "sag": float(sag), "topples": kind == "star" and count in (8, 12), "rolls_over": kind == "L",
            "polygon": polygon}
