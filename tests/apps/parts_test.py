# SPDX-License-Identifier: MIT
"""Meshes in parts, .pvtu and part_%d.msh, from outside: others read them, theirs are read, and a program that is killed
while files get their names leaves no mixture of old and new.

usage: parts_test.py TETMEND SOURCE_FOLDER
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = sys.argv[1]
MESHES = Path(sys.argv[2]) / "assets" / "meshes"
MESH, OTHER = MESHES / "bracket.meshb", MESHES / "two_materials.mesh"
failures = []


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details)


def run(*words):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=280)


def convert(mesh, out, *more):
    done = run(PROGRAM, "convert", mesh, out, *more)
    check(done.returncode == 0, "convert", mesh, out, done.stderr)
    return done


def quality_of(mesh):
    return json.loads(run(PROGRAM, "quality", mesh, "--json").stdout)


def counts_of(mesh):
    """What does not depend on the order of points, nor on the last bits of coordinates."""
    told = quality_of(mesh)
    return {key: value for key, value in told.items() if isinstance(value, int)}


def remains(folder):
    return [each.name for each in folder.iterdir() if each.name.startswith(".tetmend")]


def tasks(folder):
    """A run by tasks over files has the bytes of improve, also in parts and from parts."""
    convert(MESH, folder / "in.pvtu", "--pieces", 3)
    done = run(PROGRAM, "improve", folder / "in.pvtu", "-o", folder / "one.pvtu", "--pieces", 4, "-q")
    check(done.returncode == 0, "improve of parts", done.stderr)
    done = run(PROGRAM, "pieces", "split", folder / "work", folder / "in.pvtu", "-o", folder / "two.pvtu", "--pieces", 4)
    check(done.returncode == 0, "split of parts", done.stderr)
    while done.returncode == 0 and not json.loads((folder / "work" / "plan.json").read_text())["finished"]:
        run(PROGRAM, "pieces", "improve", folder / "work", "-q")
        done = run(PROGRAM, "pieces", "join", folder / "work", "-q")
        check(done.returncode == 0, "join to parts", done.stderr)
    parts = [(folder / name / f"{name}_{i}.vtu").read_bytes() for name in ("one", "two") for i in range(4)]
    check(parts[:4] == parts[4:], "tasks write other parts")


def only_read(folder):
    """quality, check and surface find in parts what they find in the whole."""
    for mesh, name in ((OTHER, "other.pvtu"), (MESH, "bracket_%d.msh")):
        parts, whole = folder / name, counts_of(mesh)
        convert(mesh, parts, "--pieces", 3)
        check(len(whole) > 4 and counts_of(parts) == whole, "quality of parts", name, counts_of(parts), whole)
        done = run(PROGRAM, "check", mesh, parts, "--min-dihedral", 0)
        check(done.returncode == 0 and "FAIL" not in done.stdout, "check of parts", name, done.stdout, done.stderr)
        done = run(PROGRAM, "check", parts, "--min-dihedral", 70)
        check(done.returncode == 3, "a threshold that parts miss", name, done.returncode, done.stderr)
        counted = []
        for each in (mesh, parts):
            done = run(PROGRAM, "surface", each, folder / "out.stl")
            features = run(PROGRAM, "surface", each, "--features")
            check(features.returncode == 0, "features of parts", name, features.stderr)
            counted.append((done.returncode, done.stdout.split(": ")[-1], features.stdout.split(": ")[-1]))
        check(counted[0][0] == 0 and counted[0] == counted[1], "surface of parts", name, counted)
    done = run(PROGRAM, "quality", folder / "bracket_%d.msh", "--list", 3, "--cells", folder / "bad.vtu")
    bad = quality_of(MESH)["n_bad"]
    check(done.returncode == 0 and bad > 3 and quality_of(folder / "bad.vtu")["tets"] == bad, "bad tets of parts", done.stderr)


def older_parts(folder):
    """Those of a mesh with more parts go with it; what is not named in it stays."""
    convert(MESH, folder / "out.pvtu", "--pieces", 4)
    for name in ("out_7.vtu", "notes.txt"):
        (folder / "out" / name).write_text("of the user")
    convert(OTHER, folder / "out.pvtu", "--pieces", 2)
    left = sorted(each.name for each in (folder / "out").iterdir())
    check(left == ["notes.txt", "out_0.vtu", "out_1.vtu", "out_7.vtu"], "parts of the older mesh", left)
    check(counts_of(folder / "out.pvtu") == counts_of(OTHER), "the newer mesh")


def only_read_mistakes(folder):
    convert(OTHER, folder / "in.pvtu", "--pieces", 3)
    convert(OTHER, folder / "in_%d.msh", "--pieces", 3)
    (folder / "in_2.msh").unlink()  # then in_3.msh is no part
    index = (folder / "in.pvtu").read_text()
    (folder / "less.pvtu").write_text(index.replace("in_1.vtu", "none.vtu"))
    (folder / "twice.pvtu").write_text(index.replace("in_1.vtu", "in_0.vtu"))
    (folder / "bad.pvtu").write_text("<VTKFile>\n<PUnstructuredGrid>\n")
    for name, text in (("less.pvtu", "none.vtu"), ("twice.pvtu", "twice.pvtu: "), ("bad.pvtu", "the XML is broken"),
                       ("none.pvtu", "there is no such file"), ("in_%d.msh", "in_2.msh: there is no such file, but in_3.msh"),
                       ("none_%d.msh", "none_1.msh: there is no such file")):
        for words in (("quality", folder / name), ("check", folder / name, "--no-inverted", "--measure", "mean_ratio=0"),
                      ("surface", folder / name, folder / "x.off"), ("surface", folder / name, "--features")):
            done = run(PROGRAM, *words)
            lines = done.stderr.splitlines()
            check(done.returncode == 1 and len(lines) == 1 and text in lines[0], "a mistake", words, done.returncode, done.stderr)
    check(not (folder / "x.off").exists(), "written in spite of a mistake")


def seen_by_vtk(folder):
    script = """
import sys
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader
reader = vtkXMLPUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
ids = grid.GetPointData().GetArray("GlobalNodeId")
labels = grid.GetCellData().GetArray("CellEntityIds")
tets = [i for i in range(grid.GetNumberOfCells()) if grid.GetCellType(i) == 10]
print(len(tets), len({int(ids.GetTuple1(i)) for i in range(grid.GetNumberOfPoints())}),
      sorted({int(labels.GetTuple1(i)) for i in tets}), grid.GetBounds())
"""
    if run("/usr/bin/python3", "-c", "from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader").returncode != 0:
        print("VTK is not there: .pvtu was not tried with it")
        return
    convert(OTHER, folder / "seen.pvtu", "--pieces", 3)
    done = run("/usr/bin/python3", "-c", script, folder / "seen.pvtu")
    mesh = quality_of(OTHER)
    seen = re.match(r"(\d+) (\d+) (\[.*?\]) ", done.stdout)
    points = int(re.search(r"Vertices\s+(\d+)", OTHER.read_text()).group(1))
    check(seen and int(seen.group(1)) == mesh["tets"] and int(seen.group(2)) == points and seen.group(3) == "[1, 2]",
          "VTK sees another mesh", done.stdout, done.stderr[-500:], mesh["tets"], points)


def parts_of_gmsh(folder):
    if shutil.which("gmsh") is None:
        print("gmsh is not there: its partitions were not tried")
        return
    convert(OTHER, folder / "plain.msh")
    for name, split in (("cut.msh", ["-part_split"]), ("one.msh", [])):
        done = run("gmsh", "-part", "3", *split, "-format", "msh41", "-save", "-o", folder / name, folder / "plain.msh")
        check(done.returncode == 0, "gmsh makes no parts", done.stdout[-500:], done.stderr)
    whole = counts_of(OTHER)
    for name in ("cut_%d.msh", "one.msh"):
        done = convert(folder / name, folder / "joined.meshb")
        check("partitions of elements are not kept" in done.stderr, "nothing is said of partitions", name, done.stderr)
        check(len(whole) > 4 and counts_of(folder / "joined.meshb") == whole, "parts of gmsh are another mesh", name, whole)
    convert(OTHER, folder / "ours_%d.msh", "--pieces", 3)
    done = run("gmsh", "-check", "-", *(folder / f"ours_{i}.msh" for i in (1, 2, 3)))
    check("Error" not in done.stdout + done.stderr, "gmsh does not read our parts", done.stdout[-500:], done.stderr)


def mistakes(folder):
    (folder / "taken").write_text("of the user")
    for words, text in (
            ((MESH, folder / "taken.pvtu"), "is no folder"), ((folder / "none.pvtu", folder / "x.meshb"), "there is no such file"),
            ((folder / "none_%d.msh", folder / "x.meshb"), "none_1.msh: there is no such file"),
            ((MESH, folder / "x.meshb", "--pieces", 3), "no mesh in parts"),
            ((MESH, folder / "x_%d.msh", "--variant", "2.2 ASCII"), "there is only one")):
        done = run(PROGRAM, "convert", *words)
        check(done.returncode in (1, 2) and text in done.stderr, "a mistake", words, done.returncode, done.stderr)
    check((folder / "taken").read_text() == "of the user", "a file was overwritten")
    (folder / "bad.pvtu").write_text("<VTKFile>\n<PUnstructuredGrid>\n")
    done = run(PROGRAM, "convert", folder / "bad.pvtu", folder / "x.meshb")
    check(re.search(r"bad\.pvtu:[23]: the XML is broken", done.stderr), "broken XML", done.stderr)
    check(not remains(folder), "drafts are left", remains(folder))


def interrupted(folder):
    """The n-th rename fails, or is the end of the program."""
    if shutil.which("strace") is None or run("strace", "-qq", "-o", "/dev/null", "true").returncode != 0:
        print("no strace here: no end between two names was tried")
        return
    for name, index in (("out.pvtu", "out.pvtu"), ("out_%d.msh", "out_1.msh")):
        out, now = folder / name, folder / "now.meshb"
        before, after = (folder / f"{which}.meshb" for which in ("before", "after"))
        convert(MESH, out, "--pieces", 4)
        convert(out, before)
        convert(OTHER, folder / f"after-{name}", "--pieces", 3)
        convert(folder / f"after-{name}", after)
        ends, states = ["signal=SIGKILL", "error=EIO"], set()
        for end in ends:
            for number in range(1, 40):
                shutil.rmtree(folder / "out", ignore_errors=True)
                for each in folder.glob("out_*.msh"):
                    each.unlink()
                convert(MESH, out, "--pieces", 4)
                done = run("strace", "-f", "-qq", "-o", "/dev/null", "-e", f"inject=rename:{end}:when={number}",
                           PROGRAM, "convert", OTHER, out, "--pieces", 3)
                if (folder / index).exists():
                    convert(out, now)
                    state = {before.read_bytes(): "old", after.read_bytes(): "new"}.get(now.read_bytes(), "mixture")
                else:
                    state = "none"
                wanted = {"new"} if done.returncode == 0 else {"old"} if "EIO" in end else {"old", "none"}
                check(state in wanted, "after an end between two names", name, end, number, state, done.returncode, done.stderr)
                if state == "none" and name == "out_%d.msh":
                    check("out_1.msh: there is no such file" in run(PROGRAM, "convert", out, now).stderr, "read without part 1")
                states.add((end, state))
                for each in remains(folder):
                    check("KILL" in end, "drafts are left", name, end, number, each)
                    shutil.rmtree(folder / each) if (folder / each).is_dir() else (folder / each).unlink()
                if done.returncode == 0 and number > 1:  # the first gives a lock its name, and a run does without
                    break
        check(states == {(ends[0], "old"), (ends[0], "none"), (ends[0], "new"), (ends[1], "old"), (ends[1], "new")},
              "not all ends were tried", name, states)
        check(not (folder / ("out_4.msh" if name == "out_%d.msh" else "out/out_3.vtu")).exists(), "a part of the older mesh is left")


def main() -> int:
    for test in (tasks, only_read, only_read_mistakes, older_parts, seen_by_vtk, parts_of_gmsh, mistakes, interrupted):
        with tempfile.TemporaryDirectory() as folder:
            test(Path(folder))
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
