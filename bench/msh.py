# SPDX-License-Identifier: MIT
"""Meshes with arrays, named groups and periodic links, read from and written to Gmsh's ASCII format of version 2.2
without loss of a bit."""

import re
from dataclasses import dataclass, field
from pathlib import Path

from medit import Mesh

CORNERS = {15: 1, 1: 2, 2: 3, 4: 4}  # by the number of a type: points, edges, triangles, tets
NUMBERS = {corners: number for number, corners in CORNERS.items()}
SECTIONS = {1: "Points", 2: "Edges", 3: "Triangles"}  # of Mesh.sections, by corners; the last number is the label
NO_LIFT = 0.0


@dataclass
class Model:
    """A mesh and what belongs to it. Arrays have one number for each point or tet."""

    mesh: Mesh
    point_data: dict[str, list[float]] = field(default_factory=dict)
    tet_data: dict[str, list[float]] = field(default_factory=dict)
    names: dict[tuple[int, int], str] = field(default_factory=dict)  # of groups, by dimension and label
    twins: list[tuple[int, int]] = field(default_factory=list)  # points of a periodic surface and their masters


def sections(text: str) -> dict[str, list[list[str]]]:
    """Lines of the sections by name; those of one name one after another."""
    found: dict[str, list[list[str]]] = {}
    for name, body in re.findall(r"^\$(\w+)\n(.*?)^\$End\1$", text, re.M | re.S):
        found.setdefault(name, []).append(body.splitlines())
    return found


def data_of(lines: list[str]) -> tuple[str, dict[int, float]]:
    """Name and values by number of a section of an array."""
    at, tags = 0, []
    for _ in range(3):
        count = int(lines[at])
        tags.append(lines[at + 1:at + 1 + count])
        at += 1 + count
    rows = [line.split() for line in lines[at:]]
    return tags[0][0].strip('"'), {int(number): float(value) for number, value in rows}


def read(file: Path) -> Model:
    """@throws ValueError for an element of another kind"""
    found = sections(file.read_text())
    nodes = [line.split() for line in found["Nodes"][0][1:]]
    point_of = {int(number): i for i, (number, *_) in enumerate(nodes)}
    model = Model(Mesh([tuple(map(float, xyz)) for _, *xyz in nodes], []))
    mesh, tet_of = model.mesh, {}
    mesh.labels = []
    for line in found["Elements"][0][1:]:
        number, kind, tags, label, *rest = map(int, line.split())
        if kind not in CORNERS:
            raise ValueError(f"{file}: an element of type {kind}")
        corners = tuple(point_of[v] for v in rest[tags - 1:])
        if kind == NUMBERS[4]:
            tet_of[number] = len(mesh.tets)
            mesh.tets.append(corners)
            mesh.labels.append(label)
        else:
            mesh.sections.setdefault(SECTIONS[len(corners)], []).append((*corners, label))
    for lines in found.get("PhysicalNames", []):
        for line in lines[1:]:
            dimension, label, name = line.split(maxsplit=2)
            model.names[int(dimension), int(label)] = name.strip('"')
    for section, numbers, arrays in (("NodeData", point_of, model.point_data), ("ElementData", tet_of, model.tet_data)):
        for lines in found.get(section, []):
            name, values = data_of(lines)
            arrays[name] = [values.get(number, NO_LIFT) for number in numbers]
    for lines in found.get("Periodic", []):
        pairs = [line.split() for line in lines]
        model.twins += [(point_of[int(a)], point_of[int(b)]) for a, b in (pair for pair in pairs if len(pair) == 2)]
    return model


def write(file: Path, model: Model) -> None:
    mesh = model.mesh
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    if model.names:
        lines += ["$PhysicalNames", str(len(model.names))]
        lines += [f'{dimension} {label} "{name}"' for (dimension, label), name in model.names.items()]
        lines += ["$EndPhysicalNames"]
    lines += ["$Nodes", str(len(mesh.points))]
    lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(mesh.points, 1)]
    elements = [row for name in SECTIONS.values() for row in mesh.sections.get(name, [])]
    elements += [(*tet, label) for tet, label in zip(mesh.tets, mesh.labels, strict=True)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{i} {NUMBERS[len(corners)]} 2 {label} {label} " + " ".join(str(v + 1) for v in corners)
              for i, (*corners, label) in enumerate(elements, 1)]
    lines += ["$EndElements"]
    if model.twins:  # one link of two surfaces
        lines += ["$Periodic", "1", "2 1 2", str(len(model.twins)), *(f"{a + 1} {b + 1}" for a, b in model.twins), "$EndPeriodic"]
    first_tet = len(elements) - len(mesh.tets) + 1
    for section, first, arrays in (("NodeData", 1, model.point_data), ("ElementData", first_tet, model.tet_data)):
        for name, values in arrays.items():
            lines += [f"${section}", "1", f'"{name}"', "1", "0.0", "3", "0", "1", str(len(values))]
            lines += [f"{first + i} {value!r}" for i, value in enumerate(values)]
            lines += [f"$End{section}"]
    file.write_text("\n".join([*lines, ""]))
