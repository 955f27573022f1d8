# SPDX-License-Identifier: MIT
"""The kernel from Python: arrays that are never out of date, walks, edits with undo, operators written in Python, the notebook."""

import ast
import gc
import importlib.util
import json

import numpy as np
import pytest
import tetmend
from conftest import SOURCE

NOTEBOOK = SOURCE / "docs/kernel.ipynb"


@pytest.fixture
def mesh(materials) -> tetmend.TetMesh:
    return tetmend.TetMesh(materials)


def volumes(corners: np.ndarray) -> np.ndarray:
    a, b, c, d = (corners[:, k] for k in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def state(mesh: tetmend.TetMesh) -> tuple:
    return mesh.points.copy().tobytes(), mesh.tets.copy().tobytes(), mesh.quality().tobytes()


# --- arrays


def test_points_and_tets_are_the_memory_of_the_mesh_and_a_change_waits_for_them(mesh, materials):
    points, tets = mesh.points, mesh.tets
    assert np.array_equal(points, materials.points) and np.array_equal(np.sort(tets), np.sort(materials.tets))
    assert points.__array_interface__["data"] == mesh.points.__array_interface__["data"]
    assert volumes(points[tets]).min() > 0
    with pytest.raises(ValueError, match="read-only"):
        points[0, 0] = 1
    row = points[3]
    del points, tets
    edge = mesh.edges()[0]
    for change in (lambda: mesh.edit().__enter__(), lambda: mesh.attempt("edge_removal", edge), mesh.collect_garbage):
        with pytest.raises(BufferError, match="cannot change while"):
            change()
    del row
    assert mesh.attempt("edge_removal", edge).operator_name == "edge_removal"


def test_an_array_within_an_edit_holds_up_the_edit_and_outlives_the_mesh(materials):
    mesh = tetmend.TetMesh(materials)
    inner = next(v for v in range(mesh.vertex_count) if not mesh.is_fixed(v))
    with mesh.edit() as edit:
        points = mesh.points
        with pytest.raises(BufferError):
            edit.move(inner, mesh.point(inner) + 1e-6)
        del points
        assert edit.move(inner, mesh.point(inner) + 1e-6) and edit.result == "made"
    points, sum_before = mesh.points, mesh.points.sum()
    del mesh, edit
    gc.collect()
    assert points.sum() == sum_before


def test_arrays_over_tets_edges_and_faces_agree_with_numpy(mesh):
    tets = mesh.tets.copy()
    pairs = np.sort(np.concatenate([tets[:, pair] for pair in ([0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3])]), axis=1)
    assert np.array_equal(np.unique(pairs, axis=0), np.unique(np.sort(mesh.edges(), axis=1), axis=0))
    assert len(np.unique(pairs, axis=0)) == len(mesh.edges())
    triples = np.sort(np.concatenate([np.delete(tets, k, axis=1) for k in range(4)]), axis=1)
    unique, count = np.unique(triples, axis=0, return_counts=True)
    assert np.array_equal(unique, np.unique(np.sort(mesh.faces(), axis=1), axis=0)) and len(unique) == len(mesh.faces())
    assert np.array_equal(unique[count == 1], np.unique(np.sort(mesh.boundary(), axis=1), axis=0))
    neighbours = mesh.neighbours()
    assert (neighbours == -1).sum() == len(mesh.boundary())
    for t, k in ((0, 0), (7, 2), (100, 3)):
        n = neighbours[t, k]
        assert n == -1 or (set(tets[n]) & set(tets[t]) == set(np.delete(tets[t], k)) and t in neighbours[n])
    assert mesh.is_live().all() and set(mesh.labels()) == set(mesh.mesh.labels)


def test_a_ring_is_the_tets_of_its_edge_in_turn_whichever_way_it_is_asked_for(mesh):
    tets, points = mesh.tets.copy(), mesh.points.copy()
    closed = 0
    for a, b in mesh.edges()[:400]:
        for x, y in ((a, b), (b, a)):
            ring = mesh.ring(x, y)
            assert (ring.a, ring.b) == (x, y) and len(ring.vertices) == len(ring.tets) + (not ring.closed)
            assert set(ring.tets) == set(np.flatnonzero((tets == a).any(axis=1) & (tets == b).any(axis=1)))
            made = [(x, y, ring.vertices[i], ring.vertices[(i + 1) % len(ring.vertices)]) for i in range(len(ring.tets))]
            assert [set(each) for each in made] == [set(tets[t]) for t in ring.tets]
            assert volumes(points[np.array(made)]).min() > 0
        closed += ring.closed
    assert 0 < closed < 400
    v = int(mesh.edges()[0][0])
    assert set(mesh.star(v)) == set(np.flatnonzero((tets == v).any(axis=1)))
    assert set(mesh.one_ring(v)) == set(np.unique(tets[mesh.star(v)])) - {v}


# --- edits


def test_an_edit_that_is_not_kept_is_undone_to_the_bit_and_one_that_is_kept_stays(mesh):
    before = state(mesh)
    a, b = next((a, b) for a, b in mesh.edges() if len(mesh.ring(a, b).tets) == 3 and try_flip(mesh, a, b))
    assert state(mesh) == before and mesh.check() == 0
    with mesh.edit() as edit:
        assert edit.flip_3_2(a, b) and len(edit.created) == 2
        assert np.isclose(volumes(edit.after).sum(), volumes(edit.before).sum()) and edit.after.shape == (2, 4, 3)
        edit.keep()
    assert not mesh.has_edge(a, b) and state(mesh) != before and mesh.check() == 0
    with mesh.edit() as edit:
        assert not edit.flip_3_2(a, b) and edit.result == "not_closed"
    with pytest.raises(tetmend.Error, match="within its `with`"):
        edit.keep()


def try_flip(mesh: tetmend.TetMesh, a: int, b: int) -> bool:
    with mesh.edit() as edit:
        return edit.flip_3_2(a, b)


def test_inner_edits_belong_to_the_outer_one_and_an_exception_undoes_all(mesh):
    before = state(mesh)
    inner = next(v for v in range(mesh.vertex_count) if not mesh.is_fixed(v))
    with pytest.raises(ZeroDivisionError), mesh.edit() as outer:
        with mesh.edit() as edit:
            assert edit.move(inner, mesh.point(inner) + 1e-7)
            edit.keep()
        assert outer.split(mesh.vertices(0), mesh.points[list(mesh.vertices(0))].mean(axis=0)) is not None
        outer.keep()
        raise ZeroDivisionError
    kept = state(mesh)
    assert kept != before  # it was kept before the exception
    with pytest.raises(ZeroDivisionError), mesh.edit() as outer:
        with mesh.edit() as edit:
            edit.move(inner, mesh.point(inner) + 1e-7)
            edit.keep()
        raise ZeroDivisionError
    assert state(mesh) == kept and mesh.check() == 0


def test_a_locked_vertex_stays(mesh):
    inner = next(v for v in range(mesh.vertex_count) if not mesh.is_fixed(v))
    mesh.lock(inner)
    with mesh.edit() as edit:
        assert not edit.move(inner, mesh.point(inner) + 1e-7) and edit.result == "constrained"
    mesh.unlock(inner)
    with mesh.edit() as edit:
        assert edit.move(inner, mesh.point(inner) + 1e-7)


def test_what_is_not_there_is_an_error_with_its_number(mesh):
    for wrong, words in ((lambda: mesh.star(10**6), "no vertex 1000000"), (lambda: mesh.vertices(10**6), "no tet 1000000"),
                         (lambda: mesh.attempt("nothing", (0,)), "nothing"), (lambda: mesh.attempt("smoothing", ()), "target"),
                         (lambda: mesh.operator("cell", len), "'vertex', an 'edge'"), (lambda: mesh.apply("nothing"), "nothing")):
        with pytest.raises(tetmend.Error, match=words):
            wrong()
    far = next(v for v in range(mesh.vertex_count) if not mesh.has_edge(0, v) and v != 0)
    assert mesh.attempt("edge_removal", (0, far)).verdict == "not applicable"


# --- operators


def fewer(before: np.ndarray, now: np.ndarray) -> bool:
    return len(now) < len(before)


def test_a_flip_written_in_python_is_an_operator_like_any_other(mesh):
    @mesh.operator("edge", judge=fewer)
    def my_flip(look, a, b):
        """three tets of an edge become two"""
        ring = look.ring(a, b)
        if ring.closed and len(ring.tets) == 3:
            p, q, r = ring.vertices
            look.replace(ring.tets, [(a, p, q, r), (p, q, r, b)])

    volume, tets = volumes(mesh.points[mesh.tets]).sum(), mesh.tet_count
    count = mesh.apply("my_flip", below=np.inf)
    assert count["accepted"] == tets - mesh.tet_count > 10
    assert mesh.check() == 0 and np.isclose(volumes(mesh.points[mesh.tets[mesh.is_live()]]).sum(), volume)
    other = mesh.copy()
    assert "my_flip" in other._operators and other.try_only("my_flip", other.edges()[0]).operator_name == "my_flip"
    with pytest.raises(tetmend.Error, match="registered twice"):
        mesh.operator("edge", my_flip)


def test_an_operator_in_python_is_held_to_the_contract(mesh):
    before, reached = state(mesh), []

    @mesh.operator("edge", judge=lambda before, now: True)
    def loses_tets(look, a, b):
        ring = look.ring(a, b)
        reached.append(ring.closed)
        return look.replace(ring.tets, [(a, *ring.vertices[:3])]) if ring.closed else None

    @mesh.operator("vertex", judge=lambda before, now: True)
    def throws_out(look, v):
        reached.append(v)
        return look.move(v, look.point(v) + 1e3)

    @mesh.operator("edge")
    def fails(look, a, b):
        raise KeyError("own fault")

    @mesh.operator("edge")
    def holds_on(look, a, b):
        reached.append(mesh.points)
        return False

    for a, b in mesh.edges()[:200]:
        assert not mesh.attempt("loses_tets", (a, b)).accepted
    for v in range(50):
        assert not mesh.attempt("throws_out", v).accepted
    with pytest.raises(KeyError, match="own fault"):
        mesh.attempt("fails", mesh.edges()[0])
    with pytest.raises(BufferError):
        mesh.attempt("holds_on", mesh.edges()[0])
    assert len(reached) == 251
    reached.clear()
    assert state(mesh) == before and mesh.check() == 0


def test_try_only_shows_a_tree_and_leaves_the_mesh_as_it_was(mesh):
    before = state(mesh)
    bad = np.flatnonzero(mesh.quality() < 1)
    calls = [mesh.try_only("recursive_shell_transformation", (v[0], v[k]), max_level=5)
             for v in map(mesh.vertices, bad) for k in (1, 2, 3)]
    call = max(calls, key=len)
    assert state(mesh) == before and any(each.accepted for each in calls)
    assert len(call) > 3 and len(list(call)) == len(call) == len(call.text().splitlines())
    assert call.children[0].operator_name == "shell_transformation"
    shown = call._repr_html_()
    assert shown.count("<code>") == len(call) and "recursive_shell_transformation(" in shown
    assert shown.count("<svg") == 2  # ring and tree, as figures have them
    assert state(mesh) == before
    with mesh.edit():
        assert call._repr_html_().count("<svg") == 0
    assert call._repr_html_().count("<svg") == 2
    done = next(each for each in calls if each.accepted)
    assert mesh.attempt(done.operator_name, done.target, max_level=5).accepted and state(mesh) != before
    assert call._repr_html_().count("<svg") == 0  # the mesh is another one
    assert mesh.try_only("smoothing", 0)._repr_html_().startswith("<")


def test_schedules_and_scripts_work_on_the_mesh_with_its_own_operators(mesh, materials):
    called = []

    @mesh.operator("edge", judge=fewer)
    def looks(look, a, b):
        called.append((a, b))

    passes = mesh.schedule("smooth{} local_reconnection{} apply('looks')", threads=2)
    assert [each.name for each in passes] == ["smooth", "local_reconnection", "looks"]
    assert passes[2].attempts == len(called) and passes[1].accepted > 0 and mesh.check() == 0
    other, by_two = tetmend.TetMesh(materials), tetmend.TetMesh(materials)
    assert other.schedule("shell", max_rounds=1)[-1].n_bad <= np.sum(tetmend.TetMesh(materials).quality() < 1)
    by_two.schedule("shell", threads=2, max_rounds=1)
    assert state(other) == state(by_two)
    with pytest.raises(tetmend.Error, match="script:1"):
        mesh.schedule("nothing{}")
    by_pass, by_word = tetmend.TetMesh(materials), tetmend.TetMesh(materials)
    done = by_pass.local_reconnection(edges=("recursive_shell_transformation", {"max_level": 2, "most_edges": 1})), by_pass.smooth(on={"below": 0.5})
    assert list(done) == by_word.schedule(
        "local_reconnection{edges = {'recursive_shell_transformation', max_level = 2, most_edges = 1}} smooth{on = {below = 0.5}}")
    assert state(by_pass) == state(by_word)
    with pytest.raises(tetmend.Error, match="edge"):
        by_pass.local_reconnection(edge=1)
    points = mesh.points
    with pytest.raises(BufferError):
        mesh.schedule("smooth{}")
    assert points is not None


def test_smoothing_in_python_keeps_labels_and_comes_back_as_a_mesh(mesh, materials):
    for v in range(len(materials.points)):
        if mesh.is_fixed(v):
            continue
        with mesh.edit() as edit:
            if edit.move(v, mesh.points[mesh.one_ring(v)].mean(axis=0)):
                edit.keep()
    smoothed = mesh.mesh
    assert np.array_equal(smoothed.labels, materials.labels) and not np.array_equal(smoothed.points, materials.points)
    assert tetmend.improve(smoothed).after.n_bad <= tetmend.quality(smoothed).statistics.n_bad


# --- the notebook


def cells() -> list[str]:
    return ["".join(cell["source"]) for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]


def test_the_cells_of_the_notebook_run_in_their_order(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    tetmend.load(SOURCE / "assets/meshes/bracket.meshb").save("part.mesh")
    names: dict = {}
    assert len(cells()) == 12
    for source in cells():
        tree = ast.parse(source)
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "cell", "exec"), names)
        value = None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), names)
        for show in ("_repr_html_", "_repr_svg_"):
            if hasattr(value, show):
                assert getattr(value, show)().startswith("<")
    assert names["mesh"].check() == 0 and names["count"]["accepted"] > 0


@pytest.mark.skipif(importlib.util.find_spec("nbclient") is None, reason="nbclient is not installed: cells were run without Jupyter")
def test_jupyter_runs_the_notebook(tmp_path):
    import nbclient
    import nbformat

    tetmend.load(SOURCE / "assets/meshes/bracket.meshb").save(tmp_path / "part.mesh")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert all(cell.get("execution_count") for cell in notebook.cells if cell.cell_type == "code")
