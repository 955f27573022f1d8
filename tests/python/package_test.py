# SPDX-License-Identifier: MIT
"""The package: arrays in and out, errors with their place, threads, signals, and the same bytes as the command line."""

import ast
import concurrent.futures
import copy
import doctest
import html
import importlib
import json
import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import tetmend
from conftest import BUILD, MATERIALS, SOURCE
from tetmend import _core

TET = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])


def volumes(points, tets):
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    return np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)) / 6


# --- arrays


@pytest.mark.parametrize("integer", [np.int32, np.int64, np.uint32, np.uint64, np.int16])
def test_arrays_come_back_contiguous_and_of_the_type_that_was_given(arrays, integer):
    result = tetmend.improve(arrays["points"], arrays["tets"].astype(integer), labels=arrays["labels"])
    assert result.tets.dtype == integer and result.tets.shape[1] == 4 and result.tets.flags.c_contiguous
    assert result.points.dtype == np.float64 and result.points.flags.c_contiguous
    assert result.labels.shape == (len(result.tets),)
    assert result.ending == "finished" and result.after.n_bad == 0 < result.before.n_bad
    assert result.tets.max() < len(result.points)


def test_what_goes_in_stays_as_it_is_and_what_comes_out_cannot_be_written(arrays):
    before = {name: values.copy() for name, values in arrays.items()}
    result = tetmend.improve(**arrays)
    assert all(np.array_equal(before[name], arrays[name]) for name in arrays)
    with pytest.raises(ValueError, match="read-only"):
        result.points[0, 0] = 1


def test_arrays_outlive_their_mesh(arrays):
    points = tetmend.improve(**arrays).points
    assert np.isfinite(points).all() and len(points) > 1000


def of_second_order(points, tets):
    """The same with a node in the middle of each edge."""
    ends = np.sort(np.concatenate([tets[:, pair] for pair in ([0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3])]), axis=1)
    edges, number = np.unique(ends, axis=0, return_inverse=True)
    nodes = len(points) + number.reshape(6, -1).T
    return np.concatenate([points, points[edges].mean(axis=1)]), np.concatenate([tets, nodes], axis=1)


def test_rows_of_ten_are_tets_of_second_order_and_come_back_so(arrays, tmp_path):
    points, tets = of_second_order(arrays["points"], arrays["tets"])
    faces = np.sort(tets[:, [0, 1, 2]], axis=1)
    every = np.sort(np.concatenate([tets[:, corners] for corners in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])]), axis=1)
    unique, count = np.unique(every, axis=0, return_counts=True)
    outer = {tuple(face) for face in unique[count == 1]}
    on_surface = next(row[4] for row, face in zip(tets, faces) if tuple(face) in outer)
    points[on_surface] += 1e-3  # curves the surface there
    result = tetmend.improve(points, tets, labels=arrays["labels"], point_data={"x": points[:, 0]})
    assert result.tets.shape == (result.after.tets, 10) and result.tets.dtype == tets.dtype
    assert result.after.n_bad < result.before.n_bad
    assert result.before.second_order["curved"] > 0 < result.after.second_order["curved"]
    assert np.array_equal(result.points[result.vertex_map[on_surface]], points[on_surface])
    assert result.vertex_map.shape == (len(points),) and result.tets.max() == len(result.points) - 1
    assert np.allclose(result.points[result.tets[:, 4]], result.points[result.tets[:, :2]].mean(axis=1), atol=2e-3)
    assert np.allclose(result.points[result.tets[:, 9]], result.points[result.tets[:, 2:4]].mean(axis=1), atol=2e-3)
    assert np.allclose(result.point_data["x"], result.points[:, 0], atol=2e-3)
    # The same by way of a file.
    tetmend.Mesh(points, tets, labels=arrays["labels"]).save(tmp_path / "curved.vtu")
    loaded = tetmend.load(tmp_path / "curved.vtu")
    assert loaded.tets.shape == tets.shape
    again = tetmend.improve(loaded)
    assert np.array_equal(again.points, result.points) and np.array_equal(again.tets, result.tets)


def test_a_file_given_to_improve_is_told_how_to_become_a_mesh():
    with pytest.raises(TypeError, match=r"tetmend.load\('part.mesh'\) gives one"):
        tetmend.improve("part.mesh")


def test_nodes_of_second_order_in_another_order_are_refused(arrays):
    points, tets = of_second_order(arrays["points"], arrays["tets"])
    with pytest.raises(ValueError, match="has two nodes"):
        tetmend.improve(points, tets[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]])
    tets[5, 7] = len(points)
    with pytest.raises(ValueError, match=rf"tets\[5, 7\] is {len(points)}, but there are"):
        tetmend.improve(points, tets)


def test_strided_and_small_types_are_read(arrays):
    wide = np.zeros((len(arrays["points"]), 6))
    wide[:, ::2] = arrays["points"]
    reversed_bytes = arrays["tets"].astype(">i4")
    ours = tetmend.improve(wide[:, ::2], reversed_bytes, labels=arrays["labels"].astype(np.int8))
    assert np.array_equal(ours.points, tetmend.improve(**arrays).points)


def test_maps_say_where_points_and_tets_are(arrays):
    result = tetmend.improve(**arrays)
    kept = result.vertex_map >= 0
    assert (np.diff(result.vertex_map[kept]) > 0).all() and result.vertex_map.min() >= -1
    faces = np.sort(np.concatenate([arrays["tets"][:, k] for k in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])]), axis=1)
    rows, counts = np.unique(faces, axis=0, return_counts=True)
    surface = np.unique(rows[counts == 1])
    assert np.array_equal(result.points[result.vertex_map[surface]], arrays["points"][surface])
    stays = result.tet_map >= 0
    assert 0 < stays.sum() < len(stays)
    assert np.array_equal(np.sort(result.vertex_map[arrays["tets"][stays]], axis=1),
                          np.sort(result.tets[result.tet_map[stays]], axis=1))


def test_labels_keep_their_volumes(arrays):
    result = tetmend.improve(**arrays)
    for label in np.unique(arrays["labels"]):
        then = volumes(arrays["points"], arrays["tets"])[arrays["labels"] == label].sum()
        now = volumes(result.points, result.tets)[result.labels == label].sum()
        assert now == pytest.approx(then, rel=1e-12)


def test_data_come_over_in_their_form(arrays):
    x = arrays["points"]
    result = tetmend.improve(
        **arrays, point_data={"linear": x @ [1.0, 2.0, 3.0], "tensor": np.tile(np.eye(3), (len(x), 1, 1)), "flag": x[:, 0] > 0},
        cell_data={"material": arrays["labels"].astype(np.uint8), "heat": np.ones(len(arrays["tets"]), np.float32)})
    assert np.allclose(result.point_data["linear"], result.points @ [1.0, 2.0, 3.0], atol=1e-10)
    assert result.point_data["tensor"].shape == (len(result.points), 3, 3)
    assert np.allclose(result.point_data["tensor"], np.eye(3))
    assert result.point_data["flag"].dtype == bool
    assert result.cell_data["material"].dtype == np.uint8 and np.array_equal(result.cell_data["material"], result.labels)
    assert result.cell_data["heat"].dtype == np.float32 and (result.cell_data["heat"] == 1).all()
    assert {each["name"] for each in result.figures["data"]} == {"linear", "tensor", "flag", "material", "heat"}


def test_constraints_and_groups_come_back(arrays, materials):
    held = np.zeros(len(arrays["points"]), bool)
    held[np.unique(arrays["tets"])[::7]] = True
    inlet = np.arange(10)
    result = tetmend.improve(**arrays, triangles=materials.triangles, triangle_labels=materials.triangle_labels, required=held,
                             groups=[tetmend.Group(2, 5, "inlet", inlet), tetmend.Group(3, int(arrays["labels"][0]), "core")])
    assert len(result.triangles) == len(materials.triangles)
    assert np.array_equal(np.sort(result.triangle_labels), np.sort(materials.triangle_labels))
    assert (result.vertex_map[held] >= 0).all()
    assert np.array_equal(result.points[result.vertex_map[held]], arrays["points"][held])
    found = {group.name: group for group in result.groups}
    assert found["inlet"].number == 5 and len(found["inlet"].members) == 10
    assert np.array_equal(np.sort(result.vertex_map[materials.triangles[inlet]], axis=1),
                          np.sort(result.triangles[found["inlet"].members], axis=1))
    assert np.array_equal(found["core"].members, np.flatnonzero(result.labels == arrays["labels"][0]))


def test_parts_keep_regions_apart_that_labels_do_not(arrays):
    parts = arrays.pop("labels")
    result = tetmend.improve(**arrays, parts=parts)
    for part in np.unique(parts):
        then = volumes(arrays["points"], arrays["tets"])[parts == part].sum()
        assert volumes(result.points, result.tets)[result.parts == part].sum() == pytest.approx(then, rel=1e-12)


# --- errors


def changed(array, place, value):
    array = np.array(array, dtype=float if isinstance(value, float) else None)
    array[place] = value
    return array


@pytest.mark.parametrize(("points", "tets", "more", "message"), [
    (TET[0], [[0, 1, 2, 4]], {}, "tets[0, 3] is 4, but there are 4 points, numbered from 0"),
    (TET[0], [[0, 1, -2, 3]], {}, "tets[0, 2] is -2, but numbers begin with 0"),
    (TET[0], np.array([[0, 1, 2, 2**40]]), {}, "tets[0, 3] is 1099511627776, but there are 4 points"),
    (TET[0], [[0, 1, 2, 2]], {}, "tets[0]: (0, 1, 2, 2): the same vertex twice, counted from 0"),
    (TET[0], [[0, 1, 2]], {}, "tets has shape (1, 3), but (n, 4) is wanted"),
    (TET[0], [0, 1, 2, 3], {}, "tets has shape (4,), but (n, 4) is wanted"),
    (TET[0], [[0.0, 1.0, 2.0, 3.0]], {}, "tets has type float64, but integers are wanted"),
    (TET[0], [["a", "b", "c", "d"]], {}, "tets has type <U1, but integers are wanted"),
    (changed(TET[0], (2, 1), np.nan), TET[1], {}, "points[2, 1] is nan"),
    (changed(TET[0], (3, 0), -np.inf), TET[1], {}, "points[3, 0] is -inf"),
    ([[0, 0], [1, 0]], TET[1], {}, "points has shape (2, 2), but (n, 3) is wanted"),
    (np.array(TET[0]) * 1j, TET[1], {}, "points has type complex128, but real numbers are wanted"),
    (*TET, {"labels": [1, 2]}, "labels has 2 numbers, but 1 are wanted"),
    (*TET, {"labels": [2**31]}, "labels[0] is 2147483648, which is no integer of 32 bits"),
    (*TET, {"labels": [1.5]}, "labels has type float64, but integers are wanted"),
    (*TET, {"triangles": [[0, 1, 7]]}, "triangles[0, 2] is 7, but there are 4 points"),
    (*TET, {"edges": [[0, 9]]}, "edges[0, 1] is 9, but there are 4 points"),
    (*TET, {"required": [0, 4]}, "required[1] is 4, but there are 4 points, numbered from 0"),
    (*TET, {"required": [True, False]}, "required has shape (2,), but a mask of 4 points is wanted"),
    (*TET, {"point_data": {"u": [1.0]}}, "point_data['u'] has shape (1,), but there are 4 of them"),
    (*TET, {"cell_data": {"u": ["x"]}}, "cell_data['u'] has type <U1, but real numbers of up to 64 bits are wanted"),
    (TET[0], [], {}, "the mesh has no tetrahedra"),
    (*TET, {"point_data": np.ones(4)}, "point_data is of type ndarray, but a dict of arrays is wanted"),
    (*TET, {"cell_data": [("a", [1.0])]}, "cell_data is of type list, but a dict of arrays is wanted"),
    (*TET, {"groups": [tetmend.Group(2, 1, "g", [0])]}, "groups[0].members[0] is 0, but there are 0 triangles"),
    ([[0, 0, 0]], [[0, 1, 2, 3]], {}, "tets[0, 1] is 1, but there is 1 point, numbered from 0"),
    (*TET, {"groups": [tetmend.Group(4)]}, "groups[0]: dimension 4, expected 0 to 3"),
])
def test_what_is_wrong_with_arrays_is_a_value_error_with_its_place(points, tets, more, message):
    with pytest.raises(ValueError) as caught:
        tetmend.improve(points, tets, **more)
    assert str(caught.value) == message and isinstance(caught.value, tetmend.Error)


@pytest.mark.parametrize(("options", "message"), [
    ({"goal": 80}, "goal"), ({"threads": 0}, "threads"), ({"threads": "many"}, "threads"), ({"time_limit": -1}, "time_limit"),
    ({"schedule": "swift"}, "swift"), ({"protect": "colour:3"}, "protect"), ({"set": {"nothing": 1}}, "nothing"),
    ({"goal": [1, 2, 3]}, "goal"), ({"measure": object()}, "measure"), ({"conserve": "heat"}, "conserve")])
def test_what_is_wrong_with_options_is_a_value_error_that_names_them(options, message):
    with pytest.raises(ValueError, match=message):
        tetmend.improve(*TET, **options)


def test_unknown_options_and_mixed_calls_are_type_errors(materials):
    with pytest.raises(TypeError, match="did you mean 'schedule'"):
        tetmend.improve(*TET, shedule="shell")
    with pytest.raises(TypeError, match="has its own labels"):
        tetmend.improve(materials, labels=[1])
    with pytest.raises(TypeError, match="points and tets"):
        tetmend.improve(TET[0])
    for name in ("progress", "note"):
        with pytest.raises(TypeError, match=f"{name} is of type int, but a function is wanted"):
            tetmend.improve(*TET, **{name: 3})


@pytest.mark.parametrize(("kind", "n"), [(np.int8, 3), (np.uint8, 4)])
def test_numbers_of_points_that_the_given_type_cannot_hold_are_of_32_bits(kind, n):
    from bridges_test import lattice
    points, tets, _ = lattice(n)
    splits = "goal{min = 60, max = 100} judge_by{price = 0} insert_points{} apply({'edge_split', desperate = 2, relax = true})"
    options = {"script": splits, "purpose": "angles"}
    wide = tetmend.improve(points, tets, **options)
    assert len(points) - 1 <= np.iinfo(kind).max < len(wide.points) - 1
    result = tetmend.improve(points, tets.astype(kind), **options)
    assert result.tets.dtype == np.int32 and np.array_equal(result.tets, wide.tets)


@pytest.mark.parametrize(("given", "message"), [
    ({"points": [[0, 0, 0], [1, 2]]}, "points is no array: its rows differ in length"),
    ({"tets": [[0, 1, 2, 3], [1, 2]]}, "tets is no array: its rows differ in length"),
    ({"labels": [[1], [1, 2]]}, "labels is no array"),
    ({"points": np.ma.masked_greater(np.array(TET[0], float), 0.5)}, "points has masked values"),
    ({"point_data": {"u": np.ma.masked_equal([1.0, 2.0, 3.0, 4.0], 2.0)}}, r"point_data\['u'\] has masked values"),
    ({"point_data": {3: np.ones(4)}}, r"point_data\[3\]: a name is text"),
    ({"cell_data": {"": np.ones(1)}}, r"cell_data\[''\]: a name is text that is not empty"),
    ({"groups": [tetmend.Group(3, 1, "a"), (3, 1, "a")]}, r"groups\[1\] is of type tuple, but a tetmend.Group is wanted"),
    ({"groups": tetmend.Group(3, 1, "a")}, "groups is a Group, but a sequence of them is wanted"),
    ({"groups": [tetmend.Group("vol", 1, "a")]}, r"groups\[0\].dimension is 'vol', but an integer is wanted"),
    ({"groups": [tetmend.Group(3, 2**40, "a")]}, rf"groups\[0\].number is {2**40}, but an integer of 32 bits is wanted"),
    ({"groups": [tetmend.Group(2**70, 1, "a")]}, rf"groups\[0\].dimension is {2**70}, but an integer of 32 bits is wanted"),
    ({"groups": [tetmend.Group(3, 1, None)]}, r"groups\[0\].name is None, but text is wanted"),
    ({"groups": [tetmend.Group(3, 1, "a", [[0], [0, 1]])]}, r"groups\[0\].members is no array"),
    ({"set": ["max_rounds=2"]}, r"set: \['max_rounds=2'\] is no dict"),
    ({"schedule": "shell", "script": "log(1)"}, "script: it stands in the place of a schedule"),
    ({"trace_depth": 1}, "trace_depth: it needs the option trace"),
    ({"feature_angle": 30}, "feature_angle: it needs the option surface"),
])
def test_what_has_no_meaning_is_refused_with_its_place(given, message):
    with pytest.raises((ValueError, TypeError), match=message):
        tetmend.improve(**{"points": TET[0], "tets": TET[1], **given})


@pytest.mark.parametrize(("call", "message"), [
    (lambda mesh: tetmend.quality("part.mesh"), r"tetmend.load\('part.mesh'\) gives one"),
    (lambda mesh: tetmend.quality(mesh.points), "quality.. takes a Mesh, not ndarray"),
    (lambda mesh: tetmend.quality(mesh, measures="gamma"), "^measures: unknown quality measure 'gamma'"),
    (lambda mesh: tetmend.check(mesh.points, mesh.tets), "check.. takes a Mesh, not ndarray"),
    (lambda mesh: tetmend.check(mesh, min_dihedral="a"), "min_dihedral is 'a', but a number of degrees is wanted"),
    (lambda mesh: tetmend.check(mesh, measure=["mean_ratio"]), "measure is of type list, but a dict is wanted"),
    (lambda mesh: tetmend.check(mesh, preset="ansys"), "^preset: 'ansys' is no preset"),
    (lambda mesh: tetmend.save("a.mesh", mesh.points), "takes a Mesh, not ndarray"),
    (lambda mesh: tetmend.save(mesh, "a.mesh"), "takes the name of a file and a Mesh, not Mesh first"),
    (lambda mesh: tetmend.load(3), "takes the name of a file, not int"),
    (lambda mesh: tetmend.operators("nowhere.so"), "nowhere.so: cannot be loaded as a plugin"),
])
def test_calls_with_the_wrong_kind_of_thing_say_what_is_wanted(materials, call, message):
    with pytest.raises((ValueError, TypeError), match=message):
        call(materials)


def test_a_mesh_refuses_what_would_not_change_it(materials):
    with pytest.raises(AttributeError, match="a Mesh does not change, so it takes no 'points'"):
        materials.points = materials.points + 1
    with pytest.raises(AttributeError, match="takes no 'label'"):
        materials.label = 3
    assert materials.points is materials.points  # read once


def test_a_result_stands_for_its_mesh(materials, tmp_path):
    result = tetmend.improve(materials)
    assert tetmend.improve(result).before.n_bad == 0
    assert tetmend.save(tmp_path / "a.mesh", result) == []
    assert tetmend.quality(result).statistics.n_bad == 0 and tetmend.check(materials, result).holds


def test_copies_share_a_mesh_and_pickles_are_refused_with_the_way_out(materials):
    result = tetmend.improve(materials)
    assert copy.copy(materials) is copy.deepcopy(materials) is materials
    again = copy.deepcopy(result)
    assert again.mesh is result.mesh and np.array_equal(again.vertex_map, result.vertex_map)
    assert again.after == result.after and again.after is not result.after
    with pytest.raises(TypeError, match=r"a Mesh is not pickled, .* send its arrays"):
        pickle.dumps(result)


def test_constraints_that_constrain_nothing_are_noted():
    points = [*TET[0], [1, 1, 1]]
    tets = [TET[1][0], [1, 2, 3, 4]]
    notes = tetmend.improve(points, tets, triangles=[[0, 1, 4]], edges=[[0, 4]]).notes
    assert "1 of the triangles given: not a face of any tet, kept as they are" in notes
    assert "1 of the edges given: not an edge of any tet, kept as they are" in notes


def test_files_that_cannot_be_read_or_written_are_named(tmp_path, materials):
    with pytest.raises(ValueError, match="nowhere.mesh"):
        tetmend.load(tmp_path / "nowhere.mesh")
    with pytest.raises(ValueError, match="mesh.xyz"):
        materials.save(tmp_path / "mesh.xyz")
    assert list(tmp_path.iterdir()) == []


# --- options


def test_names_of_any_bytes_are_text(tmp_path):
    file = tmp_path / "a.msh"
    file.write_bytes(b'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 "caf\xe9"\n$EndPhysicalNames\n'
                     b"$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n"
                     b'$ElementData\n1\n"Temp\xe9rature"\n1\n0\n3\n0\n1\n1\n1 3.5\n$EndElementData\n')
    mesh = tetmend.load(file)
    assert list(mesh.cell_data) == ["Température"] and [group.name for group in mesh.groups] == ["café"]
    result = tetmend.improve(mesh)
    assert list(result.mesh.cell_data) == ["Température"]
    assert any("Température" in note for note in mesh.save(tmp_path / "b.mesh"))
    with pytest.raises(tetmend.Error, match="é.mesh: cannot be read"):
        tetmend.load(os.fsdecode(os.fsencode(tmp_path) + b"/\xe9.mesh"))


def test_options_are_those_of_the_library():
    from tetmend._options import Options
    known = {name.replace("-", "_") for name, _, _, _ in _core.option_forms()}
    assert known == set(Options.__annotations__) | {"tets"}


def test_options_may_be_numbers_and_arrays_of_numpy(materials):
    plain = tetmend.improve(materials, goal=(25, 155), keep_size=True, threads=2)
    of_numpy = tetmend.improve(materials, goal=np.array([25, 155]), keep_size=np.True_, threads=np.int64(2))
    assert of_numpy.goal == (25, 155) and np.array_equal(of_numpy.tets, plain.tets)
    assert tetmend.improve(materials, goal=np.float32(25), protect=np.array(["label:1"])).figures["protected"]["tets"] > 0


def test_options_do_what_they_say(materials):
    free = tetmend.improve(materials)
    assert tetmend.improve(materials, tets="0%").after.tets <= materials.tets.shape[0]
    label = int(materials.labels[0])
    held = tetmend.improve(materials, protect=[f"label:{label}"], goal=(20, 160), threads=2, maps=False, rulers=False)
    assert held.figures["protected"]["tets"] == (materials.labels == label).sum()
    assert held.goal == (20, 160) and "rulers" not in held.after and len(held.vertex_map) == 0
    assert free.figures["protected"]["tets"] == 0 and free.after.rulers["mean_ratio"]["worst"] > 0
    spoken = []
    script = "begin_round()\nlocal_reconnection{}\nlog('that is all')"
    assert tetmend.improve(materials, script=script, note=spoken.append).ending == "finished"
    assert any("that is all" in line for line in spoken)
    assert tetmend.improve(materials, script=script).report["schedule"] == "script"


# --- the same as the command line


def test_the_bytes_are_those_of_the_command_line(tmp_path, command_line):
    command_line("improve", MATERIALS, "-o", tmp_path / "theirs.mesh", "--schedule", "thorough", "--goal", "32,145", "-q")
    result = tetmend.improve(tetmend.load(MATERIALS), schedule="thorough", goal=(32, 145), threads=3)
    assert result.save(tmp_path / "ours.mesh") == []
    assert (tmp_path / "ours.mesh").read_bytes() == (tmp_path / "theirs.mesh").read_bytes()


def test_arrays_give_the_bytes_that_the_file_gives(tmp_path, materials):
    names = ("points", "tets", "labels", "triangles", "triangle_labels", "edges", "edge_labels", "required")
    given = {name: getattr(materials, name) for name in names}
    tetmend.improve(**given).save(tmp_path / "arrays.mesh")
    tetmend.improve(materials).save(tmp_path / "file.mesh")
    assert (tmp_path / "arrays.mesh").read_bytes() == (tmp_path / "file.mesh").read_bytes()


def test_the_report_has_the_figures_and_names_of_the_command_line(tmp_path, command_line, materials):
    command_line("improve", MATERIALS, "-o", tmp_path / "a.mesh", "--report", tmp_path / "a.json")
    theirs = json.loads((tmp_path / "a.json").read_text())
    ours = json.loads(json.dumps(tetmend.improve(materials, limit=True).report, allow_nan=False))
    for of_time in ("tets_per_second", "seconds"):
        assert ours.pop(of_time).__class__ is theirs.pop(of_time).__class__
    for report in (ours, theirs):
        for each in report["passes"]:
            each.update(seconds=0, seconds_in_scans=0, seconds_in_blocks=0)
    assert set(theirs) - set(ours) == {"arguments", "input", "output", "peak_memory_bytes", "histograms", "ranks", "worst_tets"}
    assert {name: ours[name] for name in ours} == {name: theirs[name] for name in ours}


def test_quality_is_that_of_the_command_line(tmp_path, command_line, materials):
    command_line("improve", MATERIALS, "-o", tmp_path / "a.mesh", "--report", tmp_path / "a.json")
    found = tetmend.quality(materials, measures=["mean_ratio"], limit=True, bad_tets=True)
    before = json.loads((tmp_path / "a.json").read_text())["before"]
    mine = {**found.statistics}
    # Sums over the tets around a vertex, in the order of the mesh.
    for name in ("step", "cg_steps", "work"):
        assert mine["rulers"].pop(name) == pytest.approx(before["rulers"].pop(name), rel=1e-12)
    assert mine == before
    assert len(found.bad_tets) == found.statistics.n_bad == sum(found.limit["bad"].values())
    assert set(found.measures) == {"mean_ratio"}


def test_quality_tells_where_points_touch_without_being_joined():
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    points = np.concatenate([corners, corners[[0, 2, 1]], [[0, 0, -1.0]]])
    apart = tetmend.quality(points, [[0, 1, 2, 3], [4, 5, 6, 7]])
    assert len(apart.notes) == 1 and apart.notes[0].startswith("3 of 8 points lie on others and are not joined")
    assert tetmend.quality(corners, [[0, 1, 2, 3]]).notes == []


@pytest.mark.parametrize("words", [{"preset": "openfoam"}, {"min_dihedral": 15, "no_inverted": True}, {"measure": {"mean_ratio": 0.1}}])
def test_check_is_that_of_the_command_line(tmp_path, materials, words):
    better = tetmend.improve(materials)
    better.save(tmp_path / "better.mesh")
    options = {"preset": "--for=openfoam", "min_dihedral": "--min-dihedral=15", "no_inverted": "--no-inverted",
               "measure": "--measure=mean_ratio=0.1"}
    for file, mesh in ((MATERIALS, materials), (tmp_path / "better.mesh", better.mesh)):
        done = subprocess.run([BUILD / "bin/tetmend", "check", file, "--json", *(options[name] for name in words)],
                              capture_output=True, text=True)
        ours = tetmend.check(mesh, **words)
        assert done.returncode == ours.status
        assert json.loads(done.stdout)["facts"] == [vars(fact) for fact in ours.facts]
    compared = tetmend.check(MATERIALS, tmp_path / "better.mesh")
    assert compared and compared.status == 0 and "surface" in [fact.name for fact in compared.facts]
    assert tetmend.check(tmp_path / "better.mesh", MATERIALS).status == 3
    moved = tetmend.improve(materials, schedule="surface", surface="5%").mesh
    assert not tetmend.check(materials, moved)
    assert tetmend.check(materials, moved, surface="5%")
    with pytest.raises(ValueError, match="surface: 'far' is none of"):
        tetmend.check(materials, moved, surface="far")
    with pytest.raises(ValueError, match="nothing to check"):
        tetmend.check(materials)
    with pytest.raises(ValueError, match="preset"):
        tetmend.check(materials, preset="solver")


def test_schedules_and_operators_are_those_of_the_command_line(command_line):
    names = [schedule.name for schedule in tetmend.schedules()]
    listed = command_line("schedules")
    assert names[0] == "shell" and all(name in listed for name in names)
    assert "local_reconnection" in tetmend.schedules()[0].source
    shell = {parameter.name: parameter for parameter in tetmend.schedules()[0].parameters}
    assert shell["max_rounds"].low <= shell["max_rounds"].default <= shell["max_rounds"].high
    assert all(operator.name in command_line("operators") for operator in tetmend.operators())
    with pytest.raises(ValueError, match="none.so"):
        tetmend.operators(["none.so"])


def test_a_plugin_finds_the_library(materials):
    plugin = BUILD / "tests/plugins/odt_smoothing.so"
    if not plugin.exists():
        pytest.skip("the plugins of the tests are not built")
    assert tetmend.operators([plugin])[-1].name == "odt_smoothing"
    result = tetmend.improve(materials, plugin=plugin, script="begin_round()\napply{'odt_smoothing'}")
    assert [each.name for each in result.passes] and sum(each.accepted for each in result.passes) > 0


# --- running


def test_progress_is_told_and_may_stop_the_run(materials):
    seen = []
    finished = tetmend.improve(materials, progress=seen.append)
    assert finished.ending == "finished" and {moment.stage for moment in seen} >= {"building", "improving"}
    stopped = tetmend.improve(materials, progress=lambda moment: moment.stage != "improving")
    assert stopped.ending == "cancelled" and stopped.report["interrupted"]
    assert stopped.after.n_bad > finished.after.n_bad
    limited = tetmend.improve(tetmend.load(SOURCE / "assets/meshes/bracket.meshb"), schedule="thorough", time_limit=0.001)
    assert limited.ending == "time_limit" and limited.report["out_of_time"]


def test_what_progress_raises_comes_out(materials):
    def fail(moment):
        raise KeyError(moment.stage)
    with pytest.raises(KeyError, match="building"):
        tetmend.improve(materials, progress=fail)
    with pytest.raises(ZeroDivisionError):
        tetmend.improve(materials, script="log('x')", note=lambda text: 1 / 0)


def test_lengths_may_be_a_function_of_the_place(materials, tmp_path):
    script = tmp_path / "size.lua"
    script.write_text("function size(x, y, z) return 1.5 + 0.02 * x * x end")
    by_script = tetmend.adapt(materials, size=str(script), surface="flat")
    for threads in (1, 2):
        by_function = tetmend.adapt(materials, size=lambda x, y, z: np.float64(1.5 + 0.02 * x * x), surface="flat", threads=threads)
        assert np.array_equal(by_function.points, by_script.points) and np.array_equal(by_function.tets, by_script.tets)
    assert by_function.figures["sizes_after"] == by_script.figures["sizes_after"]


@pytest.mark.parametrize(("given", "raised"), [
    (lambda x, y, z: 1 / 0, ZeroDivisionError), (lambda x: x, TypeError), (lambda x, y, z: "long", TypeError),
    (lambda x, y, z: -1, tetmend.Error)])
def test_what_a_function_of_lengths_raises_comes_out_and_the_mesh_stays(materials, given, raised):
    before = materials.points.copy()
    with pytest.raises(raised):
        tetmend.adapt(materials, size=given, threads=2)
    assert np.array_equal(materials.points, before)


def test_ctrl_c_stops_the_run_and_is_raised():
    mesh = tetmend.load(SOURCE / "assets/meshes/bracket.meshb")
    seen = []

    def interrupt(moment):
        if not seen:
            signal.raise_signal(signal.SIGINT)
        seen.append(moment)
        time.sleep(0.01)
    whole = []
    tetmend.improve(mesh, progress=whole.append)
    with pytest.raises(KeyboardInterrupt):
        tetmend.improve(mesh, progress=interrupt)
    assert len(seen) < len(whole)


def test_other_threads_run_meanwhile():
    mesh = tetmend.load(SOURCE / "assets/meshes/bracket.meshb")
    count, stop = [0], threading.Event()

    def work():
        while not stop.wait(0.001):
            count[0] += 1
    thread = threading.Thread(target=work)
    thread.start()
    before = count[0]
    tetmend.improve(mesh)
    after = count[0]
    stop.set()
    thread.join()
    assert after - before > 5


def test_two_threads_improve_at_once_as_each_alone(arrays, materials):
    jobs = [lambda: tetmend.improve(**arrays, threads=2), lambda: tetmend.improve(materials, schedule="thorough")] * 2
    alone = [job() for job in jobs]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        together = [future.result() for future in [pool.submit(job) for job in jobs]]
    for one, other in zip(alone, together):
        assert one.points.tobytes() == other.points.tobytes() and one.tets.tobytes() == other.tets.tobytes()


# --- traces


def test_a_trace_tells_what_the_command_line_tells(tmp_path, materials, command_line):
    file = tmp_path / "run.trace"
    result = tetmend.improve(materials, trace=file, set={"max_rounds": 1})
    trace = tetmend.Trace(file)
    assert trace.damage == "" and trace.schedule == "shell" and trace.settings["max_rounds"] == "1"
    assert trace.summary() == command_line("trace", file)
    assert trace.tree(0) == command_line("trace", file, "--tree", 0) and trace.dot(0) == command_line("trace", file, "--dot", 0)
    assert trace.slices() == json.loads(command_line("trace", file, "--slices"))
    calls = list(trace.calls())
    assert len(calls) == trace.call_count == max(call["number"] for call in calls) + 1
    outermost = list(trace.calls(outermost=True))
    assert all(call["depth"] == 0 for call in outermost) and 0 < len(outermost) < len(calls)
    assert sum(call["accepted"] for call in calls) > 0
    events = list(trace.events())
    assert len(events) == trace.event_count
    assert sum(event["kind"] == "attempt begins" for event in events) == len(calls)
    assert len(list(trace.visits())) > 0
    assert [each["name"] for each in trace.passes()] == [each.name for each in result.passes]
    assert len(trace.mesh_at(0).tets) == len(materials.tets)
    assert len(trace.mesh_at(trace.event_count).tets) == len(result.tets)
    assert trace.measure == "sine_and_length"
    for n in (0, trace.event_count // 2, trace.event_count):
        qualities = trace.quality_at(n)
        assert qualities.dtype == np.float32 and np.allclose(qualities, tetmend.TetMesh(trace.mesh_at(n)).quality())
    with pytest.raises(ValueError, match="there is no call"):
        trace.call(trace.call_count)
    for call in (trace.call, trace.mesh_at, trace.quality_at, trace.tree, trace.dot, lambda n: next(trace.events(n))):
        with pytest.raises(ValueError, match="is -1, but numbers begin with 0"):
            call(-1)
    with pytest.raises(ValueError, match=f"but the trace has {trace.event_count} events"):
        next(trace.events(trace.event_count + 1))
    with pytest.raises(ValueError):
        tetmend.Trace(MATERIALS)


def test_a_trace_shows_itself_and_its_calls_in_a_notebook(tmp_path, materials, command_line):
    file = tmp_path / "run.trace"
    tetmend.improve(materials, trace=file, set={"max_rounds": 1})
    trace = tetmend.Trace(file)
    table = trace._repr_html_()
    counts = {}
    for row in re.findall(r"<tr><td>(.*?)</td></tr>", table):
        name, *numbers = row.split("</td><td>")
        counts[name] = [int(number.replace(",", "")) for number in numbers[:4]]
    assert sum(calls for calls, *_ in counts.values()) == trace.call_count
    assert all(calls == good + undone + refused for calls, good, undone, refused in counts.values())
    assert sum(good for _, good, *_ in counts.values()) == sum(call["for_good"] for call in trace.calls())
    page = trace.show(call=17, height=500)
    lesson = tmp_path / "run.json"
    command_line("lesson", "--make", file, "--call", 17, "-o", lesson)
    assert page.html == command_line("lesson", lesson, "--html")
    frame = page._repr_html_()
    assert "height: 500px" in frame
    assert html.unescape(re.search(r'srcdoc="([^"]*)"', frame).group(1)) == page.html
    page.save(tmp_path / "call.html")
    assert (tmp_path / "call.html").read_text() == page.html
    with pytest.raises(tetmend.Error, match=f"there is no call {trace.call_count}"):
        trace.show(call=trace.call_count)
    with pytest.raises(tetmend.Error, match="call is -1"):
        trace.show(call=-1)


def test_a_trace_has_a_ledger_in_which_each_call_is_once(tmp_path, command_line):
    file = tmp_path / "run.trace"
    tetmend.improve(tetmend.load(MATERIALS.with_name("folded_sheet.mesh")), trace=file)
    trace = tetmend.Trace(file)
    ledger = trace.ledger()
    assert sum(entry["calls"] for entry in ledger) == trace.call_count
    calls = list(trace.calls())
    lasting = [call["number"] for call in calls if call["for_good"]]
    assert lasting and all(call["accepted"] for call in calls if call["for_good"])
    assert sum(entry["calls"] for entry in ledger if entry["ending"] == "accepted for good") == len(lasting)
    undone = [call for call in calls if call["undone_with"] is not None]
    assert undone and all(call["accepted"] and not call["for_good"] and call["verdict"] == "undone with a caller" for call in undone)
    assert all(call["undone_with"] < call["number"] < calls[call["undone_with"]]["subtree_end"] for call in undone)
    entry = max((entry for entry in ledger if entry["refused"]), key=lambda entry: entry["calls"])
    found = trace.calls_of(entry)
    assert len(found) == entry["calls"] and all(calls[n]["operator"] == entry["operator"] and calls[n]["level"] == entry["level"] for n in found)
    assert json.loads(command_line("trace", file, "--ledger", "--json"))["all"]["calls"] == trace.call_count
    for entry in (entry for entry in ledger if entry["refused"]):
        missing = [calls[n]["missing"] for n in trace.calls_of(entry)]
        assert entry["nearest"] == missing[0]
        known = [value for value in missing if value is not None]
        assert missing == sorted(known) + [None] * (len(missing) - len(known))
    assert any(entry["nearest"] is None for entry in ledger if entry["refused"])
    assert all(call["missing"] is None for call in calls if call["accepted"])


def test_two_traces_are_set_side_by_side(tmp_path, materials, command_line):
    files = [tmp_path / "a.trace", tmp_path / "b.trace"]
    tetmend.improve(materials, trace=files[0], script="smooth{}")
    tetmend.improve(materials, trace=files[1])
    a, b = (tetmend.Trace(file) for file in files)
    pairs = a.worse_than(b)
    assert pairs and all(pair["bad_quality"] < 1 <= pair["good_quality"] for pair in pairs)
    assert [pair["bad_quality"] for pair in pairs] == sorted(pair["bad_quality"] for pair in pairs)
    worst = "tet:" + ",".join(str(v) for v in pairs[0]["bad"])
    assert worst in a.against(b) and "has quality" in a.history(worst)
    assert a.history("tet:worst") == command_line("trace", files[0], "--history", "tet:worst", "--all")
    assert a.worse_than(a) == []


# --- what is shown


def test_notebooks_show_a_table_of_before_and_after(materials):
    result = tetmend.improve(materials)
    shown = result._repr_html_()
    assert f"<td>{result.before.tets:,}</td><td>{result.after.tets:,}</td>" in shown
    assert f"<td>{result.before.n_bad:,}</td><td>0</td>" in shown
    assert 'data-histogram="angles"' in shown and 'class="progress"' in shown and 'data-sum="accepted"' in shown
    assert f"{result.before.n_bad:,}</data> bad tets" in shown
    spoken = tetmend.improve(materials, script="log('<script>')")
    assert "<script>" not in spoken._repr_html_() and ("&lt;script&gt;" in spoken._repr_html_()) == ("<script>" in str(spoken.notes))
    assert "cancelled" in tetmend.improve(materials, progress=lambda moment: False)._repr_html_()


@pytest.mark.parametrize("name", ["_arrays", "_catalogue", "_check", "_figures", "_html", "_improve", "_kernel", "_mesh", "_options", "_quality"])
def test_examples_in_docstrings_print_what_they_say(name):
    outcome = doctest.testmod(importlib.import_module(f"tetmend.{name}"), optionflags=doctest.IGNORE_EXCEPTION_DETAIL)
    assert outcome.failed == 0 < outcome.attempted


def test_the_stub_has_the_names_of_the_extension():
    tree = ast.parse((SOURCE / "bindings/python/tetmend/_core.pyi").read_text())
    kinds = (ast.FunctionDef, ast.ClassDef)
    names = {node.name for node in tree.body if isinstance(node, kinds)}
    assert names == {name for name in dir(_core) if not name.startswith("__")}
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and node.name in ("Edit", "Mesh", "Progress", "Proposal", "TetMesh", "Trace"):
            members = {each.name for each in node.body if isinstance(each, kinds)} - {"__init__"}
            assert members == {name for name in dir(getattr(_core, node.name)) if not name.startswith("_")}


def test_the_stub_says_of_public_classes_what_the_extension_says():
    tree = ast.parse((SOURCE / "bindings/python/tetmend/_core.pyi").read_text())
    public = [node for node in tree.body if isinstance(node, ast.ClassDef) and getattr(tetmend, node.name, None) is getattr(_core, node.name)]
    assert {node.name for node in public} == {"Error", "OptionError", "Progress"}
    for node in public:
        found = getattr(_core, node.name)
        assert ast.get_docstring(node) == found.__doc__
        for member in node.body:
            if isinstance(member, ast.FunctionDef):
                assert ast.get_docstring(member) == getattr(found, member.name).__doc__, member.name


def test_all_that_is_public_has_a_docstring():
    for name in tetmend.__all__:
        assert name == "__version__" or getattr(tetmend, name).__doc__, name


# --- what is missing, and what is shown


@pytest.mark.parametrize("call", [tetmend.load, tetmend.Trace, lambda file: tetmend.check(file, file), lambda file: tetmend.Mesh(*TET).save(file)])
def test_a_file_or_folder_that_is_not_there_is_pythons_own_error_and_ours(call, tmp_path):
    file = str(tmp_path / "none" / "part.mesh")
    with pytest.raises(FileNotFoundError) as missing:
        call(file)
    assert isinstance(missing.value, tetmend.Error) and isinstance(missing.value, tetmend.MissingFile)
    assert file in str(missing.value) and missing.value.filename == file and missing.value.errno == 2
    assert "\n" not in str(missing.value)


def test_a_file_that_is_there_and_wrong_is_no_missing_file(tmp_path):
    (tmp_path / "part.mesh").write_text("nothing")
    with pytest.raises(tetmend.Error) as wrong:
        tetmend.load(tmp_path / "part.mesh")
    assert not isinstance(wrong.value, OSError)


def test_a_notebook_shows_meshes_figures_and_checks_with_all_text_escaped(materials):
    group = tetmend.Group(3, 7, "<b>steel", members=[0])
    mesh = tetmend.Mesh(materials.points, materials.tets, labels=materials.labels, groups=[group], cell_data={"a & b": np.zeros(len(materials.tets))})
    found = tetmend.quality(mesh, bad_tets=True, measures="mean_ratio")
    held = tetmend.check(mesh, min_dihedral=30, no_inverted=True)
    for each, words in ((mesh, ["4,306", "&lt;b&gt;steel", "a &amp; b", "regions"]), (found, ["533", "bad tets", "mean_ratio", "worst 10 of 533", "search"]),
                        (held, ["FAIL", "ok", "1 of them do not hold"])):
        page = each._repr_html_()
        assert page.count("<table") == page.count("</table>") and "<b>steel" not in page
        for word in words:
            assert word in page, (type(each), word)
    assert repr(found) == "<tetmend.Quality: 4,306 tets, 533 bad, angles 0.8426 to 178.4>"
    assert repr(held) == "<tetmend.Check: 2 facts, 1 of them do not hold>"


def test_importing_takes_less_than_a_fifth_of_a_second_of_the_processor_beside_numpy():
    program = "import time, numpy; begin = time.process_time(); import tetmend; print(time.process_time() - begin)"
    environment = dict(os.environ, PYTHONPATH=str(BUILD / "python"))
    took = [float(subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True, env=environment).stdout)
            for _ in range(3)]
    assert min(took) < 0.2, took
