# SPDX-License-Identifier: MIT
"""What the experiments share: runs of tetmend, judged by bench/measure, and files of results."""

import argparse
import datetime
import hashlib
import json
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import compare  # noqa: E402
import report  # noqa: E402

SCHEDULES = ["grummp", "stellar", "shell"]  # of Table 3 and Figure 12
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
    parts = [program, mesh.read_bytes(), repr((arguments, options.time_limit)).encode()]
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


def improve(mesh: Path, options: argparse.Namespace, *arguments: str) -> dict:
    """One run: figures of bench/measure before and after, and the seconds of improving. A run that
    is there already is not made again: the experiments share some."""
    folder = options.output / "runs"
    folder.mkdir(exist_ok=True)
    kept = folder / f"{fingerprint(mesh, options, arguments)[:16]}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    result, told = folder / "result.meshb", folder / "report.json"
    command = [str(compare.BUILD / "bin" / "tetmend"), "improve", str(mesh), "-o", str(result),
               "--quiet", "--report", str(told), "--time-limit", f"{options.time_limit:g}"]
    subprocess.run([*command, *arguments], check=True)
    measured = compare.program_json("measure", str(mesh), str(result))
    if not measured["surface"]["surface"] == "identical":
        sys.exit(f"{mesh}: {' '.join(arguments)}: the surface changed")
    measured["seconds"] = json.loads(told.read_text())["seconds"]["improving"]
    measured["over_limit"] = measured["seconds"] >= options.time_limit
    result.unlink()
    told.unlink()
    kept.write_text(json.dumps(measured))
    compare.progress(f"{mesh.stem}: {' '.join(arguments)}: {measured['seconds']:.2f} s")
    return measured


def cells(measured: dict, seconds: float | None) -> list[str]:
    time = "" if seconds is None else report.seconds(seconds)
    return [f"{measured['tets']:,}", *report.quality(measured), time]


def save(name: str, options: argparse.Namespace, content: dict, table: report.Table) -> None:
    document = {"experiment": name, "date": datetime.date.today().isoformat(),
                "machine": compare.machine(), **content}
    (options.output / f"{name}.json").write_text(json.dumps(document, indent=2) + "\n")
    (options.output / f"{name}.md").write_text(report.markdown_table(table) + "\n")
    print(report.text_table(table))
