# SPDX-License-Identifier: MIT
"""The page of the Python package: all that it offers, from its docstrings. The extension need not be built, for its stub
has the names. build.py writes the page; conf.py has Sphinx read the package so."""

import __future__

import ast
import importlib
import importlib.util
import re
import sys
import types
from pathlib import Path

from failure import Failure

ROOT = Path(__file__).resolve().parent.parent.parent
PACKAGE = ROOT / "bindings" / "python" / "tetmend"

# Where each name that the package offers stands.
SECTIONS = {
    "Improving": ["improve", "adapt", "from_surface", "Options", "Result", "Statistics", "Pass", "Progress"],
    "Meshes and files": ["Mesh", "Group", "load", "save", "formats"],
    "Figures and checks": ["quality", "Quality", "BadTet", "check", "Check", "Fact"],
    "Walks, edits, operators one by one": ["TetMesh", "Edit", "Call", "Ring", "Look", "PassDone"],
    "Recorded runs": ["Trace", "TracePage"],
    "Schedules and operators": ["schedules", "Schedule", "operators", "Operator", "Parameter"],
    "Errors": ["Error", "OptionError", "MissingFile"],
}
# Modules for other programs, and what they offer.
BRIDGES = {"gmsh": "improve", "meshio": "improve", "vtk": "improve", "pyvista": "Accessor", "dolfinx": "improve"}
MADE_BY_USERS = ("Mesh", "Group", "TetMesh", "Trace")  # the others come from functions

# --- the page


def names_of_package() -> list[str]:
    tree = ast.parse((PACKAGE / "__init__.py").read_text())
    for node in tree.body:
        if isinstance(node, ast.Assign) and node.targets[0].id == "__all__":
            return ast.literal_eval(node.value)
    raise Failure(f"{PACKAGE}/__init__.py: there is no __all__")


def options() -> list[tuple[str, str]]:
    """Names and types of what improve() takes besides the mesh."""
    tree = ast.parse((PACKAGE / "_options.py").read_text())
    [found] = [node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == "Options"]
    return [(node.target.id, ast.unparse(node.annotation)) for node in found.body if isinstance(node, ast.AnnAssign)]


def meanings() -> dict[str, str]:
    """What options mean, as docs/library.md has it."""
    rows = re.findall(r"^\| (`.*?`) \|.*?\| (.*) \|$", (ROOT / "docs/library.md").read_text(), re.M)
    return {name: text for names, text in rows for name in re.findall(r"`(\w+)`", names)}


def list_of_options(of_command: dict[str, str]) -> list[str]:
    """In the words of the command line; of the few that it has not, in those of the page of the library."""
    known = meanings() | of_command | {"purpose": of_command["for"]}  # two names of one option
    lines = []
    for name, kind in options():
        if name not in known:
            raise Failure(f"neither tetmend improve --help nor docs/library.md says what the option {name} means")
        kind = kind.replace("Text", "str | PathLike")
        lines += [f"`{name}`: `{kind}`", f": {known[name]}", ""]
    return lines


def directive(name: str) -> list[str]:
    kind = "autofunction" if name.rpartition(".")[2].islower() else "autoclass"
    lines = ["```{eval-rst}", f".. {kind}:: tetmend.{name}"]
    if kind == "autoclass":
        lines += ["   :members:", "   :undoc-members:", *(["   :special-members: __init__"] if name in MADE_BY_USERS else [])]
    return [*lines, "```", ""]


def write_python(page: Path, of_command: dict[str, str]) -> None:
    """@param of_command what `tetmend improve --help` says of its options, by their names in Python"""
    offered = set(names_of_package()) - {"__version__"}
    placed = [name for names in SECTIONS.values() for name in names]
    if offered != set(placed):
        raise Failure(f"docs/site/python_pages.py: no place for {sorted(offered ^ set(placed))}")
    modules = {path.stem for path in PACKAGE.glob("[a-z]*.py")}
    if modules != set(BRIDGES):
        raise Failure(f"docs/site/python_pages.py: no place for {sorted(modules ^ set(BRIDGES))}")
    lines = ["# The Python reference", "",
             "All that `import tetmend` offers. [Python](python.md) is the place to begin.", ""]
    for title, names in SECTIONS.items():
        lines += [f"## {title}", ""]
        for name in names:
            lines += directive(name)
        if title == "Improving":
            lines += ["### Options", "", "What `improve()` takes besides the mesh, in the words of the command line. "
                      "`None` is the default.", "", *list_of_options(of_command)]
    lines += ["## Other programs", ""]
    for module, name in BRIDGES.items():
        lines += directive(f"{module}.{name}")
    page.write_text("\n".join(lines))


# --- docstrings as Sphinx reads them

SPECIAL = re.compile(r"(`[^`]*`)|([*|\\]|(?<=\w)_(?!\w))")
ROW = re.compile(r"(\S(?:.*?\S)?) {2,}(\S.*)")


def escaped(text: str) -> str:
    """Words as they are written; between backticks nothing is special."""
    return SPECIAL.sub(lambda found: f"`{found[1]}`" if found[1] else f"\\{found[2]}", text)


def as_rst(lines: list[str]) -> list[str]:
    """A docstring in plain words, blocks that are indented, sessions, and tables of two columns."""
    made: list[str] = []
    rows: list[list[str]] = []
    state = "words"
    for line in [*lines, ""]:
        row = ROW.fullmatch(line)
        if rows and line.startswith("    "):
            rows[-1][1] += " " + line.strip()
            continue
        if row and not line.startswith((" ", ">>>", "...")) and state == "words":
            rows.append([row[1], row[2]])
            continue
        for name, text in rows:
            made += [f"``{name}``", f"    {escaped(text)}"]
        rows = []
        if not line.strip():
            state = "words" if state != "code" else state
        elif line.startswith(">>>"):
            state = "session"
        elif line.startswith("    ") and state == "words":
            made += [".. code-block:: python", ""]
            state = "code"
        elif not line.startswith(" ") and state == "code":
            state = "words"
        made.append(line if state != "words" else escaped(line))
    return made


# --- the package without its extension


def is_missing(module: str) -> bool:
    return importlib.util.find_spec(module) is None


def load_package() -> None:
    """Makes `import tetmend` work with the names of the stub. Types of arrays are shown as they are written, for nobody knows
    their names any more when Sphinx asks what they are."""
    stub = types.ModuleType("tetmend._core")
    stub.__version__ = ""
    sys.modules["tetmend._core"] = stub
    sys.path.insert(0, str(PACKAGE.parent))
    text = (PACKAGE / "_core.pyi").read_text()
    exec(compile(text, "_core.pyi", "exec", __future__.annotations.compiler_flag, True), stub.__dict__)
    for path in PACKAGE.glob("*.py"):
        name = "tetmend" if path.stem == "__init__" else f"tetmend.{path.stem}"
        for alias in ("ArrayLike", "NDArray"):
            vars(importlib.import_module(name)).pop(alias, None)
