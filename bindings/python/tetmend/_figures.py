# SPDX-License-Identifier: MIT
"""Figures with the names of the command line's JSON report."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any


def to_json(value: Any) -> Any:
    """The same of what JSON can express: a number that is not finite becomes None.

    >>> to_json({"volume": float("inf"), "bands": (1, 2.5)})
    {'volume': None, 'bands': [1, 2.5]}
    """
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: to_json(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [to_json(item) for item in value]
    return value


class Statistics(Mapping[str, Any]):
    """The figures of a mesh, by name: `after["theta_min"]` or `after.theta_min`; `lambda` is `after.lambda_` then.

    Angles in degrees, shares in percent of the dihedral angles. A tet is bad if it misses the goal.

    >>> figures = Statistics({"tets": 3, "lambda": 0.5, "rulers": None})
    >>> figures.tets, figures.lambda_, sorted(figures)
    (3, 0.5, ['lambda', 'tets'])
    """

    tets: int
    vertices: int
    boundary_triangles: int
    inverted: int
    flat: int
    volume: float
    theta_min: float
    theta_max: float
    lambda_: float
    lambda_bands: list[float]
    q_worst: float
    q_mean: float
    n_bad: int
    q_aver: float
    histogram: list[int]
    rulers: dict[str, Any]
    second_order: dict[str, Any]

    def __init__(self, figures: Mapping[str, Any]) -> None:
        self._figures = {name: value for name, value in figures.items() if value is not None}

    def __getitem__(self, name: str) -> Any:
        return self._figures[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._figures)

    def __len__(self) -> int:
        return len(self._figures)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name == "_figures":
            raise AttributeError(name)
        try:
            return self._figures[name.removesuffix("_")]
        except KeyError:
            raise AttributeError(f"there is no figure {name!r}: expected one of {', '.join(self._figures)}") from None

    def __repr__(self) -> str:
        shown = ("tets", "vertices", "theta_min", "theta_max", "n_bad")
        return f"Statistics({', '.join(f'{name}={self[name]!r}' for name in shown if name in self)}, ...)"


@dataclass(frozen=True)
class Pass:
    """What one pass of the schedule did."""

    name: str
    round: int
    seconds: float
    attempts: int
    accepted: int
    verdicts: dict[str, int]
    items: int
    deferred: int
    seconds_in_scans: float
    seconds_in_blocks: float
    q_worst: float
    n_bad: int
    n_needles: int
    q_aver: float
