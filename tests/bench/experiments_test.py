# SPDX-License-Identifier: MIT
"""The experiments on small meshes: results are complete, pictures well-formed.

experiments_test.py BUILD_FOLDER SOURCE_FOLDER
"""

import itertools
import json
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

BUILD, SOURCE = Path(sys.argv[1]), Path(sys.argv[2])


class Experiments(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.output = Path(folder.name)

    def run_experiment(self, name: str, *arguments: str) -> list[dict]:
        """@param arguments  meshes, then options"""
        program = str(SOURCE / "bench" / "experiments" / f"{name}.py")
        command = [sys.executable, "-B", program, *arguments, "-o", str(self.output)]
        meshes = list(itertools.takewhile(lambda word: not word.startswith("-"), arguments))
        subprocess.run([*command, "--build", str(BUILD)], check=True, capture_output=True)
        document = json.loads((self.output / f"{name}.json").read_text())
        self.assertIn("|", (self.output / f"{name}.md").read_text())
        self.assertEqual([mesh["mesh"] for mesh in document["meshes"]], meshes)
        return [mesh["rows"] for mesh in document["meshes"]]

    def curves(self, picture: str) -> int:
        root = ElementTree.parse(self.output / picture).getroot()
        return sum(element.tag.endswith("polyline") for element in root.iter())

    def test_table_2_has_all_schemes_and_each_leaves_fewer_bad_tets(self) -> None:
        [rows] = self.run_experiment("table2", "sheet")
        self.assertEqual(set(rows), {"grummp", "stellar", "shell_flat", "shell"})
        for row in rows.values():
            self.assertLess(row["after"]["n_bad"], row["before"]["n_bad"])
        self.assertLessEqual(rows["shell"]["after"]["n_bad"], rows["grummp"]["after"]["n_bad"])

    def test_figure_13_shows_what_a_folded_sheet_costs(self) -> None:
        [rows] = self.run_experiment("figure13", "folded_sheet")
        self.assertGreater(rows["respected"]["after"]["n_bad"], rows["ignored"]["after"]["n_bad"])
        self.assertEqual(self.curves("figures/figure13-folded_sheet.svg"), 3)

    def test_figure_12_has_a_curve_for_each_schedule(self) -> None:
        self.run_experiment("figure12", "folded_sheet", "two_materials")
        self.assertGreaterEqual(self.curves("figure12a-folded_sheet.svg"), 2)
        self.assertEqual(self.curves("figure12b.svg"), 3)

    def test_a_document_is_written_whole_with_its_pictures(self) -> None:
        file = self.output / "elsewhere" / "angles.md"
        self.run_experiment("figure12", "folded_sheet", "--write", str(file))
        text = file.read_text()
        self.assertIn("Command: `script/experiment figure12 folded_sheet`", text)
        pictures = re.findall(r"\]\((\S+\.svg)\)", text)
        self.assertEqual(len(pictures), 2)
        for picture in pictures:
            self.assertTrue((file.parent / picture).exists(), picture)

    def passes_of(self, schedule: str) -> list[str]:
        report = self.output / "report.json"
        mesh = SOURCE / "assets" / "meshes" / "folded_sheet.mesh"
        subprocess.run([BUILD / "bin" / "tetmend", "improve", mesh, "-o", self.output / "x.mesh",
                        "--quiet", "--schedule", schedule, "--report", report], check=True)
        return [record["name"] for record in json.loads(report.read_text())["passes"]]

    def test_an_ablation_makes_all_passes_but_those_that_it_leaves_out(self) -> None:
        [rows] = self.run_experiment("ablation", "folded_sheet")
        self.assertEqual(len(rows), 10)
        whole = self.passes_of("thorough")
        for word in ("local_reconnection", "smooth", "suppress_points", "insert_points", "cavity_insertion",
                     "polyhedron_reconnection", "sequence", "polish"):
            def is_left_out(made: str) -> bool:
                return made == word or made.startswith(word + "(")

            self.assertTrue(any(map(is_left_out, whole)), word)
            kept = self.passes_of(str(self.output / f"thorough-without-{word}.lua"))
            self.assertFalse(any(map(is_left_out, kept)), word)
            self.assertGreater(len(set(kept)), 1)
            self.assertNotEqual(rows[word]["after"], rows["nothing"]["after"], word)
        self.assertTrue(any("joint_smoothing" in made for made in whole))
        kept = self.passes_of(str(self.output / "thorough-without-joint_smoothing.lua"))
        self.assertFalse(any("joint_smoothing" in made for made in kept))

    def test_all_schedules_that_are_listed_are_compared(self) -> None:
        [rows] = self.run_experiment("schedules", "sheet")
        listing = subprocess.run([BUILD / "bin" / "tetmend", "schedules"], check=True,
                                 capture_output=True, text=True).stdout
        for name in rows:
            self.assertIn(f"{name}", listing)
        self.assertGreaterEqual(len(rows), 4)
        for row in rows.values():
            self.assertLess(row["after"]["n_bad"], row["before"]["n_bad"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
