# SPDX-License-Identifier: MIT
"""The mesh in Gmsh's memory.

    import gmsh, tetmend.gmsh
    gmsh.initialize()
    gmsh.open("part.geo")
    gmsh.model.mesh.generate(3)
    tetmend.gmsh.improve()
    gmsh.write("part.msh")
"""

from __future__ import annotations

import numbers
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tetmend._core import Error, OptionError
from tetmend._improve import Result, improve as improve_arrays
from tetmend._options import refuse_own

# Gmsh's numbers of lines, triangles and tets, of first and second order, and of their nodes.
_KINDS = {1: ((1, 2), (2, 3), (4, 4)), 2: ((8, 3), (9, 6), (11, 10))}
_OWN = ("labels", "parts", "triangles", "triangle_labels", "edges", "edge_labels", "required", "groups")
_FROM_GMSH = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # nodes of a tet of second order in tetmend's order, and back


@dataclass(frozen=True)
class _Model:
    """What of the mesh in memory matters. Elements have tags of nodes; triangles and edges those of their corners alone."""

    order: int
    node_tags: NDArray[np.int64]  # ascending
    points: NDArray[np.float64]
    node_dimensions: NDArray[np.int64]
    node_entities: NDArray[np.int64]
    tets: NDArray[np.int64]
    tet_tags: NDArray[np.int64]
    volumes: NDArray[np.int64]  # of the tets
    triangles: NDArray[np.int64]
    edges: NDArray[np.int64]
    next_node: int  # tags that no node or element of the whole model has
    next_element: int

    def index_of(self, tags: NDArray[np.int64]) -> NDArray[np.int64]:
        return np.searchsorted(self.node_tags, tags)


def _integers(values: Any) -> NDArray[np.int64]:
    return np.asarray(values).astype(np.int64)


def _elements(gmsh: Any, entity: int, kind: int, width: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    tags, nodes = gmsh.model.mesh.getElementsByType(kind, entity)
    return _integers(tags), _integers(nodes).reshape(-1, width)


def _order(gmsh: Any, volumes: Sequence[int]) -> int:
    """1 or 2: the same for all volumes."""
    found: dict[int, int] = {}  # order, and a volume of it
    for volume in volumes:
        for kind in gmsh.model.mesh.getElementTypes(3, volume):
            orders = [order for order, kinds in _KINDS.items() if kinds[2][0] == kind]
            if not orders:
                name = gmsh.model.mesh.getElementProperties(kind)[0]
                raise Error(f"volume {volume} has elements '{name}': tets of first and second order are improved in memory; "
                            "name the volumes without them (tags=...), or improve a file")
            found.setdefault(orders[0], volume)
    if len(found) > 1:
        raise Error(f"volume {found[1]} has tets of first order, volume {found[2]} of second: improve one after the other (tags=...)")
    return next(iter(found), 1)


def _sheets(gmsh: Any, dimension: int, order: int) -> NDArray[np.int64]:
    """Corners of all elements of surfaces or curves."""
    kind, width = _KINDS[order][dimension - 1]
    found = [_elements(gmsh, tag, kind, width)[1] for _, tag in gmsh.model.getEntities(dimension)]
    return np.concatenate([np.empty((0, width), np.int64), *found])[:, : dimension + 1]


def _nodes(gmsh: Any) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Tags, points, dimension and tag of the entity that each is on; ascending by tag."""
    tags, points, dimensions, entities = [], [], [], []
    for dimension, entity in gmsh.model.getEntities():
        here, coordinates, _ = gmsh.model.mesh.getNodes(dimension, entity)
        tags.append(_integers(here))
        points.append(np.asarray(coordinates).reshape(-1, 3))
        dimensions.append(np.full(len(here), dimension))
        entities.append(np.full(len(here), entity))
    joined = np.concatenate(tags)
    order = np.argsort(joined, kind="stable")
    return joined[order], np.concatenate(points)[order], np.concatenate(dimensions)[order], np.concatenate(entities)[order]


def _read(gmsh: Any, volumes: Sequence[int]) -> _Model:
    order = _order(gmsh, volumes)
    elements = [_elements(gmsh, volume, *_KINDS[order][2]) for volume in volumes]
    tets = np.concatenate([nodes for _, nodes in elements])
    if len(tets) == 0:
        raise Error(f"there are no tets in volumes {list(volumes)}: generate a mesh first")
    tags, points, dimensions, entities = _nodes(gmsh)
    # Only what belongs to these volumes.
    used = np.zeros(len(tags), dtype=bool)
    used[np.searchsorted(tags, tets)] = True
    kept = tags[used]

    def inside(nodes: NDArray[np.int64]) -> NDArray[np.int64]:
        return nodes[np.isin(nodes, kept).all(axis=1)]

    if order == 2:
        tets = tets[:, _FROM_GMSH]
    return _Model(order, kept, points[used], dimensions[used], entities[used], tets, np.concatenate([tags for tags, _ in elements]),
                  np.concatenate([np.full(len(nodes), volume) for volume, (_, nodes) in zip(volumes, elements)]),
                  inside(_sheets(gmsh, 2, order)), inside(_sheets(gmsh, 1, order)), int(tags.max()) + 1,
                  1 + max(int(_integers(each).max()) for each in gmsh.model.mesh.getElements()[1] if len(each)))


def _write(gmsh: Any, model: _Model, result: Result, volumes: Sequence[int]) -> None:
    """Nodes and elements that are still there keep their tags; new ones get those after the largest."""
    n = len(result.points)
    stays = result.vertex_map >= 0
    tags = np.zeros(n, dtype=np.int64)
    tags[result.vertex_map[stays]] = model.node_tags[stays]
    dimensions, entities = np.full(n, 3), np.zeros(n, dtype=np.int64)
    entities[result.tets] = result.labels[:, None]
    dimensions[result.vertex_map[stays]] = model.node_dimensions[stays]
    entities[result.vertex_map[stays]] = model.node_entities[stays]
    is_new = tags == 0
    tags[is_new] = model.next_node + np.arange(int(is_new.sum()))
    tet_tags = np.zeros(len(result.tets), dtype=np.int64)
    kept = result.tet_map >= 0
    tet_tags[result.tet_map[kept]] = model.tet_tags[kept]
    tet_tags[tet_tags == 0] = model.next_element + np.arange(int((tet_tags == 0).sum()))

    tets = result.tets if model.order == 1 else result.tets[:, _FROM_GMSH]
    mesh = gmsh.model.mesh
    mesh.clear([(3, volume) for volume in volumes])
    for volume in volumes:  # all nodes first: one that two volumes share is on one of them
        here = (dimensions == 3) & (entities == volume)
        mesh.addNodes(3, volume, tags[here], result.points[here].reshape(-1))
    for volume in volumes:
        here = result.labels == volume
        mesh.addElementsByType(volume, _KINDS[model.order][2][0], tet_tags[here], tags[tets[here]].reshape(-1))
    mesh.rebuildNodeCache(False)
    mesh.rebuildElementCache(False)


def _volumes(gmsh: Any, tags: int | str | Sequence[int | str]) -> list[int]:
    """Tags of volumes; a name stands for those of the physical group."""
    known = [tag for _, tag in gmsh.model.getEntities(3)]
    named = {gmsh.model.getPhysicalName(3, group): [int(tag) for tag in gmsh.model.getEntitiesForPhysicalGroup(3, group)]
             for _, group in gmsh.model.getPhysicalGroups(3)}
    volumes: list[int] = []
    wanted = [tags] if isinstance(tags, (numbers.Integral, str)) else tags
    if not isinstance(wanted, (Sequence, np.ndarray)):
        raise TypeError(f"tags is {tags!r}, but the number or the name of a volume is wanted, or a list of them")
    if len(wanted) == 0:
        raise Error("tags is empty: it names no volume")
    for i, tag in enumerate(wanted):
        if tag not in known and tag not in named:
            names = [name for name in named if name]
            raise Error(f"tags[{i}]: there is no volume {tag!r}: expected one of {known + names}")
        volumes += [each for each in (named[tag] if tag in named else [int(tag)]) if each not in volumes]
    return volumes


def improve(tags: int | str | Sequence[int | str] | None = None, **options: Any) -> Result:
    """Improves the tets of the current model in place, and returns the Result.

    tags: the volumes to work on, by number or by the name of a physical group; left out, all that have tets. Nodes on points,
    curves and surfaces stay where they are, as do physical groups, their names and the classification of each node and
    element. Nodes and tets that are still there keep their tags. Tets have the tag of their volume as label:
    protect="label:3" keeps volume 3. Tets of second order are improved, too, and those at a curved surface stay sound.
    Values of views that belong to nodes or elements (post-processing) do not follow.

    Raises Error, and leaves the model as it was, for the option surface, for a volume with other elements than tets of first or second order, and
    for volumes of both.
    """
    import gmsh

    refuse_own(options, _OWN, "the model")
    if options.get("surface") not in (None, "", "fixed"):
        raise OptionError("surface: the elements of the model's surfaces stay as they are, so it must stay fixed; "
                          "of a file it may move, and its elements follow: tetmend.load() and improve()")
    has_elements = [tag for _, tag in gmsh.model.getEntities(3) if len(gmsh.model.mesh.getElementTypes(3, tag))]
    volumes = has_elements if tags is None else _volumes(gmsh, tags)
    if not volumes:
        raise Error("there are no tets in memory: gmsh.initialize(), then open or generate a mesh of tets, gmsh.model.mesh.generate(3)")
    model = _read(gmsh, volumes)
    fixed = model.node_dimensions < 3
    fixed[np.setdiff1d(np.arange(len(fixed)), model.index_of(model.tets[:, :4]))] = False  # edges hold their middle nodes
    result = improve_arrays(model.points, model.index_of(model.tets), labels=model.volumes,
                            triangles=model.index_of(model.triangles), edges=model.index_of(model.edges), required=fixed,
                            **{**options, "maps": True})
    _write(gmsh, model, result, volumes)
    return result
