# SPDX-License-Identifier: MIT
"""Whether the bench notices a broken promise, and what it makes of a mesh in another order.

promises_test.py SOURCE_FOLDER [BUILD_FOLDER]   without a build folder tetmend is not run
"""

import dataclasses
import math
import statistics
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
BUILD = Path(sys.argv[2]) if len(sys.argv) > 2 else None
sys.path.insert(0, str(SOURCE / "bench"))
import documents  # noqa: E402
import kinds  # noqa: E402
import medit  # noqa: E402
import promises  # noqa: E402
import renumbered  # noqa: E402
import yardstick  # noqa: E402

GOAL = (30.0, 150.0)
REGULAR = [(1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)]
CORNER = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]


def named(breaches: list[promises.Breach]) -> list[str]:
    return [breach.what for breach in breaches]


def changed(mesh: medit.Mesh, vertex: int, point: medit.Point) -> medit.Mesh:
    points = [*mesh.points[:vertex], point, *mesh.points[vertex + 1:]]
    return dataclasses.replace(mesh, points=points)


class Yardstick(unittest.TestCase):
    def test_the_regular_tet_has_the_best_figures(self) -> None:
        tet = yardstick.tet_figures(REGULAR)
        for angle in tet.angles:
            self.assertAlmostEqual(angle, math.degrees(math.acos(1 / 3)), places=12)
        for ratio in (tet.mean_ratio, tet.radius_ratio, tet.edge_ratio):
            self.assertAlmostEqual(ratio, 1, places=12)

    def test_the_corner_of_a_cube_has_known_figures(self) -> None:
        tet = yardstick.tet_figures(CORNER)
        slope = math.degrees(math.acos(1 / math.sqrt(3)))
        for angle, known in zip(sorted(tet.angles), [slope] * 3 + [90] * 3, strict=True):
            self.assertAlmostEqual(angle, known, places=12)
        self.assertAlmostEqual(tet.edge_ratio, math.sqrt(2), places=12)
        self.assertAlmostEqual(tet.mean_ratio, 12 * 0.5 ** (2 / 3) / 9, places=12)
        inradius, circumradius = 1 / (3 + math.sqrt(3)), math.sqrt(3) / 2
        self.assertAlmostEqual(tet.radius_ratio, 3 * inradius / circumradius, places=12)

    def test_a_tet_is_inverted_by_less_than_doubles_can_tell(self) -> None:
        third = 1 / 3
        flat = [(0.0, 0.0, third), (1.0, 0.0, third), (0.0, 1.0, third)]
        self.assertEqual(yardstick.orientation([*flat, (third, third, third)]), 0)
        self.assertEqual(yardstick.orientation([*flat, (third, third, third + 2 ** -54)]), 1)
        self.assertEqual(yardstick.orientation([*flat, (third, third, third - 2 ** -54)]), -1)

    def test_steep_faces_are_those_above_70_degrees(self) -> None:
        def two_tets(x: float) -> medit.Mesh:
            """Their face is horizontal, their centroids are x apart sideways, 1 upwards."""
            apex = (1 / 3, 1 / 3, -2.0), (1 / 3 + 4 * x, 1 / 3, 2.0)
            return medit.Mesh([*CORNER[:3], *apex], [(0, 2, 1, 3), (0, 1, 2, 4)])

        for x, count in ((math.tan(math.radians(69.9)), 0), (math.tan(math.radians(70.1)), 1)):
            mesh = two_tets(x)
            self.assertEqual(yardstick.measure(mesh, GOAL).not_positive, 0)
            self.assertEqual(yardstick.measure(mesh, GOAL).steep_faces, count)


class Meshes(unittest.TestCase):
    def test_a_mesh_that_was_written_is_read_bit_by_bit(self) -> None:
        mesh = kinds.make("sheet", 0)
        with tempfile.TemporaryDirectory() as folder:
            medit.write(Path(folder) / "mesh.mesh", mesh)
            self.assertEqual(medit.read(Path(folder) / "mesh.mesh"), mesh)

    def test_the_same_kind_and_number_make_the_same_mesh(self) -> None:
        self.assertEqual(kinds.make("materials", 3), kinds.make("materials", 3))
        self.assertNotEqual(kinds.make("materials", 3), kinds.make("materials", 4))

    def test_a_renumbered_mesh_is_the_same_mesh(self) -> None:
        mesh = kinds.make("sheet", 1)
        other = medit.renumbered(mesh, 1)
        self.assertNotEqual([tuple(sorted(tet)) for tet in mesh.tets],
                            [tuple(sorted(tet)) for tet in other.tets])
        self.assertNotEqual(mesh.points, other.points)
        self.assertEqual(yardstick.surface(mesh), yardstick.surface(other))
        self.assertEqual(yardstick.measure(mesh, GOAL), yardstick.measure(other, GOAL))
        self.assertEqual(medit.renumbered(mesh, 1), other)
        self.assertNotEqual(medit.renumbered(mesh, 2), other)


class Promises(unittest.TestCase):
    """Each promise, broken alone."""

    def setUp(self) -> None:
        self.before = yardstick.measure(kinds.make("materials", 1), GOAL)

    def broken(self, goal: float = 150.0, **figures: object) -> list[str]:
        after = dataclasses.replace(self.before, **figures)
        return named(promises.broken(self.before, after, goal))

    def test_an_unchanged_mesh_keeps_all(self) -> None:
        mesh = kinds.make("sheet", 2)
        _, _, broken, missed = promises.judged(mesh, medit.renumbered(mesh, 5), GOAL)
        self.assertEqual(broken + missed, [])

    def test_a_worse_figure_is_named(self) -> None:
        old = self.before
        worse = {
            "smaller theta_min": {"theta_min": old.theta_min * (1 - 1e-10)},
            "larger theta_max, over 150": {"theta_max": old.theta_max * (1 + 1e-10)},
            "more bad tets": {"bad": (old.bad[1] + 1, old.bad[1] + 1)},
            "higher lambda %": {"lambda_percent": (old.lambda_percent[1] + 1e-9,) * 2},
            "smaller worst mean ratio": {"worst_mean_ratio": old.worst_mean_ratio * (1 - 1e-10)},
            "smaller worst radius ratio": {
                "worst_radius_ratio": old.worst_radius_ratio * (1 - 1e-10)},
            "larger worst edge ratio, over 10": {"edge_ratio": 10.001},
            "more tets that are not positive": {"not_positive": 1},
        }
        self.assertGreater(old.theta_max, 150)
        self.assertLess(old.edge_ratio, 10)
        for what, figures in worse.items():
            self.assertEqual(self.broken(**figures), [what])

    def test_what_the_promise_allows_is_no_breach(self) -> None:
        self.assertEqual(self.broken(edge_ratio=10.0), [])
        self.assertEqual(self.broken(theta_min=self.before.theta_min * (1 - 1e-14)), [])
        self.assertEqual(self.broken(160.0, theta_max=max(160, self.before.theta_max)), [])

    def test_an_aim_that_was_missed_is_no_breach(self) -> None:
        after = dataclasses.replace(self.before, mean_mean_ratio=0.1, mean_radius_ratio=0.1,
                                    steep_faces=self.before.steep_faces + 1)
        self.assertEqual(promises.broken(self.before, after, 150.0), [])
        self.assertEqual(len(promises.missed(self.before, after)), 3)

    def test_a_change_of_the_surface_is_named(self) -> None:
        mesh = kinds.make("materials", 1)
        both = ["lost surface faces", "new surface faces"]

        def judged(after: medit.Mesh) -> list[str]:
            return named(promises.judged(mesh, after, GOAL)[2])

        x, y, z = mesh.points[0]
        self.assertEqual(judged(changed(mesh, 0, (math.nextafter(x, -1), y, z)))[-2:], both)
        outer = {both[0][0] for both in yardstick.sides(mesh).values() if len(both) == 1}
        inner = next(i for i in range(len(mesh.tets)) if i not in outer)
        for tet in (next(iter(outer)), inner):
            labels = [3 - label if i == tet else label for i, label in enumerate(mesh.labels)]
            self.assertIn("new surface faces", judged(dataclasses.replace(mesh, labels=labels)))
        self.assertIn("lost surface faces", judged(dataclasses.replace(
            mesh, tets=mesh.tets[1:], labels=mesh.labels[1:])))
        self.assertEqual(named(promises.surface_broken(
            yardstick.surface(kinds.make("sheet", 1)),
            yardstick.surface(dataclasses.replace(kinds.make("sheet", 1), sections={})))), both[:1])

    def test_a_mesh_that_got_worse_breaks_promises(self) -> None:
        mesh = kinds.make("stretched", 0)
        inner = max(range(len(mesh.points)), key=lambda v: sum(v in tet for tet in mesh.tets))
        tet = next(tet for tet in mesh.tets if inner in tet)
        others = [mesh.points[v] for v in tet if v != inner]
        ways = list(zip(map(statistics.mean, zip(*others, strict=True)), mesh.points[inner],
                        strict=True))  # to the middle of the face opposite, and from

        def broken(part: float) -> list[str]:
            moved = tuple(there + part * (here - there) for there, here in ways)
            return named(promises.judged(mesh, changed(mesh, inner, moved), GOAL)[2])

        self.assertEqual(broken(1), [])
        for what in ("smaller theta_min", "smaller worst mean ratio"):
            self.assertIn(what, broken(1e-7))
        self.assertIn("more tets that are not positive", broken(-1))


class Tables(unittest.TestCase):
    def test_broken_promises_are_counted_and_listed_with_their_command(self) -> None:
        figures = yardstick.measure(kinds.make("tangled", 3), GOAL)
        breach = promises.Breach("more bad tets", 1, 2)
        kept = promises.Outcome("tangled", "tangled-3", "shell", "tetmend improve", [], [], figures,
                                figures)
        outcomes = [kept, dataclasses.replace(kept, mesh="tangled-4", broken=[breach])]
        made = documents.Stamp("script/bench --promises", "0123abc", "2026-11-22", "AMD EPYC")
        text = promises.page(made, outcomes)
        [(_, table)] = documents.tables(text)
        self.assertEqual(table[1][:6], ["tangled", "shell", "2", "1", "0", "0"])
        self.assertIn("tangled-4, shell: more bad tets: 1 -> 2 (`tetmend improve`)", text)
        self.assertIn("2 runs on 2 meshes, 1 promises broken.", text)

    def test_of_copies_the_median_and_the_worst_are_told(self) -> None:
        def run(bad: int, theta_min: float) -> dict:
            return {"n_bad": bad, "theta_min": theta_min, "theta_max": 180 - theta_min,
                    "rulers": {"edge_ratio": {"worst": 3.0}, "faces_above_70": 1},
                    "user_seconds": 0.5}

        runs = [run(5, 20), run(9, 21), run(1, 23), run(4, 22)]
        runs[0]["before"] = run(99, 1)
        table = renumbered.table_of({"cube": {"shell": runs}})
        self.assertEqual([row[2:6] for row in table[1:]],
                         [["", "99", "1.00", "179.00"], ["file", "5", "20.00", "160.00"],
                          ["median", "4", "22.00", "158.00"], ["worst", "9", "21.00", "159.00"]])


@unittest.skipIf(BUILD is None, "no build folder")
class Runs(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_bench(self, name: str, *arguments: str) -> tuple[subprocess.CompletedProcess, str]:
        """And the document that it wrote."""
        page = self.folder / "page.md"
        command = [sys.executable, "-B", SOURCE / "bench" / f"{name}.py", "--build", BUILD,
                   "--write", page, *arguments]
        ran = subprocess.run(command, capture_output=True, text=True, check=False)
        return ran, page.read_text()

    def test_small_meshes_keep_their_promises(self) -> None:
        file = self.folder / "own.mesh"
        medit.write(file, kinds.make("materials", 1))
        ran, text = self.run_bench("promises", "tangled-3", "layers-3", str(file), "-o",
                                   str(self.folder / "results"))
        self.assertEqual(ran.returncode, 0, ran.stdout)
        self.assertIn("27 runs on 3 meshes, 0 promises broken.", text)
        self.assertEqual(list((self.folder / "results").iterdir()), [])

    def test_a_program_that_makes_a_mesh_worse_is_caught_and_the_mesh_kept(self) -> None:
        """A stand-in writes another mesh, with a report."""
        bin_folder = self.folder / "bin"
        bin_folder.mkdir()
        medit.write(self.folder / "worse.mesh", kinds.make("tangled", 7))
        program = bin_folder / "tetmend"
        program.write_text(f"#!/bin/sh\ncp {self.folder}/worse.mesh \"$4\"\n"
                           "echo '{\"notes\": []}' > \"$7\"\n")
        program.chmod(0o755)
        task = promises.Task("tangled", 3, None, {"shell": []}, program, self.folder)
        [outcome] = promises.perform(task)
        self.assertIn("lost surface faces", named(outcome.broken))
        self.assertEqual(outcome.command, "tetmend improve tangled-3.mesh -o tangled-3-shell.mesh")
        self.assertTrue((self.folder / "tangled-3.mesh").exists())
        self.assertTrue((self.folder / "tangled-3-shell.mesh").exists())

    def test_copies_of_a_mesh_are_run_with_each_schedule(self) -> None:
        ran, text = self.run_bench("renumbered", "sheet", "--copies", "2", "--schedule", "shell",
                                   "--schedule", "conservative")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        [(_, table)] = documents.tables(text)
        self.assertEqual([row[:3] for row in table[1:]],
                         [["sheet", "(input)", ""],
                          *(["sheet", schedule, run] for schedule in ("shell", "conservative")
                            for run in ("file", "median", "worst"))])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
