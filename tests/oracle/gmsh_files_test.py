# SPDX-License-Identifier: MIT
"""Files of Gmsh go through `tetmend convert` and `improve`, and Gmsh finds in the result what it wrote.

    gmsh_files_test.py SOURCE TETMEND

Two glued boxes with named groups, periodic sides, elements in two groups and a point in one, in each
of the four forms of MSH files. Exit status 77: Gmsh's Python module is not there.
"""

import os
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from with_gmsh import start_with_gmsh

GROUPS = 8
FORMS = [(version, binary) for version in (2.2, 4.1) for binary in (0, 1)]


def build_boxes(gmsh) -> None:
    gmsh.model.add("boxes")
    geometry = gmsh.model.occ
    left, right = geometry.addBox(0, 0, 0, 1, 1, 1), geometry.addBox(1, 0, 0, 1, 1, 1)
    geometry.fragment([(3, left)], [(3, right)])
    geometry.synchronize()

    def side(x: float) -> list[int]:
        found = gmsh.model.getEntitiesInBoundingBox(x - 0.1, -1, -1, x + 0.1, 2, 2, 2)
        return [tag for _, tag in found]

    groups = [(3, [left], 10, "left steel"), (3, [right], 20, "right copper"),
              (3, [left, right], 25, "all"), (2, side(0), 30, "inlet"), (2, side(2), 40, "outlet"),
              (2, side(1), 50, "interface"), (1, [1, 2], 60, "rim"), (0, [1], 7, "corner")]
    for dimension, entities, number, name in groups:
        gmsh.model.addPhysicalGroup(dimension, entities, number)
        gmsh.model.setPhysicalName(dimension, number, name)
    shift = [1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    gmsh.model.mesh.setPeriodic(2, side(2), side(0), shift)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.4)
    gmsh.option.setNumber("Mesh.RandomFactor", 1e-3)
    gmsh.option.setNumber("Mesh.Optimize", 0)  # something is left to do
    gmsh.model.mesh.generate(3)


def contents(gmsh, file: Path) -> dict:
    """All that must survive. Nodes are counted in the order of their numbers."""
    gmsh.model.add(file.name)
    gmsh.merge(str(file))
    model = gmsh.model
    tags, places, _ = model.mesh.getNodes()
    order = sorted(range(len(tags)), key=lambda i: tags[i])
    number = {tags[i]: k for k, i in enumerate(order)}
    result = {
        "groups": {(d, g): (model.getPhysicalName(d, g), list(model.getEntitiesForPhysicalGroup(d, g)))
                   for d, g in model.getPhysicalGroups()},
        "places": [struct.pack("3d", *places[3 * i:3 * i + 3]) for i in order],
        "numbers": sorted(tags), "of entity": {}, "elements": {}, "periodic": {}, "bounds": {},
    }
    for dimension, tag in model.getEntities():
        nodes = model.mesh.getNodes(dimension, tag)[0]
        result["of entity"][dimension, tag] = sorted(number[node] for node in nodes)
        result["bounds"][dimension, tag] = sorted(model.getBoundary([(dimension, tag)]))
        for kind, _, vertices in zip(*model.mesh.getElements(dimension, tag)):
            width = model.mesh.getElementProperties(kind)[3]
            rows = [tuple(number[v] for v in vertices[i:i + width])
                    for i in range(0, len(vertices), width)]
            result["elements"][dimension, tag, kind] = rows
        if dimension == 2:
            master, nodes, originals, affine = model.mesh.getPeriodicNodes(dimension, tag)
            pairs = sorted((number[a], number[b]) for a, b in zip(nodes, originals))
            result["periodic"][tag] = (master, pairs, list(affine))
    return result


def differences(before: dict, after: dict, groups: int) -> list[str]:
    if len(before["groups"]) != groups:
        return [f"Gmsh finds {len(before['groups'])} groups in its own file: expected {groups}"]
    wrong = [key for key in before if key != "numbers" and before[key] != after[key]]
    if list(after["numbers"]) != list(range(1, len(after["numbers"]) + 1)):
        wrong.append("numbers of nodes are not 1 to n")
    return wrong


def by_place(content: dict) -> dict:
    """What improving keeps: groups, and all that is not inside a volume, whatever the numbers."""
    places = content["places"]

    def located(rows) -> list:
        return sorted(tuple(places[v] for v in row) for row in rows)

    return {
        "groups": content["groups"],
        "bounds": content["bounds"],
        "elements": {key: located(rows) for key, rows in content["elements"].items() if key[0] < 3},
        "of entity": {key: sorted(places[v] for v in nodes)
                      for key, nodes in content["of entity"].items() if key[0] < 3},
        "periodic": {tag: (master, located(pairs), affine)
                     for tag, (master, pairs, affine) in content["periodic"].items()},
        "numbers": content["numbers"],
    }


def volumes(content: dict) -> dict[int, float]:
    """Of each volume, from its tets."""
    found = {}
    for (dimension, tag, _), rows in content["elements"].items():
        if dimension < 3:
            continue
        found[tag] = 0.0
        for row in rows:
            a, b, c, d = (struct.unpack("3d", content["places"][v]) for v in row)
            u, v, w = ([x - y for x, y in zip(p, a)] for p in (b, c, d))
            cross = (v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0])
            found[tag] += sum(x * y for x, y in zip(u, cross)) / 6
    return found


def main() -> int:
    start_with_gmsh()
    import gmsh
    tetmend = sys.argv[2]
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        build_boxes(gmsh)
        files = {}
        for save_all in (0, 1):
            gmsh.option.setNumber("Mesh.SaveAll", save_all)
            for version, binary in FORMS:
                gmsh.option.setNumber("Mesh.MshFileVersion", version)
                gmsh.option.setNumber("Mesh.Binary", binary)
                file = Path(folder) / f"boxes-{version}-{binary}-{save_all}.msh"
                gmsh.write(str(file))
                # With all elements Gmsh saves no groups in version 2.2.
                files[file] = 0 if save_all and version < 4 else GROUPS
        for file, groups in files.items():
            converted, again = file.with_suffix(".1.msh"), file.with_suffix(".2.msh")
            for source, target in ((file, converted), (converted, again)):
                subprocess.run([tetmend, "convert", source, target], check=True,
                               stdout=subprocess.DEVNULL)
            wrong = differences(contents(gmsh, file), contents(gmsh, converted), groups)
            if converted.read_bytes() != again.read_bytes():
                wrong.append("the second conversion has other bytes")
            improved = file.with_suffix(".3.msh")
            subprocess.run([tetmend, "improve", file, "-o", improved, "--quiet"], check=True)
            before, after = contents(gmsh, file), contents(gmsh, improved)
            wrong += [f"improved: {what}"
                      for what in differences(by_place(before), by_place(after), groups)]
            if before["elements"] == after["elements"]:
                wrong.append("nothing was improved")
            for tag, size in volumes(before).items():
                if abs(volumes(after).get(tag, 0) - size) > 1e-12:
                    wrong.append(f"improved: the volume of {tag}")
            failures += len(wrong) > 0
            print(f"{file.name}: {'; '.join(wrong) or 'the same'}")
    gmsh.finalize()
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
