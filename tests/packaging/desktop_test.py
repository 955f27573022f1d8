# SPDX-License-Identifier: MIT
"""The menu entry of tetmend-view is sound, and the file types that it names are those of the files that tetmend reads.

    desktop_test.py SOURCE PROGRAM
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

FOLDER = Path(sys.argv[1]) / "apps" / "desktop"
PROGRAM = Path(sys.argv[2])
SPACE = "{http://www.freedesktop.org/standards/shared-mime-info}"


def entry() -> dict[str, str]:
    lines = (FOLDER / "tetmend-view.desktop").read_text().splitlines()
    return dict(line.split("=", 1) for line in lines if "=" in line)


def types() -> dict[str, list[str]]:
    """Type and patterns."""
    root = ElementTree.parse(FOLDER / "tetmend-mime.xml").getroot()
    return {each.get("type"): [glob.get("pattern") for glob in each.iter(f"{SPACE}glob")]
            for each in root.iter(f"{SPACE}mime-type")}


class Desktop(unittest.TestCase):
    @unittest.skipUnless(shutil.which("desktop-file-validate"), "desktop-file-utils is not installed")
    def test_the_menu_entry_is_valid(self) -> None:
        done = subprocess.run(["desktop-file-validate", FOLDER / "tetmend-view.desktop"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))

    def test_it_opens_the_types_that_are_described(self) -> None:
        self.assertEqual(set(entry()["MimeType"].strip(";").split(";")), set(types()))

    def test_each_ending_that_tetmend_reads_has_a_type(self) -> None:
        said = subprocess.run([PROGRAM, "--help-json"], capture_output=True, text=True, check=True).stdout
        endings = set(json.loads(said)["words"]["extension"]) | {".trace"}
        patterns = {pattern.removeprefix("*") for each in types().values() for pattern in each}
        self.assertEqual({pattern.removeprefix("mesh") for pattern in patterns}, endings)

    def test_the_icon_is_there(self) -> None:
        root = ElementTree.parse(FOLDER / f"{entry()['Icon']}.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))

    @unittest.skipUnless(shutil.which("update-mime-database"), "shared-mime-info is not installed")
    def test_the_database_of_types_takes_them(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            database = Path(name) / "mime"
            (database / "packages").mkdir(parents=True)
            shutil.copy(FOLDER / "tetmend-mime.xml", database / "packages" / "tetmend.xml")
            done = subprocess.run(["update-mime-database", database], capture_output=True, text=True,
                                  env={**os.environ, "XDG_DATA_DIRS": name})
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            known = (database / "globs2").read_text()
        for type_name, patterns in types().items():
            for pattern in patterns:
                self.assertRegex(known, rf"(?m)^\d+:{re.escape(type_name)}:{re.escape(pattern)}$")

    def test_a_lesson_is_known_by_its_first_bytes(self) -> None:
        magic = re.search(r'value="(TETTRAC)\\n"', (FOLDER / "tetmend-mime.xml").read_text())[1]
        traces = list((FOLDER.parent.parent / "assets" / "lessons").glob("*.trace"))
        self.assertTrue(traces)
        for trace in traces:
            self.assertEqual(trace.read_bytes()[:8], f"{magic}\n".encode())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
