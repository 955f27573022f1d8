# SPDX-License-Identifier: MIT
"""Reports as pages, opened in headless Chromium and compared with the JSON of the same run.

    page_test.py SOURCE TETMEND WORK     WORK: a folder that this test may empty

Exit status 77: Chromium is not installed.
"""

import json
import random
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE, TETMEND, WORK = (Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(SOURCE / "tests" / "docs"))
import browser  # noqa: E402

SKIPPED = 77
MESHES = SOURCE / "assets" / "meshes"
# What Chromium says of its own stand-in for a graphics card.
OF_THE_BROWSER = re.compile(r"software WebGL has been deprecated|GL Driver Message \(OpenGL, Performance")
MOST_BYTES = 1_000_000

PAINTED = """
const small = Object.assign(document.createElement("canvas"), {width: 192, height: 96}).getContext("2d");
small.drawImage(document.getElementById("canvas"), 0, 0, 192, 96);
const pixels = small.getImageData(0, 0, 192, 96).data;
const halves = [0, 1].map(() => ({painted: 0, red: 0}));
for (let i = 0; i < pixels.length; i += 4) {
  const half = halves[(i / 4) % 192 < 96 ? 0 : 1];
  if (pixels[i + 3] > 0) ++half.painted;
  if (pixels[i + 3] > 0 && pixels[i] > 1.6 * pixels[i + 1] && pixels[i] > 1.6 * pixels[i + 2]) ++half.red;
}
return halves;
"""
CUT_OFF = """
const bad = [];
if (document.documentElement.scrollWidth > innerWidth + 1) bad.push(`page ${document.documentElement.scrollWidth} of ${innerWidth}`);
for (const e of document.querySelectorAll("body *")) {
  if (!e.getClientRects().length || e.closest("svg") || !e.clientWidth) continue;
  if (e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).display !== "inline") bad.push(`${e.tagName}#${e.id}.${e.className}: ${e.scrollWidth} of ${e.clientWidth}`);
  const r = e.getBoundingClientRect();
  if (r.right > innerWidth + 1 || r.left < -1) bad.push(`${e.tagName}#${e.id}.${e.className} from ${r.left} to ${r.right}`);
}
return bad;
"""
FACTS = """
const texts = (selector) => [...document.querySelectorAll(selector)].map((e) => e.textContent);
return {
  shown: [...document.querySelectorAll("data")].map((e) => [e.dataset.of, e.getAttribute("value"), e.textContent, e.getClientRects().length > 0]),
  verdict: texts("#verdict")[0], outcome: document.getElementById("verdict").className,
  promises: [...document.querySelectorAll("table.promises tbody tr")].map((e) => e.className),
  histograms: Object.fromEntries([...document.querySelectorAll("[data-histogram]")].map((e) => [e.dataset.histogram,
    [...e.querySelectorAll(".bin")].map((b) => [Number(b.dataset.bin), b.dataset.tip])])),
  passes: [...document.querySelectorAll("table.passes tbody tr")].map((e) => [e.dataset.pass, Object.fromEntries([...e.querySelectorAll("[data-sum]")].map((td) => [td.dataset.sum, td.textContent]))]),
  progress: [...document.querySelectorAll("svg.progress .bin")].map((e) => e.dataset.tip),
  worst: [...document.querySelectorAll(".worst li")].map((e) => [e.querySelector("h3").textContent, e.querySelector("svg.tet") !== null, e.querySelector(".reason").textContent]),
  names: texts(".view-name"), command: texts("#command")[0], leftOut: texts("#left-out")[0],
  ready: document.body.dataset.ready, about: JSON.parse(document.getElementById("shape-about").textContent),
};
"""


def lattice(file: Path, cells: tuple[int, int, int], jitter: float = 0.0) -> None:
    """A block of cubes of six tets each; inner vertices are moved."""
    chance = random.Random(7)
    nx, ny, nz = (n + 1 for n in cells)
    lines = ["MeshVersionFormatted 2", "Dimension 3", f"Vertices {nx * ny * nz}"]
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                inner = 0 < i < nx - 1 and 0 < j < ny - 1 and 0 < k < nz - 1
                x, y, z = ((n + (chance.uniform(-jitter, jitter) if inner else 0)) for n in (i, j, k))
                lines.append(f"{x:.6g} {y:.6g} {z:.6g} 0")
    steps = [1, nx, nx * ny]
    paths = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]
    tets = []
    for k in range(nz - 1):
        for j in range(ny - 1):
            for i in range(nx - 1):
                first = 1 + i + nx * (j + ny * k)
                for n, (a, b, c) in enumerate(paths):
                    corners = [first, first + steps[a], first + steps[a] + steps[b], first + sum(steps)]
                    if n in (1, 2, 5):
                        corners[1], corners[2] = corners[2], corners[1]
                    tets.append("{} {} {} {} 1".format(*corners))
    file.write_text("\n".join([*lines, f"Tetrahedra {len(tets)}", *tets, "End", ""]))


def number(text: str) -> float:
    return float(text.replace(",", "").replace("\u2212", "-"))


def precision(text: str) -> float:
    """Half a unit of the last digit, and a little."""
    digits, _, exponent = text.partition("e")
    decimals = len(digits.partition(".")[2])
    return 0.501 * 10 ** (int(exponent or 0) - decimals)


def at(report: dict, path: str) -> object:
    for name in path.split("."):
        report = report[int(name)] if isinstance(report, list) else report[name]
    return report


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.desk = browser.Browser(1280, 800)
        cls.desk.command("Emulation.setDeviceMetricsOverride", width=1280, height=800, deviceScaleFactor=1, mobile=False)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.desk.close()

    def improve(self, mesh: Path, *options: object, status: int = 0) -> tuple[Path, dict]:
        """Page and JSON of one run."""
        page, figures = WORK / "report.html", WORK / "report.json"
        done = subprocess.run([str(word) for word in (TETMEND, "improve", mesh, "-o", WORK / "out.mesh", "-q", "--report", page, "--report", figures, *options)],
                              capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stderr)
        return page, json.loads(figures.read_text())

    def open(self, window: browser.Browser, page: Path) -> dict:
        window.complaints()
        window.requests()
        window.open(page.as_uri())
        self.assertEqual(window.wait_for("return document.body.dataset.ready"), "yes")
        self.assertEqual([line for line in window.complaints() if not OF_THE_BROWSER.search(line)], [])
        self.assertEqual([url for url in window.requests() if not url.startswith(("file:", "data:", "blob:", "chrome"))], [])
        self.assertLess(page.stat().st_size, MOST_BYTES)
        return window.run(FACTS)

    def compare(self, facts: dict, report: dict) -> None:
        """Everything that is to be seen is what the JSON says."""
        self.assertGreater(len(facts["shown"]), 60)
        for path, exact, text, is_seen in facts["shown"]:
            value = at(report, path)
            self.assertEqual(json.loads(exact), value, path)
            self.assertTrue(is_seen, path)
            if value is None:
                self.assertIn(text, ("not finite", "unknown"), path)
            elif isinstance(value, str):
                self.assertEqual(text, value, path)
            elif isinstance(value, int):
                self.assertEqual(number(text), value, path)
            else:
                self.assertAlmostEqual(number(text), value, delta=precision(text), msg=path)
                self.assertEqual(number(text) == 0, value == 0, path)
        self.compare_histograms(facts["histograms"], report)
        self.compare_passes(facts, report)
        self.assertEqual(facts["names"], [f"{when}: {report[when]['n_bad']:,} bad tet{'' if report[when]['n_bad'] == 1 else 's'}" for when in ("before", "after")])
        self.assertEqual(set(facts["promises"]), {"kept"})
        self.assertEqual(facts["about"]["all_bad_after"], report["after"]["n_bad"])
        self.assertEqual(facts["about"]["all_bad_before"], report["before"]["n_bad"])
        self.assertEqual(facts["about"]["all_triangles"], report["after"]["boundary_triangles"])
        self.assertEqual([reason for _, _, reason in facts["worst"]], [tet["reason"] for tet in report["worst_tets"]])
        self.assertEqual(len(facts["worst"]), min(12, report["after"]["n_bad"]))
        self.assertTrue(all(has_picture for _, has_picture, _ in facts["worst"]))
        for word in report["arguments"]:
            self.assertIn(word, facts["command"])

    def compare_histograms(self, shown: dict, report: dict) -> None:
        angles = {name: report[name]["histogram"] for name in ("before", "after")}
        counts = {"angles": angles, **report["histograms"]}
        self.assertEqual(set(shown), set(counts))
        for name, bins in shown.items():
            seen = {number: [int(n.replace(",", "")) for n in re.search(r": ([\d,]+) \w+ before, ([\d,]+) after$", tip).groups()] for number, tip in bins}
            for i, pair in enumerate(zip(counts[name]["before"], counts[name]["after"], strict=True)):
                self.assertEqual(seen.get(i, [0, 0]), list(pair), f"{name}, bin {i}")
        for when in ("before", "after"):
            self.assertEqual(sum(report["histograms"]["mean_ratio"][when]), report[when]["tets"])
            self.assertEqual(sum(report["histograms"]["non_orthogonality"][when]), report[when]["rulers"]["inner_faces"])

    def compare_passes(self, facts: dict, report: dict) -> None:
        names = list(dict.fromkeys(each["name"] for each in report["passes"]))
        self.assertEqual([name for name, _ in facts["passes"]], names)
        bad = report["before"]["n_bad"] - report["protected"]["bad_tets"] - report["layers"]["bad_tets"]
        gone = dict.fromkeys(names, 0)
        for each, tip in zip(report["passes"], facts["progress"], strict=True):
            gone[each["name"]] += bad - each["n_bad"]
            self.assertIn(f"{each['attempts']:,} tried, {each['accepted']:,} kept; bad tets {bad:,} to {each['n_bad']:,};", tip)
            bad = each["n_bad"]
        for name, sums in facts["passes"]:
            own = [each for each in report["passes"] if each["name"] == name]
            self.assertEqual(number(sums["calls"]), len(own))
            self.assertEqual(number(sums["attempts"]), sum(each["attempts"] for each in own))
            self.assertEqual(number(sums["accepted"]), sum(each["accepted"] for each in own))
            self.assertEqual(number(sums["gone"]), gone[name])
            self.assertAlmostEqual(number(sums["seconds"]), sum(each["seconds"] for each in own), delta=0.002)

    def test_values_are_those_of_the_json_and_bad_tets_are_red(self) -> None:
        page, report = self.improve(MESHES / "bracket.meshb")
        facts = self.open(self.desk, page)
        self.compare(facts, report)
        self.assertIn("verdict reached", facts["outcome"])
        before, after = self.desk.run(PAINTED)
        self.assertGreater(before["painted"], 500)
        self.assertGreater(after["painted"], 500)
        self.assertGreater(before["red"], 50)
        self.assertEqual(after["red"], 0)
        self.assertEqual(self.desk.run(CUT_OFF), [])

    def test_a_goal_that_is_missed_has_reasons(self) -> None:
        page, report = self.improve(MESHES / "two_materials.mesh", "--goal", "44,130", status=3)
        facts = self.open(self.desk, page)
        self.compare(facts, report)
        self.assertGreater(report["after"]["n_bad"], 12)
        self.assertIn("verdict missed", facts["outcome"])
        self.assertGreater(self.desk.run(PAINTED)[1]["red"], 20)
        # Show: the camera goes to the tet, which is red in the middle.
        self.desk.run("document.querySelectorAll('button.show')[3].click()")
        target = self.desk.run("drawPicture(); const t = document.getElementById('target-after').getBoundingClientRect(), s = stage.getBoundingClientRect();"
                               "return [t.x + t.width / 2 - s.x - 0.75 * s.width, t.y + t.height / 2 - s.y - s.height / 2];")
        self.assertLess(max(abs(x) for x in target), 4)
        self.assertGreater(self.desk.run(PAINTED)[1]["red"], 200)

    def test_the_worst_tets_are_those_that_quality_lists(self) -> None:
        page, report = self.improve(MESHES / "bracket.meshb", "--schedule", "table2")
        facts = self.open(self.desk, page)
        self.compare(facts, report)
        done = subprocess.run([TETMEND, "quality", WORK / "out.mesh", "--limit", "--list", "12", "--json"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        listed = json.loads(done.stdout)["bad_tets"]
        self.assertEqual(len(listed), 12)
        self.assertEqual([title for title, _, _ in facts["worst"]], [f"Tet {tet['tet']}, region {tet['region']}" for tet in listed])
        for ours, theirs in zip(report["worst_tets"], listed, strict=True):
            self.assertEqual({name: ours[name] for name in ("tet", "region", "reason", "free_vertices")}, {name: theirs[name] for name in ("tet", "region", "reason", "free_vertices")})
            self.assertAlmostEqual(ours["theta_min"], theirs["theta_min"], places=6)

    def test_a_mesh_with_nothing_bad_and_a_run_of_no_pass(self) -> None:
        mesh = WORK / "good.mesh"
        lattice(mesh, (4, 3, 2))
        page, report = self.improve(mesh, "--goal", "20,160")
        facts = self.open(self.desk, page)
        self.compare(facts, report)
        self.assertEqual(report["before"]["n_bad"], 0)
        self.assertTrue(facts["verdict"].startswith("No tet missed the goal"), facts["verdict"])
        self.assertEqual(facts["worst"], [])

    def test_a_run_that_time_stops(self) -> None:
        script = WORK / "for_ever.lua"
        script.write_text("smooth{} while true do end\n")
        page, report = self.improve(MESHES / "sheet.mesh", "--schedule", script, "--time-limit", 0.3)
        facts = self.open(self.desk, page)
        self.compare(facts, report)
        self.assertTrue(facts["verdict"].startswith("The time limit stopped the run"), facts["verdict"])

    def test_the_picture_turns_is_cut_and_switched(self) -> None:
        page, _ = self.improve(MESHES / "sheet.mesh")
        self.open(self.desk, page)
        whole = self.desk.run(PAINTED)
        self.desk.run("camera.turn(0.8, 0.2); drawPicture();")
        self.assertNotEqual(self.desk.run(PAINTED), whole)
        self.desk.run("document.getElementById('whole').click(); drawPicture();")
        self.assertEqual(self.desk.run(PAINTED), whole)
        self.desk.run("const cut = document.getElementById('cut'); cut.value = 600; cut.dispatchEvent(new Event('input')); drawPicture();")
        self.assertLess(self.desk.run(PAINTED)[0]["painted"], 0.8 * whole[0]["painted"])
        for across in "xyz":
            self.desk.run("document.querySelector(`[data-across=${arguments[0]}]`).click(); drawPicture();", across)
            self.assertLess(self.desk.run(PAINTED)[0]["painted"], whole[0]["painted"], across)
        self.desk.run("document.getElementById('whole').click(); document.querySelector('[data-surface=solid]').click(); drawPicture();")
        self.assertLess(self.desk.run(PAINTED)[0]["red"], max(whole[0]["red"], 1))
        # A drag with Shift cuts, without it turns.
        self.desk.run("document.querySelector('[data-surface=clear]').click();")
        drag = ("const box = stage.getBoundingClientRect(); const fire = (type, x, y) => stage.dispatchEvent(new PointerEvent(type,"
                "{pointerId: 1, clientX: box.x + x, clientY: box.y + y, shiftKey: arguments[0], bubbles: true}));"
                "stage.setPointerCapture = () => {}; fire('pointerdown', 100, 100); fire('pointermove', 180, 260); fire('pointerup', 180, 260); drawPicture();"
                "return [look.cutAway, camera.towards];")
        away, towards = self.desk.run(drag, True)
        self.assertGreater(away, 0.2)
        again, turned = self.desk.run(drag, False)
        self.assertEqual(again, away)
        self.assertNotEqual(turned, towards)

    def test_the_surface_has_the_colours_of_its_regions(self) -> None:
        colours = """const small = Object.assign(document.createElement("canvas"), {width: 200, height: 100}).getContext("2d");
            small.drawImage(canvas, 0, 0, 200, 100);
            const pixels = small.getImageData(0, 0, 200, 100).data;
            const isNear = (i, colour) => { const p = [0, 1, 2].map((c) => pixels[i + c]); const light = Math.max(...p) / Math.max(...colour);
              return light > 0.65 && light < 1.05 && colour.every((c, n) => Math.abs(p[n] - c * light) < 6); };
            return shape.regions.map(({colour}) => { let n = 0; for (let i = 0; i < pixels.length; i += 4) n += pixels[i + 3] > 250 && isNear(i, colour); return n; });"""
        page, _ = self.improve(MESHES / "two_materials.mesh")
        self.open(self.desk, page)
        self.assertEqual([region["label"] for region in self.desk.run("return about.labels")], [1, 2])
        self.assertGreater(self.desk.run("return about.walls"), 100)
        # Cut open, for one region lies inside of the other.
        self.desk.run("document.querySelector('[data-surface=solid]').click(); document.querySelector('[data-across=view]').click(); drawPicture();")
        plain = self.desk.run(colours)
        self.desk.run("document.querySelector('[data-colour=label]').click(); drawPicture();")
        for count, before in zip(self.desk.run(colours), plain, strict=True):
            self.assertGreater(count, 200 + before)
        self.assertEqual(self.desk.run("return [...document.querySelectorAll('#labels li')].map((li) => li.textContent)"), ["region 1", "region 2"])
        self.assertEqual(self.desk.run(CUT_OFF), [])
        page, _ = self.improve(MESHES / "bracket.meshb")
        self.open(self.desk, page)
        self.assertEqual(self.desk.run("return [about.labels.length, document.getElementById('choose-colour').hidden]"), [1, True])

    def test_scales_and_tips_of_histograms(self) -> None:
        page, _ = self.improve(MESHES / "sheet.mesh")
        self.open(self.desk, page)
        seen = "return ['log', 'even'].map((s) => document.querySelector(`.scale-${s} path`).getClientRects().length > 0);"
        self.assertEqual(self.desk.run(seen), [True, False])
        self.desk.run("document.querySelector('button[data-scale=even]').click()")
        self.assertEqual(self.desk.run(seen), [False, True])
        tip = self.desk.run("const bin = document.querySelector('[data-histogram=angles] [data-bin=\"14\"]');"
                            "bin.dispatchEvent(new PointerEvent('pointermove', {clientX: 300, clientY: 300, bubbles: true}));"
                            "const tip = document.getElementById('tip'); return [tip.hidden, tip.textContent];")
        self.assertEqual(tip[0], False)
        self.assertRegex(tip[1], r"^70 to 75: [\d,]+ angles before, [\d,]+ after$")

    def test_phone_and_dark_and_large_screen(self) -> None:
        page, report = self.improve(MESHES / "two_materials.mesh", "--goal", "44,130", status=3)
        for width, height, dark in ((390, 844, False), (390, 844, True), (1920, 1080, True)):
            with self.subTest(width=width, dark=dark):
                window = browser.Browser(width, height, dark)
                try:
                    facts = self.open(window, page)
                    self.assertEqual(window.run("return innerWidth"), width)
                    self.assertEqual(window.run(CUT_OFF), [])
                    self.assertEqual(window.run("return document.documentElement.dataset.theme"), "dark" if dark else "light")
                    self.assertGreater(sum(half["painted"] for half in window.run(PAINTED)), 500)
                    if width < 640:  # one mesh at a time
                        after = sum(half["red"] for half in window.run(PAINTED))
                        window.run("document.querySelector('[data-view=before]').click(); drawPicture();")
                        self.assertGreater(sum(half["red"] for half in window.run(PAINTED)), after)
                    self.assertEqual(facts["about"]["all_bad_after"], report["after"]["n_bad"])
                finally:
                    window.close()

    def test_paper(self) -> None:
        page, _ = self.improve(MESHES / "sheet.mesh")
        self.open(self.desk, page)
        paper = self.desk.printed()
        self.assertTrue(paper.startswith(b"%PDF"))
        self.assertGreater(len(paper), 30_000)
        if not shutil.which("pdftotext"):
            return
        (WORK / "report.pdf").write_bytes(paper)
        text = subprocess.run(["pdftotext", "-layout", WORK / "report.pdf", "-"], capture_output=True, text=True, timeout=60).stdout
        for heading in ("Before and after", "What was promised", "All measures", "Quality over time", "How to repeat the run"):
            self.assertIn(heading, text)

    def test_a_hundred_thousand_triangles_are_all_there_in_less_than_a_megabyte(self) -> None:
        mesh = WORK / "large.mesh"
        lattice(mesh, (160, 150, 2), 0.25)
        page, report = self.improve(mesh, "--time-limit", 0.5)
        self.assertGreater(report["after"]["boundary_triangles"], 95_000)
        facts = self.open(self.desk, page)
        self.compare(facts, report)
        self.assertEqual(facts["about"]["triangles"], report["after"]["boundary_triangles"])

    def test_above_that_edges_and_bad_tets_are_left_and_that_is_said(self) -> None:
        mesh = WORK / "larger.mesh"
        lattice(mesh, (230, 115, 1))
        page, report = self.improve(mesh, "--time-limit", 0.2)
        triangles = report["after"]["boundary_triangles"]
        self.assertGreater(triangles, 100_000)
        facts = self.open(self.desk, page)
        self.assertEqual(facts["about"]["triangles"], 0)
        self.assertGreater(facts["about"]["edges"], 500)
        self.assertIn(f"The surface has {triangles:,} triangles, too many for a page", facts["leftOut"])
        self.assertGreater(sum(half["painted"] for half in self.desk.run(PAINTED)), 100)

    def test_a_report_has_one_of_three_endings_and_is_no_other_output(self) -> None:
        mesh = MESHES / "sheet.mesh"
        for reports, message in (([WORK / "a.txt"], "expected one of .json, .html, .htm"), ([WORK / "a.html", WORK / "a.html"], "would be the same file")):
            words = [word for report in reports for word in ("--report", report)]
            done = subprocess.run([TETMEND, "improve", mesh, "-o", WORK / "b.mesh", *words], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)
            self.assertFalse((WORK / "b.mesh").exists())
        done = subprocess.run([TETMEND, "improve", mesh, "-o", WORK / "b.mesh", "-q", "--report", WORK / "a.HTM"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((WORK / "a.HTM").read_text().startswith("<!DOCTYPE html>"))


if __name__ == "__main__":
    if not browser.is_installed():
        print("Chromium is not installed: reports were not opened")
        sys.exit(SKIPPED)
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
