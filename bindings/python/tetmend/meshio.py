# SPDX-License-Identifier: MIT
"""Meshes of meshio.

    import meshio, tetmend.meshio
    better = tetmend.meshio.improve(meshio.read("part.msh"))
    better.tetmend_result.after.theta_min
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tetmend._blocks import Block, improve_blocks
from tetmend._core import Error
from tetmend._improve import Result

if TYPE_CHECKING:
    import meshio

_DIM_TAGS = "gmsh:dim_tags"
_BOUNDING = "gmsh:bounding_entities"  # among the cell sets, but of signed tags of entities


def _marks(mesh: meshio.Mesh, i: int, names: list[str]) -> NDArray[np.bool_]:
    """A column for each cell set: whether a cell of block i is in it."""
    marks = np.zeros((len(mesh.cells[i].data), len(names)), dtype=bool)
    for k, name in enumerate(names):
        members = mesh.cell_sets[name][i]
        if members is not None and len(members):
            numbers = np.asarray(members, dtype=np.int64)
            for wrong in np.flatnonzero((numbers < 0) | (numbers >= len(marks)))[:1]:
                raise Error(f"cell_sets[{name!r}][{i}][{wrong}] is {numbers[wrong]}, but the block has {len(marks)} cells")
            marks[numbers, k] = True
    return marks


def _with_dim_tags(point_data: dict[str, NDArray[Any]], result: Result,
                   geometrical: NDArray[Any] | None) -> dict[str, NDArray[Any]]:
    """New points are inside a volume, whatever the nearest old one was on."""
    if _DIM_TAGS not in point_data or geometrical is None:
        return point_data
    tags = point_data[_DIM_TAGS].copy()
    is_new = np.ones(len(tags), dtype=bool)
    is_new[result.vertex_map[result.vertex_map >= 0]] = False
    volume = np.zeros(len(tags), dtype=tags.dtype)
    volume[result.tets] = geometrical[:, None]
    tags[is_new] = np.stack([np.full(int(is_new.sum()), 3), volume[is_new]], axis=1)
    return {**point_data, _DIM_TAGS: tags}


def improve(mesh: meshio.Mesh, *, label_array: str | None = None, **options: Any) -> meshio.Mesh:
    """A better mesh with the same blocks of cells; what goes in stays as it is.

    Blocks of tets stay apart, as do regions by `gmsh:physical`, `medit:ref` and the like, and the members of each cell set. Cells of
    other kinds keep their points. point_data, cell_data, cell_sets, point_sets and field_data come over. The Result is the
    attribute `tetmend_result` of the new mesh. For labels in options such as protect="label:3", label_array names the cell
    data they stand in. Tets of second order are improved, too. Raises Error where there are no
    tets, or tets of both orders.
    """
    import meshio as library

    if not isinstance(mesh, library.Mesh):
        raise TypeError(f"improve() takes a mesh of meshio, not {type(mesh).__name__}: meshio.read(file) gives one")
    if mesh.points.shape[1] != 3:
        raise Error(f"points has shape {mesh.points.shape}, but (n, 3) is wanted")
    set_names = [name for name in mesh.cell_sets or {} if name != _BOUNDING]
    blocks = [Block(cells.type, np.asarray(cells.data), {name: np.asarray(values[i]) for name, values in mesh.cell_data.items()},
                    _marks(mesh, i, set_names)) for i, cells in enumerate(mesh.cells)]
    improved = improve_blocks(mesh.points, blocks, mesh.point_data, label_array, options)
    result = improved.result
    cell_sets = {name: [np.flatnonzero(block.marks[:, k]) for block in improved.blocks if block.marks is not None]
                 for k, name in enumerate(set_names)}
    if _BOUNDING in (mesh.cell_sets or {}):
        cell_sets[_BOUNDING] = mesh.cell_sets[_BOUNDING]
    point_sets = {name: result.vertex_map[np.asarray(members, dtype=np.int64)] for name, members in (mesh.point_sets or {}).items()}
    geometrical = result.cell_data.get("gmsh:geometrical")
    better = library.Mesh(
        improved.points.copy(), [(block.kind, block.cells) for block in improved.blocks],
        point_data=_with_dim_tags(improved.point_data, result, geometrical),
        cell_data={name: [block.data[name] for block in improved.blocks] for name in mesh.cell_data},
        field_data=mesh.field_data, cell_sets=cell_sets,
        point_sets={name: members[members >= 0] for name, members in point_sets.items()},
        gmsh_periodic=mesh.gmsh_periodic, info=mesh.info)
    better.tetmend_result = result
    return better
