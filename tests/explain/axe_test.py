# SPDX-License-Identifier: MIT
"""axe-core on every step of every lesson, at three sizes, light and dark, to the end of the lesson.

    axe_test.py SOURCE [PAGE...]     without pages: those of the lecture and its index

TETMEND_AXE names axe.min.js, of axe-core 4.7 or later. Exit status 77: without it, or Chromium is not installed.
"""

import json
import os
import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "tests" / "docs"))
import browser  # noqa: E402
from browser import window  # noqa: E402

SKIPPED = 77
AXE = os.environ.get("TETMEND_AXE", "")
LECTURES = SOURCE / "docs" / "lectures"
PAGES = [Path(page).resolve() for page in sys.argv[2:]] or sorted(LECTURES.glob("*-*.html"), key=lambda page: int(page.name.split("-")[0]))
SIZES = {"phone": (390, 844, False), "projector": (1280, 720, True), "desk": (1920, 1080, False)}  # width, height, large text

# What axe finds, in lines; what it cannot tell, such as the contrast over a picture, is left out.
FIND = """
const found = await axe.run(document, {resultTypes: ["violations"]});
return found.violations.flatMap((rule) => rule.nodes.map((node) => `${location.hash} ${rule.id} (${rule.impact}): ${node.target.join(" ")}`));
"""
ANSWER = "const n = arguments[0]; const ask = questionAt(n); if (ask) giveAnswer(n, false, ask.kind === 'chord' ? [0, 0] : 1); return Boolean(ask)"


def steps_of(page: Path) -> int:
    return len(json.loads(re.search(r'id="recording">(.*?)</script>', page.read_text(), re.S).group(1))["lesson"]["steps"])


class Axe(unittest.TestCase):
    def setUp(self) -> None:
        self.script = Path(AXE).read_text()

    def open(self, where: browser.Browser, page: Path) -> None:
        where.open("about:blank")
        where.open(page.as_uri())
        where.run(self.script + "; return axe.version")

    def test_no_step_of_a_lesson_has_a_fault(self) -> None:
        for name, (width, height, large) in SIZES.items():
            for dark in (False, True):
                where = window(width, height, dark)
                try:
                    for page in PAGES:
                        with self.subTest(size=name, dark=dark, page=page.name):
                            self.open(where, page)
                            if large:
                                where.run("if (document.documentElement.dataset.size !== 'large') document.getElementById('text-size').click()")
                            for step in range(steps_of(page)):
                                where.run("goToLesson(arguments[0])", step)
                                self.assertEqual(where.run(FIND), [], f"step {step + 1}")
                                if where.run(ANSWER, step):
                                    self.assertEqual(where.run(FIND), [], f"step {step + 1}, answered")
                finally:
                    where.close()

    def test_all_panels_and_the_index_have_no_fault(self) -> None:
        for width, height, _ in SIZES.values():
            for dark in (False, True):
                where = window(width, height, dark)
                try:
                    for page in PAGES:
                        self.open(where, page)
                        where.run("goTo(steps.length - 1)")
                        self.assertEqual(where.run(FIND), [], page.name)
                    self.open(where, LECTURES / "index.html")
                    self.assertEqual(where.run(FIND), [])
                finally:
                    where.close()


if __name__ == "__main__":
    if not (AXE and browser.is_installed()):
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
