# SPDX-License-Identifier: MIT
"""Mesh kernels of tets: that of tetmend beside those of others, on the same meshes and edits.

Each kernel is a program that does the same tasks; counts that differ from tetmend's are marked. A
3-2 flip and a contraction begin with finding the edge between two vertices. tetmend certifies signs,
computes qualities and can undo; the others do not.
"""

import argparse
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

import compare
import documents
import report

PROGRAMS = {
    "tetmend": "kernel_tetmend",
    "tetmend, sorted": "kernel_tetmend_sorted",
    "CGAL": "kernel_cgal",
    "OpenVolumeMesh": "kernel_openvolumemesh",
    "cinolib": "kernel_cinolib",
}
TASKS = {
    "bytes": "bytes a tet",
    "build": "build of arrays, a tet",
    "volume": "loop over tets, volume",
    "neighbours": "four neighbours of a tet",
    "star": "star of a vertex",
    "one_ring": "one-ring of a vertex",
    "edges": "list of all edges, an edge",
    "ring": "tets around an edge",
    "flip": "3-2 flip, kept",
    "flip_undone": "3-2 flip, undone",
    "flip_property": "3-2 flip with a property of doubles",
    "contract": "contraction of an edge, kept",
    "contract_undone": "contraction, undone",
}
MOST_WITH_PROPERTY = 1.1  # times a flip without one
ROUNDS = 3
LIMIT = 300  # seconds
HEADERS = ["vector", "Eigen/Core", "tetmend/kernel.h", "tetmend/operators.h", "tetmend/schedule.h"]
HEADER_ROUNDS = 5
FOREIGN = ["tbb", "lua", "fmt"]
EPILOG = """\
CGAL is that of Debian (Triangulation_data_structure_3). Sources that Debian does not have:
  TETMEND_BENCH_OPENVOLUMEMESH  a checkout of OpenVolumeMesh
  TETMEND_BENCH_CINOLIB         a checkout of cinolib
They are compiled when the build is configured with these variables set.
TETMEND_BENCH_MESHES names a folder of meshes that are default meshes too.
"""

Figures = dict[str, tuple[float, int]]  # by task: the least of the rounds, and the count


def told_by(program: Path, mesh: Path, edits: Path) -> Figures:
    """Nothing after LIMIT seconds."""
    try:
        told = subprocess.run([program, mesh, edits], check=True, stdout=subprocess.PIPE, text=True, timeout=LIMIT).stdout
    except subprocess.TimeoutExpired:
        return {}
    figures = {}
    for line in told.splitlines():
        words = line.split()
        if len(words) == 3 and words[0] in TASKS:  # cinolib has more to say
            figures[words[0]] = (float(words[1]), int(words[2]))
    return figures


def least(rounds: list[Figures]) -> Figures:
    return {task: min(figures[task] for figures in rounds) for task in rounds[0]} if all(rounds) else {}


def measured(mesh: Path, build: Path, rounds: int) -> dict[str, Figures]:
    programs = {name: build / "bench" / program for name, program in PROGRAMS.items()
                if (build / "bench" / program).exists()}
    with tempfile.TemporaryDirectory() as folder:
        edits = Path(folder) / "edits"
        edits.write_bytes(subprocess.run([build / "bench" / "kernel_edits", mesh], check=True,
                                         stdout=subprocess.PIPE).stdout)
        turns: dict[str, list[Figures]] = {name: [] for name in programs}
        for _ in range(rounds):
            for name, program in programs.items():
                if {} not in turns[name]:
                    turns[name].append(told_by(program, mesh, edits))
    return {name: least(figures) for name, figures in turns.items()}


def cell(task: str, figures: Figures, first: Figures) -> str:
    if task not in figures:
        return "-"
    figure, count = figures[task]
    text = f"{figure:.3g}" if figure < 1000 else f"{figure:,.0f}"
    if figures is not first:
        text += f" ({figure / first[task][0]:.2g})"
    return text if count == first[task][1] else f"{text}, {count:,} of {first[task][1]:,}"


def table_of(kernels: dict[str, Figures]) -> documents.Table:
    first = kernels["tetmend"]
    return [["", *kernels], *([words, *(cell(task, figures, first) for figures in kernels.values())]
                              for task, words in TASKS.items())]


def header_table(build: Path) -> documents.Table:
    """What a program pays for a header, beside two that it may have anyway: time of g++, and whose headers come along."""
    seconds: dict[str, list[float]] = {header: [] for header in HEADERS}
    depends = {}
    with tempfile.TemporaryDirectory() as folder:
        commands = {}
        for number, header in enumerate(HEADERS):
            source = Path(folder) / f"{number}.cpp"
            source.write_text(f"#include <{header}>\n")
            commands[header] = ["g++", "-std=c++20", "-fsyntax-only", f"-I{build / 'include'}",
                                f"-I{documents.ROOT / 'include'}", "-I/usr/include/eigen3", source]
            depends[header] = subprocess.run([*commands[header], "-M"], check=True, stdout=subprocess.PIPE, text=True).stdout
        for _ in range(HEADER_ROUNDS):  # in turns: a busy machine slows all alike
            for header, command in commands.items():
                before = os.times().children_user
                subprocess.run(command, check=True)
                seconds[header].append(os.times().children_user - before)
    eigen = statistics.median(seconds["Eigen/Core"])
    rows = [[f"`<{header}>`", f"{statistics.median(times):.2f}", f"{statistics.median(times) / eigen:.2f}",
             str(len(depends[header].split())),
             ", ".join(name for name in FOREIGN if f"/{name}" in depends[header]) or "none"]
            for header, times in seconds.items()]
    return [["header", "seconds of g++", "times Eigen/Core", "files", "oneTBB, Lua, fmt"], *rows]


def bars(kernels: dict[str, Figures]) -> list[str]:
    """What is slower than promised."""
    figures = kernels["tetmend, sorted"]
    share = figures["flip_property"][0] / figures["flip"][0]
    if share <= MOST_WITH_PROPERTY:
        return []
    return [f"a flip with a property takes {share:.2f} times as long as one without, "
            f"{MOST_WITH_PROPERTY} at most"]


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --kernel", description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", metavar="MESH", nargs="*", type=Path)
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--build", type=Path, default=compare.BUILD, help="folder of the build")
    documents.add_option(parser)
    options = parser.parse_args()
    folder = Path(compare.MESHES)
    meshes = options.meshes or [folder / "f6s_280k.mesh.xz", folder / "f6_1m.mesh.xz"]
    sections = [__doc__.strip(), "Nanoseconds of the processor, the least of "
                f"{options.rounds} rounds; in brackets as a multiple of `tetmend`. A program without figures took "
                f"longer than {LIMIT} seconds."]
    missed = []
    for mesh in meshes:
        kernels = measured(compare.plain(mesh), options.build, options.rounds)
        sections += [f"## {mesh.name.split('.')[0]}", documents.markdown_table(table_of(kernels))]
        print(mesh.name, report.text_table(table_of(kernels)), sep="\n")
        missed += [f"{mesh.name}: {bar}" for bar in bars(kernels)]
    headers = header_table(options.build)
    print(report.text_table(headers))
    sections += ["## Headers", documents.markdown_table(headers)]
    if options.write:
        made = documents.stamp("script/bench --kernel")
        documents.write(options.write, documents.document("Mesh kernels", made, sections))
    if missed:
        raise SystemExit("\n".join(missed))


if __name__ == "__main__":
    main()
