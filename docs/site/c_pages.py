# SPDX-License-Identifier: MIT
"""The page of <tetmend/tetmend.h>: what Doxygen finds in it, in its order and under its headings."""

import re
from pathlib import Path
from xml.etree import ElementTree

from failure import Failure

HEADER = Path(__file__).resolve().parent.parent.parent / "include" / "tetmend" / "tetmend.h"
DIRECTIVES = {"enum": "doxygenenum", "define": "doxygendefine", "typedef": "doxygentypedef", "function": "doxygenfunction"}


def declarations(xml: Path) -> list[tuple[int, str, str]]:
    """Line, directive of Breathe, and name."""
    file = ElementTree.parse(xml / "tetmend_8h.xml").find("compounddef")
    found = [(int(member.find("location").get("line")), DIRECTIVES[member.get("kind")], member.findtext("name"))
             for member in file.iter("memberdef") if member.findtext("name") != "TETMEND_TETMEND_H"]
    for inner in file.findall("innerclass"):
        definition = ElementTree.parse(xml / f"{inner.get('refid')}.xml").find("compounddef")
        found.append((int(definition.find("location").get("line")), "doxygenstruct", inner.text))
    return sorted(found)


def sections() -> list[tuple[int, str]]:
    """Lines and words of the headings."""
    lines = enumerate(HEADER.read_text().splitlines(), 1)
    return [(number, found[1]) for number, line in lines if (found := re.fullmatch(r"/\* ---- (.*) ---- \*/", line))]


def introduction() -> str:
    """What its first comment says, without the example."""
    comment = re.search(r"^/\* (tetmend for C.*?)\*/", HEADER.read_text(), re.M | re.S)
    if not comment:
        raise Failure(f"{HEADER}: no comment says what it is for")
    paragraphs = re.split(r"\n \*\n", comment[1])
    words = [re.sub(r"\s*(?:^|\n) \* ?", " ", paragraph).strip() for paragraph in paragraphs if not paragraph.startswith(" *   ")]
    return "\n\n".join(words)


def write_c(page: Path, xml: Path) -> None:
    entries = [(number, f"## {title}\n") for number, title in sections()]
    for number, directive, name in declarations(xml):
        members = ":members:\n" if directive == "doxygenstruct" else ""
        entries.append((number, f"```{{{directive}}} {name}\n:project: tetmend_c\n{members}```\n"))
    if len(entries) < 40:
        raise Failure(f"{HEADER}: Doxygen finds {len(entries)} declarations")
    page.write_text("# The C reference\n\n" + introduction() + "\n\n[From C and Fortran](c.md) is the place to begin.\n\n"
                    "```c\n#include <tetmend/tetmend.h>\n```\n\n" + "\n".join(text for _, text in sorted(entries)))
