# SPDX-License-Identifier: MIT
"""Figures of calls, looked at by other programs: PDF by qpdf and poppler, SVG by Python's reader.

figures_test.py SOURCE_FOLDER TETMEND

What needs a program that is not here is left out, with a line that says so.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SOURCE, TETMEND = Path(sys.argv[1]), sys.argv[2]
LESSONS = SOURCE / "assets" / "lessons"
SVG = "{http://www.w3.org/2000/svg}"
# Lesson, call, and kinds of figures that it has.
CASES = [("1-core", 0, ("ring", "tree", "timeline", "shell")), ("2-two-shells", 0, ("ring", "tree", "timeline", "shell")),
         ("6-smoothing", 0, ("tree", "timeline", "shell")), ("7-cavity", 0, ("tree", "shell"))]
FOLDER = tempfile.TemporaryDirectory()


def run(*command: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True)


def figure(lesson: str, call: int, kind: str, ending: str) -> Path:
    file = Path(FOLDER.name) / f"{lesson}-{call}-{kind}.{ending}"
    done = run(TETMEND, "trace", LESSONS / f"{lesson}.trace", "--figure", kind, "--call", call, "-o", file)
    assert done.returncode == 0 and done.stdout == "" and done.stderr == "", done
    return file


def all_figures(ending: str) -> list[Path]:
    return [figure(lesson, call, kind, ending) for lesson, call, kinds in CASES for kind in kinds]


def words_of_svg(file: Path) -> list[str]:
    return [element.text or "" for element in ElementTree.parse(file).getroot().iter(f"{SVG}text")]


class Figures(unittest.TestCase):
    def needs(self, program: str) -> None:
        if shutil.which(program) is None:
            self.skipTest(f"tetmend: skipped: no {program} here")

    def test_svg_is_xml_with_shapes_inside_of_the_page(self) -> None:
        for file in all_figures("svg"):
            root = ElementTree.parse(file).getroot()
            width, height = (float(root.attrib[name].removesuffix("pt")) for name in ("width", "height"))
            self.assertGreater(len(root), 10)
            for shape in root.iter():
                for x, y in (pair.split(",") for pair in shape.attrib.get("points", "").split()):
                    self.assertTrue(0 <= float(x) <= width and 0 <= float(y) <= height, f"{file.name}: {x},{y}")

    def test_pdf_is_sound(self) -> None:
        self.needs("qpdf")
        for file in all_figures("pdf"):
            done = run("qpdf", "--check", file)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_pdf_has_the_words_of_the_svg(self) -> None:
        self.needs("pdftotext")
        for lesson, call, kinds in CASES:
            for kind in kinds:
                svg = words_of_svg(figure(lesson, call, kind, "svg"))
                told = run("pdftotext", "-raw", figure(lesson, call, kind, "pdf"), "-").stdout
                self.assertEqual(sorted("".join(svg).replace(" ", "")), sorted("".join(told.split())),
                                 f"{lesson} {kind}")

    def test_a_ring_and_a_shell_have_their_vertices(self) -> None:
        self.needs("pdftotext")
        ring = run("pdftotext", figure("1-core", 0, "ring", "pdf"), "-").stdout.split()
        for vertex in "234567":
            self.assertIn(vertex, ring)
        shell = run("pdftotext", figure("1-core", 0, "shell", "pdf"), "-").stdout
        for name in ("a", "b", "p"):
            self.assertRegex(shell, rf"\b{name}")

    def test_the_caption_of_a_ring_has_the_index_of_its_first_vertex_below_the_line(self) -> None:
        texts = list(ElementTree.parse(figure("1-core", 0, "ring", "svg")).getroot().iter(f"{SVG}text"))
        self.assertNotIn("_", "".join(words_of_svg(figure("1-core", 0, "ring", "svg"))))
        at = next(i for i, text in enumerate(texts) if "skirt polygon has" in (text.text or ""))
        line, letter, index, rest = texts[at:at + 4]
        self.assertEqual([letter.text, index.text], ["p", "1"])
        self.assertTrue(rest.text.startswith(" = 2 on top"), rest.text)
        self.assertGreater(float(index.attrib["y"]), float(line.attrib["y"]))
        self.assertLess(float(index.attrib["font-size"]), float(line.attrib["font-size"]))

    def test_words_are_as_wide_as_they_were_laid_out(self) -> None:
        """By poppler's own metrics of Helvetica."""
        self.needs("pdftotext")
        compared = 0
        for lesson, call, kind in (("1-core", 0, "ring"), ("2-two-shells", 0, "ring"), ("2-two-shells", 0, "tree"),
                                   ("2-two-shells", 0, "timeline")):
            laid_out: dict[str, set[float]] = {}
            for element in ElementTree.parse(figure(lesson, call, kind, "svg")).getroot().iter(f"{SVG}text"):
                laid_out.setdefault(element.text or "", set()).add(float(element.attrib["textLength"]))
            in_lines = {word for text in laid_out if " " in text for word in text.split()}
            boxes = run("pdftotext", "-bbox", figure(lesson, call, kind, "pdf"), "-").stdout
            for left, right, word in re.findall(r'xMin="([\d.]+)"[^>]*xMax="([\d.]+)"[^>]*>([^<]*)</word>', boxes):
                widths = laid_out.get(word)
                if not widths or word in in_lines:
                    continue
                compared += 1
                self.assertLess(min(abs(float(right) - float(left) - width) for width in widths), 0.2, word)
        self.assertGreater(compared, 20)

    def test_svg_is_drawn_by_librsvg(self) -> None:
        self.needs("rsvg-convert")
        for file in all_figures("svg"):
            done = run("rsvg-convert", file, "-o", file.with_suffix(".png"))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(file.with_suffix(".png").stat().st_size, 2000)

    def test_what_is_wrong_is_one_line_and_leaves_no_file(self) -> None:
        trace = LESSONS / "1-core.trace"
        out = Path(FOLDER.name) / "wrong.svg"
        for status, arguments, words in (
                (2, ["--figure", "ring", "-o", out], "--figure ring needs --call"),
                (2, ["--figure", "ring", "--call", "0"], "--figure needs -o, a .svg, .pdf or .tex file"),
                (2, ["--call", "0"], "--call is for --figure"),
                (2, ["--figure", "tree", "--call", "0", "--look", "10,20", "-o", out], "--look is for --figure shell"),
                (2, ["--figure", "pie", "--call", "0", "-o", out], "expected one of ring, tree, timeline, shell"),
                (2, ["--figure", "ring", "--call", "0", "-o", out.with_suffix(".gif")], "written as .svg, .pdf or .tex"),
                (2, ["--figure", "ring", "--tree", "0", "-o", out], "figure"),
                (1, ["--figure", "ring", "--call", "99", "-o", out], "there is no call 99")):
            done = run(TETMEND, "trace", trace, *arguments)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertFalse(out.exists())


if __name__ == "__main__":
    program = unittest.main(argv=sys.argv[:1], exit=False, verbosity=1)
    for _, reason in program.result.skipped:
        print(reason)
    sys.exit(0 if program.result.wasSuccessful() else 1)
