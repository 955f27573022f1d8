# SPDX-License-Identifier: MIT
"""The rulers of tetmend beside those of the programs that they come from, Gmsh and VTK, and those of
solvers beside what DOLFINx and CalculiX make of the mesh.

A program that is not installed is named and left out. Exit status: 0 all figures are equal, 1 some
are not, 77 there is nothing to compare with.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import competitors

SOURCE = Path(__file__).resolve().parent.parent
MESHES = ["bracket.meshb", "sheet.mesh", "two_materials.mesh"]
RIVALS = {  # name: Python module or program, script, format that it reads, Debian package
    "Gmsh": ("gmsh", ["gmsh_rulers.py"], ".mesh", "python3-gmsh"),
    "VTK": ("vtkmodules", ["vtk_rulers.py"], ".vtk", "python3-vtk9"),
    "DOLFINx": ("dolfinx", ["dolfinx_solve.py", "--values"], ".mesh", "python3-dolfinx"),
    "CalculiX": ("ccx", ["ccx_solve.py", "--values"], ".mesh", "calculix-ccx"),
}
FIGURES = ["worst", "one_percent", "mean"]
SMALL_IS_GOOD = {"condition", "aspect_ratio", "edge_ratio"}
NOTHING_TO_COMPARE = 77


def figures(ruler: str, values: list[float]) -> dict[str, float]:
    worst_first = sorted(values, reverse=ruler in SMALL_IS_GOOD)
    return {"worst": worst_first[0], "one_percent": worst_first[(len(values) + 99) // 100 - 1],
            "mean": sum(values) / len(values)}


def rows(tetmend: Path, mesh: Path, rivals: dict[str, str]) -> list[tuple[str, ...]]:
    """Mesh, program, ruler, figure, theirs, ours, and a mark where they differ."""
    run = lambda *command: subprocess.run(command, check=True, capture_output=True, text=True).stdout
    ours = json.loads(run(tetmend, "quality", mesh, "--json"))["rulers"]
    table = []
    with tempfile.TemporaryDirectory() as folder:
        for name, python in rivals.items():
            _, (script, *options), extension, _ = RIVALS[name]
            copy = Path(folder) / f"mesh{extension}"
            run(tetmend, "convert", mesh, copy)
            told = json.loads(run(python, "-B", competitors.RIVALS / script, *options, copy))
            all_of = {ruler: figures(ruler, values)
                      for ruler, values in told.get("values", {}).items()}
            for ruler, theirs_of in (all_of | told.get("figures", {})).items():
                tolerance = told["tolerance"]
                for figure, theirs in theirs_of.items():
                    here = ours[ruler][figure]
                    differ = abs(theirs - here) > tolerance * max(abs(theirs), abs(here))
                    table.append((mesh.stem, f"{name} {told['version']}", ruler, figure,
                                  f"{theirs:.12g}", f"{here:.12g}", "differ" if differ else ""))
    return table


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", type=Path, metavar="MESH",
                        default=[SOURCE / "assets" / "meshes" / name for name in MESHES])
    parser.add_argument("--build", type=Path, default=SOURCE / "build" / "release")
    options = parser.parse_args()
    rivals = {name: competitors.module(row[0]) or competitors.program(row[0]) and sys.executable
              for name, row in RIVALS.items()}
    for name, python in rivals.items():
        if python is None:
            print(f"{name} is not compared: install the package {RIVALS[name][3]}")
    rivals = {name: python for name, python in rivals.items() if python is not None}
    if not rivals:
        return NOTHING_TO_COMPARE
    table = [row for mesh in options.meshes
             for row in rows(options.build / "bin" / "tetmend", mesh, rivals)]
    for row in table:
        print("{:<14} {:<14} {:<14} {:<12} {:>16} {:>16} {}".format(*row).rstrip())
    differing = sum(row[-1] != "" for row in table)
    print(f"{len(table)} figures, {differing} differ")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
