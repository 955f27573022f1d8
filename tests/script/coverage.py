# SPDX-License-Identifier: MIT
"""Reads what llvm-cov exports, from standard input: the share of lines that were run, by layer."""

import argparse
import dataclasses
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import documents  # noqa: E402

LAYERS = "platform kernel trace search envelope ops contract schedule face pieces explain report apps".split()
NEEDED = {"kernel": 90, "ops": 90, "schedule": 90, "trace": 90}


def lines_by_file(export: dict, source: Path) -> dict[Path, tuple[int, int]]:
    """For each source of a layer: its lines that were run, and all of them."""
    files = {}
    for file in export["data"][0]["files"]:
        path = Path(os.path.normpath(file["filename"]))  # a compiler cache writes build/checked/../../kernel
        if path.is_relative_to(source) and path.relative_to(source).parts[0] in LAYERS:
            lines = file["summary"]["lines"]
            files[path.relative_to(source)] = (lines["covered"], lines["count"])
    return files


def document(rows: documents.Table) -> str:
    made = dataclasses.replace(documents.stamp("script/coverage"), command="script/sanitize --memory && script/coverage")
    said = ("The share of lines that the tests run, counted by clang while `script/sanitize --memory` runs all tests but "
            "those of the viewer. The kernel, the operators, the schedules and the traces must have 90 %.")
    return documents.document("Lines that the tests run", made, [said, documents.markdown_table(rows)])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=lambda word: Path(word).resolve())
    parser.add_argument("--files", action="store_true")
    parser.add_argument("--write", type=Path)
    options = parser.parse_args()
    files = lines_by_file(json.load(sys.stdin), options.source)
    missed = []
    rows = [["layer", "lines", "run, %"]]
    for layer in LAYERS:
        mine = {path: counts for path, counts in files.items() if path.parts[0] == layer}
        covered, count = (sum(counts[i] for counts in mine.values()) for i in (0, 1))
        share = 100 * covered / max(1, count)
        print(f"coverage: {layer:9} {share:5.1f} % of {count:,} lines")
        rows.append([f"`{layer}/`", f"{count:,}", f"{share:.1f}"])
        if share < NEEDED.get(layer, 0):
            missed.append(f"{layer}, {NEEDED[layer]} %")
        if options.files:
            for path, (run, all_lines) in sorted(mine.items(), key=lambda item: item[1][0] - item[1][1]):
                print(f"    {str(path):48} {run:6} of {all_lines:6}")
    if options.write:
        documents.write(options.write, document(rows))
    if missed:
        print(f"coverage: less than is needed: {'; '.join(missed)}", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
