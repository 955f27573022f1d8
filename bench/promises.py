# SPDX-License-Identifier: MIT
"""Holds runs of tetmend to what README promises: no figure ends worse than it was.

Without meshes it makes small ones of all kinds, the same each time. bench/yardstick.py measures
what was read and what was written; it shares nothing with tetmend. Exit status: 0 all promises are
kept, 1 some are not. Meshes of those stay in the folder of the results, before and after.
"""

import argparse
import json
import os
import re
import statistics
import subprocess
import sys
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import compare
import documents
import kinds
import medit
import report
import yardstick
from yardstick import Figures, Surface

EQUAL = 4e-12  # part of a figure that rounding may change
MOST_EDGE_RATIO = 10.0
SEEDS = 20  # meshes of each kind
OTHER_GOALS_EVERY = 4  # meshes
WENT_BACK = "went back to the state"  # how a note of tetmend begins

RUNS = {  # options of the runs of every mesh
    "shell": [],
    "thorough": ["--schedule", "thorough"],
    "conservative": ["--schedule", "conservative"],
    "polish": ["--schedule", "polish"],
    "shell, sine": ["--measure", "sine"],
}
GOALS = [20, 35]  # of further runs of some meshes, with shell and thorough

TEXT = (
    "Small meshes of all kinds, made by chance, in runs of several schedules; goals other than 30 "
    f"degrees on every {OTHER_GOALS_EVERY}th mesh. *broken* counts promises: no run ends with a "
    "smaller theta_min, a theta_max above the larger of what it was and the goal's, more bad tets, "
    "a higher lambda, a smaller worst mean ratio or radius ratio, or a worst edge ratio above the "
    "larger of what it was and 10; no tet is inverted, and the surface is the same. Lambda is the share of angles "
    "outside the goal of the run. *missed* counts aims, which are no promises: no smaller mean of "
    "the mean ratio or the radius ratio, no more faces with more than 70 degrees of "
    "non-orthogonality. *went back*: runs that ended with a worse figure and gave the state after "
    "an earlier pass. The other columns are medians of after less before. The figures come from a "
    "program that shares nothing with tetmend."
)


# --- what is promised


@dataclass(frozen=True)
class Breach:
    """A promise or an aim that a run did not keep."""

    what: str
    before: float
    after: float

    def __str__(self) -> str:
        return f"{self.what}: {self.before:.15g} -> {self.after:.15g}"


def above(value: float, bound: float) -> bool:
    return value > bound + EQUAL * max(abs(value), abs(bound))


def broken(before: Figures, after: Figures, most_angle: float) -> list[Breach]:
    """Counts are taken as is better for the run where an angle lies at a bound."""
    rows = [
        ("smaller theta_min", before.theta_min, after.theta_min,
         above(before.theta_min, after.theta_min)),
        (f"larger theta_max, over {most_angle:g}", before.theta_max, after.theta_max,
         above(after.theta_max, max(before.theta_max, most_angle))),
        ("more bad tets", before.bad[1], after.bad[0], after.bad[0] > before.bad[1]),
        ("higher lambda %", before.lambda_percent[1], after.lambda_percent[0],
         above(after.lambda_percent[0], before.lambda_percent[1])),
        ("smaller worst mean ratio", before.worst_mean_ratio, after.worst_mean_ratio,
         above(before.worst_mean_ratio, after.worst_mean_ratio)),
        ("smaller worst radius ratio", before.worst_radius_ratio, after.worst_radius_ratio,
         above(before.worst_radius_ratio, after.worst_radius_ratio)),
        (f"larger worst edge ratio, over {MOST_EDGE_RATIO:g}", before.edge_ratio, after.edge_ratio,
         above(after.edge_ratio, max(before.edge_ratio, MOST_EDGE_RATIO))),
        ("more tets that are not positive", before.not_positive, after.not_positive,
         after.not_positive > before.not_positive),
    ]
    return [Breach(what, then, now) for what, then, now, worse in rows if worse]


def surface_broken(before: Surface, after: Surface) -> list[Breach]:
    """Faces that went or came."""
    rows = [("lost surface faces", before - after), ("new surface faces", after - before)]
    return [Breach(what, 0, faces.total()) for what, faces in rows if faces]


def missed(before: Figures, after: Figures) -> list[Breach]:
    """Aims, which are no promises."""
    rows = [
        ("smaller mean of the mean ratio", before.mean_mean_ratio, after.mean_mean_ratio,
         above(before.mean_mean_ratio, after.mean_mean_ratio)),
        ("smaller mean of the radius ratio", before.mean_radius_ratio, after.mean_radius_ratio,
         above(before.mean_radius_ratio, after.mean_radius_ratio)),
        ("more faces above 70 degrees", before.steep_faces, after.steep_faces,
         after.steep_faces > before.steep_faces),
    ]
    return [Breach(what, then, now) for what, then, now, worse in rows if worse]


# --- runs


@dataclass
class Outcome:
    """One run on one mesh."""

    kind: str
    mesh: str
    run: str
    command: str  # as a reader may type it
    broken: list[Breach]
    missed: list[Breach]
    before: Figures | None = None  # none: the run failed
    after: Figures | None = None
    went_back: bool = False


@dataclass(frozen=True)
class Task:
    """All runs on one mesh. Read from a file, or made of a kind and a seed."""

    kind: str
    seed: int
    file: Path | None
    runs: dict[str, list[str]]
    tetmend: Path
    folder: Path

    def name(self) -> str:
        return self.file.stem if self.file else f"{self.kind}-{self.seed}"


def goal_of(options: list[str]) -> tuple[float, float]:
    """Degrees that no angle is to be under or over."""
    if "--goal" not in options:
        return 30.0, 150.0
    least, _, most = options[options.index("--goal") + 1].partition(",")
    return float(least), float(most or 180 - float(least))


def input_of(task: Task) -> Path:
    """As a MEDIT file in the folder of the results."""
    file = task.folder / f"{task.name()}.mesh"
    if task.file is None:
        medit.write(file, kinds.make(task.kind, task.seed))
    else:
        subprocess.run([task.tetmend, "convert", task.file, file], check=True,
                       stdout=subprocess.DEVNULL)
    return file


def judged(before: medit.Mesh, after: medit.Mesh, goal: tuple[float, float],
           known: Figures | None = None) -> tuple[Figures, Figures, list[Breach], list[Breach]]:
    """Figures of both, promises broken, aims missed.

    @param known  the figures before, if they have been measured"""
    sides = yardstick.sides(after)
    then, now = known or yardstick.measure(before, goal), yardstick.measure(after, goal, sides)
    breaches = broken(then, now, goal[1])
    breaches += surface_broken(yardstick.surface(before), yardstick.surface(after, sides))
    return then, now, breaches, missed(then, now)


def perform(task: Task) -> list[Outcome]:
    file = input_of(task)
    before = medit.read(file)
    measured: dict[tuple[float, float], Figures] = {}
    outcomes = []
    for run, options in task.runs.items():
        stem = f"{task.name()}-{re.sub('[^a-z0-9]+', '-', run)}"
        result, told = task.folder / f"{stem}.mesh", task.folder / f"{stem}.json"
        words = ["tetmend", "improve", file.name, "-o", result.name, *options]
        outcome = Outcome(task.kind, task.name(), run, " ".join(words), [], [])
        ran = subprocess.run([task.tetmend, "improve", file, "-o", result, "--quiet", "--report",
                              told, *options], capture_output=True, text=True, check=False)
        if ran.returncode not in (0, 3):  # 3: a goal that was asked for is missed
            outcome.broken = [Breach(f"exit status: {ran.stderr.strip()}", 0, ran.returncode)]
        else:
            goal = goal_of(options)
            outcome.before, outcome.after, outcome.broken, outcome.missed = judged(
                before, medit.read(result), goal, measured.get(goal))
            measured[goal] = outcome.before
            notes = json.dumps(json.loads(told.read_text())["notes"])
            outcome.went_back = WENT_BACK in notes
        told.unlink(missing_ok=True)
        if not outcome.broken:
            result.unlink()
        outcomes.append(outcome)
    if not any(outcome.broken for outcome in outcomes):
        file.unlink()
    return outcomes


def runs_of(schedules: list[str], goals: bool) -> dict[str, list[str]]:
    """@param schedules  in place of the usual ones, if there are any"""
    if schedules:
        return {name: ["--schedule", name] for name in schedules}
    further = {f"{name}, goal {goal}": [*RUNS[name], "--goal", str(goal)]
               for name in ("shell", "thorough") for goal in GOALS} if goals else {}
    return {**RUNS, **further}


def tasks(options: argparse.Namespace) -> list[Task]:
    folder = compare.fresh_folder(options.output.resolve())
    tetmend = options.build.resolve() / "bin" / "tetmend"

    def task(kind: str, seed: int, file: Path | None, goals: bool) -> Task:
        return Task(kind, seed, file, runs_of(options.schedule, goals), tetmend, folder)

    if options.meshes:
        return [task(*mesh_named(name), True) for name in options.meshes]
    return [task(kind, seed, None, seed % OTHER_GOALS_EVERY == 0)
            for seed in range(options.seeds) for kind in kinds.available()]


def mesh_named(name: str) -> tuple[str, int, Path | None]:
    """Kind and number of a made mesh, or its file."""
    made = re.fullmatch(r"([a-z]+)-(\d+)", name)
    if made and made[1] in kinds.KINDS:
        return made[1], int(made[2]), None
    file = compare.named_mesh(name)
    return file.stem, 0, file


# --- tables


def change(values: Iterable[float]) -> str:
    median = statistics.median(values)
    return "0" if median == 0 else f"{median:+.3g}"


COLUMNS: dict[str, Callable[[Figures], float]] = {
    "theta_min": lambda figures: figures.theta_min,
    "theta_max": lambda figures: figures.theta_max,
    "bad": lambda figures: figures.bad[0],
    "lambda %": lambda figures: figures.lambda_percent[0],
    "worst mean ratio": lambda figures: figures.worst_mean_ratio,
    "worst radius ratio": lambda figures: figures.worst_radius_ratio,
    "edge ratio": lambda figures: figures.edge_ratio,
    "mean mean ratio": lambda figures: figures.mean_mean_ratio,
    "mean radius ratio": lambda figures: figures.mean_radius_ratio,
    "faces above 70": lambda figures: figures.steep_faces,
}


def row(kind: str, run: str, outcomes: list[Outcome]) -> list[str]:
    done = [outcome for outcome in outcomes if outcome.before and outcome.after]
    counts = [len(outcomes), sum(len(outcome.broken) for outcome in outcomes),
              sum(len(outcome.missed) for outcome in outcomes),
              sum(outcome.went_back for outcome in outcomes)]
    changes = [change(figure(outcome.after) - figure(outcome.before) for outcome in done)
               if done else "" for figure in COLUMNS.values()]
    return [kind, run, *map(str, counts), *changes]


def table_of(outcomes: list[Outcome]) -> documents.Table:
    table = [["kind", "schedule", "meshes", "broken", "missed", "went back", *COLUMNS]]
    names = list(dict.fromkeys(outcome.kind for outcome in outcomes))
    for kind in [*names, *(["all"] if len(names) > 1 else [])]:
        here = [outcome for outcome in outcomes if kind in ("all", outcome.kind)]
        for run in dict.fromkeys(outcome.run for outcome in here):
            table.append(row(kind, run, [outcome for outcome in here if outcome.run == run]))
    return table


def breaches(outcomes: list[Outcome]) -> list[str]:
    """Each broken promise, and the command that repeats it."""
    return [f"{outcome.mesh}, {outcome.run}: {breach} (`{outcome.command}`)"
            for outcome in outcomes for breach in outcome.broken]


def summary(outcomes: list[Outcome]) -> str:
    total = sum(len(outcome.broken) for outcome in outcomes)
    meshes = len({outcome.mesh for outcome in outcomes})
    return f"{len(outcomes):,} runs on {meshes:,} meshes, {total} promises broken."


def page(made: documents.Stamp, outcomes: list[Outcome]) -> str:
    listed = "\n".join(f"- {line}" for line in breaches(outcomes))
    parts = [TEXT, summary(outcomes), documents.markdown_table(table_of(outcomes))]
    return documents.document("Promises", made, [*parts, *([listed] if listed else [])])


# --- the command line


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="script/bench --promises", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("meshes", nargs="*", metavar="MESH",
        help="file, name of a default mesh, or kind and number of a made one, such as organ-3 "
             f"(default: {SEEDS} of each kind)")
    add("--schedule", action="append", default=[], metavar="NAME",
        help="in place of the usual runs; may be repeated")
    add("--seeds", type=int, default=SEEDS, metavar="N",
        help=f"meshes of each kind (default: {SEEDS})")
    add("--jobs", type=int, default=os.cpu_count(), metavar="N",
        help="meshes at the same time (default: as many as cores)")
    add("-o", "--output", type=Path, metavar="DIR", default=compare.WORK / "promises",
        help="folder of the results (default: build/bench/promises)")
    add("--build", type=Path, default=compare.BUILD, help="build folder")
    documents.add_option(parser)
    return parser.parse_args()


def main() -> int:
    options = parse()
    left_out = set(kinds.KINDS) - set(kinds.available())
    if left_out and not options.meshes:
        print(f"Left out, for TetGen is missing: {', '.join(sorted(left_out))}")
    outcomes: list[Outcome] = []
    with ProcessPoolExecutor(options.jobs) as pool:
        for some in pool.map(perform, tasks(options)):
            outcomes += some
            if lines := breaches(some):
                compare.progress("\n  ".join(lines))
    order = {kind: i for i, kind in enumerate(kinds.KINDS)}
    outcomes.sort(key=lambda outcome: order.get(outcome.kind, len(order)))
    print(report.text_table(table_of(outcomes)))
    print("", *breaches(outcomes), summary(outcomes), sep="\n")
    if options.write:
        made = documents.stamp("script/bench --promises")
        documents.write(options.write, page(made, outcomes))
    return 1 if any(outcome.broken for outcome in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
