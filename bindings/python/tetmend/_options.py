# SPDX-License-Identifier: MIT
"""Options of improve() as the text that the library takes."""

from __future__ import annotations

import difflib
import numbers
import operator
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypedDict, Union

import numpy as np

from tetmend import _core

Text = Union[str, "os.PathLike[str]"]


class Options(TypedDict, total=False):
    """What improve() takes besides the mesh: the options of `tetmend improve`, with `_` for `-`. None is the default.

    docs/library.md has their meaning. The option `tets`, how far the mesh may grow, stands in the signature of improve().
    """

    schedule: Text
    script: str
    set: Mapping[str, Any]
    plugin: Text | Sequence[Text]
    purpose: str
    goal: float | tuple[float, float] | str
    measure: str
    threads: int
    time_limit: float
    protect: str | Sequence[str]
    only: str | Sequence[str]
    layers: str
    surface: str
    feature_angle: float
    keep_size: bool
    size: float | str | Sequence[float | str] | Callable[[float, float, float], float]
    gradation: float
    smallest: float
    largest: float
    conserve: str | Sequence[str]
    ignore_interior: bool
    straighten: bool
    trace: Text
    trace_piece: str
    trace_around: str
    trace_operator: str | Sequence[str]
    trace_depth: int
    trace_limit: int | str
    check_operators: bool
    limit: bool


def _to_text(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return str(os.fspath(value))
    if isinstance(value, numbers.Integral):
        return str(operator.index(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    raise _core.Error(f"{value!r} is neither text nor a number")


def _values_of(name: str, value: Any, adds: bool) -> list[str]:
    if name == "set":
        if not isinstance(value, Mapping):
            raise _core.Error(f"{value!r} is no dict of parameters of the schedule, such as {{'max_rounds': 2}}")
        return [f"{key}={_to_text(one)}" for key, one in dict(value).items()]
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if name == "goal" and isinstance(value, (tuple, list)):
        return [",".join(_to_text(angle) for angle in value)]
    if adds and isinstance(value, (tuple, list)):
        return [_to_text(one) for one in value]
    return [_to_text(value)]


def refuse_own(options: Mapping[str, Any], own: Sequence[str], where: str) -> None:
    """What `where` has itself is no option of a bridge."""
    for name in own:
        if options.get(name) is not None:
            raise TypeError(f"improve() takes no {name!r} here: {where} has its own")


def to_settings(options: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Names and values as on the command line.

    >>> to_settings({"goal": (20, 160), "set": {"max_rounds": 2}, "time_limit": None, "keep_size": True})
    [('goal', '20,160'), ('set', 'max_rounds=2'), ('keep-size', 'true')]
    >>> to_settings({"shedule": "thorough"})
    Traceback (most recent call last):
    TypeError: improve() has no option 'shedule': did you mean 'schedule'?
    """
    forms = {name.replace("-", "_"): (several, needed) for name, _, several, needed in _core.option_forms()}
    adds = {name: several for name, (several, _) in forms.items()}
    given = {name for name, value in options.items() if value is not None}
    for name, (_, needed) in forms.items():  # without the second, the first would do nothing
        if needed and name in given and needed not in given:
            raise _core.OptionError(f"{name}: it needs the option {needed}")
    if {"schedule", "script"} <= given:
        raise _core.OptionError("script: it stands in the place of a schedule, and there is one: give one of them")
    settings = []
    for name, value in options.items():
        if name not in adds:
            close = difflib.get_close_matches(name, adds, 1)
            hint = f": did you mean {close[0]!r}?" if close else ": expected one of " + ", ".join(adds)
            raise TypeError(f"improve() has no option {name!r}{hint}")
        if value is None:
            continue
        try:
            settings += [(name.replace("_", "-"), text) for text in _values_of(name, value, adds[name])]
        except _core.Error as error:
            raise _core.Error(f"{name}: {error}") from None
    return settings
