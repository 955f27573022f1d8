#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Time and memory for each tet from small to very large meshes: prints a Markdown table.

usage: growth.py BUILD_FOLDER WORK_FOLDER [--threads N] [--sizes N,N,...]

Meshes are lattices with moved points (bench/lattice.cpp), so that only the size changes.
"""
import argparse
import json
import subprocess
from pathlib import Path

HEADER = """| tets | before, bad | after, bad | theta_min | reading, s | building, s | improving, s | writing, s \
| improving, us a tet | ratio | peak, bytes a tet |
|---|---|---|---|---|---|---|---|---|---|---|"""


def measure(build: Path, work: Path, size: float, threads: int) -> dict:
    mesh = work / "lattice.meshb"
    report = work / "growth.json"
    improved = work / "lattice-improved.meshb"
    subprocess.run([build / "bench/lattice", f"{size:.0f}", mesh], check=True)
    command = [build / "bin/tetmend", "improve", mesh, "-o", improved, "--quiet",
               "--threads", str(threads), "--report", report]
    subprocess.run(command, check=True)
    mesh.unlink()
    improved.unlink()
    return json.loads(report.read_text())


def row(report: dict, base: float | None) -> tuple[str, float]:
    before, after, seconds = report["before"], report["after"], report["seconds"]
    per_tet = 1e6 * seconds["improving"] / before["tets"]
    cells = [f"{before['tets']:,}", f"{before['n_bad']:,}", f"{after['n_bad']:,}",
             f"{after['theta_min']:.2f}",
             *(f"{seconds[name]:.2f}" for name in ("reading", "building", "improving", "writing")),
             f"{per_tet:.2f}", f"{per_tet / base:.2f}" if base else "",
             f"{report['peak_memory_bytes'] / before['tets']:.0f}"]
    return "| " + " | ".join(cells) + " |", per_tet


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path)
    parser.add_argument("work", type=Path)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--sizes", default="1e4,1e5,1e6,1e7,3.7e7")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    print(HEADER)
    base = None
    for size in map(float, options.sizes.split(",")):
        line, per_tet = row(measure(options.build, options.work, size, options.threads), base)
        if abs(size - 1e6) < 1:
            base = per_tet
        print(line, flush=True)


if __name__ == "__main__":
    main()
