# SPDX-License-Identifier: MIT
"""What more cores make of a run: measured on those that this machine has, and by the model of bench/scaling.

A number in place of a mesh stands for a lattice of so many tets; it is modelled, not run. For the
model one thread measures the time of each block of the mesh; from these follows what 1 to 256
threads would take. --save keeps what was measured for --measured on a machine that writes the page.
"""

import argparse
import dataclasses
import json
import os
import re
import statistics
import subprocess
import tempfile
from pathlib import Path

import compare
import documents

TEXT = (
    "**A model, not a measurement.** Only the time of each block is measured, on one "
    "thread. From these follows what more threads would take: scans of the whole mesh split evenly, "
    "blocks go to the next free thread, the largest first, everything else waits. What many cores "
    "lose to memory and caches that they share is not in these figures, and it is much: compare what "
    "was measured. *alone %*: share of the time that one thread works alone. *deferred %*: targets "
    "that were tried again, for each that was tried."
)
MEASURED = (
    "**Measured** on {machine}, commit {commit}, {date}: seconds of the phases in the report of a "
    "run, {repeats}. All runs of a mesh gave the same bytes."
)
NAMES = {  # of the tables, by the first words of bench/scaling's headings
    "threads": "Speed-up by threads, with as many blocks as the size of the mesh asks for",
    "pass": "The same run, by passes",
    "blocks": "One thread for each block",
}


def tables_of(text: str) -> list[documents.Table]:
    """The tables that bench/scaling prints: lines whose columns stand two blanks apart, from a
    heading to an empty line."""
    tables: list[documents.Table] = []
    inside = False
    for line in text.splitlines():
        cells = re.split(r"\s{2,}", line.strip())
        if cells[0] in NAMES and len(cells) > 1:
            tables.append([cells])
            inside = True
        elif inside and len(cells) == len(tables[-1][0]):
            tables[-1].append(cells)
        else:
            inside = False
    return tables


def section(mesh: str, text: str) -> list[str]:
    """@param text  what bench/scaling printed for that mesh"""
    parts = [f"## {mesh}"]
    for table in tables_of(text):
        parts += [NAMES[table[0][0]] + ":", documents.markdown_table(table)]
    return parts


@dataclasses.dataclass
class Run:
    """One run of the program; seconds of the phases."""

    mesh: str
    schedule: str
    threads: int
    improving: float
    measuring: float
    whole: float


@dataclasses.dataclass
class Measured:
    """Runs on one machine, and what made them."""

    made: documents.Stamp
    runs: list[Run]

    def save(self, file: Path) -> None:
        file.write_text(json.dumps(dataclasses.asdict(self)))

    @staticmethod
    def load(file: Path) -> "Measured":
        told = json.loads(file.read_text())
        return Measured(documents.Stamp(**told["made"]), [Run(**run) for run in told["runs"]])


def measured_table(runs: list[Run]) -> documents.Table:
    """Medians over the runs of the same mesh, schedule and number of threads; speed-up against the
    fewest threads, times their number."""
    table = [["mesh", "schedule", "threads", "improving s", "speed-up", "measuring s", "whole s"]]
    groups: dict[tuple[str, str], dict[int, list[Run]]] = {}
    for run in runs:
        groups.setdefault((run.mesh, run.schedule), {}).setdefault(run.threads, []).append(run)
    for (mesh, schedule), by_threads in groups.items():
        improving = {threads: statistics.median(run.improving for run in same)
                     for threads, same in by_threads.items()}
        fewest = min(improving)
        for threads, same in sorted(by_threads.items()):
            speed_up = fewest * improving[fewest] / improving[threads]
            table.append([mesh, schedule, str(threads), f"{improving[threads]:.2f}", f"{speed_up:.1f}",
                          f"{statistics.median(run.measuring for run in same):.2f}",
                          f"{statistics.median(run.whole for run in same):.2f}"])
    return table


def measured_parts(measured: Measured) -> list[str]:
    groups: dict[tuple[str, str, int], int] = {}
    for run in measured.runs:
        key = (run.mesh, run.schedule, run.threads)
        groups[key] = groups.get(key, 0) + 1
    fewest = min(groups.values())
    repeats = "one of each" if fewest == 1 else f"the median of {fewest}"
    return [MEASURED.format(**dataclasses.asdict(measured.made), repeats=repeats),
            documents.markdown_table(measured_table(measured.runs))]


def page(made: documents.Stamp, printed: dict[str, str], measured: list[Measured] | None = None) -> str:
    """@param printed  output of bench/scaling by the name of the mesh
    @param measured  one for each machine; the pages show them first"""
    parts = [part for one in measured or [] for part in measured_parts(one)]
    if parts:
        parts = ["## Measured", *parts, "## By the model"]
    sections = [part for mesh, text in printed.items() for part in section(mesh, text)]
    return documents.document("Many cores", made, [*parts, TEXT, *sections])


def measure_run(mesh: Path, schedule: str, threads: int, folder: Path) -> tuple[Run, bytes]:
    """The run and the mesh that it left."""
    report, out = folder / "report.json", folder / "out.meshb"
    subprocess.run([compare.BUILD / "bin" / "tetmend", "improve", mesh, "-o", out, "--quiet", "--schedule",
                    schedule, "--threads", str(threads), "--report", report], check=True)
    seconds = json.loads(report.read_text())["seconds"]
    return Run(mesh.stem, schedule, threads, seconds["improving"], seconds["measuring"],
               sum(seconds.values())), out.read_bytes()


def measure_threads(meshes: list[Path], schedules: list[str], repeats: int) -> list[Run]:
    """On 1, 2, 4, ... threads up to all cores. Raises if the bytes of two runs differ."""
    cores = os.cpu_count() or 1
    counts = [1 << k for k in range(cores.bit_length()) if 1 << k < cores] + [cores]
    runs = []
    with tempfile.TemporaryDirectory() as folder:
        for mesh in meshes:
            for schedule in schedules:
                first = None
                for _ in range(repeats):
                    for threads in counts:
                        run, content = measure_run(mesh, schedule, threads, Path(folder))
                        first = first or content
                        if content != first:
                            raise SystemExit(f"{mesh}, {schedule}: {threads} threads give other bytes")
                        runs.append(run)
    return runs


def is_count(name: str) -> bool:
    """Of tets, not a mesh."""
    return re.fullmatch(r"[\d.]+(e\d+)?", name) is not None


def measure(name: str) -> tuple[str, str]:
    """Name of the mesh and what bench/scaling prints for it."""
    scaling = str(compare.BUILD / "bench" / "scaling")
    if not is_count(name):
        mesh = compare.named_mesh(name)
        return mesh.stem, subprocess.run([scaling, str(mesh)], check=True, stdout=subprocess.PIPE,
                                         text=True).stdout
    mesh = compare.WORK / "lattice.meshb"
    subprocess.run([compare.BUILD / "bench" / "lattice", name, mesh], check=True)
    text = subprocess.run([scaling, "--threads-only", str(mesh)], check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    mesh.unlink()
    return f"a lattice of about {float(name):,.0f} tets", text


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --cores", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="MESH", default=["1e7"],
                        help="file, name of a default mesh, or a number of tets (default: 1e7)")
    parser.add_argument("--schedule", action="append", metavar="NAME", help="to measure; may be repeated (default: shell)")
    parser.add_argument("--repeat", type=int, default=3, metavar="N", help="runs of each measurement (default: 3)")
    parser.add_argument("--save", type=Path, metavar="FILE", help="what was measured, for --measured; no model")
    parser.add_argument("--measured", type=Path, action="append", default=[], metavar="FILE",
                        help="also show what another machine saved")
    documents.add_option(parser)
    options = parser.parse_args()
    compare.WORK.mkdir(parents=True, exist_ok=True)
    made = documents.stamp("script/bench --cores")
    cores = os.cpu_count() or 1
    if cores < 4:
        print(f"cores: this machine has {cores}; what more would bring is a model's word")
    files = [compare.named_mesh(name) for name in options.meshes if not is_count(name)]
    measured = [Measured.load(file) for file in options.measured]
    runs = measure_threads(files, options.schedule or ["shell"], options.repeat)
    if runs:
        measured.append(Measured(made, runs))
        print("\n".join("  ".join(f"{cell:>12}" for cell in row) for row in measured_table(runs)))
    if options.save:
        Measured(made, runs).save(options.save)
        return
    printed = {}
    for name in options.meshes:
        mesh, text = measure(name)
        print(f"{mesh}\n{text}")
        printed[mesh] = text
    if options.write:
        documents.write(options.write, page(made, printed, measured))


if __name__ == "__main__":
    main()
