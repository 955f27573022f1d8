# SPDX-License-Identifier: MIT
"""Runs every command of docs/c.md on its programs, with an installed tetmend; they write what the command line writes.

    c_page_test.py SOURCE PREFIX

A command whose program is not installed is named and passed over.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from page_blocks import blocks, commands_of

SOURCE, PREFIX = (Path(word).resolve() for word in sys.argv[1:3])


def main() -> int:
    page = blocks(SOURCE / "docs/c.md")
    programs = {file: [text for kind, text in page if kind == language] for file, language in (("part.c", "c"), ("older.cpp", "cpp"), ("part.f90", "fortran"))}
    commands = [command for kind, text in page if kind == "sh" for command, _ in commands_of(text)]
    if len(commands) != 6 or any(len(found) != 1 for found in programs.values()):
        print("docs/c.md has other programs and commands")
        return 1
    [library] = [file.parent for file in PREFIX.rglob("libtetmend.so")]
    environment = dict(os.environ, PKG_CONFIG_PATH=str(library / "pkgconfig"), LD_LIBRARY_PATH=str(library))
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        for file, [text] in programs.items():
            (work / file).write_text(text)
        shutil.copy(SOURCE / "assets/meshes/sheet.mesh", work / "part.mesh")
        subprocess.run([PREFIX / "bin/tetmend", "improve", "part.mesh", "-o", "expected.mesh", "--schedule",
                        "conservative", "--quiet"], cwd=work, check=True)
        for command in commands:
            program = command.split()[0]
            if not program.startswith("./") and shutil.which(program) is None:
                print(f"passed over, {program} is not installed: {command}")
                continue
            if program.startswith("./"):
                if not (work / program).exists():
                    continue
                (work / "better.mesh").unlink(missing_ok=True)
            result = subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=work, env=environment,
                                    capture_output=True, text=True, timeout=300)
            same = not program.startswith("./") or \
                (work / "better.mesh").read_bytes() == (work / "expected.mesh").read_bytes()
            print(f"{'ok    ' if result.returncode == 0 and same else 'FAIL  '}{command}")
            if result.returncode != 0 or not same:
                print(result.stdout + result.stderr)
                return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
