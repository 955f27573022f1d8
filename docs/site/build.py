# SPDX-License-Identifier: MIT
"""Makes the site: gathers the pages of docs/, adds those that the program and the headers speak for
themselves, and has Sphinx write HTML. Called by script/site."""

import argparse
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

from c_pages import write_c
from failure import Failure
from fortran_pages import write_fortran
from python_pages import write_python

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent

# What stands under each page, in this order. A new page of docs/ gets its place here: how to call tetmend from
# another language beside "library", all that there is to call beside "cpp".
NAVIGATION: dict[str, list[str]] = {
    "index": ["start", "install", "howto", "choosing", "report", "troubleshooting", "extending",
              "overview", "reliability", "results", "reference"],
    "howto": ["howto/stl", "howto/gmsh", "howto/paraview", "howto/fenicsx", "howto/calculix", "howto/su2", "howto/openfoam",
              "howto/dealii", "howto/mfem", "howto/moose", "howto/code_aster", "howto/simvascular", "howto/simnibs", "howto/others", "python", "library", "kernel", "c", "howto/ci", "layers", "surface", "sizes", "pieces", "viewer", "examples"],
    "extending": ["operators", "schedules", "trace", "contributing", "portability"],
    "overview": ["glossary", "deviations"],
    "results": ["experiments", "results/rivals", "results/schedules", "results/ablation", "results/promises", "results/adapted",
                "results/tangled", "results/renumbered", "results/reconnection", "results/angles",
                "results/constraints", "results/surface", "results/sizes", "results/solvers", "results/cores", "results/growth", "results/viewing", "results/kernel",
                "results/ranks", "results/files", "results/parts"],
    "reliability": ["results/coverage", "results/faults", "results/fuzzing"],
    "reference": ["command-line", "formats", "cpp", "python-reference", "c-reference", "fortran-reference", "viewer-words",
                  "dependencies", "changes"],
}
# Pages that are whole by themselves, and are copied as they are.
WHOLE = Path("docs/lectures")
# Files outside of docs/ that are pages of the site.
OUTSIDE = {"CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changes.md", "README.md": "index.md"}
# Pages that are not in docs/: what they say is said by the program, the headers and the bindings.
GENERATED = {"docs/command-line.md", "docs/cpp.md", "docs/python-reference.md", "docs/c-reference.md",
             "docs/fortran-reference.md"}
COMMANDS = ["improve", "adapt", "pieces", "quality", "check", "convert", "surface", "operators", "schedules", "trace", "lesson",
            "check-plugin"]


# --- pages that are written by hand

FENCE = re.compile(r"^(```.*?^```[^\n]*$)", re.M | re.S)
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s#]*)(#[^()\s]*)?\)")
COMMENT = re.compile(r"<!--.*?-->\n?", re.S)  # the empty line below stays: it ends a table


def place_of(target: Path) -> Path | None:
    """Where the site has a file of the repository; None: nowhere."""
    name = target.as_posix()
    if name in OUTSIDE:
        return Path(OUTSIDE[name])
    if name in GENERATED or name.startswith("docs/") and (ROOT / target).is_file():
        return target.relative_to("docs")
    return None


def with_links_of_the_site(text: str, source: Path) -> str:
    """Links lead to pages of the site; what is not there, such as a header, is named without a link.
    `source` is the file, from the root of the repository."""
    here = place_of(source)

    def replaced(found: re.Match) -> str:
        image, words, target, anchor = found.groups()
        if not target or "://" in target or target.startswith("mailto:"):
            return found[0]
        path = Path(os.path.normpath(source.parent / target))
        if path.as_posix() not in GENERATED and not (ROOT / path).exists():
            raise Failure(f"{source}: there is no {target}")
        place = place_of(path)
        if path.is_relative_to(WHOLE):  # Sphinx would take it for a file to be saved
            return f'<a href="{os.path.relpath(place, here.parent)}">{words}</a>'
        if place is None:
            return words if not image else found[0]
        return f"{image}[{words}]({os.path.relpath(place, here.parent)}{anchor or ''})"

    text = re.sub(r"^```geo\b.*", "```text", text, flags=re.M)  # Pygments does not know the language of Gmsh
    parts = FENCE.split(text)
    for i in range(0, len(parts), 2):  # between the fenced blocks
        parts[i] = LINK.sub(replaced, COMMENT.sub("", parts[i]))
    return "".join(parts)


def gather(pages: Path) -> None:
    """Copies docs/ and the pages outside of it."""
    sources = [path.relative_to(ROOT) for path in sorted((ROOT / "docs").rglob("*"))
               if path.is_file() and HERE not in path.parents and ROOT / WHOLE not in path.parents]
    sources += [Path(name) for name in OUTSIDE if name != "README.md"]
    for source in sources:
        place = pages / place_of(source)
        place.parent.mkdir(parents=True, exist_ok=True)
        if source.suffix == ".md":
            place.write_text(with_links_of_the_site((ROOT / source).read_text(), source))
        else:
            shutil.copyfile(ROOT / source, place)


def add_navigation(pages: Path) -> None:
    for name, below in NAVIGATION.items():
        prefix = "../" * name.count("/")
        entries = "".join(f"{prefix}{entry}\n" for entry in below)
        with (pages / f"{name}.md").open("a") as page:
            page.write(f"\n```{{toctree}}\n:hidden:\n\n{entries}```\n")


# --- the command line

ENTRY = re.compile(r"^( {2,4})(\S.*?)(?:\s{2,}(\S.*))?$")


def help_of(program: Path, *words: str) -> str:
    done = subprocess.run([program, *words, "--help"], capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(f"{program} {' '.join(words)} --help ended with status {done.returncode}")
    return done.stdout


def signature(names: str) -> str:
    """'-o,--output OUT' as Sphinx wants it: '-o OUT, --output OUT'."""
    flags, _, value = names.partition(" ")
    value = value.partition(":")[0].strip()  # CLI11 adds a type and a range
    return ", ".join(f"{flag} {value}".strip() for flag in flags.split(","))


def entries_of(lines: list[str]) -> list[tuple[str, str]]:
    """Names and texts of a list such as 'Options:'; the text begins behind the names or below."""
    found: list[tuple[str, str]] = []
    for line in lines:
        entry = ENTRY.match(line)
        if entry and len(entry[1]) <= 4:
            found.append((entry[2], entry[3] or ""))
        elif found:
            name, text = found[-1]
            found[-1] = (name, f"{text} {line.strip()}".strip())
    return found


def escaped(text: str) -> str:
    return re.sub(r"([\\`*_<>\[\]|])", r"\\\1", text)


def paragraph(lines: list[str]) -> str:
    """Prose, or, with anything indented, a block that keeps its lines."""
    if any(line.startswith("  ") for line in lines):
        return "```\n" + "\n".join(lines) + "\n```\n"
    return escaped(" ".join(lines)) + "\n"


def section(title: str, text: str) -> str:
    """What a command says about itself, as Markdown."""
    out = [f"## {title}\n", f"```{{program}} {title}\n```\n"]
    for block in re.split(r"\n\s*\n", text.strip("\n")):
        lines = block.split("\n")
        head = lines[0].strip()
        lists = len(lines) > 1 and (head == "Arguments:" or re.match(r"  -", lines[1]))
        if head.startswith("Usage:"):
            out.append(f"```\n{head.removeprefix('Usage: ')}\n```\n")
        elif lists:
            if head not in ("Options:", "Arguments:"):
                out.append(f"**{escaped(head.removesuffix(':'))}**\n")
            for names, words in entries_of(lines[1:]):
                if names.startswith("-"):
                    out.append(f"````{{option}} {signature(names)}\n{escaped(words)}\n````\n")
                else:
                    out.append(f"`{names}`\n: {escaped(words)}\n")
        elif head == "Subcommands:":
            for name, words in entries_of(lines[1:]):
                out.append(f"[`{title} {name}`](#{title}-{name})\n: {escaped(words)}\n")
        else:
            if lines[0].endswith(":") and len(lines) > 1 and lines[1].startswith("  "):
                out.append(f"{escaped(lines[0])}\n")
                lines = lines[1:]
            out.append(paragraph(lines))
    return "\n".join(out)


def options_of(program: Path, command: str) -> dict[str, str]:
    """What it says of its options, by their names with _ for -."""
    found = {}
    for names, words in entries_of(help_of(program, command).splitlines()):
        long_name = re.search(r"--([a-z-]+)", names)
        if long_name and names.startswith("-"):
            found[long_name[1].replace("-", "_")] = escaped(words)
    return found


def write_command_line(page: Path, program: Path) -> None:
    parts = ["# The command line\n",
             "What each command says with `--help`. This page is made from that.\n",
             section("tetmend", help_of(program))]
    parts += [section(f"tetmend {name}", help_of(program, name)) for name in COMMANDS]
    page.write_text("\n".join(parts))


# --- the C++ reference

DIRECTIVES = {"enum": "doxygenenum", "variable": "doxygenvariable", "define": "doxygendefine",
              "typedef": "doxygentypedef", "function": "doxygenfunction"}


def declarations(xml: Path, header: Path) -> list[str]:
    """A directive of Breathe for each declaration of a header, in its order."""
    name = header.stem.replace("_", "__")  # as Doxygen writes it
    file = ElementTree.parse(xml / f"{name}_8h.xml").find("compounddef")
    spaces = {inner.text: ElementTree.parse(xml / f"{inner.get('refid')}.xml").find("compounddef")
              for inner in file.findall("innernamespace")}
    found: list[tuple[int, str, str]] = []
    for inner in file.findall("innerclass"):
        definition = ElementTree.parse(xml / f"{inner.get('refid')}.xml").find("compounddef")
        if inner.text.rpartition("::")[0] in spaces:  # a nested class stands in its outer one
            found.append((int(definition.find("location").get("line")), f"doxygen{definition.get('kind')}", inner.text))
    members_of = [*file.iter("memberdef"), *(each for space in spaces.values() for each in space.iter("memberdef"))]
    for member in members_of:
        place = member.find("location")
        if place.get("file").endswith(f"include/tetmend/{header.name}"):
            name = member.findtext("name") if member.get("kind") == "define" else member.findtext("qualifiedname")
            arguments = member.findtext("argsstring") if member.get("kind") == "function" else ""
            found.append((int(place.get("line")), DIRECTIVES[member.get("kind")], name + arguments))
    if not found:
        raise Failure(f"{header}: Doxygen finds no declaration")
    members = {"doxygenstruct", "doxygenclass"}
    return [f"## {name.partition('(')[0].removeprefix('tetmend::')}\n\n"
            f"```{{{directive}}} {name}\n{':members:' if directive in members else ''}\n```\n"
            for _, directive, name in sorted(set(found))]


def purpose_of(header: Path) -> str:
    """The first paragraph of its comment."""
    lead = re.match(r"// SPDX[^\n]*\n((?:// [^\n]*\n)+)", header.read_text())
    if not lead:
        raise Failure(f"{header}: no comment says what it is for")
    return " ".join(line.removeprefix("// ") for line in lead[1].splitlines())


# What a program calls, in the order in which it does.
VERBS = [("read and write a mesh", "load(), save()", "io"), ("make one of arrays", "Mesh", "mesh"), ("measure it", "measure()", "measure"),
         ("improve it", "improve()", "improve"), ("improve it again and again, in a solver's loop", "Improver", "improve"),
         ("have edges of wanted lengths", "adapt()", "improve"), ("check it against thresholds or its input", "check(), compare()", "check"),
         ("read a recorded run", "Trace", "trace")]


def verbs() -> str:
    """@throws Failure where a header does not have the name"""
    rows = []
    for what, names, header in VERBS:
        text = (ROOT / f"include/tetmend/{header}.h").read_text()
        for name in re.findall(r"\w+", names):
            if not re.search(rf"\b{name}\b", text):
                raise Failure(f"docs/site/build.py: {header}.h has no {name}")
        rows.append(f"| {what} | `{names}` | [`{header}.h`](cpp/{header}.md) |\n")
    return "| To | Call | Header |\n|---|---|---|\n" + "".join(rows)


def write_cpp(pages: Path, xml: Path) -> None:
    """A page for each public header, and one that lists them."""
    rows = []
    (pages / "cpp").mkdir()
    headers = sorted((ROOT / "include" / "tetmend").glob("*.h"))
    headers = [header for header in headers if header.name not in ("api.h", "tetmend.h")]  # a mark; for C
    for header in headers:
        text = purpose_of(header)
        parts = [f"# {header.name}\n", f"{text}\n", f"```cpp\n#include <tetmend/{header.name}>\n```\n"]
        (pages / "cpp" / f"{header.stem}.md").write_text("\n".join(parts + declarations(xml, header)))
        rows.append(f"| [`{header.name}`](cpp/{header.stem}.md) | {text} |\n")
    NAVIGATION["cpp"] = [f"cpp/{header.stem}" for header in headers]
    (pages / "cpp.md").write_text(
        "# The C++ reference\n\nAll that the public headers declare, `<tetmend/...>`, in the namespace `tetmend`. "
        "[The C++ library](library.md) is the place to begin.\n\n" + verbs() + "\n| Header | Content |\n|---|---|\n" + "".join(rows))


def run_doxygen(folder: Path, more_settings: str = "") -> None:
    folder.mkdir(exist_ok=True)
    settings = (HERE / "Doxyfile").read_text() + f"\nOUTPUT_DIRECTORY = {folder}\n{more_settings}"
    done = subprocess.run(["doxygen", "-"], input=settings, cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure("Doxygen: " + (done.stderr.strip().splitlines() or ["failed"])[0])
    for file in (folder / "xml").glob("*.xml"):  # the value of a table is no part of a reference
        file.write_text(re.sub(r"<initializer>[^<]{120,}</initializer>", "", file.read_text()))


# --- the whole


# tetmend.h has another language than the other headers.
FOR_C = """INPUT = include/tetmend/tetmend.h
EXCLUDE =
OPTIMIZE_OUTPUT_FOR_C = YES
TYPEDEF_HIDES_STRUCT = YES
"""


def run_sphinx(pages: Path, output: Path, work: Path) -> None:
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-c", str(HERE),
               "-d", str(work / "doctrees"), "-D", f"breathe_projects.tetmend={work / 'xml'}",
               "-D", f"breathe_projects.tetmend_c={work / 'c' / 'xml'}", str(pages), str(output)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.stderr.write(done.stderr.replace(f"{pages}/", ""))
        raise Failure("Sphinx found what stands above")


NORMALIZE = [Path("/usr/share/nodejs/normalize.css/normalize.css"),
             Path("/usr/share/javascript/normalize.css/normalize.css")]


def complete_theme(static: Path) -> None:
    """Debian's Furo has its style and its script in two parts each, of which a browser finds the second only on a
    server that is set up for it, or never. Here both are one."""
    style = static / "styles" / "furo.css"
    text = style.read_text()
    wanted = "@import url(/javascript/normalize.css/normalize.css);"
    if wanted in text:
        found = [path for path in NORMALIZE if path.exists()]
        if not found:
            raise Failure("normalize.css is missing; script/bootstrap --site installs it")
        style.write_text(text.replace(wanted, found[0].read_text()))
    script = static / "scripts" / "furo.js"
    text = script.read_text()
    wanted = 'import Gumshoe from "./gumshoe-patched.js";'
    if wanted in text:
        script.write_text((static / "scripts" / "gumshoe-patched.js").read_text() + text.replace(wanted, ""))


def text_of(page: Path) -> str:
    """The words of its article."""
    [article] = re.findall(r'<article role="main">(.*?)</article>', page.read_text(), re.S)
    article = re.sub(r'<a class="headerlink".*?</a>|<(script|style).*?</\1>', "", article, flags=re.S)
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", article)).split())


def add_texts(site: Path) -> None:
    """A browser lets no page that was opened as a file read others, so that of the search has their words beside it."""
    texts = {page.relative_to(site).as_posix(): text_of(page) for page in sorted(site.rglob("*.html")) if page.name != "search.html"}
    (site / "_static" / "texts.js").write_text(f"const TETMEND_TEXTS = {json.dumps(texts, ensure_ascii=False)};\n")
    search = site / "search.html"
    wanted = '<script src="_static/search.js"></script>'
    text = search.read_text()
    if wanted not in text:
        raise Failure("search.html does not load search.js: the search would show titles alone")
    search.write_text(text.replace(wanted, f'<script src="_static/texts.js"></script>\n    {wanted}'))


def build(output: Path, program: Path) -> int:
    """The number of pages. `output` is replaced when all of them are there."""
    if not os.access(program, os.X_OK):
        raise Failure(f"there is no program {program}; script/demo builds it, --program names another")
    if shutil.which("doxygen") is None:
        raise Failure("doxygen is missing; script/bootstrap --site installs it")
    output.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".site-", dir=output.parent) as name:
        work = Path(name)
        pages = work / "pages"
        gather(pages)
        write_command_line(pages / "command-line.md", program)
        run_doxygen(work)
        run_doxygen(work / "c", FOR_C)
        write_cpp(pages, work / "xml")
        write_python(pages / "python-reference.md", options_of(program, "improve"))
        write_c(pages / "c-reference.md", work / "c" / "xml")
        write_fortran(pages / "fortran-reference.md")
        add_navigation(pages)
        run_sphinx(pages, work / "html", work)
        complete_theme(work / "html" / "_static")
        add_texts(work / "html")
        shutil.copytree(ROOT / WHOLE, work / "html" / WHOLE.name)
        for unused in ["objects.inv", ".buildinfo"]:
            (work / "html" / unused).unlink(missing_ok=True)
        if output.exists():
            if not (output / "searchindex.js").exists():
                raise Failure(f"{output} is no older site; remove it first")
            output.rename(work / "old")
        (work / "html").rename(output)
    return len(list(output.rglob("*.html")))


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="script/site",
        description="Writes the documents as a site that needs no server: open its index.html in a browser.")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build" / "site",
                        help="folder (default: build/site)")
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "release" / "bin" / "tetmend",
                        help="whose --help is quoted (default: build/release/bin/tetmend)")
    arguments = parser.parse_args()
    try:
        count = build(arguments.output.resolve(), arguments.program.resolve())
    except (Failure, OSError) as error:
        print(f"site: {error}", file=sys.stderr)
        return 1
    print(f"{count} pages: {arguments.output}/index.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
