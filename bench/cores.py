# SPDX-License-Identifier: MIT
"""What more cores would make of a run: the tables of bench/scaling.

A number in place of a mesh stands for a lattice of so many tets. One thread measures the time of
each block of the mesh; from these follows what 1 to 256 threads would take.
"""

import argparse
import re
import subprocess

import compare
import documents

TEXT = (
    "**A model, not a measurement.** Only the time of each block is measured, on one "
    "thread. From these follows what more threads would take: scans of the whole mesh split evenly, "
    "blocks go to the next free thread, the largest first, everything else waits. What many cores "
    "lose to memory and caches that they share is not in these figures, and it is much: on a machine "
    "of 16 cores the default improved f6_1m 3.6 times as fast as on one of them. *alone %*: share of "
    "the time that one thread works alone. *deferred %*: targets that were tried again, for each "
    "that was tried."
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


def page(made: documents.Stamp, printed: dict[str, str]) -> str:
    """@param printed  output of bench/scaling by the name of the mesh"""
    sections = [part for mesh, text in printed.items() for part in section(mesh, text)]
    return documents.document("Many cores: a model", made, [TEXT, *sections])


def measure(name: str) -> tuple[str, str]:
    """Name of the mesh and what bench/scaling prints for it."""
    scaling = str(compare.BUILD / "bench" / "scaling")
    if not re.fullmatch(r"[\d.]+(e\d+)?", name):
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
    parser = argparse.ArgumentParser(prog="script/bench --cores", description=__doc__)
    parser.add_argument("meshes", nargs="*", metavar="MESH", default=["1e7"],
                        help="file, name of a default mesh, or a number of tets (default: 1e7)")
    documents.add_option(parser)
    options = parser.parse_args()
    compare.WORK.mkdir(parents=True, exist_ok=True)
    printed = {}
    for name in options.meshes:
        mesh, text = measure(name)
        print(f"{mesh}\n{text}")
        printed[mesh] = text
    if options.write:
        documents.write(options.write, page(documents.stamp("script/bench --cores"), printed))


if __name__ == "__main__":
    main()
