# SPDX-License-Identifier: MIT
"""Reading, building and writing of a mesh in each format, from the system's cache of files."""

import argparse
import json
import subprocess
from pathlib import Path

import compare
import documents
import report

FORMATS = {  # extension: name
    ".meshb": "MEDIT, binary",
    ".mesh": "MEDIT, ASCII",
    ".vtk": "legacy VTK, binary",
    ".node": "TetGen, `.node` and `.ele`",
}
PHASES = ["reading", "building", "writing"]
TEXT = (
    "The least time of several runs, by the clock, and the size of what is read each second. A run "
    "reads the mesh, builds adjacency and writes the same format again."
)
NO_PASSES = 'description "Leaves the mesh as it is"\n'


def bytes_of(mesh: Path) -> int:
    files = [mesh, mesh.with_suffix(".ele")] if mesh.suffix == ".node" else [mesh]
    return sum(file.stat().st_size for file in files)


def measure(mesh: Path, threads: int, runs: int) -> dict[str, float]:
    """The least seconds of each phase."""
    folder = mesh.parent
    script, told = folder / "nothing.lua", folder / "report.json"
    script.write_text(NO_PASSES)
    command = [compare.BUILD / "bin" / "tetmend", "improve", mesh,
               "-o", folder / f"out{mesh.suffix}", "--schedule", script, "--threads", str(threads),
               "--quiet", "--report", told]
    seconds = []
    for _ in range(runs):
        subprocess.run(command, check=True)
        seconds.append(json.loads(told.read_text())["seconds"])
    return {phase: min(one[phase] for one in seconds) for phase in PHASES}


def row(name: str, size: int, threads: int, seconds: dict[str, float]) -> list[str]:
    times = [report.seconds(seconds[phase]) for phase in PHASES]
    speed = size / seconds["reading"] / 1e6
    return [name, f"{size / 1e6:.1f}", str(threads), *times, f"{speed:,.0f}"]


def page(made: documents.Stamp, mesh: str, table: documents.Table) -> str:
    title = f"Reading and writing {mesh}"
    return documents.document(title, made, [TEXT, documents.markdown_table(table)])


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --files", description=__doc__)
    parser.add_argument("mesh", nargs="?", metavar="MESH",
                        help="file, or name of a default mesh (default: bracket)")
    parser.add_argument("--runs", type=int, default=5, metavar="N", help="of each (default: 5)")
    documents.add_option(parser)
    options = parser.parse_args()
    source = compare.named_mesh(options.mesh) if options.mesh else compare.own_mesh()
    folder = compare.fresh_folder(compare.WORK / "files")
    table = [["format", "MB", "threads", *(f"{phase} s" for phase in PHASES), "reading MB/s"]]
    for extension, name in FORMATS.items():
        mesh = folder / f"mesh{extension}"
        subprocess.run([compare.BUILD / "bin" / "tetmend", "convert", source, mesh], check=True,
                       stdout=subprocess.DEVNULL)
        for threads in (1, 2):
            seconds = measure(mesh, threads, options.runs)
            table.append(row(name, bytes_of(mesh), threads, seconds))
        compare.progress(f"{source.stem}{extension}")
    compare.fresh_folder(folder)
    print(report.text_table(table))
    if options.write:
        made = documents.stamp("script/bench --files")
        documents.write(options.write, page(made, source.stem, table))


if __name__ == "__main__":
    main()
