# SPDX-License-Identifier: MIT
"""What the experiments share: runs of tetmend, judged by bench/measure, and files of results."""

import argparse
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import compare  # noqa: E402
import documents  # noqa: E402
import report  # noqa: E402

SCHEDULES = ["grummp", "stellar", "shell"]  # of Figure 12
SECONDS = "user s"
MEASURED = (
    "Angles in degrees; lambda in percent of the dihedral angles outside 30 to 150 degrees; bad "
    "tets have a minimum sine below 0.5. All are measured by a program that shares no formula with "
    "tetmend, which also found every surface unchanged, bit for bit."
)
TIMED = (
    f"*{SECONDS}* is the processor time of the whole run on one thread, with reading, measuring "
    "and writing. Other work on the machine changes it less than the time by the clock."
)
TITLES = {"grummp": "Grummp's schedule", "stellar": "Stellar's schedule", "shell": "Algorithm 6"}


def parse(name: str, text: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog=f"script/experiment {name}", description=text)
    parser.add_argument("meshes", nargs="*", metavar="MESH", help="file, or name of a known mesh")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR",
                        default=compare.ROOT / "build" / "experiments",
                        help="folder of the results (default: build/experiments)")
    parser.add_argument("--build", type=Path, default=compare.BUILD, help="build folder")
    parser.add_argument("--time-limit", type=float, default=300, metavar="S",
                        help="seconds of each run (default: 300)")
    documents.add_option(parser)
    options = parser.parse_args()
    compare.BUILD = options.build.resolve()
    options.output = options.output.resolve()
    options.output.mkdir(parents=True, exist_ok=True)
    return options


def own_meshes() -> list[Path]:
    folder = compare.ROOT / "assets" / "meshes"
    return sorted(path for path in folder.iterdir() if path.suffix in (".mesh", ".meshb"))


def meshes(options: argparse.Namespace) -> list[Path]:
    if options.meshes:
        return [compare.named_mesh(name) for name in options.meshes]
    shared = compare.default_meshes(quick=False)
    return own_meshes() + [path for path in shared if path not in own_meshes()]


def fingerprint(mesh: Path, options: argparse.Namespace, arguments: tuple[str, ...]) -> str:
    """Of all that a run depends on."""
    program = (compare.BUILD / "bin" / "tetmend").read_bytes()
    parts = [program, mesh.read_bytes(), repr(("user", arguments, options.time_limit)).encode()]
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


def user_seconds(command: list[str]) -> float:
    """Runs a command to its end: the processor time that it took, without that of the system."""
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, command)
    return usage.ru_utime


def improve(mesh: Path, options: argparse.Namespace, *arguments: str) -> dict:
    """One run on one thread: figures of bench/measure before and after, the seconds of improving by
    the clock, and those of the processor for all. A run that is there already is not made again:
    the experiments share some."""
    folder = options.output / "runs"
    folder.mkdir(exist_ok=True)
    kept = folder / f"{fingerprint(mesh, options, arguments)[:16]}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    result, told = folder / "result.meshb", folder / "report.json"
    command = [str(compare.BUILD / "bin" / "tetmend"), "improve", str(mesh), "-o", str(result),
               "--quiet", "--threads", "1", "--report", str(told),
               "--time-limit", f"{options.time_limit:g}", *arguments]
    processor = user_seconds(command)
    measured = compare.program_json("measure", str(mesh), str(result))
    if not measured["surface"]["surface"] == "identical":
        sys.exit(f"{mesh}: {' '.join(arguments)}: the surface changed")
    measured["seconds"] = json.loads(told.read_text())["seconds"]["improving"]
    measured["user_seconds"] = processor
    measured["over_limit"] = measured["seconds"] >= options.time_limit
    result.unlink()
    told.unlink()
    kept.write_text(json.dumps(measured))
    compare.progress(f"{mesh.stem}: {' '.join(arguments)}: {processor:.2f} s")
    return measured


def cells(measured: dict, seconds: float | None) -> list[str]:
    time = "" if seconds is None else report.seconds(seconds)
    return [f"{measured['tets']:,}", *report.quality(measured), time]


def page(title: str, made: documents.Stamp, text: str, table: documents.Table,
         pictures: list[str] | None = None, more: list[str] | None = None) -> str:
    """The document of an experiment.

    @param pictures  names of files
    @param more  what follows the table"""
    shown = [documents.picture(name, f"{title}: {Path(name).stem}") for name in pictures or []]
    words = [text, MEASURED, *([TIMED] if SECONDS in table[0] else [])]
    parts = ["\n\n".join(words), documents.markdown_table(table), *(more or []), *shown]
    return documents.document(title, made, parts)


def save(name: str, options: argparse.Namespace, content: dict, table: documents.Table, title: str,
         text: str, pictures: dict[str, str] | None = None, more: list[str] | None = None) -> None:
    """Prints the table and writes all that the experiment found: JSON, Markdown, pictures, and the
    document that was asked for.

    @param pictures  SVG by the name of its file; those that the document shows"""
    made = documents.stamp(f"script/experiment {name}")
    record = {"experiment": name, "command": made.command, "commit": made.commit,
              "date": made.date, "machine": documents.machine(), **content}
    (options.output / f"{name}.json").write_text(json.dumps(record, indent=2) + "\n")
    text_of_page = page(title, made, text, table, list(pictures or {}), more)
    documents.write(options.output / f"{name}.md", text_of_page, pictures)
    if options.write:
        documents.write(options.write, text_of_page, pictures)
    print(report.text_table(table))
