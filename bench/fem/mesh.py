# SPDX-License-Identifier: MIT
"""Triangle meshes of polygons and discs with quadratic (six-node) triangles, and the polygons of our bodies."""

import numpy as np
from scipy.spatial import Delaunay, cKDTree


class Mesh:
    """Quadratic triangles: three vertices, then the middles of the edges 01, 12, 20; positive winding.

    nodes: rest positions (N, 2) [px]; elements: (M, 6); border: (B, 3) first vertex, middle, last vertex of the
    border edges, in the order of the outline.
    """

    def __init__(self, nodes, elements, border):
        self.nodes = nodes
        self.elements = elements
        self.border = border

    def border_nodes(self):
        """Returns every node of the outline once, in order."""
        return self.border[:, :2].ravel()

    def border_weights(self):
        """Returns the rest length that each node of `border_nodes` stands for: Simpson's rule, 1/6, 4/6, 1/6."""
        length = self._border_lengths()
        weights = np.empty((len(self.border), 2))
        weights[:, 0] = (length + np.roll(length, 1)) / 6.0
        weights[:, 1] = length * 4.0 / 6.0
        return weights.ravel()

    def _border_lengths(self):
        """Returns the rest lengths of the border edges, which are parabolas: two-point Gauss rule on |dx/ds|."""
        first, middle, last = (self.nodes[self.border[:, k]] for k in range(3))
        total = 0.0
        for s in (0.5 - np.sqrt(1 / 12), 0.5 + np.sqrt(1 / 12)):
            tangent = (4 * s - 3) * first + (4 - 8 * s) * middle + (4 * s - 1) * last
            total = total + 0.5 * np.linalg.norm(tangent, axis=1)
        return total

    def outline(self, positions, count=200):
        """Returns `count` material points of the outline, evenly spaced along the rest perimeter."""
        length = self._border_lengths()
        ends = np.cumsum(length)
        along = np.arange(count) * ends[-1] / count
        edge = np.minimum(np.searchsorted(ends, along + 1e-9 * ends[-1], side="right"), len(length) - 1)
        s = np.clip((along - (ends[edge] - length[edge])) / length[edge], 0.0, 1.0)
        shape = np.stack([(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)])
        return np.einsum("ak,kai->ki", shape, positions[self.border[edge]])

    def find(self, x, y):
        """Returns the node nearest to a rest position, and its distance from it."""
        distance = np.hypot(self.nodes[:, 0] - x, self.nodes[:, 1] - y)
        return int(np.argmin(distance)), float(distance.min())


def polygon_area(points):
    """Returns the signed area by the shoelace formula; positive if x turns towards y."""
    x, y = np.asarray(points, float).T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def polygon_centroid(points):
    """Returns the center of area."""
    points = np.asarray(points, float)
    following = np.roll(points, -1, axis=0)
    cross = points[:, 0] * following[:, 1] - following[:, 0] * points[:, 1]
    return ((points + following) * cross[:, None]).sum(axis=0) / (3.0 * cross.sum())


def _inside(points, corners):
    """Returns which points lie inside a polygon, by counting crossings."""
    x, y = points[:, :1], points[:, 1:]
    a, b = corners, np.roll(corners, -1, axis=0)
    rises = (a[:, 1] > y) != (b[:, 1] > y)
    slope = (b[:, 0] - a[:, 0]) / np.where(b[:, 1] == a[:, 1], 1.0, b[:, 1] - a[:, 1])
    return (rises & (x < a[:, 0] + (y - a[:, 1]) * slope)).sum(axis=1) % 2 == 1


def _border_distance(points, corners):
    """Returns the distance from each point to the polygon's outline."""
    a, along = corners, np.roll(corners, -1, axis=0) - corners
    offset = points[:, None, :] - a
    t = np.clip((offset * along).sum(-1) / (along * along).sum(-1), 0.0, 1.0)
    return np.linalg.norm(offset - t[..., None] * along, axis=-1).min(axis=1)


def _triangulate(points, corners):
    """Returns the Delaunay triangles whose centroids lie inside, without the flat ones along straight sides."""
    triangles = Delaunay(points).simplices
    a, b, c = (points[triangles[:, k]] for k in range(3))
    ab, ac = b - a, c - a
    area = 0.5 * (ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0])
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    longest = np.maximum(np.maximum((ab**2).sum(1), (ac**2).sum(1)), ((c - b) ** 2).sum(1))
    keep = (np.abs(area) > 1e-6 * longest) & _inside((a + b + c) / 3.0, corners)
    return triangles[keep]


def graded(spacing, least, points, growth=0.3):
    """Returns an edge length as a function of place: `least` at some points, growing with the distance from them."""
    points = np.asarray(points, float)

    def size(places):
        away = np.linalg.norm(np.asarray(places)[..., None, :] - points, axis=-1).min(axis=-1)
        return np.minimum(spacing, least + growth * away)

    return size


def _split_side(place, length, spacing, size):
    """Returns parameters in [0, 1) that split a side into pieces of about the wanted length.

    place: maps parameters to positions; length: of the side.
    """
    if size is None:
        count = max(1, int(np.ceil(length / spacing - 1e-6)))
        return np.arange(count) / count
    t = np.linspace(0.0, 1.0, 2001)
    density = length / size(place(t))
    pieces = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1])) / 2000.0])
    count = max(1, int(np.ceil(pieces[-1] - 1e-6)))
    return np.interp(np.arange(count) * pieces[-1] / count, pieces, t)


def _lattice(middle, reach, spacing):
    """Returns a hexagonal lattice through `middle` that covers a square of half width `reach`."""
    rows = int(np.ceil(reach / (spacing * np.sqrt(0.75)))) + 2
    row, column = np.meshgrid(np.arange(-rows, rows + 1), np.arange(-rows, rows + 1), indexing="ij")
    return np.stack([middle[0] + (column + 0.5 * (row % 2)) * spacing, middle[1] + row * spacing * np.sqrt(0.75)],
                    axis=-1).reshape(-1, 2)


def _inner_points(corners, spacing, size):
    """Returns inner vertices: of lattices whose spacing halves where smaller edges are wanted, away from the border."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle, reach = (low + high) / 2.0, (high - low).max() / 2.0
    kept = np.empty((0, 2))
    fineness = spacing
    while True:
        points = _lattice(middle, reach, fineness)
        points = points[_inside(points, corners)]
        wanted = np.full(len(points), spacing) if size is None else size(points)
        right = wanted > 0.75 * fineness
        if fineness < spacing:
            right &= wanted <= 1.5 * fineness
        points, wanted = points[right], wanted[right]
        points, wanted = (values[_border_distance(points, corners) > 0.65 * wanted] for values in (points, wanted))
        if len(kept) and len(points):
            distance, _ = cKDTree(kept).query(points)
            points = points[distance > 0.75 * wanted]
        kept = np.concatenate([kept, points])
        fineness *= 0.5
        if size is None or 1.5 * fineness < size(corners).min():
            return kept


def mesh_polygon(corners, spacing, round_radius=None, size=None, split=True):
    """Returns a mesh of a simple polygon with edges of about `spacing`, or of `size`(places) if that is given.

    The corners stay vertices. Inner vertices start on a hexagonal lattice about the middle of the bounding box.
    `round_radius`: the corners lie on a circle of this radius about the origin, and the middles of the border edges
    are moved onto it (isoparametric elements). `split`: false if the corners are all the border vertices wanted.
    """
    corners = np.asarray(corners, float)
    if polygon_area(corners) < 0:
        corners = corners[::-1]
    border = corners
    if split:
        border = []
        for a, b in zip(corners, np.roll(corners, -1, axis=0)):
            t = _split_side(lambda t: a + (b - a) * np.asarray(t)[:, None], np.linalg.norm(b - a), spacing, size)
            border.append(a + (b - a) * t[:, None])
        border = np.concatenate(border)
    inner = _inner_points(corners, spacing, size)
    points = np.concatenate([border, inner])
    count = len(border)
    triangles = _triangulate(points, corners)
    for _ in range(4 if size is None else 12):
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        edges = np.unique(np.sort(edges, axis=1), axis=0)
        edges = np.concatenate([edges, edges[:, ::-1]])
        total = np.stack([np.bincount(edges[:, 0], points[edges[:, 1], k], len(points)) for k in range(2)], axis=1)
        degree = np.bincount(edges[:, 0], minlength=len(points))[:, None]
        points[count:] = (total / np.maximum(degree, 1))[count:]
        triangles = _triangulate(points, corners)

    return _to_quadratic(points, triangles, len(border), corners, round_radius)


def _to_quadratic(points, triangles, border_count, corners, round_radius):
    """Adds the edges' middles and checks that the triangles fill the polygon and hold every border edge."""
    used = np.unique(triangles)
    if len(used) != len(points):
        raise ValueError("mesh: %d vertices belong to no triangle" % (len(points) - len(used)))
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    edges, index, uses = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    index = index.ravel()
    nodes = np.concatenate([points, points[edges].mean(axis=1)])
    elements = np.concatenate([triangles, len(points) + index.reshape(3, -1).T], axis=1)

    lookup = {tuple(edge): k for k, edge in enumerate(edges)}
    border = []
    for first in range(border_count):
        last = (first + 1) % border_count
        edge = lookup.get((min(first, last), max(first, last)))
        if edge is None or uses[edge] != 1:
            raise ValueError("mesh: border segment %d is not a border edge of the triangles" % first)
        border.append((first, len(points) + edge, last))
    border = np.array(border)
    if np.count_nonzero(uses == 1) != border_count:
        raise ValueError("mesh: the triangles have a hole or a loose edge")
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum()
    if abs(area / polygon_area(corners) - 1.0) > 1e-9:
        raise ValueError("mesh: area %g instead of %g" % (area, polygon_area(corners)))
    if round_radius is not None:
        middle = nodes[border[:, 1]]
        nodes[border[:, 1]] = middle * (round_radius / np.linalg.norm(middle, axis=1))[:, None]
    return Mesh(nodes, elements, border)


def mesh_disc(radius, border_count, marks=(), least=None):
    """Returns a mesh of a disc about the origin; the border vertices are at angles 2 pi k / border_count.

    With `marks`, two angles in order, vertices lie at these, and the edges there have the length `least`; the
    outline then starts at the first mark.
    """
    spacing = 1.001 * 2.0 * radius * np.sin(np.pi / border_count)
    size = None
    angles = 2.0 * np.pi * np.arange(border_count) / border_count
    if len(marks):
        size = graded(spacing, least, [(radius * np.cos(mark), radius * np.sin(mark)) for mark in marks])
        angles = []
        for first, last in ((marks[0], marks[1]), (marks[1], marks[0] + 2.0 * np.pi)):
            t = _split_side(lambda t: radius * np.stack([np.cos(first + (last - first) * t),
                                                         np.sin(first + (last - first) * t)], axis=1),
                            radius * (last - first), spacing, size)
            angles.append(first + (last - first) * t)
        angles = np.concatenate(angles)
    corners = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return mesh_polygon(corners, spacing, round_radius=radius, size=size, split=False)


# The outlines of our bodies, y down, in px.

L_CORNERS = np.array([(0, 0), (100, 0), (100, 40), (40, 40), (40, 100), (0, 100)], float)


def _subdivide(corners, count):
    """Splits sides evenly, always the one with the longest pieces (ties: the first), until there are `count` points."""
    corners = np.asarray(corners, float)
    sides = np.roll(corners, -1, axis=0) - corners
    length = np.linalg.norm(sides, axis=1)
    pieces = np.ones(len(corners), int)
    for _ in range(count - len(corners)):
        piece = np.round(length / pieces, 9)
        pieces[int(np.argmax(piece))] += 1
    return np.concatenate([corners[k] + sides[k] * (np.arange(n) / n)[:, None] for k, n in enumerate(pieces)])



def make_outline(kind, count):
    """Returns the polygon of a body: "circle", "box", "capsule", "L" (standing, arm up at the left) or "star"."""
    if kind == "circle":
        angle = 2.0 * np.pi * (np.arange(count) + 0.5) / count
        # With count a multiple of 4, the two lowest points lie at angles pi/2 -+ pi/count.
        return 50.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    if kind == "box":
        corners = np.array([(-40, -40), (40, -40), (40, 40), (-40, 40)], float)
        return _subdivide(corners, count)
    if kind == "capsule":
        radius, half = 25.0, 40.0
        turn = np.pi * radius
        total = 4.0 * half + 2.0 * turn

        def at(s):
            # Starts at the middle of the lower side and runs along +x.
            if s < half:
                return s, radius
            s -= half
            if s < turn:
                return half + radius * np.sin(s / radius), radius * np.cos(s / radius)
            s -= turn
            if s < 2 * half:
                return half - s, -radius
            s -= 2 * half
            if s < turn:
                return -half - radius * np.sin(s / radius), -radius * np.cos(s / radius)
            return -half + (s - turn), radius

        return np.array([at((total * (k + 0.5) / count) % total) for k in range(count)])
    if kind == "L":
        return _subdivide(L_CORNERS * (1.0, -1.0), count)
    if kind == "star":
        tips = {8: 4, 12: 6}.get(count, 5)
        angle = -0.5 * np.pi + np.pi * np.arange(2 * tips) / tips
        radius = np.where(np.arange(2 * tips) % 2 == 0, 60.0, 35.0)
        return _subdivide(radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1), count)
    raise ValueError("no such outline: " + kind)
