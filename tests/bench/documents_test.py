# SPDX-License-Identifier: MIT
"""What the bench writes for readers: the form of its documents, tables from known figures, and
pages that quote them. Runs no measurement.

documents_test.py SOURCE_FOLDER
"""

import math
import sys
import tempfile
import unittest
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "bench"))
import cores  # noqa: E402
import documents  # noqa: E402
import dots  # noqa: E402
import files  # noqa: E402
import growth  # noqa: E402
import measures  # noqa: E402
import micro  # noqa: E402
import pages  # noqa: E402
import ranks  # noqa: E402
import report  # noqa: E402
import viewing  # noqa: E402

MADE = documents.Stamp("script/bench --quick", "0123abc", "2026-11-22", "AMD EPYC, 2 cores, 25 GB")
MEASURED = {"tets": 1000, "theta_min": 0.0012, "theta_max": 179.5, "lambda": 5.25, "n_bad": 1234,
            "inverted": 0, "flat": 0,
            "rulers": {"mean_ratio": {"worst": 0.0005, "mean": 0.75},
                       "radius_ratio": {"worst": 0.0, "mean": 0.7},
                       "edge_ratio": {"worst": 12.345, "mean": 2.0}, "faces_above_70": 1300}}
BETTER = {**MEASURED, "tets": 900, "theta_min": 30.0, "theta_max": 149.0, "lambda": 0.0, "n_bad": 7}


def times(median: float) -> dict:
    return {"median": median, "min": 0.9 * median, "max": 1.1 * median}


def compared(name: str, ours: bool, after: dict) -> dict:
    phases = {phase: times(0.5) for phase in report.PHASES} if ours else {"improving": times(2)}
    return {"improver": name, "short": name, "ours": ours, "command": f"{name} input.mesh",
            "version": "1.0", "status": "ok", "phases": phases, "whole_seconds": times(3),
            "user_seconds": times(1),
            "peak_bytes": 87_000_000, "after": after,
            "surface": {"surface": "identical", "lost": 0, "distance": 0}}


COMPARISON = {
    "date": MADE.date, "commit": MADE.commit, "command": MADE.command, "repetitions": 3,
    "machine": {"processor": "AMD EPYC", "cores": 2, "memory_bytes": 25e9, "load_before": 0.1},
    "missing": [{"improver": "MMG", "hint": "Needs MMG"}],
    "meshes": [{"mesh": "cube", "before": MEASURED, "rows": [
        compared("tetmend, 1 thread", True, BETTER),
        compared("Some", False, {**BETTER, "n_bad": 90}),
        compared("Other", False, {**BETTER, "n_bad": 80, "flat": 3})]}],
}
FAILED = ("over ", "exit status ")  # of a run that took too long or crashed
PRINTED = """\
cube.mesh: 5 tets

blocks by the size of the mesh
threads                      1       2
smoothing                 1.00    1.99
all: speed-up             1.00    1.96

pass                     alone %  deferred %   seconds
smoothing                   0.58        43.7      0.44

one thread for each block
  blocks   alone %  deferred %  critical s  speed-up    n_bad   q_worst
       1     93.22         0.0        1.51       1.0     4315    0.2768
"""


def tables(text: str) -> list[documents.Table]:
    return [table for _, table in documents.tables(text)]


# By page, the cells behind the mesh that mean a run of a schedule.
RUNS = {
    "ablation": {("nothing",): "thorough"},
    "constraints": {("respected",): "shell"},
    "renumbered": {("shell", "file"): "shell", ("thorough", "file"): "thorough"},
    "rivals": {("tetmend, 1 thread",): "shell", ("tetmend, 2 threads",): "shell",
               ("tetmend, thorough, 1 thread",): "thorough", ("tetmend, polish, 1 thread",): "polish"},
    "schedules": {(name,): name for name in ("conservative", "grummp", "polish", "shell", "stellar",
                                             "thorough")},
}


def count(figure: str) -> int:
    return int(figure.split(", ")[0].replace(",", ""))


def same_runs(results: Path) -> Iterator[tuple[str, tuple[str, str], dict[str, str]]]:
    """Page, mesh and schedule, and the figures of quality."""
    names = {"tets": "tets", "tets after": "tets", "bad": "bad", "theta_min": "theta_min",
             "theta_max": "theta_max", "lambda %": "lambda %"}
    for page, schedules in RUNS.items():
        for heading, table in documents.tables((results / f"{page}.md").read_text()):
            if "bad" not in table[0] or "tets before" in table[0]:
                continue
            for row in table[1:]:
                mesh, *rest = row if table[0][0] == "mesh" else [heading, *row]
                for words, schedule in schedules.items():
                    if tuple(rest[:len(words)]) == words:
                        cells = dict(zip(table[0], row, strict=True))
                        yield page, (mesh, schedule), {known: cells[name] for name, known in
                                                       names.items() if name in cells}


class Documents(unittest.TestCase):
    def test_the_first_lines_say_command_commit_date_and_machine(self) -> None:
        found = documents.HEAD.match(documents.document("Title", MADE, ["Text."]))
        self.assertEqual(found["title"], "Title")
        self.assertEqual(documents.Stamp(found["command"], found["commit"], found["date"],
                                         found["machine"]), MADE)

    def test_a_command_is_shown_without_folders_and_files_of_this_machine(self) -> None:
        arguments = ["/home/me/part.mesh", "tire", "--write", "docs/x.md", "-o", "/tmp/x",
                     "--build=/tmp/b", "--threads", "2"]
        self.assertEqual(documents.typed("script/bench", arguments),
                         "script/bench part.mesh tire --threads 2")

    def test_what_was_written_as_a_table_is_read_as_that_table(self) -> None:
        table = [["mesh", "bad"], ["cube", "1,234"], ["tire", ""]]
        text = documents.document("T", MADE, ["## Here", documents.markdown_table(table), "End."])
        self.assertEqual(list(documents.tables(text)), [("Here", table)])

    def test_prose_is_wrapped_and_tables_are_not(self) -> None:
        wide = [["a" * 120, "b"], ["c", "d"]]
        text = documents.document("T", MADE, ["word " * 50, documents.markdown_table(wide)])
        self.assertEqual(tables(text), [wide])
        self.assertTrue(all(len(line) <= 100 for line in text.splitlines() if line[0:1] != "|"))

    def test_pictures_lie_in_a_folder_beside_the_document(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "results" / "page.md"
            documents.write(file, documents.picture("x.svg", "X"), {"x.svg": "<svg/>"})
            self.assertEqual(file.read_text(), "![X](figures/x.svg)")
            self.assertEqual((file.parent / "figures" / "x.svg").read_text(), "<svg/>")


class Tables(unittest.TestCase):
    def test_a_comparison_has_all_improvers_their_commands_and_what_is_missing(self) -> None:
        text = report.page(COMPARISON)
        self.assertIsNotNone(documents.HEAD.match(text))
        own, cube, shapes, commands = tables(text)
        self.assertEqual(own[1][4:8], ["0.0012 -> 30.00", "179.50 -> 149.00", "5.25 -> 0",
                                       "1,234 -> 7"])
        self.assertEqual(cube[1], ["(input)", "1,000", "0.0012", "179.50", "5.25", "1,234",
                                   "", "", "", "", ""])
        self.assertEqual(cube[3], ["Some", "900", "30.00", "149.00", "0", "90", "kept",
                                   "1.80", "2.70", "0.900", "87"])
        self.assertEqual(cube[4][5], "80, 3 inverted or flat")
        self.assertEqual(shapes[1], ["(input)", "0.0005", "0.7500", "0.0000", "0.7000", "12.35",
                                     "1,300"])
        self.assertEqual([row[0] for row in shapes[2:]], [row[0] for row in cube[2:]])
        self.assertEqual(commands[2], ["Some", "`Some input.mesh`", "1.0"])
        self.assertIn("not run: MMG", text)
        self.assertIn("![cube, 1,000 tets: quality against time](figures/quality-cube.svg)", text)
        self.assertIn("![cube, 1,000 tets: all measures](figures/measures-cube.svg)", text)

    def test_a_chart_of_measures_has_each_improver_in_each_row_and_places_it_by_its_figure(
            self) -> None:
        [mesh] = COMPARISON["meshes"]
        drawn = ElementTree.fromstring(dots.chart(mesh))
        space = "{http://www.w3.org/2000/svg}"
        texts = [element.text for element in drawn.iter(f"{space}text")]
        for measure in measures.MEASURES:
            self.assertIn(measure.title, texts)
        self.assertEqual(len(list(drawn.iter(f"{space}circle"))), 1 + len(measures.MEASURES))
        self.assertEqual(len(list(drawn.iter(f"{space}polygon"))), 2 * (1 + len(measures.MEASURES)))
        [least] = [measure for measure in measures.MEASURES if measure.column == "theta_min"]
        [bad] = [measure for measure in measures.MEASURES if measure.column == "bad"]
        self.assertEqual(dots.places(least, [10.0, 20.0, 30.0]), [0.0, 0.5, 1.0])
        self.assertEqual(dots.places(bad, [1000, 10, 100]), [0.0, 1.0, 0.5])
        self.assertEqual(dots.places(bad, [7, 7]), [1.0, 1.0])

    def test_dots_in_one_place_are_moved_apart(self) -> None:
        placed = dots.moved_apart([600.0] * 9 + [300.0])
        for i, one in enumerate(placed):
            for other in placed[:i]:
                self.assertGreater(math.dist(one, other), 0.9 * dots.APART)
        self.assertEqual(placed[0], (600.0, 0.0))
        self.assertEqual(placed[-1], (300.0, 0.0))

    def test_growth_compares_larger_meshes_with_that_of_a_million(self) -> None:
        def told(tets: int, improving: float) -> dict:
            seconds = {"reading": 0.1, "building": 0.2, "improving": improving, "writing": 0.3}
            return {"before": {"tets": tets, "n_bad": 9}, "after": {"n_bad": 1, "theta_min": 30.0},
                    "seconds": seconds, "peak_memory_bytes": 80 * tets}

        runs = {1e5: told(100_000, 0.1), 1e6: told(1_000_000, 2.0), 1e7: told(10_000_000, 30.0)}
        [table] = tables(growth.page(MADE, growth.table_of(runs)))
        self.assertEqual([row[8:] for row in table[1:]],
                         [["1.00", "", "80"], ["2.00", "", "80"], ["3.00", "1.50", "80"]])

    def test_pieces_are_played_again_on_more_processes(self) -> None:
        def told(count: int) -> dict:
            parts = [{"step": step, "part": part, "tets": 100, "seconds": seconds}
                     for step, times in enumerate([[1.0, 3.0, 2.0, 2.0], [0.5] * 4, [0.2, 0.1]])
                     for part, seconds in enumerate(times)]
            divisions = [{"tets": 400, "bytes": 8000, "seconds": 0.4}] * 4
            passes = [{"name": name, "n_bad": n_bad}
                      for name, n_bad in (("division", 20), ("division", 10), ("zones", 5))]
            return {"before": {"tets": 400, "n_bad": 90}, "passes": passes, "processor_share": 1.0,
                    "processor_seconds": 12.0, "after": {"n_bad": 5, "tets": 390, "theta_min": 20.0, "theta_max": 150.0},
                    "seconds": {"building": 0.1, "measuring": 1.2, "improving": 9.0, "total": 11.0},
                    "ranks": {"count": count, "peak_memory_bytes": [50_000_000] * count,
                              "bytes_a_tet_and_division": 20.0, "divisions": divisions,
                              "parts": parts}}

        runs = {1: told(1), 2: told(2)}
        whole, on_disk = ({**told(1), "peak_memory_bytes": peak} for peak in (3e7, 2.5e8))
        memory, pieces, *played = tables(ranks.page(MADE, runs, whole, on_disk))
        self.assertEqual(memory[2][:5], ["2", "50", "50", "60", "20.0"])
        self.assertEqual(pieces[1:], [["division 1", "4", "20000.00", "1.50", "1000.00"],
                                      ["division 2", "4", "5000.00", "1.00", "1000.00"],
                                      ["zones 1", "2", "750.00", "1.33", "1000.00"]])
        self.assertEqual([[row[0] for row in table[1:]] for table in played],
                         [["1", "4", "16", "64", "256", "1,024"]] * 3)
        # What is kept and what is missed is said.
        self.assertIn("2 processes keep the bound for memory, with 50 of 60 MB", ranks.kept_or_missed(runs, whole))
        runs[2]["ranks"]["peak_memory_bytes"] = [5e7, 6.1e7]
        self.assertIn("2 processes miss the bound for memory, with 61 of 60 MB", ranks.kept_or_missed(runs, whole))
        self.assertIn("took 250 MB, more than the 240 MB", ranks.out_of_core(on_disk))
        # Seconds are those of the processor, of which a run may have had a part.
        [half, *_] = ranks.steps_of({**runs[1], "processor_share": 0.5})
        self.assertEqual(half.seconds, [0.5, 1.5, 1.0, 1.0])
        # Of two processes all wait for the slower one: 4 of 8, 1 of 2, 0.2 of 0.3.
        timed = ranks.Timed("cube", 4, {**whole, "processor_seconds": 6.0}, told(1))
        self.assertAlmostEqual(ranks.share_of_two(timed), 5.2 / 10.3)
        self.assertIn("Pieces take 2.0 times as long", ranks.time_kept(timed))
        _, seconds, *_ = tables(ranks.page(MADE, runs, whole, on_disk, timed))
        self.assertEqual([row[1] for row in seconds[1:]], ["6.0", "12.0"])
        # The measured run itself, on one core without a network, is what was measured.
        known = ranks.Measured(ranks.steps_of(runs[1]), ranks.checking_of(runs[1]), 0.0)
        same = ranks.play(known, 400, 4, 1, ranks.Cluster(cores=1))
        self.assertAlmostEqual(same.improving, 8 + 2)
        self.assertAlmostEqual(same.zones, 0.3)
        self.assertAlmostEqual(same.dividing, 4 * 0.4 + 0.4)
        self.assertAlmostEqual(same.work, 10.3)
        # Pieces 0 and 1 are of the first process: it works 4 + 1, the other one waits no less.
        two = ranks.play(known, 400, 4, 2, ranks.Cluster(cores=1))
        self.assertAlmostEqual(two.improving, 4 + 1)
        self.assertAlmostEqual(two.zones, 0.2)
        self.assertAlmostEqual(two.dividing, 1.0)
        # Twice the mesh in twice the pieces: the same for each of twice the processes, but zones.
        more = ranks.play(known, 800, 8, 4, ranks.Cluster(cores=1))
        self.assertAlmostEqual(more.improving, two.improving)
        self.assertEqual(ranks.loads_of_ranges([1, 2, 3], 5), [1, 2, 0, 3, 0])

    def test_what_the_viewer_costs_is_in_seconds_or_milliseconds(self) -> None:
        def figure(what: str, seconds: float) -> dict:
            return {"what": what, "median": seconds, "mean": seconds, "most": 2 * seconds}

        mesh = {"tets": 10_110_954, "events": 0, "peak_memory": 700_000_000, "figures": [figure("open", 2.345)]}
        trace = {"tets": 998_250, "events": 2_650_000, "peak_memory": 900_000_000, "figures": [figure("step", 0.0015)]}
        page = viewing.page(MADE, [mesh, trace])
        opened, stepped = tables(page)
        self.assertEqual(opened[1], ["open", "2.35 s", "2.35 s", "4.69 s"])
        self.assertEqual(stepped[1], ["step", "1.50 ms", "1.50 ms", "3.00 ms"])
        self.assertIn("## A mesh of 10,110,954 tets: 0.70 GB", page)
        self.assertIn("## A trace of 998,250 tets and 2,650,000 events: 0.90 GB", page)

    def test_the_tables_of_scaling_keep_all_their_figures(self) -> None:
        threads, passes, blocks = tables(cores.page(MADE, {"cube": PRINTED}))
        self.assertEqual(threads, [["threads", "1", "2"], ["smoothing", "1.00", "1.99"],
                                   ["all: speed-up", "1.00", "1.96"]])
        self.assertEqual(passes[1], ["smoothing", "0.58", "43.7", "0.44"])
        self.assertEqual(blocks[1], ["1", "93.22", "0.0", "1.51", "1.0", "4315", "0.2768"])

    def test_threads_that_were_measured_stand_before_the_model(self) -> None:
        runs = [cores.Run("cube", "shell", threads, improving, 0.25, improving + 1)
                for threads, improving in ((1, 4.0), (1, 4.2), (1, 9.0), (4, 1.4), (4, 1.5), (4, 1.6))]
        with tempfile.TemporaryDirectory() as folder:
            cores.Measured(MADE, runs).save(Path(folder) / "saved.json")
            measured = cores.Measured.load(Path(folder) / "saved.json")
        page = cores.page(MADE, {"cube": PRINTED}, [measured])
        self.assertIn("the median of 3", " ".join(page.split()))
        table, *model = tables(page)
        self.assertEqual(table[1:], [["cube", "shell", "1", "4.20", "1.0", "0.25", "5.20"],
                                     ["cube", "shell", "4", "1.50", "2.8", "0.25", "2.50"]])
        self.assertEqual(len(model), 3)

    def test_a_row_of_files_has_the_speed_of_reading(self) -> None:
        seconds = {"reading": 0.1, "building": 0.2, "writing": 0.4}
        self.assertEqual(files.row("MEDIT", 45_400_000, 2, seconds),
                         ["MEDIT", "45.4", "2", "0.100", "0.200", "0.400", "454"])

    def test_the_least_of_repeated_micro_benchmarks_counts_by_the_right_clock(self) -> None:
        def ran(name: str, cpu: float, real: float, kind: str = "iteration") -> dict:
            return {"name": name, "run_type": kind, "cpu_time": cpu, "real_time": real,
                    "time_unit": "ns"}

        told = {"benchmarks": [ran("walk", 200, 900), ran("walk", 100, 950),
                               ran("flip/manual_time", 9e6, 500),
                               ran("walk_mean", 1, 1, "aggregate")]}
        self.assertEqual(micro.table_of(told)[1:], [["`walk`", "0.1"],
                                                    ["`flip/manual_time`", "0.5"]])


class Pages(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = Path(folder.name)
        (self.results / "rivals.md").write_text(report.page(COMPARISON))

    def test_a_figure_is_taken_from_its_place_in_a_table(self) -> None:
        template = ("- All {rivals / cube / (input) / bad} and\n  {rivals / cube /\n  Some / bad}."
                    "\n- {rivals / Some / command}\n\n| {rivals / cube / Some / improving s} |\n")
        self.assertEqual(pages.page(template, self.results),
                         "- All 1,234 and 90.\n- `Some input.mesh`\n\n| 1.80 |\n")

    def test_the_best_rival_is_that_with_the_fewest_bad_tets(self) -> None:
        template = ("{rivals / cube / best rival / improver}, {rivals / cube / best rival / bad}; "
                    "{rivals / cube / best rival / edge ratio}")
        self.assertEqual(pages.page(template, self.results),
                         "Other, 80, 3 inverted or flat; 12.35\n")

    def test_a_figure_alone_is_without_its_brackets(self) -> None:
        (self.results / "felt.md").write_text("## all\n\n| improver | step |\n|---|---|\n| Some | 2.38 (1) |\n")
        template = "{felt / all / Some / step}, {felt / all / Some / step, alone}"
        self.assertEqual(pages.page(template, self.results), "2.38 (1), 2.38\n")

    def test_a_place_that_means_no_cell_or_several_is_an_error(self) -> None:
        for place in ["rivals / cube / Nobody / bad", "rivals / cube / bad"]:
            with self.assertRaises(SystemExit) as refused:
                pages.page(f"{{{place}}}", self.results)
            self.assertIn(place, str(refused.exception))


class Published(unittest.TestCase):
    """The documents of this repository."""

    def test_each_document_of_results_says_how_it_was_made(self) -> None:
        found = sorted((SOURCE / "docs" / "results").glob("*.md"))
        self.assertGreaterEqual(len(found), 5)
        for file in found:
            text = file.read_text()
            head = documents.HEAD.match(text)
            self.assertIsNotNone(head, file.name)
            script = SOURCE / head["command"].split()[0]
            self.assertTrue(script.exists(), head["command"])
            self.assertNotIn(" with changes", head["commit"], file.name)
            self.assertGreaterEqual(len(tables(text)), 1, file.name)

    def test_pages_quote_the_figures_of_these_documents(self) -> None:
        for template in (SOURCE / "bench" / "pages").glob("*.md"):
            written = pages.page(template.read_text(), SOURCE / "docs" / "results")
            self.assertEqual((SOURCE / "docs" / template.name).read_text(), written,
                             "script/pages writes it anew")
        for document in pages.WITH_PARTS:
            text = document.read_text()
            for part in (SOURCE / "bench" / "pages" / "parts").glob("*.md"):
                self.assertIn(f"<!-- {part.stem} -->", text, document.name)
            self.assertEqual(text, pages.with_parts(document, SOURCE / "docs" / "results"),
                             "script/pages writes it anew")

    def test_tables_that_tell_of_the_same_run_agree(self) -> None:
        """Two programs count, so one tet at the threshold may be bad for one of them only."""
        told: dict[tuple[str, str], dict[str, tuple[str, str]]] = {}
        for page, run, figures in same_runs(SOURCE / "docs" / "results"):
            for name, figure in figures.items():
                known, where = told.setdefault(run, {}).setdefault(name, (figure, page))
                message = f"{name} of {' / '.join(run)}: {known} in {where}, {figure} in {page}"
                if name == "bad":
                    self.assertLessEqual(abs(count(known) - count(figure)), 1, message)
                else:
                    self.assertEqual(known, figure, message)
        self.assertGreater(len(told), 20)

    def test_the_page_on_the_surface_has_the_figures_of_its_results(self) -> None:
        [quoted] = [table for _, table in documents.tables((SOURCE / "docs" / "surface.md").read_text())
                    if "Program" in table[0]]
        [measured] = tables((SOURCE / "docs" / "results" / "surface.md").read_text())
        wanted = [measured[0].index(name)
                  for name in ("mesh", "program", "angles", "below 30 or above 150")]
        there = [[row[i] for i in wanted] for row in measured[1:]]
        self.assertGreater(len(quoted), 3)
        for row in quoted[1:]:
            self.assertIn(row, there)

    def test_no_run_in_a_table_was_ended_by_the_clock(self) -> None:
        for file in (SOURCE / "docs" / "results").glob("*.md"):
            self.assertNotIn(", stopped |", file.read_text(), f"{file.name}: give it a longer --time-limit")

    def test_what_pages_claim_of_schedules_is_so(self) -> None:
        def of(mesh: str, schedule: str) -> dict[str, float]:
            return {name: float(pages.figure(f"schedules / {mesh} / {schedule} / {name}",
                                             SOURCE / "docs" / "results").replace(",", ""))
                    for name in ("tets", "theta_min", "theta_max", "bad", "user s")}

        shell, stellar, thorough = (of("f6_1m", name) for name in ("shell", "stellar", "thorough"))
        self.assertLess(stellar["bad"], thorough["bad"])  # "One schedule leaves fewer on the largest mesh, ..."
        self.assertLess(stellar["tets"], thorough["tets"])  # "... at a price."
        self.assertGreater(stellar["user s"], 5 * thorough["user s"])
        self.assertLess(stellar["bad"], shell["bad"])
        self.assertGreater(of("f6_280k", "stellar")["bad"], of("f6_280k", "shell")["bad"])
        for mesh in ("f6_1m", "f6_280k", "f6s_280k"):  # "better angles than Stellar's on all these aircraft"
            self.assertGreater(of(mesh, "thorough")["theta_min"], of(mesh, "stellar")["theta_min"])
            self.assertLess(of(mesh, "thorough")["theta_max"], of(mesh, "stellar")["theta_max"])

    def test_what_pages_claim_of_operators_is_so(self) -> None:
        def of(mesh: str, column: str) -> dict[str, float]:
            [table] = tables((SOURCE / "docs" / "results" / "ablation.md").read_text())
            return {row[1]: float(row[table[0].index(column)].replace(",", ""))
                    for row in table[1:] if row[0] == mesh}

        for mesh, operator in (("f6_1m", "cavity_insertion"), ("f6_280k", "insert_points")):
            bad = of(mesh, "bad")
            self.assertEqual(max(bad, key=bad.get), operator)  # "Insertion buys most"
        least = of("f6_280k", "theta_min")
        for operator in ("sequence", "joint_smoothing"):  # "raise the smallest angle"
            self.assertLess(least[operator], least["nothing"] - 0.5)
        self.assertGreater(of("f6_1m", "tets")["local_reconnection"], 1.1 * of("f6_1m", "tets")["nothing"])

    def test_what_the_page_claims_of_rivals_is_so(self) -> None:
        text = (SOURCE / "docs" / "results" / "rivals.md").read_text()
        compared = [table for _, table in documents.tables(text)
                    if table[0][0] == "improver" and "bad" in table[0]]
        self.assertGreaterEqual(len(compared), 5)
        for table in compared:
            bad, surface = table[0].index("bad"), table[0].index("surface")
            own = [row for row in table[1:] if row[0].startswith("tetmend")]
            rival = int(pages.best_rival(table)[bad].replace(",", ""))
            for row in own:
                self.assertLess(int(row[bad].replace(",", "")), rival)
            for row in table[2:]:
                self.assertTrue(row[surface].startswith(("kept", "rounded ", *FAILED)), row)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
