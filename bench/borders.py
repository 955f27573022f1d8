# SPDX-License-Identifier: MIT
"""How far the surface of a mesh, the borders of its labels and their lines have moved: by samples, with numpy. No line
of the program that is judged has a part in it.

The surface: faces with another label or nothing beyond. Its lines: edges where it bends, branches or ends, or where the
labels beside it change.
"""

import math

import numpy as np

from medit import Mesh

SIDE = 3  # samples along an edge of a triangle
SHARP = 40.0  # degrees by which tetmend's feature edges bend
BENT = 10.0  # by which a line of the result bends at least
EXACT = 1e-11  # of the diagonal: what rounding leaves of a place that stays


def border(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Corners of the faces, and the labels on both sides: -2^31 for none, the smaller first."""
    tets, labels = np.array(mesh.tets), np.array(mesh.labels)
    faces = np.concatenate([tets[:, f] for f in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
    beside = np.tile(labels, 4)
    keys, first, back, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_inverse=True, return_counts=True)
    low, high = np.full(len(keys), 2 ** 31 - 1), np.full(len(keys), -2 ** 31)
    np.minimum.at(low, back.ravel(), beside)
    np.maximum.at(high, back.ravel(), beside)
    low[count == 1] = -2 ** 31
    is_border = low != high
    return faces[first][is_border], np.stack([low, high], axis=1)[is_border]


def mean_edges(mesh: Mesh, surface: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """By triangle."""
    p = np.array(mesh.points)[surface[0]]
    return np.mean([np.linalg.norm(p[:, i] - p[:, j], axis=1) for i, j in ((0, 1), (1, 2), (2, 0))], axis=0)


def lines(mesh: Mesh, surface: tuple[np.ndarray, np.ndarray], degrees: float) -> np.ndarray:
    """Ends of the edges of the surface that bend by more, or where not two triangles of the same labels meet."""
    faces, labels = surface
    points = np.array(mesh.points)
    normals = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    at: dict[tuple[int, int], list[tuple[int, bool]]] = {}
    for number, (a, b, c) in enumerate(faces.tolist()):
        for v, w in ((a, b), (b, c), (c, a)):
            at.setdefault((min(v, w), max(v, w)), []).append((number, v < w))
    kept = []
    for ends, both in at.items():
        if len(both) == 2:
            (i, up), (j, down) = both
            same = (labels[i] == labels[j]).all()
            way = 1 if up != down else -1
            sine = np.linalg.norm(np.cross(normals[i], normals[j]))
            bend = math.degrees(math.atan2(sine, way * float(normals[i] @ normals[j])))
            if same and bend <= degrees:
                continue
        kept.append(ends)
    return points[np.array(kept, dtype=int).reshape(-1, 2)]


def along(segments: np.ndarray) -> np.ndarray:
    """Samples."""
    shares = np.linspace(0, 1, SIDE + 1)[:, None, None]
    return ((1 - shares) * segments[:, 0] + shares * segments[:, 1]).reshape(-1, 3)


def on_triangles(corners: np.ndarray) -> np.ndarray:
    weights = np.array([(i, j, SIDE - i - j) for i in range(SIDE + 1) for j in range(SIDE + 1 - i)]) / SIDE
    return np.einsum("wc,tcx->twx", weights, corners).reshape(-1, 3)


def from_segments(places: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distances of each place from each segment."""
    way = b - a
    share = np.einsum("psx,sx->ps", places[:, None] - a, way) / np.maximum(np.einsum("sx,sx->s", way, way), 1e-300)
    nearest = a + np.clip(share, 0, 1)[..., None] * way
    return np.linalg.norm(places[:, None] - nearest, axis=2)


def from_triangles(places: np.ndarray, corners: np.ndarray) -> np.ndarray:
    a, b, c = corners.transpose(1, 0, 2)
    found = np.minimum(np.minimum(from_segments(places, a, b), from_segments(places, b, c)), from_segments(places, c, a))
    normal = np.cross(b - a, c - a)
    size = np.maximum(np.einsum("tx,tx->t", normal, normal), 1e-300)
    away = places[:, None] - a
    inside = np.ones(found.shape, dtype=bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= np.einsum("ptx,tx->pt", np.cross(q - p, places[:, None] - p), normal) >= 0
    return np.where(inside, np.minimum(found, np.abs(np.einsum("ptx,tx->pt", away, normal)) / np.sqrt(size)), found)


def farthest(places: np.ndarray, distances, shapes: np.ndarray, reach: float) -> float:
    """The largest distance of a place from the nearest of the shapes.

    @param reach  shapes whose boxes are farther are looked at only where none is nearer"""
    if not len(places) or not len(shapes):
        return math.inf if len(places) else 0.0
    low, high, worst = shapes.min(axis=1), shapes.max(axis=1), 0.0
    places = places[np.lexsort(places.T)]
    for begin in range(0, len(places), 64):
        some = places[begin:begin + 64]
        near = np.all((low - reach <= some.max(axis=0)) & (high + reach >= some.min(axis=0)), axis=1)
        found = distances(some, shapes[near]).min(axis=1) if near.any() else np.full(len(some), math.inf)
        lost = found > reach
        if lost.any():
            found[lost] = distances(some[lost], shapes).min(axis=1)
        worst = max(worst, float(found.max()))
    return worst


def moved(before: Mesh, after: Mesh, eps: float) -> list[tuple[str, float, float]]:
    """What, how far it may go, and how far it went: borders of each pair of labels both ways, and lines.

    @param eps  0: flat parts and straight lines alone change"""
    points = np.array(before.points)
    allowed = 1.000001 * eps + EXACT * float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    allowed += 8 * np.finfo(float).eps * float(np.abs(points).max())
    old, new = border(before), border(after)
    found = []
    for pair in np.unique(np.concatenate([old[1], new[1]]), axis=0):
        was, now = (np.array(mesh.points)[faces[(labels == pair).all(axis=1)]]
                    for mesh, (faces, labels) in ((before, old), (after, new)))
        name = "/".join("outside" if label == -2 ** 31 else str(label) for label in pair)
        found.append((f"new border {name} from the old", allowed, farthest(on_triangles(now), from_triangles, was, allowed)))
        found.append((f"old border {name} from the new", allowed, farthest(on_triangles(was), from_triangles, now, allowed)))

    def by_ends(places: np.ndarray, segments: np.ndarray) -> np.ndarray:
        return from_segments(places, segments[:, 0], segments[:, 1])

    sharp = lines(before, old, SHARP)
    found.append(("old lines from the new", allowed, farthest(along(sharp), by_ends, lines(after, new, BENT), allowed)))
    return found


def volume_changes(before: Mesh, after: Mesh, eps: float) -> list[tuple[int, float, float, float]]:
    """Label, volume before and after, and by how much that may change."""
    def volumes(mesh: Mesh) -> dict[int, float]:
        corners = np.array(mesh.points)[np.array(mesh.tets)]
        six = np.linalg.det(corners[:, 1:] - corners[:, :1])
        return {label: math.fsum(six[np.array(mesh.labels) == label]) / 6 for label in set(mesh.labels)}

    faces, labels = border(before)
    points = np.array(before.points)
    p = points[faces]
    areas = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    rounding = 8 * np.finfo(float).eps * float(np.abs(points).max())
    was, now = volumes(before), volumes(after)
    return [(label, volume, now.get(label, 0.0),
             1e-10 * volume + (1.001 * eps + rounding) * float(areas[(labels == label).any(axis=1)].sum()))
            for label, volume in was.items()]
