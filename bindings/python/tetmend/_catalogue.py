# SPDX-License-Identifier: MIT
"""What there is to improve a mesh with, and which files are known."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from tetmend import _core
from tetmend._mesh import PathLike


@dataclass(frozen=True)
class Parameter:
    """Of a schedule or an operator."""

    name: str
    help: str
    default: Any
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Schedule:
    """A script that says which passes are made."""

    name: str
    description: str
    parameters: list[Parameter]

    @property
    def source(self) -> str:
        """The text of the script."""
        return _core.schedule_source(self.name)


@dataclass(frozen=True)
class Operator:
    """As a script can name it."""

    name: str
    target: str
    """What it works on: 'tet', 'edge', 'face' or 'vertex'."""
    help: str
    plugin: str
    """The file it comes from; empty: tetmend itself."""
    parameters: list[Parameter]


def _parameters(given: list[dict[str, Any]]) -> list[Parameter]:
    return [Parameter(**{**each, "choices": tuple(each.get("choices", ()))}) for each in given]


def schedules() -> list[Schedule]:
    """The schedules that tetmend brings along; the first is the default.

    >>> [schedule.name for schedule in schedules()][0]
    'shell'
    """
    return [Schedule(each["name"], each["description"], _parameters(each["parameters"])) for each in _core.schedules()]


def operators(plugins: PathLike | Sequence[PathLike] = ()) -> list[Operator]:
    """The operators of tetmend, then those of the plugins. Raises Error for a plugin that cannot be loaded.

    >>> "edge_removal" in [operator.name for operator in operators()]
    True
    """
    plugins = [plugins] if isinstance(plugins, (str, os.PathLike)) else plugins
    found = _core.operators([os.fspath(plugin) for plugin in plugins])
    return [Operator(**{**each, "parameters": _parameters(each["parameters"])}) for each in found]


def formats() -> dict[str, str]:
    """What load() and save() know: names of formats by extension.

    >>> formats()[".mesh"]
    'MEDIT ASCII'
    """
    return dict(_core.file_formats())
