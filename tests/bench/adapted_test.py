# SPDX-License-Identifier: MIT
"""Whether the bench notices each broken promise of tetmend adapt, and what its judge says of shapes that are known.

adapted_test.py SOURCE_FOLDER BUILD_FOLDER

Exit status 77: numpy is not there.
"""

import copy
import dataclasses
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
try:
    import numpy as np
except ImportError:
    print(f"skipped: {sys.executable} has no numpy")
    sys.exit(77)
sys.path.insert(0, str(SOURCE / "bench"))
import adapted  # noqa: E402
import borders  # noqa: E402
import kinds  # noqa: E402
import lengths  # noqa: E402
import medit  # noqa: E402
import msh  # noqa: E402
from adapted import Given  # noqa: E402
from medit import Mesh  # noqa: E402
from msh import Model  # noqa: E402

NOTHING_TOLD = {"layers": {"tets": 0}}


def box(n: int = 3) -> Mesh:
    """With labels 1 and 2 beside x = 1/3."""
    mesh = kinds.lattice((n, n, n), lambda x, y, z: (x / n, y / n, z / n))
    mesh.labels = [1 if sum(mesh.points[v][0] for v in tet) < 4 / 3 else 2 for tet in mesh.tets]
    return mesh


def moved(mesh: Mesh, place: tuple, to: tuple) -> Mesh:
    return dataclasses.replace(mesh, points=[to if p == place else p for p in mesh.points])


class Lengths(unittest.TestCase):
    def test_edges_of_a_lattice_are_in_range_or_not(self) -> None:
        mesh = kinds.lattice((2, 2, 2), lambda *at: tuple(map(float, at)))
        straight, diagonal, through = 54, 36, 8
        every = straight + diagonal + through
        for wanted, inside in ((1.2, straight + diagonal), (1.9, diagonal + through), (0.6, 0)):
            share = lengths.share_in_range(mesh, wanted)
            self.assertEqual(share.edges, every)
            self.assertAlmostEqual(share.certain, inside / every)
        at_bound = lengths.share_in_range(mesh, math.sqrt(2))  # straight edges are as short as may be
        self.assertGreater(at_bound.possible, at_bound.certain)

    def test_a_linear_field_is_exact_in_its_tets_and_bounded_beside_them(self) -> None:
        mesh = kinds.lattice((3, 3, 3), lambda *at: tuple(map(float, at)))
        field = lengths.Field(mesh, np.array([1 + x + 2 * y - z / 2 for x, y, z in mesh.points]))
        places = [(0.3, 1.7, 2.2), (2.9, 0.1, 0.4), (1.0, 1.0, 1.0), (-0.5, 0.0, 3.0)]
        values, beside = field.at(places)
        for value, (x, y, z) in zip(values[:3], places, strict=False):
            self.assertAlmostEqual(value, 1 + x + 2 * y - z / 2)
        self.assertEqual(beside.tolist(), [False, False, False, True])
        self.assertTrue(-0.5 <= values[3] <= 4)

    def test_a_gradation_bounds_how_lengths_grow_along_edges(self) -> None:
        mesh = kinds.lattice((5, 1, 1), lambda *at: tuple(map(float, at)))
        found = lengths.graded(mesh, np.array([1.0 if x == 0 else 9.0 for x, _, _ in mesh.points]), 1.5)
        for (x, y, z), length in zip(mesh.points, found, strict=True):
            if y == z:  # on a straight way of edges from the wall
                self.assertAlmostEqual(length, 1 + 0.5 * x)

    def test_the_mean_edge_counts_an_edge_for_each_of_its_tets(self) -> None:
        mesh = Mesh([(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)],
                    [(0, 1, 2, 3), (0, 2, 1, 4)])
        self.assertAlmostEqual(lengths.present(mesh)[0], (2 * 3 + 2 * 1 + 1 + 1) / 6)


class Files(unittest.TestCase):
    def test_a_model_that_was_written_is_read_bit_by_bit(self) -> None:
        model = adapted.make(next(n for n in range(50) if adapted.make(n).kind == "periodic")).model
        model.names = {(3, 1): "part one"}
        with tempfile.TemporaryDirectory() as folder:
            msh.write(Path(folder) / "a.msh", model)
            self.assertEqual(msh.read(Path(folder) / "a.msh"), model)
        self.assertGreater(len(model.twins), 5)
        self.assertTrue(model.point_data)


class Promises(unittest.TestCase):
    """Each promise, broken alone."""

    def given(self, surface: str = "fixed", eps: float = 0.0) -> Given:
        model = Model(box(), {"line": []}, {"mass": [1.0 + i % 3 for i in range(162)]}, {(3, 1): "one"})
        model.point_data["line"] = [3 + 2 * x - 5 * y + z / 4 for x, y, z in model.mesh.points]
        model.mesh.sections = {"Triangles": [(0, 1, 5, 7)], "RequiredVertices": [(21,)], "Edges": [(0, 1, 4)]}
        return Given("a", "box", model, ".msh", surface=surface, eps=eps, conserved=True, protected=[1])

    def breaches(self, given: Given, after: Model, layers: int = 0) -> str:
        told = {"layers": {"tets": layers}}
        found = adapted.surface_breaches(given, given.model.mesh, after.mesh) + adapted.data_breaches(given, given.model, after, told)
        return "; ".join(breach.what for breach in found)

    def test_an_unchanged_mesh_keeps_all(self) -> None:
        for surface, eps in (("fixed", 0.0), ("flat", 0.0), ("1%", 1e-3)):
            given = self.given(surface, eps)
            self.assertEqual(self.breaches(given, copy.deepcopy(given.model)), "")

    def test_what_is_lost_is_named(self) -> None:
        losses = {
            "lost labels": lambda model: model.mesh.labels.__setitem__(slice(None), [1] * 162),
            "lost groups": lambda model: model.names.clear(),
            "lost arrays": lambda model: model.tet_data.update(other=[0.0] * 162),
            "lost triangles of labels": lambda model: model.mesh.sections.pop("Triangles"),
            "lost required points": lambda model: model.mesh.sections.pop("RequiredVertices"),
            "lost named edges": lambda model: model.mesh.sections.pop("Edges"),
            "error of a linear array": lambda model: model.point_data["line"].__setitem__(3, 0.0),
            "another total of an array": lambda model: model.tet_data["mass"].__setitem__(3, 2.0),
            "changed periodic points": lambda model: model.twins.append((0, 3)),
            "changed protected tets": lambda model: model.mesh.points.__setitem__(21, (0.34, 0.34, 0.34)),
        }
        for what, lose in losses.items():
            given = self.given()
            after = copy.deepcopy(given.model)
            lose(after)
            self.assertIn(what, self.breaches(given, after))
        self.assertIn("changed tets of layers", self.breaches(self.given(), self.given().model, layers=163))

    def test_a_surface_that_went_too_far_is_named(self) -> None:
        before = box()
        side = moved(before, (1 / 3, 1 / 3, 0.0), (1 / 3, 1 / 3, -0.01))
        edge = moved(before, (2 / 3, 0.0, 0.0), (2 / 3, -0.01, -0.01))
        within = moved(before, (2 / 3, 1 / 3, 0.0), (0.7, 0.35, 0.0))
        for after, eps, is_broken in ((side, 0.0, True), (side, 0.009, True), (side, 0.011, False), (edge, 0.011, True),
                                      (edge, 0.015, False), (within, 0.0, False)):
            found = [what for what, allowed, far in borders.moved(before, after, eps) if far > allowed]
            self.assertEqual(bool(found), is_broken, (found, eps))
        along = moved(before, (2 / 3, 0.0, 0.0), (0.7, 0.0, 0.0))  # a line stays where it is
        self.assertFalse([what for what, allowed, far in borders.moved(before, along, 0.0) if far > allowed])
        cut = moved(before, (0.0, 0.0, 0.0), (0.05, 0.0, 0.0))
        self.assertIn("old lines from the new", [what for what, allowed, far in borders.moved(before, cut, 1e-3) if far > allowed])

    def test_a_border_of_labels_that_moved_changes_volumes(self) -> None:
        before = box()
        after = moved(before, (1 / 3, 1 / 3, 1 / 3), (0.4, 1 / 3, 1 / 3))
        changed = [label for label, was, now, allowed in borders.volume_changes(before, after, 0.0) if abs(now - was) > allowed]
        self.assertEqual(sorted(changed), [1, 2])

    def test_figures_of_the_report_are_compared(self) -> None:
        mesh = box()
        figures = adapted.yardstick.measure(mesh, (30, 150))
        share = lengths.share_in_range(mesh, 0.4)
        one = {"theta_min": figures.theta_min, "theta_max": figures.theta_max, "tets": 162}
        sizes = {"in_range": share.certain, "edges": share.edges}
        told = {"before": one, "after": one, "sizes": {"before": sizes, "after": sizes}}
        self.assertEqual(adapted.report_breaches(told, figures, figures, (share, share)), [])
        for where, key, value in ((one, "tets", 163), (one, "theta_min", figures.theta_min - 0.1),
                                  (sizes, "in_range", share.certain - 0.01), (sizes, "edges", 0)):
            was, where[key] = where[key], value
            self.assertEqual(len(adapted.report_breaches(told, figures, figures, (share, share))), 2, key)
            where[key] = was


class Runs(unittest.TestCase):
    def test_some_runs_keep_all_promises(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            ran = subprocess.run([sys.executable, "-B", SOURCE / "bench" / "adapted.py", "3", "5", "23", "--build", BUILD,
                                  "-o", Path(folder) / "results", "--write", page], capture_output=True, text=True, check=False)
            self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
            self.assertIn("4 runs on 4 meshes, 0 promises broken.", page.read_text())
            self.assertEqual(list((Path(folder) / "results").iterdir()), [])

    def test_a_program_that_writes_another_mesh_is_caught(self) -> None:
        """A stand-in writes the mesh of another run."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            given, other = adapted.make(3), adapted.make(5)
            medit.write(folder / "other.mesh", other.model.mesh)
            program = folder / "tetmend"
            program.write_text("#!/bin/sh\nwhile [ $# -gt 1 ]; do case $1 in -o) cp other.mesh \"$2\";; --report) echo '{}' > \"$2\";; "
                               "esac; shift; done\n")
            program.chmod(0o755)
            with self.assertRaises(KeyError):  # nothing is taken for granted of a report that says nothing
                adapted.run(given, program, folder)
            self.assertTrue(adapted.surface_breaches(given, given.model.mesh, medit.read(folder / f"{given.name}-1.mesh")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
