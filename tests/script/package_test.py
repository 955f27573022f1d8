# SPDX-License-Identifier: MIT
"""script/package in a fresh clone, with stand-ins for what builds and packs.

usage: package_test.py SOURCE_FOLDER
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
NAMES = ["tetmend", "tetmend-viewer", "libtetmend0.1", "libtetmend-dev", "python3-tetmend"]
failures = []


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details, flush=True)


class Clone:
    """A clone with the script as it is here, and programs of its own before all others."""

    def __init__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="tetmend-clone-"))
        self.source = self.folder / "tetmend"
        subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{SOURCE}", self.source], check=True)
        shutil.copy(SOURCE / "script/package", self.source / "script/package")
        self.tools = self.folder / "bin"
        self.tools.mkdir()
        self.stand_in("dpkg-shlibdeps", "exit 0")

    def stand_in(self, name, body):
        (self.tools / name).write_text(f"#!/bin/sh\n{body}\n")
        (self.tools / name).chmod(0o755)

    def run(self):
        environment = os.environ | {"PATH": f"{self.tools}:{os.environ['PATH']}"}
        return subprocess.run([self.source / "script/package"], env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=60)


if not (SOURCE / ".git").exists() or shutil.which("git") is None:
    sys.exit(77)
clone = Clone()
try:
    clone.stand_in("cmake", "echo 'no such compiler' >&2; exit 3")
    done = clone.run()
    check(done.returncode == 1, "a configuration that fails ends it", done.returncode)
    check(done.stdout.strip() == "no such compiler", "it says what CMake said, and nothing else", done.stdout)

    clone.stand_in("cmake", 'case "$1" in -S) mkdir -p "$4" ;; --build) test -d "$2" ;; esac')
    clone.stand_in("cpack", "echo 'no room' >&2; exit 1")
    done = clone.run()
    check(done.returncode == 1 and done.stdout.strip() == "no room", "a packer that fails ends it", done.stdout)

    clone.stand_in("cpack", "mkdir packages && touch " + " ".join(f"packages/{name}_1.deb" for name in NAMES))
    done = clone.run()
    check(done.returncode == 0, "in a fresh clone it makes packages", done.stdout)
    check(all(f"/{name}_1.deb" in done.stdout for name in NAMES), "it names them", done.stdout)
finally:
    shutil.rmtree(clone.folder)
sys.exit(1 if failures else 0)
