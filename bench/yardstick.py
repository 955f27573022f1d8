# SPDX-License-Identifier: MIT
"""The figures that tetmend promises not to make worse, from plain lists by formulas of their own:
no line of the program that is judged has a part in them.

The corners of a tet are taken in the order of their coordinates. So a tet that stayed has the same
figures to the last bit, however it is numbered.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import atan2, sqrt
from typing import NamedTuple

from medit import Mesh, Point, Tet

Surface = Counter  # of (label, corners of a face counterclockwise from outside that label)

ROUNDING = 1e-9  # degrees: an angle so near to a bound counts as what is better for the program
DEGREES = 180 / math.pi
STEEP = math.cos(math.radians(70))


@dataclass
class Figures:
    """All that is promised or aimed at. Counts are ranges: without and with what is at a bound."""

    tets: int
    theta_min: float  # degrees
    theta_max: float
    bad: tuple[int, int]
    lambda_percent: tuple[float, float]
    worst_mean_ratio: float
    worst_radius_ratio: float
    edge_ratio: float
    mean_mean_ratio: float
    mean_radius_ratio: float
    steep_faces: int  # with more than 70 degrees of non-orthogonality
    not_positive: int  # tets, in exact arithmetic


def six_volumes(a: Point, b: Point, c: Point, d: Point) -> float:
    x, y, z = a
    ux, uy, uz = b[0] - x, b[1] - y, b[2] - z
    vx, vy, vz = c[0] - x, c[1] - y, c[2] - z
    return ((uy * vz - uz * vy) * (d[0] - x) + (uz * vx - ux * vz) * (d[1] - y)
            + (ux * vy - uy * vx) * (d[2] - z))


def orientation(corners: list[Point]) -> int:
    """Sign of the volume, exact."""
    volume = six_volumes(*corners)
    size = max(abs(p - q) for point in corners[1:] for p, q in zip(point, corners[0], strict=True))
    if abs(volume) <= 1e-14 * size ** 3:
        volume = six_volumes(*(tuple(map(Fraction, point)) for point in corners))
    return (volume > 0) - (volume < 0)


class TetFigures(NamedTuple):
    angles: tuple[float, ...]  # degrees
    mean_ratio: float
    radius_ratio: float
    edge_ratio: float


def tet_figures(corners: list[Point]) -> TetFigures:
    """Of a tet without regard to its orientation; written out, for it is called for each."""
    (x, y, z), b, c, d = sorted(corners)
    ux, uy, uz = b[0] - x, b[1] - y, b[2] - z
    vx, vy, vz = c[0] - x, c[1] - y, c[2] - z
    wx, wy, wz = d[0] - x, d[1] - y, d[2] - z
    px, py, pz = c[0] - b[0], c[1] - b[1], c[2] - b[2]
    qx, qy, qz = d[0] - b[0], d[1] - b[1], d[2] - b[2]
    rx, ry, rz = d[0] - c[0], d[1] - c[1], d[2] - c[2]
    uu, vv = ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz
    ww, pp = wx * wx + wy * wy + wz * wz, px * px + py * py + pz * pz
    qq, rr = qx * qx + qy * qy + qz * qz, rx * rx + ry * ry + rz * rz
    # The normals of the faces opposite a, b, c, d: all outwards or all inwards.
    ax, ay, az = qy * pz - qz * py, qz * px - qx * pz, qx * py - qy * px
    bx, by, bz = vy * wz - vz * wy, vz * wx - vx * wz, vx * wy - vy * wx
    cx, cy, cz = wy * uz - wz * uy, wz * ux - wx * uz, wx * uy - wy * ux
    dx, dy, dz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    volume = abs(dx * wx + dy * wy + dz * wz)  # times 6
    edge_ratio = sqrt(max(uu, vv, ww, pp, qq, rr) / (min(uu, vv, ww, pp, qq, rr) or 5e-324))
    if volume == 0:
        return TetFigures((0.0, 180.0), 0.0, 0.0, edge_ratio)
    # The product of two normals is six volumes times the edge in which the faces meet.
    angles = (
        DEGREES * atan2(volume * sqrt(uu), -(cx * dx + cy * dy + cz * dz)),
        DEGREES * atan2(volume * sqrt(vv), -(bx * dx + by * dy + bz * dz)),
        DEGREES * atan2(volume * sqrt(ww), -(bx * cx + by * cy + bz * cz)),
        DEGREES * atan2(volume * sqrt(pp), -(ax * dx + ay * dy + az * dz)),
        DEGREES * atan2(volume * sqrt(qq), -(ax * cx + ay * cy + az * cz)),
        DEGREES * atan2(volume * sqrt(rr), -(ax * bx + ay * by + az * bz)),
    )
    area = (sqrt(ax * ax + ay * ay + az * az) + sqrt(bx * bx + by * by + bz * bz)
            + sqrt(cx * cx + cy * cy + cz * cz) + sqrt(dx * dx + dy * dy + dz * dz))  # times 2
    # The circumcentre seen from a is (ww d + vv c + uu b) / (2 volume).
    circumradius = sqrt((ww * dx + vv * cx + uu * bx) ** 2 + (ww * dy + vv * cy + uu * by) ** 2
                        + (ww * dz + vv * cz + uu * bz) ** 2) / (2 * volume)
    mean_ratio = 12 * (volume / 2) ** (2 / 3) / (uu + vv + ww + pp + qq + rr)
    return TetFigures(angles, mean_ratio, 3 * volume / area / circumradius, edge_ratio)


def faces_of(tet: Tet) -> Iterator[tuple[int, int, int]]:
    """Counterclockwise as seen from outside a positive tet."""
    a, b, c, d = tet
    return iter(((b, c, d), (a, d, c), (a, b, d), (a, c, b)))


def sides(mesh: Mesh) -> dict[tuple[int, ...], list[tuple[int, tuple[int, int, int]]]]:
    """By the sorted vertices of a face: tets that have it, and how it looks from outside each."""
    found: dict = {}
    for i, tet in enumerate(mesh.tets):
        for face in faces_of(tet):
            found.setdefault(tuple(sorted(face)), []).append((i, face))
    return found


def steep_faces(mesh: Mesh, found: dict) -> int:
    points, count = mesh.points, 0
    sums = [tuple(map(sum, zip(*(points[v] for v in tet), strict=True))) for tet in mesh.tets]
    for both in found.values():
        if len(both) != 2:
            continue
        (i, (u, v, w)), (j, _) = both
        (x, y, z), q, r = points[u], points[v], points[w]
        px, py, pz = q[0] - x, q[1] - y, q[2] - z
        qx, qy, qz = r[0] - x, r[1] - y, r[2] - z
        nx, ny, nz = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
        lx, ly, lz = (there - here for here, there in zip(sums[i], sums[j], strict=True))
        lengths = sqrt((nx * nx + ny * ny + nz * nz) * (lx * lx + ly * ly + lz * lz))
        count += nx * lx + ny * ly + nz * lz < STEEP * lengths
    return count


def surface(mesh: Mesh, found: dict | None = None) -> Surface:
    """What must stay: faces with another label or nothing beyond, as coordinates, and the named
    triangles that are faces of tets."""
    found = found or sides(mesh)
    kept: Surface = Counter()
    for both in found.values():
        labels = {mesh.labels[i] for i, _ in both}
        if len(both) == 2 and len(labels) == 1:
            continue
        for i, face in both:
            corners = [mesh.points[v] for v in face]
            first = corners.index(min(corners))
            kept[(mesh.labels[i], *corners[first:], *corners[:first])] += 1
    for *corners, mark in mesh.sections.get("Triangles", []):
        if tuple(sorted(corners)) in found:
            kept[("named", mark, *sorted(mesh.points[v] for v in corners))] += 1
    return kept


def outside(angles: Sequence[float], low: float, high: float) -> int:
    return sum(angle < low or angle > high for angle in angles)


class Count:
    """Of angles outside two bounds: for certain, and with those at a bound."""

    def __init__(self, low: float, high: float) -> None:
        self.narrow = (low - ROUNDING, high + ROUNDING)
        self.wide = (low + ROUNDING, high - ROUNDING)
        self.certain = self.possible = 0

    def add(self, angles: Sequence[float], least: float, most: float, most_counted: int) -> None:
        if self.wide[0] <= least and most <= self.wide[1]:
            return
        self.certain += min(outside(angles, *self.narrow), most_counted)
        self.possible += min(outside(angles, *self.wide), most_counted)


def measure(mesh: Mesh, goal: tuple[float, float], found: dict | None = None) -> Figures:
    """@param goal  degrees: a tet with an angle outside is bad, and lambda is the share of these
    angles"""
    bad, extreme = Count(*goal), Count(*goal)
    theta_min, theta_max, edge_ratio = 180.0, 0.0, 1.0
    mean_ratios, radius_ratios, not_positive = [], [], 0
    for tet in mesh.tets:
        corners = [mesh.points[v] for v in tet]
        own = tet_figures(corners)
        least, most = min(own.angles), max(own.angles)
        theta_min, theta_max = min(theta_min, least), max(theta_max, most)
        bad.add(own.angles, least, most, 1)
        extreme.add(own.angles, least, most, 6)
        edge_ratio = max(edge_ratio, own.edge_ratio)
        mean_ratios.append(own.mean_ratio)
        radius_ratios.append(own.radius_ratio)
        not_positive += orientation(corners) <= 0
    tets = len(mesh.tets)
    percent = 100 / (6 * tets)
    return Figures(
        tets=tets,
        theta_min=theta_min,
        theta_max=theta_max,
        bad=(bad.certain, bad.possible),
        lambda_percent=(percent * extreme.certain, percent * extreme.possible),
        worst_mean_ratio=min(mean_ratios),
        worst_radius_ratio=min(radius_ratios),
        edge_ratio=edge_ratio,
        mean_mean_ratio=math.fsum(mean_ratios) / tets,
        mean_radius_ratio=math.fsum(radius_ratios) / tets,
        steep_faces=steep_faces(mesh, found or sides(mesh)),
        not_positive=not_positive,
    )
