# SPDX-License-Identifier: MIT
"""The path of docs/overview.md for a newcomer: an hour's reading, of files that are there.

newcomer_test.py SOURCE_FOLDER
"""

import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "bench"))
import documents  # noqa: E402

MOST_LINES = 1200


def path() -> dict[str, tuple[int, int]]:
    """The files to read: lines as told, and as they are."""
    text = (SOURCE / "docs" / "overview.md").read_text()
    [table] = [rows for heading, rows in documents.tables(text) if heading == "A newcomer's hour"]
    return {name.strip("`"): (int(told), len((SOURCE / name.strip("`")).read_text().splitlines()))
            for name, told, _ in table[1:]}


class NewcomersHour(unittest.TestCase):
    def test_the_files_to_read_have_at_most_1200_lines_in_all(self) -> None:
        self.assertGreaterEqual(len(path()), 4)
        self.assertLessEqual(sum(lines for _, lines in path().values()), MOST_LINES)

    def test_the_page_tells_how_long_each_file_is_within_a_tenth(self) -> None:
        for name, (told, lines) in path().items():
            self.assertLessEqual(abs(told - lines), 0.1 * lines + 5, f"{name} has {lines} lines")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
