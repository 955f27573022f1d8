# SPDX-License-Identifier: MIT
"""A dependency stands in script/bootstrap, docs/install.md, docs/dependencies.md and CMake at once.

bootstrap_test.py SOURCE_FOLDER
"""

import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "bench"))
import documents  # noqa: E402

NOT_PACKAGES = {"PkgConfig", "tetmend"}  # a module of CMake; tetmend itself
OPTIONS = {"REQUIRED", "QUIET", "IMPORTED_TARGET", "GLOBAL", "COMPONENTS", "NO_MODULE"}


def quoted(cell: str) -> set[str]:
    return set(re.findall(r"`([^`]+)`", cell))


def table() -> documents.Table:
    [(_, rows)] = documents.tables((SOURCE / "docs" / "dependencies.md").read_text())
    return rows[1:]


def listed() -> str:
    """What script/bootstrap installs, as it prints it."""
    command = [SOURCE / "script" / "bootstrap", "--list"]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def packages() -> set[str]:
    groups = {"build", "surface", "viewer", "test", "bench", "check", "site", "package"}
    return {word for line in listed().splitlines() for i, word in enumerate(line.split())
            if not (i == 0 and line[0] != " " and word in groups)}


def found_by_cmake() -> set[str]:
    names: set[str] = set()
    # Not below build: other tests make and remove folders there meanwhile.
    folders = [folder for folder in SOURCE.iterdir() if folder.is_dir() and folder.name != "build"]
    for file in [SOURCE / "CMakeLists.txt", *(file for folder in folders for file in folder.rglob("CMakeLists.txt"))]:
        text = file.read_text()
        names |= set(re.findall(r"^ *find_package\((\w+)", text, re.M))
        for words in re.findall(r"^ *pkg_check_modules\(\w+ ([^)]+)\)", text, re.M):
            names |= {word for word in words.split() if word not in OPTIONS and word[0] != "$"}
        for words in re.findall(r"^ *set\(TETMEND_LUA (.+) CACHE", text, re.M):
            names |= set(words.split())
    return names - NOT_PACKAGES


class Dependencies(unittest.TestCase):
    def test_the_page_on_installing_quotes_the_list_of_bootstrap(self) -> None:
        self.assertIn(f"```\n{listed()}```", (SOURCE / "docs" / "install.md").read_text())

    def test_each_package_has_a_purpose(self) -> None:
        self.assertEqual({name for row in table() for name in quoted(row[0])}, packages())

    def test_what_cmake_looks_for_has_a_package(self) -> None:
        self.assertEqual({name for row in table() for name in quoted(row[1])}, found_by_cmake())


class Readme(unittest.TestCase):
    def test_it_has_at_most_120_lines(self) -> None:
        self.assertLessEqual(len((SOURCE / "README.md").read_text().splitlines()), 120)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
