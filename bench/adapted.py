# SPDX-License-Identifier: MIT
"""Holds runs of tetmend adapt to what docs/sizes.md promises, on meshes and sizes made by chance.

Each run has a number, and is the same each time. What was read and what was written is judged by lengths.py,
yardstick.py and borders.py, which share nothing with tetmend. Exit status: 0 all promises are kept, 1 some are not.
Meshes of those stay in the folder of the results, before and after. Needs numpy.
"""

import argparse
import dataclasses
import json
import math
import os
import random
import resource
import signal
import statistics
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import borders
import compare
import documents
import kinds
import lengths
import medit
import msh
import promises
import report
import sizes
import yardstick
from lengths import Field, Share
from medit import Mesh, Point
from msh import Model
from promises import Breach

RUNS = 200
FLOOR = 0.35  # the quality that splits and contractions leave at least
SHIPPED = ["two_materials.mesh", "folded_sheet.mesh", "sheet.mesh"]
MOST_TETS = 1000  # that a size asks for
MANY_EVERY, MANY_TETS = 50, 60000  # runs: so many that threads have several blocks each
SECONDS = 40  # of the processor for a run, at most
LINEAR = (3.0, 2.0, -5.0, 0.25)  # an array of the points: a constant, then what it grows by along each axis
TOO_LONG = f"over {SECONDS} s of the processor"  # no promise: counted as missed
GROUP = 77  # label of the triangles of a group
SURFACES = ["fixed", "flat", "1%", "length"]
TEXT = (
    "Small meshes of all kinds and sizes of all forms, made by chance. *coarser, finer*: twice the lengths that are "
    "there, then half of them. *broken* counts promises: the surface is the same, or within its tolerance, with its lines; "
    "the volume of each label stays where the shape does; named triangles, edges and required points are there; groups, "
    "arrays, totals of arrays, periodic points, layers and protected tets come over; no tet is inverted; no tet is worse "
    f"than the worst there was, or than a quality of {FLOOR}; the share of edges in range is smaller only if fewer are out of "
    "range; the report has these figures; two threads write the bytes of one. *too long*: runs of more than "
    f"{SECONDS} s of the processor, which were not judged. *in range* and *tets* are medians, before and after. The "
    "judge shares nothing with tetmend."
)


# --- what is made by chance


@dataclass
class Given:
    """An input, what is asked for, and what the judge has to know of it."""

    name: str
    kind: str
    model: Model
    suffix: str
    options: list[str] = field(default_factory=list)
    surface: str = "fixed"
    eps: float = 0.0  # how far the surface may go, where that is told as a length
    form: str = "constant"
    wanted: Field | float = 1.0
    grounds: dict[str, Model] = field(default_factory=dict)  # other meshes that options name
    lengths: list[float] = field(default_factory=list)  # for a file of lengths
    goal: float = 30.0  # degrees
    conserved: bool = False
    protected: list[int] = field(default_factory=list)  # labels


def periodic_box(chance: random.Random) -> Model:
    """Both sides along x are alike, and linked."""
    cells = kinds.sized(chance, 200, 1500)
    mesh = kinds.shaken_box(chance, cells, (1.0, 1.0, 1.0), 0.3)
    end = max(point[0] for point in mesh.points)
    left = {p[1:]: i for i, p in enumerate(mesh.points) if p[0] == 0}
    for i, p in enumerate(mesh.points):  # lattice: a point of the right side has the row of one of the left
        if p[0] == end:
            mesh.points[i] = (end, *mesh.points[i - cells[0]][1:])
    mesh = kinds.positive(mesh)
    left = {p[1:]: i for i, p in enumerate(mesh.points) if p[0] == 0}
    twins = [(i, left[p[1:]]) for i, p in enumerate(mesh.points) if p[0] == end]
    outer = [faces[0][1] for faces in yardstick.sides(mesh).values() if len(faces) == 1]
    mesh.sections["Triangles"] = [(*face, label) for face in outer
                                  for label, x in ((1, end), (2, 0.0)) if all(mesh.points[v][0] == x for v in face)]
    return Model(mesh, twins=twins)


def some_mesh(chance: random.Random, number: int) -> tuple[str, Model]:
    names = [*kinds.available(), "shipped", "periodic"]
    kind = names[number % len(names)]
    if kind == "shipped":
        name = SHIPPED[number // len(names) % len(SHIPPED)]
        return name.partition(".")[0], Model(medit.read(documents.ROOT / "assets" / "meshes" / name, leave_out_unknown=True))
    if kind == "periodic":
        return kind, periodic_box(chance)
    return kind, Model(kinds.make(kind, number))


def volume_of(mesh: Mesh) -> float:
    return math.fsum(kinds.volumes(mesh, mesh.tets)) / 6


def waves(chance: random.Random, mesh: Mesh, usual: float) -> list[float]:
    """Lengths about a usual one that grow along a line, away from a point, or away from a plane."""
    low, high = (np.array(mesh.points).min(axis=0), np.array(mesh.points).max(axis=0))
    place = low + np.array([chance.random() for _ in range(3)]) * (high - low)
    way = np.array([chance.uniform(-1, 1) for _ in range(3)])
    way /= np.linalg.norm(way)
    away = np.array(mesh.points) - place
    reach = float(np.linalg.norm(high - low))
    form = chance.choice(["line", "point", "plane"])
    share = {"line": away @ way / reach, "point": np.linalg.norm(away, axis=1) / reach,
             "plane": np.abs(away @ way) / reach}[form]
    least, most = 0.5, chance.choice([1.5, 3.0])
    return [usual * min(most, max(least, least + 2 * s)) for s in share.tolist()]


def finest(lengths_wanted: np.ndarray, mesh: Mesh) -> float:
    """What to multiply lengths with, so that they do not ask for more than MOST_TETS."""
    at = np.asarray(lengths_wanted)[np.array(mesh.tets)]
    volumes = np.abs(np.array(kinds.volumes(mesh, mesh.tets))) / 6
    tets = float(np.sum(volumes * np.mean(at ** -3.0, axis=1)) * 12 / math.sqrt(2))
    return max(1.0, (tets / MOST_TETS) ** (1 / 3))


def add_many(given: Given) -> None:
    mesh = given.model.mesh
    given.wanted = (6 * math.sqrt(2) * volume_of(mesh) / MANY_TETS) ** (1 / 3)
    given.options += ["--size", repr(given.wanted), "--goal", "10"]
    given.goal = 10.0


def add_sizes(given: Given, chance: random.Random) -> None:
    """A form of size, bounds and gradation, and what they mean at each place."""
    mesh = given.model.mesh
    count = math.exp(chance.uniform(math.log(40), math.log(MOST_TETS)))
    usual = (6 * math.sqrt(2) * volume_of(mesh) / count) ** (1 / 3)
    gradation = chance.choice([1.3, 1.3, 0, 1.1, 2])
    smallest, largest = (chance.choice([0, 0, 0, 0.8 * usual]), chance.choice([0, 0, 0, 1.5 * usual]))
    forms = ["constant", "factor", "array", "file", "background", "regions"]
    given.form = forms[chance.randrange(len(forms))]
    if given.form == "array" and given.suffix == ".mesh":
        given.form = "file"
    there = lengths.present(mesh)
    used = sorted({v for tet in mesh.tets for v in tet})
    there[sorted(set(range(len(there))) - set(used))] = 1.0

    def bounded(values: np.ndarray) -> np.ndarray:
        return np.minimum(np.maximum(values, smallest), largest or np.inf)

    if given.form == "constant":
        given.options += ["--size", repr(usual)]
        at = np.full(len(mesh.points), usual)
    elif given.form == "factor":
        share = max(chance.uniform(0.5, 3), finest(there, mesh))
        given.options += ["--size", f"{share!r}x"]
        at = share * there
    elif given.form in ("array", "file"):
        given.lengths = waves(chance, mesh, usual)
        given.lengths = [finest(np.array(given.lengths), mesh) * length for length in given.lengths]
        at = np.array(given.lengths)
        if given.form == "array":
            given.model.point_data["wanted"] = given.lengths
            given.options += ["--size", "array:wanted"]
        else:
            given.options += ["--size", f"{given.name}.sol"]
    elif given.form == "background":
        low, high = (np.array(mesh.points).min(axis=0), np.array(mesh.points).max(axis=0))
        cells = (chance.randint(2, 6), chance.randint(2, 6), chance.randint(2, 6))
        ground = kinds.lattice(cells, lambda *i: tuple(float(a + (b - a) * (1.2 * k / n - 0.1))
                                                       for a, b, k, n in zip(low, high, i, cells, strict=True)))
        values = waves(chance, ground, usual)
        given.grounds[f"{given.name}-ground.msh"] = Model(ground, {"h": values})
        given.options += ["--size", f"{given.name}-ground.msh:h"]
        at = np.array(values)
    else:
        label, share = chance.choice(sorted(set(mesh.labels))), max(1.0, finest(there, mesh))
        given.options += ["--size", f"{share!r}x", "--size", f"label:{label}={usual!r}"]
        at = share * there
        at[sorted({v for tet, own in zip(mesh.tets, mesh.labels, strict=True) if own == label for v in tet})] = usual
    for name, value, default in (("gradation", gradation, 1.3), ("smallest", smallest, 0), ("largest", largest, 0)):
        given.options += [f"--{name}", repr(value)] if value != default else []
    if given.form == "constant":
        given.wanted = float(bounded(at)[0])
    else:
        of = next(iter(given.grounds.values())).mesh if given.form == "background" else mesh
        given.wanted = Field(of, lengths.graded(of, bounded(at), gradation))


def add_surface(given: Given, chance: random.Random) -> None:
    given.surface = chance.choice(SURFACES)
    if given.surface == "fixed":
        return
    faces = borders.border(given.model.mesh)
    edge = borders.mean_edges(given.model.mesh, faces)
    given.eps = 0.0 if given.surface == "flat" else float(0.01 * edge.max())
    told = {"flat": "flat", "1%": "1%", "length": repr(float(0.01 * edge.mean()))}[given.surface]
    if given.surface == "length":
        given.eps = float(told)
    given.options += ["--surface", told]


def add_data(given: Given, chance: random.Random) -> None:
    """Arrays, groups, required points, protected labels."""
    mesh = given.model.mesh
    if given.suffix == ".mesh":
        some = chance.sample(range(len(mesh.points)), min(5, len(mesh.points)))
        mesh.sections.setdefault("RequiredVertices", [(v,) for v in sorted(some)])
    else:
        given.model.point_data["line"] = [LINEAR[0] + sum(s * x for s, x in zip(LINEAR[1:], p, strict=True)) for p in mesh.points]
        given.model.tet_data["mass"] = [1 + chance.random() for _ in mesh.tets]
        given.model.names = {(3, label): f"part {label}" for label in sorted(set(mesh.labels))}
        if "Triangles" not in mesh.sections:
            outer = [faces[0][1] for faces in yardstick.sides(mesh).values() if len(faces) == 1]
            middle = statistics.median(sum(mesh.points[v][0] for v in face) for face in outer)
            mesh.sections["Triangles"] = [(*face, GROUP) for face in outer
                                          if sum(mesh.points[v][0] for v in face) <= middle]
            given.model.names[2, GROUP] = "wall"
        given.conserved = chance.random() < 0.5
        given.options += ["--conserve", "mass"] if given.conserved else []
    labels = sorted(set(mesh.labels))
    if len(labels) > 1 and chance.random() < 0.3:
        given.protected = [labels[0]]
        given.options += ["--protect", f"label:{labels[0]}"]


def make(number: int) -> Given:
    chance = random.Random(f"adapt {number}")
    kind, model = some_mesh(chance, number)
    suffix = ".mesh" if kind != "periodic" and (chance.random() < 0.3 or model.mesh.sections) else ".msh"
    given = Given(f"run-{number}", kind, model, suffix)
    add_data(given, chance)
    if number % MANY_EVERY == 0:
        add_many(given)
        return given
    add_surface(given, chance)
    add_sizes(given, chance)
    add_goal(given, chance)
    return given


def add_goal(given: Given, chance: random.Random) -> None:
    """One that few tets miss where the surface moves, for most of the time goes into those."""
    given.goal = chance.choice([30.0, 10.0]) if given.surface == "fixed" else 10.0
    given.options += ["--goal", f"{given.goal:g}"] if given.goal != 30 else []


def back_and_forth(number: int) -> list[Given]:
    """Twice the lengths, about an eighth of the tets; and of the result half of them. The second has no mesh yet."""
    chance = random.Random(f"adapt {number}")
    kind, model = some_mesh(chance, number)
    suffix = ".mesh" if model.mesh.sections and not model.twins else ".msh"
    steps = [Given(f"run-{number}-{word}", kind, model, suffix, ["--size", size], form=word)
             for word, size in (("coarser", "2x"), ("finer", "0.5x"))]
    add_data(steps[0], chance)
    add_surface(steps[0], chance)
    add_goal(steps[0], chance)
    steps[1].options += [word for word in steps[0].options if word not in ("--size", "2x")]
    steps[1] = dataclasses.replace(steps[1], surface=steps[0].surface, goal=steps[0].goal, conserved=steps[0].conserved,
                                   protected=steps[0].protected)
    return steps


# --- the judge


def quality(figures: yardstick.Figures, goal: float) -> float:
    """The smallest sine of an angle, over that of the goal."""
    least, most = (math.sin(math.radians(angle)) for angle in (figures.theta_min, figures.theta_max))
    return min(least, most) / math.sin(math.radians(goal))


def tets_of(mesh: Mesh, labels: set[int] | None = None) -> set[tuple]:
    """By the places of their corners."""
    return {(label, *sorted(mesh.points[v] for v in tet)) for tet, label in zip(mesh.tets, mesh.labels, strict=True)
            if labels is None or label in labels}


def count(what: str, missing: int) -> list[Breach]:
    return [Breach(what, 0, missing)] if missing else []


def section_places(mesh: Mesh, name: str, corners: int) -> set[tuple]:
    return {(*row[corners:], *sorted(mesh.points[v] for v in row[:corners])) for row in mesh.sections.get(name, [])}


def surface_breaches(given: Given, before: Mesh, after: Mesh) -> list[Breach]:
    if given.surface == "fixed":
        found = promises.surface_broken(yardstick.surface(before), yardstick.surface(after))
        return found + count("lost named edges", len(section_places(before, "Edges", 2) - section_places(after, "Edges", 2)))
    found = [Breach(what, allowed, is_) for what, allowed, is_ in borders.moved(before, after, given.eps) if is_ > allowed]
    return found + [Breach(f"volume of label {label}", was, now) for label, was, now, allowed
                    in borders.volume_changes(before, after, given.eps) if abs(now - was) > allowed]


def data_breaches(given: Given, before: Model, after: Model, told: dict) -> list[Breach]:
    found = count("lost required points", len(section_places(before.mesh, "RequiredVertices", 1)
                                              - section_places(after.mesh, "RequiredVertices", 1)))
    found += count("lost labels", len(set(before.mesh.labels) ^ set(after.mesh.labels)))
    found += count("lost groups", len(set(before.names.items()) ^ set(after.names.items())))
    found += count("lost arrays", len(set(before.point_data) ^ set(after.point_data)) + len(set(before.tet_data) ^ set(after.tet_data)))
    found += count("lost triangles of labels", len({row[3] for row in before.mesh.sections.get("Triangles", [])}
                                                   ^ {row[3] for row in after.mesh.sections.get("Triangles", [])}))
    if "line" in before.point_data:
        found += line_breaches(given, before.mesh, after)
    if given.conserved and given.eps == 0:
        was, now = (math.fsum(v * m for v, m in zip(kinds.volumes(model.mesh, model.mesh.tets), model.tet_data["mass"], strict=True))
                    for model in (before, after))
        found += [Breach("another total of an array", was, now)] if abs(now - was) > 1e-9 * abs(was) else []
    if given.protected:
        kept = tets_of(before.mesh, set(given.protected))
        found += count("changed protected tets", len(kept - tets_of(after.mesh)))
    layers = told["layers"]["tets"]
    same = len(tets_of(before.mesh) & tets_of(after.mesh)) if layers else 0
    found += count("changed tets of layers", max(0, layers - same))
    return found + twin_breaches(before, after)


def line_breaches(given: Given, before: Mesh, after: Model) -> list[Breach]:
    points = np.array(after.mesh.points)
    truth = LINEAR[0] + points @ np.array(LINEAR[1:])
    error = float(np.max(np.abs(np.array(after.point_data["line"]) - truth)))
    size = float(np.max(np.abs(np.array(before.points)))) + 1
    allowed = 1e-9 * 8 * size + (100 * given.eps if given.eps else 0)
    return [Breach("error of a linear array", allowed, error)] if error > allowed else []


def twin_breaches(before: Model, after: Model) -> list[Breach]:
    """Points of the two sides are as they were, and still linked."""
    def pairs(model: Model) -> set[tuple[Point, Point]]:
        return {(model.mesh.points[a], model.mesh.points[b]) for a, b in model.twins}
    return count("changed periodic points", len(pairs(before) ^ pairs(after)))


def report_breaches(told: dict, then: yardstick.Figures, now: yardstick.Figures, shares: tuple[Share, Share]) -> list[Breach]:
    found = []
    for when, figures, share in (("before", then, shares[0]), ("after", now, shares[1])):
        own, of_sizes = told[when], told["sizes"][when]
        found += [Breach(f"the report's {what}, {when}", mine, theirs) for what, mine, theirs in (
            ("theta_min", figures.theta_min, own["theta_min"]), ("theta_max", figures.theta_max, own["theta_max"]))
            if abs(mine - theirs) > 1e-6 * max(1, mine)]
        found += [Breach(f"the report's {what}, {when}", mine, theirs) for what, mine, theirs in (
            ("tets", figures.tets, own["tets"]), ("edges", share.edges, of_sizes["edges"])) if mine != theirs]
        if not share.holds(of_sizes["in_range"]):
            found.append(Breach(f"the report's share in range, {when}", share.certain, of_sizes["in_range"]))
    return found


@dataclass
class Outcome(promises.Outcome):
    """With what a run of adapt reached."""

    surface: str = ""
    tets: tuple[int, int] = (0, 0)
    shares: tuple[float, float] = (0, 0)


def judged(given: Given, after: Model, told: dict) -> tuple[list[Breach], tuple[Share, Share]]:
    before = given.model
    then, now = (yardstick.measure(model.mesh, (given.goal, 180 - given.goal)) for model in (before, after))
    shares = tuple(lengths.share_in_range(model.mesh, given.wanted) for model in (before, after))
    found = surface_breaches(given, before.mesh, after.mesh) + data_breaches(given, before, after, told)
    found += report_breaches(told, then, now, shares)
    found += count("tets that are not positive", now.not_positive)
    least = min(FLOOR, quality(then, given.goal))
    if quality(now, given.goal) < least * (1 - 1e-6):  # as single precision ranks tets
        found.append(Breach("a worse tet than the worst, or than the floor", least, quality(now, given.goal)))
    if shares[1].possible < shares[0].certain and shares[1].off() > shares[0].off():
        found.append(Breach("a smaller share in range, and more edges out of range", shares[0].certain, shares[1].possible))
    return found, shares


# --- runs


def write(file: Path, model: Model) -> None:
    medit.write(file, model.mesh) if file.suffix == ".mesh" else msh.write(file, model)


def read(file: Path) -> Model:
    return Model(medit.read(file)) if file.suffix == ".mesh" else msh.read(file)


def adapt(tetmend: Path, words: list[str], folder: Path) -> str:
    """@return nothing, or what went wrong"""
    ran = subprocess.run([tetmend, *words[1:], "--quiet"], cwd=folder, capture_output=True, text=True, check=False,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5)))
    if ran.returncode == -signal.SIGXCPU:
        return TOO_LONG
    return "" if ran.returncode in (0, 3) else f"exit status {ran.returncode}: {ran.stderr.strip()}"


def run(given: Given, tetmend: Path, folder: Path) -> tuple[Outcome, Model | None]:
    source, results = f"{given.name}{given.suffix}", [f"{given.name}-{n}{given.suffix}" for n in (1, 2)]
    write(folder / source, given.model)
    if given.form == "file":
        sizes.write_sizes(folder / f"{given.name}.sol", given.lengths)
    for name, ground in given.grounds.items():
        msh.write(folder / name, ground)
    words = ["tetmend", "adapt", source, "-o", results[0], *given.options]
    outcome = Outcome(given.kind, given.name, given.form, " ".join(words), [], [], surface=given.surface)
    told, after = folder / f"{given.name}.json", None
    for result, threads in zip(results, ("1", "2"), strict=True):
        wrong = adapt(tetmend, ["tetmend", "adapt", source, "-o", result, *given.options, "--threads", threads,
                                "--report", told.name], folder)
        if wrong:
            (outcome.missed if wrong == TOO_LONG else outcome.broken).append(Breach(wrong, 0, 1))
            break
    if not wrong:
        after = read(folder / results[0])
        outcome.broken, shares = judged(given, after, json.loads(told.read_text()))
        outcome.tets = (len(given.model.mesh.tets), len(after.mesh.tets))
        outcome.shares = tuple(share.certain for share in shares)
        if (folder / results[0]).read_bytes() != (folder / results[1]).read_bytes():
            outcome.broken.append(Breach("other bytes with two threads", 1, 2))
    if not outcome.broken:
        for name in (source, *results, f"{given.name}.sol", told.name, *given.grounds):
            (folder / name).unlink(missing_ok=True)
    return outcome, after


def perform(task: tuple[int, bool, Path, Path]) -> list[Outcome]:
    """@param task  number, whether it goes back and forth, tetmend, folder of the results"""
    number, goes_back, tetmend, folder = task
    if not goes_back:
        return [run(make(number), tetmend, folder)[0]]
    outcomes = []
    first, second = back_and_forth(number)
    for given, share in ((first, 2.0), (second, 0.5)):
        if given is second:
            given.model = after
            faces = borders.border(after.mesh)
            told = given.options[given.options.index("--surface") + 1] if given.surface == "length" else ""
            given.eps = {"1%": 0.01 * float(borders.mean_edges(after.mesh, faces).max()),
                         "length": float(told or 0)}.get(given.surface, 0.0)
        given.wanted = Field(given.model.mesh, lengths.graded(given.model.mesh, share * lengths.present(given.model.mesh), 1.3))
        outcome, after = run(given, tetmend, folder)
        outcomes.append(outcome)
        if after is None:
            break
    return outcomes


# --- tables


def row(name: str, outcomes: list[Outcome]) -> list[str]:
    done = [outcome for outcome in outcomes if outcome.tets[0]]

    def median(values: list[float], text: str) -> str:
        return format(statistics.median(values), text) if values else ""

    return [name, str(len(outcomes)), str(sum(len(outcome.broken) for outcome in outcomes)),
            str(sum(len(outcome.missed) for outcome in outcomes)),
            *(median([100 * outcome.shares[i] for outcome in done], ".1f") + " %" for i in (0, 1)),
            *(median([outcome.tets[i] for outcome in done], ",.0f") for i in (0, 1))]


def table_of(outcomes: list[Outcome]) -> documents.Table:
    table = [["", "runs", "broken", "too long", "in range before", "after", "tets before", "after"]]
    for what in (lambda one: f"surface: {one.surface}", lambda one: f"size: {one.run}", lambda one: f"mesh: {one.kind}"):
        for name in dict.fromkeys(sorted(map(what, outcomes))):
            table.append(row(name, [one for one in outcomes if what(one) == name]))
    return [*table, row("all", outcomes)]


def page(made: documents.Stamp, outcomes: list[Outcome]) -> str:
    listed = "\n".join(f"- {line}" for line in promises.breaches(outcomes))
    parts = [TEXT, promises.summary(outcomes), documents.markdown_table(table_of(outcomes))]
    return documents.document("Promises of adapt", made, [*parts, *([listed] if listed else [])])


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="script/bench --adapted", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("numbers", nargs="*", type=int, metavar="NUMBER", help=f"of runs (default: 0 to {RUNS - 1})")
    add("--runs", type=int, default=RUNS, metavar="N", help="how many, from 0")
    add("--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at the same time (default: as many as cores)")
    add("-o", "--output", type=Path, metavar="DIR", default=compare.WORK / "adapted",
        help="folder of the results (default: build/bench/adapted)")
    add("--build", type=Path, default=compare.BUILD, help="build folder")
    documents.add_option(parser)
    return parser.parse_args()


BACK_EVERY = 8  # runs: coarser by 8 and back


def main() -> int:
    options = parse()
    folder = compare.fresh_folder(options.output.resolve())
    tetmend = options.build.resolve() / "bin" / "tetmend"
    tasks = [(number, number % BACK_EVERY == BACK_EVERY - 1, tetmend, folder) for number in options.numbers or range(options.runs)]
    outcomes: list[Outcome] = []
    with ProcessPoolExecutor(options.jobs) as pool:
        for some in pool.map(perform, tasks):
            outcomes += some
            if lines := promises.breaches(some):
                compare.progress("\n  ".join(lines))
    print(report.text_table(table_of(outcomes)))
    print("", *promises.breaches(outcomes), promises.summary(outcomes), sep="\n")
    if options.write:
        documents.write(options.write, page(documents.stamp("script/bench --adapted"), outcomes))
    return 1 if any(outcome.broken for outcome in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
