# SPDX-License-Identifier: MIT
"""Compares tetmend with the other improvers of this machine: time, memory and final quality.

Every improver runs on the same meshes, in turns, several times; bench/measure judges all results.
"""

import argparse
import json
import math
import os
import resource
import signal
import statistics
import subprocess
import sys
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path

import charts
import documents
import dots
import report
from competitors import Competitor, Phases, competitors, shown_command, version

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "release"
WORK = ROOT / "build" / "bench"
MESHES = os.environ.get("TETMEND_BENCH_MESHES", "")

GNU_TIME = "/usr/bin/time"
PATIENCE = 20  # seconds by the clock for each of the processor, on a busy machine
EXACT_MEASURES = ["tets", "theta_min", "theta_max", "lambda", "inverted", "flat", "volume"]
EXACT_RULERS = ["mean_ratio", "radius_ratio", "edge_ratio"]

EPILOG = """\
Results go to build/bench: results.json, results.md, and for each mesh a chart of all measures and
one of quality against time. With --write FILE a document like docs/results/rivals.md is written,
too.

TETMEND_BENCH_MESHES names a folder of meshes (.mesh, .meshb, .mesh.xz) that are default meshes too.
Rivals that Debian does not have are found through environment variables:
  TETMEND_BENCH_MMG3D    the program mmg3d
  TETMEND_BENCH_STELLAR  the program Stellar
  TETMEND_BENCH_HXT      HXT's optimiser, called as PROGRAM IN.mesh OUT.mesh
  TETMEND_BENCH_OTHER    any other program, called in the same way
  TETMEND_BENCH_PYTHON   a Python with other versions of the modules gmsh and netgen than Debian's

Other measurements, each with a --help and a --write of its own:
  script/bench --schedules [MESH...]   all schedules of tetmend
  script/bench --growth                time and memory for each tet, 10 thousand to 37 million tets
  script/bench --cores [MESH]          what more cores make of a run: measured, and by a model
  script/bench --files [MESH]          reading and writing of each format
  script/bench --promises [MESH...]    is a figure ever worse than before: meshes of all kinds
  script/bench --adapted [NUMBER...]   does tetmend adapt keep its promises, in runs made by chance
  script/bench --renumbered MESH...    what the order of vertices and tets changes
  script/bench --solvers [MESH...]     what solvers feel: error, CG steps, explicit steps
  script/bench --tangled [MESH...]     what is left of inverted tets in meshes that can be repaired
  script/bench --sizes [WORD...]       edges as long as wanted: tetmend adapt, MMG, Gmsh
  script/bench --kernel [MESH...]      the mesh kernel beside those of others: memory, walks, edits
  script/bench --micro [OPTION...]     walks, searches, edits, smoothing one by one; the options are
                                       those of Google Benchmark, such as --benchmark_filter=shell
"""


@dataclass
class Outcome:
    """One run of one improver."""

    status: str  # "ok", "time limit", or what went wrong
    whole: float = 0.0  # seconds from start to exit
    user: float = 0.0  # seconds of the processor, without those of the system
    phases: Phases = field(default_factory=dict)
    peak_bytes: int = 0


@dataclass
class Row:
    """All runs of one improver on one mesh."""

    competitor: Competitor
    outcomes: list[Outcome] = field(default_factory=list)
    quality: dict | None = None

    def status(self) -> str:
        return self.outcomes[-1].status if self.outcomes else "not run"

    def to_json(self) -> dict:
        good = [outcome for outcome in self.outcomes if outcome.status == "ok"]
        result = {
            "improver": self.competitor.name,
            "short": self.competitor.short,
            "ours": self.competitor.ours,
            "command": shown_command(self.competitor),
            "version": version(self.competitor),
            "status": self.status(),
            "runs": [asdict(outcome) for outcome in self.outcomes],
        }
        if good and self.quality:
            result["phases"] = {
                phase: spread([outcome.phases[phase] for outcome in good])
                for phase in good[0].phases
                if all(phase in outcome.phases for outcome in good)
            }
            result["whole_seconds"] = spread([outcome.whole for outcome in good])
            result["user_seconds"] = spread([outcome.user for outcome in good])
            result["peak_bytes"] = max(outcome.peak_bytes for outcome in good)
            result["after"] = self.quality["after"]
            result["surface"] = self.quality["surface"]
        return result


def spread(values: list[float]) -> dict:
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


# --- running


def run(command: Iterable[str], folder: Path, limit: float) -> Outcome:
    """Runs a command in a folder. GNU time takes processor time and peak memory: what the kernel
    tells this process about its children would include the memory of the interpreter.

    @param limit  seconds of the processor, which other work on the machine does not use up"""
    seconds = math.ceil(limit)
    timed = [GNU_TIME, "-q", "-f", "%M %U", "-o", "usage.txt", *command]
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    with open(folder / "log.txt", "wb") as log:
        start = time.perf_counter()
        process = subprocess.Popen(
            timed,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            env=environment,
            start_new_session=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU,
                                                  (seconds, seconds + 5)),
        )
        try:
            code = process.wait(timeout=PATIENCE * limit)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return Outcome(f"over {limit:.0f} s")
        whole = time.perf_counter() - start
    if code == 128 + signal.SIGXCPU:
        return Outcome(f"over {limit:.0f} s")
    if code != 0:
        return Outcome(f"exit status {code}")
    kilobytes, user = (folder / "usage.txt").read_text().split()[-2:]
    return Outcome("ok", whole, float(user), {}, 1024 * int(kilobytes))


def fresh_folder(path: Path) -> Path:
    path.mkdir(parents=True, exist_ok=True)
    for entry in path.iterdir():
        entry.unlink()
    return path


def run_once(row: Row, inputs: Path, folder: Path, limit: float) -> None:
    competitor = row.competitor
    fresh_folder(folder)
    for file in inputs.glob("input.*"):
        (folder / file.name).symlink_to(file)
    outcome = run(competitor.command, folder, limit)
    row.outcomes.append(outcome)
    if outcome.status != "ok":
        return
    result = folder / competitor.output
    if not result.exists():
        outcome.status = "no result"
        return
    outcome.phases = competitor.phases(folder)
    if row.quality is None:
        try:
            row.quality = program_json("measure", str(inputs / "input.mesh"), str(result))
        except subprocess.CalledProcessError:
            outcome.status = "unreadable result"
            return
    if competitor.ours and not report_agrees(folder / "report.json", row.quality["after"]):
        outcome.status = "its own report disagrees with bench/measure"


def report_agrees(file: Path, measured: dict) -> bool:
    """Whether the kernel's statistics are those of the independent routine. A tet or a face at a
    threshold may count for one only."""
    own = json.loads(file.read_text())["after"]
    pairs = [(own[key], measured[key]) for key in EXACT_MEASURES]
    pairs += [(own["rulers"][ruler][what], measured["rulers"][ruler][what])
              for ruler in EXACT_RULERS for what in ("worst", "mean")]
    counts = [(own["n_bad"], measured["n_bad"]),
              (own["rulers"]["faces_above_70"], measured["rulers"]["faces_above_70"])]
    return (all(math.isclose(*pair, rel_tol=1e-6) for pair in pairs)
            and all(math.isclose(*pair, rel_tol=1e-3, abs_tol=1) for pair in counts))


def program_json(name: str, *arguments: str) -> dict:
    command = [str(BUILD / "bench" / name), *arguments]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def prepare(mesh: Path, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    program = str(BUILD / "bench" / "prepare")
    subprocess.run([program, str(mesh), str(folder / "input.mesh")], check=True)
    subprocess.run([program, str(mesh), str(folder / "input.node"), "--unique"], check=True)


def compare(mesh: Path, found: list[Competitor], repetitions: int, limit: float) -> dict:
    name = mesh.stem
    inputs = WORK / "inputs" / name
    prepare(mesh, inputs)
    rows = [Row(competitor) for competitor in found]
    for repetition in range(repetitions):
        for row in rows:
            if repetition > 0 and row.status() != "ok":
                continue  # it would fail again, at the cost of another time limit
            folder = WORK / "runs" / name / row.competitor.short.replace(" ", "_")
            run_once(row, inputs, folder, limit)
            progress(f"{name}: {row.competitor.name}: {row.status()}")
    before = program_json("measure", str(inputs / "input.mesh"))["before"]
    return {"mesh": name, "before": before, "rows": [row.to_json() for row in rows]}


def progress(text: str) -> None:
    print(f"  {text}", file=sys.stderr, flush=True)


# --- what is compared


def own_mesh() -> Path:
    return ROOT / "assets" / "meshes" / "bracket.meshb"


def unpacked(packed: Path) -> Path:
    plain = WORK / packed.stem
    if not plain.exists():
        plain.parent.mkdir(parents=True, exist_ok=True)
        partial = plain.with_suffix(".partial")
        with open(partial, "wb") as stream:
            subprocess.run(["xz", "-dkc", str(packed)], stdout=stream, check=True)
        partial.rename(plain)
    return plain


def given_meshes() -> list[Path]:
    """Those of the folder TETMEND_BENCH_MESHES, the small first."""
    files = [path for pattern in ("*.mesh", "*.meshb", "*.mesh.xz")
             for path in Path(MESHES).glob(pattern)] if MESHES else []
    return sorted(files, key=lambda path: (path.suffix == ".xz", path.name))


def plain(mesh: Path) -> Path:
    return unpacked(mesh) if mesh.suffix == ".xz" else mesh


def default_meshes(quick: bool) -> list[Path]:
    meshes = [own_mesh(), *given_meshes()]
    return [plain(mesh) for mesh in (meshes[:2] if quick else meshes)]


def named_mesh(name: str) -> Path:
    """A file, or one of the default meshes by its name."""
    if Path(name).exists():
        return Path(name).resolve()
    for mesh in [*(ROOT / "assets" / "meshes").glob("*.mesh*"), *given_meshes()]:
        if name in (mesh.name, mesh.name.split(".")[0]):
            return plain(mesh)
    sys.exit(f"bench: no mesh {name}")


def chosen(rows: list[Competitor], only: list[str]) -> list[Competitor]:
    if not only:
        return rows
    wanted = [name.lower() for name in only]
    return [row for row in rows if any(name in row.name.lower() for name in wanted)]


# --- the command line


def add_folders(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--build", type=Path, default=BUILD, help="build folder")
    parser.add_argument("-o", "--output", type=Path, default=WORK, metavar="DIR",
                        help="folder of the results (default: build/bench)")


def use_folders(options: argparse.Namespace) -> None:
    global BUILD, WORK
    BUILD, WORK = options.build.resolve(), options.output.resolve()


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="script/bench",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("meshes", nargs="*", metavar="MESH", help="file, or name of a default mesh (default: all)")
    add("--quick", action="store_true", help="the two smallest default meshes only")
    add("--only", action="append", default=[], metavar="NAME", help="improvers with NAME in theirs")
    add("--repetitions", type=int, default=3, metavar="N", help="runs of each (default: 3)")
    add("--time-limit", type=float, default=1800, metavar="S",
        help="seconds of the processor for each run (default: 1800)")
    add("--continue", dest="continued", action="store_true",
        help="take what an earlier call, stopped or with fewer meshes, measured at this commit")
    add("--profile", action="store_true", help="and the functions that take the most time (perf)")
    add_folders(parser)
    documents.add_option(parser)
    options = parser.parse_args(arguments)
    use_folders(options)
    return options


def measured_before(results: dict, found: list[Competitor]) -> dict[str, dict]:
    """The meshes of an earlier call at the same commit with the same improvers, by their names."""
    file = WORK / "results.json"
    earlier = json.loads(file.read_text()) if file.exists() else {}
    if any(earlier.get(key) != results[key] for key in ("commit", "repetitions")):
        return {}
    names = [row.name for row in found]
    return {mesh["mesh"]: mesh for mesh in earlier["meshes"]
            if [row["improver"] for row in mesh["rows"]] == names}


def profile(mesh: Path) -> None:
    data = str(WORK / "perf.data")
    improve = [str(BUILD / "bin" / "tetmend"), "improve", str(mesh), "--quiet"]
    output = ["-o", str(WORK / "profiled.meshb")]
    subprocess.run(["perf", "record", "-q", "-o", data, *improve, *output], check=True)
    listing = ["perf", "report", "-i", data, "--stdio", "--percent-limit", "1"]
    text = subprocess.run(listing, check=True, capture_output=True, text=True).stdout
    print("\n".join(line for line in text.splitlines() if line and not line.startswith("#")))


def main() -> None:
    options = parse(sys.argv[1:])
    if not Path(GNU_TIME).exists():
        sys.exit("bench: please install the Debian package time")
    everyone = competitors(BUILD / "bin" / "tetmend")
    contenders = chosen(everyone, options.only)
    found = [row for row in contenders if row.found]
    meshes = [named_mesh(name) for name in options.meshes] or default_meshes(options.quick)
    made = documents.stamp("script/bench")
    results = {
        "date": made.date,
        "machine": documents.machine(),
        "command": made.command,
        "commit": made.commit,
        "repetitions": options.repetitions,
        "missing": [
            {"improver": row.name, "hint": row.hint} for row in contenders if not row.found
        ],
        "meshes": [],
    }
    WORK.mkdir(parents=True, exist_ok=True)
    earlier = measured_before(results, found) if options.continued else {}
    for mesh in meshes:
        results["meshes"].append(earlier.get(mesh.stem) or compare(
            mesh, found, options.repetitions, options.time_limit))
        (WORK / "results.json").write_text(json.dumps(results, indent=2) + "\n")
    print(report.text(results))
    drawings = {**charts.all_charts(results), **dots.all_charts(results)}
    for file in [WORK / "results.md", *([options.write] if options.write else [])]:
        documents.write(file, report.page(results), drawings)
    print(f"\nSaved in {os.path.relpath(WORK)}: results.json, results.md, figures.")
    if options.profile:
        profile(meshes[-1])


if __name__ == "__main__":
    main()
