# SPDX-License-Identifier: MIT
"""Meshes as plain lists, read from and written to MEDIT's ASCII format without loss of a bit."""

import random
from dataclasses import dataclass, field
from pathlib import Path

Point = tuple[float, float, float]
Tet = tuple[int, int, int, int]

# Vertex numbers at the begin of each row, all numbers of a row.
SECTIONS = {"Triangles": (3, 4), "Edges": (2, 3), "Corners": (1, 1), "RequiredVertices": (1, 1),
            "Ridges": (0, 1), "RequiredEdges": (0, 1), "RequiredTriangles": (0, 1)}
EVEN = [(0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2), (1, 0, 3, 2), (1, 2, 0, 3), (1, 3, 2, 0),
        (2, 0, 1, 3), (2, 1, 3, 0), (2, 3, 0, 1), (3, 0, 2, 1), (3, 1, 0, 2), (3, 2, 1, 0)]


@dataclass
class Mesh:
    """Vertices are counted from 0, also in the rows of the sections."""

    points: list[Point]
    tets: list[Tet]
    labels: list[int] = field(default_factory=list)  # of the tets
    marks: list[int] = field(default_factory=list)  # of the points
    sections: dict[str, list[tuple[int, ...]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.labels = self.labels or [1] * len(self.tets)
        self.marks = self.marks or [0] * len(self.points)


def read(file: Path, *, leave_out_unknown: bool = False) -> Mesh:
    """@param leave_out_unknown  sections such as Normals; else they are an error"""
    words = file.read_text().split()
    mesh = Mesh([], [])
    at = 0

    def columns(count: int) -> list[list[str]]:
        """Of the section that begins here."""
        nonlocal at
        end = at + 1 + count * int(words[at])
        found = [words[at + 1 + i:end:count] for i in range(count)]
        at = end
        return found

    def vertices(column: list[str]) -> list[int]:
        return [int(word) - 1 for word in column]

    while at < len(words) and words[at] != "End":
        name = words[at]
        at += 1
        if name in ("MeshVersionFormatted", "Dimension"):
            at += 1
        elif name == "Vertices":
            *xyz, marks = columns(4)
            mesh.points = list(zip(*(map(float, column) for column in xyz), strict=True))
            mesh.marks = list(map(int, marks))
        elif name == "Tetrahedra":
            *corners, labels = columns(5)
            mesh.tets = list(zip(*map(vertices, corners), strict=True))
            mesh.labels = list(map(int, labels))
        elif name in SECTIONS:
            corners, size = SECTIONS[name]
            found = columns(size)
            numbers = [*map(vertices, found[:corners]),
                       *(list(map(int, column)) for column in found[corners:])]
            mesh.sections[name] = list(zip(*numbers, strict=True))
        elif leave_out_unknown:
            while at < len(words) and not words[at][0].isalpha():
                at += 1
        else:
            raise ValueError(f"{file}: section {name} is unknown")
    return mesh


def write(file: Path, mesh: Mesh) -> None:
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(mesh.points))]
    lines += [f"{x!r} {y!r} {z!r} {mark}"
              for (x, y, z), mark in zip(mesh.points, mesh.marks, strict=True)]
    lines += ["Tetrahedra", str(len(mesh.tets))]
    lines += [f"{a + 1} {b + 1} {c + 1} {d + 1} {label}"
              for (a, b, c, d), label in zip(mesh.tets, mesh.labels, strict=True)]
    for name, rows in mesh.sections.items():
        corners = SECTIONS[name][0]
        lines += [name, str(len(rows))]
        lines += [" ".join(str(number + (i < corners)) for i, number in enumerate(row))
                  for row in rows]
    file.write_text("\n".join([*lines, "End", ""]))


def renumbered(mesh: Mesh, seed: int) -> Mesh:
    """The same mesh with vertices, tets and the corners of each tet in another order."""
    chance = random.Random(seed)
    old = list(range(len(mesh.points)))  # by the new number
    chance.shuffle(old)
    new = [0] * len(old)
    for i, vertex in enumerate(old):
        new[vertex] = i
    order = list(range(len(mesh.tets)))
    chance.shuffle(order)
    tets = [tuple(new[mesh.tets[tet][i]] for i in chance.choice(EVEN)) for tet in order]
    sections = {
        name: [tuple(new[number] if i < SECTIONS[name][0] else number
                     for i, number in enumerate(row)) for row in rows]
        for name, rows in mesh.sections.items()
    }
    return Mesh([mesh.points[i] for i in old], tets, [mesh.labels[i] for i in order],
                [mesh.marks[i] for i in old], sections)
