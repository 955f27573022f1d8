# SPDX-License-Identifier: MIT
"""The measures of a mesh that users look at: where bench/measure tells each, which way is better,
and how it is shown."""

from collections.abc import Callable
from dataclasses import dataclass


def angle(degrees: float) -> str:
    return f"{degrees:.2f}" if degrees >= 0.01 else f"{degrees:.2g}"


def percent(value: float) -> str:
    return "0" if value == 0 else f"{value:#.3g}"


def count(value: float) -> str:
    return f"{value:,}"


def ratio(value: float) -> str:
    return f"{value:.4f}" if value >= 0.001 or value == 0 else f"{value:.2g}"


def large_ratio(value: float) -> str:
    return f"{value:,.2f}" if value < 1e6 else f"{value:.2g}"


@dataclass(frozen=True)
class Measure:
    column: str  # its heading in tables
    title: str  # in charts
    of: Callable[[dict], float]  # from what bench/measure tells of a mesh
    shown: Callable[[float], str]
    more_is_better: bool = False
    logarithmic: bool = False  # in charts


def ruler(name: str, what: str) -> Callable[[dict], float]:
    return lambda measured: measured["rulers"][name][what]


ANGLES = [
    Measure("theta_min", "smallest angle", lambda told: told["theta_min"], angle, True),
    Measure("theta_max", "largest angle", lambda told: told["theta_max"], angle),
    Measure("lambda %", "angles outside 30 to 150, %", lambda told: told["lambda"], percent,
            logarithmic=True),
    Measure("bad", "bad tets", lambda told: told["n_bad"], count, logarithmic=True),
]
SHAPES = [
    Measure("worst mean ratio", "mean ratio, worst", ruler("mean_ratio", "worst"), ratio, True),
    Measure("mean mean ratio", "mean ratio, mean", ruler("mean_ratio", "mean"), ratio, True),
    Measure("worst radius ratio", "radius ratio, worst", ruler("radius_ratio", "worst"), ratio,
            True),
    Measure("mean radius ratio", "radius ratio, mean", ruler("radius_ratio", "mean"), ratio, True),
    Measure("edge ratio", "edge ratio, worst", ruler("edge_ratio", "worst"), large_ratio,
            logarithmic=True),
    Measure("faces above 70", "faces above 70 degrees",
            lambda told: told["rulers"]["faces_above_70"], count, logarithmic=True),
]
MEASURES = [*ANGLES, *SHAPES]
