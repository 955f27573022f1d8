# SPDX-License-Identifier: MIT
"""A recorded run."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Iterator
from typing import Any

from tetmend import _core
from tetmend._mesh import Mesh, PathLike

_AT_ONCE = 4096  # events


class Trace:
    """What `improve(..., trace=FILE)` recorded, opened for reading.

    Events, calls (attempts of operators), visits (bad tets that a pass turned to) and passes come as dicts; vertices are numbered
    as the run numbered them. The calls that call c makes are those from c + 1 up to before its 'subtree_end'.

        trace = tetmend.Trace("run.trace")
        lasting = sum(call["for_good"] for call in trace.calls())
        trace.mesh_at(trace.call(17)["events"][0]).save("then.vtu")
    """

    def __init__(self, file: PathLike) -> None:
        self._core = _core.Trace(os.fspath(file))

    def __repr__(self) -> str:
        return f"<tetmend.Trace of {self.input or 'arrays'}: {self.call_count:,} calls, {self.event_count:,} events>"

    @property
    def program(self) -> str:
        """Name and version."""
        return self._core.program

    @property
    def input(self) -> str:
        """File of the mesh; empty: it was made of arrays."""
        return self._core.input

    @property
    def schedule(self) -> str:
        """Its name."""
        return self._core.schedule

    @property
    def settings(self) -> dict[str, str]:
        """Parameters of the schedule."""
        return dict(self._core.settings)

    @property
    def filter(self) -> str:
        """What was left out, in words; empty: nothing."""
        return self._core.filter

    @property
    def damage(self) -> str:
        """How far the file can be read, and why no further; empty: it is complete."""
        return self._core.damage

    @property
    def limit_reached(self) -> bool:
        """The trace ends before the run, for its size."""
        return self._core.limit_reached

    @property
    def event_count(self) -> int:
        """Events in all."""
        return self._core.event_count

    @property
    def call_count(self) -> int:
        """Calls in all."""
        return self._core.call_count

    @staticmethod
    def _number(name: str, value: int) -> int:
        if operator.index(value) < 0:
            raise _core.Error(f"{name} is {value}, but numbers begin with 0")
        return operator.index(value)

    def call(self, number: int) -> dict[str, Any]:
        """One attempt of an operator."""
        return self._core.call(self._number("number", number))

    def calls(self, *, outermost: bool = False) -> Iterator[dict[str, Any]]:
        """All of them, or those that no other call made."""
        number = 0
        while number < self._core.call_count:
            call = self._core.call(number)
            yield {"number": number, **call}
            number = call["subtree_end"] if outermost else number + 1

    def visits(self) -> Iterator[dict[str, Any]]:
        """The bad tets that passes turned to."""
        return (self._core.visit(i) for i in range(self._core.visit_count))

    def passes(self) -> Iterator[dict[str, Any]]:
        """The passes of the schedule."""
        return (self._core.pass_(i) for i in range(self._core.pass_count))

    def events(self, first: int = 0, last: int | None = None) -> Iterator[dict[str, Any]]:
        """From one up to before the other."""
        end = self.event_count if last is None else self._number("last", last)
        if self._number("first", first) > self.event_count:
            raise _core.Error(f"first is {first}, but the trace has {self.event_count} events")
        for begin in range(first, end, _AT_ONCE):
            yield from self._core.events(begin, min(begin + _AT_ONCE, end))

    def mesh_at(self, n: int) -> Mesh:
        """The mesh after the first n events. Takes a microsecond for each of them."""
        return Mesh._of(self._core.mesh_at(self._number("n", n)))

    def ledger(self) -> list[dict[str, Any]]:
        """The whole of the run: a dict for each operator, level of recursion and way to end.

        Keys are operator, level, ending, reason, refused, calls, share (of the operator's calls on the level) and seconds (of these
        calls, without calls in them). Each call is in one of them: `pandas.DataFrame(trace.ledger())` is a table of all.
        Takes a tenth of a microsecond for each call.
        """
        return self._core.ledger()

    def calls_of(self, entry: dict[str, Any]) -> list[int]:
        """The calls of an entry of the ledger, by number; those nearest to being accepted come first."""
        return self._core.calls_of(entry["operator"], entry["level"], entry["ending"])

    def worse_than(self, other: Trace) -> list[dict[str, Any]]:
        """Where this run left a bad tet and the other a good one, the worst first: dicts of bad and good, which are four vertices as
        the runs numbered them, and of bad_quality and good_quality. Takes a replay of both.
        """
        return self._core.worse_than(other._core)

    def against(self, other: Trace) -> str:
        """Two runs side by side, as `tetmend trace FILE --against OTHER` prints them: this one is a."""
        return self._core.against(other._core)

    def history(self, what: str) -> str:
        """Why a tet, face, edge or vertex is there or gone, as `tetmend trace FILE --history WHAT --all` prints it."""
        return self._core.history(what)

    def summary(self) -> str:
        """As `tetmend trace FILE` prints it."""
        return self._core.summary()

    def tree(self, call: int) -> str:
        """A call and all in it, as text."""
        return self._core.tree(self._number("call", call))

    def dot(self, call: int) -> str:
        """The same as a graph for Graphviz."""
        return self._core.dot(self._number("call", call))

    def slices(self) -> Any:
        """All of it in the JSON format of Perfetto and chrome://tracing."""
        return json.loads(self._core.slices())
