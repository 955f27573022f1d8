# SPDX-License-Identifier: MIT
"""Fills the surface of input.mesh with tets of the lengths in input.sol by Gmsh: the triangles stay, all
vertices inside are its own. Writes output.mesh."""

from pathlib import Path

import gmsh


def lengths_of(file: Path) -> list[float]:
    words = file.read_text().split()
    at = words.index("SolAtVertices")
    return [float(word) for word in words[at + 4:at + 4 + int(words[at + 1])]]


def view_of(lengths: list[float]) -> int:
    """A view of the lengths, linear in the tets of the mesh that is open."""
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    place = {tag: (*xyz[3 * i:3 * i + 3], lengths[i]) for i, tag in enumerate(tags)}
    corners = gmsh.model.mesh.getElementsByType(4)[1]
    data = []
    for first in range(0, len(corners), 4):
        four = [place[tag] for tag in corners[first:first + 4]]
        for row in zip(*four, strict=True):
            data.extend(row)
    view = gmsh.view.add("lengths")
    gmsh.view.addListData(view, "SS", len(corners) // 4, data)
    return view


def keep_surface() -> None:
    """A new model of a volume within the boundary triangles of the mesh that is open."""
    gmsh.model.mesh.createTopology()
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    place = {tag: xyz[3 * i:3 * i + 3] for i, tag in enumerate(tags)}
    corners = gmsh.model.mesh.getElementsByType(2)[1]
    used = sorted(set(corners))
    gmsh.model.add("surface")
    gmsh.model.addDiscreteEntity(2, 1)
    gmsh.model.mesh.addNodes(2, 1, used, [x for tag in used for x in place[tag]])
    gmsh.model.mesh.addElementsByType(1, 2, [], corners)
    gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop([1])])
    gmsh.model.geo.synchronize()


def main() -> None:
    gmsh.initialize()
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.open("input.mesh")
    view = view_of(lengths_of(Path("input.sol")))
    keep_surface()
    field = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(field, "ViewTag", view)
    gmsh.model.mesh.field.setAsBackgroundMesh(field)
    for option in ("ExtendFromBoundary", "FromPoints", "FromCurvature"):
        gmsh.option.setNumber(f"Mesh.MeshSize{option}", 0)
    gmsh.model.mesh.generate(3)
    gmsh.write("output.mesh")
    gmsh.finalize()


if __name__ == "__main__":
    main()
