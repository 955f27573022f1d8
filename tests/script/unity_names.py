# SPDX-License-Identifier: MIT
"""Finds sources that cannot be compiled as one with others of their target (cmake/unity.cmake), for both have a name of
their own that is the same.

    unity_names.py ROOT           fails where there are any, and says the names
"""

import collections
import pathlib
import re
import sys

FOLDERS = "platform kernel trace search envelope ops contract schedule face pieces mpi figure explain report bindings/c " \
          "bindings/python viewer apps tests/apps tests/envelope tests/explain tests/face tests/pieces tests/report " \
          "tests/viewer tests/unit".split()
UNIT = ("tests/platform/", "tests/kernel/", "tests/trace/", "tests/search/", "tests/ops/", "tests/schedule/", "tests/contract/")
PYTHON_CHARTS = ("report/", "explain/json_text.cpp", "explain/page_text.cpp", "figure/markup.cpp", "kernel/printable.cpp")
# Programs of one source, and code of another system: never compiled as one with the others of their folder.
APART = ("apps/tetmend_mpi.cpp", "apps/tetmend_view.cpp", "platform/platform_windows.cpp")
DECLARED = re.compile(
    r"^(?:template <[^;{]*> *)?(?:(?:struct|class|enum(?: class)?|union|concept) (?P<type>\w+)"
    r"|using (?P<alias>\w+) ="
    r"|(?:namespace) (?P<space>\w+) ="
    r"|(?:[\w:<>,&*\[\]\" ]|\([^()]*\))*?[\w>&*\]] ?[&*]*\b(?P<name>\w+)(?= ?(?:\(|\{|=|\[|;)))")


def own_names(text):
    """Names that a source declares for itself: at the beginning of a line in an unnamed namespace, or static."""
    names, inside = set(), False
    for line in text.splitlines():
        if line == "namespace {":
            inside = True
        elif line == "}  // namespace":
            inside = False
        elif inside or line.startswith("static ") or (line.startswith("using ") and "namespace" not in line):
            if not line or line[0] in " }#/)":
                continue
            if line.startswith("using ") and "=" not in line:
                continue  # the same name of the same thing
            match = DECLARED.match(line)
            if match:
                names.add(next(name for name in match.groups() if name))
    return names


def group_of(path):
    """Sources of one group may be compiled as one."""
    if path.startswith(UNIT):
        return "tests/unit"
    if path.startswith("tests/figure/"):
        return "tests/explain"
    return max((folder for folder in FOLDERS if path.startswith(folder + "/")), key=len, default=None)


def shared_names(root):
    """(group, name, sources) of each private name that several sources of a group have."""
    groups = collections.defaultdict(lambda: collections.defaultdict(set))
    for path in sorted(root.glob("**/*.cpp")):
        source = path.relative_to(root).as_posix()
        group = None if source.startswith("build/") or source in APART else group_of(source)
        if group:
            also = ["bindings/python"] if source.startswith(PYTHON_CHARTS) else []
            for name in own_names(path.read_text(encoding="utf-8")):
                for of in [group, *also]:
                    groups[of][name].add(source)
    return [(group, name, sorted(sources)) for group, names in sorted(groups.items())
            for name, sources in sorted(names.items()) if len(sources) > 1]


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    shared = shared_names(pathlib.Path(sys.argv[1]))
    for _, name, sources in shared:
        print(f"{name} is a private name of {' and '.join(sources)}, which are compiled as one: give it another in one of them, "
              "or one place for all")
    return 1 if shared else 0


if __name__ == "__main__":
    sys.exit(main())
