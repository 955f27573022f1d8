# SPDX-License-Identifier: MIT
"""Small meshes of all kinds, each made by chance from its kind and its number.

All tets are positive. Kinds of TETGEN_KINDS are Delaunay meshes that TetGen makes of our points.
"""

import itertools
import math
import random
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path

import yardstick
from medit import Mesh, Point, Tet

Chance = random.Random
Cell = tuple[int, int, int]

LEAST_VOLUME = 1e-9  # of a tet, as a part of the mean


# --- lattices


def lattice(cells: Cell, place: Callable[[int, int, int], Point]) -> Mesh:
    """Cubes of six tets around a diagonal each, one for each order of the axes."""
    sides = [n + 1 for n in cells]

    def number(x: int, y: int, z: int) -> int:
        return (z * sides[1] + y) * sides[0] + x

    points = [place(x, y, z) for z, y, x in itertools.product(*map(range, reversed(sides)))]
    tets: list[Tet] = []
    for cell in itertools.product(*map(range, cells)):
        for order in itertools.permutations(range(3)):
            at, corners = list(cell), [number(*cell)]
            for axis in order:
                at[axis] += 1
                corners.append(number(*at))
            tets.append(tuple(corners))
    return positive(Mesh(points, tets))


def positive(mesh: Mesh) -> Mesh:
    mesh.tets = [(a, b, c, d) if yardstick.orientation([mesh.points[v] for v in (a, b, c, d)]) > 0
                 else (a, b, d, c) for a, b, c, d in mesh.tets]
    return mesh


def volumes(mesh: Mesh, tets: Iterable[Tet]) -> list[float]:
    return [yardstick.six_volumes(*(mesh.points[v] for v in tet)) for tet in tets]


def shake(mesh: Mesh, reach: Callable[[int], Point], chance: Chance,
          least: float = LEAST_VOLUME) -> Mesh:
    """Moves each vertex by chance. Where that leaves too little of a tet, by less.

    @param reach  of a vertex: how far at most it may go along each axis
    @param least  volume of a tet afterwards, as a part of the mean"""
    around: dict[int, list[Tet]] = {}
    for tet in mesh.tets:
        for v in tet:
            around.setdefault(v, []).append(tet)
    floor = least * sum(volumes(mesh, mesh.tets)) / len(mesh.tets)
    for v, tets in around.items():
        old = mesh.points[v]
        move = [length * chance.uniform(-1, 1) for length in reach(v)]
        for part in (1, 0.7, 0.5, 0.25, 0):
            mesh.points[v] = tuple(x + part * step for x, step in zip(old, move, strict=True))
            if min(volumes(mesh, tets)) > floor:
                break
        else:
            mesh.points[v] = old
    return mesh


def sized(chance: Chance, least: int, most: int, flat: int | None = None) -> Cell:
    """Cells of a lattice with about so many tets.

    @param flat  the number of cells upwards, if that is given"""
    cells = chance.uniform(least, most) / 6
    if flat:
        n = math.sqrt(cells / flat)
        return (max(2, round(n * chance.uniform(0.6, 1.4))), max(2, round(n)), flat)
    n = cells ** (1 / 3)
    return tuple(max(2, round(n * chance.uniform(0.7, 1.3))) for _ in range(3))


def shaken_box(chance: Chance, cells: Cell, steps: Point, amplitude: float,
               least: float = LEAST_VOLUME) -> Mesh:
    """A box whose inner vertices have moved, those of its faces within these."""
    mesh = lattice(cells, lambda *at: tuple(i * step for i, step in zip(at, steps, strict=True)))
    ends = [n * step for n, step in zip(cells, steps, strict=True)]

    def reach(v: int) -> Point:
        return tuple(amplitude * step if 0 < x < end else 0.0
                     for x, step, end in zip(mesh.points[v], steps, ends, strict=True))

    return shake(mesh, reach, chance, least)


def stretched(chance: Chance) -> Mesh:
    steps = [1.0, chance.uniform(1, 20), chance.choice([1.0, chance.uniform(1, 20)])]
    chance.shuffle(steps)
    return shaken_box(chance, sized(chance, 200, 2500), tuple(steps), chance.uniform(0, 0.45))


def plate(chance: Chance) -> Mesh:
    flat = chance.choice([1, 1, 2, 3])
    height = chance.choice([0.02, 0.05, 0.1, 0.3, 1.0])
    return shaken_box(chance, sized(chance, 100, 2000, flat), (1.0, 1.0, height / flat),
                      chance.uniform(0.1, 0.6))


def layers(chance: Chance) -> Mesh:
    """Thin prisms on a wall that is flat or waves, cut into tets, below a box of moved vertices."""
    count, growth = chance.randint(2, 6), chance.uniform(1, 1.6)
    first, wave = chance.uniform(0.01, 0.2), chance.choice([0.0, 0.15])
    heights = [0.0]
    for i in range(count):
        heights.append(heights[-1] + first * growth ** i)
    core = chance.randint(2, 4)
    top = heights[-1] + core
    cells = sized(chance, 600, 2500, count + core)
    heights += [heights[-1] + i + 1 for i in range(core)]
    columns: dict[tuple[int, int], tuple[float, float]] = {}

    def place(x: int, y: int, z: int) -> Point:
        inner = 0 < x < cells[0] and 0 < y < cells[1]
        move = 0.25 if inner else 0.0
        here = columns.setdefault((x, y), (x + chance.uniform(-move, move),
                                           y + chance.uniform(-move, move)))
        share = 1 - heights[z] / top  # of the wave, which ends below the top
        return (*here, heights[z] + share * wave * math.sin(1.3 * here[0]) * math.cos(here[1]))

    mesh = lattice(cells, place)
    side = (cells[0] + 1) * (cells[1] + 1)

    def reach(v: int) -> Point:
        x, y, z = v % (cells[0] + 1), v // (cells[0] + 1) % (cells[1] + 1), v // side
        inner = 0 < x < cells[0] and 0 < y < cells[1] and count < z < count + core
        return (0.45, 0.45, 0.45) if inner else (0.0, 0.0, 0.0)

    return shake(mesh, reach, chance)


def tangled(chance: Chance) -> Mesh:
    """As far from a lattice as positive tets allow."""
    least = chance.choice([1e-2, 1e-3, 1e-5, 1e-7])
    mesh = shaken_box(chance, sized(chance, 200, 2000), (1.0, 1.0, 1.0), 0.9, least)
    ends = [max(point[axis] for point in mesh.points) for axis in range(3)]
    for _ in range(2):
        shake(mesh, lambda v: tuple(0.5 * (0 < x < end) for x, end in
                                    zip(mesh.points[v], ends, strict=True)), chance, least)
    return mesh


def sheet(chance: Chance) -> Mesh:
    """A lattice with triangles that the file names inside the region, and a named edge."""
    cells = sized(chance, 300, 2000)
    mesh = shaken_box(chance, cells, (1.0, 1.0, chance.choice([0.3, 1.0])),
                      chance.uniform(0.2, 0.45))
    layer = (cells[0] + 1) * (cells[1] + 1)
    middle = max(1, cells[2] // 2)
    inside = [face for face in yardstick.sides(mesh) if {v // layer for v in face} == {middle}]
    kept = inside[:max(1, round(chance.uniform(0.3, 1) * len(inside)))]
    mesh.sections = {"Triangles": [(*face, 7) for face in kept],
                     "Edges": [(*min(mesh.tets)[:2], 9)]}
    return mesh


def units(chance: Chance) -> Mesh:
    """Very large or very small, and some far from the origin, where doubles are coarse."""
    mesh = shaken_box(chance, sized(chance, 200, 1500), (1.0, 1.0, chance.uniform(0.3, 1)),
                      chance.uniform(0.2, 0.45), 1e-3)
    scale = 10 ** chance.uniform(-9, 9)
    shift = chance.choice([0, 1e2, 1e5, 1e8])
    mesh.points = [tuple(scale * (x + shift) for x in point) for point in mesh.points]
    return mesh


# --- labels


def middle(mesh: Mesh, tet: Tet) -> Point:
    return tuple(sum(mesh.points[v][axis] for v in tet) / 4 for axis in range(3))


def materials(chance: Chance) -> Mesh:
    """Regions that a plane, a ball or octants divide, with rough borders."""
    mesh = shaken_box(chance, sized(chance, 300, 2500), (1.0, 1.0, chance.uniform(0.4, 1.5)),
                      chance.uniform(0.1, 0.45))
    centre = [max(point[axis] for point in mesh.points) * chance.uniform(0.3, 0.7)
              for axis in range(3)]
    slope = [chance.uniform(-1, 1) for _ in range(3)]
    radius = 0.6 * max(centre)
    shape = chance.choice(["plane", "ball", "octants"])
    for i, tet in enumerate(mesh.tets):
        away = [x - c for x, c in zip(middle(mesh, tet), centre, strict=True)]
        if shape == "plane":
            mesh.labels[i] = 1 + (sum(x * s for x, s in zip(away, slope, strict=True)) > 0)
        elif shape == "ball":
            mesh.labels[i] = 1 + (math.hypot(*away) < radius)
        else:
            mesh.labels[i] = 1 + sum((x > 0) << axis for axis, x in enumerate(away))
    return mesh


# --- by TetGen


def tetgen(options: str, input_name: str, text: str) -> Mesh:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / input_name).write_text(text)
        subprocess.run(["tetgen", f"-{options}Q", input_name], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        points = rows(Path(folder) / "in.1.node")
        tets = rows(Path(folder) / "in.1.ele")
    return positive(Mesh([tuple(map(float, row[1:4])) for row in points],
                         [tuple(map(int, row[1:5])) for row in tets]))


def rows(file: Path) -> list[list[str]]:
    lines = [line.split() for line in file.read_text().splitlines() if line[:1] != "#"]
    return lines[1:1 + int(lines[0][0])]


def nodes(points: list[Point]) -> str:
    lines = [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(points)]
    return "\n".join([f"{len(points)} 3 0 0", *lines, ""])


def without(mesh: Mesh, unwanted: Callable[[Tet], bool]) -> Mesh:
    """Without some tets, and without the vertices that no tet has then."""
    tets = [tet for tet in mesh.tets if not unwanted(tet)]
    used = sorted({v for tet in tets for v in tet})
    new = {v: i for i, v in enumerate(used)}
    return Mesh([mesh.points[v] for v in used], [tuple(new[v] for v in tet) for tet in tets])


def peeled(mesh: Mesh) -> Mesh:
    """Without the flat tets that lie outermost in the hull of points."""
    while True:
        floor = LEAST_VOLUME * sum(volumes(mesh, mesh.tets)) / len(mesh.tets)
        flat = [tet for tet, volume in zip(mesh.tets, volumes(mesh, mesh.tets), strict=True)
                if volume <= floor]
        if not flat:
            return mesh
        outer = {mesh.tets[both[0][0]] for both in yardstick.sides(mesh).values() if len(both) == 1}
        removed = outer.intersection(flat)
        if not removed:
            raise ValueError("a flat tet inside")
        mesh = without(mesh, removed.__contains__)


def in_ball(chance: Chance) -> Point:
    while True:
        point = tuple(chance.uniform(-1, 1) for _ in range(3))
        if math.hypot(*point) <= 1:
            return point


def delaunay(chance: Chance) -> Mesh:
    """Of points by chance in a ball, a box or between two balls."""
    shape = chance.choice(["ball", "box", "shell"])
    count = chance.randint(40, 450)
    if shape == "box":
        scale = [chance.uniform(0.3, 2) for _ in range(3)]
        points = [tuple(s * chance.random() for s in scale) for _ in range(count)]
        return peeled(tetgen("", "in.node", nodes(points)))
    points = [in_ball(chance) for _ in range(count)]
    if shape == "ball":
        return peeled(tetgen("", "in.node", nodes(points)))
    hollow = chance.uniform(0.3, 0.6)
    points = [point for point in points if math.hypot(*point) > hollow]
    mesh = tetgen("", "in.node", nodes(points))
    return peeled(without(mesh, lambda tet: math.hypot(*middle(mesh, tet)) < hollow))


def slivers(chance: Chance) -> Mesh:
    """The corners of cubes lie on a sphere: moved a little, they make tets of nearly no volume."""
    noise = 10 ** chance.uniform(-3, -1)
    n = chance.randint(3, 7)
    points = [tuple(x + chance.uniform(-noise, noise) for x in at)
              for at in itertools.product(range(n), repeat=3)]
    return peeled(tetgen("", "in.node", nodes(points)))


def needles(chance: Chance) -> Mesh:
    """Some points have a twin close by."""
    points = [in_ball(chance) for _ in range(chance.randint(40, 300))]
    near = 10 ** chance.uniform(-3, -1.3)
    twins = chance.sample(points, round(chance.uniform(0.05, 0.4) * len(points)))
    points += [tuple(x + near * chance.uniform(-1, 1) for x in point) for point in twins]
    return peeled(tetgen("", "in.node", nodes(points)))


def sphere(fineness: int) -> tuple[list[Point], list[tuple[int, int, int]]]:
    """An octahedron divided so many times, each time into four times as many triangles."""
    points: list[Point] = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5),
                 (0, 3, 5)]
    for _ in range(fineness):
        between: dict[tuple[int, int], int] = {}

        def half(a: int, b: int) -> int:
            key = (min(a, b), max(a, b))
            if key not in between:
                sums = [p + q for p, q in zip(points[a], points[b], strict=True)]
                points.append(tuple(x / math.hypot(*sums) for x in sums))
                between[key] = len(points) - 1
            return between[key]

        split = [(a, b, c, half(a, b), half(b, c), half(c, a)) for a, b, c in triangles]
        triangles = [part for a, b, c, ab, bc, ca in split
                     for part in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))]
    return points, triangles


def organ(chance: Chance) -> Mesh:
    """Inside a lumpy surface whose every point is seen from the centre."""
    points, triangles = sphere(chance.choice([1, 2, 2, 3]))
    waves = [([chance.uniform(-3, 3) for _ in range(3)], chance.uniform(0, 0.15))
             for _ in range(4)]
    noise = chance.choice([0.0, 0.05, 0.15])

    def radius(point: Point) -> float:
        lumps = sum(height * math.sin(sum(x * w for x, w in zip(point, wave, strict=True)))
                    for wave, height in waves)
        return 1 + lumps + chance.uniform(-noise, noise)

    scaled = []
    for point in points:
        length = radius(point)
        scaled.append(tuple(length * x for x in point))
    facets = [f"1\n3 {a} {b} {c}" for a, b, c in triangles]
    text = "\n".join([nodes(scaled).rstrip(), f"{len(facets)} 0", *facets, "0", "0", ""])
    options = chance.choice(["pY", "pYq2.0", f"pYa{chance.choice([0.002, 0.01, 0.05])}"])
    return peeled(tetgen(options, "in.poly", text))


# --- all of them


TETGEN_KINDS = {"delaunay": delaunay, "slivers": slivers, "needles": needles, "organ": organ}
KINDS: dict[str, Callable[[Chance], Mesh]] = {
    "stretched": stretched, "plate": plate, "layers": layers, "tangled": tangled, "units": units,
    "sheet": sheet, "materials": materials, **TETGEN_KINDS}


def available() -> list[str]:
    """Without those that need TetGen, if it is missing."""
    return [kind for kind in KINDS if kind not in TETGEN_KINDS or shutil.which("tetgen")]


def make(kind: str, seed: int) -> Mesh:
    mesh = KINDS[kind](Chance(f"{kind} {seed}"))
    if any(yardstick.orientation([mesh.points[v] for v in tet]) <= 0 for tet in mesh.tets):
        raise ValueError(f"{kind} {seed} has a tet that is not positive")
    return mesh
