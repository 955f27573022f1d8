# SPDX-License-Identifier: MIT
"""Elements that are dropped from a file have a note, however the file is read: as a whole, by slices, in pieces.

usage: dropped_test.py TETMEND
"""

import itertools
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = sys.argv[1]
POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
SOUND = [(1, 2, 3, 4), (2, 3, 4, 5)]
failures = []


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details)


def lattice(n):
    """Points and tets of n^3 cubes of six tets each."""
    points = [(x, y, z) for z in range(n + 1) for y in range(n + 1) for x in range(n + 1)]
    number = {p: i + 1 for i, p in enumerate(points)}
    tets = []
    for x, y, z in points:
        if max(x, y, z) == n:
            continue
        for axes in itertools.permutations(range(3)):
            corners = [[x, y, z]]
            for axis in axes:
                corners.append([c + (k == axis) for k, c in enumerate(corners[-1])])
            tets.append(tuple(number[tuple(c)] for c in corners))
    return points, tets


def write_meshb(file, tets, points=POINTS):
    bytes_ = struct.pack("<ii", 1, 2)

    def section(keyword, body):
        nonlocal bytes_
        bytes_ += struct.pack("<ii", keyword, len(bytes_) + 8 + len(body)) + body

    section(3, struct.pack("<i", 3))
    section(4, struct.pack("<i", len(points)) + b"".join(struct.pack("<dddi", *p, 0) for p in points))
    section(8, struct.pack("<i", len(tets)) + b"".join(struct.pack("<5i", *tet, 1) for tet in tets))
    file.write_bytes(bytes_ + struct.pack("<ii", 54, 0))


def main():
    twice = ([SOUND[0], (2, 3, 3, 4), SOUND[1]], "tet 2 (vertices 2 3 3 4) has a vertex twice: dropped")
    again = ([*SOUND, (4, 3, 2, 1)], "tet 3 is tet 1 again: dropped")
    with tempfile.TemporaryDirectory() as name:
        file, out = Path(name) / "a.meshb", Path(name) / "o.meshb"
        for (tets, note), options in [(case, options) for case in (twice, again)
                                      for options in ([], ["--pieces", "2"], ["--memory", "1G"])] + [
                                          (twice, ["--memory", "1G", "--pieces", "2"])]:
            write_meshb(file, tets)
            out.unlink(missing_ok=True)
            done = subprocess.run([PROGRAM, "improve", file, "-o", out, "-q", *options], capture_output=True, text=True)
            what = (note, *options)
            check(done.returncode == 0 and out.exists(), what, done.returncode, done.stderr)
            check(done.stderr.count(note) == 1, what, "is not told once", done.stderr)
            out.unlink(missing_ok=True)
            done = subprocess.run([PROGRAM, "improve", file, "-o", out, "-q", "--strict", *options], capture_output=True,
                                  text=True)
            check(done.returncode == 1 and not out.exists(), what, "--strict", done.returncode, done.stderr)
        # Slices do not know that a tet is there twice: pieces say which.
        write_meshb(file, again[0])
        done = subprocess.run([PROGRAM, "improve", file, "-o", out, "-q", "--memory", "1G", "--pieces", "2"],
                              capture_output=True, text=True)
        is_told = done.stderr.count(again[1]) == 1 if done.returncode == 0 else "tet 3 of the file" in done.stderr
        check(is_told, "a tet that is there twice in pieces", done.returncode, done.stderr)
        points, tets = lattice(6)
        a, b, c, d = tets[700]
        write_meshb(file, [*tets, (b, c, a, d)], points)
        out.write_text("older")
        done = subprocess.run([PROGRAM, "improve", file, "-o", out, "-q", "--checkpoint", Path(name) / "ck", "--pieces", "4"],
                              capture_output=True, text=True)
        told = "tet 1297 of the file is tet 701 again: a run in pieces drops none, 'tetmend convert' does"
        check(done.returncode == 1 and done.stderr == f"tetmend: {told}\n", "in pieces", done.returncode, done.stderr)
        check(out.read_text() == "older", "the older file is gone")
    if failures:
        sys.exit(f"{len(failures)} failures")


main()
