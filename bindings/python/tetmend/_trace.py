# SPDX-License-Identifier: MIT
"""A recorded run."""

from __future__ import annotations

import html
import json
import operator
import os
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tetmend import _core
from tetmend._mesh import Mesh, PathLike, naming_missing_files

_AT_ONCE = 4096  # events


class TracePage:
    """A page that steps through a call, of Trace.show(): a notebook shows it, `save()` writes it for a browser."""

    def __init__(self, page: str, height: int) -> None:
        self._page = page
        self._height = height

    @property
    def html(self) -> str:
        """The page, which needs nothing else."""
        return self._page

    def save(self, file: PathLike) -> None:
        """Writes the page to a file."""
        with open(file, "w", encoding="utf-8") as out:
            out.write(self._page)

    def __repr__(self) -> str:
        return f"<tetmend.TracePage, {len(self._page):,} characters>"

    def _repr_html_(self) -> str:
        return (f'<iframe title="a call, step by step" srcdoc="{html.escape(self._page)}" '
                f'style="width: 100%; height: {self._height}px; border: 1px solid #ccc"></iframe>')


class Trace:
    """What `improve(..., trace=FILE)` recorded, opened for reading.

    Events, calls (attempts of operators), visits (bad tets that a pass turned to) and passes come as dicts; vertices are numbered
    as the run numbered them. The calls that call c makes are those from c + 1 up to before its 'subtree_end'.

        trace = tetmend.Trace("run.trace")
        lasting = sum(call["for_good"] for call in trace.calls())
        trace.mesh_at(trace.call(17)["events"][0]).save("then.vtu")
    """

    def __init__(self, file: PathLike) -> None:
        self._file = os.fspath(file)
        with naming_missing_files(file):
            self._core = _core.Trace(self._file)

    def __repr__(self) -> str:
        return f"<tetmend.Trace of {self.input or 'arrays'}: {self.call_count:,} calls, {self.event_count:,} events>"

    def _repr_html_(self) -> str:
        columns: dict[str, list[float]] = {}  # calls, for good, undone, refused, seconds of each operator
        for entry in self.ledger():
            kind = 1 if entry["ending"] == "accepted for good" else 2 if entry["ending"] == "undone with a caller" else 3
            row = columns.setdefault(entry["operator"], [0, 0, 0, 0, 0.0])
            row[0] += entry["calls"]
            row[kind] += entry["calls"] if kind < 3 or entry["refused"] else 0  # a trace that is cut off ends in none of these
            row[4] += entry["seconds"]
        head = "".join(f"<th>{text}</th>" for text in ("operator", "calls", "accepted for good", "undone with a caller", "refused", "seconds"))
        rows = "".join(f"<tr><td>{html.escape(name)}</td>{''.join(f'<td>{count:,}</td>' for count in counts[:4])}<td>{counts[4]:.2f}</td></tr>"
                       for name, counts in columns.items())
        about = f"{self.input or 'arrays'}, schedule {self.schedule}: {self.call_count:,} calls, {self.event_count:,} events"
        damage = f"<p>{html.escape(self.damage)}</p>" if self.damage else ""
        return f"<p>{html.escape(about)}</p>{damage}<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"

    def show(self, call: int, *, height: int = 640) -> TracePage:
        """A call step by step, with three questions, as `tetmend lesson --make FILE --call N` proposes it.

        A notebook shows it, `height` pixels high. The file of the trace is read once more.
        Raises Error where the trace ends before the call does.
        """
        return TracePage(_core.page_of_call(self._file, self._number("call", call)), height)

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
    def measure(self) -> str:
        """What tets were judged by when the run began: "sine_and_length", "sine", or the name of a program's measure."""
        return self._core.measure

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

    def quality_at(self, n: int) -> NDArray[np.float32]:
        """Of each tet of mesh_at(n), in its order, the quality that the run had for it: bad below 1, inverted below 0.

        Also by a measure of a program, see `measure`. Takes as long as mesh_at().
        """
        return self._core.quality_at(self._number("n", n))

    def ledger(self) -> list[dict[str, Any]]:
        """The whole of the run: a dict for each operator, level of recursion and way to end.

        Keys are operator, level, ending, reason, refused, calls, share (of the operator's calls on the level), seconds (of these
        calls, without calls in them) and nearest: the least quality that a refused one was missing, None where nothing was compared.
        Each call is in one of them: `pandas.DataFrame(trace.ledger())` is a table of all.
        Takes a tenth of a microsecond for each call.
        """
        return self._core.ledger()

    def calls_of(self, entry: dict[str, Any]) -> list[int]:
        """The calls of an entry of the ledger, by number; those nearest to being accepted come first, those that compared nothing last."""
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
