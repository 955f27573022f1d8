# SPDX-License-Identifier: MIT
"""The site that script/site makes: whole, at home on a phone, in the dark and without a network.

    site_test.py SOURCE TETMEND WORK     WORK: a folder that this test may empty

Exit status 77: what script/site needs is not installed. Without Chromium the pages are read as files alone.
"""

import http.server
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from functools import cache, partial
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import browser

SKIPPED = 77
SOURCE, TETMEND, WORK = (Path(argument).resolve() for argument in sys.argv[1:4])
SCRIPT = SOURCE / "script" / "site"
SITE = WORK / "site"
PHONE = (390, 844)
DESK = (1280, 900)
EMPTY_ELEMENTS = {"img", "br", "hr", "input", "link", "meta", "col"}
# Boxes that scroll sideways: only programs and tables may.
SCROLLS_SIDEWAYS = """return [...document.querySelectorAll("body *")].filter(box => box.scrollWidth > box.clientWidth + 1
    && ["auto", "scroll", "hidden"].includes(getComputedStyle(box).overflowX) && box.offsetWidth > 1
    && !box.matches("pre, .highlight, .table-wrapper, .sidebar-drawer *, .toc-drawer *")).map(box => box.outerHTML.slice(0, 80))"""
# Reached from the page that they belong to; a reader has no need of them on the first day.
DEEP = re.compile(r"(results|cpp)/.*")


def script(*arguments: object, **options: object) -> subprocess.CompletedProcess:
    return subprocess.run([SCRIPT, *map(str, arguments)], capture_output=True, text=True, timeout=300, **options)


class Page(HTMLParser):
    """Anchors, links and words of a page."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []         # of <a>
        self.links_of_text: list[str] = []  # of them, those of the article
        self.loaded: list[str] = []        # what a browser fetches by itself
        self.words: list[str] = []
        self.depth_of_article = 0
        self.is_hidden = False
        self.feed(file.read_text())

    def handle_starttag(self, tag: str, attributes: list) -> None:
        named = dict(attributes)
        self.anchors |= {named[key] for key in ("id", "name") if named.get(key)}
        if tag == "article" or (self.depth_of_article and tag not in EMPTY_ELEMENTS):
            self.depth_of_article += 1
        if tag == "a" and named.get("href"):
            self.links.append(named["href"])
            if self.depth_of_article:
                self.links_of_text.append(named["href"])
        elif tag == "link" and named.get("href") and named.get("rel") not in ("index", "search", "next", "prev"):
            self.loaded.append(named["href"])
        elif named.get("src"):
            self.loaded.append(named["src"])
        self.is_hidden = tag in ("script", "style", "title")

    def handle_endtag(self, tag: str) -> None:
        if self.depth_of_article and tag not in EMPTY_ELEMENTS:  # <img/> is told as a beginning and an end
            self.depth_of_article -= 1
        self.is_hidden = False

    def handle_data(self, data: str) -> None:
        if not self.is_hidden and self.depth_of_article:
            self.words += re.findall(r"[A-Za-z]+", data)


@cache
def pages() -> dict[str, Page]:
    """Without those of the lecture, which are made elsewhere and have a test of their own."""
    return {file.relative_to(SITE).as_posix(): Page(file) for file in sorted(SITE.rglob("*.html")) if file.parent != SITE / "lectures"}


def target(page: str, link: str) -> tuple[str, str]:
    """File, from the root of the site, and anchor."""
    path, _, anchor = link.partition("#")
    path = path.partition("?")[0]
    return os.path.normpath(os.path.join(os.path.dirname(page), unquote(path))) if path else page, unquote(anchor)


def is_outside(link: str) -> bool:
    return bool(re.match(r"[a-z]+:|//", link))


class Script(unittest.TestCase):
    def test_help_is_printed_from_any_folder(self) -> None:
        done = script("--help", cwd="/")
        self.assertEqual(done.returncode, 0)
        self.assertIn("--program", done.stdout)

    def fails_with_one_line(self, done: subprocess.CompletedProcess, *words: str) -> None:
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_without_the_program_it_ends_with_one_line_and_leaves_the_older_site(self) -> None:
        before = (SITE / "index.html").stat()
        self.fails_with_one_line(script("--program", WORK / "nothing", "-o", SITE), "nothing", "script/demo")
        self.assertEqual((SITE / "index.html").stat(), before)
        self.assertEqual([path.name for path in WORK.iterdir()], ["site"])

    def test_without_doxygen_it_ends_with_one_line(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for name in ("bash", "dirname", "python3"):
                (Path(folder) / name).symlink_to(shutil.which(name))
            done = script("--program", TETMEND, "-o", SITE, env=dict(os.environ, PATH=folder))
        self.fails_with_one_line(done, "doxygen", "script/bootstrap --site")

    def test_a_folder_with_something_else_is_not_replaced(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "thesis").write_text("years")
            self.fails_with_one_line(script("--program", TETMEND, "-o", folder), folder)
            self.assertEqual((Path(folder) / "thesis").read_text(), "years")


class Files(unittest.TestCase):
    def test_each_document_has_a_page(self) -> None:
        documents = {file.relative_to(SOURCE / "docs").with_suffix(".html").as_posix()
                     for file in (SOURCE / "docs").rglob("*.md")}
        self.assertGreater(len(documents), 40)
        self.assertEqual(documents - set(pages()), set())

    def test_the_lecture_is_there_as_it_is_and_the_first_page_leads_to_it(self) -> None:
        for page in (SOURCE / "docs/lectures").iterdir():
            self.assertEqual((SITE / "lectures" / page.name).read_bytes(), page.read_bytes())
        self.assertIn("lectures/index.html", pages()["index.html"].links_of_text)

    def test_each_header_of_the_library_has_a_page_with_what_it_declares(self) -> None:
        for header in (SOURCE / "include/tetmend").glob("*.h"):
            if header.name in ("api.h", "tetmend.h"):  # a mark; for C, below
                continue
            anchors = pages()[f"cpp/{header.stem}.html"].anchors
            for name in re.findall(r"^(?:struct|class|enum class)(?: TETMEND_API)? (\w+)\b(?!;)", header.read_text(), re.M):
                has_name = any(anchor.endswith(f"{len(name)}{name}E") for anchor in anchors)  # a mangled one
                self.assertTrue(has_name, f"{header.name}: {name}")

    def test_all_that_the_python_package_offers_is_in_its_reference(self) -> None:
        page = pages()["python-reference.html"]
        package = SOURCE / "bindings/python/tetmend"
        [names] = re.findall(r"__all__ = \[(.*?)\]", (package / "__init__.py").read_text(), re.S)
        for name in set(re.findall(r'"(\w+)"', names)) - {"__version__"}:
            self.assertIn(f"tetmend.{name}", page.anchors)
        for name in ("Result.vertex_map", "Mesh.points", "Progress.share", "Trace.calls", "gmsh.improve", "pyvista.Accessor.quality"):
            self.assertIn(f"tetmend.{name}", page.anchors)
        options = (package / "_options.py").read_text().partition("class Options")[2].partition("\n\n\n")[0]
        text = (SITE / "python-reference.html").read_text()
        for name in re.findall(r"^    (\w+): ", options, re.M):
            self.assertRegex(text, rf"<dt>(<p>)?<code[^>]*><span class=\"pre\">{name}</span>", name)

    def test_all_that_tetmend_h_declares_is_in_the_reference_of_c(self) -> None:
        anchors = pages()["c-reference.html"].anchors
        functions = (SOURCE / "bindings/c/names.txt").read_text().split()
        types = re.findall(r"^} (tetmend_\w+);", (SOURCE / "include/tetmend/tetmend.h").read_text(), re.M)
        self.assertGreater(len(types), 7)
        for name in [*functions, *types, "tetmend_progress_function", "tetmend_statistics.n_bad", "TETMEND_RULERS"]:
            self.assertIn(f"c.{name}", anchors)

    def test_all_procedures_of_the_fortran_module_are_in_its_reference(self) -> None:
        anchors = pages()["fortran-reference.html"].anchors
        names = re.findall(r"^    (?:procedure|generic), public :: (\w+)", (SOURCE / "bindings/fortran/tetmend.f90").read_text(), re.M)
        self.assertGreater(len(names), 25)
        for name in names:
            self.assertIn(name.replace("_", "-"), anchors)
        text = (SITE / "fortran-reference.html").read_text()
        for call in ("mesh%create()", "tetmend_set_group()"):
            self.assertIn(call, re.sub(r"<[^>]*>", "", text))

    def test_each_option_of_the_command_line_has_an_anchor(self) -> None:
        anchors = pages()["command-line.html"].anchors
        for command in ("improve", "check", "trace"):
            text = subprocess.run([TETMEND, command, "--help"], capture_output=True, text=True, check=True).stdout
            for option in set(re.findall(r"^ {2,4}(?:-\w,)?--([a-z-]+)", text, re.M)):
                self.assertIn(f"cmdoption-tetmend-{command}-{option}", anchors)

    def test_links_and_anchors_lead_somewhere(self) -> None:
        checked = 0
        for name, page in pages().items():
            for link in page.links + page.loaded:
                if is_outside(link):
                    continue
                file, anchor = target(name, link)
                self.assertTrue((SITE / file).is_file(), f"{name}: {link}")
                if anchor and file in pages():
                    self.assertIn(anchor, pages()[file].anchors, f"{name}: {link}")
                checked += 1
        self.assertGreater(checked, 1000)

    def test_nothing_is_loaded_from_elsewhere(self) -> None:
        for name, page in pages().items():
            outside = [link for link in page.loaded if is_outside(link) and not link.startswith("data:")]
            self.assertEqual(outside, [], name)
        for style in SITE.rglob("*.css"):
            for address in re.findall(r"(?:url\(|@import\s+)[\"']?([^\"')\s;]+)", style.read_text()):
                self.assertRegex(address, r"^(data:|#|[\w./-]+$)(?!/)", style.name)
                if not address.startswith(("data:", "#")):
                    self.assertTrue((style.parent / address).exists(), f"{style.name}: {address}")

    def test_no_entity_is_shown_as_it_is_written(self) -> None:
        for file in SITE.rglob("*.html"):
            self.assertNotRegex(file.read_text(), r"&amp;(#\d+|[a-z]+);", file.name)

    def test_what_is_needed_on_the_first_day_is_two_clicks_away(self) -> None:
        clicks = {"index.html": 0}
        for distance in (1, 2):
            for name in [name for name, so_far in clicks.items() if so_far == distance - 1]:
                for link in pages()[name].links_of_text:
                    if not is_outside(link) and target(name, link)[0] in pages():
                        clicks.setdefault(target(name, link)[0], distance)
        far = set(pages()) - set(clicks) - {"search.html"}
        self.assertEqual({name for name in far if not DEEP.match(name)}, set())


class Server:
    """The site at an address of this machine."""

    def __enter__(self) -> str:
        class Handler(http.server.SimpleHTTPRequestHandler):
            def log_message(self, *_: object) -> None:
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=SITE))
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return f"http://127.0.0.1:{self.server.server_port}"

    def __exit__(self, *_: object) -> None:
        self.server.shutdown()
        self.server.server_close()


@unittest.skipUnless(browser.is_installed(), "chromium and chromium-driver are not installed: no page is looked at")
class Shown(unittest.TestCase):
    def looked_at(self, window: browser.Browser, address: str) -> None:
        """Opens it; it must not complain, or ask anybody for anything."""
        window.open(address)
        self.assertEqual(window.complaints(), [], address)
        base = address[:address.index("/", len("http://"))]
        elsewhere = [url for url in window.requests() if not url.startswith((base, "file:", "data:", "chrome:"))]
        self.assertEqual(elsewhere, [], address)

    def open_window(self, size: tuple[int, int], dark: bool = False) -> browser.Browser:
        window = browser.Browser(*size, dark)
        self.addCleanup(window.close)
        window.open("about:blank")
        window.requests()  # those of the first empty page
        return window

    def test_on_a_phone_no_page_scrolls_sideways_complains_or_asks_the_network(self) -> None:
        window = self.open_window(PHONE)
        for name in pages():
            self.looked_at(window, f"file://{SITE}/{name}")
            self.assertEqual(window.run("return [innerWidth, document.documentElement.scrollWidth]"), [390, 390], name)
            self.assertEqual(window.run(SCROLLS_SIDEWAYS), [], name)

    def lightness(self, window: browser.Browser) -> tuple[float, float]:
        """Of text and ground, 0 to 1."""
        colours = window.run("const s = getComputedStyle(document.body); return [s.color, s.backgroundColor]")
        text, ground = (sum(map(float, re.findall(r"[\d.]+", colour)[:3])) / 765 for colour in colours)
        return text, ground

    def test_it_is_dark_where_the_system_is_and_a_button_makes_it_light(self) -> None:
        window = self.open_window(DESK, dark=True)
        self.looked_at(window, f"file://{SITE}/start.html")
        text, ground = self.lightness(window)
        self.assertGreater(text - ground, 0.6)
        window.run("document.querySelector('.theme-toggle').click()")
        text, ground = self.lightness(window)
        self.assertLess(text - ground, -0.6)

    def test_on_a_light_system_it_is_light(self) -> None:
        window = self.open_window(DESK)
        self.looked_at(window, f"file://{SITE}/start.html")
        text, ground = self.lightness(window)
        self.assertLess(text - ground, -0.6)

    def test_on_paper_it_is_light_and_without_navigation(self) -> None:
        window = self.open_window(DESK, dark=True)
        self.looked_at(window, f"file://{SITE}/start.html")
        window.command("Emulation.setEmulatedMedia", media="print",
                       features=[{"name": "prefers-color-scheme", "value": "dark"}])
        text, ground = self.lightness(window)
        self.assertLess(text - ground, -0.6)
        for part in (".sidebar-drawer", ".toc-drawer", ".related-pages", ".theme-toggle"):
            self.assertEqual(window.run("return document.querySelector(arguments[0])?.offsetHeight ?? 0", part), 0, part)
        self.assertTrue(window.printed().startswith(b"%PDF"))

    def rare_words(self) -> list[tuple[str, str]]:
        """Words that stand on one page only, with the page: one of each of some pages."""
        on: dict[str, set[str]] = {}
        for name, page in pages().items():
            for word in page.words:
                on.setdefault(word.lower(), set()).add(name)
        found = {}
        for word in sorted(on):
            if len(on[word]) == 1 and 7 <= len(word) <= 12:
                found.setdefault(min(on[word]), word)
        return [(word, name) for name, word in found.items() if name.startswith(("howto/", "start", "formats"))]

    def results(self, window: browser.Browser, address: str, word: str) -> list[str]:
        self.looked_at(window, f"{address}/search.html?q={word}")
        window.wait_for("return document.querySelector('#search-results ul.search li') && "
                        "/finished/i.test(document.querySelector('#search-results').innerText)")
        return window.run("return [...document.querySelectorAll('#search-results ul.search li a')].map(a => a.href)")

    def test_a_search_finds_a_word_that_stands_on_one_page(self) -> None:
        words = self.rare_words()
        self.assertGreater(len(words), 3)
        window = self.open_window(DESK)
        for word, name in words:
            found = self.results(window, f"file://{SITE}", word)
            self.assertTrue(any(f"/{name}" in address for address in found), f"{word} of {name}: {found}")
            self.assertEqual(window.complaints(), [])

    # Of a word: a page that must be among the first four.
    WANTED = {"gmsh": "howto/gmsh", "schedule": "choosing", "paraview": "howto/paraview", "quality": "howto/gmsh", "labels": "howto/paraview",
              "goal": "choosing", "improve": "start", "boundary layers": "layers"}

    def test_a_search_lists_what_shows_how_before_the_references(self) -> None:
        window = self.open_window(DESK)
        for word, page in self.WANTED.items():
            found = [address.partition(f"{SITE}/")[2].partition(".html")[0]
                     for address in self.results(window, f"file://{SITE}", word.replace(" ", "+"))]
            self.assertIn(page, found[:4], word)
            references = [place for place, name in enumerate(found) if name.startswith("cpp/") or name.endswith("-reference")]
            self.assertGreater(min(references, default=9), 2, f"{word}: {found[:8]}")
        for name, page in {"tetmend_set_group": "c-reference", "Result.vertex_map": "python-reference"}.items():
            self.assertIn(f"/{page}.html", self.results(window, f"file://{SITE}", name)[0])

    def test_a_search_of_a_site_that_was_opened_as_a_file_shows_where_the_word_stands(self) -> None:
        window = self.open_window(DESK)
        for word, name in self.rare_words()[:4]:
            self.results(window, f"file://{SITE}", word)
            text = window.wait_for("return document.querySelector('#search-results .context')?.innerText")
            self.assertIn(word, (text or "").lower(), name)
            self.assertEqual(window.complaints(), [])

    def test_the_first_page_has_a_command_a_number_and_a_picture_above_the_fold(self) -> None:
        for size in ((1280, 800), PHONE):
            for dark in (False, True):
                window = self.open_window(size, dark)
                self.looked_at(window, f"file://{SITE}/index.html")
                for what, words in {"article pre": "tetmend improve", "article th": "4,556", "article img": ""}.items():
                    text, bottom, fold = window.run("const box = document.querySelector(arguments[0]); "
                                                    "return [box.innerText, box.getBoundingClientRect().bottom, innerHeight]", what)
                    self.assertIn(words, text or "")
                    self.assertLessEqual(bottom, fold, f"{what} at {size}")

    def test_from_a_server_a_search_shows_where_the_word_stands(self) -> None:
        word, name = self.rare_words()[0]
        window = self.open_window(DESK)
        with Server() as address:
            self.assertTrue(any(f"/{name}" in found for found in self.results(window, address, word)))
            text = window.wait_for("return document.querySelector('#search-results .context')?.innerText")
            self.assertIn(word, (text or "").lower())
            self.assertEqual(window.complaints(), [])


def main() -> None:
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    done = script("--program", TETMEND, "-o", SITE, cwd="/")
    if done.returncode != 0:
        print(done.stderr, end="")
        sys.exit(SKIPPED if "script/bootstrap --site" in done.stderr else 1)
    unittest.main(argv=sys.argv[:1])


if __name__ == "__main__":
    main()
