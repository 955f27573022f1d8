# SPDX-License-Identifier: MIT
"""Hexahedra, prisms and pyramids beside tets stay, and so does each face and edge that tets have in common with them:
of one mesh in memory and of one in pieces, with a surface that stays or moves. SU2 files have all of these.

usage: mixed_test.py TETMEND
"""

import itertools
import random
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

PROGRAM = sys.argv[1]
TET, HEXAHEDRON, PRISM, PYRAMID = 10, 12, 13, 14  # of VTK and SU2
CORNERS = {5: 3, 9: 4, TET: 4, HEXAHEDRON: 8, PRISM: 6, PYRAMID: 5}
TRIANGLES = {TET: [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)], PRISM: [(0, 1, 2), (3, 4, 5)], HEXAHEDRON: [],
             PYRAMID: [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]}
EDGES = {TET: list(itertools.combinations(range(4), 2)),
         HEXAHEDRON: [(i, (i + 1) % 4) for i in range(4)] + [(4 + i, 4 + (i + 1) % 4) for i in range(4)]
         + [(i, i + 4) for i in range(4)],
         PRISM: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
         PYRAMID: [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)]}
failures = []


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details)


def run(*words):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=280)


def cells(n, seed):
    """Points and elements of n * n columns of cells: below a hexahedron or two prisms, above it a cell whose centre is
    the tip of a pyramid on the hexahedron and of tets on its other faces, and on top cells of such tets alone."""
    rng = random.Random(seed)
    points, elements = [], []

    def corner(i, j, k):
        return (k * (n + 1) + j) * (n + 1) + i

    for k, j, i in itertools.product(range(n + 1), range(n + 1), range(n + 1)):
        inside = 0 < i < n and 0 < j < n and 1 < k < n
        points.append([x + inside * rng.uniform(-0.22, 0.22) for x in (i, j, k)])
    for k, j, i in itertools.product(range(n), range(n), range(n)):
        q = [corner(i + (s & 1), j + (s >> 1 & 1), k + (s >> 2)) for s in range(8)]
        is_hexahedron = (i + j) % 2 == 0
        if k == 0 and is_hexahedron:
            elements.append((HEXAHEDRON, (q[0], q[1], q[3], q[2], q[4], q[5], q[7], q[6])))
        elif k == 0:
            elements += [(PRISM, (q[0], q[3], q[1], q[4], q[7], q[5])), (PRISM, (q[0], q[2], q[3], q[4], q[6], q[7]))]
        else:
            centre = len(points)
            points.append([sum(points[v][axis] for v in q) / 8 + (k > 1) * rng.uniform(-0.08, 0.08) for axis in range(3)])
            if k == 1 and is_hexahedron:
                elements.append((PYRAMID, (q[0], q[1], q[3], q[2], centre)))
            # The diagonal of each face goes from its lowest corner to its highest, as those of the prisms do.
            faces = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
            for a, b, c, d in faces[1:] if k == 1 and is_hexahedron else faces:
                elements += [(TET, (q[a], q[b], q[c], centre)), (TET, (q[a], q[c], q[d], centre))]
    return points, elements


def put_up(points, tet):
    """The same tet with a positive volume."""
    a, b, c, d = (points[v] for v in tet)
    u, v, w = ([x - y for x, y in zip(p, a)] for p in (b, c, d))
    volume = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]))
    return tet if volume > 0 else (tet[0], tet[2], tet[1], tet[3])


def write_su2(file, points, elements):
    lines = ["NDIME= 3", f"NELEM= {len(elements)}"]
    lines += [f"{kind} {' '.join(map(str, put_up(points, v) if kind == TET else v))}" for kind, v in elements]
    lines += [f"NPOIN= {len(points)}"] + [" ".join(map(repr, p)) for p in points] + ["NMARK= 0"]
    file.write_text("\n".join(lines) + "\n")


def read_su2(file):
    """Elements with the places of their corners."""
    lines = [line.split("%")[0].strip() for line in file.read_text().splitlines()]
    lines = iter([line for line in lines if line])
    points, rows = [], []
    for line in lines:
        name, _, count = line.partition("=")
        if name == "NELEM":
            rows += [list(map(int, next(lines).split())) for _ in range(int(count))]
        elif name == "NPOIN":
            points += [tuple(map(float, next(lines).split()[:3])) for _ in range(int(count.split()[0]))]
        elif name == "MARKER_ELEMS":
            for _ in range(int(count)):
                next(lines)
    return [(row[0], tuple(points[v] for v in row[1:1 + CORNERS[row[0]]])) for row in rows]


def parts(elements, table, kinds):
    """Faces or edges of these kinds of elements, each with how many have it."""
    return Counter(tuple(sorted(v[k] for k in part)) for kind, v in elements if kind in kinds for part in table[kind])


OTHERS = (HEXAHEDRON, PRISM, PYRAMID)


def compare(what, before, after, surface_stays):
    others = [Counter(element for element in mesh if element[0] in OTHERS) for mesh in (before, after)]
    check(others[0] == others[1], what, "other elements have changed")
    for name, table in (("faces", TRIANGLES), ("edges", EDGES)):
        shared = parts(before, table, OTHERS).keys() & parts(before, table, (TET,)).keys()
        lost = shared - parts(after, table, (TET,)).keys()
        check(shared and not lost, what, f"{len(lost)} of {len(shared)} {name} in common are gone")
    counts = [parts(mesh, TRIANGLES, (TET, PRISM, PYRAMID)) for mesh in (before, after)]
    check(max(counts[1].values()) == 2, what, "a face has more than two elements")
    if surface_stays:
        surface = [{face for face, count in each.items() if count == 1} for each in counts]
        check(surface[0] == surface[1], what, "the surface has changed")
    check([e for e in before if e[0] == TET] != [e for e in after if e[0] == TET], what, "no tet has changed")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = folder / "in.su2"
        write_su2(source, *cells(5, 1))
        before = read_su2(source)
        done = run(PROGRAM, "convert", source, folder / "again.su2")
        check(done.returncode == 0, "convert to SU2", done.stderr)
        check(Counter(read_su2(folder / "again.su2")) == Counter(before), "SU2 comes back with other elements")
        for ending in ("su2", "msh", "vtu", "inp"):
            converted = folder / f"in.{ending}"
            if ending != "su2":
                done = run(PROGRAM, "convert", source, converted)
                check(done.returncode == 0, "convert to", ending, done.stderr)
            for options in ([], ["--pieces", "3"], ["--surface", "flat"], ["--surface", "flat", "--pieces", "3"]):
                what = " ".join([ending, *options])
                out, told = folder / f"out.{ending}", folder / "out.su2"
                done = run(PROGRAM, "improve", converted, "-o", out, "-q", "--goal", "40,130", *options)
                check(done.returncode in (0, 3), what, done.returncode, done.stderr)
                if ending != "su2":
                    run(PROGRAM, "convert", out, told)
                compare(what, before, read_su2(told), surface_stays="--surface" not in options)
                out.unlink(missing_ok=True)
                told.unlink(missing_ok=True)
    if failures:
        sys.exit(f"{len(failures)} failures")


main()
