# SPDX-License-Identifier: MIT
"""Grids of VTK.

    import tetmend.vtk
    better = tetmend.vtk.improve(reader.GetOutput())
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tetmend._cells import Cells, improve_cells
from tetmend._core import Error

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkUnstructuredGrid


def _arrays_of(attributes: vtkDataSetAttributes, of: str) -> dict[str, NDArray[Any]]:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    arrays = {}
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetAbstractArray(i)
        if not array.IsNumeric():
            raise Error(f"{of} data {array.GetName()!r} are no numbers: they cannot be carried along")
        arrays[array.GetName() or f"array {i}"] = vtk_to_numpy(array)
    return arrays


def _add_arrays(attributes: vtkDataSetAttributes, arrays: dict[str, NDArray[Any]]) -> None:
    from vtkmodules.util.numpy_support import numpy_to_vtk

    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        attributes.AddArray(array)


def improve(grid: vtkUnstructuredGrid, *, label_array: str | None = None, **options: Any) -> vtkUnstructuredGrid:
    """A better grid; what goes in stays as it is.

    Triangles and lines are constraints, cells of other kinds keep their points. Point, cell and field data come over; cells are
    sorted by type. Points are of double precision, for new ones would be moved by rounding. label_array names the cell data
    that tell regions apart; left out, the names that mesh tools use. Tets of second order are
    improved, too. Raises Error where there are no tets, or tets of both orders.
    """
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

    if not isinstance(grid, vtkUnstructuredGrid):
        raise TypeError(f"improve() takes a vtkUnstructuredGrid, not {type(grid).__name__}")
    if grid.GetNumberOfCells() == 0:
        raise Error("the grid has no cells")
    given = Cells(
        vtk_to_numpy(grid.GetPoints().GetData()), vtk_to_numpy(grid.GetCells().GetConnectivityArray()),
        vtk_to_numpy(grid.GetCells().GetOffsetsArray()), vtk_to_numpy(grid.GetCellTypesArray()),
        _arrays_of(grid.GetPointData(), "point"), _arrays_of(grid.GetCellData(), "cell"))
    made, result = improve_cells(given, label_array, options)

    better = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(made.points, deep=True))
    better.SetPoints(points)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(made.offsets, deep=True), numpy_to_vtkIdTypeArray(made.connectivity, deep=True))
    better.SetCells(numpy_to_vtk(made.types, deep=True), cells)
    _add_arrays(better.GetPointData(), dict(made.point_data))
    _add_arrays(better.GetCellData(), dict(made.cell_data))
    better.SetFieldData(grid.GetFieldData())
    better.tetmend_result = result
    return better
