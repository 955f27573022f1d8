# SPDX-License-Identifier: MIT
"""Meshes in other programs: Gmsh, meshio, VTK, PyVista, ParaView. What is not installed is skipped."""

import importlib
import os
import re
import runpy
import shutil
import subprocess
import sys
import types
from pathlib import Path

import numpy as np
import pytest
import tetmend
from conftest import SOURCE


def volumes(points, tets):
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def lattice(n, seed=1):
    """Two cubes side by side, cut into tets, with the inner vertices moved at random. Labels by side."""
    rng = np.random.default_rng(seed)
    shape = (2 * n + 1, n + 1, n + 1)
    index = np.arange(np.prod(shape)).reshape(shape)
    points = np.stack(np.meshgrid(*(np.arange(k) / n for k in shape), indexing="ij"), axis=-1).reshape(-1, 3)
    inner = np.all((points > 1e-9) & (points < np.array([2, 1, 1]) - 1e-9), axis=1) & (np.abs(points[:, 0] - 1) > 1e-9)
    tets = []
    for axes in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
        corner = np.zeros(3, int)
        steps = [corner.copy()]
        for axis in axes:
            corner[axis] = 1
            steps.append(corner.copy())
        tets.append(np.stack([index[tuple(slice(s, s + k - 1) for s, k in zip(step, shape))].ravel() for step in steps], axis=1))
    tets = np.concatenate(tets)
    flipped = volumes(points, tets) < 0
    tets[flipped] = tets[flipped][:, [0, 2, 1, 3]]
    points[inner] += rng.uniform(-0.3, 0.3, (int(inner.sum()), 3)) / n
    side = (points[tets].mean(axis=1)[:, 0] > 1).astype(np.int32)
    return points, tets, side


# --- Gmsh

PHYSICAL = [(30, "inlet", -0.1, 0.1), (40, "outlet", 1.9, 2.1), (50, "interface", 0.9, 1.1)]


@pytest.fixture
def gmsh():
    library = pytest.importorskip("gmsh")
    library.initialize()
    library.option.setNumber("General.Terminal", 0)
    library.option.setNumber("Mesh.Optimize", 0)
    library.option.setNumber("Mesh.MeshSizeMax", 0.2)
    library.option.setNumber("Mesh.Binary", 1)  # text would round coordinates
    yield library
    library.finalize()


@pytest.fixture
def boxes(gmsh):
    """Two glued boxes with named groups, meshed."""
    gmsh.model.add("boxes")
    left, right = gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1), gmsh.model.occ.addBox(1, 0, 0, 1, 1, 1)
    gmsh.model.occ.fragment([(3, left)], [(3, right)])
    gmsh.model.occ.synchronize()
    groups = [(3, [1], 10, "left steel"), (3, [2], 20, "right copper")]
    for number, name, low, high in PHYSICAL:
        groups.append((2, [tag for _, tag in gmsh.model.getEntitiesInBoundingBox(low, -1, -1, high, 2, 2, 2)], number, name))
    for dimension, tags, number, name in groups:
        gmsh.model.addPhysicalGroup(dimension, tags, number)
        gmsh.model.setPhysicalName(dimension, number, name)
    gmsh.model.mesh.generate(3)
    return gmsh


def contents(gmsh):
    """Names of groups, with the nodes of each element of a surface, and the volume of each region."""
    found = {}
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(tags)
    sorted_tags, points = tags[order], np.array(xyz).reshape(-1, 3)[order]
    for dimension, number in gmsh.model.getPhysicalGroups():
        name = gmsh.model.getPhysicalName(dimension, number)
        kind, width = {2: (2, 3), 3: (4, 4)}[dimension]
        nodes = np.concatenate([gmsh.model.mesh.getElementsByType(kind, tag)[1].reshape(-1, width)
                                for tag in gmsh.model.getEntitiesForPhysicalGroup(dimension, number)])
        at = points[np.searchsorted(sorted_tags, nodes)]
        found[(dimension, number, name)] = (
            sorted(map(bytes, at)) if dimension == 2 else round(float(np.abs(volumes(points, np.searchsorted(sorted_tags, nodes))).sum()), 9))
    return found


def test_gmsh_keeps_names_groups_and_classification(boxes, tmp_path):
    import tetmend.gmsh
    before = contents(boxes)
    entities = boxes.model.getEntities()
    sheets = {(d, t): list(boxes.model.mesh.getNodes(d, t)[0]) for d, t in entities if d < 3}
    result = tetmend.gmsh.improve()
    assert result.before.n_bad > 50 and result.after.n_bad == 0 and result.ending == "finished"
    assert len(before) == 5 and contents(boxes) == before
    assert boxes.model.getEntities() == entities
    assert {key: list(boxes.model.mesh.getNodes(*key)[0]) for key in sheets} == sheets
    assert sum(len(boxes.model.mesh.getElementsByType(4, volume)[0]) for volume in (1, 2)) == result.after.tets
    for volume in (1, 2):
        assert set(boxes.model.mesh.getNodes(3, volume)[0]) <= set(boxes.model.mesh.getElementsByType(4, volume)[1])
    boxes.write(str(tmp_path / "boxes.msh"))
    boxes.clear()
    boxes.open(str(tmp_path / "boxes.msh"))
    assert contents(boxes) == before
    saved = tetmend.load(tmp_path / "boxes.msh")
    assert tetmend.quality(saved).statistics.theta_min == pytest.approx(result.after.theta_min, abs=1e-9)
    # Once more, on what is there now: nothing bad is left, so little changes.
    assert tetmend.gmsh.improve().after.n_bad == 0


def test_gmsh_nodes_and_tets_that_stay_keep_their_tags(boxes):
    import tetmend.gmsh
    tags, nodes = boxes.model.mesh.getElementsByType(4)
    then = {tag: frozenset(four) for tag, four in zip(tags, nodes.reshape(-1, 4).tolist())}
    result = tetmend.gmsh.improve()
    tags, nodes = boxes.model.mesh.getElementsByType(4)
    now = {tag: frozenset(four) for tag, four in zip(tags, nodes.reshape(-1, 4).tolist())}
    same = [tag for tag in now if tag in then]
    assert len(same) == (result.tet_map >= 0).sum() > 0 and all(now[tag] == then[tag] for tag in same)


def test_gmsh_improves_the_volumes_that_are_named(boxes):
    import tetmend.gmsh
    before = contents(boxes)
    right = boxes.model.mesh.getElementsByType(4, 2)
    result = tetmend.gmsh.improve(tags=[1])
    assert result.before.n_bad > result.after.n_bad
    assert all(np.array_equal(then, now) for then, now in zip(right, boxes.model.mesh.getElementsByType(4, 2)))
    assert contents(boxes) == before
    with pytest.raises(ValueError, match=r"tags\[1\]: there is no volume 7: expected one of \[1, 2, 'left steel'"):
        tetmend.gmsh.improve(tags=[1, 7])
    left = boxes.model.mesh.getElementsByType(4, 1)
    for copper in (2, "right copper", [2, "right copper"]):
        tetmend.gmsh.improve(tags=copper)
        assert all(np.array_equal(then, now) for then, now in zip(left, boxes.model.mesh.getElementsByType(4, 1)))
    assert not all(np.array_equal(then, now) for then, now in zip(right, boxes.model.mesh.getElementsByType(4, 2)))


def test_gmsh_refuses_options_that_the_model_answers_and_leaves_it(boxes):
    import tetmend.gmsh
    before = contents(boxes)
    tets = boxes.model.mesh.getElementsByType(4)
    with pytest.raises(ValueError, match="surface: the elements of the model's surfaces stay"):
        tetmend.gmsh.improve(surface="3%")
    with pytest.raises(TypeError, match="takes no 'labels' here: the model has its own"):
        tetmend.gmsh.improve(labels=[1])
    with pytest.raises(TypeError, match="tags is 1.5, but the number or the name of a volume is wanted"):
        tetmend.gmsh.improve(1.5)
    with pytest.raises(ValueError, match="tags is empty"):
        tetmend.gmsh.improve([])
    assert contents(boxes) == before
    assert all(np.array_equal(then, now) for then, now in zip(tets, boxes.model.mesh.getElementsByType(4)))
    assert tetmend.gmsh.improve(np.int32(1), surface="fixed").ending == "finished"


def test_gmsh_keeps_what_is_embedded(gmsh):
    import tetmend.gmsh
    gmsh.model.add("embedded")
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.09)
    box = gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    sheet = gmsh.model.occ.addRectangle(0.3, 0.3, 0.5, 0.4, 0.4)
    point = gmsh.model.occ.addPoint(0.2, 0.2, 0.2)
    line = gmsh.model.occ.addLine(gmsh.model.occ.addPoint(0.8, 0.2, 0.1), gmsh.model.occ.addPoint(0.85, 0.8, 0.9))
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.setTransfiniteCurve(line, 3)  # long edges, which a run would like to remove
    gmsh.model.mesh.embed(2, [sheet], 3, box)
    gmsh.model.mesh.embed(1, [line], 3, box)
    gmsh.model.mesh.embed(0, [point], 3, box)
    gmsh.model.mesh.generate(3)
    kept = {key: gmsh.model.mesh.getNodes(*key, True) for key in ((2, sheet), (1, line), (0, point))}
    result = tetmend.gmsh.improve(goal=(45, 125))  # touches as much as it can
    assert result.touched_tets > result.after.tets / 2
    faces = {frozenset(face) for four in gmsh.model.mesh.getElementsByType(4)[1].reshape(-1, 4).tolist()
             for face in (four[1:], four[:1] + four[2:], four[:2] + four[3:], four[:3])}
    assert all(frozenset(three) in faces for three in gmsh.model.mesh.getElementsByType(2, sheet)[1].reshape(-1, 3).tolist())
    edges = {pair for face in faces for pair in ({frozenset((a, b)) for a in face for b in face if a != b})}
    assert all(frozenset(two) in edges for two in gmsh.model.mesh.getElementsByType(1, line)[1].reshape(-1, 2).tolist())
    for key, (tags, xyz, _) in kept.items():
        now = gmsh.model.mesh.getNodes(*key, True)
        assert np.array_equal(tags, now[0]) and np.array_equal(xyz, now[1])


@pytest.fixture
def ball_in_a_box(gmsh):
    """Two volumes that share a sphere, of second order."""
    gmsh.model.add("curved")
    box, ball = gmsh.model.occ.addBox(-1, -1, -1, 2, 2, 2), gmsh.model.occ.addSphere(0, 0, 0, 0.5)
    gmsh.model.occ.fragment([(3, box)], [(3, ball)])
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.25)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    return gmsh


def test_gmsh_improves_curved_tets_and_keeps_the_curved_surface(ball_in_a_box, tmp_path):
    import tetmend.gmsh
    mesh, model = ball_in_a_box.model.mesh, ball_in_a_box.model
    fixed = {key: mesh.getNodes(*key) for key in model.getEntities() if key[0] < 3}
    faces = {tag: mesh.getElementsByType(9, tag) for _, tag in model.getEntities(2)}
    volumes = [tag for _, tag in model.getEntities(3)]
    result = tetmend.gmsh.improve()
    assert result.before.n_bad > result.after.n_bad and result.tets.shape[1] == 10
    for key, (tags, points, _) in fixed.items():
        now = mesh.getNodes(*key)
        assert np.array_equal(now[0], tags) and np.array_equal(now[1], points)
    for tag, (tags, nodes) in faces.items():
        now = mesh.getElementsByType(9, tag)
        assert np.array_equal(now[0], tags) and np.array_equal(now[1], nodes)
    # Gmsh's own judgement: all curved tets are positive, at the corners, too.
    places = np.append(mesh.getIntegrationPoints(11, "Gauss8")[0], [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1])
    signs = np.concatenate([mesh.getJacobians(11, places, volume)[1] for volume in volumes])
    assert len(signs) == result.after.tets * len(places) / 3 and signs.min() > 0
    on_file, xyz, _ = mesh.getNodes()
    middle = dict(zip(on_file.tolist(), np.array(xyz).reshape(-1, 3)))
    for four in mesh.getElementsByType(11, volumes[0])[1].reshape(-1, 10)[:200].tolist():
        ends = [(0, 1), (1, 2), (2, 0), (0, 3), (2, 3), (1, 3)]  # in Gmsh's order of nodes
        for (a, b), node in zip(ends, four[4:]):
            chord = np.linalg.norm(middle[four[a]] - middle[four[b]])
            assert np.linalg.norm(middle[node] - (middle[four[a]] + middle[four[b]]) / 2) < 0.2 * chord
    ball_in_a_box.write(str(tmp_path / "curved.msh"))
    assert tetmend.quality(tetmend.load(tmp_path / "curved.msh")).statistics.tets == result.after.tets


def test_gmsh_refuses_what_it_cannot_keep_and_leaves_it(gmsh):
    import tetmend.gmsh
    with pytest.raises(ValueError, match="no tets in memory"):
        tetmend.gmsh.improve()
    gmsh.model.add("cubic")
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(3)
    before = gmsh.model.mesh.getElements()[2]
    with pytest.raises(ValueError, match="volume 1 has elements 'Tetrahedron 20'"):
        tetmend.gmsh.improve()
    assert all(np.array_equal(then, now) for then, now in zip(before, gmsh.model.mesh.getElements()[2]))


# --- meshio


def test_meshio_keeps_blocks_data_sets_and_fields(tmp_path):
    meshio = pytest.importorskip("meshio")
    import tetmend.meshio
    points, tets, side = lattice(5)
    left, right = tets[side == 0], tets[side == 1]
    wall = np.array([[0, 1, 6], [1, 7, 6]])
    faces = np.sort(np.concatenate([tets[:, k] for k in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])]), axis=1)
    rows, counts = np.unique(faces, axis=0, return_counts=True)
    wall = rows[counts == 1][:20]
    core = np.flatnonzero(points[left].mean(axis=1)[:, 1] > 0.5)
    mesh = meshio.Mesh(
        points, [("tetra", left), ("triangle", wall), ("tetra", right), ("vertex", [[0], [3]])],
        point_data={"linear": points @ [1.0, 2.0, 3.0], "vector": points.astype(np.float32)},
        cell_data={"gmsh:physical": [np.full(len(left), 7), np.full(20, 3), np.full(len(right), 9), np.array([1, 2])],
                   "heat": [np.full(len(left), 1.5), np.zeros(20), np.full(len(right), 2.5), np.zeros(2)]},
        field_data={"steel": np.array([7, 3]), "inlet": np.array([3, 2])},
        cell_sets={"core": [core, np.empty(0, int), np.empty(0, int), np.empty(0, int)],
                   "inlet": [np.empty(0, int), np.arange(5), np.empty(0, int), np.array([1])]},
        point_sets={"corners": np.array([0, 5])})
    better = tetmend.meshio.improve(mesh, threads=2)
    result = better.tetmend_result
    assert result.before.n_bad > 50 > result.after.n_bad
    assert [block.type for block in better.cells] == ["tetra", "triangle", "tetra", "vertex"]
    for i, number, heat in ((0, 7, 1.5), (2, 9, 2.5)):
        assert (better.cell_data["gmsh:physical"][i] == number).all() and (better.cell_data["heat"][i] == heat).all()
        assert volumes(better.points, better.cells[i].data).sum() == pytest.approx(1)
    assert np.array_equal(better.points[better.cells[1].data], points[wall])
    assert np.array_equal(better.points[better.cells[3].data], points[[[0], [3]]])
    assert np.allclose(better.point_data["linear"], better.points @ [1.0, 2.0, 3.0])
    assert better.point_data["vector"].dtype == np.float32
    inside = better.cell_sets["core"][0]
    assert volumes(better.points, better.cells[0].data[inside]).sum() == pytest.approx(volumes(points, left[core]).sum())
    assert list(better.cell_sets["inlet"][1]) == [0, 1, 2, 3, 4] and list(better.cell_sets["inlet"][3]) == [1]
    assert better.field_data is mesh.field_data
    assert np.array_equal(better.points[better.point_sets["corners"]], points[[0, 5]])
    better.write(tmp_path / "better.vtu")
    assert len(meshio.read(tmp_path / "better.vtu").points) == len(better.points)
    assert tetmend.meshio.improve(mesh, protect="label:7").tetmend_result.figures["protected"]["tets"] == len(left)


def test_meshio_files_of_gmsh_come_back_whole(tmp_path, boxes):
    meshio = pytest.importorskip("meshio")
    import tetmend.meshio
    before = contents(boxes)
    boxes.write(str(tmp_path / "boxes.msh"))
    mesh = meshio.read(tmp_path / "boxes.msh")
    better = tetmend.meshio.improve(mesh, schedule="thorough")
    assert better.tetmend_result.after.n_bad == 0
    # Not cells: signed tags of entities.
    bounding = "gmsh:bounding_entities"
    assert any((np.asarray(tags) < 0).any() for tags in mesh.cell_sets[bounding] if tags is not None)
    for given, carried in zip(mesh.cell_sets[bounding], better.cell_sets[bounding], strict=True):
        assert np.array_equal(given, carried)
    tags = better.point_data["gmsh:dim_tags"]
    kept = better.tetmend_result.vertex_map
    is_new = ~np.isin(np.arange(len(tags)), kept)
    assert is_new.any() and (tags[is_new, 0] == 3).all() and (tags[is_new, 1] == 1 + (better.points[is_new, 0] > 1)).all()
    meshio.write(tmp_path / "better.msh", better, file_format="gmsh", binary=False)
    boxes.clear()
    boxes.open(str(tmp_path / "better.msh"))
    assert {key: value for key, value in contents(boxes).items() if key[0] == 3} == \
        {key: value for key, value in before.items() if key[0] == 3}


def test_meshio_has_tets_of_second_order_improved(boxes, tmp_path):
    meshio = pytest.importorskip("meshio")
    import tetmend.meshio
    boxes.model.mesh.setOrder(2)
    boxes.write(str(tmp_path / "curved.msh"))
    mesh = meshio.read(tmp_path / "curved.msh")
    kinds = [block.type for block in mesh.cells]
    assert {"tetra10", "triangle6"} <= set(kinds)
    better = tetmend.meshio.improve(mesh)
    assert [block.type for block in better.cells] == kinds
    result = better.tetmend_result
    assert result.after.n_bad < result.before.n_bad and result.after.second_order["mid_nodes"] > 0
    for old, new in zip(mesh.cells, better.cells):
        if new.type == "tetra10":
            ends = better.points[new.data[:, [2, 3]]].mean(axis=1)
            assert np.allclose(better.points[new.data[:, 9]], ends)
        elif new.type == "triangle6":
            assert np.array_equal(better.points[new.data], mesh.points[old.data])


def test_meshio_refuses_what_it_cannot_keep():
    meshio = pytest.importorskip("meshio")
    import tetmend.meshio
    with pytest.raises(ValueError, match="tetra20"):
        tetmend.meshio.improve(meshio.Mesh(np.random.rand(20, 3), [("tetra20", [range(20)])]))
    with pytest.raises(ValueError, match="of one order"):
        tetmend.meshio.improve(meshio.Mesh(np.random.rand(10, 3), [("tetra10", [range(10)]), ("tetra", [range(4)])]))
    with pytest.raises(ValueError, match="no tets"):
        tetmend.meshio.improve(meshio.Mesh(np.random.rand(3, 3), [("triangle", [[0, 1, 2]])]))
    with pytest.raises(ValueError, match=r"cell_sets\['s'\]\[0\]\[1\] is 9, but the block has 1 cells"):
        tetmend.meshio.improve(meshio.Mesh(np.random.rand(4, 3), [("tetra", [range(4)])], cell_sets={"s": [np.array([0, 9])]}))
    with pytest.raises(TypeError, match="takes a mesh of meshio, not str"):
        tetmend.meshio.improve("part.msh")
    with pytest.raises(ValueError, match="label_array"):
        tetmend.meshio.improve(meshio.Mesh(*lattice(1)[:1], [("tetra", lattice(1)[1])]), label_array="nothing")
    points, tets, _ = lattice(2)
    sheet = meshio.Mesh(points, [("tetra", tets), ("triangle", tets[:1, :3])], cell_data={"heat": [np.ones(len(tets)), np.ones(1)]})
    with pytest.raises(ValueError, match="surface: cells of kind 'triangle' stay as they are"):
        tetmend.meshio.improve(sheet, surface="1%")
    with pytest.raises(ValueError, match="label_array: the data 'heat' of the tets have type float64"):
        tetmend.meshio.improve(sheet, label_array="heat")
    with pytest.raises(TypeError, match="takes no 'point_data' here: the mesh has its own"):
        tetmend.meshio.improve(sheet, point_data={})


def test_the_surface_of_tets_alone_may_move():
    meshio = pytest.importorskip("meshio")
    import tetmend.meshio
    points, tets, side = lattice(4)
    mesh = meshio.Mesh(points, [("tetra", tets)], cell_data={"material": [side + 1]})
    better = tetmend.meshio.improve(mesh, surface="1%")
    assert better.cells[0].data.min() >= 0 and volumes(better.points, better.cells[0].data).sum() == pytest.approx(2, rel=1e-2)


# --- VTK, ParaView


def grid_of(points, tets, side):
    """With a prism's worth of other cells: triangles on the surface, a vertex, and data."""
    vtk = pytest.importorskip("vtkmodules.all")
    from vtkmodules.util.numpy_support import numpy_to_vtk
    faces = np.sort(np.concatenate([tets[:, k] for k in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])]), axis=1)
    rows, counts = np.unique(faces, axis=0, return_counts=True)
    grid = vtk.vtkUnstructuredGrid()
    nodes = vtk.vtkPoints()
    nodes.SetDataTypeToDouble()
    for p in points:
        nodes.InsertNextPoint(p)
    grid.SetPoints(nodes)
    for kind, cells in ((5, rows[counts == 1][:12]), (10, tets), (1, [[4]])):
        for cell in cells:
            grid.InsertNextCell(kind, len(cell), list(map(int, cell)))
    for attributes, name, values in (
            (grid.GetCellData(), "material", np.concatenate([np.zeros(12, int), side + 1, [0]])),
            (grid.GetCellData(), "weight", np.linspace(0, 1, len(tets) + 13)),
            (grid.GetPointData(), "linear", points @ [1.0, 2.0, 3.0])):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        attributes.AddArray(array)
    note = vtk.vtkStringArray()
    note.SetName("note")
    note.InsertNextValue("mine")
    grid.GetFieldData().AddArray(note)
    return grid


def check_grid(better, points, side):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    types = vtk_to_numpy(better.GetCellTypesArray())
    assert (types == 5).sum() == 12 and (types == 1).sum() == 1
    material = vtk_to_numpy(better.GetCellData().GetArray("material"))
    at = vtk_to_numpy(better.GetPoints().GetData())
    offsets = vtk_to_numpy(better.GetCells().GetOffsetsArray())
    nodes = vtk_to_numpy(better.GetCells().GetConnectivityArray())
    tets = nodes[offsets[:-1][types == 10][:, None] + np.arange(4)]
    for label in (1, 2):
        assert volumes(at, tets[material[types == 10] == label]).sum() == pytest.approx(1)
    assert np.allclose(vtk_to_numpy(better.GetPointData().GetArray("linear")), at @ [1.0, 2.0, 3.0])
    assert np.array_equal(at[nodes[offsets[:-1][types == 1]]][0], points[4])
    assert better.GetFieldData().GetAbstractArray("note").GetValue(0) == "mine"
    return tetmend.quality(at, tets).statistics


def test_vtk_grids_come_back_with_their_cells_and_data():
    points, tets, side = lattice(4)
    grid = grid_of(points, tets, side)
    import tetmend.vtk
    better = tetmend.vtk.improve(grid)
    assert check_grid(better, points, side).n_bad < 20 < better.tetmend_result.before.n_bad
    assert grid.GetNumberOfCells() == len(tets) + 13
    text = importlib.import_module("vtkmodules.all").vtkStringArray()
    text.SetName("words")
    text.SetNumberOfValues(len(points))
    grid.GetPointData().AddArray(text)
    with pytest.raises(TypeError, match="takes a vtkUnstructuredGrid, not vtkPolyData"):
        tetmend.vtk.improve(importlib.import_module("vtkmodules.all").vtkPolyData())
    with pytest.raises(ValueError, match="'words' are no numbers"):
        tetmend.vtk.improve(grid)


def test_the_paraview_macro_does_the_same_in_a_programmable_filter():
    points, tets, side = lattice(4)
    grid = grid_of(points, tets, side)
    vtk = importlib.import_module("vtkmodules.all")
    macro = runpy.run_path(str(SOURCE / "bindings/python/paraview/tetmend_improve.py"))
    programmable = vtk.vtkProgrammableFilter()
    programmable.SetInputData(grid)
    programmable.SetExecuteMethod(lambda: macro["execute"](programmable))
    programmable.Update()
    assert check_grid(programmable.GetUnstructuredGridOutput(), points, side).n_bad < 20


IN_PARAVIEW = """
import sys
from paraview import simple
read = simple.XMLUnstructuredGridReader(FileName=[sys.argv[1]])
simple.SetActiveSource(read)
simple.Show(read)
with open(sys.argv[2]) as file:
    exec(compile(file.read(), sys.argv[2], "exec"), {"__name__": "__vtkconsole__"})  # as ParaView runs a macro
made = simple.FindSource("tetmend")
made.UpdatePipeline()
for proxy in (read, made):
    about = proxy.GetDataInformation()
    print("cells", about.GetNumberOfCells(), "points", about.GetNumberOfPoints(), "data", [array.GetName() for array in proxy.CellData])
"""


def test_the_macro_runs_in_paraview_itself(tmp_path, command_line):
    pvbatch, server = shutil.which("pvbatch"), shutil.which("Xvfb")
    if not pvbatch or not server:
        pytest.skip("pvbatch or Xvfb is not installed")
    mesh = tmp_path / "sheet.vtu"
    command_line("convert", SOURCE / "assets/meshes/sheet.mesh", mesh)
    command_line("improve", mesh, "-o", tmp_path / "better.vtu", "--schedule", "shell", "--goal", "30,150", "--quiet")
    script = tmp_path / "in_paraview.py"
    script.write_text(IN_PARAVIEW)
    ours, theirs = os.pipe()
    display = subprocess.Popen([server, "-displayfd", str(theirs), "-screen", "0", "800x600x24", "-noreset"], pass_fds=[theirs], stderr=subprocess.DEVNULL)
    try:
        os.close(theirs)
        with os.fdopen(ours) as pipe:
            number = pipe.readline().strip()
        package = str(Path(tetmend._core.__file__).parent.parent)  # of a build, the rest is linked from the source
        done = subprocess.run([pvbatch, script, mesh, SOURCE / "bindings/python/paraview/tetmend_improve.py"], capture_output=True, text=True,
                              timeout=300, env={**os.environ, "DISPLAY": f":{number}", "PYTHONPATH": package})
    finally:
        display.terminate()
        display.wait()
    assert done.returncode == 0, done.stderr
    before, after = re.findall(r"cells (\d+) points (\d+) data (.*)", done.stdout)
    assert before[2] == after[2]
    given, made = tetmend.load(mesh), tetmend.load(tmp_path / "better.vtu")
    assert int(before[1]) == len(given.points) and int(after[1]) == len(made.points) != len(given.points)
    assert int(after[0]) - len(made.tets) == int(before[0]) - len(given.tets)


# --- PyVista


class StubGrid:
    """What of PyVista's grid the accessor uses."""

    def __init__(self, cells, celltypes, points):
        self.cells, self.celltypes, self.points = np.asarray(cells), np.asarray(celltypes), np.asarray(points)
        self.point_data, self.cell_data, self.field_data = {}, {}, {}
        offset, at = [0], 0
        keep = np.ones(len(self.cells), bool)
        for _ in self.celltypes:
            keep[at] = False
            offset.append(offset[-1] + int(self.cells[at]))
            at += 1 + int(self.cells[at])
        assert at == len(self.cells)
        self.offset, self.cell_connectivity = np.array(offset), self.cells[keep]

    @property
    def cells_dict(self):
        starts = self.offset[:-1]
        return {kind: np.array([self.cell_connectivity[a:b] for a, b, k in zip(starts, self.offset[1:], self.celltypes) if k == kind])
                for kind in np.unique(self.celltypes)}


def vtk_grid_class():
    """As PyVista's class: VTK's own grid with arrays in and out. It takes no new attributes."""
    vtk = pytest.importorskip("vtkmodules.all")
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

    class Attributes:
        def __init__(self, attributes):
            self.attributes = attributes

        def keys(self):
            return [self.attributes.GetAbstractArray(i).GetName() for i in range(self.attributes.GetNumberOfArrays())]

        def __getitem__(self, name):
            array = self.attributes.GetAbstractArray(name)
            return [array.GetValue(i) for i in range(array.GetNumberOfValues())] if array.IsA("vtkStringArray") else vtk_to_numpy(array)

        def __setitem__(self, name, values):
            if isinstance(values, list):
                array = vtk.vtkStringArray()
                for value in values:
                    array.InsertNextValue(value)
            else:
                array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
            array.SetName(name)
            self.attributes.AddArray(array)

    class Grid(vtk.vtkUnstructuredGrid):
        def __init__(self, cells, celltypes, points):
            super().__init__()
            nodes, made = vtk.vtkPoints(), vtk.vtkCellArray()
            nodes.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
            made.ImportLegacyFormat(numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, np.int64), deep=True))
            self.SetPoints(nodes)
            self.SetCells(numpy_to_vtk(np.asarray(celltypes, np.uint8), deep=True), made)

        def __setattr__(self, name, value):
            raise AttributeError(f"a grid of PyVista takes no new attribute {name}")

        points = property(lambda self: vtk_to_numpy(self.GetPoints().GetData()))
        cell_connectivity = property(lambda self: vtk_to_numpy(self.GetCells().GetConnectivityArray()))
        offset = property(lambda self: vtk_to_numpy(self.GetCells().GetOffsetsArray()))
        celltypes = property(lambda self: vtk_to_numpy(self.GetCellTypesArray()))
        point_data = property(lambda self: Attributes(self.GetPointData()))
        cell_data = property(lambda self: Attributes(self.GetCellData()))
        field_data = property(lambda self: Attributes(self.GetFieldData()))
        cells_dict = StubGrid.cells_dict

    return Grid


@pytest.fixture(params=["arrays", "VTK", "VTK, with a register"])
def stub(request, monkeypatch):
    """In place of PyVista: its grid of arrays alone, or on VTK's; older, or with the register of 0.48."""
    library = types.ModuleType("pyvista")
    library.UnstructuredGrid = type("UnstructuredGrid", (StubGrid,), {}) if request.param == "arrays" else vtk_grid_class()
    if "register" in request.param:
        def register_dataset_accessor(name, target):
            class Once:  # one accessor for each grid, as PyVista keeps it
                def __get__(self, grid, owner):
                    return accessors.setdefault(id(grid), accessor[0](grid))

            accessors, accessor = {}, []

            def decorate(given):
                accessor.append(given)
                setattr(target, name, Once())
                return given
            return decorate
        library.register_dataset_accessor = register_dataset_accessor
    monkeypatch.setitem(sys.modules, "pyvista", library)
    monkeypatch.delitem(sys.modules, "tetmend.pyvista", raising=False)
    importlib.import_module("tetmend.pyvista")
    yield library
    sys.modules.pop("tetmend.pyvista", None)


def test_pyvista_grids_have_an_accessor_that_keeps_data_and_result(stub):
    points, tets, side = lattice(4)
    flat = np.concatenate([[3, *tets[0][:3]], np.insert(tets, 0, 4, axis=1).ravel()])
    grid = stub.UnstructuredGrid(flat, [5] + [10] * len(tets), points)
    grid.cell_data["material"] = np.concatenate([[0], side + 1])
    grid.point_data["linear"] = points @ [1.0, 2.0, 3.0]
    grid.field_data["note"] = ["mine"]
    before = grid.tetmend.quality().statistics
    better = grid.tetmend.improve(threads=2)
    assert type(better) is stub.UnstructuredGrid and better.tetmend.quality().statistics.n_bad < 20 < before.n_bad
    now = better.cells_dict[10]
    for label in (1, 2):
        assert volumes(better.points, now[better.cell_data["material"][1:] == label]).sum() == pytest.approx(1)
    assert np.allclose(better.point_data["linear"], better.points @ [1.0, 2.0, 3.0]) and better.field_data["note"] == ["mine"]
    assert len(better.cells_dict[5]) == 1
    result = better.tetmend.result
    assert result.after.n_bad == better.tetmend.quality().statistics.n_bad and len(result.vertex_map) == len(points)
    assert grid.tetmend.result is None
    again = better.tetmend.improve()
    assert again.tetmend.result.before.n_bad == result.after.n_bad and better.tetmend.result is result
    from package_test import of_second_order
    curved, rows = of_second_order(points, tets)
    of_ten = stub.UnstructuredGrid(np.insert(rows, 0, 10, axis=1).ravel(), [24] * len(rows), curved)
    assert of_ten.tetmend.quality().statistics.n_bad == before.n_bad


def test_pyvista_forgets_a_result_with_its_grid(stub):
    points, tets, _ = lattice(3)
    better = stub.UnstructuredGrid(np.insert(tets, 0, 4, axis=1).ravel(), [10] * len(tets), points).tetmend.improve()
    results = sys.modules["tetmend.pyvista"]._results
    assert len(results) == 1
    del better
    if not hasattr(stub, "register_dataset_accessor"):  # the stand-in keeps accessors, and these their grids
        assert not results


def test_pyvista_reads_files_that_it_does_not_know(stub, tmp_path):
    module = sys.modules["tetmend.pyvista"]
    mesh = tetmend.load(SOURCE / "assets/meshes/two_materials.mesh")
    mesh.save(tmp_path / "part.vol")
    with pytest.warns(UserWarning, match="triangles with labels are not in the grid"):
        grid = module.read(tmp_path / "part.vol")
    assert len(grid.cells_dict[10]) == len(mesh.tets) and set(grid.cell_data["label"]) == set(mesh.labels)
    assert grid.tetmend.improve(label_array="label").tetmend.result.after.n_bad < 100
    with pytest.raises(FileNotFoundError):
        module.read(tmp_path / "none.vol")


def test_what_entry_points_name_is_there(stub):
    tomllib = pytest.importorskip("tomllib")
    points = tomllib.loads((SOURCE / "pyproject.toml").read_text())["project"]["entry-points"]
    assert set(points) == {"pyvista.accessors", "pyvista.readers"}
    for value in [value for names in points.values() for value in names.values()]:
        module, _, name = value.partition(":")
        found = importlib.import_module(module)
        assert not name or callable(getattr(found, name))
    known = {extension for each in tetmend.formats() for extension in ([each] if isinstance(each, str) else each)}
    assert set(points["pyvista.readers"]) <= known


# --- DOLFINx


@pytest.fixture
def tagged_boxes(boxes):
    """Two boxes with tags of cells and facets, of which some have none."""
    pytest.importorskip("dolfinx")
    from dolfinx.io import gmshio
    from mpi4py import MPI
    mesh, cells, facets = gmshio.model_to_mesh(boxes.model, MPI.COMM_SELF, 0)
    return mesh, cells, facets


def measures(mesh, tags, dimension):
    """Volumes or areas by tag, from corners alone."""
    mesh.topology.create_connectivity(dimension, 3)
    from tetmend.dolfinx import _nodes_of_facets, _rows
    nodes = (_rows(mesh.geometry.dofmap, 4) if dimension == 3 else _nodes_of_facets(mesh))[tags.indices]
    p = mesh.geometry.x[nodes]
    sizes = np.abs(np.linalg.det(p[:, 1:] - p[:, :1])) / 6 if dimension == 3 else \
        np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    return {int(tag): float(sizes[tags.values == tag].sum()) for tag in np.unique(tags.values)}


def test_dolfinx_keeps_tags_of_cells_and_facets(tagged_boxes):
    import tetmend.dolfinx
    mesh, cells, facets = tagged_boxes
    better = tetmend.dolfinx.improve(mesh, cells, facets, threads=2)
    assert better.result.before.n_bad > 50 and better.result.after.n_bad == 0
    for old, new, dimension in ((cells, better.cell_tags, 3), (facets, better.facet_tags, 2)):
        assert measures(better.mesh, new, dimension) == pytest.approx(measures(mesh, old, dimension))
        assert np.array_equal(new.indices, np.unique(new.indices)) and new.dim == dimension
    assert len(better.cell_tags.indices) == better.result.after.tets == better.mesh.topology.index_map(3).size_local
    made = tetmend.quality(better.mesh.geometry.x, np.asarray(getattr(better.mesh.geometry.dofmap, "array", better.mesh.geometry.dofmap)).reshape(-1, 4))
    assert made.statistics.n_bad == 0 and made.statistics.theta_min == pytest.approx(better.result.after.theta_min)
    # The points, in the order that the docstring promises.
    order = np.asarray(better.mesh.geometry.input_global_indices)
    assert np.array_equal(better.mesh.geometry.x, better.result.points[order])


def test_dolfinx_keeps_cells_without_a_tag_apart(tagged_boxes):
    import tetmend.dolfinx
    from dolfinx.mesh import meshtags
    mesh, cells, _ = tagged_boxes
    left = cells.indices[cells.values == cells.values.min()]
    some = meshtags(mesh, 3, left, np.full(len(left), 5, np.int32))
    better = tetmend.dolfinx.improve(mesh, some)
    assert better.facet_tags is None
    assert measures(better.mesh, better.cell_tags, 3) == pytest.approx({5: 1.0})
    assert len(better.cell_tags.indices) < better.result.after.tets
    zero = meshtags(mesh, 3, left, np.zeros(len(left), np.int32))  # the value that cells without a tag might have
    assert measures(mesh, tetmend.dolfinx.improve(mesh, zero).cell_tags, 3).keys() == {0}


def test_dolfinx_refuses_other_cells_and_tags_of_another_dimension(tagged_boxes):
    import tetmend.dolfinx
    from dolfinx.mesh import create_unit_square
    mesh, cells, facets = tagged_boxes
    with pytest.raises(ValueError, match="other cells than tets of first order"):
        tetmend.dolfinx.improve(create_unit_square(mesh.comm, 2, 2))
    with pytest.raises(ValueError, match="cell_tags are of dimension 2, but 3 is wanted"):
        tetmend.dolfinx.improve(mesh, facets)
    with pytest.raises(TypeError, match="takes no 'labels' here"):
        tetmend.dolfinx.improve(mesh, labels=[1])
    with pytest.raises(ValueError, match="surface: facets with tags stay"):
        tetmend.dolfinx.improve(mesh, cells, facets, surface="1%")


# --- Meshers


CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
SIDES = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])


def finer(points, triangles):
    """Each triangle becomes four."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    rows, inverse = np.unique(edges, axis=0, return_inverse=True)
    ab, bc, ca = len(points) + inverse.reshape(3, -1)
    a, b, c = triangles.T
    return (np.concatenate([points, points[rows].mean(axis=1)]),
            np.concatenate([np.stack(each, axis=1) for each in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]))


@pytest.fixture
def cube():
    """Turned and stretched by thirds, so that no coordinate is short."""
    points, triangles = finer(*finer(*finer(CORNERS, SIDES)))
    return points @ np.array([[2 / 3, 0.1, 0], [-0.1, 1 / 3, 0.05], [0, 1 / 7, 1]]), triangles


@pytest.mark.parametrize("mesher", ["gmsh", "tetgen"])
def test_a_surface_is_filled_and_its_triangles_stay_bit_for_bit(cube, mesher):
    if shutil.which(mesher) is None:
        pytest.skip(f"{mesher} is not installed")
    points, triangles = cube
    result = tetmend.from_surface(cube, mesher)
    assert result.after.tets > 300 and result.after.n_bad < result.before.n_bad
    rows, counts = np.unique(np.sort(np.concatenate([result.tets[:, k] for k in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])]), axis=1),
                             axis=0, return_counts=True)
    wanted = {tuple(sorted(map(tuple, face))) for face in points[triangles].tolist()}
    assert {tuple(sorted(map(tuple, face))) for face in result.points[rows[counts == 1]].tolist()} == wanted
    fine = tetmend.from_surface(cube, mesher, size=0.06)
    assert fine.after.tets > 1.5 * result.after.tets


def test_files_of_stl_are_read_in_both_forms(cube, tmp_path):
    points, triangles = cube
    corners = points[triangles].astype(np.float32)
    record = np.zeros(len(triangles), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]))
    record["corners"] = corners
    (tmp_path / "binary.stl").write_bytes(b"solid, though it is binary".ljust(80) + len(record).to_bytes(4, "little") + record.tobytes())
    text = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex " + " ".join(map(repr, map(float, p))) + "\n" for p in three) +
                   "endloop\nendfacet\n" for three in corners)
    (tmp_path / "text.STL").write_text(f"solid cube\n{text}endsolid cube\n")
    from tetmend._surface import _read_stl
    for name in ("binary.stl", "text.STL"):
        read, numbers = _read_stl(tmp_path / name)
        assert len(read) == len(points) and np.array_equal(read[numbers], corners.astype(float)), name
    if shutil.which("tetgen"):
        assert tetmend.from_surface(tmp_path / "binary.stl", "tetgen").ending == "finished"


def test_a_surface_that_cannot_be_filled_is_refused_with_its_reason(cube, tmp_path, monkeypatch):
    points, triangles = cube
    with pytest.raises(ValueError, match="the surface is not closed: the edge of points .* has 1 triangle, and 3 edges are like it"):
        tetmend.from_surface((points, triangles[1:]))
    with pytest.raises(ValueError, match=r"triangles\[0, 1\] is 999, but there are 386 points"):
        tetmend.from_surface((points, np.array([[0, 999, 1]])))
    with pytest.raises(ValueError, match="mesher is 'tetwild': expected one of"):
        tetmend.from_surface(cube, "tetwild")
    with pytest.raises(FileNotFoundError, match="none.stl"):
        tetmend.from_surface(tmp_path / "none.stl")
    with pytest.raises(ValueError, match="of files from_surface\\(\\) reads .stl"):
        tetmend.from_surface("part.step")
    (tmp_path / "empty.stl").write_text("solid nothing\nendsolid\n")
    with pytest.raises(ValueError, match="empty.stl: no STL file"):
        tetmend.from_surface(tmp_path / "empty.stl")
    if shutil.which("tetgen"):  # two cubes through each other
        both = np.concatenate([points, points + 0.1]), np.concatenate([triangles, triangles + len(points)])
        with pytest.raises(ValueError, match="tetgen (could not fill|did not keep) the surface"):
            tetmend.from_surface(both, "tetgen")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ValueError, match="mesher: gmsh and tetgen are not installed, or not in PATH"):
        tetmend.from_surface(cube)
