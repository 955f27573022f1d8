# SPDX-License-Identifier: MIT
"""Pages of lessons and of calls, walked step by step in headless Chromium and compared with the viewer.

    pages_test.py SOURCE TETMEND VIEWER WORK     VIEWER: tetmend-view, or "none"; WORK: a folder that this test may empty

Exit status 77: Chromium is not installed.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

SOURCE, TETMEND = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
VIEWER = None if sys.argv[3] == "none" else Path(sys.argv[3]).resolve()
WORK = Path(sys.argv[4]).resolve()
sys.path.insert(0, str(SOURCE / "tests" / "docs"))
import browser  # noqa: E402

SKIPPED = 77
LESSONS = SOURCE / "assets" / "lessons"
LECTURES = SOURCE / "docs" / "lectures"
NAMES = sorted(file.stem for file in LESSONS.glob("*.json"))
ENVIRONMENT = dict(os.environ, TETMEND_LESSONS=str(LESSONS))
HOSTILE = "<img src=x onerror=\"document.title='owned'\"><script>"  # no slash: names of files
# What Chromium says of its own stand-in for a graphics card.
OF_THE_BROWSER = re.compile(r"software WebGL has been deprecated|GL Driver Message \(OpenGL, Performance")

# Goes to a step, and to every cell of the tables there; says what is to be seen.
WALK = """
const n = arguments[0];
const texts = (selector) => [...document.querySelectorAll(selector)].map((e) => e.textContent);
const isSeen = (e) => e.getClientRects().length > 0;
const painted = () => {
  const small = Object.assign(document.createElement("canvas"), {width: 96, height: 96}).getContext("2d");
  small.drawImage(document.getElementById("canvas"), 0, 0, 96, 96);
  const pixels = small.getImageData(0, 0, 96, 96).data;
  let count = 0;
  for (let i = 3; i < pixels.length; i += 4) if (pixels[i] > 0) ++count;
  return count / (96 * 96);
};
const cutOff = () => {
  const bad = [];
  if (document.documentElement.scrollWidth > innerWidth + 1) bad.push(`page ${document.documentElement.scrollWidth} of ${innerWidth}`);
  for (const e of document.querySelectorAll("body *")) {
    if (!isSeen(e) || e.closest("svg") || e.closest("#names") || !e.clientWidth) continue;
    const style = getComputedStyle(e);
    if (e.scrollWidth > e.clientWidth + 1 && style.overflowX !== "visible" && style.display !== "inline") bad.push(`${e.tagName}#${e.id}.${e.className}: ${e.scrollWidth} of ${e.clientWidth}`);
    if (e.scrollHeight > e.clientHeight + 1 && ["hidden", "clip"].includes(style.overflowY) && style.display !== "inline") bad.push(`${e.tagName}#${e.id}.${e.className}: height ${e.scrollHeight} of ${e.clientHeight}`);
  }
  const ring = document.getElementById("ring");
  if (isSeen(ring)) {
    const box = ring.getBoundingClientRect();
    for (const text of ring.querySelectorAll("text")) {
      const r = text.getBoundingClientRect();
      if (r.left < box.left - 1 || r.right > box.right + 1 || r.top < box.top - 1 || r.bottom > box.bottom + 1) bad.push(`ring: ${text.textContent}`);
    }
    if (Math.min(box.width, box.height) < 100) bad.push(`ring ${box.width} wide, ${box.height} high`);
    const card = document.getElementById("ring-card").getBoundingClientRect();
    if (box.bottom > card.bottom + 1 || box.right > card.right + 1) bad.push(`ring: ${box.bottom} below its card, ${card.bottom}`);
  }
  if (innerWidth < 500) {  // the page scrolls, and nothing in it
    for (const box of document.querySelectorAll(".scrolls")) if (isSeen(box) && box.scrollHeight > box.clientHeight + 1) bad.push(`a table scrolls: ${box.scrollHeight} of ${box.clientHeight}`);
  }
  const stage = document.getElementById("stage").getBoundingClientRect();
  const names = [...document.querySelectorAll("#names span")].filter(isSeen);
  for (const name of names) {
    const r = name.getBoundingClientRect();
    const isOut = r.left < stage.left - 1 || r.right > stage.right + 1 || r.top < stage.top - 1 || r.bottom > stage.bottom + 1;
    if (isOut && !name.classList.contains("quiet")) bad.push(`name ${name.textContent}`);
    for (const other of names) {
      if (other === name) break;
      const s = other.getBoundingClientRect();
      const over = Math.min(Math.min(r.right, s.right) - Math.max(r.left, s.left), Math.min(r.bottom, s.bottom) - Math.max(r.top, s.top));
      if (over > 2) bad.push(`names ${name.textContent} and ${other.textContent} overlap`);
    }
  }
  return bad;
};
const table = (id) => Object.fromEntries([...document.querySelectorAll(`#${id} td[data-cell]`)].map((td) => [td.dataset.cell, td.textContent]));
goTo(n);
goToPlaces(inView.places, true);
const filling = shellBeingFilled(steps[n]);
const cells = filling ? cellsOf(filling).length : 0;
const fact = {position: Number(document.body.dataset.position), shown: Number(document.body.dataset.shown), hash: location.hash,
  event: texts("#event")[0], verdict: texts("#verdict")[0], reason: texts("#reason")[0], crumbs: texts("#crumbs button"),
  code: texts("#code-title")[0], lines: [...document.querySelectorAll("#code li")].flatMap((li, i) => li.classList.contains("here") ? [i + 1] : []),
  caller: texts("#caller")[0], tree: [...document.querySelectorAll("#tree tbody tr")].map((tr) => [Number(tr.dataset.call), ...[...tr.querySelectorAll("td")].map((td) => td.textContent)]),
  painted: painted(), cut: cutOff(), lesson: texts("#lesson-text")[0], removal: texts("#removal")[0], legend: texts("#legend li"),
  caller_shell: scene.shellOfCaller.map((tet) => tets[tet].corners.map((corner) => points[corner].vertex).sort((x, y) => x - y))};
const ring = document.getElementById("ring");
if (isSeen(ring)) {
  fact.caption = texts("#caption")[0];
  fact.corners = texts("#ring text[data-kind=corner]").map(Number);
  fact.numbers = texts("#ring text[data-kind=number]");
  fact.chordsDrawn = ring.querySelectorAll("line[data-kind=chord] title").length;
  fact.chords = [...document.querySelectorAll("#chords tr")].slice(1).map((tr) => [...tr.querySelectorAll("td")].map((td) => td.textContent));
  fact.locks = texts("#locks")[0];
}
if (cells > 0) {
  fact.emptyCells = document.querySelectorAll("#table-q td.open").length;
  fact.cells = [];
  for (let cell = 1; cell <= cells; ++cell) {
    goTo(n, cell);
    fact.cells.push({text: texts("#cell-text")[0], empty: document.querySelectorAll("#table-q td.open").length, cut: cutOff(), hash: location.hash});
  }
}
if (isSeen(document.getElementById("tables-card"))) fact.tables = [table("table-q"), table("table-k")];
return fact;
"""


def run(*arguments: object, **options: object) -> subprocess.CompletedProcess:
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=300, env=ENVIRONMENT, **options)


def recording(page: Path) -> dict:
    return json.loads(re.search(r'id="recording">(.*?)</script>', page.read_text(), re.S).group(1))


def viewer_states(trace: Path, positions: list[int]) -> list[dict]:
    """What the viewer shows after so many events; it starts once, which takes longer than a step."""
    script = WORK / "seek.lua"
    script.write_text("".join(f"seek({position}) print(state())\n" for position in positions))
    done = run(VIEWER, "--script", script, trace)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    states, rest = [], done.stdout.strip()
    while rest:
        state, end = json.JSONDecoder().raw_decode(rest)
        states.append(with_lists(state))
        rest = rest[end:].lstrip()
    return states


def with_lists(value: object, name: str = "") -> object:
    """Of tables of Lua, where an empty list is an empty object."""
    if isinstance(value, list):
        return [with_lists(entry) for entry in value]
    if isinstance(value, dict):
        return {key: with_lists(entry, key) for key, entry in value.items()} if value or name == "tables" else []
    return value


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        done = run(TETMEND, "lesson", "--html", "-o", WORK / "lessons")
        assert done.returncode == 0, done.stderr
        cls.desk = browser.Browser(1920, 1080)
        cls.desk.command("Emulation.setDeviceMetricsOverride", width=1920, height=1080, deviceScaleFactor=1, mobile=False)
        cls.desk.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])

    faces_to_remove = 0  # steps that mark one
    calling_lines = 0  # steps that name one of Algorithm 4 or 5

    @classmethod
    def tearDownClass(cls) -> None:
        cls.desk.close()

    def quiet(self, window: browser.Browser, where: str) -> None:
        said = [line for line in window.complaints() if not OF_THE_BROWSER.search(line)]
        self.assertEqual(said, [], where)

    def walk(self, window: browser.Browser, page: Path) -> list[dict]:
        window.complaints()
        window.requests()
        window.open(page.as_uri())
        facts = [window.run(WALK, n) for n in range(window.run("return steps.length"))]
        self.quiet(window, page.name)
        self.assertEqual([url for url in window.requests() if not url.startswith(("file:", "data:", "chrome"))], [], page.name)
        first = facts[0]["position"]
        self.assertEqual([fact["position"] for fact in facts], list(range(first, first + len(facts))), page.name)
        for fact in facts:
            where = f"{page.name}, step {fact['position']}"
            self.assertEqual(fact["cut"], [], where)
            self.assertEqual(fact["hash"], f"#step={fact['position']}", where)
            if fact["shown"]:
                self.assertGreater(fact["painted"], 0.005, where)
            for cell in fact.get("cells", []):
                self.assertEqual(cell["cut"], [], f"{where}, {cell['text']}")
                self.assertRegex(cell["text"], r"^Cell \d+ of \d+, pocket from \d+ to \d+: ")
            self.assertEqual([c["empty"] for c in fact.get("cells", [])], list(range(len(fact.get("cells", [])) - 1, -1, -1)), where)
        return facts

    def test_the_index_leads_to_a_page_of_each_lesson(self) -> None:
        index = (WORK / "lessons" / "index.html").read_text()
        self.assertEqual(re.findall(r'href="([^"]+)"', index), [f"{name}.html" for name in NAMES])
        for name in NAMES:
            page = WORK / "lessons" / f"{name}.html"
            self.assertLess(page.stat().st_size, 1_000_000)
            self.assertIn(json.loads((LESSONS / f"{name}.json").read_text())["title"], page.read_text())

    def test_each_step_of_each_lesson_is_whole_and_shows_what_the_viewer_shows(self) -> None:
        for name in NAMES:
            with self.subTest(lesson=name):
                lesson = json.loads((LESSONS / f"{name}.json").read_text())
                facts = self.walk(self.desk, WORK / "lessons" / f"{name}.html")
                positions = [fact["position"] for fact in facts]
                self.assertEqual(positions, list(range(len(facts))))
                for fact in facts:
                    text = [step["text"] for step in lesson["steps"] if step["at"] <= fact["position"]][-1]
                    self.assertEqual(fact["lesson"], text)
                if VIEWER is None:
                    continue
                for fact, state in zip(facts, viewer_states(LESSONS / f"{name}.trace", positions), strict=True):
                    self.compare(fact, state, f"{name}, step {fact['position']}")
        if VIEWER is not None:
            self.assertGreater(self.faces_to_remove, 5)
            self.assertGreater(self.calling_lines, 50)

    def test_the_viewer_fills_tables_cell_by_cell_with_the_words_of_the_page(self) -> None:
        if VIEWER is None:
            self.skipTest("without the viewer")
        filled = 0
        for name in NAMES:
            facts = [fact for fact in self.walk(self.desk, WORK / "lessons" / f"{name}.html") if fact.get("cells")]
            steps = [(fact["position"], cell["text"]) for fact in facts for cell in fact["cells"]]
            script = WORK / "fill.lua"
            script.write_text("tables()\n" + "".join(
                f"seek({fact['position']})\nfor _ = 1, {len(fact['cells'])} do step_into() print(state().trace.position, state().trace.filling.text) end\n" for fact in facts))
            done = run(VIEWER, "--script", script, LESSONS / f"{name}.trace")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.splitlines(), [f"{position} {text}" for position, text in steps], name)
            filled += len(steps)
        self.assertGreater(filled, 100)

    def test_each_step_of_each_page_of_the_lecture_is_whole(self) -> None:
        made = {page.name: page.read_bytes() for page in (WORK / "lessons").iterdir()}
        walked = skipped = 0
        for page in sorted(LECTURES.glob("*.html")):
            if page.name == "index.html":
                continue
            if made.get(page.name) == page.read_bytes():  # of a lesson: another test walks it
                skipped += 1
                continue
            with self.subTest(page=page.name):
                self.walk(self.desk, page)
                walked += 1
        self.assertEqual(walked + skipped, len(list(LECTURES.glob("*.html"))) - 1)
        self.assertGreaterEqual(walked, 2)

    def test_the_index_of_the_lecture_leads_to_pages_that_can_be_seen(self) -> None:
        self.desk.complaints()
        self.desk.open((LECTURES / "index.html").as_uri())
        links = self.desk.run("return [...document.querySelectorAll('a')].map((a) => a.href)")
        self.assertEqual(len(links), len(list(LECTURES.glob("*.html"))) - 1)
        text, entries = self.desk.run("return ['main > p', 'main > ol'].map((e) => document.querySelector(e).getBoundingClientRect()).map((r) => [r.left, r.width])")
        self.assertEqual(text, entries)  # below each other, as wide as there is room
        self.assertGreater(entries[1], 700)
        for link in links:
            self.desk.open(link)
            self.assertGreater(self.desk.run("return Number(document.body.dataset.position ?? -1)"), -1, link)
        self.quiet(self.desk, "index")

    # What a page does at its step 5, and what the walk is to say of it.
    BROKEN = {
        "an error": ("const whole = showCode; showCode = (step) => { whole(step); if (place.step === 5) setTimeout(() => { throw new Error('broken step'); }); };", "broken step"),
        "an empty picture": ("const whole = drawPicture; drawPicture = () => { whole(); if (place.step === 5) { painter.gl.clearColor(0, 0, 0, 0); painter.gl.clear(painter.gl.COLOR_BUFFER_BIT); } };", "not greater than 0.005"),
        "a text that is cut off": ("const whole = showCode; showCode = (step) => { whole(step); const reason = byId('event'); Object.assign(reason.style, place.step === 5 ? {width: '3em', whiteSpace: 'nowrap', overflow: 'hidden', display: 'block'} : {width: '', whiteSpace: '', overflow: '', display: ''}); };", "Lists differ"),
        "a cell that does not say what it is": ("const whole = showTables; showTables = (...all) => { whole(...all); if (place.step === 4 && place.cell === 3) byId('cell-text').textContent = ''; };", "Regex didn't match"),
        "a step that is passed over": ("const whole = goTo; goTo = (n, ...more) => whole(n === 5 ? 6 : n, ...more);", "Lists differ"),
    }

    def test_the_walk_notices_a_single_broken_step(self) -> None:
        page = WORK / "lessons" / "2-two-shells.html"
        broken = WORK / "broken.html"
        for name, (fault, said) in self.BROKEN.items():
            with self.subTest(fault=name):
                broken.write_text(page.read_text().replace("</body>", f"<script>{fault}</script></body>"))
                with self.assertRaisesRegex(AssertionError, said):
                    self.walk(self.desk, broken)

    def compare(self, fact: dict, state: dict, where: str) -> None:
        trace = state["trace"]
        stack = trace["stack"]
        # How a call has ended stands beside it, once.
        said = f": {stack[-1]['verdict']}" if stack else ""
        self.assertEqual(fact["event"], trace["event"].removesuffix(said), where)
        self.assertEqual(fact["shown"], state["shown"], where)
        self.assertEqual(len(fact["crumbs"]), len(stack), where)
        rows = {row[0]: row for row in fact["tree"]}
        for crumb, call in zip(fact["crumbs"], stack, strict=True):
            target = [str(v) for v in call["target"]]  # behind the name, which may have numbers
            self.assertEqual(re.findall(r"\d+", crumb)[-len(target):], target, where)
            before, after = call["degree_before"], call["degree_after"] if call["verdict"] != "under way" else call["degree_before"]
            self.assertEqual(rows[call["number"]][2], f"{before}" if before == after else f"{before} -> {after}", where)
        if not stack:
            self.assertEqual(fact["verdict"], "", where)
            self.assertEqual(fact["lines"], [trace["pass_line"]] if trace["pass_line"] else [], where)
            return
        here = stack[-1]
        self.assertEqual(fact["verdict"], here["verdict"], where)
        self.assertEqual(fact["lines"], [here["line"]] if here["line"] else [], where)
        caller = stack[-2]["line"] if len(stack) > 1 else trace["pass_line"]
        self.assertEqual(re.findall(r"^called from line (\d+) of", fact["caller"]), [str(caller)] if caller else [], where)
        self.compare_line_of_call(fact, here, where)
        self.assertEqual(fact["reason"], "" if here["verdict"] == "under way" else trace["reason"], where)
        self.compare_caller(fact, state, where)
        self.assertEqual("caption" in fact, "caption" in trace, where)
        if "caption" in trace:
            self.compare_shell(fact, trace, where)

    # What the line of an algorithm of the paper says that makes a call.
    CALLING_LINES = {"recursive_shell_transformation": "recursion: remove", "shell_transformation": "transform the shell of e",
                     "multi_face_removal": "multi-face removal of"}

    def compare_line_of_call(self, fact: dict, here: dict, where: str) -> None:
        """The caller's line is the one that makes this call, and not another on which page and viewer agree."""
        found = re.match(r"called from line (\d+) of Algorithm ([45]): (.*?)(?:; goes on at line (\d+))?$", fact["caller"])
        if not found:
            return
        line, _, text, goes_on = found.groups()
        self.assertIn(self.CALLING_LINES[here["operator"]], text, where)
        self.assertEqual(goes_on, None if here["verdict"] == "under way" else str(int(line) + 1), where)
        type(self).calling_lines += 1

    def compare_caller(self, fact: dict, state: dict, where: str) -> None:
        """The shell of the caller, as a ghost, and the face that is to go."""
        trace = state["trace"]
        self.assertEqual(fact["removal"], trace.get("removal", ""), where)
        self.assertEqual(sorted(fact["caller_shell"]), sorted(trace["shell_of_caller"]), where)

        def of_caller(legend: list[str]) -> list[str]:
            return [text for text in legend if text.startswith(("shell of the caller", "face f"))]

        self.assertEqual(of_caller(fact["legend"]), of_caller(state["legend"]), where)
        type(self).faces_to_remove += len(of_caller(fact["legend"])) == 2

    def compare_shell(self, fact: dict, trace: dict, where: str) -> None:
        shell = trace["shell"]
        self.assertEqual(fact["caption"], trace["caption"], where)
        self.assertEqual(fact["corners"], shell["ring"], where)

        def told(quality: float) -> str:
            return "none" if quality <= 0 else f"{quality:.4f}, better" if quality > shell["floor"] else f"{quality:.4f}"

        if shell["chords"]:
            self.assertEqual(fact["chords"], [[f"{c['from']} - {c['to']}", told(c["on"]), told(c["back"])] for c in shell["chords"]], where)
        if fact["caption"].startswith(("found", "made", "tried")):
            covering = shell["covering"]
            core = covering["core"] if len(covering["core"]) >= 3 else []
            numbers = [f"{part['quality']:.3f}" for part in core + covering["triangles"]]
            self.assertEqual(sorted(fact["numbers"]), sorted(numbers), where)
            self.assertEqual(fact["chordsDrawn"], 0, where)
        elif fact["caption"].startswith("before the call"):  # the shell is gone
            self.assertEqual(fact["chordsDrawn"], 0, where)
        else:
            self.assertEqual(fact["chordsDrawn"], len(shell["chords"]), where)
        if "tables" not in fact:
            return
        ring = shell["ring"]
        for cell, text in fact["tables"][0].items():
            i, j = (int(n) for n in cell.split(","))
            entry = shell["tables"].get(f"{ring[i]} {ring[j]}")
            if i != j and j != (i + 1) % len(ring):
                self.assertEqual(text, f"{entry['q']:.3f}" if entry else "none", f"{where}, M_q {cell}")
                self.assertEqual(fact["tables"][1][cell], str(entry["k"]) if entry else "\u2013", f"{where}, M_k {cell}")

    def test_pages_are_whole_on_a_phone_in_the_dark_and_on_the_largest_screen(self) -> None:
        for width, height, dark in ((390, 844, False), (390, 844, True), (3840, 2160, True), (1920, 940, False), (1280, 720, False)):
            window = browser.Browser(width, height, dark)
            try:
                if width >= 500:
                    window.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
                for name in ("2-two-shells", "4-tables"):
                    with self.subTest(page=name, width=width):
                        self.walk(window, WORK / "lessons" / f"{name}.html")
                        self.assertEqual(window.run("return document.documentElement.dataset.theme"), "dark" if dark else "light")
                window.open((LECTURES / "index.html").as_uri())
                brightness = window.run("return getComputedStyle(document.body).backgroundColor.match(/[0-9]+/g).map(Number).reduce((a, b) => a + b)")
                self.assertEqual(brightness < 300, dark, "paper of the index")
            finally:
                window.close()

    def test_large_text_on_a_projector_leaves_algorithm_and_ring_whole(self) -> None:
        window = browser.Browser(1920, 1080)
        try:
            window.command("Emulation.setDeviceMetricsOverride", width=1920, height=940, deviceScaleFactor=1, mobile=False)
            for name, position in (("2-two-shells", 4), ("2-two-shells", 19), ("4-tables", 2)):
                with self.subTest(page=name, position=position):
                    window.open("about:blank")
                    window.open((WORK / "lessons" / f"{name}.html").as_uri() + f"#step={position}")
                    window.run("if (document.documentElement.dataset.size !== 'large') document.getElementById('text-size').click()")
                    crushed = window.run('''return [...document.querySelectorAll("main > .card")].filter((card) => card.getClientRects().length && !card.querySelector(".scrolls")
                        && (card.scrollHeight > card.clientHeight + 1 || card.clientHeight < 60)).map((card) => `${card.className}: ${card.scrollHeight} of ${card.clientHeight}`)''')
                    self.assertEqual(crushed, [])
                    self.assertEqual(window.run("return document.documentElement.dataset.size"), "large")
                    self.assertLessEqual(window.run("return document.documentElement.scrollWidth"), 1920)
        finally:
            window.close()

    def test_what_scrolls_in_a_card_is_reached_by_keys(self) -> None:
        window = browser.Browser(1920, 1080)
        try:
            window.command("Emulation.setDeviceMetricsOverride", width=1920, height=1080, deviceScaleFactor=1, mobile=False)
            scrolling = """const scrolling = [...document.querySelectorAll("main *")].filter((e) => e.getClientRects().length && e.scrollHeight > e.clientHeight + 1
                && getComputedStyle(e).overflowY === "auto");"""
            for name, position, height, what in (("2-two-shells", 2, 937, "card code"), ("5-reconnection", 1, 937, "card code"),
                                                 ("4-tables", 2, 1080, "card tables")):
                with self.subTest(page=name):
                    window.command("Emulation.setDeviceMetricsOverride", width=1920, height=height, deviceScaleFactor=1, mobile=False)
                    window.open("about:blank")
                    window.open((WORK / "lessons" / f"{name}.html").as_uri() + f"#step={position}")
                    names, unreached = window.run(scrolling + """const isReached = (e) => e.tabIndex >= 0 || e.querySelector("a, button, [tabindex]");
                        return [scrolling.map((e) => e.className), scrolling.filter((e) => !isReached(e)).map((e) => e.className)]""")
                    self.assertIn(what, names)
                    self.assertEqual(unreached, [])
            # There arrows are for what scrolls, not for the next step.
            window.run("document.getElementById('tables-card').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowDown', bubbles: true}))")
            self.assertEqual(window.run("return location.hash"), "#step=2")
        finally:
            window.close()

    def test_keys_buttons_and_links_lead_where_the_debugger_leads(self) -> None:
        page = WORK / "lessons" / "2-two-shells.html"
        self.desk.open(page.as_uri() + "#step=4.2")

        def place() -> str:
            return self.desk.run("return location.hash")

        def press(key: str) -> str:
            self.desk.run("document.body.dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0], bubbles: true}))", key)
            return place()

        self.assertEqual(place(), "#step=4.2")
        self.assertEqual(press("ArrowLeft"), "#step=4.1")
        self.assertEqual(press("ArrowUp"), "#step=4")
        self.assertEqual(press("ArrowDown"), "#step=5")
        self.assertEqual(press("PageDown"), "#step=7")
        self.assertEqual(press("ArrowDown"), "#step=13")   # over the recursion
        self.assertEqual(press("ArrowUp"), "#step=7")
        self.assertEqual(press("PageUp"), "#step=1")
        self.assertEqual(press("ArrowRight"), "#step=2")
        self.assertEqual(press("ArrowDown"), "#step=3")
        self.assertEqual(press("End"), "#step=19")
        self.assertEqual(press("b"), "#step=18")
        self.assertEqual(press("Home"), "#step=0")
        self.assertEqual(press("n"), "#step=2")
        for step, leads_to in (("over", "#step=3"), ("back-over", "#step=2"), ("into", "#step=3"), ("out", "#step=18"), ("back-into", "#step=17")):
            self.desk.run("document.querySelector(`[data-step=${arguments[0]}]`).click()", step)
            self.assertEqual(place(), leads_to, step)
        self.desk.run("document.querySelector('#tree tr[data-call=\"2\"] button.row').click()")
        self.assertEqual(place(), "#step=8", "a row of the tree")
        self.desk.open("about:blank")
        self.desk.open(page.as_uri() + "#step=9.3")
        self.assertEqual(self.desk.run("return [document.body.dataset.position, document.body.dataset.cell]"), ["9", "3"])
        self.quiet(self.desk, "keys")

    def on_page(self, name: str, step: str) -> tuple:
        """Opened there: what presses a key, and what clicks; both tell the place afterwards."""
        self.desk.open("about:blank")
        self.desk.open((WORK / "lessons" / f"{name}.html").as_uri() + f"#step={step}")

        def press(key: str) -> str:
            return self.desk.run("document.body.dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0], bubbles: true, cancelable: true})); return location.hash.slice(6)", key)

        def click(selector: str) -> str:
            return self.desk.run("document.querySelector(arguments[0]).click(); return location.hash.slice(6)", selector)

        return press, click

    def test_keys_that_jump_find_what_they_name(self) -> None:
        press, click = self.on_page("2-two-shells", "0")
        calls = recording(WORK / "lessons" / "2-two-shells.html")["calls"]
        accepted = sorted(call["end"] for call in calls.values() if call["outcome"] == "accepted")
        for ends, forth, back in ((accepted, "j", "J"),):
            self.assertEqual([int(press(forth)) for _ in ends], ends)
            self.assertEqual([int(press(back)) for _ in ends[1:]], ends[-2::-1])
        deepest = max(calls.values(), key=lambda call: call["depth"])
        self.assertEqual(int(press("d")), deepest["begin"] + 1)
        for key in ("L", "K", "n", "b"):
            self.assertNotEqual(press(key), "")
        self.assertEqual(press("Home"), "0")
        first = click("#lesson-next")
        self.assertGreater(int(first), 0)
        self.assertEqual(click("#lesson-back"), "0")
        self.assertTrue(self.desk.run("return document.getElementById('lesson-back').disabled"))
        self.desk.run("const slider = document.getElementById('slider'); slider.value = 7; slider.dispatchEvent(new Event('input', {bubbles: true}))")
        self.assertEqual(self.desk.run("return location.hash"), "#step=7")
        press("PageUp"), press("d")
        crumbs = self.desk.run("return [...document.querySelectorAll('#crumbs button')].length")
        self.assertGreater(crumbs, 2)
        self.assertEqual(click("#crumbs button"), "2", "the outermost call")
        press, click = self.on_page("3-refusals", "0")
        calls = recording(WORK / "lessons" / "3-refusals.html")["calls"]
        refused = sorted(call["end"] for call in calls.values() if call["outcome"] not in ("accepted", "undone", "unfinished"))
        self.assertGreater(len(refused), 1)
        self.assertEqual([int(press("u")) for _ in refused], refused)
        self.assertEqual([int(press("U")) for _ in refused[1:]], refused[-2::-1])
        self.quiet(self.desk, "jumps")

    def test_buttons_and_keys_for_looks_change_the_picture(self) -> None:
        press, click = self.on_page("2-two-shells", "10")

        def look() -> list:
            return self.desk.run("""drawPicture();
                const small = Object.assign(document.createElement("canvas"), {width: 48, height: 48}).getContext("2d");
                small.drawImage(document.getElementById("canvas"), 0, 0, 48, 48);
                return [...small.getImageData(0, 0, 48, 48).data].join()""")

        def pressed() -> str:
            return self.desk.run("return document.querySelector('[data-when][aria-pressed=true]').dataset.when")

        looks = [look()]

        def changes(what: str) -> None:
            looks.append(look())
            self.assertNotEqual(looks[-1], looks[-2], what)

        self.assertEqual(pressed(), "now")
        for key, when in (("2", "before"), ("3", "after"), ("1", "now")):
            press(key)
            self.assertEqual(pressed(), when)
            press("1")
            click(f"[data-when={when}]")
            self.assertEqual(pressed(), when)
        press("2")
        changes("before")
        press("1")
        changes("now")
        press("a")
        changes("along the edge")
        press("h")
        changes("from the side")
        click("#along")
        changes("along the edge, by the button")
        click("#home")
        changes("from the side, by the button")
        click("#around")
        changes("without the tets around")
        self.desk.run("const apart = document.getElementById('apart'); apart.value = 50; apart.dispatchEvent(new Event('input', {bubbles: true}))")
        changes("apart")
        theme = "return document.documentElement.dataset.theme"
        before = self.desk.run(theme)
        press("t")
        self.assertNotEqual(self.desk.run(theme), before)
        click("#theme")
        self.assertEqual(self.desk.run(theme), before)
        size = "return document.documentElement.dataset.size"
        press("g")
        self.assertEqual(self.desk.run(size), "large")
        click("#text-size")
        self.assertEqual(self.desk.run(size), "")
        click("#copy-link")
        self.assertRegex(self.desk.wait_for("return document.getElementById('said').textContent") or "", "link|#step=10")
        for way in ("click", "press"):
            click("#show-keys") if way == "click" else press("?")
            rows = self.desk.run("return document.getElementById('keys').open ? document.querySelectorAll('#key-list tr').length : 0")
            self.assertGreater(rows, 20, way)
            click("#keys form button")
            self.assertFalse(self.desk.run("return document.getElementById('keys').open"))
        fold = "return document.querySelectorAll('#tree tbody tr').length"
        rows = self.desk.run(fold)
        click("#tree button.fold")
        self.assertLess(self.desk.run(fold), rows)
        click("#tree button.fold")
        self.assertEqual(self.desk.run(fold), rows)
        self.quiet(self.desk, "looks")

    def test_the_space_bar_plays_and_stops(self) -> None:
        press, _ = self.on_page("1-core", "0")
        press(" ")
        self.assertTrue(self.desk.wait_for("return Number(document.body.dataset.position) >= 2"))
        press(" ")
        stopped = self.desk.run("return location.hash")
        time.sleep(1.2)
        self.assertEqual(self.desk.run("return location.hash"), stopped)

    def test_a_page_of_a_true_run_is_small_and_whole(self) -> None:
        trace, page = WORK / "run.trace", WORK / "call.html"
        done = run(TETMEND, "improve", SOURCE / "assets/meshes/sheet.mesh", "-o", WORK / "out.mesh", "-q", "--trace", trace)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = run(TETMEND, "trace", trace).stdout
        call = re.search(r"(\d+)", summary[summary.index("argest"):]).group(1)
        done = run(TETMEND, "trace", trace, "--html", call, "-o", page)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(page.stat().st_size, 1_000_000)
        facts = self.walk(self.desk, page)
        self.assertGreater(len(facts), 10)
        if VIEWER is None:
            return
        some = facts[1::max(1, len(facts) // 12)]
        for fact, state in zip(some, viewer_states(trace, [fact["position"] for fact in some]), strict=True):
            self.compare(fact, state, f"call {call}, step {fact['position']}")

    def test_print_has_a_picture(self) -> None:
        self.desk.open((WORK / "lessons" / "2-two-shells.html").as_uri() + "#step=7")
        pdf = self.desk.printed()
        self.assertTrue(pdf.startswith(b"%PDF"))
        self.assertGreater(len(pdf), 20_000)
        self.desk.command("Emulation.setEmulatedMedia", media="print", features=[])
        try:
            seen = self.desk.run("""const svg = document.getElementById("flat").getBoundingClientRect();
                return [svg.width, svg.height, document.querySelectorAll("#flat polygon").length, document.getElementById("canvas").getClientRects().length,
                        [...document.querySelectorAll(".card[hidden]")].filter((card) => card.getClientRects().length > 0).length]""")
        finally:
            self.desk.command("Emulation.setEmulatedMedia", media="", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
        self.assertGreater(min(seen[0], seen[1]), 100)
        self.assertGreaterEqual(seen[2], 20)
        self.assertEqual(seen[3:], [0, 0])  # no empty card either

    def test_names_of_a_stranger_are_texts(self) -> None:
        folder = WORK / "hostile"
        folder.mkdir(exist_ok=True)
        mesh, schedule = folder / f"{HOSTILE}.mesh", folder / f"{HOSTILE}.lua"
        shutil.copy(SOURCE / "assets" / "meshes" / "sheet.mesh", mesh)
        schedule.write_text("local_reconnection{}")
        done = run(TETMEND, "improve", mesh, "-o", folder / "out.mesh", "--schedule", schedule, "--trace", folder / "bad.trace", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run(TETMEND, "trace", folder / "bad.trace", "--html", "0", "-o", folder / "bad.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.desk.complaints()
        self.desk.open((folder / "bad.html").as_uri())
        title, images, text = self.desk.run("return [document.title, document.images.length, document.body.innerText]")
        self.assertIn("Call 0", title)
        self.assertEqual(images, 0)
        self.assertIn(f"{HOSTILE}.mesh", text)
        self.assertIn(f"{HOSTILE}.lua", text)
        self.quiet(self.desk, "hostile")


if __name__ == "__main__":
    if not browser.is_installed():
        print("pages_test: no chromium or chromedriver: skipped")
        sys.exit(SKIPPED)
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
