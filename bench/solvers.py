# SPDX-License-Identifier: MIT
"""What solvers feel of a mesh and of what improvers make of it, with DOLFINx and CalculiX as judges.

Every improver of this machine that keeps the surface runs on the same meshes. Judges solve equations
on what they leave; see bench/rivals/dolfinx_solve.py and ccx_solve.py.
"""

import argparse
import json
import math
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import compare
import competitors
import documents
import report
from compare import Row
from competitors import Competitor

TEXT = (
    "The first row of each table has figures of the input, the others what has become of them, as a "
    "factor. *error*: of the gradient, relative, of Poisson's equation with linear elements and a "
    "smooth solution that is known; *at equal points* it is multiplied by the cube root of the factor "
    "of the points, as if the mesh had been made finer evenly. *CG* are steps of conjugate gradients "
    "to 1e-8 with Jacobi's preconditioner and with algebraic multigrid (GAMG); *work* is tets by "
    "steps with Jacobi's. *step*: the largest stable one of explicit time integration with lumped "
    "mass; *explicit cost* is tets by step. So far DOLFINx. *ccx CG*: iterations of CalculiX with "
    "diagonal scaling, of a body that hangs from one end; *ccx step*: its stable time increment for "
    "explicit dynamics. *estimated CG* and *ruler step* are the rulers `cg_steps` and `step` of "
    "tetmend. Less is better, but of steps more. All tets are of one material."
)
MEANS = (
    "Geometric means over the meshes that an improver took, without inverted tets and with the "
    "surface as it was; in brackets on how many meshes it is worse than the input by more than 2 %."
)


@dataclass(frozen=True)
class Column:
    title: str
    value: Callable[[dict], float | None]  # of what judges found
    more_is_better: bool = False
    is_factor: bool = False  # says nothing about one mesh


def ratio(above: str, below: str) -> Callable[[dict], float | None]:
    return lambda told: told[above] / told[below] if told.get(above) and told.get(below) else None


COLUMNS = [
    Column("tets", lambda told: told["tets"]),
    Column("points", lambda told: told["points"]),
    Column("error", lambda told: told.get("error")),
    Column("at equal points",
           lambda told: told["error"] * told["points"] ** (1 / 3) if "error" in told else None,
           is_factor=True),
    Column("CG, Jacobi", lambda told: told.get("jacobi")),
    Column("CG, multigrid", lambda told: told.get("amg")),
    Column("work", lambda told: told["tets"] * told["jacobi"] if "jacobi" in told else None),
    Column("step", lambda told: told.get("dt"), more_is_better=True),
    Column("explicit cost", ratio("tets", "dt")),
    Column("ccx CG", lambda told: told.get("iterations")),
    Column("ccx step", lambda told: told.get("explicit"), more_is_better=True),
    Column("estimated CG", lambda told: told.get("estimate")),
    Column("ruler step", lambda told: told.get("ruler step"), more_is_better=True),
]


@dataclass
class Judged:
    program: str
    status: str
    told: dict

    def is_good(self) -> bool:
        return self.status == "ok"


# --- judging


def judges() -> dict[str, str]:
    """Python for the script of each judge that is here."""
    found = {"dolfinx_solve.py": competitors.module("dolfinx"),
             "ccx_solve.py": competitors.program("ccx") and sys.executable}
    missing = [name for name, python in found.items() if python is None]
    if missing:
        packages = "python3-dolfinx and calculix-ccx"
        compare.progress(f"{', '.join(missing)}: please install the packages {packages}")
    return {name: python for name, python in found.items() if python is not None}


def judge(mesh: Path, folder: Path) -> dict:
    """What the judges find; those that fail leave out what is theirs."""
    plain = folder / "judged.mesh"  # tets and surface alone, whatever else the improver wrote
    subprocess.run([compare.BUILD / "bench" / "prepare", mesh, plain], check=True)
    quality = subprocess.run([compare.BUILD / "bin" / "tetmend", "quality", plain, "--json"],
                             check=True, capture_output=True, text=True).stdout
    rulers = json.loads(quality)["rulers"]
    told = {"estimate": rulers.get("cg_steps"),
            "ruler step": rulers.get("step", {}).get("worst")}
    for script, python in judges().items():
        ran = subprocess.run([python, "-B", competitors.RIVALS / script, plain], check=False,
                             capture_output=True, text=True)
        if ran.returncode == 0:
            told |= json.loads(ran.stdout)
        else:
            compare.progress(f"{script}: {ran.stderr.strip().splitlines()[-1:]}")
    return told


def judged(row: Row, inputs: Path, folder: Path, limit: float) -> Judged:
    compare.run_once(row, inputs, folder, limit)
    if row.status() != "ok":
        return Judged(row.competitor.name, row.status(), {})
    after, surface = row.quality["after"], row.quality["surface"]
    if after["inverted"] + after["flat"] > 0:
        return Judged(row.competitor.name, "inverted tets", {})
    if surface["surface"] == "changed":
        return Judged(row.competitor.name, "surface changed", {})
    told = judge(folder / row.competitor.output, folder)
    return Judged(row.competitor.name, "ok", told | {name: after[name] for name in ("tets", "points")})


def rows(only: list[str]) -> list[Competitor]:
    tetmend = compare.BUILD / "bin" / "tetmend"
    all_rows = [*competitors.purpose_rows(tetmend), *competitors.competitors(tetmend)]
    all_rows = [row for row in all_rows if row.name != "tetmend, 2 threads"]  # the same bytes
    found = compare.chosen([*all_rows, competitors.cgal_row("CGAL")], only)
    for row in found:
        if row.found is None:
            compare.progress(f"{row.name}: {row.hint}")
    return [row for row in found if row.found is not None]


def measure(mesh: Path, found: list[Competitor], limit: float) -> tuple[dict, list[Judged]]:
    inputs = compare.WORK / "inputs" / mesh.stem
    compare.prepare(mesh, inputs)
    folder = compare.fresh_folder(compare.WORK / "runs" / mesh.stem / "input")
    before = compare.program_json("measure", str(inputs / "input.mesh"))["before"]
    base = judge(inputs / "input.mesh", folder) | {name: before[name] for name in ("tets", "points")}
    results = []
    for row in found:
        place = compare.WORK / "runs" / mesh.stem / row.short.replace(" ", "_")
        results.append(judged(Row(row), inputs, place, limit))
        compare.progress(f"{mesh.stem}: {row.name}: {results[-1].status}")
    return base, results


# --- tables


def factor(column: Column, base: dict, told: dict) -> float | None:
    then, now = column.value(base), column.value(told)
    return now / then if then and now is not None else None


def shown(value: float | None) -> str:
    return "" if value is None else f"{value:.2f}"


def absolute(value: float | None) -> str:
    return "" if value is None else f"{value:,}" if isinstance(value, int) else f"{value:.3g}"


def table_of(base: dict, results: list[Judged]) -> documents.Table:
    table = [["improver", *(column.title for column in COLUMNS)],
             ["(input)", *("" if column.is_factor else absolute(column.value(base)) for column in COLUMNS)]]
    for one in results:
        cells = [shown(factor(column, base, one.told)) for column in COLUMNS] if one.is_good() else \
            [one.status, *[""] * (len(COLUMNS) - 1)]
        table.append([one.program, *cells])
    return table


def mean(column: Column, factors: list[float]) -> str:
    if not factors:
        return ""
    if min(factors) <= 0:
        return "0"
    worse = sum(f < 0.98 if column.more_is_better else f > 1.02 for f in factors)
    return f"{math.exp(sum(map(math.log, factors)) / len(factors)):.2f} ({worse})"


def means(all_results: list[tuple[dict, list[Judged]]]) -> documents.Table:
    table = [["improver", "meshes", *(column.title for column in COLUMNS)]]
    for name in [one.program for one in all_results[0][1]]:
        pairs = [(base, one.told) for base, results in all_results for one in results
                 if one.program == name and one.is_good()]
        cells = [mean(column, [f for base, told in pairs
                               if (f := factor(column, base, told)) is not None])
                 for column in COLUMNS]
        table.append([name, str(len(pairs)), *cells])
    return table


# --- the command line


def write(file: Path, parts: list[str]) -> None:
    made = documents.stamp("script/bench --solvers")
    documents.write(file, documents.document("What solvers feel", made, parts))


def shipped(mesh: Path) -> bool:
    return compare.ROOT / "assets" in mesh.resolve().parents


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --solvers", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("meshes", nargs="*", metavar="MESH", help="file, or name of a default mesh (default: the "
        "default meshes)")
    add("--only", action="append", default=[], metavar="NAME", help="improvers with NAME in theirs")
    add("--limit", type=float, default=600, metavar="SECONDS",
        help="of the processor, for each run (default: 600)")
    compare.add_folders(parser)
    documents.add_option(parser)
    options = parser.parse_args()
    compare.use_folders(options)
    meshes = [compare.named_mesh(name) for name in options.meshes] or compare.default_meshes(False)
    found = rows(options.only)
    parts, everything = [TEXT], []
    for mesh in meshes:
        base, results = measure(mesh, found, options.limit)
        everything.append((base, results))
        table = table_of(base, results)
        print(f"{mesh.stem}\n{report.text_table(table)}\n", flush=True)
        note = [] if shipped(mesh) else ["This mesh does not come with tetmend."]
        parts += [f"## {mesh.stem}", *note, documents.markdown_table(table)]
        if options.write:  # after each mesh: what was measured is not lost
            rest = ", ".join(each.stem for each in meshes[len(everything):])
            stopped = [f"Stopped before {rest}."] if rest else []
            write(options.write, [*parts, *stopped, "## all meshes", MEANS,
                                  documents.markdown_table(means(everything))])
    print(report.text_table(means(everything)))


if __name__ == "__main__":
    main()
