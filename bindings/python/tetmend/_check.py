# SPDX-License-Identifier: MIT
"""Facts about a mesh, or about what became of it."""

from __future__ import annotations

import numbers
import os
from collections.abc import Mapping
from dataclasses import dataclass

from tetmend import _core
from tetmend._html import check_as_html
from tetmend._mesh import Mesh, PathLike, load, mesh_in
from tetmend._options import to_settings


@dataclass(frozen=True)
class Fact:
    """What was looked at, and whether it holds."""

    name: str
    holds: bool
    text: str
    value: float | int | None
    wanted: float | int | None


@dataclass(frozen=True, repr=False)
class Check:
    """All facts. It is true if all of them hold."""

    facts: list[Fact]

    @property
    def holds(self) -> bool:
        """Whether all of them do."""
        return all(fact.holds for fact in self.facts)

    @property
    def status(self) -> int:
        """Exit status of `tetmend check`: 0 all of it holds, 3 something does not."""
        return 0 if self.holds else 3

    def __bool__(self) -> bool:
        return self.holds

    def __repr__(self) -> str:
        return f"<tetmend.Check: {len(self.facts)} facts, {sum(not fact.holds for fact in self.facts)} of them do not hold>"

    def _repr_html_(self) -> str:
        return check_as_html(self)

    def __str__(self) -> str:
        return "\n".join(f"{'ok  ' if fact.holds else 'FAIL'}  {fact.text}" for fact in self.facts)


def check(mesh: Mesh | PathLike, improved: Mesh | PathLike | None = None, *, min_dihedral: float = 0,
          max_dihedral: float = 180, no_inverted: bool = False, measure: Mapping[str, float] | None = None, preset: str = "",
          threads: int = 1, goal: float | tuple[float, float] | str | None = None, surface: str | float | None = None) -> Check:
    """Does a mesh keep what a solver, or its input, asks of it? As `tetmend check` does.

    With two meshes: the same surface, walls, labels, groups and volumes, and nothing worse; thresholds are asked of the second.
    min_dihedral, max_dihedral: degrees. no_inverted: in exact arithmetic. measure: worst values of rulers,
    {"mean_ratio": 0.1}. preset: what a solver or a use asks: "calculix", "explicit", "fenicsx", "implicit", "openfoam", "su2" (`--for`).
    goal: that of the run, where the second mesh was improved by another than 30 and 150 degrees: which tets are bad depends on it.
    surface: how far that run let the surface move, as improve() has it ("1%"): proven both ways, wholly; without it, bit for bit.

    >>> tet = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    >>> print(check(tet, min_dihedral=60, no_inverted=True))
    ok    no inverted or flat tet, in exact arithmetic
    FAIL  smallest dihedral angle 54.7356, wanted at least 60
    >>> check(tet, tet).status
    0
    """
    for name, angle in (("min_dihedral", min_dihedral), ("max_dihedral", max_dihedral)):
        if not isinstance(angle, numbers.Real):
            raise TypeError(f"{name} is {angle!r}, but a number of degrees is wanted")
    if measure is not None and not isinstance(measure, Mapping):
        raise TypeError(f"measure is of type {type(measure).__name__}, but a dict is wanted: {{'mean_ratio': 0.1}}")
    asks = min_dihedral > 0 or max_dihedral < 180 or no_inverted or bool(measure) or bool(preset)
    if not asks and improved is None:
        raise _core.Error("nothing to check: give a threshold, a preset or a second mesh")
    first, second = (load(each, threads=threads) if isinstance(each, (str, os.PathLike)) else each for each in (mesh, improved))
    first = mesh_in(first, "check()")
    second = None if second is None else mesh_in(second, "check()")
    try:
        facts = _core.check(first._core, None if second is None else second._core, min_dihedral, max_dihedral, no_inverted,
                            list((measure or {}).items()), preset, threads, to_settings({"goal": goal, "surface": surface}))
    except _core.OptionError as error:
        raise _core.OptionError("preset" + text[3:] if (text := str(error)).startswith("for:") else text) from None
    return Check([Fact(**each) for each in facts])
