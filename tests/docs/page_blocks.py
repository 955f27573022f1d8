# SPDX-License-Identifier: MIT
"""What a page of the documents has: blocks with commands, what they print, and files. For the tests that run them."""

import re
from collections.abc import Iterator
from pathlib import Path

FENCE = re.compile(r"^```([^\n`]*)\n(.*?)^```", re.M | re.S)

# part.geo, which pages on Gmsh take for granted: two boxes with names.
GEOMETRY = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Physical Volume("steel", 1) = {1};
Physical Volume("copper", 2) = {2};
inlet() = Surface In BoundingBox {-0.1, -1, -1, 0.1, 2, 2};
walls() = Abs(CombinedBoundary{ Volume{1}; Volume{2}; });
walls() -= inlet();
Physical Surface("inlet", 3) = inlet();
Physical Surface("wall", 4) = walls();
Mesh.MeshSizeMax = 0.25;
Mesh.Optimize = 0;
"""
# The surface of part.stl, likewise: a plate with a hole.
PLATE = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 4, 1};
Cylinder(2) = {2, 2, 0, 0, 0, 1, 1};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.MeshSizeMax = 0.4;
"""


def blocks(page: Path) -> list[tuple[str, str]]:
    """Language (or what stands in its place) and content."""
    return [(language.strip(), content) for language, content in FENCE.findall(page.read_text())]


def commands_of(block: str) -> Iterator[tuple[str, int]]:
    """One from each line, without its comment, and the status with which it ends."""
    for line in block.splitlines():
        command, _, comment = line.partition(" # ")
        status = re.search(r"\bstatus (\d)", comment)
        if command.strip() and not command.startswith("#"):
            yield command.strip(), int(status[1]) if status else 0


def write_files(page: Path, folder: Path) -> None:
    """Those of its blocks that have a name: `python NAME`, `lua NAME`, `geo NAME`."""
    for language, content in blocks(page):
        kind, _, name = language.partition(" ")
        if kind in ("python", "lua", "geo") and name:
            (folder / name).write_text(content)


def not_printed(quoted: str, printed: str) -> list[str]:
    """The quoted lines that nobody printed; blanks do not count."""
    known = {" ".join(line.split()) for line in printed.splitlines()}
    return [line for line in quoted.splitlines() if " ".join(line.split()) not in known]
