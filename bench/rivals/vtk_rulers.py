# SPDX-License-Identifier: MIT
"""Prints as JSON what VTK (Verdict) says about each tet of a mesh, as the rulers of tetmend.

    vtk_rulers.py INPUT.vtk
"""

import json
import sys

from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader

# Those at which VTK counts from 1 upwards are the inverses of ours.
MEASURES = {  # ruler: VTK's name, whether it is the inverse
    "mean_ratio": ("AspectFrobenius", True),
    "radius_ratio": ("RadiusRatio", True),
    "condition": ("Condition", False),
    "aspect_ratio": ("AspectRatio", False),
    "edge_ratio": ("EdgeRatio", False),
}
TET = 10  # VTK's number of that kind of cell


def main() -> None:
    reader = vtkUnstructuredGridReader()
    reader.SetFileName(sys.argv[1])
    reader.Update()
    mesh = reader.GetOutput()
    tets = [i for i in range(mesh.GetNumberOfCells()) if mesh.GetCellType(i) == TET]
    values = {}
    for name, (measure, inverse) in MEASURES.items():
        quality = vtkMeshQuality()
        quality.SetInputData(mesh)
        getattr(quality, f"SetTetQualityMeasureTo{measure}")()
        quality.Update()
        array = quality.GetOutput().GetCellData().GetArray("Quality")
        told = [array.GetValue(i) for i in tets]
        values[name] = [1 / value for value in told] if inverse else told
    print(json.dumps({"version": vtkVersion().GetVTKVersion(), "tolerance": 1e-10,
                      "values": values}))


main()
