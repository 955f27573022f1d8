# SPDX-License-Identifier: MIT
"""The command line as people meet it: short help, ten lines, many files, dry runs, a folder's options, colours.

usage: command_line_test.py PROGRAM SOURCE_FOLDER
"""

import json
import os
import pty
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv[1]).resolve()
MESHES = Path(sys.argv[2]).resolve() / "assets" / "meshes"
SHEET = MESHES / "sheet.mesh"
TWO = MESHES / "two_materials.mesh"


class CommandLine(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_program(self, *words: str | Path, env: dict[str, str] | None = None) -> subprocess.CompletedProcess:
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=self.folder,
                              env=None if env is None else {**os.environ, **env})

    def on_terminal(self, *words: str | Path, **env: str) -> str:
        """What both streams say to a terminal."""
        main, side = pty.openpty()
        process = subprocess.Popen([PROGRAM, *map(str, words)], stdout=side, stderr=side, cwd=self.folder,
                                   env={**os.environ, "TERM": "xterm", "NO_COLOR": "", **env})
        os.close(side)
        said = b""
        try:
            while part := os.read(main, 4096):
                said += part
        except OSError:  # the other side is closed
            pass
        os.close(main)
        process.wait()
        return said.decode()

    # --- help

    def test_short_help_is_one_screen_and_long_help_has_all(self) -> None:
        short = self.run_program("improve", "-h").stdout
        long = self.run_program("improve", "--help").stdout
        self.assertLessEqual(len(short.splitlines()), 48)
        self.assertIn("Examples:", short)
        self.assertIn("tetmend improve --help", short)
        self.assertIn("--goal", short)
        self.assertNotIn("--trace-depth", short)
        self.assertIn("--trace-depth", long)
        self.assertEqual(self.run_program("help", "improve").stdout, long)

    def test_usual_options_come_first_and_no_line_is_long(self) -> None:
        long = self.run_program("improve", "--help").stdout
        heads = re.findall(r"^(\S.*):$", long, re.M)
        self.assertEqual(heads[:4], ["Arguments", "Options", "How much may change", "How it is searched"])
        usual = long.partition("Options:\n")[2].partition("\n\n")[0]
        self.assertEqual(re.findall(r"^ {2}(?:-\w,)?--([a-z-]+)", usual, re.M)[:4], ["output", "schedule", "goal", "for"])
        for command in ("improve", "adapt", "convert", "trace", "pieces"):
            for line in self.run_program(command, "--help").stdout.splitlines():
                self.assertLessEqual(len(line), 80, f"{command}: {line}")

    def test_no_phrase_of_the_parser_is_left(self) -> None:
        said = self.run_program("trace", "--help").stdout
        self.assertNotIn("[Option Group", said)
        for words, expected in [(["improve"], "IN is missing"),
                                (["improve", SHEET, "-o"], "--output: OUT is missing"),
                                (["improve", SHEET, "-o", "a.mesh", "-o", "b.mesh"], "--output is given twice"),
                                (["quality", SHEET, "--list", "x"], "'x' is not a whole number from 1 to 1000000000"),
                                (["check", SHEET, "--min-dihedral", "99"], "'99' is not a number from 0 to 71")]:
            done = self.run_program(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(expected, done.stderr)

    def test_a_mistyped_value_is_told_with_what_was_meant(self) -> None:
        for words, meant in [(["improve", SHEET, "-o", "o.mesh", "--schedule", "thorogh"], "thorough"),
                             (["improve", SHEET, "-o", "o.mesh", "--for", "explict"], "explicit"),
                             (["improve", SHEET, "-o", "o.mesh", "--set", "max_round=3"], "max_rounds"),
                             (["improve", SHEET, "-o", "o.mehs"], ".mesh"),
                             (["schedules", "polsh"], "polish"),
                             (["operators", "edge_slit"], "edge_split"),
                             (["check", SHEET, "--for", "openfaom"], "openfoam"),
                             (["quality", SHEET, "--measure", "radius_rato"], "radius_ratio"),
                             (["convert", SHEET, "o.msh", "--variant", "4.1ASCII"], "4.1 ASCII")]:
            done = self.run_program(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(f"did you mean '{meant}'?", done.stderr)

    # --- what improve prints

    def test_improve_prints_ten_lines_and_with_v_the_tables(self) -> None:
        few = self.run_program("improve", TWO, "-o", "a.mesh").stdout
        self.assertLessEqual(len(few.splitlines()), 14)
        for words in ("theta_min", "bad tets", "untouched", "exact arithmetic", "-v"):
            self.assertIn(words, few)
        all_of_it = self.run_program("improve", TWO, "-o", "b.mesh", "--verbose").stdout
        self.assertIn("lambda_5", all_of_it)
        self.assertIn("peak memory", all_of_it)
        self.assertEqual((self.folder / "a.mesh").read_bytes(), (self.folder / "b.mesh").read_bytes())

    def test_quality_goes_by_the_goal_that_is_asked_for(self) -> None:
        found = json.loads(self.run_program("quality", SHEET, "--json", "--goal", "10").stdout)
        self.assertEqual(found["goal"], {"min_angle": 10, "max_angle": 170})
        self.assertLess(found["n_bad"], json.loads(self.run_program("quality", SHEET, "--json").stdout)["n_bad"])
        self.assertIn("below 10 or above 170 degrees", self.run_program("quality", SHEET, "--goal", "10").stdout)
        wrong = self.run_program("quality", SHEET, "--goal", "80,90")
        self.assertEqual((wrong.returncode, "is no goal" in wrong.stderr), (2, True))

    def test_check_goes_by_the_goal_of_the_run(self) -> None:
        self.run_program("improve", SHEET, "-o", "o.mesh", "--goal", "10,170", "-q")
        facts = [json.loads(self.run_program("check", "o.mesh", SHEET, "--json", *goal).stdout)["facts"]
                 for goal in ([], ["--goal", "10,170"])]
        counts = [next(fact for fact in each if fact["name"] == "n_bad") for each in facts]
        self.assertEqual(counts[1]["wanted"], 0)
        self.assertLess(counts[1]["value"], counts[0]["value"])
        self.assertEqual(self.run_program("check", SHEET, "o.mesh", "--goal", "10,170").returncode, 0)
        self.assertEqual(self.run_program("check", SHEET, "o.mesh", "--goal", "x").returncode, 2)

    def test_convert_makes_the_folder_and_can_be_silent(self) -> None:
        done = self.run_program("convert", SHEET, TWO, "--to", "vtu", "--into", "a/b", "-q")
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertEqual(sorted(file.name for file in (self.folder / "a/b").iterdir()), ["sheet.vtu", "two_materials.vtu"])

    def test_a_dry_run_writes_nothing_and_says_what_would_be_kept(self) -> None:
        done = self.run_program("improve", TWO, "-o", "a.mesh", "--dry-run", "--protect", "label:1", "--trace", "t.trace")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(list(self.folder.iterdir()), [])
        tets = json.loads(self.run_program("quality", TWO, "--json").stdout)["tets"]
        self.assertIn(f"{tets:,}", done.stdout)
        self.assertIn("tets protected", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^regions +2$")
        self.assertIn("nothing is written", done.stdout)
        self.assertEqual(self.run_program("improve", TWO, "--dry-run", "--protect", "label:1").stdout, done.stdout)
        self.assertEqual(self.run_program("improve", TWO).returncode, 2)
        self.run_program("convert", TWO, "two.vtu", "-q")
        self.assertRegex(self.run_program("improve", "two.vtu", "--dry-run").stdout, r"(?m)^regions +2, by the array '[^']+'$")
        (self.folder / "two.vtu").unlink()
        own = self.folder / "own.mesh"
        own.write_bytes(Path(TWO).read_bytes())
        for words in (["-o", ""], ["-o", "", "--memory", "1G"], ["--dry-run=false"]):
            self.assertEqual(self.run_program("improve", own, *words).returncode, 2, words)
            self.assertEqual(own.read_bytes(), Path(TWO).read_bytes(), words)
        own.unlink()
        wrong = self.run_program("improve", TWO, "-o", "a.mesh", "--dry-run", "--memory", "1G")
        self.assertEqual(wrong.returncode, 2)

    def test_a_folder_in_place_of_a_file_is_called_one(self) -> None:
        done = self.run_program("improve", TWO, "-o", self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is a folder: expected a file, one of .mesh", done.stderr)

    def test_a_mistyped_subcommand_is_told_before_its_options(self) -> None:
        done = self.run_program("imrpove", TWO, "-o", "a.mesh")
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'improve'?", done.stderr)

    # --- many files

    def test_check_of_many_says_a_line_each_and_has_the_status_of_the_worst(self) -> None:
        ask = ["--min-dihedral", "0.1", "--no-inverted"]
        good = self.run_program("check", "--each", SHEET, TWO, *ask)
        self.assertEqual(good.returncode, 0, good.stdout)
        self.assertEqual(len(good.stdout.splitlines()), 3)
        self.assertIn("2 of 2 hold", good.stdout)
        ask[1] = "60"
        bad = self.run_program("check", SHEET, TWO, SHEET, *ask)
        self.assertEqual(bad.returncode, 3)
        self.assertIn("0 of 3 hold; the worst: ", bad.stdout)
        lines = self.run_program("check", SHEET, TWO, SHEET, *ask, "--json").stdout.splitlines()
        self.assertEqual([json.loads(line)["holds"] for line in lines], [False] * 3)
        some = self.run_program("check", SHEET, "none.mesh", TWO, "--no-inverted")
        self.assertEqual(some.returncode, 1)
        self.assertIn("none.mesh", some.stderr)
        self.assertIn("2 of 3 hold", some.stdout)
        self.assertEqual(self.run_program("check", SHEET, TWO, SHEET).returncode, 2)

    def test_convert_of_many_writes_each_and_names_what_it_could_not_read(self) -> None:
        (self.folder / "to").mkdir()
        done = self.run_program("convert", SHEET, TWO, MESHES / "folded_sheet.mesh", "--to", "vtu", "--into", "to")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(file.name for file in (self.folder / "to").iterdir()),
                         ["folded_sheet.vtu", "sheet.vtu", "two_materials.vtu"])
        self.assertEqual(len(done.stdout.splitlines()), 4)
        self.run_program("convert", SHEET, "alone.vtu")
        self.assertEqual((self.folder / "to" / "sheet.vtu").read_bytes(), (self.folder / "alone.vtu").read_bytes())
        for file in (SHEET, TWO):
            shutil.copy(file, self.folder)
        some = self.run_program("convert", "sheet.mesh", "none.mesh", "two_materials.mesh", "--to", "msh", "--json")
        self.assertEqual(some.returncode, 1)
        self.assertEqual([json.loads(line)["output"] for line in some.stdout.splitlines()], ["sheet.msh", "two_materials.msh"])
        made = (self.folder / "sheet.msh").read_bytes()
        for words in (["sheet.mesh"], ["a.mesh", "b.msh", "c.vtu"], ["sheet.mesh", "a.msh", "--into", "to"],
                      ["sheet.mesh", "sheet.msh", "--to", "vtu"], ["sheet.mesh", "./sheet.msh", "--to", "vtu"],
                      ["sheet.mesh", "./sheet.msh", "--to", "msh"], ["sheet.mesh", "--to", "mesh"],
                      ["sheet.mesh", "--to", "msh", "--variant", "none"], ["-", "sheet.mesh", "--to", "msh"]):
            self.assertEqual(self.run_program("convert", *words).returncode, 2, words)
            self.assertEqual((self.folder / "sheet.msh").read_bytes(), made, words)
        self.assertEqual((self.folder / "sheet.mesh").read_bytes(), SHEET.read_bytes())

    # --- a folder's options

    def test_a_file_of_the_folder_holds_options_and_the_command_line_prevails(self) -> None:
        (self.folder / "tetmend.conf").write_text('# ours\ngoal = 20\nkeep-size = true\nschedule = "conservative"\n')
        report = self.folder / "r.json"

        def said(*more: str) -> tuple[str, dict]:
            done = self.run_program("improve", TWO, "-o", "o.mesh", "--report", report, *more)
            self.assertIn(done.returncode, (0, 3), done.stderr)
            return done.stderr, json.loads(report.read_text())

        told, found = said()
        self.assertIn("tetmend.conf says --goal=20 --keep-size --schedule=conservative\n", told)
        self.assertEqual((found["goal"]["min_angle"], found["schedule"]), (20, "conservative"))
        told, found = said("--goal", "25")
        self.assertEqual((found["goal"]["min_angle"], found["schedule"]), (25, "conservative"))
        told, found = said("--no-config")
        self.assertEqual((told, found["goal"]["min_angle"], found["schedule"]), ("", 30, "shell"))
        self.assertEqual(self.run_program("quality", TWO).stderr, "")

    def test_a_file_with_options_of_the_folder_is_no_output(self) -> None:
        options = self.folder / "tetmend.conf"
        options.write_text("goal = 20\n")
        for words in [("--trace", "tetmend.conf"), ("--goal", "25", "--trace", "./tetmend.conf")]:
            done = self.run_program("improve", TWO, "-o", "o.mesh", *words)
            self.assertEqual((done.returncode, options.read_text()), (2, "goal = 20\n"))
            self.assertIn("options of the folder and --trace would be the same file", done.stderr)
        done = self.run_program("improve", TWO, "-o", "o.mesh", "--no-config", "--trace", "tetmend.conf")
        self.assertEqual((done.returncode, options.read_bytes()[:7]), (0, b"TETTRAC"))

    def test_tasks_end_with_the_status_of_a_run_in_pieces(self) -> None:
        for goal, status in [(("--goal", "40,130"), 3), (("--goal", "1,179"), 0), ((), 0)]:
            with self.subTest(goal=goal):
                done = self.run_program("improve", TWO, "-o", "a.mesh", "--pieces", "2", "-q", *goal)
                self.assertEqual(done.returncode, status)
                work = self.folder / f"work{len(goal)}{status}"
                self.run_program("pieces", "split", work, TWO, "-o", "b.mesh", "--pieces", "2", "-q", *goal)
                joined = done
                while not json.loads((work / "plan.json").read_text())["finished"]:
                    self.assertEqual(self.run_program("pieces", "improve", work, "-q").returncode, 0)
                    joined = self.run_program("pieces", "join", work, "-q")
                self.assertEqual((joined.returncode, joined.stderr), (done.returncode, done.stderr))
                self.assertEqual((self.folder / "a.mesh").read_bytes(), (self.folder / "b.mesh").read_bytes())

    def test_a_wrong_line_of_the_folder_is_told_with_its_place(self) -> None:
        for text, reason in [("gaol = 20", "tetmend.conf:1: improve has no option 'gaol': did you mean 'goal'?"),
                             ("\ngoal 20", "tetmend.conf:2: 'goal 20' is not of the form NAME = VALUE"),
                             ("plugin = evil.so", "tetmend.conf:1: 'plugin' stands on the command line alone"),
                             ("keep-size = yes", "tetmend.conf:1: keep-size: 'yes' is neither true nor false"),
                             ("goal = x", "tetmend.conf:1: --goal: 'x' is not of the form MIN or MIN,MAX"),
                             ("\ngoal =", "tetmend.conf:2: goal: the value is missing"),
                             ("surface = 5%", "tetmend.conf:1: 'surface' stands on the command line alone")]:
            (self.folder / "tetmend.conf").write_text(text)
            done = self.run_program("improve", TWO, "-o", "o.mesh")
            self.assertEqual(done.returncode, 2)
            self.assertIn(reason, done.stderr)
            self.assertFalse((self.folder / "o.mesh").exists())

    def test_a_folder_adds_only_what_the_command_line_leaves_open(self) -> None:
        def used(conf: bytes, *words: str) -> dict:
            (self.folder / "tetmend.conf").write_bytes(conf)
            done = self.run_program("improve", TWO, "-o", "o.mesh", "--report", "r.json", *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads((self.folder / "r.json").read_text())

        plain = used(b"", "--purpose", "implicit")["settings"]
        self.assertEqual(used(b"for = explicit\n", "--purpose", "implicit")["settings"], plain)
        used(b"feature-angle = 30\n")  # of --surface, which is not there
        used(b"size = 0.5x\n")  # of adapt
        self.assertEqual(used(b"\xef\xbb\xbfgoal = 20\r\n")["goal"]["min_angle"], 20)
        (self.folder / "a#b.lua").write_text('description "none"\n')
        self.assertEqual(used(b"schedule = \"a#b.lua\" # ours\n")["passes"], [])
        (self.folder / "tetmend.conf").write_text("size = 0.9x\nkeep-size = true\n")
        self.assertEqual(self.run_program("adapt", TWO, "-o", "o.mesh", "-q").returncode, 0)
        self.assertEqual(self.run_program("help", "improve").returncode, 0)
        (self.folder / "tetmend.conf").unlink()
        (self.folder / "tetmend.conf").mkdir()
        done = self.run_program("improve", TWO, "-o", "o.mesh")
        self.assertIn("tetmend.conf: it cannot be read", done.stderr)
        self.assertEqual(done.returncode, 1)

    # --- colours

    def test_colours_are_for_terminals_alone_and_can_be_switched_off(self) -> None:
        words = ["check", TWO, "--min-dihedral", "60", "--no-inverted"]
        self.assertIn("\x1b[31mFAIL\x1b[0m", self.on_terminal(*words))
        self.assertIn("\x1b[32mok\x1b[0m", self.on_terminal(*words))
        self.assertNotIn("\x1b", self.on_terminal(*words, NO_COLOR="1"))
        self.assertNotIn("\x1b", self.on_terminal(*words, TERM="dumb"))
        self.assertNotIn("\x1b", self.run_program(*words, env={"TERM": "xterm", "NO_COLOR": ""}).stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
