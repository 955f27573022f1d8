# SPDX-License-Identifier: MIT
"""Reads what llvm-cov exports: the share of lines that were run, by layer.

usage: coverage.py SOURCE_FOLDER [--short] [--files] [--write FILE] <EXPORT
"""

import json
import os
import sys
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
LAYERS = ["platform", "kernel", "trace", "search", "envelope", "ops", "contract", "schedule", "face", "pieces", "explain", "report", "apps"]
NEEDED = {"kernel": 90, "ops": 90, "schedule": 90, "trace": 90}

files = {}
for file in json.load(sys.stdin)["data"][0]["files"]:
    path = Path(os.path.normpath(file["filename"]))  # a compiler cache writes build/checked/../../kernel
    if path.is_relative_to(SOURCE) and path.relative_to(SOURCE).parts[0] in LAYERS:
        lines = file["summary"]["lines"]
        files[path.relative_to(SOURCE)] = (lines["covered"], lines["count"])
missed = []
table = ["# Which lines the tests run", "", "Written by `script/coverage`: of all tests that are programs of C++.", "",
         "| Layer | Lines | Run % |", "|---|---|---|"]
for layer in LAYERS:
    mine = {path: counts for path, counts in files.items() if path.parts[0] == layer}
    covered, count = (sum(counts[i] for counts in mine.values()) for i in (0, 1))
    share = 100 * covered / max(1, count)
    print(f"coverage: {layer:9} {share:5.1f} % of {count:,} lines")
    table.append(f"| `{layer}/` | {count:,} | {share:.1f} |")
    if share < NEEDED.get(layer, 0):
        missed.append(layer)
    if "--files" in sys.argv:
        for path, (run, all_lines) in sorted(mine.items(), key=lambda item: item[1][0] - item[1][1]):
            print(f"    {str(path):48} {run:6} of {all_lines:6}")
if "--write" in sys.argv:
    Path(sys.argv[sys.argv.index("--write") + 1]).write_text("\n".join(table) + "\n")
sys.exit(f"coverage: less than is needed in {', '.join(missed)}" if missed else 0)
