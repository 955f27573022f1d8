# SPDX-License-Identifier: MIT
"""What the viewer costs: opening, turning and cutting a large mesh, and steps through a long trace.

Meshes are lattices with moved points (bench/lattice.cpp). The trace is that of a run of the default schedule.
"""

import argparse
import json
import subprocess

import compare
import documents
import report

HEADING = ["what", "median", "mean", "most"]
TEXT = (
    "Seconds and milliseconds are those of the processor, of all threads. *picture* is a whole one of 1280 x 720 pixels, "
    "drawn in software and read back, after the camera has turned by ten pixels of the mouse. A step has all lists, "
    "figures and triangles made anew that it changes; drawing is not in it."
)


def measure(file: object) -> dict:
    done = subprocess.run([compare.BUILD / "bench" / "viewer_cost", "--json", file], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def lattice(size: float, folder: object) -> object:
    mesh = folder / f"{size:.0f}.meshb"
    subprocess.run([compare.BUILD / "bench" / "lattice", f"{size:.0f}", mesh], check=True)
    return mesh


def in_words(seconds: float) -> str:
    return f"{seconds:.2f} s" if seconds >= 0.1 else f"{1e3 * seconds:.2f} ms"


def table_of(told: dict) -> documents.Table:
    return [HEADING, *([each["what"], *(in_words(each[name]) for name in HEADING[1:])] for each in told["figures"])]


def title_of(told: dict) -> str:
    events = f" and {told['events']:,} events" if told["events"] else ""
    return f"{'A trace' if told['events'] else 'A mesh'} of {told['tets']:,} tets{events}: {told['peak_memory'] / 1e9:.2f} GB"


def page(made: documents.Stamp, runs: list[dict]) -> str:
    parts = [TEXT]
    for told in runs:
        parts += [f"## {title_of(told)}", documents.markdown_table(table_of(told))]
    return documents.document("What the viewer costs", made, parts)


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --viewer", description=__doc__)
    parser.add_argument("--mesh", type=float, nargs="+", default=[1e6, 1e7], metavar="N",
                        help="tets of the meshes (default: one and ten million)")
    parser.add_argument("--trace", type=float, default=1e6, metavar="N", help="tets of the trace (default: a million)")
    compare.add_folders(parser)
    documents.add_option(parser)
    options = parser.parse_args()
    compare.use_folders(options)
    folder = compare.WORK / "viewing"
    folder.mkdir(parents=True, exist_ok=True)
    runs = []
    for size in options.mesh:
        mesh = lattice(size, folder)
        runs.append(measure(mesh))
        mesh.unlink()
    start, improved, trace = lattice(options.trace, folder), folder / "out.meshb", folder / "run.trace"
    subprocess.run([compare.BUILD / "bin" / "tetmend", "improve", start, "-o", improved, "--quiet", "--trace", trace], check=True)
    runs.append(measure(trace))
    for file in (start, improved, trace):
        file.unlink()
    for told in runs:
        print(title_of(told))
        print(report.text_table(table_of(told)))
    if options.write:
        documents.write(options.write, page(documents.stamp("script/bench --viewer"), runs))


if __name__ == "__main__":
    main()
