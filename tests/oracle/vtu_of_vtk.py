# SPDX-License-Identifier: MIT
"""VTK writes a mesh with data as .vtu in all encodings; tetmend reads each and writes it again; VTK
reads that and finds the same points, cells and arrays.

    vtu_of_vtk.py PROGRAM     status 77: VTK is not installed
"""

import itertools
import random
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    from vtkmodules.vtkCommonCore import (vtkDoubleArray, vtkFloatArray, vtkIntArray, vtkPoints,
                                          vtkTypeInt64Array, vtkUnsignedCharArray)
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter
except ImportError:
    print("skipped: Debian's python3-vtk9 is not installed")
    sys.exit(77)

CELLS = 5
SIX_TETS = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]


def lattice() -> vtkUnstructuredGrid:
    grid, points, noise = vtkUnstructuredGrid(), vtkPoints(), random.Random(1)
    points.SetDataTypeToDouble()
    corners = list(itertools.product(range(CELLS + 1), repeat=3))
    number = {corner: i for i, corner in enumerate(corners)}
    for corner in corners:
        points.InsertNextPoint(*(x + 0.1 * noise.random() for x in corner))
    grid.SetPoints(points)
    for x, y, z in itertools.product(range(CELLS), repeat=3):
        cube = [number[x + a, y + b, z + c] for c, b, a in itertools.product((0, 1), repeat=3)]
        for tet in SIX_TETS:
            grid.InsertNextCell(VTK_TETRA, 4, [cube[k] for k in tet])
    add(grid.GetCellData(), vtkIntArray(), "mat_id", 1, grid.GetNumberOfCells(),
        lambda row, k: 1 + row % 3)
    add(grid.GetCellData(), vtkDoubleArray(), "k & <x>", 1, grid.GetNumberOfCells(),
        lambda row, k: row / 7)
    add(grid.GetCellData(), vtkFloatArray(), "v", 3, grid.GetNumberOfCells(),
        lambda row, k: row * k)
    add(grid.GetPointData(), vtkDoubleArray(), "T", 1, len(corners), lambda row, k: 1.1 * row)
    add(grid.GetPointData(), vtkTypeInt64Array(), "ids", 1, len(corners),
        lambda row, k: row + 5_000_000_000)
    add(grid.GetPointData(), vtkUnsignedCharArray(), "bytes", 1, len(corners),
        lambda row, k: row % 256)
    return grid


def add(data, array, name, components, rows, value) -> None:
    array.SetName(name)
    array.SetNumberOfComponents(components)
    array.SetNumberOfTuples(rows)
    for row, k in itertools.product(range(rows), range(components)):
        array.SetComponent(row, k, value(row, k))
    data.AddArray(array)


def content(grid) -> dict:
    found = {"points": [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]}
    cells = (grid.GetCell(i) for i in range(grid.GetNumberOfCells()))
    found["cells"] = [(cell.GetCellType(), [cell.GetPointId(k) for k in range(4)])
                      for cell in cells]
    for kind, data in (("cell", grid.GetCellData()), ("point", grid.GetPointData())):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            found[kind, array.GetName()] = [array.GetTuple(row)
                                            for row in range(array.GetNumberOfTuples())]
    return found


def write(grid, file: Path, mode: str, packed: bool, wide: bool, encoded: bool) -> None:
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(file))
    getattr(writer, f"SetDataModeTo{mode}")()
    writer.SetEncodeAppendedData(encoded)
    if packed:
        writer.SetCompressorTypeToZLib()
        writer.SetBlockSize(1024)
    else:
        writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
    if writer.Write() != 1:
        raise SystemExit("VTK could not write")


def main(program: str) -> int:
    grid = lattice()
    wanted = content(grid)
    encodings = [("Ascii", False), ("Binary", False), ("Appended", False), ("Appended", True)]
    failures = 0
    with tempfile.TemporaryDirectory() as name:
        theirs, ours = Path(name) / "theirs.vtu", Path(name) / "ours.vtu"
        for (mode, encoded), packed, wide in itertools.product(encodings, (False, True),
                                                               (False, True)):
            write(grid, theirs, mode, packed, wide, encoded)
            run = subprocess.run([program, "convert", theirs, ours], capture_output=True, text=True,
                                 check=False)
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(ours))
            reader.Update()
            found = content(reader.GetOutput())
            differing = [key for key in wanted if wanted[key] != found.get(key)]
            if run.returncode != 0 or run.stderr or differing:
                failures += 1
                print(f"{mode}, packed {packed}, wide {wide}, base64 {encoded}: "
                      f"status {run.returncode} {run.stderr.strip()} differing: {differing}")
    print(f"{failures} of 16 encodings differ")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
