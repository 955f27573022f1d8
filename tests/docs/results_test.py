# SPDX-License-Identifier: MIT
"""docs/results: each table is of a commit that anyone can go back to, and what it says of small
meshes is so today. The page's own program makes these rows again.

results_test.py SOURCE_FOLDER commits             the commits that pages name
results_test.py SOURCE_FOLDER own BUILD_FOLDER    rows of meshes that come with tetmend
results_test.py SOURCE_FOLDER tire BUILD_FOLDER   rows of the paper's tire, from TETMEND_BENCH_MESHES
"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
WHAT = sys.argv[2]
BUILD = Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else None
RESULTS = SOURCE / "docs" / "results"
SKIPPED = 77  # as CTest is told
sys.path.insert(0, str(SOURCE / "bench"))
import compare  # noqa: E402
import documents  # noqa: E402

OWN = ["bracket", "folded_sheet", "sheet", "two_materials"]


@dataclass(frozen=True)
class Rerun:
    """How the cheap rows of a page are made again."""

    own: list[str] = field(default_factory=list)  # arguments that stand for meshes of tetmend
    tire: list[str] = field(default_factory=list)
    options: list[str] = field(default_factory=list)
    keys: int = 1  # cells at the beginning that say which rows belong together


RERUNS = {
    "ablation": Rerun(own=OWN, tire=["tire"]),
    "angles": Rerun(own=OWN, tire=["tire"]),
    "constraints": Rerun(own=OWN[1:]),
    "growth": Rerun(own=["--sizes", "1e4,1e5"]),
    "reconnection": Rerun(own=OWN, tire=["tire"]),
    "renumbered": Rerun(tire=["tire"], options=["--copies", "0"], keys=3),
    "rivals": Rerun(own=["bracket"], tire=["tire"],
                    options=["--only", "tetmend", "--repetitions", "1"]),
    "schedules": Rerun(own=OWN, tire=["tire"]),
    "sizes": Rerun(own=["radial", "coarser"], keys=2),  # rivals are not run
    "surface": Rerun(tire=["tire"], keys=2),  # rivals are not run
    "tangled": Rerun(own=["lattice", "--share", "10", "--share", "45"], keys=2),
}
NOT_RUN = {
    "cores": "large meshes only",
    "coverage": "all tests",
    "faults": "counts of what was tried",
    "files": "times only",
    "kernel": "times only",
    "fuzzing": "counts of what was tried",
    "parts": "times only",
    "promises": "sums over more than a thousand runs",
    "adapted": "medians over hundreds of runs",
    "ranks": "large meshes only",
    "solvers": "needs DOLFINx and CalculiX",
    "viewing": "times only",
}
NEED_TIME = {"rivals", "surface"}
# What another machine, or another load, changes.
VARIES = re.compile(r"(.* )?(s|seconds|MB)|tets a second|(improving )?us a tet|ratio|peak bytes a tet")

Rows = set[tuple[str, ...]]


# --- commits


def git(*arguments: str) -> subprocess.CompletedProcess:
    try:
        return subprocess.run(["git", "-C", str(SOURCE), *arguments], capture_output=True, text=True,
                              check=False)
    except OSError as error:
        return subprocess.CompletedProcess(arguments, 1, "", str(error))


def why_no_history() -> str | None:
    """Of an archive, or of a checkout that was cut short, nobody can tell."""
    top = git("rev-parse", "--show-toplevel")
    if top.returncode != 0:
        return top.stderr.strip()
    if Path(top.stdout.strip()).resolve() != SOURCE:
        return "these sources are no checkout of their own"
    if git("rev-parse", "--is-shallow-repository").stdout.strip() == "true":
        return "the checkout has not all of the history (git fetch --unshallow)"
    return None


class Commits(unittest.TestCase):
    def test_each_page_names_a_commit_in_the_history(self) -> None:
        for page in sorted(RESULTS.glob("*.md")):
            with self.subTest(page=page.name):
                commit = documents.HEAD.match(page.read_text())["commit"]
                self.assertRegex(commit, "^[0-9a-f]+$")
                known = git("merge-base", "--is-ancestor", commit, "HEAD")
                self.assertEqual(known.returncode, 0, f"{commit} is in no history of this commit: make {page.name} "
                                                      f"anew. {known.stderr}")


# --- rows


def program_of(page: str) -> Path:
    """Of the command that the page says it was made by."""
    words = documents.HEAD.match(page)["command"].split()
    if words[0] == "script/experiment":
        return SOURCE / "bench" / "experiments" / f"{words[1]}.py"
    name = words[1].removeprefix("--") if words[1].startswith("--") else "compare"
    return SOURCE / "bench" / f"{name}.py"


def lasting(heading: list[str], row: list[str]) -> tuple[str, ...]:
    """The cells that another run must have as well. A column `worst` goes with the one before."""
    cells, varies = [], False
    for name, cell in zip(heading, row, strict=True):
        varies = varies if name == "worst" else VARIES.fullmatch(name) is not None
        cells += [] if varies else [cell]
    return tuple(cells)


def rows_of(page: str) -> Iterator[tuple[str, Rows]]:
    """By the heading above a table and its columns."""
    for heading, table in documents.tables(page):
        name = " / ".join([heading, *lasting(table[0], table[0])])
        yield name, {lasting(table[0], row) for row in table[1:]}


def differences(written: str, made: str, keys: int) -> list[str]:
    """Rows that were made now and do not stand in the page, and rows of the page of which another
    stands in their place.

    @param keys  so many cells say what a row is about"""
    page = dict(rows_of(written))
    wrong = []
    for name, rows in rows_of(made):
        if "scheme" in name:  # of the paper
            continue
        about = {row[:keys] for row in rows}
        there = {row for row in page.get(name, set()) if row[:keys] in about}
        wrong += [f"today    | {' | '.join(row)} |" for row in sorted(rows - there)]
        wrong += [f"the page | {' | '.join(row)} |" for row in sorted(there - rows)]
    return sorted(wrong, key=lambda line: line.partition("|")[2])


class RowsOfPages(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)  # experiments share runs there

    def make(self, page: str, arguments: list[str]) -> str:
        """What the program of the page writes now."""
        file = self.folder / "made" / "page.md"
        program = program_of(page)
        folder = ["-o", self.folder / "runs"] if "--output" in self.help_of(program) else []
        ran = subprocess.run([sys.executable, "-B", program, *arguments, "--build", BUILD, *folder,
                              "--write", file], capture_output=True, text=True, check=False)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return file.read_text()

    def help_of(self, program: Path) -> str:
        return subprocess.run([sys.executable, "-B", program, "--help"], capture_output=True, text=True,
                              check=True).stdout

    def test_rows_are_what_tetmend_does_today(self) -> None:
        for name, rerun in RERUNS.items():
            meshes = getattr(rerun, WHAT)
            if not meshes:
                continue
            with self.subTest(page=name):
                if name in NEED_TIME and not Path(compare.GNU_TIME).exists():
                    self.skipTest(f"no {compare.GNU_TIME}: please install the Debian package time")
                page = (RESULTS / f"{name}.md").read_text()
                made = self.make(page, [*meshes, *rerun.options])
                count = sum(len(rows) for _, rows in rows_of(made))
                self.assertGreater(count, 0)
                wrong = differences(page, made, rerun.keys)
                if wrong:
                    self.fail(f"{name}.md is not of today:\n" + "\n".join(wrong))
                print(f"{name}: {count} rows", flush=True)

    def test_pieces_of_the_bracket_are_what_docs_pieces_says(self) -> None:
        if WHAT != "own":
            self.skipTest("not of this mesh")
        [table] = [table for _, table in documents.tables((SOURCE / "docs" / "pieces.md").read_text())
                   if "Pieces" in table[0]]
        first = next(i for i, row in enumerate(table) if row[0] == "`bracket`")
        last = next(i for i, row in enumerate(table) if i > first and row[0])
        self.assertGreater(last - first, 1)
        for _, pieces, *figures in table[first:last]:
            told = self.folder / "report.json"
            subprocess.run([BUILD / "bin" / "tetmend", "improve", compare.named_mesh("bracket"), "--quiet", "-o",
                            self.folder / "pieces.meshb", "--pieces", pieces, "--report", told], check=True)
            now = json.loads(told.read_text())["after"]
            self.assertEqual(figures, [f"{now['tets']:,}", f"{now['n_bad']:,}",
                                       f"{now['theta_min']:.1f}, {now['theta_max']:.1f}", f"{now['lambda']:.2g}"])

    def test_the_moving_body_does_what_docs_examples_says(self) -> None:
        if WHAT != "own":
            self.skipTest("not of this mesh")
        page = (SOURCE / "docs" / "examples.md").read_text()
        repaired, plain, at_once = (self.steps_of_the_body(*options)
                                    for options in ([], ["--plain"], ["--steps", "1"]))
        [(_, table)] = documents.tables(page)
        self.assertGreater(len(table), 4)
        for step, *figures in table[1:]:
            now, moved = repaired[int(step) - 1], plain[int(step) - 1]
            self.assertEqual(figures, [now["theta_min"], now["theta_max"], now["inverted"],
                                       f"{int(now['tets']):,}", f"{int(now['touched']):,}",
                                       moved["theta_min"], moved["theta_max"], moved["inverted"]], step)
        prose = " ".join(page.split())
        least = min(float(step["theta_min"]) for step in repaired)
        most = max(int(step["touched"]) / int(step["tets"]) for step in repaired)
        first = next(step for step in plain if step["inverted"] != "0")
        for claim in (f"the smallest angle of all 40 steps is {least:.1f} degrees",
                      f"No step touches more than {100 * most:.0f} % of the tets",
                      f"the first tets turn over in step {first['step']}.",
                      f"takes {at_once[0]['parts']} parts",
                      f"a smallest angle of {float(at_once[0]['theta_min']):.1f} degrees"):
            self.assertIn(claim, prose)

    def steps_of_the_body(self, *options: str) -> list[dict[str, str]]:
        ran = subprocess.run([BUILD / "bin" / "moving_body", *options], capture_output=True, text=True,
                             check=False)  # status 1 is for tets that turned over
        rows = [line.split() for line in ran.stdout.splitlines()]
        heading = next(i for i, row in enumerate(rows) if row[:1] == ["step"])
        return [dict(zip(rows[heading], row, strict=True)) for row in rows[heading + 1:]
                if len(row) == len(rows[heading]) and row[0].isdecimal()]

    def test_each_page_is_run_again_or_has_a_reason_why_not(self) -> None:
        pages = {page.stem for page in RESULTS.glob("*.md")}
        self.assertEqual(pages, RERUNS.keys() | NOT_RUN.keys())
        self.assertFalse(RERUNS.keys() & NOT_RUN.keys())

    def test_a_figure_that_was_changed_is_noticed(self) -> None:
        page = "## A\n\n| mesh | tets | user s |\n|---|---|---|\n| cube | 5 | 0.1 |\n| tire | 7 | 0.2 |\n"
        again = page.replace("0.1", "0.3").replace("| tire | 7 | 0.2 |\n", "")
        self.assertEqual(differences(page, again, 1), [])
        self.assertEqual(differences(page.replace("5", "6"), again, 1),
                         ["today    | cube | 5 |", "the page | cube | 6 |"])
        self.assertEqual(differences(page.replace("cube", "ball"), again, 1), ["today    | cube | 5 |"])


def main() -> None:
    if WHAT == "commits":
        lacking, case = why_no_history(), Commits
    else:
        is_there = WHAT == "own" or any(mesh.name.split(".")[0] == WHAT for mesh in compare.given_meshes())
        lacking = None if is_there else f"{WHAT} lies in no folder that TETMEND_BENCH_MESHES names"
        case = RowsOfPages
    if lacking:
        print(f"skipped: {lacking}")
        sys.exit(SKIPPED)
    ran = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(case))
    sys.exit(not ran.wasSuccessful())


if __name__ == "__main__":
    main()
