# SPDX-License-Identifier: MIT
"""CalculiX refuses a deck with inverted tets; improved by tetmend, the same deck runs.

    ccx_test.py TETMEND

A bar of tets with a material, supports by set and by node number, a load by node, a pressure on a
surface of the elements and a step. Exit status 77: CalculiX (ccx) is not there.
"""

import itertools
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
LENGTH, WIDTH = 12, 4
MOVED = 10
TETMEND = sys.argv[1]


def bar() -> tuple[dict, dict]:
    """Points and tets by number: six tets in each cube."""
    number = {}
    points = {}
    for place in itertools.product(range(LENGTH + 1), range(WIDTH + 1), range(WIDTH + 1)):
        number[place] = 3 * len(points) + 5  # with gaps
        points[number[place]] = tuple(float(x) for x in place)
    tets = {}
    for corner in itertools.product(range(LENGTH), range(WIDTH), range(WIDTH)):
        for order in itertools.permutations(range(3)):
            place = list(corner)
            path = [number[tuple(place)]]
            for axis in order:
                place[axis] += 1
                path.append(number[tuple(place)])
            odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
            if odd:
                path[1], path[2] = path[2], path[1]
            tets[2 * len(tets) + 11] = path
    return points, tets


def six_volumes(points: dict, tet: list) -> float:
    a, b, c, d = (points[v] for v in tet)
    u, v, w = ([x - y for x, y in zip(p, a)] for p in (b, c, d))
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0]))


def move_points(points: dict) -> None:
    """Points deep inside, which no line of the deck names, into the tets of their neighbours."""
    inner = [n for n, p in points.items()
             if 2 <= p[0] <= LENGTH - 2 and all(0 < x < WIDTH for x in p[1:])]
    for node in random.Random(7).sample(inner, MOVED // 4):
        x, y, z = points[node]
        points[node] = (x + 1.3, y + 0.2, z + 0.1)


def second_order(points: dict, tets: dict) -> tuple[dict, dict]:
    """The same bar with a node in the middle of each edge."""
    points, middles, curved = dict(points), {}, {}
    first = max(points) + 10
    for tet, v in tets.items():
        nodes = list(v)
        for i, j in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)):
            ends = tuple(sorted((v[i], v[j])))
            if ends not in middles:
                middles[ends] = first + len(middles)
                points[middles[ends]] = tuple((a + b) / 2 for a, b in zip(points[v[i]], points[v[j]]))
            nodes.append(middles[ends])
        curved[tet] = nodes
    return points, curved


def deck(points: dict, tets: dict) -> str:
    fixed = [n for n, p in points.items() if p[0] == 0]
    tip = [n for n, p in points.items() if p[0] == LENGTH]
    single = next(n for n, p in points.items() if p == (LENGTH / 2, 0.0, 0.0))
    faces = []
    for tet, v in tets.items():
        for k, face in enumerate(((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)), 1):
            if all(points[v[i]][1] == WIDTH for i in face):
                faces.append((tet, k))
    half = [t for t, v in tets.items() if all(points[n][0] <= LENGTH / 2 for n in v[:4])]
    rest = [t for t in tets if t not in set(half)]
    lines = ["** A bar", "*Heading", "a bar of two materials", "*Node, nset=Nall"]
    lines += [f"{n}, {p[0]}, {p[1]}, {p[2]}" for n, p in points.items()]
    for name, some in (("Left", half), ("Right", rest)):
        kind = "C3D4" if len(next(iter(tets.values()))) == 4 else "C3D10"
        lines += [f"*Element, type={kind}, elset={name}"]
        lines += [f"{t}, {', '.join(map(str, tets[t]))}" for t in some]
    lines += ["*Elset, elset=All", "Left, Right", "*Nset, nset=Fixed"]
    lines += [f"{n}," for n in fixed] + ["** the top", "*Surface, name=Top, type=element"]
    lines += [f"{t}, S{k}" for t, k in faces]
    for k, name in enumerate(("Left", "Right"), 1):
        lines += [f"*Material, name=M{k}", "*Elastic", f"{k}000., 0.3",
                  f"*Solid section, elset={name}, material=M{k}"]
    lines += ["*Step", "*Static", "*Boundary", "Fixed, 1, 3", f"{tip[0]}, 2, 2", "*Cload",
              f"{single}, 3, 0.5", "*Dload"]
    lines += [f"{t}, P{k}, 0.25" for t, k in faces[:6]]
    lines += ["*Node print, nset=Fixed, totals=only", "RF", "*El print, elset=All, totals=only",
              "EVOL", "*End step"]
    return "\n".join(lines) + "\n"


def run_ccx(file: Path) -> tuple[int, str]:
    result = subprocess.run(["ccx", file.stem], cwd=file.parent, capture_output=True, text=True,
                            env=dict(os.environ, OMP_NUM_THREADS="1"), timeout=120)
    return result.returncode, result.stdout + result.stderr


def run_tetmend(*arguments) -> int:
    return subprocess.run([TETMEND, *arguments], stdout=subprocess.DEVNULL).returncode


def figures(file: Path) -> tuple[list[float], float]:
    """Sum of the forces on the support and the volume, as ccx prints them."""
    text = file.with_suffix(".dat").read_text()
    numbers = [[float(x) for x in re.findall(r"[-+]?\d\.\d+E[-+]\d+", line)]
               for line in text.splitlines()]
    [force] = [row for row in numbers if len(row) == 3]
    return force, numbers[-1][0]


def verbatim(text: str) -> list[str]:
    """What must be the same word for word: keywords and comments, and lines from the material on."""
    head, tail = text.split("*Material", 1)
    tail = tail.split("*Dload")[0] + tail[tail.index("*Node print"):]
    return [line for line in head.splitlines() if line.startswith("**")] + tail.splitlines()


def main() -> int:
    if shutil.which("ccx") is None:
        print("skipped: install the package calculix-ccx")
        return SKIPPED
    wrong = []
    for order in (1, 2):
        print(f"tets of order {order}")
        follow(order, wrong)
    return 1 if wrong else 0


def follow(order: int, wrong: list) -> None:
    """One bar on its way from sound to broken to improved."""
    def expect(what: str, is_so: bool) -> None:
        print(f"{'ok  ' if is_so else 'FAIL'}  {what}")
        if not is_so:
            wrong.append(what)

    def deck_of(points: dict, tets: dict) -> str:
        return deck(points, tets) if order == 1 else deck(*second_order(points, tets))

    points, tets = bar()
    with tempfile.TemporaryDirectory() as folder:
        sound, broken, fixed = (Path(folder) / f"{name}.inp" for name in ("sound", "broken", "fixed"))
        sound.write_text(deck_of(points, tets))
        status, _ = run_ccx(sound)
        expect("ccx solves the sound bar", status == 0)
        again = Path(folder) / "again.inp"
        expect("convert succeeds", run_tetmend("convert", sound, again) == 0)
        status, _ = run_ccx(again)
        expect("ccx solves the converted bar", status == 0)
        expect("with the same forces and volume", figures(sound) == figures(again))
        text = deck_of(points, tets)
        move_points(points)
        inverted = sum(six_volumes(points, v) <= 0 for v in tets.values())
        expect(f"{inverted} tets are inverted: about {MOVED}", MOVED // 2 <= inverted <= 4 * MOVED)
        broken.write_text(deck_of(points, tets))
        expect("the decks differ in nodes only", len(text) - len(broken.read_text()) < 1000)
        status, output = run_ccx(broken)
        expect("ccx refuses inverted tets: status 201", status == 201)
        expect("and says why", "nonpositive jacobian" in output)
        expect("check finds them: status 3", run_tetmend("check", broken, "--for", "calculix") == 3)
        expect("improve succeeds", run_tetmend("improve", broken, "-o", fixed, "--quiet", "--set", "polish_first=0",
                           "--set", "polish_last=0") == 0)  # the forces depend on the mesh a little
        expect("check finds none: status 0", run_tetmend("check", fixed, "--for", "calculix") == 0)
        expect("surface, labels, groups are kept",
               run_tetmend("check", broken, fixed) == 0)
        status, output = run_ccx(fixed)
        expect("ccx solves the improved bar: status 0", status == 0)
        if status != 0:
            print(output[-2000:])
            return
        expect("lines beside the mesh are word for word the same",
               verbatim(fixed.read_text()) == verbatim(broken.read_text()))
        force, volume = figures(fixed)
        force_before, volume_before = figures(sound)
        expect("the volume is that of the sound bar", abs(volume - volume_before) < 1e-4 * volume)
        expect("the forces on the support are those of the sound bar",
               all(abs(a - b) < 1e-3 for a, b in zip(force, force_before)))


if __name__ == "__main__":
    sys.exit(main())
