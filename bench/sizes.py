# SPDX-License-Identifier: MIT
"""Meshes whose edges are to be as long as a field says: `tetmend adapt` beside MMG and Gmsh, in the same run.

All are given one length at each vertex of the same mesh. How well edges keep to that is judged here, by the
field itself at their ends, and shares no code with what made them.
"""

import argparse
import math
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import compare
import competitors
import documents
import kinds
import medit
import report
from competitors import Competitor
from medit import Mesh, Point

LEAST, MOST = math.sqrt(0.5), math.sqrt(2)
GRADATION = 1.3
TEXT = (
    "*in range*: the share of edges from 0.71 to 1.41 of the wanted length, which changes linearly along them; "
    "*within 2*: from 0.5 to 2. *mean ratio* of tets: worst and mean. *least angle*: dihedral, in "
    "degrees. *distance*: the largest of samples of either surface from the other, in parts of the tolerance, 1 % of the "
    "mean edge length of the surface; 0: it stays. *seconds* of the processor on one thread, reading and writing included; "
    "*us a tet*: microseconds for each tet that there is more or less. Where the surface stays, its edges do, and what "
    "lies beside them has to follow."
)
HEADING = ["mesh, field", "program", "tets", "in range", "within 2", "mean ratio", "least angle", "distance", "seconds", "us a tet"]
Field = Callable[[Point], float]


@dataclass(frozen=True)
class Case:
    name: str
    mesh: Callable[[], Mesh]
    field_in: Callable[[Mesh], Field]


def cube(cells: int) -> Mesh:
    return kinds.lattice((cells, cells, cells), lambda x, y, z: (x / cells, y / cells, z / cells))


def shipped(name: str) -> Mesh:
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / "plain.mesh"
        subprocess.run([compare.BUILD / "bench" / "prepare", documents.ROOT / "assets" / "meshes" / name, plain], check=True)
        return medit.read(plain, leave_out_unknown=True)


def anywhere(field: Field) -> Callable[[Mesh], Field]:
    return lambda _: field


def around_a_corner(mesh: Mesh) -> Field:
    """From half of the mean edge at the first point to twice that at the other end."""
    edges = [math.dist(mesh.points[tet[0]], mesh.points[tet[1]]) for tet in mesh.tets]
    usual, place = sum(edges) / len(edges), mesh.points[0]
    reach = max(math.dist(place, p) for p in mesh.points)
    return lambda p: usual * (0.5 + 1.5 * math.dist(place, p) / reach)


CASES = [
    Case("cube, constant", lambda: cube(8), anywhere(lambda p: 0.06)),
    Case("cube, linear", lambda: cube(8), anywhere(lambda p: 0.02 + 0.1 * p[0])),
    Case("cube, radial", lambda: cube(8), anywhere(lambda p: 0.02 + 0.1 * math.hypot(*p))),
    Case("cube, shock", lambda: cube(8), anywhere(lambda p: min(0.12, 0.02 + 0.25 * abs(p[0] + 0.3 * p[1] - 0.6)))),
    Case("cube, coarser by 4", lambda: cube(16), anywhere(lambda p: 0.25)),
    Case("bracket, around a corner", lambda: shipped("bracket.meshb"), around_a_corner),
]


def write_sizes(file: Path, lengths: list[float]) -> None:
    rows = "\n".join(f"{length:.17g}" for length in lengths)
    file.write_text(f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(lengths)}\n1 1\n{rows}\nEnd\n")


def rows(tetmend: Path, tolerance: float) -> list[Competitor]:
    def own(name: str, *surface: str) -> Competitor:
        return Competitor(name=f"tetmend, {name}", short=name, found=str(tetmend), hint="", output="output.mesh",
                          command=(str(tetmend), "adapt", "input.mesh", "--size", "input.sol", "--gradation", f"{GRADATION}", "-q",
                                   "--threads", "1", *surface, "-o", "output.mesh"), phases=competitors.untold, ours=True)

    def mmg(name: str, *surface: str) -> Competitor:
        program = competitors.variable("TETMEND_BENCH_MMG3D")
        return Competitor(name=f"MMG, {name}", short=name, found=program, output="output.mesh",
                          hint="Needs TETMEND_BENCH_MMG3D=PROGRAM: mmg3d (www.mmgtools.org)",
                          command=(program or "mmg3d", "-sol", "input.sol", "-hgrad", f"{GRADATION}", *surface, "-in", "input.mesh",
                                   "-out", "output.mesh"), phases=competitors.untold)

    script = Path(__file__).parent / "rivals" / "gmsh_sizes.py"
    moving = f"{tolerance:.6g}"
    return [own("surface fixed"), mmg("surface fixed", "-nosurf"),
            Competitor(name="Gmsh, surface fixed", short="Gmsh", found=competitors.module("gmsh"),
                       hint="Needs the Debian package python3-gmsh", output="output.mesh",
                       command=(competitors.PYTHON, str(script)), phases=competitors.untold),
            own("tolerance", "--surface", moving), mmg("tolerance", "-hausd", moving)]


def relative_lengths(mesh: Mesh, field: Field) -> list[float]:
    wanted = [field(p) for p in mesh.points]
    edges = {(min(a, b), max(a, b)) for tet in mesh.tets for i, a in enumerate(tet) for b in tet[i + 1:]}
    found = []
    for a, b in edges:
        length, at_a, at_b = math.dist(mesh.points[a], mesh.points[b]), wanted[a], wanted[b]
        mean = (at_a + at_b) / 2 if abs(at_b / at_a - 1) < 1e-4 else (at_b - at_a) / math.log(at_b / at_a)
        found.append(length / mean)
    return found


def mean_ratio(mesh: Mesh, tet: medit.Tet) -> float:
    """12 (3 V)^(2/3) over the sum of the squares of the edges."""
    a, b, c, d = (mesh.points[v] for v in tet)
    u, v, w = ([q - p for p, q in zip(a, other, strict=True)] for other in (b, c, d))
    volume6 = (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]))
    squares = sum(math.dist(p, q) ** 2 for p, q in ((a, b), (a, c), (a, d), (b, c), (b, d), (c, d)))
    return math.copysign(12 * (abs(volume6) / 2) ** (2 / 3) / squares, volume6)


def judged(field: Field, given: Path, result: Path, seconds: float, tolerance: float, before: int) -> list[str]:
    mesh = medit.read(result, leave_out_unknown=True)
    lengths = relative_lengths(mesh, field)
    ratios = [mean_ratio(mesh, tet) for tet in mesh.tets]
    measured = compare.program_json("measure", str(given), str(result))["after"]
    moved = compare.program_json("surfaces", str(given), str(result), "5")
    distance = max(moved["after_to_before"], moved["before_to_after"]) / tolerance

    def share(least: float, most: float) -> str:
        return f"{100 * sum(least <= length <= most for length in lengths) / len(lengths):.1f} %"

    made = max(1, abs(len(mesh.tets) - before))
    return [f"{len(mesh.tets):,}", share(LEAST, MOST), share(0.5, 2), f"{min(ratios):.2f}, {sum(ratios) / len(ratios):.3f}",
            f"{measured['theta_min']:.1f}", "0" if distance < 1e-9 else f"{distance:.2g}", f"{seconds:.1f}", f"{1e6 * seconds / made:.0f}"]


def run(row: Competitor, field: Field, given: Path, tolerance: float, before: int, limit: float) -> list[str]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in (given, given.with_suffix(".sol")):
            (folder / file.name).symlink_to(file)
        outcome = compare.run(row.command, folder, limit)
        if outcome.status != "ok" or not (folder / row.output).exists():
            return [outcome.status if outcome.status != "ok" else "no result", *[""] * (len(HEADING) - 3)]
        return judged(field, given, folder / row.output, outcome.user, tolerance, before)


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --sizes", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="WORD", help="those with WORD in their name (default: all)")
    parser.add_argument("--limit", type=float, default=600, metavar="SECONDS", help="of the processor, for each run (default: 600)")
    parser.add_argument("--build", type=Path, default=compare.BUILD, help="build folder")
    documents.add_option(parser)
    options = parser.parse_args()
    compare.BUILD = options.build.resolve()
    table = [HEADING]
    for case in CASES:
        if options.cases and not any(word in case.name for word in options.cases):
            continue
        with tempfile.TemporaryDirectory() as name:
            given = Path(name) / "input.mesh"
            mesh = case.mesh()
            field = case.field_in(mesh)
            medit.write(given, mesh)
            write_sizes(given.with_suffix(".sol"), [field(p) for p in mesh.points])
            tolerance = 0.01 * compare.program_json("surfaces", str(given), str(given), "1")["mean_edge"]
            for row in rows(compare.BUILD / "bin" / "tetmend", tolerance):
                if row.found is None:
                    compare.progress(f"{row.name}: {row.hint}")
                    continue
                table.append([case.name, row.name, *run(row, field, given, tolerance, len(mesh.tets), options.limit)])
                compare.progress(" | ".join(table[-1]))
    print(report.text_table(table))
    if options.write:
        made = documents.stamp("script/bench --sizes")
        documents.write(options.write, documents.document("Sizes", made, [TEXT, documents.markdown_table(table)]))


if __name__ == "__main__":
    main()
