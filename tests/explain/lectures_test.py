# SPDX-License-Identifier: MIT
"""The lecture of docs/lectures: ten pages and an index, small, and as script/lectures makes them today.

    lectures_test.py SOURCE TETMEND
"""

import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE, TETMEND = (Path(argument).resolve() for argument in sys.argv[1:3])
LECTURES = SOURCE / "docs" / "lectures"


def script(*arguments: object) -> subprocess.CompletedProcess:
    return subprocess.run([SOURCE / "script" / "lectures", *map(str, arguments)], capture_output=True, text=True, timeout=300)


class Lectures(unittest.TestCase):
    def test_help_is_printed(self) -> None:
        done = script("--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("--check", done.stdout)

    def test_the_index_leads_to_ten_pages(self) -> None:
        links = re.findall(r'href="([^"]+)"', (LECTURES / "index.html").read_text())
        self.assertEqual(len(links), 10)
        self.assertEqual(sorted([*links, "index.html"]), sorted(page.name for page in LECTURES.glob("*.html")))
        self.assertLess(sum(page.stat().st_size for page in LECTURES.iterdir()), 3_000_000)

    def test_the_pages_are_what_the_script_makes(self) -> None:
        done = script("--program", TETMEND, "--check")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
