# SPDX-License-Identifier: MIT
"""Numbers of pages stand in the documents of results that they link; docs/reliability.md and its scripts.

reliability_test.py SOURCE_FOLDER
"""

import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
DOCS = SOURCE / "docs"
PAGE = (DOCS / "reliability.md").read_text()
LINK = re.compile(r"\[([^\]]*\d[^\]]*)\]\((results/[^)]*)\)")
NUMBER = re.compile(r"(?<![\w.,])\d+(?:,\d{3})*(?:\.\d+)?(?![\w])")


class Reliability(unittest.TestCase):
    def test_each_number_in_a_link_stands_in_the_document_that_is_linked(self) -> None:
        checked = dict.fromkeys((page.name for page in DOCS.glob("*.md")), 0)
        for page in checked:
            for text, target in LINK.findall((DOCS / page).read_text()):
                there = NUMBER.findall((DOCS / target).read_text())
                for number in NUMBER.findall(re.sub("`[^`]*`", "", text)):
                    self.assertIn(number, there, f"{page}: {target} has no {number} of '{text}'")
                    checked[page] += 1
        self.assertGreater(checked["reliability.md"], 10)
        self.assertGreater(checked["pieces.md"], 8)

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
