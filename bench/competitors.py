# SPDX-License-Identifier: MIT
"""The improvers that script/bench compares: how each is found, called and asked for its time.

To add one, add a row to `competitors()`.
"""

import json
import os
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

RIVALS = Path(__file__).resolve().parent / "rivals"
# The default is the Python that knows Debian's modules.
OWN_PYTHON = os.environ.get("TETMEND_BENCH_PYTHON")
PYTHON = OWN_PYTHON or "/usr/bin/python3"

Phases = dict[str, float]  # seconds; "improving" is the work without reading and writing


@dataclass(frozen=True)
class Competitor:
    name: str
    short: str  # label in charts
    found: str | None  # program or Python module to run, None: not on this machine
    hint: str  # how to get it
    command: tuple[str, ...]  # run in a folder that holds the input
    output: str  # file that the command leaves in the folder
    phases: Callable[[Path], Phases]  # what it tells about its time, from the folder of the run
    package: str | None = None  # Debian package, for its version
    ours: bool = False


def shown_command(competitor: Competitor) -> str:
    """The command as a reader may type it: no folders of this machine."""
    words = competitor.command
    return " ".join(Path(word).name if word.startswith("/") else word for word in words)


def version(competitor: Competitor) -> str:
    if competitor.package is None or shutil.which("dpkg-query") is None:
        return ""
    query = ["dpkg-query", "-W", "-f=${Version}", competitor.package]
    return subprocess.run(query, capture_output=True, text=True, check=False).stdout


# --- how a rival is found


def program(name: str) -> str | None:
    return shutil.which(name)


def module(name: str) -> str | None:
    """Python with that module, or nothing."""
    if shutil.which(PYTHON) is None:
        return None
    test = f"import importlib.util as u, sys; sys.exit(u.find_spec('{name}') is None)"
    return PYTHON if subprocess.run([PYTHON, "-c", test], check=False).returncode == 0 else None


def variable(name: str) -> str | None:
    path = os.environ.get(name, "")
    return shutil.which(path) if path else None


# --- what a rival tells about its time


def log_of(folder: Path) -> str:
    return (folder / "log.txt").read_text(errors="replace")


def untold(_: Path) -> Phases:
    return {}


def improving(found: list[str]) -> Phases:
    return {"improving": sum(map(float, found))} if found else {}


def tetmend_phases(folder: Path) -> Phases:
    return json.loads((folder / "report.json").read_text())["seconds"]


def line_phases(folder: Path) -> Phases:
    return improving(re.findall(r"^improving seconds: *([\d.eE+-]+)", log_of(folder), re.M))


def tetgen_phases(folder: Path) -> Phases:
    pattern = r"^(?:Refinement|Optimization) seconds: *([\d.eE+-]+)"
    return improving(re.findall(pattern, log_of(folder), re.M))


def mmg_phases(folder: Path) -> Phases:
    """Sum of its phases, which lie between reading and writing: "0.123s" or "1m02s (62.345s)"."""
    pattern = r"PHASE \d COMPLETED\. +(?:\S+ *\()?([\d.]+)s"
    return improving(re.findall(pattern, log_of(folder)))


# --- the table


def tetmend_row(tetmend: Path, name: str, short: str, options: str) -> Competitor:
    options = f"--quiet --report report.json {options}"
    command = (str(tetmend), "improve", "input.mesh", "-o", "output.mesh", *options.split())
    return Competitor(
        name=f"tetmend, {name}",
        short=f"tetmend {short}",
        found=str(tetmend),
        hint="",
        command=command,
        output="output.mesh",
        phases=tetmend_phases,
        ours=True,
    )


def tetmend_rows(tetmend: Path) -> list[Competitor]:
    return [
        tetmend_row(tetmend, "1 thread", "(1)", "--threads 1"),
        tetmend_row(tetmend, "2 threads", "(2)", "--threads 2"),
        tetmend_row(tetmend, "thorough, 1 thread", "thorough", "--threads 1 --schedule thorough"),
        tetmend_row(tetmend, "polish, 1 thread", "polish", "--threads 1 --schedule polish"),
    ]


def purpose_rows(tetmend: Path) -> list[Competitor]:
    return [tetmend_row(tetmend, f"--for {purpose}", purpose, f"--for {purpose}")
            for purpose in ("explicit", "implicit", "volumes", "angles")]


def gmsh_rows() -> list[Competitor]:
    found = module("gmsh")

    def row(name: str, short: str, mode: str) -> Competitor:
        script = str(RIVALS / "gmsh_optimize.py")
        return Competitor(
            name=name,
            short=short,
            found=found,
            hint="Needs the Debian package python3-gmsh",
            command=(PYTHON, script, mode, "input.mesh", "output.vtk"),
            output="output.vtk",
            phases=line_phases,
            package=None if OWN_PYTHON else "python3-gmsh",
        )

    return [
        row("Gmsh, own optimiser", "Gmsh", "default"),
        row("Gmsh, threshold 0.6 three times, relocation", "Gmsh 0.6 x3", "thorough"),
    ]


def tetgen_rows() -> list[Competitor]:
    def row(angle: int) -> Competitor:
        # Without -q TetGen leaves its optimiser out.
        return Competitor(
            name=f"TetGen, goal {angle} degrees",
            short=f"TetGen {angle}",
            found=program("tetgen"),
            hint="Needs the Debian package tetgen",
            command=("tetgen", f"-rq100/0YO9/7o/{angle}", "input.node"),
            output="input.1.node",
            phases=tetgen_phases,
            package="tetgen",
        )

    return [row(140), row(120)]


def netgen_rows() -> list[Competitor]:
    script = str(RIVALS / "netgen_optimize.py")
    return [
        Competitor(
            name="Netgen",
            short="Netgen",
            found=module("netgen"),
            hint="Needs the Debian package python3-netgen",
            command=(PYTHON, script, "input.mesh", "output.mesh"),
            output="output.mesh",
            phases=line_phases,
            package=None if OWN_PYTHON else "python3-netgen",
        )
    ]


def mmg_rows() -> list[Competitor]:
    found = variable("TETMEND_BENCH_MMG3D")

    def row(name: str, short: str, *options: str) -> Competitor:
        files = ("-in", "input.mesh", "-out", "output.meshb")
        return Competitor(
            name=name,
            short=short,
            found=found,
            hint="Needs TETMEND_BENCH_MMG3D=PROGRAM: mmg3d (www.mmgtools.org)",
            command=(found or "mmg3d", "-optim", "-nosurf", *options, *files),
            output="output.meshb",
            phases=mmg_phases,
        )

    return [
        row("MMG, no insertion", "MMG -noinsert", "-noinsert"),
        row("MMG", "MMG"),
    ]


def stellar_rows() -> list[Competitor]:
    found = variable("TETMEND_BENCH_STELLAR")
    return [
        Competitor(
            name="Stellar, surface fixed",
            short="Stellar",
            found=found,
            hint="Needs TETMEND_BENCH_STELLAR=PROGRAM: Stellar "
            "(people.eecs.berkeley.edu/~jrs/stellar)",
            command=(found or "Stellar", "-s", str(RIVALS / "stellar.config"), "input"),
            output="output.node",
            phases=untold,
        )
    ]


def cgal_row(name: str) -> Competitor:
    """Not among competitors(): whether the surface stays is up to the program that calls CGAL."""
    found = variable("TETMEND_BENCH_CGAL")
    return Competitor(
        name=name,
        short="CGAL",
        found=found,
        hint="Needs TETMEND_BENCH_CGAL=PROGRAM, called as PROGRAM IN.mesh OUT.mesh: a program that "
        "calls CGAL's tetrahedral_isotropic_remeshing, which is under the GPL",
        command=(found or "cgal", "input.mesh", "output.mesh"),
        output="output.mesh",
        phases=line_phases,
    )


def other_rows() -> list[Competitor]:
    """Programs that are called as PROGRAM IN.mesh OUT.mesh; a script can bring any to that."""

    def row(name: str, name_of_variable: str) -> Competitor:
        found = variable(name_of_variable)
        return Competitor(
            name=name,
            short=name,
            found=found,
            hint=f"Needs {name_of_variable}=PROGRAM, called as PROGRAM IN.mesh OUT.mesh; "
            'it may print "improving seconds: X"',
            command=(found or name, "input.mesh", "output.mesh"),
            output="output.mesh",
            phases=line_phases,
        )

    return [row("HXT", "TETMEND_BENCH_HXT"), row("other", "TETMEND_BENCH_OTHER")]


def competitors(tetmend: Path) -> list[Competitor]:
    return [
        *tetmend_rows(tetmend),
        *gmsh_rows(),
        *tetgen_rows(),
        *netgen_rows(),
        *mmg_rows(),
        *stellar_rows(),
        *other_rows(),
    ]
