# SPDX-License-Identifier: MIT
"""Meshes of cells of many kinds, as other programs have them. Tets are improved; all other cells keep their points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tetmend._core import Error, OptionError
from tetmend._improve import Result, improve
from tetmend._options import refuse_own

# Names, in lower case, under which mesh tools store labels; the first that a mesh has is taken, as for files. A border between
# two values of any of them stays.
_LABEL_NAMES = (
    "cellentityids", "label", "labels", "medit:ref", "gmsh:physical", "tetgen:ref", "region", "regionid", "region_id",
    "modelregionid", "material", "materialids", "materialid", "material_id", "mat_id", "matid", "mat", "physicalids", "physical",
    "tag", "tags", "cell_tags", "cell_scalars", "domain", "subdomain", "geometryids", "geometry", "gmsh:geometrical")
_WIDTHS = {"tetra": 4, "tetra10": 10}  # what is improved
_CONSTRAINTS = {"triangle": 3, "triangle6": 3, "line": 2, "line3": 2}  # corners, which come first
_OWN = ("labels", "parts", "triangles", "triangle_labels", "triangle_data", "edges", "edge_labels", "edge_data", "point_labels",
        "required", "point_data", "cell_data", "groups")
_OTHER_TETS = ("tetra11", "tetra20", "tetra35")


@dataclass(frozen=True)
class Block:
    """Cells of one kind, "tetra", "tetra10" or what meshio calls it; `marks` are columns of further borders that stay."""

    kind: str
    cells: NDArray[Any]
    data: dict[str, NDArray[Any]] = field(default_factory=dict)
    marks: NDArray[Any] | None = None


@dataclass(frozen=True)
class Improved:
    """What became of them, in the same order of blocks."""

    result: Result
    points: NDArray[np.float64]
    blocks: list[Block]
    point_data: dict[str, NDArray[Any]]


def _corners(blocks: Sequence[Block], width: int) -> NDArray[Any] | None:
    """Of triangles (3) or edges (2) of either order."""
    found = [block.cells[:, :width] for block in blocks if _CONSTRAINTS.get(block.kind) == width]
    return np.concatenate(found) if found else None


def _data_of(blocks: Sequence[Block], kind: str) -> dict[str, NDArray[Any]]:
    """Arrays that all blocks of the kind have."""
    found = [block for block in blocks if block.kind == kind]
    names = [name for name in found[0].data if all(name in block.data for block in found)] if found else []
    return {name: np.concatenate([block.data[name] for block in found]) for name in names}


def _kind_of_tets(blocks: Sequence[Block]) -> str:
    kinds = {block.kind for block in blocks}
    for kind in kinds.intersection(_OTHER_TETS):
        raise Error(f"cells of kind {kind!r}: tets of first and second order are improved, 'tetra' or 'tetra10'")
    found = kinds.intersection(_WIDTHS)
    if not found:
        raise Error(f"there are no tets, only cells of kinds {sorted(kinds)}")
    if len(found) > 1:
        raise Error("there are cells of kinds 'tetra' and 'tetra10': tets of one order are improved")
    return found.pop()


def _labels_of(data: Mapping[str, NDArray[Any]], label_array: str | None) -> NDArray[Any] | None:
    if label_array is not None:
        if label_array not in data:
            raise Error(f"label_array: the tets have no data {label_array!r}: expected one of {sorted(data)}")
        if data[label_array].dtype.kind not in "iu" or data[label_array].ndim != 1:
            raise Error(f"label_array: the data {label_array!r} of the tets have type {data[label_array].dtype} and shape "
                        f"{data[label_array].shape}, but one integer for each is wanted")
        return data[label_array]
    found = _label_arrays(data)
    return data[min(found, key=lambda name: _LABEL_NAMES.index(name.lower()))] if found else None


def _label_arrays(data: Mapping[str, NDArray[Any]]) -> list[str]:
    return [name for name, values in data.items()
            if name.lower() in _LABEL_NAMES and values.ndim == 1 and values.dtype.kind in "iu"]


def _parts_of(blocks: Sequence[Block], data: Mapping[str, NDArray[Any]]) -> NDArray[np.int64]:
    """One number for each tet; different for those that a block, a label of any tool or a mark tells apart."""
    tets = [(i, block) for i, block in enumerate(blocks) if block.kind in _WIDTHS]
    columns = [np.concatenate([np.full(len(block.cells), i) for i, block in tets])]
    columns += [data[name] for name in _label_arrays(data)]
    if all(block.marks is not None for _, block in tets):
        columns += list(np.concatenate([block.marks for _, block in tets]).T)
    _, parts = np.unique(np.stack([column.astype(np.int64) for column in columns]), axis=1, return_inverse=True)
    return parts.reshape(-1)


def improve_blocks(points: ArrayLike, blocks: Sequence[Block], point_data: Mapping[str, ArrayLike], label_array: str | None,
                   options: Mapping[str, Any]) -> Improved:
    """Triangles and edges become constraints, the points of all other cells are required."""
    refuse_own(options, _OWN, "the mesh")
    tets = _kind_of_tets(blocks)
    if options.get("surface") not in (None, "", "fixed"):
        for block in blocks:
            if block.kind in _CONSTRAINTS and len(block.cells):
                raise OptionError(f"surface: cells of kind {block.kind!r} stay as they are, so it must stay fixed; "
                                  "without them it may move, and of a file they follow: tetmend.load() and improve()")
    data = _data_of(blocks, tets)
    parts = _parts_of(blocks, data)
    others = [block.cells.reshape(-1) for block in blocks if block.kind not in (tets, *_CONSTRAINTS)]
    result = improve(points, np.concatenate([block.cells for block in blocks if block.kind == tets]).reshape(-1, _WIDTHS[tets]),
                     labels=_labels_of(data, label_array), parts=parts,
                     triangles=_corners(blocks, 3), edges=_corners(blocks, 2),
                     required=np.unique(np.concatenate(others)) if others else None,
                     point_data=point_data, cell_data=data, **{**options, "maps": True})
    # A part lies in one block.
    block_of_part = np.zeros(int(parts.max()) + 1, dtype=np.int64)
    block_of_part[parts] = np.concatenate([np.full(len(block.cells), i) for i, block in enumerate(blocks) if block.kind == tets])
    block_of_tet = block_of_part[result.parts]
    marks_of_part = _marks_of_parts(blocks, parts)
    made = []
    for i, block in enumerate(blocks):
        if block.kind == tets:
            here = block_of_tet == i
            carried = {name: values[here].astype(block.data[name].dtype) for name, values in result.cell_data.items()}
            marks = None if marks_of_part is None else marks_of_part[result.parts[here]]
            made.append(Block(block.kind, result.tets[here], carried, marks))
        else:
            made.append(Block(block.kind, result.vertex_map[block.cells].astype(block.cells.dtype), block.data, block.marks))
    return Improved(result, result.points, made, result.point_data)


def _marks_of_parts(blocks: Sequence[Block], parts: NDArray[Any]) -> NDArray[Any] | None:
    tets = [block.marks for block in blocks if block.kind in _WIDTHS]
    if any(marks is None for marks in tets):
        return None
    joined = np.concatenate([marks for marks in tets if marks is not None])
    found = np.zeros((int(parts.max()) + 1, joined.shape[1]), dtype=joined.dtype)
    found[parts] = joined
    return found
