# SPDX-License-Identifier: MIT
"""Runs the commands of a page of the documents, in its order, in a folder of their own.

    pages_test.py SOURCE BUILD PAGE     the page from the root of the source: docs/howto/gmsh.md
    pages_test.py SOURCE --all          that all pages have their commands where the first form finds them

Commands stand in blocks of the language `sh`. A block `output` below has lines that the last of them printed; blanks
do not count. A block `python NAME`, `lua NAME` or `geo NAME` is a file that a command uses. A command ends with status 0, unless
its comment has the words "status N". One whose program is not installed is named and passed over. Scripts for those who
work on tetmend, and builds of all of it, are not run but looked up: script, options and presets exist. Exit status 77:
no command could be run.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from page_blocks import GEOMETRY, PLATE, blocks, commands_of, not_printed, write_files

SKIPPED = 77
DEBIAN_PYTHON = "/usr/bin/python3"

# Commands that build something, and the test that does the same with a build of its own.
ELSEWHERE = {
    "cmake -S . -B build/prefix -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=$HOME/tetmend -DTETMEND_BUILD_TESTS=OFF":
        "a plugin and a program are built against an installed tetmend, and run",
    "cmake --build build/prefix": "a plugin and a program are built against an installed tetmend, and run",
    "cmake --install build/prefix": "a plugin and a program are built against an installed tetmend, and run",
    "cmake --build build/release --target make_lessons && build/release/bin/make_lessons assets/lessons":
        "lesson_tests",
    "cmake -S examples/petsc -B build/petsc -DCMAKE_PREFIX_PATH=~/tetmend && cmake --build build/petsc":
        "a plugin and a program are built against an installed tetmend, and run",
    "mpirun -n 2 build/petsc/improve_plex -dm_plex_filename part.msh -better_dm_view hdf5:better.h5":
        "a plugin and a program are built against an installed tetmend, and run",
    "python3 examples/adapting/poisson_peak.py": "the example poisson_peak.py does what docs/sizes.md says",
    "python3 examples/adapting/moving_front.py": "the example moving_front.py does what docs/sizes.md says",
    "cmake -S plugins -B build/plugins -DCMAKE_PREFIX_PATH=~/tetmend":
        "a plugin and a program are built against an installed tetmend, and run",
    "cmake --build build/plugins": "a plugin and a program are built against an installed tetmend, and run",
    "~/tetmend/bin/tetmend operators odt_smoothing --plugin build/plugins/odt_smoothing.so":
        "a plugin and a program are built against an installed tetmend, and run",
    "~/tetmend/bin/tetmend check-plugin build/plugins/odt_smoothing.so --mesh part.mesh":
        "a plugin and a program are built against an installed tetmend, and run",
}
# A line that begins so is a command, and belongs into a block `sh`.
COMMAND = re.compile(r"^(?:\$ )?(?:tetmend(?:-view)? [a-z-]|script/\w|cmake |ctest |build/\w|gmsh |ccx |python3 )")
# Besides `sh`, and what has no language.
KNOWN_KIND = re.compile(r"output|c|cpp|fortran|cmake|lua|(python|lua|geo) \w+\.(py|lua|geo)")

CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;
writeControl timeStep; writeInterval 1;
"""
DICTIONARY = "FoamFile {{ version 2.0; format ascii; class dictionary; object {0}; }}\n"
SCHEMES = "gradSchemes {} divSchemes {} laplacianSchemes {} interpolationSchemes {} snGradSchemes {} ddtSchemes {}\n"
PHYSICS = "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n"
STEP = "*STEP\n*STATIC\n*BOUNDARY\ninlet, 1, 3\n*DLOAD\n*NODE PRINT, NSET=inlet, TOTALS=ONLY\nRF\n*END STEP\n"


# --- what a page has

def pages_of(source: Path) -> list[Path]:
    return [source / "README.md", source / "CONTRIBUTING.md",
            *sorted((source / "docs").glob("*.md")), *sorted((source / "docs/howto").glob("*.md"))]


# --- where its commands run


class Missing(Exception):
    """A program or module that is not installed."""


class Workshop:
    """A folder with the programs of the build and the files that pages take for granted, made when first named."""

    def __init__(self, folder: Path, source: Path, build: Path) -> None:
        self.source = source
        self.work = folder / "work"
        self.tools = folder / "bin"
        self.work.mkdir()
        self.tools.mkdir()
        for program in ["tetmend", "tetmend-view", "tetmend-mpi"]:
            if (build / "bin" / program).exists():
                (self.tools / program).symlink_to(build / "bin" / program)
        (self.tools / "python3").symlink_to(DEBIAN_PYTHON)
        (self.work / "build").mkdir()
        (self.work / "build/release").symlink_to(build)
        (self.work / "assets").symlink_to(source / "assets")
        self.environment = dict(os.environ, PATH=f"{self.tools}:{os.environ['PATH']}", HOME=str(folder),
                                OMP_NUM_THREADS="1", WM_PROJECT_DIR="/usr/share/openfoam")  # where Debian has it
        self.environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                             "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
        if (build / "python/tetmend").is_dir():
            self.environment["PYTHONPATH"] = str(build / "python")
        self.environment.pop("TETMEND_PLUGIN_PATH", None)
        self.makers = {"part.mesh": self.make_mesh, "huge.meshb": self.make_huge, "better.mesh": self.make_better, "part.geo": self.make_geometry,
                       "part.msh": self.make_gmsh, "part.stl": self.make_stl, "job.inp": self.make_deck, "case": self.make_case}

    def run(self, command: str) -> subprocess.CompletedProcess:
        return subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=self.work, env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)

    def must(self, command: str) -> None:
        self.require(command)
        done = self.run(command)
        if done.returncode != 0:
            raise RuntimeError(f"{command}\n{done.stdout}")

    def require(self, command: str) -> None:
        """@throws Missing when a program or a module that it names is not there"""
        words = list(shlex.shlex(command, punctuation_chars=True, posix=True))
        programs = [words[0]] + [words[i + 1] for i, word in enumerate(words[:-1]) if word in ("|", "&&")]
        programs += ["tetmend-mpi"] if "tetmend-mpi" in command else []
        for program in programs:
            known = shutil.which(program, path=self.environment["PATH"]) or (self.work / program).exists()
            if not known and program not in ("export", "cd"):
                raise Missing(program)
        if "--video" in words and shutil.which("ffmpeg") is None:
            raise Missing("ffmpeg")
        for word in words[1:] if words[0] == "python3" else []:
            script = self.work / word
            imports = re.findall(r"^(?:import|from) (\w+)", script.read_text(), re.M) if script.suffix == ".py" else []
            for module in imports:
                if subprocess.run([DEBIAN_PYTHON, "-c", f"import {module}"], capture_output=True, env=self.environment).returncode != 0:
                    raise Missing(f"the module {module} of {DEBIAN_PYTHON}")

    def prepare(self, command: str) -> None:
        """Makes what the command names and is not there."""
        words = set(re.split(r"[\s/=]", command))
        for file in [self.work / word for word in words if word.endswith((".geo", ".py"))]:  # what they read
            words |= set(re.findall(r'"([^"]+)"', file.read_text())) if file.is_file() else set()
        for name, make in self.makers.items():
            if name in words and not (self.work / name).exists():
                make()

    def make_mesh(self) -> None:
        self.must(f"tetmend convert {shlex.quote(str(self.source))}/assets/meshes/bracket.meshb part.mesh")

    def make_huge(self) -> None:
        self.must(f"cp {shlex.quote(str(self.source))}/assets/meshes/bracket.meshb huge.meshb")

    def make_better(self) -> None:
        self.prepare("part.mesh")
        self.must("tetmend improve part.mesh -o better.mesh")

    def make_geometry(self) -> None:
        (self.work / "part.geo").write_text(GEOMETRY)

    def make_gmsh(self) -> None:
        self.prepare("part.geo")
        self.must("gmsh -3 part.geo -format msh41 -o part.msh")

    def make_stl(self) -> None:
        """A plate with a hole."""
        (self.work / "plate.geo").write_text(PLATE)
        self.must("gmsh -2 plate.geo -format stl -o part.stl")

    def make_deck(self) -> None:
        """The mesh of Gmsh with what a solver wants."""
        self.prepare("part.msh")
        self.must("tetmend convert part.msh job.inp")
        text = (self.work / "job.inp").read_text()
        sets = re.findall(r"\*ELEMENT, TYPE=C3D4, ELSET=(\w+)", text)
        sections = "".join(f"*SOLID SECTION, ELSET={name}, MATERIAL=M\n" for name in sets)
        (self.work / "job.inp").write_text(text + PHYSICS + sections + STEP)

    def make_case(self) -> None:
        (self.work / "case/system").mkdir(parents=True)
        (self.work / "case/system/controlDict").write_text(CONTROL)
        (self.work / "case/system/fvSchemes").write_text(DICTIONARY.format("fvSchemes") + SCHEMES)
        (self.work / "case/system/fvSolution").write_text(DICTIONARY.format("fvSolution"))


# --- what is done with a command


def is_looked_up(command: str) -> bool:
    """Scripts for those who work on tetmend, and builds of all of it."""
    return command.startswith(("script/", "cmake --preset", "cmake --build build/release", "ctest --preset"))


def look_up(command: str, source: Path) -> list[str]:
    """What of a command that is not run does not exist: scripts, their options, presets."""
    wrong = []
    script = re.match(r"script/\S+", command)
    if script:
        file = source / script[0]
        if not os.access(file, os.X_OK):
            return [f"there is no {script[0]}"]
        told = file.read_text()
        if "| --help)" in told:  # any other script would begin its work
            told += subprocess.run([file, "--help"], capture_output=True, text=True, timeout=60).stdout
        options = re.findall(r" (--[a-z-]+)", command)
        wrong += [f"{script[0]} --help does not say {option}" for option in options if option not in told]
    known = {preset["name"] for preset in json.loads((source / "CMakePresets.json").read_text())["configurePresets"]}
    wrong += [f"there is no preset {name}" for name in re.findall(r"--preset (\S+)", command) if name not in known]
    return wrong


def without_window(command: str) -> str:
    """The viewer draws the same into a file, where it would wait for somebody to close its window."""
    is_window = re.match(r"(?:\S*/)?tetmend-view ", command) and not re.search(r"--(render|script|video|help|keys)", command)
    return f"{command} --render window.png" if is_window else command


def outputs_of(command: str) -> list[str]:
    """The files that a command says it writes."""
    named = re.findall(r"(?:\s-o|\s--cells|\s--report|\s--trace|\s--render|\s--video|>)\s+([\w./]+)", command)
    named += [name.replace("%d", "1") for name in re.findall(r"^tetmend convert \S+ (\S+)", command)]
    named += [f"{job}.dat" for job in re.findall(r"^ccx (\w+)", command)]
    return named + [f"{case}/constant/polyMesh" for case in re.findall(r"^gmshToFoam .*-case (\w+)", command)]


class Trial:
    """The commands of one page."""

    def __init__(self, page: Path, source: Path, build: Path, folder: Path) -> None:
        self.page, self.source = page, source
        self.shop = Workshop(folder, source, build)
        if page.name == "start.md":  # whoever begins has the source and nothing else
            self.shop.makers = {}
        self.counts = {"ok": 0, "FAIL": 0, "looked up": 0, "elsewhere": 0, "passed over": 0}
        self.printed: str | None = None  # by the last command that ran
        self.not_made: dict[str, str] = {}  # files of commands that were passed over, with what is not installed

    def tell(self, outcome: str, text: str) -> None:
        self.counts[outcome] += 1
        print(f"{outcome:<12} {text}")

    def try_command(self, command: str, status: int) -> None:
        self.printed = None
        if command in ELSEWHERE:
            self.tell("elsewhere", f"{command}   [{ELSEWHERE[command]}]")
            return
        if is_looked_up(command):
            wrong = look_up(command, self.source)
            self.tell("FAIL" if wrong else "looked up", "; ".join([command, *wrong]))
            return
        try:
            self.shop.prepare(command)
            self.shop.require(command)
            self.require_files(command)
        except Missing as missing:
            self.tell("passed over", f"{command}   [{missing} is not installed]")
            for file in re.findall(r"[\w./-]+\.\w+|(?<=-case )\w+", command):
                self.not_made |= {file: str(missing), file.partition(".")[0] or file: str(missing)}
            return
        done = self.shop.run(without_window(command))
        self.printed = done.stdout
        lacking = [file for file in outputs_of(command) if status in (0, 3) and not (self.shop.work / file).exists()]
        self.tell("FAIL" if done.returncode != status or lacking else "ok", command)
        if done.returncode != status:
            print(f"status {done.returncode}, not {status}\n{done.stdout[-2000:]}")
        elif lacking:
            print(f"did not make {', '.join(lacking)}")

    def require_files(self, command: str) -> None:
        """@throws Missing when it reads what a command that was passed over would have made"""
        for word in re.findall(r"[\w./-]+", re.sub(r"(?:-o|>) *\S+", "", command)):
            if word in self.not_made and not (self.shop.work / word).is_file():
                raise Missing(self.not_made[word])

    def compare(self, quoted: str) -> None:
        """With what the last command that ran printed."""
        for line in not_printed(quoted, self.printed) if self.printed is not None else []:
            self.tell("FAIL", f"nobody printed: {line}")

    def run(self) -> None:
        last = None
        write_files(self.page, self.shop.work)
        for language, content in blocks(self.page):
            if language == "sh":
                for command, status in commands_of(content):
                    self.try_command(command, status)
                last = self.printed
            elif language == "output":
                self.printed = last
                self.compare(content)


def try_page(page: Path, source: Path, build: Path) -> int:
    with tempfile.TemporaryDirectory() as name:
        trial = Trial(page, source, build, Path(name))
        trial.run()
    counts = trial.counts
    print(", ".join(f"{count} {outcome}" for outcome, count in counts.items()))
    if counts["FAIL"]:
        return 1
    return SKIPPED if counts["passed over"] and not counts["ok"] else 0


def check_all(source: Path) -> int:
    """Commands stand in blocks `sh`, and what is tried elsewhere is."""
    wrong = []
    seen = set()
    for page in pages_of(source):
        name = page.relative_to(source)
        for language, content in blocks(page):
            if language == "sh":
                seen |= {command for command, _ in commands_of(content)}
            elif language in ("", "text", "bash", "shell", "console"):
                wrong += [f"{name}: no test runs: {line}" for line in content.splitlines() if COMMAND.match(line)]
            elif not KNOWN_KIND.fullmatch(language):
                wrong.append(f"{name}: a block of unknown kind: {language}")
    tests = (source / "tests/CMakeLists.txt").read_text()
    for command, test in ELSEWHERE.items():
        if command not in seen:
            wrong.append(f"no page has: {command}")
        if test not in tests:
            wrong.append(f"there is no test: {test}")
    print("\n".join(wrong) or f"{len(seen)} commands")
    return 1 if wrong or len(seen) < 50 else 0


def main() -> int:
    source = Path(sys.argv[1]).resolve()
    if sys.argv[2] == "--all":
        return check_all(source)
    return try_page(source / sys.argv[3], source, Path(sys.argv[2]).resolve())


if __name__ == "__main__":
    sys.exit(main())
