# SPDX-License-Identifier: MIT
"""Documents of results. Each is written whole by a program and says in its first lines how it was
made: command, commit, date, machine. Nobody edits one by hand."""

import argparse
import datetime
import os
import platform
import re
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

Table = list[list[str]]  # the first row is the heading

HEAD = re.compile(
    r"# (?P<title>.+)\n\n"
    r"Command: `(?P<command>[^`\n]+)`\\\n"
    r"Commit: (?P<commit>[0-9a-f]{7,}(?: with changes)?), date: (?P<date>\d{4}-\d\d-\d\d), "
    r"machine: (?P<machine>.+)\n"
)


@dataclass(frozen=True)
class Stamp:
    """Where figures come from."""

    command: str  # as typed in the root of the repository
    commit: str  # of the program that was measured
    date: str
    machine: str


# --- how the figures were made


def typed(program: str, arguments: list[str]) -> str:
    """The command as a reader may type it: without the folders of this machine, and without
    options that name folders and documents, which change no figure."""
    words, skip = [program], False
    for word in arguments:
        if skip or word in ("--write", "--build", "-o", "--output"):
            skip = not skip
        elif not word.startswith(("--write=", "--build=", "--output=")):
            words.append(Path(word).name if "/" in word else word)
    return " ".join(words)


def commit() -> str:
    """Of the checkout that this file lies in; changes of documents do not count."""
    git = ["git", "-C", str(ROOT)]
    try:
        head = subprocess.run([*git, "rev-parse", "--short", "HEAD"], check=True,
                              capture_output=True, text=True).stdout.strip()
        changes = subprocess.run([*git, "status", "--porcelain", "--untracked-files=no", "--",
                                  ".", ":!docs"], check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return f"{head} with changes" if changes else head


def machine() -> dict:
    info = Path("/proc/cpuinfo").read_text() if Path("/proc/cpuinfo").exists() else ""
    models = [line.split(":")[1].strip() for line in info.splitlines() if "model name" in line]
    return {
        "processor": models[0] if models else platform.processor(),
        "cores": os.cpu_count(),
        "memory_bytes": os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"),
        "system": platform.system(),
        "load_before": os.getloadavg()[0],
    }


def machine_text(described: dict) -> str:
    memory = described["memory_bytes"] / 1e9
    return f"{described['processor']}, {described['cores']} cores, {memory:.0f} GB"


def stamp(program: str) -> Stamp:
    """Of the running script, here and now.

    @param program  how it is called, without its arguments"""
    today = datetime.date.today().isoformat()
    return Stamp(typed(program, sys.argv[1:]), commit(), today, machine_text(machine()))


# --- writing


def markdown_table(table: Table) -> str:
    lines = ["| " + " | ".join(row) + " |" for row in table]
    return "\n".join([lines[0], "|" + "---|" * len(table[0]), *lines[1:]])


def wrapped(part: str) -> str:
    """Prose in lines of at most 100 columns; tables, headings, lists and pictures as they are."""
    if part.startswith(("|", "#", "-", "!")):
        return part
    paragraphs = part.split("\n\n")
    return "\n\n".join(textwrap.fill(paragraph, 100, break_long_words=False,
                                     break_on_hyphens=False) for paragraph in paragraphs)


def document(title: str, made: Stamp, parts: list[str]) -> str:
    """@param parts  paragraphs, tables, headings, pictures in their order"""
    head = (
        f"# {title}\n\nCommand: `{made.command}`\\\n"
        f"Commit: {made.commit}, date: {made.date}, machine: {made.machine}"
    )
    return "\n\n".join([head, *map(wrapped, parts)]) + "\n"


def add_option(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--write", type=Path, metavar="FILE",
                        help="also write all as a document, such as those in docs/results")


def write(file: Path, text: str, pictures: dict[str, str] | None = None) -> None:
    """The document, and its pictures into the folder `figures` beside it.

    @param pictures  SVG by the name of its file"""
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    for name, drawing in (pictures or {}).items():
        (file.parent / "figures").mkdir(exist_ok=True)
        (file.parent / "figures" / name).write_text(drawing)


def picture(name: str, text: str) -> str:
    """How a document shows one of its pictures."""
    return f"![{text}](figures/{name})"


# --- reading


def tables(text: str) -> Iterator[tuple[str, Table]]:
    """The tables of a document, each with the heading that it stands under."""
    heading, table = "", []
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if set("".join(cells)) != {"-"}:
                table.append(cells)
        elif table:
            yield heading, table
            table = []
        if line.startswith("#"):
            heading = line.lstrip("# ")
