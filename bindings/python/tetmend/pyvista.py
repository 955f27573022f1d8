# SPDX-License-Identifier: MIT
"""Grids of PyVista: importing this module gives each of them an attribute `tetmend`.

    import pyvista, tetmend.pyvista
    better = pyvista.read("part.vtu").tetmend.improve(threads=4)
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pyvista

from tetmend._cells import Cells, improve_cells
from tetmend._core import Error
from tetmend._mesh import Mesh
from tetmend._quality import Quality, quality

_TETS = (10, 24)  # of first and second order


class Accessor:
    """What `grid.tetmend` is."""

    def __init__(self, grid: pyvista.UnstructuredGrid) -> None:
        self._grid = grid

    def improve(self, *, label_array: str | None = None, **options: Any) -> pyvista.UnstructuredGrid:
        """A better grid; this one stays as it is. As tetmend.vtk.improve(); the Result is not kept."""
        grid = self._grid
        given = Cells(np.asarray(grid.points), np.asarray(grid.cell_connectivity), np.asarray(grid.offset),
                      np.asarray(grid.celltypes), {name: np.asarray(grid.point_data[name]) for name in grid.point_data.keys()},
                      {name: np.asarray(grid.cell_data[name]) for name in grid.cell_data.keys()})
        made, _ = improve_cells(given, label_array, options)
        # Each cell: how many points, then these.
        flat = np.insert(made.connectivity, made.offsets[:-1], np.diff(made.offsets))
        better = type(grid)(flat, made.types, made.points.copy())
        for name, values in made.point_data.items():
            better.point_data[name] = values
        for name, values in made.cell_data.items():
            better.cell_data[name] = values
        for name in grid.field_data.keys():
            better.field_data[name] = grid.field_data[name]
        return better

    def quality(self, **options: Any) -> Quality:
        """Of its tets: as tetmend.quality()."""
        found = [self._grid.cells_dict[kind] for kind in _TETS if kind in self._grid.cells_dict]
        if len(found) != 1:
            raise Error("the grid has tets of first and second order: one of them is measured" if found else "the grid has no tets")
        tets = found[0]
        return quality(Mesh(self._grid.points, tets), **options)


pyvista.UnstructuredGrid.tetmend = property(Accessor, doc="tetmend: improve() and quality().")
