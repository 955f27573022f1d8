# SPDX-License-Identifier: MIT
"""What is left of inverted tets in meshes that can be repaired.

Takes sound meshes, a lattice of 8^3 cells or a file that the default has improved, and moves their
inner vertices at random, so far that a share of the tets is inverted. Each seed gives another mesh.
Of the seeds it tells the median and the worst.
"""

import argparse
import json
import random
import resource
import statistics
import subprocess
import tempfile
from collections import Counter
from dataclasses import dataclass, replace
from itertools import combinations, permutations
from pathlib import Path

import compare
import documents
import medit
import report
from yardstick import six_volumes

SCHEDULES = ["shell", "thorough"]
SHARES = [10, 23, 26, 37, 39, 45]
TEXT = (
    "Sound meshes whose inner vertices are moved at random, in each direction by up to a multiple of "
    "the mean length of their edges, so far that a share of the tets is inverted. All can be "
    "repaired by moving the vertices back. *left*: inverted or flat tets of the result. *growth*: "
    "tets of the result, more than before. *seconds* of the processor on one thread, reading and "
    "writing included."
)


# --- meshes


def lattice(cells: int) -> medit.Mesh:
    side = range(cells + 1)
    points = [(float(x), float(y), float(z)) for z in side for y in side for x in side]
    tets = []
    for corner in [(x, y, z) for z in side[1:] for y in side[1:] for x in side[1:]]:
        for order in permutations(range(3)):
            at = [c - 1 for c in corner]
            tet = []
            for axis in (*order, 0):
                tet.append((at[2] * len(side) + at[1]) * len(side) + at[0])
                at[axis] += 1
            if six_volumes(*(points[v] for v in tet)) < 0:
                tet[2], tet[3] = tet[3], tet[2]
            tets.append(tuple(tet))
    return medit.Mesh(points, tets)


def on_surface(mesh: medit.Mesh) -> set[int]:
    """Also on faces between labels."""
    faces = Counter()
    for tet, label in zip(mesh.tets, mesh.labels, strict=True):
        faces.update((label, face) for face in combinations(sorted(tet), 3))
    return {v for (_, face), count in faces.items() if count == 1 for v in face}


def inverted(points: list[medit.Point], tets: list[medit.Tet]) -> int:
    return sum(six_volumes(*(points[v] for v in tet)) <= 0 for tet in tets)


def tangled(mesh: medit.Mesh, share: float, seed: int) -> medit.Mesh:
    """With the least moves that invert this share of the tets."""
    lengths: list[list[float]] = [[] for _ in mesh.points]
    for tet in mesh.tets:
        for v, w in combinations(tet, 2):
            length = sum((p - q) ** 2 for p, q in zip(mesh.points[v], mesh.points[w])) ** 0.5
            lengths[v].append(length)
            lengths[w].append(length)
    chance = random.Random(seed)
    fixed = on_surface(mesh)
    moves = [tuple(0.0 if v in fixed else statistics.fmean(around) * chance.uniform(-1, 1)
                   for _ in range(3)) for v, around in enumerate(lengths)]

    def moved(factor: float) -> list[medit.Point]:
        return [tuple(x + factor * m for x, m in zip(point, move))
                for point, move in zip(mesh.points, moves)]

    least, most = 0.0, 50.0
    while most - least > 1e-3:
        middle = (least + most) / 2
        if inverted(moved(middle), mesh.tets) < share / 100 * len(mesh.tets):
            least = middle
        else:
            most = middle
    return replace(mesh, points=moved(most))


def sound(name: str, folder: Path) -> medit.Mesh:
    if name == "lattice":
        return lattice(8)
    result = folder / "sound.mesh"
    subprocess.run([compare.BUILD / "bin" / "tetmend", "improve", compare.named_mesh(name), "-o",
                    result, "--quiet"], check=True)
    return medit.read(result)


# --- runs


@dataclass(frozen=True)
class Run:
    inverted: int
    tets: int
    left: int
    tets_after: int
    seconds: float


def processor_seconds() -> float:
    """Of all programs run so far. The clock tells little where others work beside."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(program: Path, mesh: Path, schedule: str, folder: Path) -> Run:
    told = folder / "report.json"
    start = processor_seconds()
    subprocess.run([program, "improve", mesh, "-o", folder / "result.meshb", "--quiet", "--threads",
                    "1", "--schedule", schedule, "--report", told], check=True)
    seconds = processor_seconds() - start
    figures = json.loads(told.read_text())
    before, after = figures["before"], figures["after"]
    return Run(before["inverted"] + before["flat"], before["tets"],
               after["inverted"] + after["flat"], after["tets"], seconds)


def row(mesh: str, schedule: str, program: str, runs: list[Run]) -> list[str]:
    def pair(values: list[float], shown: str) -> list[str]:
        return [format(statistics.median(values), shown), format(max(values), shown)]

    return [mesh, f"{100 * runs[0].inverted / runs[0].tets:.0f} %",
            f"{runs[0].inverted:,} of {runs[0].tets:,}", schedule, program,
            *pair([one.left for one in runs], ",.0f"),
            *pair([100 * (one.tets_after / one.tets - 1) for one in runs], ".1f"),
            *pair([one.seconds for one in runs], ".2f")]


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --tangled", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("meshes", nargs="*", metavar="MESH", help="lattice, file, or name of a default mesh "
        "(default: lattice)")
    add("--seeds", type=int, default=10, metavar="N", help="of each mesh (default: 10)")
    add("--share", type=float, action="append", default=[], metavar="PERCENT",
        help=f"may be repeated (default: {', '.join(map(str, SHARES))})")
    add("--schedule", action="append", default=[], metavar="NAME",
        help=f"may be repeated (default: {' and '.join(SCHEDULES)})")
    add("--against", type=Path, metavar="PROGRAM", help="another tetmend, measured beside this one")
    add("--keep", type=Path, metavar="FOLDER", help="leave the tangled meshes there")
    add("--build", type=Path, default=compare.BUILD, help="build folder")
    documents.add_option(parser)
    options = parser.parse_args()
    compare.BUILD = options.build.resolve()
    programs = {"now": compare.BUILD / "bin" / "tetmend"}
    if options.against:
        programs = {"before": options.against.resolve(), **programs}
    table = [["mesh", "share", "inverted, of seed 1", "schedule", "program", "left", "worst",
              "growth %", "worst", "seconds", "worst"]]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for mesh in options.meshes or ["lattice"]:
            good = sound(mesh, folder)
            for share in options.share or SHARES:
                runs: dict[tuple[str, str], list[Run]] = {}
                for seed in range(1, options.seeds + 1):
                    file = (options.keep or folder) / f"{Path(mesh).stem}_{share:g}_{seed}.mesh"
                    medit.write(file, tangled(good, share, seed))
                    for schedule in options.schedule or SCHEDULES:
                        for program, path in programs.items():
                            one = run(path, file, schedule, folder)
                            runs.setdefault((schedule, program), []).append(one)
                            compare.progress(f"{file.stem}: {schedule}, {program}: {one}")
                table += [row(Path(mesh).stem, schedule, program, found)
                          for (schedule, program), found in runs.items()]
    print(report.text_table(table))
    if options.write:
        made = documents.stamp("script/bench --tangled")
        parts = [TEXT, f"{options.seeds} seeds: the median, then the worst of them.",
                 documents.markdown_table(table)]
        documents.write(options.write, documents.document("Tangled meshes", made, parts))


if __name__ == "__main__":
    main()
