# SPDX-License-Identifier: MIT
"""The figures of a mesh."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from tetmend import _core
from tetmend._figures import Statistics
from tetmend._html import quality_as_html
from tetmend._mesh import Mesh, mesh_in
from tetmend._options import to_settings


@dataclass(frozen=True)
class BadTet:
    """A tet that misses the goal of 30 and 150 degrees."""

    tet: int
    number: int
    """What its file calls it."""
    label: int
    centre: tuple[float, float, float]
    theta_min: float
    theta_max: float
    quality: float
    """Minimum sine; below 0: inverted."""
    free_vertices: int
    reason: str
    """Why it is there: 'frozen', 'surface', 'constraint', 'no_free_vertex', 'search'."""


@dataclass(frozen=True, repr=False)
class Quality:
    """What quality() found."""

    statistics: Statistics
    measures: dict[str, dict[str, float]]
    """Worst and mean value of each measure that was asked for."""
    limit: dict[str, Any] | None
    """What no mesh of this surface can beat."""
    bad_tets: list[BadTet]
    """The worst first."""
    build: dict[str, Any]
    """What is peculiar about the mesh."""
    notes: list[str]
    """Where points touch without being joined."""

    def __repr__(self) -> str:
        figures = self.statistics
        return f"<tetmend.Quality: {figures.tets:,} tets, {figures.n_bad:,} bad, angles {figures.theta_min:.4g} to {figures.theta_max:.4g}>"

    def _repr_html_(self) -> str:
        return quality_as_html(self)


def quality(mesh: Mesh | ArrayLike, tets: ArrayLike | None = None, *, labels: ArrayLike | None = None,
            measures: str | Sequence[str] = (), goal: float | tuple[float, float] | str | None = None, rulers: bool = True, limit: bool = False, bad_tets: bool = False,
            threads: int = 1) -> Quality:
    """Measures a Mesh or that of a Result, or quality(points, tets).

    measures: names of further measures, see `tetmend quality --help`. goal: a tet that misses it is bad, as of improve(). limit: prove what the surface allows. bad_tets: list them,
    with reasons. Raises Error for a mesh without tets or of broken topology.

    >>> found = quality([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]], bad_tets=True)
    >>> round(found.statistics.theta_min, 4), found.statistics.n_bad, found.bad_tets
    (54.7356, 0, [])
    """
    if tets is None and isinstance(mesh, (str, os.PathLike)):
        raise TypeError(f"quality() takes points and tets, or a Mesh: tetmend.load({os.fspath(mesh)!r}) gives one")
    if tets is None:
        mesh = mesh_in(mesh, "quality()")
    if not isinstance(mesh, Mesh):
        mesh = Mesh(mesh, tets, labels=labels)
    elif tets is not None or labels is not None:
        raise TypeError("a Mesh has its own tets and labels")
    names = [measures] if isinstance(measures, str) else list(measures)
    try:
        figures = _core.measure(mesh._core, names, rulers, limit, bad_tets, to_settings({"goal": goal}), threads)
    except _core.OptionError as error:
        raise _core.OptionError(str(error).replace("measure:", "measures:", 1)) from None
    return Quality(Statistics(figures["statistics"]), figures["measures"], figures["limit"],
                   [BadTet(**{**each, "centre": tuple(each["centre"])}) for each in figures["bad_tets"]], figures["build"],
                   figures["notes"])
