# SPDX-License-Identifier: MIT
"""The lecture of docs/lectures: ten pages and an index, small, and as script/lectures makes them today.

    lectures_test.py SOURCE TETMEND
"""

import json
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

    def test_each_page_is_small_and_leads_to_the_list_and_to_the_pages_beside_it(self) -> None:
        names = re.findall(r'href="([^"]+)"', (LECTURES / "index.html").read_text())
        self.assertEqual([int(name.split("-")[0]) for name in names], list(range(1, 11)))
        for n, name in enumerate(names):
            page = (LECTURES / name).read_text()
            self.assertLess(len(page.encode()), 150_000, name)
            links = dict(re.findall(r'<a id="to-(\w+)" href="([^"]+)"', page))
            wanted = {"contents": "index.html"}
            if n > 0:
                wanted["previous"] = names[n - 1]
            if n + 1 < len(names):
                wanted["next"] = names[n + 1]
            self.assertEqual(links, wanted, name)

    def test_the_ten_pages_ask_24_questions_whose_answers_they_hold(self) -> None:
        asked = []
        for page in LECTURES.glob("*-*.html"):
            recording = json.loads(re.search(r'id="recording">(.*?)</script>', page.read_text(), re.S).group(1))
            questions = [step["ask"] for step in recording["lesson"]["steps"] if "ask" in step]
            self.assertGreater(len(questions), 0, page.name)
            self.assertTrue(all(question["why"] and "answer" in question for question in questions), page.name)
            asked += questions
        self.assertEqual(len(asked), 24)
        self.assertEqual({question["kind"] for question in asked}, {"line", "accepted", "chord", "number"})

    def test_the_pages_are_what_the_script_makes(self) -> None:
        done = script("--program", TETMEND, "--check")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
