# SPDX-License-Identifier: MIT
"""Compiles all sources of a build without making code, many as one, for most of the time of a compiler goes into headers.

    check_sources.py COMPILE_COMMANDS [-j JOBS] [--list]

Sources that declare the same name for themselves are not put together. Where a batch fails, its sources are compiled one by
one: only what fails alone is an error, and is printed with what the compiler says. Of one batch all have the include folders
and definitions of all, so a missing include may stay hidden. --list prints the batches and compiles nothing.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import json
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import unity_names

MOST = 32  # sources in a batch
# They hide functions of headers, which only a compiler knows; or want another HDF5 than the others.
ALONE = ["pieces/medit_slices.cpp", "viewer/ui/drawing_canvas.cpp", "mpi/hdf5_file.cpp"]
# Of the standard and of others: what many sources include.
PRECOMPILED = """algorithm any array atomic charconv cmath condition_variable cstdint cstring deque filesystem fstream functional
    iostream limits list map memory mutex numeric optional queue random regex set span sstream string string_view thread tuple
    unordered_map unordered_set utility variant vector Eigen/Core Eigen/Geometry Eigen/LU fmt/format.h fmt/ranges.h
    nlohmann/json.hpp""".split()


def own_names(text: str) -> set[str]:
    """What a source declares for itself, macros and names of others too."""
    names = set(re.findall(r"^#define (\w+)|^using (?:\w*::)*(\w+);", text, re.M))
    names = {name for pair in names for name in pair if name}
    return names | unity_names.own_names(text)


class Build:
    """What compiles its sources: the words of all of its commands together."""

    def __init__(self, database: Path) -> None:
        entries = json.loads(database.read_text())
        self.folder = database.parent
        self.sources = list(dict.fromkeys(Path(entry["directory"], entry["file"]).resolve() for entry in entries))
        words: dict[tuple[str, ...], None] = {}
        self.own_words: dict[Path, list[str]] = {}
        for entry in entries:
            own: list[tuple[str, ...]] = []
            given = shlex.split(entry["command"])
            given = given[next(i for i, word in enumerate(given) if not word.endswith("ccache")):]
            self.compiler = given[0]
            taken = iter(given[1:])
            for word in taken:
                if word in ("-o", "-c"):
                    next(taken)
                elif word in ("-isystem", "-include"):
                    own.append((word, next(taken)))
                elif word.startswith(("-I", "-D", "-std", "-stdlib", "-f", "-U")) and not word.startswith(("-fPI", "-D_FORTIFY", "-U_FORT")):
                    own.append((word,))
            words |= dict.fromkeys(own)
            self.own_words[Path(entry["directory"], entry["file"]).resolve()] = [word for pair in own for word in pair]
        self.words = [word for pair in words for word in pair]

    def call(self, *more: object) -> subprocess.CompletedProcess:
        command = [self.compiler, *self.words, "-w", *map(str, more)]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True)

    def precompile(self) -> None:
        """Makes a header that all calls begin with."""
        header = self.folder / "check_sources.h"
        header.write_text("".join(f"#include <{name}>\n" for name in PRECOMPILED))
        is_clang = "clang" in Path(self.compiler).name
        made = header.with_suffix(".pch" if is_clang else ".h.gch")
        more = ["-Xclang", "-fpch-instantiate-templates"] if is_clang else []
        done = self.call(*more, "-x", "c++-header", header, "-o", made)
        if done.returncode:
            raise SystemExit(done.stderr)
        self.words += ["-include-pch", str(made)] if is_clang else ["-include", str(header)]

    def check(self, sources: list[Path]) -> tuple[list[Path], str]:
        """The sources that do not compile, and what the compiler says of them."""
        if len(sources) == 1:
            done = self.call("-fsyntax-only", sources[0])
            if done.returncode:  # two libraries may have headers of one name: then by its own command
                own = [self.compiler, *self.own_words[sources[0]], "-w", "-fsyntax-only", str(sources[0])]
                done = subprocess.run(own, cwd=self.folder, capture_output=True, text=True)
            return (sources, done.stderr) if done.returncode else ([], "")
        batch = self.folder / f"check_sources_{self.sources.index(sources[0])}.cpp"
        batch.write_text("".join(f'#include "{source}"\n' for source in sources))
        done = self.call("-fsyntax-only", batch)
        if done.returncode == 0:
            return [], ""
        wrong: list[Path] = []
        said = ""
        for source in sources:
            failed, text = self.check([source])
            wrong += failed
            said += text
        if not wrong:
            print(f"{len(sources)} sources are right, but not as one:\n{done.stderr[:600]}", file=sys.stderr)
        return wrong, said


class Names:
    """What sources declare for themselves, and what the headers that they include declare for all."""

    def __init__(self, root: Path) -> None:
        self.folders = [root, root / "include"]
        self.known: dict[Path, tuple[set[Path], set[str]]] = {}  # of headers: all that they include, with themselves; and the names

    def headers(self, text: str) -> tuple[set[Path], set[str]]:
        files: set[Path] = set()
        names: set[str] = set()
        for name in re.findall(r'^#include ["<]([\w/.]+)[">]', text, re.M):
            for header in (folder / name for folder in self.folders):
                if header.is_file():
                    more = self.of_header(header)
                    files |= more[0]
                    names |= more[1]
                    break
        return files, names

    def of_header(self, header: Path) -> tuple[set[Path], set[str]]:
        if header not in self.known:
            self.known[header] = (set(), set())
            text = header.read_text(encoding="utf-8")
            files, names = self.headers(text)
            lines = (line for line in text.splitlines() if line[:1].isalpha() and not line.startswith("namespace"))
            found = (unity_names.DECLARED.match(line) for line in lines)
            own = {next(name for name in match.groups() if name) for match in found if match}
            self.known[header] = (files | {header}, names | own)
        return self.known[header]


@dataclass
class Batch:
    """Sources that are compiled as one."""

    sources: list[Path] = field(default_factory=list)
    own: set[str] = field(default_factory=set)
    hidden: set[str] = field(default_factory=set)  # of them: types, and what no header of the source itself declares, too
    seen: set[str] = field(default_factory=set)  # of headers
    headers: set[Path] = field(default_factory=set)

    def fits(self, other: Batch) -> bool:
        return not (self.own & other.own or self.hidden & other.seen or self.seen & other.hidden)

    def add(self, other: Batch) -> None:
        self.sources += other.sources
        for name in ("own", "hidden", "seen", "headers"):
            getattr(self, name).update(getattr(other, name))


def batches_of(sources: list[Path], root: Path) -> list[list[Path]]:
    """Such that in none a name means two things, and those that include the same stay together where they can."""
    names = Names(root)
    singles = []
    for source in sources:
        text = source.read_text(encoding="utf-8")
        headers, seen = names.headers(text)
        own = own_names(text)
        hidden = {name for name in own if name[0].isupper() or name not in seen}
        singles.append(Batch([source], own, hidden, seen, headers))
    alone = [one for one in singles if one.sources[0].as_posix().endswith(tuple(ALONE))]
    singles = [one for one in singles if one not in alone]
    # The ones that are hard to place first.
    clashes = {id(one): sum(not one.fits(other) for other in singles) for one in singles}
    batches = [Batch() for _ in range(-(-len(singles) // MOST))]
    for one in sorted(singles, key=lambda single: -clashes[id(single)]):
        fitting = [batch for batch in batches if len(batch.sources) < MOST and batch.fits(one)]
        if not fitting:
            batches.append(Batch())
            fitting = batches[-1:]
        min(fitting, key=lambda batch: (len(one.headers - batch.headers), len(batch.sources))).add(one)
    return [batch.sources for batch in [*batches, *alone] if batch.sources]


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("commands", type=Path)
    parser.add_argument("-j", type=int, default=1)
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    build = Build(options.commands.resolve())
    batches = batches_of(build.sources, Path(__file__).resolve().parents[2])
    if options.list:
        for batch in batches:
            print(len(batch), *batch)
        return 0
    build.precompile()
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        outcomes = list(pool.map(build.check, sorted(batches, key=len, reverse=True)))
    wrong = [source for failed, _ in outcomes for source in failed]
    sys.stderr.write("".join(said for _, said in outcomes))
    for source in wrong:
        print(f"does not compile: {source}", file=sys.stderr)
    print(len(build.sources))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
