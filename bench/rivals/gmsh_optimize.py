# SPDX-License-Identifier: MIT
"""Runs Gmsh's tetrahedral optimiser on one thread and tells how long the optimiser itself took.

    gmsh_optimize.py default|thorough INPUT.mesh OUTPUT.vtk

default   the optimiser as Gmsh runs it after meshing: it works on tets below a quality of 0.3
thorough  quality 0.6, three times, then relocation of vertices
"""

import sys
import time

import gmsh


def optimize(mode: str) -> None:
    mesh = gmsh.model.mesh
    if mode == "thorough":
        gmsh.option.setNumber("Mesh.OptimizeThreshold", 0.6)
        for _ in range(3):
            mesh.optimize("", force=True)
        mesh.optimize("Relocate3D", force=True)
    else:
        mesh.optimize("", force=True)


def main() -> None:
    mode, source, target = sys.argv[1:]
    gmsh.initialize()
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.option.setNumber("General.Verbosity", 2)
    gmsh.option.setNumber("Mesh.Binary", 1)  # of the text formats none keeps all bits
    gmsh.open(source)
    start = time.perf_counter()
    optimize(mode)
    print("improving seconds:", time.perf_counter() - start)
    gmsh.write(target)
    gmsh.finalize()


main()
