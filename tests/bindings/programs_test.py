# SPDX-License-Identifier: MIT
"""The examples in C and Fortran do what the command line does, leak nothing, and survive without memory.

    programs_test.py SOURCE BUILD TETMEND FAILING_MALLOC

What needs a program that is not installed (gfortran, valgrind) is named and passed over.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, BUILD, TETMEND, FAILING_MALLOC = (Path(word).resolve() for word in sys.argv[1:5])
STRICT = ["-std=c89", "-pedantic", "-Wall", "-Wextra", "-Werror"]
LINK = [f"-L{BUILD}", "-ltetmend", f"-Wl,-rpath,{BUILD}"]
WORK = Path(tempfile.mkdtemp(prefix="tetmend-"))


def call(*words: object, **more: object) -> subprocess.CompletedProcess:
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=WORK, timeout=600, **more)


def build_c(source: Path) -> Path:
    program = WORK / f"c_{source.stem}"
    made = call("cc", *STRICT, "-O1", "-g", f"-I{SOURCE}/include", source, "-o", program, *LINK)
    assert made.returncode == 0, made.stderr
    return program


def build_fortran(source: Path) -> Path:
    program = WORK / f"fortran_{source.stem}"
    module = SOURCE / "bindings/fortran/tetmend.f90"
    made = call("gfortran", "-std=f2008", "-Wall", "-Werror", "-fcheck=all", module, source, "-o", program, *LINK)
    assert made.returncode == 0, made.stderr
    return program


def programs(name: str) -> list[Path]:
    """The example in each language that there is a compiler for."""
    built = [build_c(SOURCE / f"examples/c/{name}.c")]
    if shutil.which("gfortran"):
        built.append(build_fortran(SOURCE / f"examples/fortran/{name}.f90"))
    else:
        print(f"passed over, gfortran is not installed: examples/fortran/{name}.f90")
    return built


def improve(mesh: Path, *options: str) -> tuple[bytes, dict, str]:
    """What the command line makes of a mesh: the file, the report, and the text."""
    run = call(TETMEND, "improve", mesh, "-o", "expected.mesh", "-v", "--report", "report.json", *options)
    assert run.returncode in (0, 3), run.stderr  # 3: a tet misses the goal
    return (WORK / "expected.mesh").read_bytes(), json.loads((WORK / "report.json").read_text()), run.stdout


def figures(text: str) -> dict[str, list[str]]:
    """Rows of two numbers by their names."""
    return {row[1].strip(): [row[2].replace(",", ""), row[3].replace(",", "")]
            for row in re.finditer(r"^(\S.*?) +([\d.,]+) +([\d.,]+)$", text, re.M)}


class Examples(unittest.TestCase):
    def test_a_file_is_improved_as_by_the_command_line(self) -> None:
        cases = [("sheet.mesh", []), ("two_materials.mesh", ["schedule", "conservative", "goal", "25,155"])]
        for name, options in cases:
            mesh = SOURCE / "assets/meshes" / name
            words = [f"--{word}" if i % 2 == 0 else word for i, word in enumerate(options)]
            expected, report, text = improve(mesh, *words)
            printed = figures(text)
            for program in programs("improve_file"):
                run = call(program, mesh, "out.mesh", *options)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual((WORK / "out.mesh").read_bytes(), expected, f"{program} {name}")
                rows = figures(run.stdout)
                fields = {"tets": "tets", "points": "vertices", "boundary triangles": "boundary_triangles",
                          "theta_min, degrees": "theta_min", "theta_max, degrees": "theta_max",
                          "lambda %": "lambda", "q_worst": "q_worst", "bad tets": "n_bad"}
                self.assertEqual(rows.keys(), fields.keys())
                for row, field in fields.items():
                    for i, when in enumerate(("before", "after")):
                        value = report[when][field]
                        self.assertEqual(rows[row][i], f"{value:.4f}" if "." in rows[row][i] else str(value), row)
                for row in ("tets", "points", "theta_min, degrees", "theta_max, degrees"):
                    self.assertEqual([float(x) for x in rows[row]], [float(x) for x in printed[row]], row)

    def test_a_mesh_made_in_memory_is_improved_as_from_its_file(self) -> None:
        outputs = set()
        for program in programs("cube_lattice"):
            run = call(program, "before.mesh", "after.mesh")
            self.assertEqual(run.returncode, 0, run.stderr)
            expected, report, _ = improve(WORK / "before.mesh")
            self.assertEqual((WORK / "after.mesh").read_bytes(), expected, str(program))
            self.assertGreater(report["before"]["n_bad"], 100)
            rows = figures(run.stdout)
            self.assertEqual(rows["bad tets"], [str(report[when]["n_bad"]) for when in ("before", "after")])
            self.assertEqual(rows["theta_min"], [f"{report[when]['theta_min']:.4f}" for when in ("before", "after")])
            outputs.add((WORK / "before.mesh").read_bytes() + expected)
        self.assertEqual(len(outputs), 1, "C and Fortran make different meshes")

    def test_groups_go_through_the_fortran_module(self) -> None:
        if not shutil.which("gfortran"):
            self.skipTest("gfortran is not installed")
        run = call(build_fortran(SOURCE / "tests/bindings/groups.f90"))
        self.assertEqual((run.returncode, run.stdout), (0, "ok\n"), run.stdout + run.stderr)

    def test_fortran_arrays_of_the_wrong_shape_are_told(self) -> None:
        if not shutil.which("gfortran"):
            self.skipTest("gfortran is not installed")
        run = call(build_fortran(SOURCE / "tests/bindings/shapes.f90"))
        self.assertEqual((run.returncode, run.stdout), (0, "ok\n"), run.stdout + run.stderr)

    def test_a_mistake_is_told_in_one_line(self) -> None:
        for program in programs("improve_file"):
            for words, reason in [(["missing.mesh", "out.mesh"], "missing.mesh"),
                                  (["missing.mesh", "out.mesh", "threads", "0"], "threads: '0' is not a whole number"),
                                  ([SOURCE / "assets/meshes/sheet.mesh", "no/out.mesh"], "no/out.mesh")]:
                run = call(program, *words)
                self.assertEqual(run.returncode, 1)
                self.assertTrue(run.stderr.startswith(f"improve_file: {reason}"), run.stderr)
                lines = [line for line in run.stderr.splitlines() if line != "STOP 1"]  # gfortran says that too
                self.assertEqual(len(lines), 1, run.stderr)

    def test_running_out_of_memory_is_a_status(self) -> None:
        program = build_c(SOURCE / "examples/c/cube_lattice.c")
        library = call("ldd", program).stdout
        self.assertIn("libtetmend", library)
        told = 0
        for at in [*range(0, 60, 3), *range(100, 20000, 997)]:
            environment = {**os.environ, "LD_PRELOAD": str(FAILING_MALLOC), "TETMEND_FAIL_AT": str(at)}
            run = call(program, "before.mesh", "after.mesh", env=environment)
            self.assertIn(run.returncode, (0, 1), f"allocation {at}: {run.stderr}")
            if run.returncode == 1:
                self.assertIn("memory", run.stderr, f"allocation {at}")
                told += 1
        self.assertGreater(told, 10)

    def test_a_thousand_handles_leave_nothing(self) -> None:
        if shutil.which("valgrind") is None:
            print("passed over, valgrind is not installed: a thousand handles")
            return
        program = build_c(SOURCE / "tests/bindings/thousand.c")
        run = call("valgrind", "--quiet", "--leak-check=full", "--errors-for-leak-kinds=definite,indirect",
                   "--show-leak-kinds=definite,indirect", "--error-exitcode=9", program)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)


if __name__ == "__main__":
    try:
        unittest.main(argv=sys.argv[:1])
    finally:
        shutil.rmtree(WORK, ignore_errors=True)
