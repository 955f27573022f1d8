# SPDX-License-Identifier: MIT
"""Meshes of DOLFINx, with their tags.

    import tetmend.dolfinx
    better = tetmend.dolfinx.improve(mesh, cell_tags, facet_tags)
    better.mesh, better.cell_tags, better.facet_tags, better.result.after.theta_min
"""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tetmend._core import Error, OptionError
from tetmend._improve import Result, improve as improve_arrays
from tetmend._options import refuse_own

if TYPE_CHECKING:
    from dolfinx.mesh import Mesh, MeshTags

_OWN = ("labels", "parts", "triangles", "triangle_labels", "triangle_data", "edges", "edge_labels", "edge_data", "point_labels", "required",
        "point_data", "cell_data", "groups")


@dataclass(frozen=True)
class Improved:
    """A better mesh, tags on it with the values of before, and the figures of both."""

    mesh: Mesh
    cell_tags: MeshTags | None
    facet_tags: MeshTags | None
    result: Result
    """In the order of tetmend: `mesh.geometry.input_global_indices` and `mesh.topology.original_cell_index` are its points and tets."""


def _rows(lists: Any, width: int) -> NDArray[Any]:
    """Of an adjacency list, or of the array that newer versions have in its place."""
    return np.asarray(getattr(lists, "array", lists)).reshape(-1, width)


def _nodes_of_facets(mesh: Mesh) -> NDArray[Any]:
    """The three nodes of the geometry of each facet."""
    topology = mesh.topology
    topology.create_connectivity(2, 0)
    topology.create_connectivity(3, 0)
    vertices = _rows(topology.connectivity(3, 0), 4)
    node_of_vertex = np.zeros(int(vertices.max()) + 1, dtype=np.int64)
    node_of_vertex[vertices] = _rows(mesh.geometry.dofmap, 4)
    return node_of_vertex[_rows(topology.connectivity(2, 0), 3)]


def _created(like: Mesh, points: NDArray[Any], cells: NDArray[Any]) -> Mesh:
    import ufl
    from dolfinx.mesh import create_mesh

    element = like.ufl_domain().ufl_coordinate_element()
    takes = inspect.signature(create_mesh).parameters  # the order of its arguments is that of its version
    shape = {"domain": ufl.Mesh(element)} if "domain" in takes else {"e": ufl.Mesh(element)}
    return create_mesh(like.comm, cells=cells.astype(np.int64), x=points.astype(like.geometry.x.dtype), **shape)


def _check(mesh: Mesh, tags: dict[str, tuple[MeshTags | None, int]], options: dict[str, Any]) -> None:
    refuse_own(options, _OWN, "the mesh")
    if mesh.comm.size > 1:
        raise Error(f"the mesh is spread over {mesh.comm.size} processes, but one of a single process is wanted: improve it before it is "
                    "distributed, or a file with tetmend-mpi")
    cells = mesh.topology.index_map(mesh.topology.dim).size_local
    nodes = np.asarray(getattr(mesh.geometry.dofmap, "array", mesh.geometry.dofmap)).size
    if mesh.topology.dim != 3 or not cells or nodes != 4 * cells:
        raise Error("the mesh has other cells than tets of first order, which are improved")
    for name, (tag, dimension) in tags.items():
        if tag is not None and tag.dim != dimension:
            raise Error(f"{name} are of dimension {tag.dim}, but {dimension} is wanted")
    if tags["facet_tags"][0] is not None and options.get("surface") not in (None, "", "fixed"):
        raise OptionError("surface: facets with tags stay as they are, so it must stay fixed")


def improve(mesh: Mesh, cell_tags: MeshTags | None = None, facet_tags: MeshTags | None = None, **options: Any) -> Improved:
    """A better mesh and its tags, for a mesh of tets of first order in one process; what goes in stays as it is.

    Regions by cell_tags stay apart, and their values are labels for options such as protect="label:3"; cells without a tag have none after.
    Facets with a tag stay, bit for bit, and keep it. Functions on the mesh do not follow: interpolate them, or give them as arrays to
    tetmend.improve(). The new mesh is made by dolfinx.mesh.create_mesh, which numbers its cells and nodes anew.

    Raises Error for other cells, for a mesh of several processes, and for tags of another dimension.
    """
    from dolfinx.mesh import meshtags

    _check(mesh, {"cell_tags": (cell_tags, 3), "facet_tags": (facet_tags, 2)}, options)
    tets = _rows(mesh.geometry.dofmap, 4)
    labels, is_tagged = np.zeros(len(tets), dtype=np.int32), np.zeros(len(tets), dtype=np.int32)
    if cell_tags is not None:
        labels[cell_tags.indices], is_tagged[cell_tags.indices] = cell_tags.values, 1
    facets = None if facet_tags is None else _nodes_of_facets(mesh)[facet_tags.indices]
    result = improve_arrays(mesh.geometry.x, tets, labels=labels, parts=is_tagged, triangles=facets, **{**options, "maps": True})

    better = _created(mesh, result.points, result.tets)
    new_cells = new_facets = None
    if cell_tags is not None:
        order = np.asarray(better.topology.original_cell_index)
        here = np.flatnonzero(result.parts[order] == 1).astype(np.int32)
        new_cells = meshtags(better, 3, here, result.labels[order][here])
    if facet_tags is not None:
        new_facets = meshtags(better, 2, *_found_facets(better, result.vertex_map[facets], facet_tags.values))
    for given, made in ((cell_tags, new_cells), (facet_tags, new_facets)):
        if made is not None and hasattr(given, "name"):
            made.name = given.name
    return Improved(better, new_cells, new_facets, result)


def _found_facets(mesh: Mesh, triangles: NDArray[Any], values: NDArray[Any]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Numbers of the facets with these points, ascending, and their values."""
    nodes = np.sort(np.asarray(mesh.geometry.input_global_indices)[_nodes_of_facets(mesh)], axis=1)
    facet_of = {tuple(row): i for i, row in enumerate(nodes.tolist())}
    facets = np.array([facet_of[tuple(row)] for row in np.sort(triangles, axis=1).tolist()], dtype=np.int32)
    order = np.argsort(facets)
    return facets[order], np.asarray(values)[order].astype(np.int32)
