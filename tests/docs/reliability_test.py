# SPDX-License-Identifier: MIT
"""docs/reliability.md: its numbers stand in the documents of results that it links, its scripts are there.

reliability_test.py SOURCE_FOLDER
"""

import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
PAGE = (SOURCE / "docs" / "reliability.md").read_text()
NUMBER = re.compile(r"(?<![\w.,])\d[\d,]*(?:\.\d+)?")


class Reliability(unittest.TestCase):
    def test_each_number_in_a_link_stands_in_the_document_that_is_linked(self) -> None:
        checked = 0
        for text, target in re.findall(r"\[([^\]]*\d[^\]]*)\]\((results/[^)]*)\)", PAGE):
            there = NUMBER.findall((SOURCE / "docs" / target).read_text())
            for number in NUMBER.findall(text):
                self.assertIn(number, there, f"{target} has no {number} of '{text}'")
                checked += 1
        self.assertGreater(checked, 10)

    def test_each_promise_says_how_it_is_tested_and_how_often_it_was_tried(self) -> None:
        rows = [line for line in PAGE.splitlines() if line.startswith("| ")]
        self.assertGreater(len(rows), 20)
        for row in rows:
            self.assertTrue(all(cell.strip() for cell in row.strip("|").split("|")), row)

    def test_each_script_is_there(self) -> None:
        for script in re.findall(r"`(script/\w+)", PAGE):
            self.assertTrue((SOURCE / script).is_file(), script)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
