# SPDX-License-Identifier: MIT
"""Finds the sources that cannot be compiled as one with others of their folder, for both have a name of their own that is
the same: cmake/unity_alone.txt lists them, cmake/unity.cmake reads it.

    unity_names.py ROOT           fails where a source is missing in the list
    unity_names.py ROOT --write   writes the list; lines below "# By hand" stay
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
BY_HAND = "# By hand: names that only a compiler sees."
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


def alone(root, known=()):
    """For each group, as few sources as are found quickly, besides the known, such that no two of the others share a name."""
    groups = collections.defaultdict(dict)
    for path in sorted(root.glob("**/*.cpp")):
        name = path.relative_to(root).as_posix()
        group = None if name.startswith("build/") or name in APART else group_of(name)
        if group:
            names = own_names(path.read_text(encoding="utf-8"))
            groups[group][name] = names
            if name.startswith(PYTHON_CHARTS):
                groups["bindings/python"][name] = names
    result = set(known)
    for sources in groups.values():
        while True:
            holders = collections.defaultdict(list)
            for source in sources:
                for name in sources[source] if source not in result else ():
                    holders[name].append(source)
            clashes = collections.Counter(s for held in holders.values() if len(held) > 1 for s in held for _ in held[1:])
            if not clashes:
                break
            result.add(max(sorted(clashes), key=clashes.get))
    return result


def main():
    root = pathlib.Path(sys.argv[1])
    file = root / "cmake/unity_alone.txt"
    lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    by_hand = lines[lines.index(BY_HAND) + 1:] if BY_HAND in lines else []
    if not sys.argv[2:]:
        missing = sorted(alone(root, lines) - set(lines))
        for name in missing:
            print(f"{name} shares a name of its own with a source that it may be compiled with: give it another, or run "
                  "tests/script/unity_names.py . --write")
        return 1 if missing else 0
    if sys.argv[2:] == ["--write"]:
        found = sorted(alone(root, by_hand) - set(by_hand))
        head = "# Sources that are compiled alone: written by tests/script/unity_names.py, read by unity.cmake."
        file.write_text("\n".join([head, *found, BY_HAND, *by_hand]) + "\n", encoding="utf-8")
        print(len(found), "sources, and by hand", len(by_hand))
        return 0
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
