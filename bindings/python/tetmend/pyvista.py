# SPDX-License-Identifier: MIT
"""Grids of PyVista: each of them has an attribute `tetmend`.

    import pyvista, tetmend.pyvista
    better = pyvista.read("part.vtu").tetmend.improve(threads=4)
    better.tetmend.result.after.theta_min

PyVista 0.48 and later finds the module by itself, where tetmend was installed by pip: the import may be left out, and
pyvista.read() takes files that it does not know otherwise (`read`).
"""

from __future__ import annotations

import warnings
import weakref
from typing import Any

import numpy as np
import pyvista

from tetmend._cells import Cells, improve_cells
from tetmend._core import Error
from tetmend._improve import Result
from tetmend._mesh import Mesh, PathLike, load
from tetmend._quality import Quality, quality

_TETS = (10, 24)  # of first and second order
_KINDS = {4: 10, 10: 24}  # by the points of a tet

# Of grids that came from improve(), as long as they live. A grid takes no new attributes and is no key.
_results: dict[int, tuple[weakref.ref[Any], Result]] = {}


def _keep(grid: Any, result: Result) -> None:
    key = id(grid)
    _results[key] = (weakref.ref(grid, lambda _: _results.pop(key, None)), result)


class Accessor:
    """What `grid.tetmend` is."""

    def __init__(self, grid: pyvista.UnstructuredGrid) -> None:
        self._grid = grid

    def improve(self, *, label_array: str | None = None, **options: Any) -> pyvista.UnstructuredGrid:
        """A better grid; this one stays as it is. As tetmend.vtk.improve(); its `tetmend.result` is the Result."""
        grid = self._grid
        given = Cells(np.asarray(grid.points), np.asarray(grid.cell_connectivity), np.asarray(grid.offset),
                      np.asarray(grid.celltypes), {name: np.asarray(grid.point_data[name]) for name in grid.point_data.keys()},
                      {name: np.asarray(grid.cell_data[name]) for name in grid.cell_data.keys()})
        made, result = improve_cells(given, label_array, options)
        # Each cell: how many points, then these.
        flat = np.insert(made.connectivity, made.offsets[:-1], np.diff(made.offsets))
        better = type(grid)(flat, made.types, made.points.copy())
        for name, values in made.point_data.items():
            better.point_data[name] = values
        for name, values in made.cell_data.items():
            better.cell_data[name] = values
        for name in grid.field_data.keys():
            better.field_data[name] = grid.field_data[name]
        _keep(better, result)
        return better

    @property
    def result(self) -> Result | None:
        """Of the run that made this very grid: figures, maps, notes. None for any other grid, also for a copy."""
        kept = _results.get(id(self._grid))
        return kept[1] if kept and kept[0]() is self._grid else None

    def quality(self, **options: Any) -> Quality:
        """Of its tets: as tetmend.quality()."""
        found = [self._grid.cells_dict[kind] for kind in _TETS if kind in self._grid.cells_dict]
        if len(found) != 1:
            raise Error("the grid has tets of first and second order: one of them is measured" if found else "the grid has no tets")
        tets = found[0]
        return quality(Mesh(self._grid.points, tets), **options)


def read(file: PathLike, **options: Any) -> pyvista.UnstructuredGrid:
    """A file of any format that tetmend.load() reads, as a grid of its tets: labels are the cell data `label`, beside the data that the
    file has. What a grid has no place for, such as triangles with names, is told by a warning.
    """
    mesh = load(file, **options)
    tets = np.asarray(mesh.tets, dtype=np.int64)
    width = tets.shape[1]
    grid = pyvista.UnstructuredGrid(np.insert(tets, 0, width, axis=1).ravel(), np.full(len(tets), _KINDS[width], np.uint8), mesh.points.copy())
    grid.cell_data["label"] = mesh.labels.copy()
    for name, values in mesh.cell_data.items():
        grid.cell_data[name] = values.copy()
    for name, values in mesh.point_data.items():
        grid.point_data[name] = values.copy()
    left = {"triangles with labels": len(mesh.triangles), "edges with labels": len(mesh.edges), "named groups": len(mesh.groups)}
    left_out = [f"{count:,} {what} are not in the grid: tetmend.load() has them" for what, count in left.items() if count]
    for note in [*mesh.notes, *left_out]:
        warnings.warn(note, stacklevel=2)
    return grid


_register = getattr(pyvista, "register_dataset_accessor", None)
if _register is not None:  # PyVista 0.48 and later
    _register("tetmend", pyvista.UnstructuredGrid)(Accessor)
else:
    pyvista.UnstructuredGrid.tetmend = property(Accessor, doc="tetmend: improve() and quality().")
