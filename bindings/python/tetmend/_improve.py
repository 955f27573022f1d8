# SPDX-License-Identifier: MIT
"""The one verb: a mesh goes in, a better one comes out."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tetmend import _core
from tetmend._core import Progress
from tetmend._figures import Pass, Statistics, to_json
from tetmend._html import table_of
from tetmend._mesh import Group, Mesh, PathLike
from tetmend._options import to_settings

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from tetmend._options import Options


@dataclass(frozen=True, eq=False, repr=False)
class Result:
    """An improved mesh, what became of the old one, and the figures of both.

    The arrays are those of `mesh`: contiguous and read-only. Take `result.points.copy()` to change them.
    """

    mesh: Mesh
    vertex_map: NDArray[np.int32]
    """By the old number of a point its new one, -1 if it is gone. Those that stay come first, in their old order."""
    tet_map: NDArray[np.int32]
    """The same for tets. One is the same as long as its four vertices stay together, though they may move."""
    before: Statistics
    after: Statistics
    goal: tuple[float, float]
    """Degrees: what the run worked towards."""
    ending: str
    """'finished', 'time_limit' or 'cancelled': the progress function returned False."""
    passes: list[Pass]
    notes: list[str]
    """What the schedule said, what was kept, what holds the bad tets that are left."""
    worse_than_before: list[str]
    """All figures that are worse, in words, as the report has them: the promised ones first, which are worse only where inverted
    tets were mended, then `missed_aims`."""
    missed_aims: list[str]
    """Those of them that are aims and no promises: means, and non-orthogonal faces."""
    touched_tets: int
    """New tets, and those with a vertex that moved."""
    volume_change: float
    """|after - before| / |before|: rounding."""
    seconds: dict[str, float]
    figures: dict[str, Any]
    """All that the run found, with the names of the command line's report: build, data, limit, protected, layers, ..."""

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 3)."""
        return self.mesh.points

    @property
    def tets(self) -> NDArray[Any]:
        """(m, 4), or (m, 10) of second order, of the type of integers that was given, or int32 where that is too narrow."""
        return self.mesh.tets

    @property
    def labels(self) -> NDArray[np.int32]:
        """(m,): regions."""
        return self.mesh.labels

    @property
    def parts(self) -> NDArray[np.int32]:
        """(m,), or (0,) where none were given."""
        return self.mesh.parts

    @property
    def triangles(self) -> NDArray[Any]:
        """(k, 3)."""
        return self.mesh.triangles

    @property
    def triangle_labels(self) -> NDArray[np.int32]:
        """(k,)."""
        return self.mesh.triangle_labels

    @property
    def edges(self) -> NDArray[Any]:
        """(k, 2)."""
        return self.mesh.edges

    @property
    def edge_labels(self) -> NDArray[np.int32]:
        """(k,)."""
        return self.mesh.edge_labels

    @property
    def point_labels(self) -> NDArray[np.int32]:
        """(n,), or (0,) where all are 0."""
        return self.mesh.point_labels

    @property
    def required(self) -> NDArray[Any]:
        """New numbers of the points that had to stay."""
        return self.mesh.required

    @property
    def point_data(self) -> dict[str, NDArray[Any]]:
        """Carried over linearly in the old mesh; integers from the nearest vertex."""
        return self.mesh.point_data

    @property
    def cell_data(self) -> dict[str, NDArray[Any]]:
        """Carried over from the old tet at the centroid, or see the option `conserve`."""
        return self.mesh.cell_data

    @property
    def triangle_data(self) -> dict[str, NDArray[Any]]:
        """As given."""
        return self.mesh.triangle_data

    @property
    def edge_data(self) -> dict[str, NDArray[Any]]:
        """As given."""
        return self.mesh.edge_data

    @property
    def groups(self) -> list[Group]:
        """With their members in the new mesh."""
        return self.mesh.groups

    @cached_property
    def report(self) -> dict[str, Any]:
        """All figures as JSON can express them, under the names of the command line's `--report`."""
        wanted = {"schedule", "settings", "measure", "threads", "size_drift", "notes", "data", "build", "protected", "layers",
                  "limit", "curved_edges", "straightened_edges", "not_positive_tets", "volume_change", "seconds", "passes", "worse_than_before", "missed_aims"}
        fingerprints = [f"{self.figures[name]:016x}" for name in ("surface_fingerprint_before", "surface_fingerprint")]
        report = {name: value for name, value in self.figures.items() if name in wanted}
        return to_json({
            "tetmend": _core.__version__, **report, "before": self.before, "after": self.after,
            "goal": {"min_angle": self.goal[0], "max_angle": self.goal[1]},
            "interrupted": self.ending == "cancelled", "out_of_time": self.ending == "time_limit",
            "surface": {"unchanged": fingerprints[0] == fingerprints[1], "fingerprint_before": fingerprints[0],
                        "fingerprint_after": fingerprints[1], **(self.figures["surface_change"] or {})},
            "touched_share": self.touched_tets / max(self.after.tets, 1),
            "tets_per_second": self.before.tets / max(self.seconds["improving"], 1e-9)})

    def save(self, file: PathLike, *, threads: int = 1, variant: str = "") -> list[str]:
        """As tetmend.save()."""
        return self.mesh.save(file, threads=threads, variant=variant)

    def __repr__(self) -> str:
        return (f"<tetmend.Result: {self.ending}, bad tets {self.before.n_bad:,} -> {self.after.n_bad:,}, "
                f"theta_min {self.before.theta_min:.4g} -> {self.after.theta_min:.4g}>")

    def _repr_html_(self) -> str:
        return table_of(self)


def _notes_of(build: Mapping[str, Any]) -> list[str]:
    """Constraints that constrain nothing."""
    loose = {"triangles": (build["loose_triangles"], "a face"), "edges": (build["loose_edges"], "an edge")}
    return [f"{count:,} of the {name} given: not {what} of any tet, kept as they are" for name, (count, what) in loose.items() if count]


def _check_function(name: str, given: object) -> None:
    if given is not None and not callable(given):
        raise TypeError(f"{name} is of type {type(given).__name__}, but a function is wanted")


def improve(points: ArrayLike | Mesh | Result, tets: ArrayLike | str | None = None, *, labels: ArrayLike | None = None,
            parts: ArrayLike | None = None, triangles: ArrayLike | None = None, triangle_labels: ArrayLike | None = None,
            edges: ArrayLike | None = None, edge_labels: ArrayLike | None = None,
            point_labels: ArrayLike | None = None, required: ArrayLike | None = None,
            point_data: Mapping[str, ArrayLike] | None = None, cell_data: Mapping[str, ArrayLike] | None = None,
            triangle_data: Mapping[str, ArrayLike] | None = None, edge_data: Mapping[str, ArrayLike] | None = None,
            groups: Sequence[Group] | None = None, progress: Callable[[Progress], object] | None = None,
            note: Callable[[str], object] | None = None, maps: bool = True, rulers: bool = True,
            **options: Unpack[Options]) -> Result:
    """Improves a mesh. What goes in stays as it is.

    improve(points, tets, ...) takes arrays; help(tetmend.Mesh) has their shapes, and what labels, triangles, required and the
    others mean. improve(mesh, ...) takes a Mesh, or that of a Result. With a Mesh, `tets` is the option of
    that name: how far the mesh may grow, "10%" or "500000".

    progress      a function, called several times a second with a Progress, by any thread; the run stops if it returns False
    note          a function, called with what the schedule has to say
    maps, rulers  False saves their time and memory

    The other options have the names of the command line: schedule="shell", goal=(30, 150), threads=1, time_limit=None,
    trace="run.trace", set={"max_rounds": 2}, protect=["label:3"], ...; help(tetmend.Options) lists them.

    Other threads of Python run meanwhile. Ctrl-C stops the run soon; KeyboardInterrupt is raised then.

    Raises Error, a ValueError, for what is wrong with the mesh, with its place, or with an option; TypeError for an unknown
    option; MemoryError.

    >>> import numpy as np
    >>> corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    >>> points = np.vstack([corners, [[0.5, 0.5, 0.02]]])
    >>> faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    >>> tets = [(a, b, c, 8) for f in faces for a, b, c in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
    >>> result = improve(points, tets, threads=2)
    >>> result.ending, bool(result.after.theta_min > 20 > result.before.theta_min)
    ('finished', True)
    >>> improve(points, [(0, 1, 2, 9)])
    Traceback (most recent call last):
    tetmend._core.Error: tets[0, 3] is 9, but there are 9 points, numbered from 0
    """
    given = {"labels": labels, "parts": parts, "triangles": triangles, "triangle_labels": triangle_labels, "edges": edges,
             "edge_labels": edge_labels, "point_labels": point_labels, "required": required, "point_data": point_data,
             "cell_data": cell_data, "triangle_data": triangle_data, "edge_data": edge_data, "groups": groups}
    _check_function("progress", progress)
    _check_function("note", note)
    size_at = options.pop("size") if callable(options.get("size")) else None
    settings = to_settings(options)
    if isinstance(points, Result):
        points = points.mesh
    if isinstance(points, Mesh):
        present = [name for name, value in given.items() if value is not None]
        if present:
            raise TypeError(f"a Mesh has its own {present[0]}")
        if tets is not None:
            if not isinstance(tets, str):
                raise TypeError("beside a Mesh, tets is how far it may grow: text such as '10%'")
            settings.append(("tets", tets))
        _core.check_options(settings)
        mesh, core = points, points._core.copy()
    else:
        if isinstance(points, (str, os.PathLike)):
            raise TypeError(f"improve() takes points and tets, or a Mesh: tetmend.load({os.fspath(points)!r}) gives one")
        if tets is None or isinstance(tets, str):
            raise TypeError("improve() takes points and tets, or a Mesh")
        _core.check_options(settings)
        mesh = Mesh(points, tets, **{name: value for name, value in given.items() if value is not None})
        core = mesh._core
    figures, vertex_map, tet_map = _core.improve_in_place(core, settings, rulers, maps, progress, note, size_at)
    figures["schedule"] = "script" if options.get("script") else str(options.get("schedule") or "shell")
    figures["settings"] = {str(name): value for name, value in dict(options.get("set") or {}).items()}
    figures["measure"] = options.get("measure") or "sine_and_length"
    figures["threads"] = options.get("threads") or 1
    figures["notes"] = [*mesh.notes, *_notes_of(figures["build"]), *figures["notes"]]
    return Result(
        mesh=Mesh._of(core, mesh._forms, mesh._integer), vertex_map=vertex_map, tet_map=tet_map,
        before=Statistics(figures["before"]), after=Statistics(figures["after"]), goal=figures["goal"], ending=figures["ending"],
        passes=[Pass(**each) for each in figures["passes"]], notes=figures["notes"],
        worse_than_before=figures["worse_than_before"], missed_aims=figures["missed_aims"], touched_tets=figures["touched_tets"],
        volume_change=figures["volume_change"], seconds=figures["seconds"], figures=figures)


def adapt(points: ArrayLike | Mesh | Result, tets: ArrayLike | str | None = None, *,
          size: float | str | Sequence[float | str] | Callable[[float, float, float], float], **options: Any) -> Result:
    """Makes edges as long as wanted, and improves what came of it without undoing that. What goes in stays as it is.

    size  0.5, a length; "0.5x", half of what edges are there; "array:h", an array of point_data; "h.sol", a file of MEDIT;
          "coarse.vtu:h", an array of another mesh; "h.lua", a function size(x, y, z) of a script; or one of these for a region,
          "label:3=0.2"; or several of them; or a function of x, y and z. Any thread may call it, one at a time,
          and it must always say the same of a place

    All else is as for improve(), also gradation=1.3, smallest and largest, the bounds of wanted lengths. The surface stays, and so
    do its edges, unless the option surface lets it move. The figures of the input are no bounds.
    result.figures["sizes_after"] says how well edges keep to the sizes.

    >>> import numpy as np
    >>> corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    >>> faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    >>> tets = [(a, b, c, 8) for f in faces for a, b, c in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
    >>> result = adapt(np.vstack([corners, [[0.5, 0.5, 0.5]]]), tets, size=0.3, surface="flat")
    >>> len(result.tets) > 100
    True
    """
    if not options.get("schedule") and not options.get("script"):
        options["schedule"] = "adapt"
    return improve(points, tets, size=size, **options)
