# SPDX-License-Identifier: MIT
"""The kernel: a mesh to walk over and to edit, operators one by one, operators of one's own."""

from __future__ import annotations

import html
import inspect
import json
import weakref
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from types import TracebackType
from typing import Any, NamedTuple, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tetmend import _core
from tetmend._mesh import Mesh, mesh_in

Function = TypeVar("Function", bound=Callable[..., Any])


class Ring(NamedTuple):
    """The tets around an edge (a, b) in turn: the tet with the number tets[i] is (a, b, vertices[i], vertices[i + 1]), in positive order.

    A closed ring has as many vertices as tets. An open one goes from the boundary to the boundary, and has one vertex more.
    """

    a: int
    b: int
    tets: tuple[int, ...]
    vertices: tuple[int, ...]
    closed: bool


class PassDone(NamedTuple):
    """What a pass did, and how many bad tets there were then."""

    name: str
    attempts: int
    accepted: int
    n_bad: int


_COLOURS = {"accepted": "#2a7a3b", "no improvement": "#b36b00", "not applicable": "#777777"}


@dataclass(frozen=True)
class Call:
    """An attempt of an operator, with those that it made itself.

    A notebook shows it as a tree. Above it are the ring and the tree as figures of papers have them, until the mesh is changed: not of an attempt
    that stays, so ask try_only() before. Operators in Python have the tree alone.
    """

    operator_name: str
    target: tuple[int, ...]  #: 1 vertex, 2 of an edge, 3 of a face, 4 of a tet
    verdict: str
    level: int = 0  #: of a recursion
    worst_before: float = 0  #: worst quality of what changed, or would have; 0: nothing was compared
    worst_after: float = 0
    edits: int = 0
    children: tuple[Call, ...] = field(default=(), repr=False)
    _draw: Callable[[], list[str]] | None = field(default=None, repr=False, compare=False)

    @property
    def accepted(self) -> bool:
        """It stays, unless try_only() asked."""
        return self.verdict == "accepted"

    def __iter__(self) -> Iterator[Call]:
        """This call and all below it, in the order in which they began."""
        yield self
        for child in self.children:
            yield from child

    def __len__(self) -> int:
        return 1 + sum(map(len, self.children))

    def _line(self) -> str:
        gain = f" {self.worst_before:.3f} → {self.worst_after:.3f}" if self.worst_before or self.worst_after else ""
        return f"{self.operator_name}({' '.join(map(str, self.target))}) {self.verdict}{gain}"

    def text(self) -> str:
        """A line for each call, indented by its depth."""
        lines: list[str] = []

        def add(call: Call, depth: int) -> None:
            lines.append("  " * depth + call._line())
            for child in call.children:
                add(child, depth + 1)

        add(self, 0)
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        def tree(call: Call, depth: int) -> str:
            colour = _COLOURS.get(call.verdict, "#a02020")
            line = f'<span style="color:{colour}">●</span> <code>{html.escape(call._line())}</code>'
            if not call.children:
                return f"<li>{line}</li>"
            inner = "".join(tree(child, depth + 1) for child in call.children)
            shown = " open" if depth < 2 else ""
            return f"<li><details{shown}><summary>{line} ({len(call):,} calls)</summary><ul>{inner}</ul></details></li>"

        drawings = "".join(f"<div>{svg}</div>" for svg in self._draw()) if self._draw else ""
        return f'{drawings}<ul style="list-style:none">{tree(self, 0)}</ul>'


def _to_call(made: tuple[Any, ...]) -> Call:
    return Call(*made[:7], children=tuple(map(_to_call, made[7])))


class Edit:
    """Changes that stay or go together: what `with mesh.edit() as edit` gives. Without keep() all is undone at its end, bit for bit.

    Each change answers whether it was made. If not, nothing has changed, and `result` says why:

    inverted      a tet would lose its positive volume
    constrained   something would move or vanish that must stay: the surface, a face between two labels, a locked vertex
    not_closed    the tets around are not those that the change is for
    """

    def __init__(self, mesh: _core.TetMesh) -> None:
        self._mesh = mesh
        self._made: _core.Edit | None = None

    def __enter__(self) -> Edit:
        self._made = self._mesh.begin()
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        made, self._made = self._made, None
        if made is not None:
            made.end()

    @property
    def _core(self) -> _core.Edit:
        if self._made is None:
            raise _core.Error("an edit is open within its `with` only")
        return self._made

    def move(self, v: int, point: Sequence[float]) -> bool:
        """Moves a vertex."""
        return self._core.move(v, point)

    def flip_3_2(self, a: int, b: int) -> bool:
        """The three tets of an edge become two."""
        return self._core.flip_3_2(a, b)

    def flip_2_3(self, a: int, b: int, c: int) -> bool:
        """The two tets of a face become three."""
        return self._core.flip_2_3(a, b, c)

    def flip_4_4(self, a: int, b: int, diagonal: int = 0) -> bool:
        """The four tets of an edge become four around a diagonal of its ring: that of vertices 0 and 2, or 1 and 3, of one of its
        directions."""
        return self._core.flip_4_4(a, b, diagonal)

    def contract(self, gone: int, stays: int) -> bool:
        """Contracts the edge between two vertices; the first goes."""
        return self._core.contract(gone, stays)

    def split(self, of: Sequence[int], point: Sequence[float]) -> int | None:
        """A new vertex within an edge, a face or a tet, which its vertices name. Returns its number, or None: refused."""
        return self._core.split(of, point)

    def replace(self, old: Sequence[int], created: Sequence[Sequence[int]]) -> bool:
        """Replaces tets, by number, by others with the same outer surface: four vertices each, in positive order."""
        return self._core.replace(old, created)

    def keep(self) -> bool:
        """What was done stays: as part of the edit around this one, or of the mesh. Nothing may follow. Returns True."""
        self._core.keep()
        return True

    def undo(self) -> None:
        """Takes back all that was done so far. More may follow."""
        self._core.undo()

    @property
    def result(self) -> str:
        """What became of the last change: 'made', 'inverted', 'constrained' or 'not_closed'."""
        return self._core.result()

    @property
    def before(self) -> NDArray[np.float64]:
        """(k, 4, 3): corners of all tets that the edit has changed, as they were."""
        return self._core.before()

    @property
    def after(self) -> NDArray[np.float64]:
        """(k, 4, 3): the same as they are now."""
        return self._core.after()

    @property
    def created(self) -> list[int]:
        """Numbers of the tets that the last change made."""
        return self._core.created()

    @property
    def changed(self) -> list[int]:
        """Numbers of the tets that the edit has changed, those that are there."""
        return self._core.changed()


class Look:
    """What an operator sees: walks over the mesh, and the way to propose something."""

    def __init__(self, mesh: TetMesh, proposal: _core.Proposal) -> None:
        self._mesh = mesh
        self._proposal = proposal

    def replace(self, old: Sequence[int], created: Sequence[Sequence[int]]) -> bool:
        """Proposes other tets for these: four vertices each, in positive order. Returns True."""
        return self._proposal.replace(old, created)

    def move(self, v: int, point: Sequence[float]) -> bool:
        """Proposes another place for a vertex. Returns True."""
        return self._proposal.move(v, point)

    def ring(self, a: int, b: int) -> Ring:
        """As TetMesh.ring()."""
        return self._mesh.ring(a, b)

    def star(self, v: int) -> list[int]:
        """As TetMesh.star()."""
        return self._mesh.star(v)

    def one_ring(self, v: int) -> list[int]:
        """As TetMesh.one_ring()."""
        return self._mesh.one_ring(v)

    def vertices(self, t: int) -> tuple[int, int, int, int]:
        """As TetMesh.vertices()."""
        return self._mesh.vertices(t)

    def find_tet(self, a: int, b: int, c: int, d: int) -> int | None:
        """As TetMesh.find_tet()."""
        return self._mesh.find_tet(a, b, c, d)

    def has_edge(self, a: int, b: int) -> bool:
        """As TetMesh.has_edge()."""
        return self._mesh.has_edge(a, b)

    def point(self, v: int) -> NDArray[np.float64]:
        """As TetMesh.point()."""
        return self._mesh.point(v)

    def is_boundary(self, v: int) -> bool:
        """As TetMesh.is_boundary()."""
        return self._mesh.is_boundary(v)

    def is_fixed(self, v: int) -> bool:
        """As TetMesh.is_fixed()."""
        return self._mesh.is_fixed(v)


class TetMesh:
    """A mesh to walk over and to edit. It begins with the numbers of the Mesh that it is made of.

    >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
    >>> mesh = TetMesh(corners, [[0, 1, 2, 3], [4, 1, 3, 2]])
    >>> mesh.ring(1, 2).vertices, mesh.boundary().shape
    ((0, 3, 4), (6, 3))
    >>> mesh.one_ring(0)
    [1, 2, 3]

    Arguments: a Mesh or a Result; or points (n, 3), tets (m, 4) and, if there are regions, labels (m,).

    Vertices and tets keep their numbers. Numbers of what is gone may be used again by what is made later: keep vertices, and find the
    rest. Arrays over tets have a row for each number; is_live() tells which are there.
    `points` and `tets` are the memory of the mesh itself. While one of them, or a part of it, is in use, a change raises BufferError:
    no such array is ever out of date. All other arrays belong to whoever asked for them.
    One thread at a time. Raises Error, a ValueError, for a vertex, edge or tet that is not there.
    """

    def __init__(self, mesh: Any, tets: ArrayLike | None = None, labels: ArrayLike | None = None) -> None:
        given = mesh_in(mesh, "TetMesh(mesh)") if tets is None else Mesh(mesh, tets, labels=labels)
        self._core = _core.TetMesh(given._core)
        self._operators: dict[str, tuple[str, Callable[..., Any], Callable[..., Any] | None]] = {}

    def __repr__(self) -> str:
        return f"<tetmend.TetMesh: {self.vertex_count:,} vertices, {self.tet_count:,} tets>"

    def __copy__(self) -> TetMesh:
        return self.copy()

    def copy(self) -> TetMesh:
        """Another one with the same content and operators."""
        other = TetMesh.__new__(TetMesh)
        other._core = self._core.copy()
        other._operators = {}
        for name, (target, function, judge) in self._operators.items():
            other._add_operator(target, name, function, judge)
        return other

    @property
    def mesh(self) -> Mesh:
        """The mesh as it is now, with labels, groups and data, to save() or improve(). Cost: linear."""
        return Mesh._of(self._core.to_mesh())

    @property
    def tet_count(self) -> int:
        """Tets that are there."""
        return self._core.tet_count

    @property
    def vertex_count(self) -> int:
        """Vertices of tets."""
        return self._core.vertex_count

    # --- arrays

    @property
    def points(self) -> NDArray[np.float64]:
        """(numbers, 3): the memory of the mesh, read-only; see above. Of a mesh of far from ordinary size a copy."""
        return self._core.points

    @property
    def tets(self) -> NDArray[np.int32]:
        """(numbers, 4): the memory of the mesh, read-only; see above. Vertices in positive order; -1 first in a row of no tet."""
        return self._core.tets

    def is_live(self) -> NDArray[np.bool_]:
        """(numbers,): which tets are there."""
        return self._core.is_live()

    def neighbours(self) -> NDArray[np.int32]:
        """(numbers, 4): the tet behind the face opposite each corner; -1 at the boundary, and of no tet."""
        return self._core.neighbours()

    def labels(self) -> NDArray[np.int32]:
        """(numbers,): the region of each tet."""
        return self._core.labels()

    def quality(self) -> NDArray[np.float32]:
        """(numbers,): 1 where a dihedral angle just reaches the goal of 30 and 150 degrees, less for a worse one, 0 for a flat tet,
        negative for an inverted one; nan of no tet."""
        return self._core.quality()

    def edges(self) -> NDArray[np.int32]:
        """(k, 2): each edge once."""
        return self._core.edges()

    def faces(self) -> NDArray[np.int32]:
        """(k, 3): each face once."""
        return self._core.faces()

    def boundary(self) -> NDArray[np.int32]:
        """(k, 3): the faces with nothing on the other side, counterclockwise as seen from there."""
        return self._core.boundary()

    # --- walks

    def star(self, v: int) -> list[int]:
        """Numbers of the tets of a vertex."""
        return self._core.star(v)

    def one_ring(self, v: int) -> list[int]:
        """The vertices around a vertex."""
        return self._core.one_ring(v)

    def ring(self, a: int, b: int) -> Ring:
        """The tets and vertices around an edge, in turn."""
        return Ring(*self._core.ring(a, b))

    def vertices(self, t: int) -> tuple[int, int, int, int]:
        """The corners of a tet, in positive order."""
        return self._core.vertices(t)

    def point(self, v: int) -> NDArray[np.float64]:
        """(3,): a copy, unlike `points[v]`."""
        return self._core.point(v)

    def find_tet(self, a: int, b: int, c: int, d: int) -> int | None:
        """The number of the tet with these corners."""
        return self._core.find_tet(a, b, c, d)

    def has_edge(self, a: int, b: int) -> bool:
        """Whether a tet has both vertices."""
        return self._core.has_edge(a, b)

    def is_boundary(self, v: int) -> bool:
        """Whether a vertex lies on the boundary."""
        return self._core.is_boundary(v)

    def is_fixed(self, v: int) -> bool:
        """On the boundary, on a constraint, required, or locked: it neither moves nor vanishes."""
        return self._core.is_fixed(v)

    def lock(self, v: int) -> None:
        """From now on nothing moves or removes the vertex."""
        self._core.lock(v)

    def unlock(self, v: int) -> None:
        """Takes lock() back."""
        self._core.unlock(v)

    # --- changes

    def edit(self) -> Edit:
        """A scope for changes, undone at its end unless it is kept.

        `with mesh.edit() as edit:` begins one; in it, edit.flip_3_2(a, b) and the like change the mesh, edit.before and edit.after are the
        corners of what changed, and edit.keep() keeps it.
        """
        return Edit(self._core)

    def attempt(self, operator: str, target: int | Sequence[int], **settings: float) -> Call:
        """Tries an operator at a vertex, an edge, a face or a tet, which its vertices name. What it does stays if its judge accepts it.

        >>> mesh = TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
        >>> mesh.attempt("edge_removal", (0, 1)).accepted
        False
        """
        return self._attempt(operator, target, settings, True)

    def try_only(self, operator: str, target: int | Sequence[int], **settings: float) -> Call:
        """The same, and undone whatever came of it: what would happen."""
        return self._attempt(operator, target, settings, False)

    def _attempt(self, operator: str, target: int | Sequence[int], settings: dict[str, float], keeps: bool) -> Call:
        vertices = [target] if isinstance(target, (int, np.integer)) else list(target)
        call = _to_call(self._core.attempt(operator, vertices, list(settings.items()), keeps))
        if (keeps and call.accepted) or self._core.has_open_edit():
            return call
        known, changes = weakref.ref(self), self._core.changes

        def draw() -> list[str]:
            mesh = known()
            if mesh is None or mesh._core.changes != changes:
                return []
            try:
                return mesh._core.drawings(operator, vertices, list(settings.items()))
            except _core.Error:  # there was nothing to attempt
                return []

        return replace(call, _draw=draw)

    @overload
    def operator(self, target: str, *, judge: Callable[..., Any] | None = None) -> Callable[[Function], Function]: ...
    @overload
    def operator(self, target: str, function: Function, *, judge: Callable[..., Any] | None = None) -> Function: ...
    def operator(self, target: str, function: Any = None, *, judge: Callable[..., Any] | None = None) -> Any:
        """Makes a function an operator of this mesh, under its name, for a 'vertex', an 'edge', a 'face' or a 'tet'.

        A decorator, as `@mesh.operator("edge")`. The function gets a Look and the vertices of the target, and proposes other tets or
        another place for a vertex, or nothing. The attempt does that and undoes it unless the judge accepts it: that of tetmend, or
        `judge(before, now)` of the corners of all tets that changed, arrays (k, 4, 3). A proposal that breaks the mesh is refused.
        """
        if function is None:
            return lambda decorated: self.operator(target, decorated, judge=judge)
        self._add_operator(target, function.__name__, function, judge)
        return function

    def _add_operator(self, target: str, name: str, function: Callable[..., Any], judge: Callable[..., Any] | None) -> None:
        known = weakref.ref(self)  # the mesh holds the function, not the other way round

        def propose(proposal: _core.Proposal, *vertices: int) -> Any:
            mesh = known()
            assert mesh is not None
            return function(Look(mesh, proposal), *vertices)

        self._core.add_operator(name, target, (inspect.getdoc(function) or name).splitlines()[0], propose, judge)
        self._operators[name] = (target, function, judge)

    def apply(self, operator: str, *, below: float = 1, sweeps: int = 1, **settings: float) -> dict[str, int]:
        """Tries an operator in and around each tet with a quality below a limit, the worst first.

        Returns the number of attempts by verdict.

        In one thread: a loop of attempt(). See schedule() for passes.
        """
        kind = self._operators[operator][0] if operator in self._operators else _target_of(operator)
        picks = {"vertex": [(i,) for i in range(4)], "edge": [(i, j) for i in range(4) for j in range(i + 1, 4)],
                 "face": [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)], "tet": [(0, 1, 2, 3)]}[kind]
        count: dict[str, int] = {}
        for _ in range(sweeps):
            quality = self.quality()
            tets = self.tets.copy()
            bad = np.flatnonzero(quality < below)
            accepted = count.get("accepted", 0)
            for t in bad[np.argsort(quality[bad], kind="stable")]:
                corners = [int(v) for v in tets[t]]
                for pick in picks:
                    if self.find_tet(*corners) != t:
                        break  # gone by now
                    verdict = self.attempt(operator, [corners[i] for i in pick], **settings).verdict
                    count[verdict] = count.get(verdict, 0) + 1
            if count.get("accepted", 0) == accepted:
                break
        return count

    def schedule(self, name_or_script: str, *, threads: int = 1, **settings: object) -> list[PassDone]:
        """Makes the passes of a schedule, by its name, or of a script; operators of this mesh may be among them.

        A script tries an operator of the mesh by `apply('my_flip')`. Settings are the parameters of the schedule. The result is the
        same for every number of threads; an operator in Python is called by one of them.
        """
        texts = [(name, str(value).lower() if isinstance(value, bool) else str(value)) for name, value in settings.items()]
        return [PassDone(*each) for each in self._core.schedule(name_or_script, texts, threads)]

    def _pass(self, name: str, threads: int, options: dict[str, Any]) -> PassDone:
        done = self.schedule(f"{name}{_lua(options)}", threads=threads)
        return done[0] if done else PassDone(name, 0, 0, int((self.quality() < 1).sum()))

    def local_reconnection(self, *, threads: int = 1, **options: Any) -> PassDone:
        """A pass, with the options of its word in schedules: docs/schedules.md. The next five are likewise.

        An operator and its parameters are a tuple: `edges=("recursive_shell_transformation", {"max_level": 2})`.
        """
        return self._pass("local_reconnection", threads, options)

    def smooth(self, *, threads: int = 1, **options: Any) -> PassDone:
        """A pass, see local_reconnection()."""
        return self._pass("smooth", threads, options)

    def suppress_points(self, *, threads: int = 1, **options: Any) -> PassDone:
        """A pass, see local_reconnection()."""
        return self._pass("suppress_points", threads, options)

    def insert_points(self, *, threads: int = 1, **options: Any) -> PassDone:
        """A pass, see local_reconnection()."""
        return self._pass("insert_points", threads, options)

    def polish(self, *, threads: int = 1, **options: Any) -> PassDone:
        """A pass, see local_reconnection()."""
        return self._pass("polish", threads, options)

    def untangle(self, *, threads: int = 1, **options: Any) -> PassDone:
        """A pass, see local_reconnection()."""
        return self._pass("untangle", threads, options)

    def collect_garbage(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Gives vertices and tets new numbers without gaps. Returns those of all old ones, -1 for what is gone."""
        return self._core.collect_garbage()

    def check(self) -> int:
        """Contradictions in the mesh: 0, or tetmend has a bug."""
        return self._core.check()


def _lua(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_lua(each)}" for key, each in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        parts = [_lua(each) for each in value]
        if parts and isinstance(value[0], str) and isinstance(value[-1], dict):  # a name and its parameters are one table
            parts[-1] = parts[-1][1:-1]
        return "{" + ", ".join(parts) + "}"
    return json.dumps(value) if isinstance(value, str) else repr(float(value)) if isinstance(value, float) else str(value)


def _target_of(operator: str) -> str:
    for each in _core.operators([]):
        if each["name"] == operator:
            return each["target"]
    raise _core.Error(f"unknown operator '{operator}'")
