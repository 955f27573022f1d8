# SPDX-License-Identifier: MIT
"""Wanted lengths and how edges keep to them, after docs/sizes.md, with numpy: no line of the program that is judged
has a part in them."""

import heapq
import math
from dataclasses import dataclass

import numpy as np

from medit import Mesh, Point

LEAST, MOST = math.sqrt(0.5), math.sqrt(2)
ROUNDING = 1e-6  # of a relative length: so near to a bound, an edge counts as what is better for the program
BESIDE = 0.2  # the same where an end lies beside all tets of the field
EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]


def edges_of(tets: np.ndarray) -> np.ndarray:
    """Each once, the smaller end first."""
    pairs = np.sort(np.concatenate([tets[:, ends] for ends in EDGES]), axis=1)
    return np.unique(pairs, axis=0)


def present(mesh: Mesh) -> np.ndarray:
    """The mean edge at each point; an edge counts once for each of its tets."""
    points, tets = np.array(mesh.points), np.array(mesh.tets)
    sums, counts = np.zeros(len(points)), np.zeros(len(points))
    for ends in EDGES:
        a, b = tets[:, ends].T
        length = np.linalg.norm(points[a] - points[b], axis=1)
        for end in (a, b):
            np.add.at(sums, end, length)
            np.add.at(counts, end, 1)
    return sums / np.maximum(counts, 1)


def graded(mesh: Mesh, lengths: np.ndarray, gradation: float) -> np.ndarray:
    """Lowered until they grow by no more than that less 1 times the distance along edges; 0: as they are."""
    if gradation == 0:
        return lengths
    points, found = np.array(mesh.points), [float(length) for length in lengths]
    around: list[list[tuple[int, float]]] = [[] for _ in found]
    for a, b in edges_of(np.array(mesh.tets)).tolist():
        most = (gradation - 1) * float(np.linalg.norm(points[a] - points[b]))
        around[a].append((b, most))
        around[b].append((a, most))
    queue = [(length, v) for v, length in enumerate(found) if around[v]]
    heapq.heapify(queue)
    while queue:
        length, v = heapq.heappop(queue)
        if length > found[v]:
            continue
        for w, most in around[v]:
            if length + most < found[w]:
                found[w] = length + most
                heapq.heappush(queue, (found[w], w))
    return np.array(found)


class Field:
    """Numbers at the points of a mesh, linear in its tets."""

    CHUNK = 128  # places at a time

    def __init__(self, mesh: Mesh, values: np.ndarray) -> None:
        points, self.tets, self.values = np.array(mesh.points), np.array(mesh.tets), np.asarray(values, dtype=float)
        corners = points[self.tets]
        self.origin = corners[:, 0]
        sides = corners[:, 1:] - corners[:, :1]
        flat = np.abs(np.linalg.det(sides)) == 0
        sides[flat] = np.eye(3)
        self.inverse = np.linalg.inv(sides)
        self.inverse[flat] = np.nan
        self.low, self.high = corners.min(axis=1), corners.max(axis=1)
        self.known = {tuple(point): i for i, point in enumerate(mesh.points)}
        self.margin = 1e-9 * float(np.max(points.max(axis=0) - points.min(axis=0)))

    def at(self, places: list[Point]) -> tuple[np.ndarray, np.ndarray]:
        """Values there, and which places are in no tet: they have a value of one of the nearest tets."""
        found, beside = np.zeros(len(places)), np.zeros(len(places), dtype=bool)
        unknown = []
        for i, place in enumerate(places):
            number = self.known.get(tuple(place))
            if number is None:
                unknown.append(i)
            else:
                found[i] = self.values[number]
        unknown.sort(key=lambda i: places[i])
        for begin in range(0, len(unknown), self.CHUNK):
            some = np.array(unknown[begin:begin + self.CHUNK])
            found[some], beside[some] = self._at(np.array([places[i] for i in some]))
        return found, beside

    def _at(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        near = np.all((self.low - self.margin <= places.max(axis=0)) & (self.high + self.margin >= places.min(axis=0)), axis=1)
        values, least = self._among(places, np.flatnonzero(near))
        lost = least < -ROUNDING
        if lost.any():
            values[lost], least[lost] = self._among(places[lost], np.arange(len(self.tets)))
        return values, least < -ROUNDING

    def _among(self, places: np.ndarray, tets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values, and the least weight of a corner: below 0 outside."""
        if not len(tets):
            return np.zeros(len(places)), np.full(len(places), -np.inf)
        weights = np.einsum("tij,ptj->pti", self.inverse[tets].transpose(0, 2, 1), places[:, None] - self.origin[tets])
        all_four = np.concatenate([1 - weights.sum(axis=2, keepdims=True), weights], axis=2)
        least = np.nan_to_num(all_four.min(axis=2), nan=-np.inf)
        best = least.argmax(axis=1)
        rows = np.arange(len(places))
        corners = self.values[self.tets[tets[best]]]
        values = np.einsum("pi,pi->p", all_four[rows, best], corners)
        return np.clip(values, corners.min(axis=1), corners.max(axis=1)), least[rows, best]


@dataclass(frozen=True)
class Share:
    """Of edges in range: for certain, and with those at a bound."""

    certain: float
    possible: float
    edges: int

    def off(self) -> int:
        """Edges out of range."""
        return round((1 - self.certain) * self.edges)

    def holds(self, share: float) -> bool:
        return self.certain - 1e-12 <= share <= self.possible + 1e-12


def share_in_range(mesh: Mesh, wanted: Field | float) -> Share:
    points, edges = np.array(mesh.points), edges_of(np.array(mesh.tets))
    if isinstance(wanted, Field):
        at, beside = wanted.at(mesh.points)
    else:
        at, beside = np.full(len(points), wanted), np.zeros(len(points), dtype=bool)
    a, b = edges.T
    ratio = at[b] / at[a]
    near = np.abs(ratio - 1) < 1e-4
    mean = np.where(near, (at[a] + at[b]) / 2, (at[b] - at[a]) / np.log(np.where(near, 2, ratio)))
    relative = np.linalg.norm(points[a] - points[b], axis=1) / mean
    doubt = np.where(beside[a] | beside[b], BESIDE, ROUNDING)

    def share(scale: float) -> float:
        margin = scale * doubt
        return float(np.mean((relative >= LEAST * (1 - margin)) & (relative <= MOST * (1 + margin))))

    return Share(share(-1), share(1), len(edges))
