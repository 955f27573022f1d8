# SPDX-License-Identifier: MIT
"""Writes the pages of docs that quote measured figures: each template of bench/pages, with the
figures of the tables in docs/results in place.

A figure is a place in a table: {FILE / ROW / COLUMN}, where ROW is what the row begins with, cell
by cell. If the tables of a file have a heading each, ROW begins with that heading.
{rivals / tire / best rival / COLUMN} is the row of the improver, tetmend apart, that leaves the
fewest bad tets. {FILE / ROW / COLUMN, alone} is the cell without what it has in brackets.

bench/pages/parts has pieces that stand in several documents, each between <!-- NAME --> and
<!-- /NAME -->; their links are those of docs/.
"""

import argparse
import re
import sys
import textwrap
from pathlib import Path

import documents

TEMPLATES = documents.ROOT / "bench" / "pages"
DOCS = documents.ROOT / "docs"
WITH_PARTS = [documents.ROOT / "README.md", DOCS / "index.md"]
BEST_RIVAL = "best rival"


def is_rival(row: list[str], bad: int) -> bool:
    return not row[0].startswith(("(input)", "tetmend")) and row[bad] != ""


def best_rival(table: documents.Table) -> list[str]:
    bad = table[0].index("bad")
    rivals = [row for row in table[1:] if is_rival(row, bad)]
    return min(rivals, key=lambda row: int(row[bad].split(", ")[0].replace(",", "")))


def under_heading(keys: list[str], heading: str, table: documents.Table) -> list[list[str]]:
    return [row for row in table[1:] if [heading, *row][:len(keys)] == keys]


def named(keys: list[str], text: str) -> list[str]:
    """With the name of the best rival, if the keys ask for it."""
    if keys[1:] != [BEST_RIVAL]:
        return keys
    [name] = [best_rival(table)[0] for heading, table in documents.tables(text)
              if heading == keys[0] and "bad" in table[0]]
    return [keys[0], name]


def figure(place: str, results: Path) -> str:
    """The cell at a place."""
    file, *keys, column = place.split(" / ")
    column, is_alone = column.removesuffix(", alone"), column.endswith(", alone")
    text = (results / f"{file}.md").read_text()
    keys = named(keys, text)
    tables = [(heading, table) for heading, table in documents.tables(text) if column in table[0]]
    cells = [row[table[0].index(column)] for heading, table in tables
             for row in under_heading(keys, heading, table)]
    cells = cells or [row[table[0].index(column)] for _, table in tables
                      for row in table[1:] if row[:len(keys)] == keys]
    if len(set(cells)) != 1:
        sys.exit(f"pages: {{{place}}} means {len(cells)} cells of {file}.md, not one")
    return cells[0].partition(" (")[0] if is_alone else cells[0]


def filled(block: str) -> str:
    """Prose in lines of 100 columns: its figures are shorter than the places that they stand at."""
    if block.startswith(("|", "#", "!", "<!--", "```")):
        return block
    lines = []
    for item in re.split(r"\n(?=\d+\. |- )", block):
        mark = re.match(r"\d+\. |- ", item)
        indent = " " * len(mark[0]) if mark else ""
        lines.append(textwrap.fill(" ".join(item.split()), 100, subsequent_indent=indent,
                                   break_long_words=False, break_on_hyphens=False))
    return "\n".join(lines)


def page(template: str, results: Path) -> str:
    text = re.sub(r"\{([^{}]+)\}",
                  lambda found: figure(" ".join(found[1].split()), results), template)
    return "\n\n".join(filled(block) for block in text.rstrip("\n").split("\n\n")) + "\n"


def with_parts(document: Path, results: Path) -> str:
    """The document with each part that it has marks for."""
    text = document.read_text()
    for template in sorted((TEMPLATES / "parts").glob("*.md")):
        first, last = f"<!-- {template.stem} -->\n", f"<!-- /{template.stem} -->\n"
        if first not in text:
            continue
        part = page(template.read_text(), results)
        if document.parent != DOCS:
            part = re.sub(r"\]\((?![a-z]+:)", "](docs/", part)
        before, _, rest = text.partition(first)
        text = before + first + part + last + rest.partition(last)[2]
    return text


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/pages", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true",
                        help="write nothing; status 1 if a page is not what this would write")
    check = parser.parse_args().check
    stale = []
    written = {DOCS / template.name: page(template.read_text(), DOCS / "results")
               for template in sorted(TEMPLATES.glob("*.md"))}
    written |= {document: with_parts(document, DOCS / "results") for document in WITH_PARTS}
    for target, text in written.items():
        if text != (target.read_text() if target.exists() else ""):
            stale.append(target.name)
            if not check:
                target.write_text(text)
    if check and stale:
        sys.exit(f"pages: script/pages has not written {', '.join(stale)} since docs/results or "
                 "bench/pages changed")


if __name__ == "__main__":
    main()
