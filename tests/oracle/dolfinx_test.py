# SPDX-License-Identifier: MIT
"""DOLFINx reads a Gmsh file that tetmend has improved, with the same markers of cells and facets.

    dolfinx_test.py TETMEND

Two glued boxes with two named volumes and three named surfaces. The volume of each marker of cells,
and number and area of the facets of each marker, are those of the input. Exit status 77: DOLFINx or
Gmsh's Python module is not there.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77

try:
    import gmsh
    import numpy
    from dolfinx.io import gmshio
    from mpi4py import MPI
except ImportError as error:
    print(f"skipped: install the packages python3-dolfinx and python3-gmsh ({error})")
    sys.exit(SKIPPED)


def write_boxes(file: Path) -> None:
    gmsh.model.add("boxes")
    geometry = gmsh.model.occ
    left, right = geometry.addBox(0, 0, 0, 1, 1, 1), geometry.addBox(1, 0, 0, 1, 1, 1)
    geometry.fragment([(3, left)], [(3, right)])
    geometry.synchronize()

    def side(x: float) -> list[int]:
        found = gmsh.model.getEntitiesInBoundingBox(x - 0.1, -1, -1, x + 0.1, 2, 2, 2)
        return [tag for _, tag in found]

    for dimension, entities, number, name in ((3, [left], 10, "steel"), (3, [right], 20, "copper"),
                                              (2, side(0), 30, "inlet"), (2, side(2), 40, "outlet"),
                                              (2, side(1), 50, "interface")):
        gmsh.model.addPhysicalGroup(dimension, entities, number)
        gmsh.model.setPhysicalName(dimension, number, name)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
    gmsh.option.setNumber("Mesh.RandomFactor", 1e-3)
    gmsh.option.setNumber("Mesh.Optimize", 0)  # something is left to do
    gmsh.model.mesh.generate(3)
    gmsh.write(str(file))


def measure(file: Path) -> dict:
    """For each marker: number and size of cells, number and area of facets."""
    gmsh.clear()
    gmsh.open(str(file))
    mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, MPI.COMM_SELF, 0)
    points = mesh.geometry.x
    topology = mesh.topology
    topology.create_connectivity(2, 0)

    def vertices_of(dimension: int, entity: int):
        return topology.connectivity(dimension, 0).links(entity)

    # A cell of first order lists its points as it lists its vertices.
    place = numpy.zeros(len(points), dtype=int)
    for cell in range(topology.index_map(3).size_local):
        place[vertices_of(3, cell)] = mesh.geometry.dofmap.links(cell)
    found = {"names": sorted(gmsh.model.getPhysicalName(d, g)
                             for d, g in gmsh.model.getPhysicalGroups())}
    for dimension, tags in ((3, cells), (2, facets)):
        corners = place[numpy.array([vertices_of(dimension, i) for i in tags.indices])]
        edges = points[corners[:, 1:]] - points[corners[:, :1]]
        if dimension == 3:
            sizes = numpy.abs(numpy.linalg.det(edges)) / 6
        else:
            sizes = numpy.linalg.norm(numpy.cross(edges[:, 0], edges[:, 1]), axis=1) / 2
        found[dimension] = {int(marker): (int(numpy.sum(tags.values == marker)),
                                          float(numpy.sum(sizes[tags.values == marker])))
                            for marker in numpy.unique(tags.values)}
    return found


def main() -> int:
    wrong = []
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    with tempfile.TemporaryDirectory() as folder:
        file, improved = Path(folder) / "boxes.msh", Path(folder) / "better.msh"
        write_boxes(file)
        subprocess.run([sys.argv[1], "improve", file, "-o", improved, "--quiet"], check=True)
        before, after = measure(file), measure(improved)
    gmsh.finalize()
    if sorted(before[3]) != [10, 20] or sorted(before[2]) != [30, 40, 50]:
        wrong.append(f"DOLFINx finds other markers in Gmsh's own file: {before}")
    if before["names"] != after["names"]:
        wrong.append(f"names: {before['names']} became {after['names']}")
    for dimension in (3, 2):
        if sorted(before[dimension]) != sorted(after[dimension]):
            wrong.append(f"markers of dimension {dimension}: {after[dimension]}")
            continue
        for marker, (count, size) in before[dimension].items():
            count_now, size_now = after[dimension][marker]
            print(f"marker {marker}: {count} of size {size:.9g}, now {count_now} of {size_now:.9g}")
            if abs(size_now - size) > 1e-12:
                wrong.append(f"the size of marker {marker}")
            if dimension == 2 and count_now != count:
                wrong.append(f"the facets of marker {marker}")
    if before[3] == after[3]:
        wrong.append("nothing was improved")
    print("; ".join(wrong) or "the same")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
