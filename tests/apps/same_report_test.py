# SPDX-License-Identifier: MIT
"""Whichever way a mesh is improved, its report has the same keys; and where the bytes of the mesh are the same, the same
values: in memory, in pieces, in pieces of files, by tasks over files, by processes.

usage: same_report_test.py TETMEND TETMEND_MPI SOURCE      TETMEND_MPI: none where it is not built
"""

import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, MPI_PROGRAM, SOURCE = sys.argv[1:4]
PIECES = 4
# A proof and a walk through the whole mesh, which pieces of files never are: docs/pieces.md says why.
OF_WHOLE = ("limit.", "before.rulers.cg_steps", "before.rulers.work", "after.rulers.cg_steps", "after.rulers.work",
            "worst_tets")
OF_RUN = ("seconds", "arguments", "input", "output", "peak_memory_bytes", "tets_per_second", "threads", "ranks")
failures = []


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details)


def run(*words):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=280, check=False,
                          env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
    check(done.returncode in (0, 3), "a run failed", words, done.stderr)


def leaves(value, path=""):
    """By path; of a list, which may have any length, its entries as one value."""
    if isinstance(value, dict) and value:
        return {at: leaf for key, inner in value.items() for at, leaf in leaves(inner, f"{path}.{key}".lstrip(".")).items()}
    return {path: value}


def keys(report):
    """What is there, passes and the proof of a limit apart: null in place of a table counts as that table's absence."""
    return {path for path in leaves(report) if not path.startswith(("ranks", "settings"))}


def is_same(a, b):
    if isinstance(a, float) and isinstance(b, (int, float)):
        return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-12)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(is_same(x, y) for x, y in zip(a, b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(is_same(a[key], b[key]) for key in a if not key.startswith("seconds"))
    return a == b


def reports(folder, mesh, *options):
    """By name: the bytes of the mesh and the report."""
    made = {}

    def add(name, *words):
        out, report = folder / f"{name}.meshb", folder / f"{name}.json"
        run(*words, mesh, "-o", out, "--report", report, "-q", *options)
        made[name] = (out.read_bytes(), json.loads(report.read_text()))

    add("whole", PROGRAM, "improve")
    add("one", PROGRAM, "improve", "--memory", "1G")
    add("pieces", PROGRAM, "improve", "--pieces", PIECES)
    add("files", PROGRAM, "improve", "--pieces", PIECES, "--memory", "1G")
    if MPI_PROGRAM != "none":
        add("ranks", "mpirun", "--oversubscribe", "-n", 3, MPI_PROGRAM, "improve", "--pieces", PIECES)
    work, out, report = folder / "work", folder / "tasks.meshb", folder / "tasks.json"
    run(PROGRAM, "pieces", "split", work, mesh, "-o", out, "--pieces", PIECES, "-q", *options)
    while not json.loads((work / "plan.json").read_text())["finished"]:
        run(PROGRAM, "pieces", "improve", work, "-q")
        run(PROGRAM, "pieces", "join", work, "--report", report, "-q")
    made["tasks"] = (out.read_bytes(), json.loads(report.read_text()))
    return made


def compare(made):
    whole = keys(made["whole"][1])
    for name, (mesh, report) in made.items():
        check(keys(report) == whole, "other keys", name, keys(report) ^ whole)
        if name in ("whole", "pieces"):
            continue
        if name == "one":  # there is memory enough for the whole
            check(mesh == made["whole"][0], "other bytes", name)
            for path in ("histograms", "worst_tets"):
                check(is_same(made["whole"][1][path], report[path]), "another value", name, path)
            continue
        check(mesh == made["pieces"][0], "other bytes", name)
        expected, got = leaves(made["pieces"][1]), leaves(report)
        for path in expected.keys() & got.keys():
            if path.startswith((*OF_WHOLE, *OF_RUN)):
                continue
            check(is_same(expected[path], got[path]), "another value", name, path, expected[path], got[path])
        for expected_tet, tet in zip(made["pieces"][1]["worst_tets"], report["worst_tets"], strict=True):
            for key in expected_tet.keys() - {"hindrance", "reason"}:
                check(is_same(expected_tet[key], tet[key]), "another bad tet", name, key, expected_tet, tet)
        check(report["after"]["rulers"]["work"] is None, "what no piece can tell is told", name)
        check(report["histograms"]["step"]["after"] != report["histograms"]["step"]["before"], "one histogram", name)


with tempfile.TemporaryDirectory() as temporary:
    for mesh, options in [("bracket.meshb", ()), ("two_materials.mesh", ("--goal", "35,140")),
                          ("bracket.meshb", ("--surface", "1%"))]:
        folder = Path(temporary) / f"{mesh}-{len(options)}-{options[-1:] == ('1%',)}"
        folder.mkdir()
        compare(reports(folder, Path(SOURCE) / "assets/meshes" / mesh, *options))
sys.exit(1 if failures else 0)
