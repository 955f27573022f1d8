# SPDX-License-Identifier: MIT
"""Every step of every lesson on its stage, in headless Chromium: what it speaks of is in the window, the buttons stay where they are,
and the trace answers the questions.

    stage_test.py SOURCE TETMEND WORK     WORK: a folder that this test may empty

Exit status 77: Chromium is not installed.
"""

import json
import re
import shutil
import sys
import unittest
from pathlib import Path

SOURCE, TETMEND, WORK = (Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(SOURCE / "tests" / "docs"))
import browser  # noqa: E402
from browser import window  # noqa: E402

SKIPPED = 77
LECTURES = SOURCE / "docs" / "lectures"
PAGES = sorted(LECTURES.glob("*-*.html"), key=lambda page: int(page.name.split("-")[0]))
SIZES = {"phone": (390, 844, False), "projector": (1280, 720, True), "desk": (1920, 1080, False)}  # width, height, large text
# What Chromium says of its own stand-in for a graphics card.
OF_THE_BROWSER = re.compile(r"software WebGL has been deprecated|GL Driver Message \(OpenGL, Performance")

# Where things are at a step, and what is cut off.
LOOK = """
const look = () => {
const isSeen = (e) => e.getClientRects().length > 0;
const box = (e) => { const r = e.getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom].map((x) => Math.round(10 * x) / 10); };
const wanted = lesson.steps[place.lesson].focus;
const panels = {picture: ".picture", ring: ".ring", tables: ".tables", algorithm: ".code", tree: ".tree"};
const bad = [];
const isInside = (e, [left, top, right, bottom], what) => {
  const r = e.getBoundingClientRect();
  if (r.left < left - 1 || r.top < top - 1 || r.right > right + 1 || r.bottom > bottom + 1) bad.push(`${what}: ${box(e)} of ${[left, top, right, bottom]}`);
};
const bar = document.getElementById("bar").getBoundingClientRect();
const room = [0, 0, innerWidth, bar.top];
if (document.documentElement.scrollHeight > innerHeight || document.documentElement.scrollWidth > innerWidth) bad.push("the page scrolls");
isInside(document.getElementById("bar"), [0, 0, innerWidth, innerHeight], "bar");
for (const e of document.querySelectorAll("[role=img]")) {
  if (isSeen(e) && e.querySelector("a, button, [tabindex]")) bad.push(`${e.id}: a picture with something to press`);
}
for (const id of ["lesson-text", "ask"]) {
  const e = document.getElementById(id);
  if (!isSeen(e)) continue;
  isInside(e, room, id);
  if (e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1) bad.push(`${id}: a text is cut`);
}
for (const spot of document.querySelectorAll("#ring .pick")) {  // its line, too; the picture goes from -1 to 1
  const far = Math.max(Math.abs(spot.cx.baseVal.value), Math.abs(spot.cy.baseVal.value)) + spot.r.baseVal.value + parseFloat(getComputedStyle(spot).strokeWidth) / 2;
  if (far > 1.0001) bad.push(`ring: a corner to press of ${far}`);
}
const fingers = [...document.querySelectorAll("#code button:not(:disabled)")].filter(isSeen).map((e) => e.getBoundingClientRect().height);
document.querySelectorAll("#ring .pick").forEach((spot, i) => {
  for (const kind of ["corner", "place"]) {
    const text = document.querySelectorAll(`#ring text[data-kind=${kind}]`)[i].getBBox();
    const far = Math.max(...[text.x, text.x + text.width].map((x) => Math.abs(x - spot.cx.baseVal.value)));
    if (far > spot.r.baseVal.value) bad.push(`ring: a number sticks out of its corner to press, ${far}`);
  }
});
const shown = [];
for (const [name, selector] of Object.entries(panels)) {
  const card = document.querySelector(selector);
  if (!isSeen(card)) continue;
  shown.push(name);
  isInside(card, room, name);
  for (const e of [card, ...card.querySelectorAll("*")]) {
    if (e.closest("#names") || (e !== e.closest("svg") && e.closest("svg")) || !isSeen(e)) continue;
    if (e.matches(".index i")) continue;  // the stroke of M_q, which is there to be copied, not to be seen
    isInside(e, box(card), `${name} ${e.tagName} ${e.textContent.slice(0, 20)}`);
    if (e.childElementCount === 0 && e.textContent.trim() && parseFloat(getComputedStyle(e).fontSize) < 8.5) bad.push(`${name}: text of ${getComputedStyle(e).fontSize}`);
  }
}
if (isSeen(document.getElementById("names")) && overflows(document.getElementById("names"))) bad.push("a name is cut");
const size = (selector) => { const r = document.querySelector(selector).getBoundingClientRect(); return Math.min(r.width, r.height); };
if (shown.includes("picture") && size("#stage") < 95) bad.push(`picture of ${size("#stage")}`);
if (shown.includes("ring") && size("#ring") < 95) bad.push(`ring of ${size("#ring")}`);
return {hash: location.hash, bad, wanted, shown, fingers, next: box(document.getElementById("lesson-next")), back: box(document.getElementById("lesson-back")), theme: document.documentElement.dataset.theme};
};
"""
# From the first step to the last by Next alone; each once more with its question answered.
WALK = LOOK + """
const seen = [];
for (let n = 0; n < lesson.steps.length; ++n) {
  seen.push(look());
  if (questionAt(n)) {
    giveAnswer(n, false, questionAt(n).kind === "chord" ? [0, 0] : 1);
    seen.push(look());
  }
  if (n + 1 < lesson.steps.length) document.getElementById("lesson-next").click();
}
return seen;
"""


def recording(page: Path) -> dict:
    return json.loads(re.search(r'id="recording">(.*?)</script>', page.read_text(), re.S).group(1))


class Stage(unittest.TestCase):
    def quiet(self, where: browser.Browser, what: str) -> None:
        self.assertEqual([line for line in where.complaints() if not OF_THE_BROWSER.search(line)], [], what)

    fingers: list[tuple[str, float]] = []  # lines of algorithms to be pressed, and how high they are

    def walk(self, where: browser.Browser, page: Path, large: bool, dark: bool) -> int:
        where.open("about:blank")
        where.open(page.as_uri())
        if large:
            where.run("if (document.documentElement.dataset.size !== 'large') document.getElementById('text-size').click()")  # it goes on from page to page
        steps = recording(page)["lesson"]["steps"]
        seen = where.run(WALK)
        for look in seen:
            what = f"{page.name}, {look['hash']}"
            self.assertEqual(look["bad"], [], what)
            self.assertTrue(look["shown"], what)
            self.assertLessEqual(set(look["shown"]), set(look["wanted"]) | {"picture"}, what)
            self.assertEqual(look["theme"], "dark" if dark else "light", what)
            self.fingers += [(what, height) for height in look["fingers"]]
        wanted = [f"#lesson={n}" for n, step in enumerate(steps, 1) for _ in range(2 if "ask" in step else 1)]
        self.assertEqual([look["hash"] for look in seen], wanted, page.name)
        self.assertEqual(len({(*look["next"], *look["back"]) for look in seen}), 1, f"{page.name}: Next and Previous move")
        self.quiet(where, page.name)
        return len(steps)

    def test_what_each_step_speaks_of_is_in_the_window_and_next_never_moves(self) -> None:
        for name, (width, height, large) in SIZES.items():
            for dark in (False, True):
                where = window(width, height, dark)
                try:
                    for page in PAGES:
                        with self.subTest(size=name, dark=dark, page=page.name):
                            self.assertGreater(self.walk(where, page, large, dark), 3)
                finally:
                    where.close()
        self.assertGreater(len(self.fingers), 100)
        self.assertEqual([line for line in self.fingers if line[1] < 31.9], [], "lines too low for fingers")

    def test_the_camera_goes_to_what_each_step_is_about(self) -> None:
        """To the tets of a call, or to the tet that the pass turns to: all of them are in the picture, and they fill it."""
        look = """
        const size = {width: stage.clientWidth, height: stage.clientHeight};
        const step = steps[place.step];
        const visited = tetVisited(step);
        const about = visited ? [...present.tets].filter((tet) => tets[tet].corners.every((corner) => visited.includes(points[corner].vertex))) : [];
        const seen = (about.length > 0 ? [...placesIn(about).values()] : scene.places).map((at) => camera.project(at, size));
        const extent = [0, 1].map((axis) => [Math.min(...seen.map((at) => at[axis])), Math.max(...seen.map((at) => at[axis]))]);
        const isWithCaller = callOf(step)?.caller ? true : false;
        return {size: [size.width, size.height], extent, isTet: about.length > 0, isWithCaller};
        """
        tets = 0
        for width, height, _ in SIZES.values():
            where = window(width, height)
            try:
                for page in PAGES:
                    where.open("about:blank")
                    where.open(page.as_uri())
                    for n, step in enumerate(recording(page)["lesson"]["steps"], 1):
                        if n > 1:
                            where.run("document.getElementById('lesson-next').click()")
                        if "picture" not in step["focus"]:
                            continue
                        at = where.run(look)
                        what = f"{page.name}, step {n}, {width}x{height}: {at}"
                        for (low, high), room in zip(at["extent"], at["size"]):
                            self.assertTrue(low > -1 and high < room + 1, what)
                        parts = [(high - low) / room for (low, high), room in zip(at["extent"], at["size"])]
                        if not at["isWithCaller"]:
                            self.assertGreater(max(parts), 0.4 if at["isTet"] else 0.55, what)
                        tets += at["isTet"]
                self.quiet(where, "camera")
            finally:
                where.close()
        self.assertGreater(tets, 3)

    def test_what_is_promised_is_shown_where_the_trace_has_it(self) -> None:
        """At most the first step of a lesson, before any call, has a panel less than its focus."""
        where = window(1920, 1080)
        try:
            for page in PAGES:
                where.open("about:blank")
                where.open(page.as_uri())
                steps = recording(page)["lesson"]["steps"]
                shown = {look["hash"]: set(look["shown"]) for look in where.run(WALK)}
                for step, told in enumerate(steps[1:], 2):
                    with self.subTest(page=page.name, step=step):
                        self.assertEqual(shown[f"#lesson={step}"], set(told["focus"]))
        finally:
            where.close()

    def test_a_phone_goes_through_the_lecture_by_taps_at_one_place(self) -> None:
        where = window(390, 844)
        try:
            where.open(PAGES[0].as_uri())
            x, y = where.run("const r = document.getElementById('lesson-next').getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height / 2]")
            for n, page in enumerate(PAGES):
                self.assertTrue(where.run("return location.pathname").endswith(page.name))
                for _ in recording(page)["lesson"]["steps"]:
                    for kind in ("touchStart", "touchEnd"):
                        where.command("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y}] if kind == "touchStart" else [])
                if n + 1 < len(PAGES):
                    following = PAGES[n + 1].name
                    self.assertTrue(where.wait_for(f"return location.pathname.endsWith('{following}') && document.readyState === 'complete'"), following)
            self.assertTrue(where.run("return document.getElementById('lesson-next').disabled"))
        finally:
            where.close()

    def test_parts_of_a_shell_have_the_colours_of_windows_and_figures(self) -> None:
        table = dict(re.findall(r"k(\w+)Colour\{(\d+, \d+, \d+)", (SOURCE / "figure" / "colour.h").read_text()))
        wanted = {"edge": "SupportingEdge", "visited": "Selection", "skirt": "Skirt", "chord": "Chord", "core": "Core", "cell": "Cell", "face": "FaceToRemove"}
        for dark in (False, True):
            where = window(1280, 800, dark)
            try:
                where.open(PAGES[1].as_uri())
                for name, constant in wanted.items():
                    if not (dark and name in ("cell", "face")):  # too dark for a dark ground
                        self.assertEqual(where.run("return colourOf(arguments[0]).join(', ')", name), table[constant], name)
                edge, bad, cell = where.run("return [colourOf('edge'), BAD, colourOf('cell')]")
                for other in (bad, cell):
                    self.assertGreater(max(abs(a - b) for a, b in zip(edge, other)), 100, f"{edge} {other}")
            finally:
                where.close()

    def test_the_legend_names_each_colour_of_lines_and_faces(self) -> None:
        look = """return steps.flatMap((step, n) => {
            goTo(n);
            const svgs = [...document.querySelectorAll("#legend svg *")];
            const named = new Set(["wire"].map((kind) => inCss(colourOf(kind))));
            for (const e of svgs) for (const look of ["stroke", "fill"]) if (e.getAttribute(look)) named.add(e.getAttribute(look));
            const drawn = [...scene.lines.filter((line) => line.top), ...scene.faces.filter((face) => face.flat)].map(({colour}) => inCss(colour));
            return [...new Set(drawn)].filter((colour) => !named.has(colour)).map((colour) => `${step.position}: ${colour}`);
        });"""
        where = window(1280, 800)
        try:
            for page in PAGES[:8]:
                where.open("about:blank")
                where.open(page.as_uri())
                self.assertEqual(where.run(look), [], page.name)
            where.open(f"{PAGES[1].as_uri()}#lesson=5")
            face = where.run("return [...document.querySelectorAll('#legend li')].filter((e) => e.dataset.kind === 'face').map((e) => [e.textContent, e.querySelectorAll('line').length > 3])")
            self.assertEqual(face, [["face f to remove, 0 1 5", True]], "hatched, as in the picture")
            where.open("about:blank")
            where.open(f"{PAGES[4].as_uri()}#lesson=3")
            self.assertEqual(where.run("return scene.lines.filter((line) => inCss(line.colour) === inCss(colourOf('visited'))).length"), 6)
        finally:
            where.close()

    def test_a_target_that_is_no_edge_is_marked_as_in_windows(self) -> None:
        look = """return [document.querySelectorAll("#legend li[data-kind=" + arguments[0] + "]").length,
            scene.lines.filter((line) => line.top && inCss(line.colour) === inCss(colourOf(arguments[0]))).length,
            [...document.querySelectorAll("#names span.end")].map((e) => e.textContent)]"""
        for width, height, _ in SIZES.values():
            where = window(width, height)
            try:
                where.open(f"{(LECTURES / '8-polyhedron').as_uri()}.html#lesson=3")
                self.assertEqual(where.run(look, "tet"), [1, 6, []], "yellow, and its vertices are no ends of an edge")
                where.open(f"{(LECTURES / '6-smoothing').as_uri()}.html#lesson=3")
                self.assertEqual(where.run(look, "vertex"), [1, 1, ["6 = v"]])
                where.open(f"{(LECTURES / '5-reconnection').as_uri()}.html#lesson=6")
                seen = "return [...document.querySelectorAll('#legend li[data-kind=visited]')].filter((e) => e.getClientRects().length > 0).length"
                self.assertEqual(where.run(seen), 1, f"the colour of t is told at {width}")
            finally:
                where.close()

    def test_what_the_search_has_found_is_seen_before_it_is_made(self) -> None:
        where = window(1280, 720)
        try:
            where.open(f"{(LECTURES / '1-core').as_uri()}.html#lesson=5")
            dashed = "return scene.lines.filter((line) => line.dashed && ['chord', 'core'].some((kind) => inCss(line.colour) === inCss(colourOf(kind)))).length"
            self.assertGreater(where.run(dashed), 4)
            self.assertTrue(where.run("return document.getElementById('caption').textContent").startswith("found: degree 6 -> 4, worst "))
            self.assertTrue(where.run("return document.querySelector('[data-when=after]').disabled"), "it would answer the question")
            where.run("document.getElementById('lesson-next').click()")
            self.assertEqual(where.run(dashed), 0)
            self.assertTrue(where.run("return document.getElementById('caption').textContent").startswith("made: degree 6 -> 4, worst "))
        finally:
            where.close()

    def test_names_do_not_cover_what_they_name(self) -> None:
        around = """const size = {width: stage.clientWidth, height: stage.clientHeight};
            const near = {...camera, project: (place) => [195 + 9 * place[0], 120 + 9 * place[1], place[2]]};
            const named = {names: [[0, 0], [0, 3], [3, 3], [3, 0], [1.5, 1.4], [1.4, 2]].map((at, n) => ({text: `${1000 + n}`, vertex: n, place: [...at, 0], corner: n + 1}))};
            return placeNames(named, near, size, 16).map(({at, half, isLed, hidden}) => [at[0] - half[0] < 195 + 27 && at[0] + half[0] > 195 && at[1] - half[1] < 120 + 27 && at[1] + half[1] > 120, isLed, hidden]);"""
        where = window(390, 844)
        try:
            where.open((LECTURES / "1-core.html").as_uri())
            self.assertEqual(where.run(around), 6 * [[False, True, False]])
        finally:
            where.close()

    def test_corners_of_the_ring_are_p_i_in_the_picture_as_in_the_ring(self) -> None:
        look = """const of = (selector) => [...document.querySelectorAll(selector)].filter((e) => e.getClientRects().length > 0).map((e) => e.textContent);
            const [corners, places] = [of("#ring text[data-kind=corner]"), of("#ring text[data-kind=place]")];
            const names = [...document.querySelectorAll("#names span[data-vertex]")].filter((e) => !e.hidden && e.querySelector("sub")).map((e) => e.textContent);
            const crossed = [...document.querySelectorAll("#names span:not(.quiet)")].filter((e) => {
              const name = scene.names.find(({vertex}) => vertex === Number(e.dataset.vertex));
              const [x, y] = camera.project(name.place, {width: stage.clientWidth, height: stage.clientHeight});
              const [box, around] = [e.getBoundingClientRect(), stage.getBoundingClientRect()];
              const isOn = x > box.left - around.left - 4 && x < box.right - around.left + 4 && y > box.top - around.top - 4 && y < box.bottom - around.top + 4;
              return !isOn && document.querySelectorAll("#names .leader").length === 0;
            });
            return {wanted: corners.map((corner, i) => `${corner} = ${places[i]}`), names, lost: crossed.length};"""
        where = window(1280, 720)
        try:
            for lesson, number in (("1-core", 5), ("1-core", 6), ("2-two-shells", 4), ("2-two-shells", 8), ("4-tables", 4)):
                where.open("about:blank")
                where.open(f"{(LECTURES / lesson).as_uri()}.html#lesson={number}")
                seen = where.run(look)
                self.assertEqual(sorted(seen["names"]), sorted(seen["wanted"]), f"{lesson}, {number}")
                self.assertGreater(len(seen["names"]), 2)
                self.assertEqual(seen["lost"], 0, "a name away from its vertex has a line to it")
        finally:
            where.close()

    def test_names_of_the_paper_have_indices_and_can_be_copied(self) -> None:
        tables = next(page for page in PAGES if page.name == "4-tables.html")
        where = window(1280, 800)
        try:
            where.open(f"{tables.as_uri()}#lesson=4")
            self.assertEqual(where.run("return document.querySelector('h1').textContent"), recording(tables)["lesson"]["title"])
            self.assertEqual(where.run("return document.getElementById('lesson-text').textContent"), recording(tables)["lesson"]["steps"][3]["text"])
            self.assertEqual(where.run("return document.querySelector('#lesson-text sub').textContent"), "_k")
            self.assertEqual(where.run("return document.querySelector('#lesson-text sub i').getBoundingClientRect().width"), 0)
        finally:
            where.close()

    def test_a_phone_can_read_tables_and_ring(self) -> None:
        look = """return [1, 4].map((n) => {
            goToLesson(n);
            const ring = document.getElementById("ring").getBoundingClientRect();
            const inRing = [...document.querySelectorAll("#ring text")].filter((e) => ["corner", "place", "number"].includes(e.dataset.kind));
            const outside = inRing.map((e) => e.getBoundingClientRect()).filter((r) => r.left < ring.left - 1 || r.right > ring.right + 1 || r.top < ring.top - 1 || r.bottom > ring.bottom + 1);
            const index = (e) => e.querySelector("tspan[dy]") ? parseFloat(e.querySelector("tspan[dy]").getAttribute("font-size")) / 100 : 1;
            const sizes = inRing.map((e) => index(e) * parseFloat(e.getAttribute("font-size")) * Math.min(ring.width, ring.height) / 2);
            const texts = [...document.querySelectorAll(".tables td, .tables th, .code li")].filter((e) => e.getClientRects().length > 0);
            return [Math.min(...sizes), Math.min(...texts.map((e) => parseFloat(getComputedStyle(e).fontSize))), outside.length];
        });"""
        where = window(390, 844)
        try:
            where.open((LECTURES / "4-tables.html").as_uri())
            for ring, text, outside in where.run(look):
                self.assertGreaterEqual(ring, 9)
                self.assertGreaterEqual(text, 9)
                self.assertEqual(outside, 0)
        finally:
            where.close()

    def test_the_index_is_as_wide_as_the_window_and_has_indices(self) -> None:
        for width, height, _ in SIZES.values():
            where = window(width, height)
            try:
                where.open((LECTURES / "index.html").as_uri())
                wide = where.run("return [...document.querySelectorAll('*')].filter((e) => e.scrollWidth > innerWidth || e.getBoundingClientRect().right > innerWidth).map((e) => e.textContent.slice(0, 30))")
                self.assertEqual(wide, [], width)
                self.assertEqual(where.run("return [...document.querySelectorAll('.list sub')].map((e) => e.textContent)"), ["_q", "_k"])
                if width < 500:
                    self.assertGreaterEqual(where.run("return Math.min(...[...document.querySelectorAll('a')].map((e) => e.getBoundingClientRect().height))"), 44)
            finally:
                where.close()

    def test_a_line_of_an_algorithm_with_an_index_is_one_line_of_text(self) -> None:
        def page(name: str) -> str:
            return (LECTURES / f"{name}.html").as_uri()

        where = window(1920, 1080)
        try:
            where.open(f"{page('5-reconnection')}#lesson=3")
            lines = where.run("""return [...document.querySelectorAll("#code li")].filter((li) => li.querySelector("sub")).map((li) => {
                const index = li.querySelector(".index");
                const text = document.createRange();
                text.selectNodeContents(index.previousSibling);
                return [li.children.length, li.textContent.trim(), index.getBoundingClientRect().left - text.getBoundingClientRect().right, new Set([...text.getClientRects()].map((r) => r.top)).size];
            })""")
            self.assertEqual([line[1] for line in lines], ["for each edge e_j of E", "recursion: remove e_j (Algorithm 4)", "for each face f_j of F", "multi-face removal of f_j"])
            for parts, text, gap, rows in lines:
                self.assertEqual((parts, rows), (1, 1), text)
                self.assertLess(gap, 2, text)
            where.open(f"{page('2-two-shells')}#lesson=2")
            self.assertEqual(where.run("return [...document.querySelectorAll('#code button sub')].map((e) => e.textContent)"), ["_i", "_i"])
            where.open("about:blank")
            where.open(f"{page('2-two-shells')}#step=8")
            self.assertIn("remove f_i at e'", where.run("return document.getElementById('caller').textContent"))
            self.assertEqual(where.run("return document.querySelector('#caller sub').textContent"), "_i")
        finally:
            where.close()

    def test_large_text_and_the_dark_go_on_to_the_next_page(self) -> None:
        tables = next(page for page in PAGES if page.name == "4-tables.html")
        looks = "const {size, theme} = document.documentElement.dataset; return [size, theme, document.getElementById('text-size').getAttribute('aria-pressed')]"
        where = window(1280, 720)
        try:
            where.open(tables.as_uri())
            self.assertEqual(where.run(looks), ["", "light", "false"])
            where.run("document.getElementById('text-size').click(), document.getElementById('theme').click()")
            cut = where.run("const h1 = document.querySelector('h1'); return h1.scrollWidth > h1.clientWidth + 1 || h1.scrollHeight > h1.clientHeight + 3 || getComputedStyle(h1).whiteSpace === 'nowrap'")
            self.assertFalse(cut, "the title")
            where.run("localStorage.clear()")  # as with a browser in which each file has its own
            where.run("document.getElementById('to-next').click()")
            self.assertTrue(where.wait_for("return location.pathname.endsWith('5-reconnection.html') && document.readyState === 'complete'"))
            self.assertEqual(where.run(looks), ["large", "dark", "true"])
            self.assertEqual(where.run("return location.search"), "")
            where.open(PAGES[0].as_uri())
            self.assertEqual(where.run(looks), ["large", "dark", "true"], "by storage")
            where.open((LECTURES / "index.html").as_uri())
            self.assertEqual(where.run("return [document.documentElement.dataset.theme, document.querySelector('a').search]"), ["dark", "?size=large&theme=dark"])
            where.open(f"{PAGES[0].as_uri()}?size=normal&theme=auto&other=1#lesson=2")
            self.assertEqual(where.run(looks), ["", "light", "false"])
            self.assertEqual(where.run("return location.search + location.hash"), "?other=1#lesson=2")
            self.quiet(where, "looks")
        finally:
            where.close()

    def test_what_is_pressed_on_a_phone_is_as_high_as_a_finger(self) -> None:
        """Lines of an algorithm are not: 16 of them would not fit into a window so."""
        low = """const isLow = (e) => e.getClientRects().length > 0 && !e.closest("#code") && e.getBoundingClientRect().height < 43.9;
            const low = () => [...document.querySelectorAll("button, a, input:not([type=checkbox]), label")].filter(isLow).map((e) => `${e.id} ${e.className} ${e.textContent}`);"""
        where = window(390, 844)
        try:
            for page in PAGES:
                where.open("about:blank")
                where.open(page.as_uri())
                self.assertEqual(where.run(low + "return lesson.steps.flatMap((step, n) => { goToLesson(n); return low(); })"), [], page.name)
                self.assertEqual(where.run(low + "return steps.flatMap((step, n) => { goTo(n); return low(); })"), [], f"{page.name}, all panels")
        finally:
            where.close()

    def test_all_panels_on_a_phone_have_one_bar_and_are_scrolled_by_a_finger_on_the_picture(self) -> None:
        look = """const isSeen = (e) => e.getClientRects().length > 0;
            const bars = [...document.querySelectorAll("nav")].filter((e) => isSeen(e) && getComputedStyle(e).position === "sticky");
            const button = document.getElementById("explore").getBoundingClientRect();
            const box = bars[0].getBoundingClientRect();
            return {bars: bars.map((e) => e.className), touch: ["canvas", "flat"].map((id) => getComputedStyle(document.getElementById(id)).touchAction),
              isIn: button.height > 0 && button.top >= box.top && button.bottom <= box.bottom && button.right <= box.right, low: innerHeight - box.bottom,
              focus: document.activeElement.id, wide: document.documentElement.scrollWidth};"""
        where = window(390, 844)
        try:
            where.open(f"{PAGES[1].as_uri()}#lesson=4")
            where.run("const button = document.getElementById('explore'); button.focus(); button.click()")
            self.assertEqual(where.run(look), {"bars": ["events"], "touch": ["pan-y", "pan-y"], "isIn": True, "low": 0, "focus": "explore", "wide": 390})
            where.run("document.getElementById('explore').click()")
            self.assertEqual(where.run("return location.hash"), "#lesson=4")
            back = where.run("return [...document.querySelectorAll('nav')].filter((e) => e.getClientRects().length > 0).map((e) => [e.className, ...[...e.querySelectorAll('button')].map((b) => b.id)])")
            self.assertEqual([bar for bar in back if bar[0] == "bar"], [["bar", "lesson-back", "explore", "lesson-next"]])
            self.assertNotIn("events", [bar[0] for bar in back])
            self.quiet(where, "one bar")
        finally:
            where.close()

    def test_the_colours_of_a_ring_are_named_below_it(self) -> None:
        for width, height, _ in SIZES.values():
            where = window(width, height)
            try:
                where.open(f"{PAGES[1].as_uri()}#lesson=4")
                told = "return [...document.querySelectorAll('#' + arguments[0] + ' li')].filter((e) => e.getClientRects().length > 0).map((e) => e.dataset.kind)"
                lines = where.run(told, "ring-legend")
                self.assertEqual([kind for kind in lines if kind not in ("edge", None)], ["skirt", "chord", "core"], width)
                for step in (0, 1, 3, 4, 5):
                    where.run("goToLesson(arguments[0])", step)
                    drawn = where.run("return document.body.dataset.drawn")
                    ring, picture = where.run(told, "ring-legend"), where.run(told, "legend")
                    if "ring" in drawn:
                        self.assertIn("skirt", ring, (width, step))
                    if "picture" in drawn:
                        self.assertLessEqual(set(where.run("return [...scene.kinds].filter((kind) => ['edge', 'face', 'ancestor', 'tet', 'vertex', 'visited'].includes(kind))")), set(picture), (width, step))
                    if drawn:
                        self.assertIn(None, ring + picture, f"the fills are told, too: {width}, {step}")
            finally:
                where.close()

    def test_no_panel_of_a_step_is_blank(self) -> None:
        where = window(1280, 720)
        try:
            for page in PAGES:
                where.open("about:blank")
                where.open(page.as_uri())
                blank = where.run("""return lesson.steps.flatMap((step, n) => {
                    goToLesson(n);
                    const code = document.querySelector(".code");
                    return code.getClientRects().length > 0 && document.querySelectorAll("#code li").length === 0 ? [n + 1] : [];
                })""")
                self.assertEqual(blank, [], page.name)
                for step in recording(page)["lesson"]["steps"]:
                    self.assertNotRegex(step["text"], r"flip.3.2|\w+_(transformation|removal|insertion)", page.name)
            where.open((LECTURES / "3-refusals.html").as_uri() + "#step=3")
            self.assertIn("0 3-2 flip 0-1", where.run("return document.getElementById('tree').textContent"))
        finally:
            where.close()

    def test_dashed_chords_are_spoken_of_where_there_are_any(self) -> None:
        captions = [(stage[2], len(data["shells"][stage[3]]["ring"])) for page in PAGES for data in [recording(page)] for call in data["calls"].values()
                    for stage in (data["shells"][call["shell"]] | call["made"] if "shell" in call else {}).get("stages", [])]
        triangles = [caption for caption, corners in captions if corners == 3 and caption.startswith("before: ")]
        self.assertGreater(len(triangles), 3)
        self.assertEqual([caption for caption in triangles if "chords" in caption], [])
        self.assertGreater(sum("dashed chords" in caption for caption, corners in captions if corners > 4), 3)

    def test_answers_are_those_of_the_trace_and_count_once(self) -> None:
        where = window(1920, 1080)
        kinds = set()
        try:
            for page in PAGES:
                steps = recording(page)["lesson"]["steps"]
                asked = [n for n, step in enumerate(steps, 1) if "ask" in step]
                for is_right in (True, False):
                    where.open("about:blank")
                    where.open(f"{page.as_uri()}#lesson=1")
                    for n in asked:
                        ask = steps[n - 1]["ask"]
                        where.run("goToLesson(arguments[0] - 1)", n)
                        for _ in range(2):  # the second time, nothing may change
                            self.answer(where, ask, is_right)
                        said = where.run("return document.getElementById('answered').textContent")
                        self.assertTrue(said.startswith("✓ Right." if is_right else "✗ Not so."), f"{page.name}, step {n}: {said}")
                        self.assertIn(ask["why"], said)
                        kinds.add(ask["kind"])
                    score = f"{len(asked) if is_right else 0} right of {len(asked)}"
                    self.assertIn(score, where.run("return document.getElementById('score').textContent"), page.name)
                self.quiet(where, page.name)
        finally:
            where.close()
        self.assertEqual(kinds, {"line", "accepted", "chord", "number"})

    def answer(self, where: browser.Browser, ask: dict, is_right: bool) -> None:
        """By the buttons that a reader has."""
        answer = ask["answer"]
        if ask["kind"] == "accepted":
            wanted = answer if is_right else not answer
            where.run("document.querySelectorAll('#choices button')[arguments[0] ? 0 : 1].click()", wanted)
        elif ask["kind"] == "line":
            line = answer if is_right else answer % where.run("return document.querySelectorAll('#code li').length") + 1
            where.run("document.querySelectorAll('#code button')[arguments[0] - 1].click()", line)
        elif ask["kind"] == "number":
            value = answer if is_right else answer + ask["within"] + 1
            where.run("const field = document.getElementById('number'); if (!field.disabled) field.value = arguments[0]; document.querySelector('#choices button').click()", str(value))
        else:
            chord = answer[0]
            if not is_right:
                ring = where.run("return [...document.querySelectorAll('#ring text[data-kind=corner]')].map((e) => Number(e.textContent))")
                chord = [ring[0], ring[1]]  # a side
            for vertex in chord:
                where.run("document.querySelector(`#ring [data-corner='${arguments[0]}']`)?.dispatchEvent(new MouseEvent('click', {bubbles: true}))", vertex)

    def test_a_page_tells_the_page_around_it_how_far_its_reader_is(self) -> None:
        course = WORK / "course.html"
        course.write_text(f"""<!DOCTYPE html><title>course</title><iframe id="lesson" src="{PAGES[1].as_uri()}" style="width: 1000px; height: 700px"></iframe>
            <script>const told = []; addEventListener("message", (event) => told.push(event.data));</script>""")
        where = window(1280, 800)
        try:
            where.open(course.as_uri())
            first = where.wait_for("return told.length > 0 && told[told.length - 1]")
            steps = recording(PAGES[1])["lesson"]["steps"]
            questions = sum("ask" in step for step in steps)
            self.assertEqual(first, {"from": "tetmend", "lesson": recording(PAGES[1])["lesson"]["title"], "step": 1, "steps": len(steps),
                                     "questions": questions, "answered": 0, "right": 0})
            # The course cannot reach into the page, as files are strangers to each other: keys can.
            where.run("document.getElementById('lesson').focus()")
            for kind in ("keyDown", "keyUp"):
                where.command("Input.dispatchKeyEvent", type=kind, key="n", text="n" if kind == "keyDown" else "")
            self.assertTrue(where.wait_for("return told[told.length - 1].step === 2"))
            self.quiet(where, "course")
        finally:
            where.close()

    def test_a_page_within_a_document_of_text_works_without_an_address(self) -> None:
        notebook = WORK / "notebook.html"
        text = PAGES[0].read_text().replace("&", "&amp;").replace('"', "&quot;")
        notebook.write_text(f"""<!DOCTYPE html><title>notebook</title><iframe srcdoc="{text}" style="width: 1000px; height: 700px"></iframe>
            <script>const told = []; addEventListener("message", (event) => told.push(event.data));</script>""")
        where = window(1280, 800)
        try:
            where.open(notebook.as_uri())
            self.assertTrue(where.wait_for("return told.length > 0"))
            where.run("document.querySelector('iframe').contentDocument.getElementById('lesson-next').click()")
            self.assertTrue(where.wait_for("return told[told.length - 1].step === 2"))
            self.quiet(where, "notebook")
        finally:
            where.close()

    def test_explore_has_all_panels_and_leads_back_to_the_step(self) -> None:
        where = window(1280, 800)
        try:
            where.open(f"{PAGES[1].as_uri()}#lesson=4")
            where.run("document.getElementById('explore').click()")
            self.assertRegex(where.run("return location.hash"), "#step=")
            seen = where.run("return ['.picture', '.told', '.code', '.ring', '.tree', '.events'].filter((e) => document.querySelector(e).getClientRects().length > 0).length")
            self.assertEqual(seen, 6)
            where.run("document.getElementById('explore').click()")
            self.assertEqual(where.run("return location.hash"), "#lesson=4")
            self.quiet(where, "explore")
        finally:
            where.close()


if __name__ == "__main__":
    if not browser.is_installed():
        print("stage_test: no chromium or chromedriver: skipped")
        sys.exit(SKIPPED)
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
