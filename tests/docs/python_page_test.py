# SPDX-License-Identifier: MIT
"""Runs the commands of docs/python.md, in its order, in a folder of their own.

    python_page_test.py SOURCE BUILD PYTHON

Commands stand in blocks `sh`; a block `output` below has lines that they printed, blanks do not count; a block `python NAME` is a file.
Exit status 77: a module that the page imports is not installed.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from page_blocks import GEOMETRY, PLATE, blocks, commands_of, not_printed, write_files

SOURCE, BUILD, PYTHON = (Path(word).absolute() for word in sys.argv[1:4])
# What a test with a build of its own does.
ELSEWHERE = {"python3 -m venv --system-site-packages ~/mesh", ". ~/mesh/bin/activate", "pip install --no-build-isolation ."}
TEST = "Python: a wheel made without a network installs and runs"


def main() -> int:
    page = SOURCE / "docs/python.md"
    environment = dict(os.environ, PYTHONPATH=str(BUILD / "python"), PATH=f"{BUILD / 'bin'}:{os.environ['PATH']}")
    for module in ("numpy", "gmsh"):
        if subprocess.run([PYTHON, "-c", f"import {module}"], capture_output=True).returncode != 0:
            print(f"skipped: {module} is not installed for {PYTHON}")
            return 77
    if shutil.which("gmsh") is None:
        print("skipped: gmsh is not installed")
        return 77
    assert TEST in (SOURCE / "tests/CMakeLists.txt").read_text()
    elsewhere, ran, wrong, printed = set(), 0, 0, ""
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        (work / "part.geo").write_text(GEOMETRY)
        subprocess.run([BUILD / "bin/tetmend", "convert", SOURCE / "assets/meshes/bracket.meshb", work / "part.mesh"], check=True,
                       capture_output=True)
        (work / "plate.geo").write_text(PLATE)
        subprocess.run(["gmsh", "-2", "plate.geo", "-format", "stl", "-o", "part.stl"], cwd=work, check=True, capture_output=True)
        write_files(page, work)
        for kind, text in blocks(page):
            if kind == "sh":
                printed = ""
                for command, status in commands_of(text):
                    if command in ELSEWHERE:
                        elsewhere.add(command)
                        continue
                    done = subprocess.run(re.sub(r"^python3 ", f"{PYTHON} ", command), shell=True, cwd=work, env=environment,
                                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
                    printed += done.stdout
                    ran += 1
                    if done.returncode != status:
                        wrong += 1
                        print(f"{command}: status {done.returncode}\n{done.stdout}")
            elif kind == "output":
                for line in not_printed(text, printed):
                    wrong += 1
                    print(f"nobody printed: {line}\n{printed}")
            elif not kind.startswith("python "):
                wrong += 1
                print(f"a block of unknown kind: {kind}")
    print(f"{ran} commands run, {len(elsewhere)} elsewhere")
    return 1 if wrong or ran < 5 or elsewhere != ELSEWHERE else 0


if __name__ == "__main__":
    sys.exit(main())
