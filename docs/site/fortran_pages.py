# SPDX-License-Identifier: MIT
"""The page of the Fortran module: its type and procedures with their arguments, as tetmend.f90 declares them."""

import re
from pathlib import Path

from failure import Failure

MODULE = Path(__file__).resolve().parent.parent.parent / "bindings" / "fortran" / "tetmend.f90"


def joined(text: str) -> str:
    """Continued lines as one."""
    return re.sub(r"&\s*\n\s*&?", "", text)


def public_procedures(text: str) -> list[tuple[str, list[str]]]:
    """Names by which they are called, and the procedures behind each."""
    [contained] = re.findall(r"type, public :: tetmend_mesh\n.*?\n  contains\n(.*?)\n  end type", text, re.S)
    found = []
    for line in contained.splitlines():
        bound = re.fullmatch(r"\s*(?:procedure|generic), public :: (\w+)(?: => (.*))?", line)
        if bound:
            found.append((bound[1], re.split(r",\s*", bound[2] or bound[1])))
        elif not re.fullmatch(r"\s*procedure, private :: \w+|\s*!.*|\s*", line):
            raise Failure(f"{MODULE}: the site cannot read: {line.strip()}")
    return found


PROCEDURE = re.compile(r"(?P<comment>(?:^  ![^\n]*\n)*)^  (?P<kind>function|subroutine) (?P<name>\w+)\((?P<arguments>[^)]*)\)"
                       r"[^\n]*\n(?P<body>.*?)^  end (?P=kind)", re.M | re.S)


def definitions(text: str) -> dict[str, re.Match]:
    """The procedures of the module, those behind the interfaces to C left out."""
    return {found["name"]: found for found in PROCEDURE.finditer(text[text.index("\ncontains\n"):])}


def declarations(body: str) -> dict[str, tuple[str, str]]:
    """Type and intent, and name with shape, of each variable."""
    found = {}
    for line in body.splitlines():
        declared = re.fullmatch(r"    (\S.*?) :: (.*)", line)
        if not declared:
            continue
        for variable in re.findall(r"\w+(?:\([^)]*\))?", declared[2]):
            found[variable.partition("(")[0]] = (declared[1].replace(", target", ""), variable)
    return found


def words(comment: str) -> str:
    return " ".join(line.strip().removeprefix("!").strip() for line in comment.splitlines())


def entry(name: str, found: re.Match, of_c: set[str]) -> str:
    """A procedure as one calls it."""
    given = [argument.strip() for argument in found["arguments"].split(",") if argument.strip() not in ("", "self")]
    known = declarations(found["body"])
    missing = [argument for argument in given if argument not in known]
    if missing:
        raise Failure(f"{MODULE}: {found['name']}: no declaration of {missing[0]}")
    call = f"mesh%{name}({', '.join(given)})"
    result = re.search(r"result\((\w+)\)", found[0].split("\n    ")[0])
    call = f"call {call}" if found["kind"] == "subroutine" else f"{result[1] if result else found['name']} = {call}"
    lines = [call] + [f"  {kind} :: {variable}" for kind, variable in (known[argument] for argument in given)]
    note = [words(found["comment"]).removesuffix(".") + "."] if found["comment"] else []
    called = [function for function in re.findall(r"\bc(_\w+)\(", found["body"]) if f"tetmend{function}" in of_c]
    if called:
        note.append(f"See {{c:func}}`tetmend{called[0]}`.")
    return "```fortran\n" + "\n".join(lines) + "\n```\n\n" + " ".join(note) + "\n"


def write_fortran(page: Path) -> None:
    text = joined(MODULE.read_text())
    known = definitions(text)
    of_c = set(re.findall(r"bind\(c, name='(\w+)'\)", text))
    procedures = public_procedures(text)
    if len(procedures) < 20:
        raise Failure(f"{MODULE}: the site finds {len(procedures)} procedures")
    parts = ["# The Fortran reference\n", "The module `tetmend`, which is `tetmend.f90`: a type with procedures around "
             "[the functions of C](c-reference.md). [From C and Fortran](c.md#fortran) is the place to begin.\n",
             "```fortran\nuse tetmend\ntype(tetmend_mesh) :: mesh\n```\n",
             "`status` is `tetmend_ok` or another of the [constants](#constants); what was wrong says `last_error()`.\n",
             "## Procedures\n"]
    for name, behind in procedures:
        parts.append(f"### {name}\n")
        for each in behind:
            if each not in known:
                raise Failure(f"{MODULE}: there is no procedure {each}")
            parts.append(entry(name, known[each], of_c))
    parts += ["## Constants\n"]
    head = text[:text.index("\n  interface\n")]
    for comment, names in re.findall(r"^  ! (.*)\n((?:^  integer\(c_int\), parameter, public :: .*\n)+)", head, re.M):
        constants = re.findall(r"(tetmend_\w+) = (\d+)", names)
        parts.append(f"{comment}: " + ", ".join(f"`{name}` = {value}" for name, value in constants) + ".\n")
    parts += ["## Types\n"]
    for body in re.findall(r"^  (type, bind\(c\), public :: .*?^  end type)", head, re.M | re.S):
        name = re.search(r":: (\w+)", body)[1]
        parts.append(f"### {name}\n\n```fortran\n" + re.sub(r"^  ", "", body, flags=re.M) + "\n```\n")
    interface = re.search(r"^  abstract interface\n(.*?)^  end interface", text, re.M | re.S)[1]
    function = re.search(r"(?P<comment>(?:^    ![^\n]*\n)*)^    (?P<code>function .*?^    end function)", interface, re.M | re.S)
    parts += ["### tetmend_progress_function\n", words(function["comment"]) + "\n",
              "```fortran\n" + re.sub(r"^    ", "", function["code"], flags=re.M) + "\n```\n"]
    page.write_text("\n".join(parts))
