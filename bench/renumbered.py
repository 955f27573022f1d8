# SPDX-License-Identifier: MIT
"""How much of a result depends on the order in which a file lists vertices and tets.

Runs schedules on a mesh and on copies with vertices, tets and the corners of each tet in another
order, made from seeds 1, 2, and so on. Of the copies it tells the median and the worst.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import compare
import documents
import medit
import report

sys.path.insert(0, str(Path(__file__).resolve().parent / "experiments"))
import common  # noqa: E402

SCHEDULES = ["shell", "thorough"]
NO_PASSES = 'description "Leaves the mesh as it is"\n'
TEXT = (
    "Each mesh as its file has it, and copies whose vertices, tets and corners of tets stand in "
    "another order. A *bad* tet has an angle under 30 or over 150 degrees; *edge ratio* is that of "
    "the longest to the shortest edge of a tet, at worst; *faces above 70* have more than 70 "
    "degrees of non-orthogonality. *user s* is the processor time of improving on one thread: that "
    "of the run less that of a run without passes, which reads, measures and writes."
)


@dataclass(frozen=True)
class Column:
    """A figure of a run, and which of several is the worst."""

    figure: Callable[[dict], float]
    worst: Callable[[Iterable[float]], float]
    shown: Callable[[float], str]


def count(value: float) -> str:
    return f"{value:,.0f}" if value == round(value) else f"{value:,.1f}"


COLUMNS = {
    "bad": Column(lambda run: run["n_bad"], max, count),
    "theta_min": Column(lambda run: run["theta_min"], min, report.angle),
    "theta_max": Column(lambda run: run["theta_max"], max, report.angle),
    "edge ratio": Column(lambda run: run["rulers"]["edge_ratio"]["worst"], max,
                         lambda value: f"{value:.2f}"),
    "faces above 70": Column(lambda run: run["rulers"]["faces_above_70"], max, count),
    "user s": Column(lambda run: run["user_seconds"], max, report.seconds),
}


# --- runs


def improved(mesh: Path, schedule: str, folder: Path) -> dict:
    """What a run told about its result, and its processor time."""
    told, result = folder / "report.json", folder / "result.meshb"
    seconds = common.user_seconds(
        [str(compare.BUILD / "bin" / "tetmend"), "improve", str(mesh), "-o", str(result), "--quiet",
         "--threads", "1", "--schedule", schedule, "--report", str(told)])
    run = json.loads(told.read_text())
    return {**run["after"], "before": run["before"], "user_seconds": seconds}


def as_medit(mesh: Path, folder: Path) -> medit.Mesh:
    plain = folder / "plain.mesh"
    subprocess.run([compare.BUILD / "bin" / "tetmend", "convert", mesh, plain], check=True,
                   stdout=subprocess.DEVNULL)
    return medit.read(plain)


def measure(mesh: Path, schedules: list[str], copies: int, folder: Path) -> dict[str, list[dict]]:
    """By schedule, the run on the file itself, then those on its copies.

    @param folder  for what is needed meanwhile"""
    nothing, copy = folder / "nothing.lua", folder / "copy.mesh"
    nothing.write_text(NO_PASSES)
    original = as_medit(mesh, folder)
    found: dict[str, list[dict]] = {schedule: [] for schedule in schedules}
    for seed in range(copies + 1):
        if seed > 0:
            medit.write(copy, medit.renumbered(original, seed))
        file = copy if seed > 0 else mesh
        idle = improved(file, str(nothing), folder)["user_seconds"]
        for schedule in schedules:
            run = improved(file, schedule, folder)
            run["user_seconds"] = max(0.0, run["user_seconds"] - idle)
            found[schedule].append(run)
            compare.progress(f"{mesh.stem}, {f'copy {seed}' if seed else 'file'}: {schedule}: "
                             f"{run['n_bad']:,} bad, {run['user_seconds']:.2f} s")
    return found


# --- tables


def rows(mesh: str, schedule: str, runs: list[dict]) -> documents.Table:
    """@param runs  that of the file itself first"""

    def row(name: str, of: Callable[[Column], float]) -> list[str]:
        return [mesh, schedule, name, *(column.shown(of(column)) for column in COLUMNS.values())]

    itself, *copies = runs
    table = [row("file", lambda column: column.figure(itself))]
    if copies:
        table += [row("median", lambda column: statistics.median(map(column.figure, copies))),
                  row("worst", lambda column: column.worst(map(column.figure, copies)))]
    return table


def before(mesh: str, run: dict) -> list[str]:
    figures = {**run["before"], "user_seconds": 0.0}
    cells = [column.shown(column.figure(figures)) for column in COLUMNS.values()]
    return [mesh, "(input)", "", *cells[:-1], ""]


def table_of(measured: dict[str, dict[str, list[dict]]]) -> documents.Table:
    """@param measured  by mesh and schedule"""
    table = [["mesh", "schedule", "run", *COLUMNS]]
    for mesh, found in measured.items():
        table.append(before(mesh, next(iter(found.values()))[0]))
        for schedule, runs in found.items():
            table += rows(mesh, schedule, runs)
    return table


def page(made: documents.Stamp, copies: int, table: documents.Table) -> str:
    parts = [TEXT, f"{copies} copies of each mesh.", documents.markdown_table(table)]
    return documents.document("The same mesh in other orders", made, parts)


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --renumbered", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("meshes", nargs="+", metavar="MESH", help="file, or name of a default mesh")
    add("--copies", type=int, default=10, metavar="N", help="of each mesh (default: 10)")
    add("--schedule", action="append", default=[], metavar="NAME",
        help=f"may be repeated (default: {' and '.join(SCHEDULES)})")
    add("--build", type=Path, default=compare.BUILD, help="build folder")
    documents.add_option(parser)
    options = parser.parse_args()
    compare.BUILD = options.build.resolve()
    measured = {}
    for name in options.meshes:
        mesh = compare.named_mesh(name)
        with tempfile.TemporaryDirectory() as folder:
            measured[mesh.stem] = measure(mesh, options.schedule or SCHEDULES, options.copies,
                                          Path(folder))
    table = table_of(measured)
    print(report.text_table(table))
    if options.write:
        made = documents.stamp("script/bench --renumbered")
        documents.write(options.write, page(made, options.copies, table))


if __name__ == "__main__":
    main()
