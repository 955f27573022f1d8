# SPDX-License-Identifier: MIT
"""The rows of tests/cases that Gmsh has to mesh first: thin sheets, and a pipe whose wall is thinner than
its curved faces bend.

    geometry_cases_test.py TETMEND SOURCE     status 77: Gmsh is not here
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, CASES = sys.argv[1], Path(sys.argv[2]) / "tests" / "cases"


def meshed(folder: Path, name: str, *options: str) -> Path:
    out = folder / f"{name}.msh"
    command = ["gmsh", CASES / f"{name}.geo", "-3", *options, "-nopopup", "-o", out]
    subprocess.run(command, check=True, capture_output=True)
    return out


def improved(file: Path, *options: str) -> tuple[dict, str, Path]:
    """The report, what the run says, and the mesh."""
    out, report = file.with_name("better.msh"), file.with_name("report.json")
    command = [PROGRAM, "improve", file, "-o", out, "--report", report, "-v", *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{options}: status {done.returncode}: {done.stderr}")
    return json.loads(report.read_text()), done.stdout + done.stderr, out


def nodes(file: Path) -> dict:
    """Of an ASCII file of version 2.2: places by number."""
    lines = file.read_text().split("$Nodes\n")[1].split("$EndNodes")[0].splitlines()[1:]
    return {row[0]: tuple(map(float, row[1:4])) for row in map(str.split, lines)}


def surface_nodes(file: Path, elements: set[str]) -> set:
    """Places of the nodes of elements of these types."""
    places = nodes(file)
    rows = [line.split() for line in file.read_text().split("$Elements\n")[1].split("$EndElements")[0].splitlines()[1:]]
    return {places[v] for row in rows if row[1] in elements for v in row[3 + int(row[2]):]}


def thin_sheets(folder: Path) -> list[str]:
    mesh = meshed(folder, "thin-sheets")
    wrong = []
    # The film is thinner than its mesh everywhere: its own faces force most of what is left, however many bad
    # tets Gmsh made, which are 3,800 to 4,000 and others in each run.
    for options, most in (((), 2200), (("--layers", "improve"), 2000)):
        report, text, _ = improved(mesh, *options)
        before, after = report["before"]["n_bad"], report["after"]["n_bad"]
        if not (before > 3000 and after <= most):
            wrong.append(f"thin-sheets {options}: {before} bad tets became {after}")
        if "state after pass 0" in text:
            wrong.append(f"thin-sheets {options}: the whole run was thrown away")
    return wrong


def thin_wall_curved(folder: Path) -> list[str]:
    mesh = meshed(folder, "thin-wall-curved", "-order", "2", "-format", "msh22", "-setnumber", "Mesh.SaveAll", "1")
    wrong = []
    report, text, out = improved(mesh)
    before, after = (report[when]["second_order"]["turned_over"] for when in ("before", "after"))
    if not (before > 100 and after < 20 and after > 0):
        wrong.append(f"thin-wall-curved: {before} turned over became {after}")
    if f"stay turned over: {after}; nodes on edges that stay hold them" not in text or "--straighten" not in text:
        wrong.append("thin-wall-curved: no word on what holds the rest and what helps")
    if surface_nodes(mesh, {"9"}) != surface_nodes(out, {"9"}):
        wrong.append("thin-wall-curved: a node of the surface moved")
    report, text, out = improved(mesh, "--straighten")
    after = report["after"]["second_order"]["turned_over"]
    if after != 0 or "made straight: " not in text:
        wrong.append(f"thin-wall-curved --straighten: {after} stay turned over")
    return wrong


def main() -> int:
    if shutil.which("gmsh") is None:
        print("skipped: Gmsh is not here, which meshes thin-sheets.geo and thin-wall-curved.geo; install gmsh")
        return 77
    wrong = []
    for case in (thin_sheets, thin_wall_curved):
        with tempfile.TemporaryDirectory() as folder:
            wrong += case(Path(folder))
    print("\n".join(wrong) or "both are as their rows say")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
