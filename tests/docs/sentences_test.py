# SPDX-License-Identifier: MIT
"""Sentences of README.md and of the pages have at most 30 words.

sentences_test.py SOURCE_FOLDER

A colon and a semicolon end a sentence here, a list of code is one word, and blocks of code have none.
"""

import re
import sys
import unittest
from collections.abc import Iterator
from pathlib import Path

SOURCE = Path(sys.argv[1])
MOST_WORDS = 30
ITEM = re.compile(r"^\s*(?:[-*]|\d\.)\s+")


def paragraphs(page: str) -> Iterator[str]:
    """Paragraphs, items of lists and cells of tables."""
    lines: list[str] = []
    for line in [*re.sub(r"```.*?```|<!--.*?-->", "\n\n", page, flags=re.S).splitlines(), ""]:
        if not line.strip() or line.startswith(("#", "|")) or ITEM.match(line):
            yield " ".join(lines)
            lines = []
        if line.startswith("|"):
            yield from line.split("|")
        elif line.strip() and not line.startswith("#"):
            lines.append(ITEM.sub("", line, count=1))


def sentences(page: str) -> Iterator[str]:
    for paragraph in paragraphs(page):
        text = re.sub(r"`[^`]*`", "CODE", paragraph)
        text = re.sub(r"CODE(?:,? (?:and )?CODE)+", "CODE", text)
        text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
        yield from re.split(r"(?<=[.!?:;])[*_)\"']*\s+", text)


class Sentences(unittest.TestCase):
    def test_no_sentence_of_a_page_is_long(self) -> None:
        count = 0
        for page in [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "docs").glob("*.md"))]:
            for sentence in sentences(page.read_text()):
                count += 1
                words = [word for word in sentence.split() if re.search(r"\w", word)]
                self.assertLessEqual(len(words), MOST_WORDS, f"{page.name}: {sentence.strip()}")
        self.assertGreater(count, 3000)

    def test_a_long_sentence_is_found_wherever_it_stands(self) -> None:
        long = "word " * 31 + "end."
        for page in [long, f"- {long}", f"| a | {long} |", f"Short. {long}", f"```\ncode\n```\n{long}"]:
            self.assertGreater(max(len(sentence.split()) for sentence in sentences(page)), MOST_WORDS, page)
        self.assertLess(max(len(sentence.split()) for sentence in sentences(f"```\n{long}\n```")), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
