# SPDX-License-Identifier: MIT
"""Runs Netgen's volume optimiser and tells how long the optimiser itself took.

    netgen_optimize.py INPUT.mesh OUTPUT.mesh

INPUT names all boundary triangles. Netgen lists a tet's vertices the other way round than MEDIT.
"""

import sys
import time

from netgen.meshing import (
    Element2D,
    Element3D,
    FaceDescriptor,
    Mesh,
    MeshPoint,
    Pnt,
    SetMessageImportance,
)


def section(words: list[str], name: str, width: int) -> list[list[str]]:
    """The rows of a section of a MEDIT file, each without its label."""
    start = words.index(name) + 2
    end = start + width * int(words[start - 1])
    return [words[i : i + width - 1] for i in range(start, end, width)]


def read(file: str) -> Mesh:
    with open(file, encoding="ascii") as stream:
        words = stream.read().split()
    mesh = Mesh()
    points = [
        mesh.Add(MeshPoint(Pnt(float(x), float(y), float(z))))
        for x, y, z in section(words, "Vertices", 4)
    ]
    surface = mesh.Add(FaceDescriptor(surfnr=1, domin=1, bc=1))
    for row in section(words, "Triangles", 4):
        mesh.Add(Element2D(surface, [points[int(v) - 1] for v in row]))
    for a, b, c, d in section(words, "Tetrahedra", 5):
        mesh.Add(Element3D(1, [points[int(v) - 1] for v in (a, b, d, c)]))
    return mesh


def write(file: str, mesh: Mesh) -> None:
    points = [point.p for point in mesh.Points()]
    tets = [[v.nr for v in tet.vertices] for tet in mesh.Elements3D()]
    with open(file, "w", encoding="ascii") as stream:
        stream.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n")
        stream.writelines(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in points)
        stream.write(f"Tetrahedra\n{len(tets)}\n")
        stream.writelines(f"{a} {b} {d} {c} 1\n" for a, b, c, d in tets)
        stream.write("End\n")


def main() -> None:
    source, target = sys.argv[1:]
    SetMessageImportance(0)
    mesh = read(source)
    start = time.perf_counter()
    mesh.OptimizeVolumeMesh()
    print("improving seconds:", time.perf_counter() - start)
    write(target, mesh)


main()
