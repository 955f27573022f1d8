# SPDX-License-Identifier: MIT
"""Names that are no plain text: of groups, arrays, files and options, in JSON, XML, HTML, SVG, DOT and on the terminal.

usage: names_test.py PROGRAM SOURCE_FOLDER
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

PROGRAM = sys.argv[1]
MESH = Path(sys.argv[2]) / "assets" / "meshes" / "two_materials.mesh"
FEW_TETS = Path(sys.argv[2]) / "assets" / "lessons" / "1-core.mesh"
failures = []

# Bytes, and what is shown for them.
NAMES = {
    b"caf\xe9": "café",
    b"Temp\xe9rature \xff\xfe": "Température ÿþ",
    b"\x1b]0;title\x07\x1b[31mred": r"\x1b]0;title\x07\x1b[31mred",
    "\u202eevil\u2066\u2028".encode(): r"\u202eevil\u2066\u2028",
    b"\xef\xbf\xbe\xef\xbf\xbf": r"\ufffe\uffff",
    b"\xed\xa0\x80": "í\u00a0\\x80",
    b"\x7f\xc2\x9b31m": r"\x7f\x9b31m",
    "網 ≥ 🙂".encode(): "網 ≥ 🙂",
}
ACTED_ON = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufffe\uffff]")


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *(ascii(detail) for detail in details))


def run(*arguments):
    """Status, and what was said, which any terminal takes."""
    done = subprocess.run([os.fsencode(PROGRAM), *map(os.fsencode, arguments)], capture_output=True, timeout=120)
    said = []
    for stream in (done.stdout, done.stderr):
        try:
            said.append(stream.decode())
        except UnicodeDecodeError:
            check(False, "what is said is UTF-8", arguments, stream[:200])
            said.append(stream.decode("latin1"))
    check(not ACTED_ON.search("".join(said)), "a terminal acts on nothing that is said", arguments, said)
    check("json.exception" not in said[1], "a library's words reach nobody", arguments, said[1])
    return done.returncode, *said


def with_names(group, array):
    """The mesh as .msh, with a group and an array over tets."""
    def quoted(name):
        return b'"' + name + b'"'
    words = MESH.read_text().split()
    at = words.index("Vertices")
    points = [words[at + 2 + 4 * i: at + 5 + 4 * i] for i in range(int(words[at + 1]))]
    at = words.index("Tetrahedra")
    tets = [words[at + 2 + 5 * i: at + 6 + 5 * i] for i in range(int(words[at + 1]))]
    lines = [b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 " + quoted(group) + b"\n$EndPhysicalNames"]
    lines += [b"$Nodes\n%d" % len(points)]
    lines += [f"{i + 1} {' '.join(p)}".encode() for i, p in enumerate(points)] + [b"$EndNodes\n$Elements\n%d" % len(tets)]
    lines += [f"{i + 1} 4 2 1 1 {' '.join(t)}".encode() for i, t in enumerate(tets)] + [b"$EndElements"]
    lines += [b"$ElementData\n1\n" + quoted(array) + b"\n1\n0\n3\n0\n1\n%d" % len(tets)]
    lines += [f"{i + 1} {i}".encode() for i in range(len(tets))] + [b"$EndElementData\n"]
    return b"\n".join(lines)


def names_of_groups_and_arrays():
    for name, shown in NAMES.items():
        is_plain = name.decode("utf8", "replace") == shown
        mesh = b"in.msh"
        Path("in.msh").write_bytes(with_names(name, name))
        status, _, err = run("improve", mesh, "-o", "out.vtu", "--report", "r.json", "--report", "r.html")
        check(status == 0, "a mesh with such names is improved", name, err)
        root = xml.etree.ElementTree.parse("out.vtu").getroot()
        names = [array.get("Name") for array in root.iter("DataArray")]
        check(shown in names, "XML has the name as text", name, names)
        check(("is not kept as it is" in err) == (not is_plain), "a note names the array whose name changes", name, err)
        report = json.loads(Path("r.json").read_bytes().decode())
        check(shown in [array["name"] for array in report["data"]], "JSON has the same name", name, report["data"])
        check(("r.json: " in err) == (not is_plain) and (is_plain or shown in err), "a note names what is written otherwise",
              name, err)
        page = Path("r.html").read_bytes().decode()
        check(not ACTED_ON.search(page), "the page is text", name)
        check(run("convert", mesh, "parts.pvtu", "--pieces", "2")[0] == 0, "parts are written", name)
        for part in [Path("parts.pvtu"), *Path("parts").iterdir()]:
            names = [array.get("Name") for array in xml.etree.ElementTree.parse(part).getroot().iter() if array.get("Name")]
            check(shown in names, "parts have the name as text", name, names)
        status, out, _ = run("improve", mesh, "-o", "out.msh")
        check(status == 0 and name in Path("out.msh").read_bytes() or b"\x1b" in name or b"\x7f" in name,
              "a format that takes any bytes keeps them", name)
        for arguments in (("quality", mesh, "--json"), ("check", mesh, "out.msh", "--json")):
            status, out, err = run(*arguments)
            check(json.loads(out) and status in (0, 3), "JSON on standard output can be read", name, arguments, err)
        run("check", mesh, "out.msh")


def names_of_files():
    for name, shown in NAMES.items():
        mesh = name + b".mesh"
        shutil.copy(os.fsencode(FEW_TETS), mesh)
        trace = name + b".trace"
        status, _, err = run("improve", mesh, "-o", b"out" + mesh, "--report", name + b".json", "--report", "r.html", "--trace", trace)
        check(status == 0, "a mesh of such a name is improved", name, err)
        report = json.loads(Path(os.fsdecode(name + b".json")).read_bytes().decode())
        check(report["input"] == shown + ".mesh", "JSON has the name as text", name, report["input"])
        check(not ACTED_ON.search(Path("r.html").read_bytes().decode()), "the page is text", name)
        check(shown + ".mesh" in err or not shown.startswith("caf"), "a note names the file", name, err)
        for options, made in ((("--html", "-o", "t.html"), "t.html"), (("--slices", "-o", "t.json"), "t.json"),
                              (("--dot", "0", "-o", "t.dot"), "t.dot"),
                              (("--figure", "timeline", "-o", "t.svg"), "t.svg"), (("--extract", "0", "-o", "kit"), "kit/call.lua")):
            status, _, err = run("trace", trace, *options)
            check(status == 0, "what was recorded is shown, with its report beside it", name, options, err)
            check(not ACTED_ON.search(Path(made).read_bytes().decode()), "what is made of a trace is text", name, made)
            if made.endswith(".svg"):
                xml.etree.ElementTree.parse(made)
        json.loads(Path("t.json").read_text())
        folder = name + b".run"
        status, _, err = run("pieces", "split", folder, MESH, "-o", b"pieces" + mesh, "--pieces", "2")
        check(status == 0, "a run in pieces begins", name, err)
        plan = json.loads(Path(os.fsdecode(folder + b"/plan.json")).read_bytes().decode())
        check(plan["output"].endswith(shown + ".mesh"), "the plan has the name as text", name, plan)
        Path(os.fsdecode(b"broken" + mesh)).write_bytes(b"x" + name)
        for arguments in (("quality", b"none" + mesh), ("quality", b"broken" + mesh), ("quality", name),
                          ("improve", mesh, "-o", b"no/" + mesh), ("improve", mesh, "-o", mesh, "--report", b"no/" + name + b".json")):
            status, _, err = run(*arguments)
            check(status in (1, 2) and err.count("\n") == 1, "an error is one line", name, arguments, err)
        for option in ("--schedule", "--set", "--protect", "--conserve", "--label-array", "--goal", "--variant", name):
            status, _, err = run("improve", mesh, "-o", "o.mesh", option, name)
            check(status in (1, 2) and err.count("\n") == 1, "a wrong option is one line", name, option, err)


home = os.getcwd()
with tempfile.TemporaryDirectory(prefix="tetmend-") as work:
    os.chdir(work)
    names_of_groups_and_arrays()
    names_of_files()
    os.chdir(home)
sys.exit(f"{len(failures)} checks failed" if failures else 0)
