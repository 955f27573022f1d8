# SPDX-License-Identifier: MIT
"""Runs every command of docs/formats.md.

    formats_page_test.py SOURCE TETMEND

A command whose program is not installed is named and passed over. Exit status 77: Gmsh's, which
makes the meshes, is not there.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
DEBIAN_PYTHON = "/usr/bin/python3"

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

CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;
writeControl timeStep; writeInterval 1;
"""


DICTIONARY = "FoamFile {{ version 2.0; format ascii; class dictionary; object {0}; }}\n"
SCHEMES = "gradSchemes {} divSchemes {} laplacianSchemes {} interpolationSchemes {} snGradSchemes {} ddtSchemes {}\n"


def blocks(page: str) -> tuple[list[str], dict[str, str]]:
    """The commands, and the files that the page gives."""
    commands = [line for block in re.findall(r"```sh\n(.*?)```", page, re.S) for line in block.splitlines()]
    files = dict(re.findall(r"```python (\S+)\n(.*?)```", page, re.S))
    return commands, files


def deck_of(part: Path) -> str:
    """A deck from the converted mesh, with what a solver wants."""
    text = part.read_text()
    sets = re.findall(r"\*ELEMENT, TYPE=C3D4, ELSET=(\w+)", text)
    text += "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n"
    text += "".join(f"*SOLID SECTION, ELSET={name}, MATERIAL=M\n" for name in sets)
    return text + "*STEP\n*STATIC\n*BOUNDARY\ninlet, 1, 3\n*DLOAD\n*NODE PRINT, NSET=inlet, TOTALS=ONLY\nRF\n*END STEP\n"


def missing(command: str, tools: Path) -> str:
    """The program or module that the command lacks; empty: none."""
    lexer = shlex.shlex(command, punctuation_chars=True)
    words = list(lexer)
    programs = [words[0]] + [words[i + 1] for i, word in enumerate(words) if word == "|"]
    for program in programs:
        if shutil.which(program, path=f"{tools}:{os.environ['PATH']}") is None:
            return program
    if words[0] == "python3":
        known = subprocess.run([DEBIAN_PYTHON, "-c", "import gmsh, dolfinx"], capture_output=True)
        return "python3-dolfinx" if known.returncode != 0 else ""
    return ""


def main() -> int:
    commands, files = blocks((Path(sys.argv[1]) / "docs/formats.md").read_text())
    tetmend = str(Path(sys.argv[2]).resolve())
    if len(commands) < 15 or not files:
        print("docs/formats.md has no commands")
        return 1
    failures = passed = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        tools = folder / "bin"
        tools.mkdir()
        (tools / "tetmend").symlink_to(tetmend)
        (tools / "python3").symlink_to(DEBIAN_PYTHON)
        if shutil.which("gmsh") is None:
            print("skipped: install the package gmsh")
            return SKIPPED
        work = folder / "work"
        (work / "case/system").mkdir(parents=True)
        (work / "case/system/controlDict").write_text(CONTROL)
        (work / "case/system/fvSchemes").write_text(DICTIONARY.format("fvSchemes") + SCHEMES)
        (work / "case/system/fvSolution").write_text(DICTIONARY.format("fvSolution"))
        (work / "part.geo").write_text(GEOMETRY)
        for file, content in files.items():
            (work / file).write_text(content)
        environment = dict(os.environ, PATH=f"{tools}:{os.environ['PATH']}", OMP_NUM_THREADS="1",
                           WM_PROJECT_DIR="/usr/share/openfoam")  # where Debian has it
        for command in commands:
            lacking = missing(command, tools)
            if lacking:
                print(f"passed over, {lacking} is not installed: {command}")
                passed += 1
                continue
            if "job.inp" in command:
                subprocess.run([tetmend, "convert", "part.msh", "converted.inp"], cwd=work, check=True,
                               capture_output=True)
                (work / "job.inp").write_text(deck_of(work / "converted.inp"))
            result = subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=work, env=environment,
                                    capture_output=True, text=True, timeout=300)
            print(f"{'ok    ' if result.returncode == 0 else 'FAIL  '}{command}")
            if result.returncode != 0:
                print(result.stdout[-1500:] + result.stderr[-1500:])
                failures += 1
        improved = (work / "better.inp").exists() and (work / "bad.vtu").exists() and (work / "elmer/mesh.nodes").exists()
        if not improved:
            print("FAIL  files that the page promises are not there")
            failures += 1
    print(f"{len(commands)} commands, {passed} passed over, {failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
