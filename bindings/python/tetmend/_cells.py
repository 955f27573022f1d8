# SPDX-License-Identifier: MIT
"""Cells as VTK has them: connectivity, offsets and types in one list."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tetmend._blocks import Block, improve_blocks
from tetmend._core import Error
from tetmend._improve import Result

_KINDS = {1: "vertex", 3: "line", 5: "triangle", 10: "tetra", 21: "line3", 22: "triangle6", 24: "tetra10"}
_POLYHEDRON = 42


@dataclass(frozen=True)
class Cells:
    """offsets has one number more than there are cells."""

    points: NDArray[Any]
    connectivity: NDArray[Any]
    offsets: NDArray[Any]
    types: NDArray[Any]
    point_data: Mapping[str, NDArray[Any]]
    cell_data: Mapping[str, NDArray[Any]]


def improve_cells(given: Cells, label_array: str | None, options: Mapping[str, Any]) -> tuple[Cells, Result]:
    """Cells come back sorted by type, in the order in which the types came first."""
    if np.any(given.types == _POLYHEDRON):
        raise Error("polyhedra (VTK type 42) cannot be carried along")
    sizes = np.diff(given.offsets)
    kinds = np.stack([given.types.astype(np.int64), sizes.astype(np.int64)], axis=1)
    rows, first = np.unique(kinds, axis=0, return_index=True)
    blocks = []
    order = rows[np.argsort(first)]
    for cell_type, size in order:
        ids = np.flatnonzero((kinds == (cell_type, size)).all(axis=1))
        cells = given.connectivity[given.offsets[ids][:, None] + np.arange(size)]
        data = {name: values[ids] for name, values in given.cell_data.items()}
        blocks.append(Block(_KINDS.get(int(cell_type), f"type {cell_type}"), cells, data))
    improved = improve_blocks(given.points, blocks, given.point_data, label_array, options)
    counts = [len(block.cells) for block in improved.blocks]
    widths = np.repeat(order[:, 1], counts)
    made = Cells(
        improved.points, np.concatenate([block.cells.reshape(-1).astype(np.int64) for block in improved.blocks]),
        np.concatenate([[0], np.cumsum(widths)]).astype(np.int64), np.repeat(order[:, 0], counts).astype(np.uint8),
        improved.point_data,
        {name: np.concatenate([block.data[name] for block in improved.blocks]) for name in given.cell_data})
    return made, improved.result
