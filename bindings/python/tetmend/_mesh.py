# SPDX-License-Identifier: MIT
"""A mesh, and files."""

from __future__ import annotations

import errno
import numbers
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tetmend import _core
from tetmend._arrays import Forms, array_of, pack, unpack
from tetmend._html import mesh_as_html

PathLike = str | os.PathLike[str]


class MissingFile(_core.Error, FileNotFoundError):
    """A file or a folder that is not there: an Error, and Python's own FileNotFoundError."""

    def __str__(self) -> str:
        return str(self.args[0])


def missing_file(file: PathLike, reason: str) -> MissingFile:
    error = MissingFile(f"{os.fspath(file)}: {os.strerror(errno.ENOENT)}: {reason}")
    error.errno, error.filename = errno.ENOENT, os.fspath(file)
    return error


@contextmanager
def naming_missing_files(file: PathLike) -> Iterator[None]:
    """An Error of the library that says so becomes a MissingFile."""
    try:
        yield
    except _core.Error as error:
        if os.strerror(errno.ENOENT) not in str(error) or isinstance(error, MissingFile):
            raise
        missing = MissingFile(str(error))
        missing.errno, missing.filename = errno.ENOENT, os.fspath(file)
        raise missing from None


@dataclass(frozen=True, eq=False)
class Group:
    """A named or numbered set of points (dimension 0), edges (1), triangles (2) or tets (3).

    `members` are their numbers. Left out, the group has all elements with the label `number`.
    """

    dimension: int
    number: int = 0
    name: str = ""
    members: ArrayLike | None = None

    def __repr__(self) -> str:
        count = "by label" if self.members is None else f"{np.size(self.members):,} members"
        return f"Group(dimension={self.dimension}, number={self.number}, name={self.name!r}, {count})"


def _array(name: str, values: ArrayLike | None) -> NDArray[Any] | None:
    if values is None:
        return None
    array = array_of(name, values)
    return None if array.size == 0 else array


def _indices(name: str, values: ArrayLike | None, count: int) -> NDArray[Any] | None:
    """Numbers, also of a mask."""
    array = _array(name, values)
    if array is None or array.dtype != bool:
        return array
    if array.shape != (count,):
        raise _core.Error(f"{name} has shape {array.shape}, but a mask of {count} points is wanted")
    return np.flatnonzero(array)


def _sets(groups: Sequence[Group]) -> list[tuple[int, int, str, NDArray[Any] | None]]:
    """As the library takes them."""
    if isinstance(groups, Group):
        raise TypeError("groups is a Group, but a sequence of them is wanted: groups=[group]")
    sets = []
    for i, group in enumerate(groups):
        if not isinstance(group, Group):
            raise TypeError(f"groups[{i}] is of type {type(group).__name__}, but a tetmend.Group is wanted")
        for name, kind in (("dimension", numbers.Integral), ("number", numbers.Integral), ("name", str)):
            value = getattr(group, name)
            if not isinstance(value, kind):
                raise _core.Error(f"groups[{i}].{name} is {value!r}, but {'text' if kind is str else 'an integer'} is wanted")
            if kind is not str and not -(2**31) <= int(value) < 2**31:
                raise _core.Error(f"groups[{i}].{name} is {int(value)}, but an integer of 32 bits is wanted")
        sets.append((int(group.dimension), int(group.number), group.name, _array(f"groups[{i}].members", group.members)))
    return sets


class Mesh:
    """Points, tets and what else belongs to them. It does not change; its arrays are read-only views.

    >>> mesh = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]], cell_data={"heat": [2.5]})
    >>> mesh.points.shape, mesh.tets.tolist(), mesh.cell_data["heat"].tolist()
    ((4, 3), [[0, 1, 2, 3]], [2.5])
    >>> Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 4]])
    Traceback (most recent call last):
    tetmend._core.Error: tets[0, 3] is 4, but there are 4 points, numbered from 0

    Arguments and attributes, for n points and m tets:

    points            (n, 3), real
    tets              (m, 4), integers. Which way round does not matter, if it is the same for all where some are inverted. (m, 10): of second order, corners first, then the nodes of
                      the edges 01, 12, 20, 03, 13, 23, as VTK, meshio and Abaqus have them
    labels            (m,), integers: regions. A face between two labels stays
    parts             (m,), integers, or None: what labels do not tell apart. A face between two parts stays
    triangles, edges  (k, 3) and (k, 2): those of the surface with a name, and constraints inside. They stay
    triangle_labels, edge_labels, point_labels    carried along
    required          numbers of points, or a mask of them: they neither move nor vanish
    point_data, cell_data, triangle_data, edge_data    dicts of named arrays: of points, tets, triangles, edges
    groups            a sequence of Group

    Raises Error, a ValueError, with the place of what is wrong.
    """

    def __init__(self, points: ArrayLike, tets: ArrayLike, *, labels: ArrayLike | None = None,
                 parts: ArrayLike | None = None, triangles: ArrayLike | None = None, triangle_labels: ArrayLike | None = None,
                 edges: ArrayLike | None = None, edge_labels: ArrayLike | None = None,
                 point_labels: ArrayLike | None = None, required: ArrayLike | None = None,
                 point_data: Mapping[str, ArrayLike] | None = None, cell_data: Mapping[str, ArrayLike] | None = None,
                 triangle_data: Mapping[str, ArrayLike] | None = None, edge_data: Mapping[str, ArrayLike] | None = None,
                 groups: Sequence[Group] = ()) -> None:
        point_array, tet_array = array_of("points", points), array_of("tets", tets)
        if tet_array.shape == (0,):  # an empty list has no type of numbers
            tet_array = np.empty((0, 4), np.int32)
        elements = {"triangles": _array("triangles", triangles), "edges": _array("edges", edges)}
        counts = {"point_data": len(point_array) if point_array.ndim else 0, "cell_data": len(tet_array) if tet_array.ndim else 0,
                  **{f"{name[:-1]}_data": 0 if array is None else len(array) for name, array in elements.items()}}
        data = {"point_data": point_data, "cell_data": cell_data, "triangle_data": triangle_data, "edge_data": edge_data}
        packed = {name: pack(name, arrays, counts[name]) for name, arrays in data.items()}
        plain = {"labels": labels, "parts": parts, "triangle_labels": triangle_labels, "edge_labels": edge_labels,
                 "point_labels": point_labels}
        arrays = {**elements, **{name: _array(name, values) for name, values in plain.items()},
                  "required": _indices("required", required, counts["point_data"]),
                  **{name: values for name, (values, _) in packed.items()}}
        self._core = _core.Mesh(point_array, tet_array, arrays, _sets(groups))
        self._forms: dict[str, Forms] = {name: forms for name, (_, forms) in packed.items()}
        self._integer: np.dtype[Any] = tet_array.dtype

    @classmethod
    def _of(cls, core: _core.Mesh, forms: dict[str, Forms] | None = None, integer: np.dtype[Any] | None = None) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._core = core
        mesh._forms = forms or {}
        mesh._integer = integer or np.dtype(np.int32)
        return mesh

    def __setattr__(self, name: str, value: object) -> None:
        if not name.startswith("_"):  # a new array of points would change nothing
            raise AttributeError(f"a Mesh does not change, so it takes no {name!r}: make a new one, tetmend.Mesh(points, tets, ...)")
        super().__setattr__(name, value)

    def __copy__(self) -> Mesh:
        return self  # it does not change

    def __deepcopy__(self, memo: object) -> Mesh:
        return self

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Mesh is not pickled, for what a file says besides the arrays would be lost: "
                        "save() it, or send its arrays and make a new one, tetmend.Mesh(points, tets, ...)")

    def __repr__(self) -> str:
        return f"<tetmend.Mesh: {self._core.point_count:,} points, {self._core.tet_count:,} tets>"

    def _repr_html_(self) -> str:
        return mesh_as_html(self)

    def _integers(self, array: NDArray[Any]) -> NDArray[Any]:
        """Numbers of points, as the type that was given, or int32 where that is too narrow for them."""
        if self._integer == np.uint32:
            return array.view(np.uint32)
        if self._core.point_count - 1 > np.iinfo(self._integer).max:
            return array
        return array if array.dtype == self._integer else array.astype(self._integer)

    @cached_property
    def points(self) -> NDArray[np.float64]:
        """(n, 3)."""
        return self._core.points

    @cached_property
    def tets(self) -> NDArray[Any]:
        """(m, 4), or (m, 10) of second order, of the type of integers that was given; int32 for a mesh from a file."""
        return self._integers(self._core.tets)

    @cached_property
    def triangles(self) -> NDArray[Any]:
        """(k, 3)."""
        return self._integers(self._core.triangles)

    @cached_property
    def edges(self) -> NDArray[Any]:
        """(k, 2)."""
        return self._integers(self._core.edges)

    @cached_property
    def labels(self) -> NDArray[np.int32]:
        """(m,): regions of the tets."""
        return self._core.labels

    @cached_property
    def parts(self) -> NDArray[np.int32]:
        """(m,), or (0,) where there are none."""
        return self._core.parts

    @cached_property
    def triangle_labels(self) -> NDArray[np.int32]:
        """(k,)."""
        return self._core.triangle_labels

    @cached_property
    def edge_labels(self) -> NDArray[np.int32]:
        """(k,)."""
        return self._core.edge_labels

    @cached_property
    def point_labels(self) -> NDArray[np.int32]:
        """(n,), or (0,) where all are 0."""
        return self._core.point_labels

    @cached_property
    def required(self) -> NDArray[Any]:
        """Numbers of the points that neither move nor vanish."""
        return self._integers(self._core.required)

    @cached_property
    def point_data(self) -> dict[str, NDArray[Any]]:
        """Named arrays of the points."""
        return unpack(self._core.point_data, self._forms.get("point_data", {}))

    @cached_property
    def cell_data(self) -> dict[str, NDArray[Any]]:
        """Named arrays of the tets."""
        return unpack(self._core.cell_data, self._forms.get("cell_data", {}))

    @cached_property
    def triangle_data(self) -> dict[str, NDArray[Any]]:
        """Named arrays of the triangles."""
        return unpack(self._core.triangle_data, self._forms.get("triangle_data", {}))

    @cached_property
    def edge_data(self) -> dict[str, NDArray[Any]]:
        """Named arrays of the edges."""
        return unpack(self._core.edge_data, self._forms.get("edge_data", {}))

    @cached_property
    def groups(self) -> list[Group]:
        """Named sets, each with its members."""
        return [Group(*group) for group in self._core.groups]

    @property
    def notes(self) -> list[str]:
        """What of the file it was loaded from is not here, one sentence each."""
        return self._core.notes

    def save(self, file: PathLike, *, threads: int = 1, variant: str = "") -> list[str]:
        """As tetmend.save()."""
        return save(file, self, threads=threads, variant=variant)


def mesh_in(given: Any, call: str) -> Mesh:
    """The mesh of a Result, or a mesh itself."""
    mesh = getattr(given, "mesh", given)
    if not isinstance(mesh, Mesh):
        raise TypeError(f"{call} takes a Mesh, not {type(given).__name__}")
    return mesh


def load(file: PathLike, *, threads: int = 1, label_array: str = "") -> Mesh:
    """Reads a mesh; the format follows from the extension, see formats().

    label_array: the array over cells that holds their labels; empty: the one with a name that mesh tools use.
    Raises Error, ``FILE:LINE: reason``, for a file that cannot be read; of one that is not there it is a FileNotFoundError, too. `Mesh.notes` names what of it is not kept.
    """
    if not isinstance(file, (str, os.PathLike)):
        raise TypeError(f"load() takes the name of a file, not {type(file).__name__}")
    with naming_missing_files(file):
        return Mesh._of(_core.load(os.fspath(file), threads, label_array))


def save(file: PathLike, mesh: Mesh, *, threads: int = 1, variant: str = "") -> list[str]:
    """Writes a mesh, and returns what of it the format cannot hold, one sentence each.

    The file appears when it is complete; a failure leaves an older one as it was. Where the command line writes the same mesh,
    the bytes are the same.
    variant: of a format with several, "2.2 ASCII" of `.msh`; empty: as the mesh was read.
    """
    if not isinstance(file, (str, os.PathLike)):
        raise TypeError(f"save() takes the name of a file and a Mesh, not {type(file).__name__} first")
    core = mesh_in(mesh, "save(file, mesh)")._core
    with naming_missing_files(file):
        return _core.save(os.fspath(file), core, threads, variant)
