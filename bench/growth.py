# SPDX-License-Identifier: MIT
"""Time and memory for each tet from small to very large meshes.

Meshes are lattices with moved points (bench/lattice.cpp), so that only the size changes.
"""

import argparse
import json
import subprocess

import compare
import documents
import report

HEADING = ["tets", "bad before", "after", "theta_min", "reading s", "building s", "improving s",
           "writing s", "improving us a tet", "ratio", "peak bytes a tet"]
TEXT = (
    "The default schedule on lattices of moved points, so that only the size changes. Times are by "
    "the clock. *ratio* is that of the improving time for each tet to that on the mesh of a "
    "million."
)
BASE = 1e6  # tets of the mesh that the others are compared with


def measure(size: float, threads: int) -> dict:
    folder = compare.WORK / "growth"
    folder.mkdir(parents=True, exist_ok=True)
    mesh, improved, told = (folder / name for name in ("lattice.meshb", "out.meshb", "report.json"))
    subprocess.run([compare.BUILD / "bench" / "lattice", f"{size:.0f}", mesh], check=True)
    subprocess.run([compare.BUILD / "bin" / "tetmend", "improve", mesh, "-o", improved, "--quiet",
                    "--threads", str(threads), "--report", told], check=True)
    mesh.unlink()
    improved.unlink()
    return json.loads(told.read_text())


def micros_a_tet(told: dict) -> float:
    return 1e6 * told["seconds"]["improving"] / told["before"]["tets"]


def row(told: dict, base: float | None) -> list[str]:
    """@param base  microseconds for each tet of the mesh that others are compared with"""
    before, after, seconds = told["before"], told["after"], told["seconds"]
    times = [f"{seconds[name]:.2f}" for name in ("reading", "building", "improving", "writing")]
    a_tet = micros_a_tet(told)
    return [f"{before['tets']:,}", f"{before['n_bad']:,}", f"{after['n_bad']:,}",
            f"{after['theta_min']:.2f}", *times, f"{a_tet:.2f}",
            f"{a_tet / base:.2f}" if base else "",
            f"{told['peak_memory_bytes'] / before['tets']:.0f}"]


def table_of(runs: dict[float, dict]) -> documents.Table:
    """@param runs  what each run reported, by the size that was asked for"""
    base = micros_a_tet(runs[BASE]) if BASE in runs else None
    return [HEADING, *(row(told, base if size > BASE else None) for size, told in runs.items())]


def page(made: documents.Stamp, table: documents.Table) -> str:
    parts = [TEXT, documents.markdown_table(table)]
    return documents.document("Growth with the size of the mesh", made, parts)


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --growth", description=__doc__)
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="(default: 1)")
    parser.add_argument("--sizes", default="1e4,1e5,1e6,1e7,3.7e7", metavar="N,N,...",
                        help="numbers of tets (default: 10 thousand to 37 million)")
    compare.add_folders(parser)
    documents.add_option(parser)
    options = parser.parse_args()
    compare.use_folders(options)
    runs = {}
    for size in map(float, options.sizes.split(",")):
        runs[size] = measure(size, options.threads)
        compare.progress(f"{size:,.0f} tets: {runs[size]['seconds']['improving']:.2f} s")
    table = table_of(runs)
    print(report.text_table(table))
    if options.write:
        documents.write(options.write, page(documents.stamp("script/bench --growth"), table))


if __name__ == "__main__":
    main()
