# SPDX-License-Identifier: MIT
"""tetmend-mpi and `tetmend pieces` from outside: the bytes of `tetmend improve --pieces`, also after a kill.

usage: mpi_test.py TETMEND TETMEND_MPI|none SOURCE_FOLDER
"""

import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAM, MPI_PROGRAM = sys.argv[1:3]
MESHES = Path(sys.argv[3]) / "assets" / "meshes"
MESH = MESHES / "bracket.meshb"
PIECES = 6
RANKS_MAY_SHARE_CORES = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                         "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
                         "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
failures = []


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details)


def run(*words, **environment):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=280,
                          env=dict(os.environ, **RANKS_MAY_SHARE_CORES, **environment))


def mpi(ranks, *arguments):
    return ["mpirun", "-n", str(ranks), MPI_PROGRAM, "improve", *map(str, arguments)]


def improve(folder, *more):
    return [MESH, "-o", folder / "out.meshb", "--pieces", PIECES, *more]


def taken(folder):
    """The bytes of the output, which is not there any more then."""
    out = folder / "out.meshb"
    if not out.exists():
        return None
    content = out.read_bytes()
    out.unlink()
    return content


def ranks_of(starter):
    """Processes of the program that mpirun has started, by what the system says of each process."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            if parent == starter and os.readlink(entry / "exe") == os.path.realpath(MPI_PROGRAM):
                found.append(int(entry.name))
        except (OSError, ValueError, IndexError):
            pass
    return found


def any_number_of_ranks(folder, expected):
    for ranks, threads in [(1, 2), (2, 1), (2, 2), (3, 1), (8, 1)]:
        done = run(*mpi(ranks, *improve(folder, "--threads", threads, "-q")))
        check(done.returncode == 0 and taken(folder) == expected, "other bytes", ranks, threads, done.stderr)
    done = run(*mpi(3, *improve(folder, "-q")), TETMEND_MPI_MESSAGE_BYTES="4096")
    check(done.returncode == 0 and taken(folder) == expected, "cut messages show", done.stderr)
    done = run(*mpi(3, *improve(folder, "-q")), TETMEND_MPI_FIRST_VERTEX_ID=str(2**33))
    check(done.returncode == 0 and taken(folder) == expected, "ids of vertices show", done.stderr)
    report = folder / "report.json"
    done = run(*mpi(2, *improve(folder, "-v", "--report", report)))
    check("worse than before    nothing" in done.stdout, "there is no report", done.stdout)
    check(json.loads(report.read_text())["after"]["n_bad"] == 0, "bad tets are left")
    check(done.stdout.count("peak memory") == 1, "not one rank alone reports")
    ranks = json.loads(report.read_text())["ranks"]
    check("bytes a tet and division, 2 processes" in done.stdout, "there is no traffic", done.stdout)
    check(len(ranks["peak_memory_bytes"]) == 2 and 1 < ranks["bytes_a_tet_and_division"] < 35, "traffic", ranks)
    check(len(ranks["parts"]) >= 3 * PIECES and all(each["tets"] > 30000 for each in ranks["divisions"]), "parts", ranks)
    taken(folder)
    whole = folder / "whole.meshb"
    done = run(*mpi(2, MESH, "-o", whole, "-q"))
    run(PROGRAM, "improve", MESH, "-o", folder / "alone.meshb", "-q")
    check(whole.read_bytes() == (folder / "alone.meshb").read_bytes(), "one piece is not the run of improve")


def adapts(folder):
    """Lengths of places: the bytes and figures of a run that has the whole mesh, from checkpoints and any number of ranks."""
    script = folder / "size.lua"
    script.write_text("function size(x, y, z) return 2 + 0.05 * math.abs(x) end")
    report = folder / "adapted.json"

    def sizes():
        found = json.loads(report.read_text())["sizes"]
        report.unlink()
        return found

    def words(size, *more):
        return [MESH, "--size", size, "-o", folder / "out.meshb", "--pieces", 4, "--set", "improve=false", "-q", "--report", report, *more]

    done = run(PROGRAM, "adapt", *words(script))
    expected, whole = taken(folder), sizes()
    check(done.returncode == 0 and whole["after"]["in_range"] > 1.5 * whole["before"]["in_range"], "adapt in pieces", done.stderr, whole)
    commands = [[PROGRAM, "adapt", *words(script, "--checkpoint", folder / "saved")]]
    if MPI_PROGRAM != "none":
        commands.append(["mpirun", "-n", "3", MPI_PROGRAM, "adapt", *words(script)])
    for command in commands:
        done = run(*command)
        check(done.returncode == 0 and taken(folder) == expected, "another adapted mesh", command, done.stderr)
        found = sizes()
        for moment in ("before", "after"):
            for name, value in whole[moment].items():
                now = found[moment][name]
                if name == "off_between_walls":  # between pieces nobody knows
                    same = now <= value
                elif isinstance(value, float):
                    same = math.isclose(now, value, rel_tol=1e-9)
                else:
                    same = now == value
                check(same, "other sizes", command, moment, name, now, value)
    saved = words(script, "--checkpoint", folder / "stopped", "--time-limit", "2")
    done = run(PROGRAM, "adapt", *saved)
    if taken(folder) != expected:  # stopped between two divisions, as a rule
        script.write_text("function size(x, y, z) return 3 end")
        done = run(PROGRAM, "adapt", *saved)
        check(done.returncode == 1 and "with other options" in done.stderr, "another function goes on", done.stderr)
        done = run(PROGRAM, "adapt", *words("3", "--checkpoint", folder / "stopped"))
        check(done.returncode == 1 and "with other options" in done.stderr, "another length goes on", done.stderr)
        done = run(PROGRAM, "pieces", "improve", folder / "stopped")
        check(done.returncode == 1 and "repeat the command" in done.stderr, "tasks of adapt", done.returncode, done.stderr)
    done = run(PROGRAM, "adapt", *words("0.5x", "--memory", "1G"))
    check(done.returncode == 2 and "--size 0.5x: needs the whole mesh in memory" in done.stderr and taken(folder) is None,
          "a size that the whole mesh tells", done.returncode, done.stderr)


def traces(folder):
    """Of one piece: the bytes of `tetmend improve`, and what cannot be is an error that loses nothing."""
    trace = folder / "run.trace"

    def made():
        content = trace.read_bytes() if trace.exists() else None
        trace.unlink(missing_ok=True)
        return content

    for piece in ([], ["--trace-piece", "2:3"], ["--trace-around", "17"]):
        options = ["--trace", trace, *piece, "-q"]
        done = run(PROGRAM, "improve", *improve(folder, *options))
        mesh, expected = taken(folder), made()
        check(done.returncode == 0 and expected is not None, "a trace of a piece", piece, done.stderr)
        done = run(PROGRAM, "improve", *improve(folder, "--memory", "1G", *options))
        check(made() == expected and taken(folder) == mesh, "another trace out of core", piece, done.stderr)
        if MPI_PROGRAM == "none":
            continue
        for ranks in (1, 3, 8):
            done = run(*mpi(ranks, *improve(folder, "--threads", 2, *options)))
            check(done.returncode == 0 and made() == expected and taken(folder) == mesh, "another trace", ranks, piece,
                  done.stderr)
    trace.write_bytes(expected)
    done = run(PROGRAM, "trace", trace)
    check(done.returncode == 0 and "--pieces = 6, --trace-piece = 1:" in done.stdout, "tetmend trace", done.stdout)
    made()
    wrong = [(PROGRAM, "improve", *improve(folder, "--trace", trace, "--trace-piece", "1:6")),
             (PROGRAM, "improve", MESH, "-o", folder / "out.meshb", "--trace", trace, "--trace-piece", "1:1")]
    if MPI_PROGRAM != "none":
        wrong.append(mpi(2, *improve(folder, "--trace", trace, "--trace-piece", "1:6")))
    for command in wrong:
        done = run(*command)
        check(done.returncode == 2 and done.stderr.count("--trace-piece: ") == 1, "a piece that is not there", command,
              done.returncode, done.stderr)
        check(taken(folder) is None and made() is None, "something was written", command)
    late = improve(folder, "--trace", trace, "--trace-piece", "4:900", "-q")
    for command in [(PROGRAM, "improve", *late)] + ([mpi(2, *late)] if MPI_PROGRAM != "none" else []):
        done = run(*command)
        check(done.returncode == 1 and f"{trace}: " in done.stderr, "a zone that is not there", command, done.returncode,
              done.stderr)
        check(taken(folder) is None and made() is None, "a zone that is not there", command)


def mistakes(folder):
    done = run(*mpi(3, folder / "none.meshb", "-o", folder / "out.meshb"))
    check(done.returncode == 1 and done.stderr.count("none.meshb") == 1, "a missing mesh", done.returncode, done.stderr)
    done = run(*mpi(2, *improve(folder, "--threads", "many")))
    check(done.returncode == 2 and done.stderr.count("threads") == 1, "a wrong option", done.returncode, done.stderr)
    done = run(*mpi(2, *improve(folder, "--keep-size")))
    check(done.returncode == 2 and "needs the whole mesh" in done.stderr, "keep-size", done.stderr)
    done = run(*mpi(2, *improve(folder, "--protect", "label:77")))
    check(done.returncode != 0 and done.stderr.count("no tet has label 77") == 1, "a region without tets",
          done.returncode, done.stderr)
    check(taken(folder) is None, "there is an output after a mistake")


def killed_rank(folder, expected):
    saved = folder / "saved"
    command = mpi(3, *improve(folder, "-q", "--checkpoint", saved))
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True,
                          env=dict(os.environ, **RANKS_MAY_SHARE_CORES)) as starter:
        while not (saved / "run").exists() and starter.poll() is None:
            time.sleep(0.002)
        ranks = ranks_of(starter.pid)
        check(len(ranks) == 3, "there are not three ranks", ranks)
        os.kill(ranks[1], signal.SIGKILL)
        begin = time.monotonic()
        said = starter.communicate(timeout=60)[1]
        check(time.monotonic() - begin < 10, "the others go on without the one that died")
        check(starter.returncode not in (0, None) and "signal 9" in said, "nobody says so", starter.returncode, said)
    check(taken(folder) is None, "there is an output of a killed run")
    check((saved / "run").exists(), "there is no checkpoint")
    done = run(*mpi(2, *improve(folder, "-q", "--goal", "20", "--checkpoint", saved)))
    check(done.returncode == 1 and "other options" in done.stderr, "the checkpoint of other options", done.stderr)
    done = run(*mpi(2, *improve(folder, "-q", "--checkpoint", saved)))
    check(done.returncode == 0 and taken(folder) == expected, "other bytes after a kill", done.stderr)
    check(not saved.exists(), "the checkpoint is still there")


def files_of_hdf5(folder, expected):
    whole = folder / "whole.h5"
    done = run("mpirun", "-n", "3", MPI_PROGRAM, "convert", MESH, whole)
    if done.returncode == 2:
        print("tetmend-mpi has no HDF5: .h5 was not tried", done.stderr)
        return
    check(done.returncode == 0, "convert to .h5", done.stderr)
    done = run("mpirun", "-n", "2", MPI_PROGRAM, "convert", whole, folder / "again.meshb")
    run(PROGRAM, "convert", MESH, folder / "same.meshb")
    check((folder / "again.meshb").read_bytes() == (folder / "same.meshb").read_bytes(), "convert there and back",
          done.stderr)
    contents = set()
    for ranks in (1, 2, 3, 8):
        done = run(*mpi(ranks, whole, "-o", folder / "out.h5", "--pieces", PIECES, "-q"))
        check(done.returncode == 0, "improve of .h5", ranks, done.stderr)
        contents.add((folder / "out.h5").read_bytes())
        (folder / "out.h5").unlink()
    check(len(contents) == 1, "the number of ranks shows in .h5")
    check("out.h5:/connect" in (folder / "out.xdmf").read_text(), "there is no .xdmf")
    done = run(*mpi(3, whole, "-o", folder / "out.meshb", "--pieces", PIECES, "-q"))
    check(taken(folder) == expected, "other bytes from .h5", done.stderr)
    done = run(*mpi(2, MESH, "-o", folder / "out.h5", "--pieces", PIECES, "-q"))
    check((folder / "out.h5").read_bytes() in contents, ".h5 is another where the input is none", done.stderr)
    (folder / "none.h5").write_text("no HDF5")
    done = run(*mpi(2, folder / "none.h5", "-o", folder / "out.meshb", "-q"))
    check(done.returncode == 1 and "none.h5: is no HDF5 file" in done.stderr, "no HDF5", done.stderr)
    seen_by_meshio(folder)


def seen_by_meshio(folder):
    """A reader of others, by .xdmf and the arrays that it names."""
    script = ("import sys, meshio; mesh = meshio.read(sys.argv[1]); before = meshio.read(sys.argv[2]); "
              "tets = mesh.cells_dict['tetra']; "
              "print(len(tets), len(mesh.points), int(tets.max()), abs(mesh.points).max() == abs(before.points).max(), "
              "len(mesh.cell_data_dict['group']['tetra']))")
    if run("/usr/bin/python3", "-c", "import meshio, h5py").returncode != 0:
        print("meshio or h5py is not there: .xdmf was not tried")
        return
    done = run("/usr/bin/python3", "-c", script, folder / "out.xdmf", folder / "whole.xdmf")
    seen = done.stdout.split()
    check(len(seen) == 5 and int(seen[0]) > 30000 and int(seen[2]) == int(seen[1]) - 1 and seen[3] == "True" and
          seen[4] == seen[0], "meshio sees another mesh", done.stdout, done.stderr[-300:])


def write_data(folder):
    """A mesh with arrays, also with names that HDF5 has no path for; as tetmend writes it."""
    run(PROGRAM, "convert", MESHES / "two_materials.mesh", folder / "plain.vtu")
    text = (folder / "plain.vtu").read_bytes()
    points, cells = (int(re.search(rb'NumberOf%s="(\d+)"' % kind, text)[1]) for kind in (b"Points", b"Cells"))

    def array(kind, name, components, count):
        values = ((7 * i) % 1000 / (8 if kind[0] == "F" else 1) for i in range(count * components))
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
                + " ".join(f"{value:g}" for value in values) + "</DataArray>\n").encode()

    of_points = b"".join(array(kind, name, components, points) for kind, name, components in (
        ("Float64", "temperature", 1), ("Float32", "a/b", 3), ("Int64", ".", 1), ("Int32", "x:y &lt;z", 2),
        ("Float64", " blank", 1)))
    of_cells = array("Float64", "density", 1, cells) + array("Float32", "stress", 9, cells) + array("Int64", "id", 1, cells)
    if b"<PointData>" not in text:
        text = text.replace(b"<CellData>", b"<PointData>\n</PointData>\n<CellData>", 1)
    text = text.replace(b"</PointData>", of_points + b"</PointData>").replace(b"</CellData>", of_cells + b"</CellData>")
    (folder / "ascii.vtu").write_bytes(text)
    done = run(PROGRAM, "convert", folder / "ascii.vtu", folder / "data.vtu")
    check(done.returncode == 0 and done.stderr == "", "a mesh with arrays", done.stderr)


def arrays_of_hdf5(folder):
    """They are those of one process with a .vtu file, for any number of ranks."""
    write_data(folder)
    data = folder / "data.vtu"
    contents = set()
    for ranks in (1, 2, 3, 8):
        done = run("mpirun", "-n", ranks, MPI_PROGRAM, "convert", data, folder / "data.h5")
        check(done.returncode == 0 and done.stderr == "", "arrays to .h5", ranks, done.stderr)
        contents.add((folder / "data.h5").read_bytes())
    check(len(contents) == 1, "the number of ranks shows in arrays of .h5")
    for way in ("data.h5", "data.pvtu"):
        if way != "data.h5":
            run("mpirun", "-n", 2, MPI_PROGRAM, "convert", folder / "data.h5", folder / way)
        done = run("mpirun", "-n", 3, MPI_PROGRAM, "convert", folder / way, folder / "again.vtu")
        check((folder / "again.vtu").read_bytes() == data.read_bytes(), "arrays there and back", way, done.stderr)
    for more in ([], ["--pieces", 3], ["--pieces", 3, "--conserve", "density"]):
        out, expected, improved = folder / "out.vtu", folder / "expected.vtu", set()
        run(PROGRAM, "improve", data, "-o", expected, "-q", *more)
        for ranks in (1, 2, 5):
            done = run(*mpi(ranks, folder / "data.h5", "-o", out, "-q", *more))
            check(done.returncode == 0 and done.stderr == "", "improve with arrays", ranks, more, done.stderr)
            check(out.read_bytes() == expected.read_bytes(), "other arrays from .h5", ranks, more)
            run(*mpi(ranks, folder / "data.h5", "-o", folder / "improved.h5", "-q", *more))
            improved.add((folder / "improved.h5").read_bytes())
        run(*mpi(2, data, "-o", folder / "improved.h5", "-q", *more))
        improved.add((folder / "improved.h5").read_bytes())
        check(len(improved) == 1, "ranks or the format of the input show in improved arrays", more)
        done = run("mpirun", "-n", 2, MPI_PROGRAM, "convert", folder / "improved.h5", out)
        check(out.read_bytes() == expected.read_bytes(), "other arrays to .h5", more, done.stderr)
    done = run(*mpi(2, folder / "data.h5", "-o", folder / "report.h5", "--pieces", 3, "-v"))
    check(done.stdout.count("data of points 'a/b': linear in the old mesh") == 1, "no report of arrays", done.stdout)
    done = run(*mpi(2, folder / "data.h5", "-o", folder / "report.h5", "--pieces", 3, "--conserve", "id", "-q"))
    check(done.returncode != 0 and "id" in done.stderr, "integers are conserved", done.stderr)
    done = run("mpirun", "-n", 2, MPI_PROGRAM, "convert", folder / "data.h5", folder / "data_%d.msh")
    check(done.stderr.count("the array 'density' of tets is not written") == 1, "lost arrays are not named", done.stderr)
    arrays_seen_by_others(folder)


def arrays_seen_by_others(folder):
    """By h5py and meshio, if they are there. What h5py adds is read, or named."""
    if run("/usr/bin/python3", "-c", "import meshio, h5py").returncode != 0:
        print("meshio or h5py is not there: arrays of .h5 were not tried by others")
        return
    script = """
import sys, h5py, meshio, numpy
seen = meshio.read(sys.argv[1] + "/data.xdmf")
print(sorted(seen.point_data), [values[0].shape[1:] for values in seen.cell_data.values()], seen.point_data["a/b"][1].tolist())
with h5py.File(sys.argv[1] + "/data.h5", "r+") as file:
    print(sorted(file["point_data"]), file["cell_data/density"][5])
    points = len(file["geometry"])
    file["point_data/half"] = numpy.arange(points, dtype="f2")
    file["point_data/short"] = numpy.arange(points, dtype=">u2")
    file["point_data/cube"] = numpy.zeros((points, 2, 2))
    file["point_data/fewer"] = numpy.zeros(points - 1)
    file["point_data/unsigned"] = numpy.zeros(points, dtype="u8")
    file["point_data/more/deeper"] = numpy.zeros(points)
    file["point_data/array-2"].attrs["name"] = "renamed"
    file["edge_data/x"] = numpy.zeros(3)
    file["fields"] = numpy.zeros(3)
"""
    done = run("/usr/bin/python3", "-c", script, folder)
    lines = done.stdout.splitlines()
    check(lines == ["[' blank', '.', 'a/b', 'temperature', 'x:y <z'] [(), (), (9,), ()] [2.625, 3.5, 4.375]",
                    "['array-2', 'array-3', 'array-4', 'array-5', 'temperature'] 4.375"], "others see other arrays", done.stdout,
          done.stderr[-500:])
    done = run("mpirun", "-n", 3, MPI_PROGRAM, "convert", folder / "data.h5", folder / "more.vtu")
    for name in ("point_data/cube", "point_data/fewer", "point_data/unsigned", "point_data/more", "edge_data/x", "fields"):
        check(done.stderr.count(f"/{name} is not kept") == 1, "what is no array is not named", name, done.stderr)
    check(done.returncode == 0 and done.stderr.count("note:") == 6, "other notes", done.stderr)
    text = (folder / "more.vtu").read_bytes()
    for tag in (b'"Float32" Name="half"', b'"Int32" Name="short"', b'"Float32" Name="renamed"'):
        check(tag in text, "an array of others is not read", tag)
    check(b'Name="a/b"' not in text and b'Name="cube"' not in text, "an array that is not there")


def meshes_in_parts(folder):
    """Written and read by all processes: their number shows in neither."""
    for name in ("out.pvtu", "out_%d.msh"):
        contents = set()
        for ranks in (1, 3):
            done = run(*mpi(ranks, MESH, "-o", folder / name, "--pieces", PIECES, "-q"))
            check(done.returncode == 0, "improve to parts", name, done.stderr)
            parts = sorted([*folder.glob("out/*.vtu"), *folder.glob("out_*.msh"), *folder.glob("out.pvtu")])
            contents.add(tuple(part.read_bytes() for part in parts))
        check(len(contents) == 1 and len(parts) == PIECES + (name == "out.pvtu"), "processes show in parts", name, parts)
        whole = set()
        for command in (["mpirun", "-n", "2", MPI_PROGRAM], [PROGRAM]):
            done = run(*command, "convert", folder / name, folder / "again.meshb")
            check(done.returncode == 0, "convert of parts", name, command, done.stderr)
            whole.add((folder / "again.meshb").read_bytes())
        check(len(whole) == 1, "processes show in what is read of parts", name)
        run("mpirun", "-n", "3", MPI_PROGRAM, "convert", MESH, folder / name, "--pieces", 2)
        one = (folder / ("out.pvtu" if "pvtu" in name else "out_2.msh")).read_bytes()
        run(PROGRAM, "convert", MESH, folder / name, "--pieces", 2)
        two = (folder / ("out.pvtu" if "pvtu" in name else "out_2.msh")).read_bytes()
        check(one == two and not (folder / "out_3.msh").exists(), "processes show in converted parts", name)
        shutil.rmtree(folder / "out", ignore_errors=True)
        (folder / "out.pvtu").unlink(missing_ok=True)
        check(not [each for each in folder.iterdir() if each.name.startswith(".tetmend")], "drafts are left", name)


def tasks(folder, expected):
    work = folder / "work"
    done = run(PROGRAM, "pieces", "split", work, *improve(folder, "--check-operators"))
    check(done.returncode == 2 and "options of improve" in done.stderr, "split with a check", done.stderr)
    done = run(PROGRAM, "pieces", "split", work, *improve(folder))
    check(done.returncode == 0 and "division 1: pieces 0 to 5" in done.stdout, "split", done.stdout, done.stderr)
    check(run(PROGRAM, "pieces", "split", work, *improve(folder)).returncode == 1, "split into a folder with a run")
    done = run(PROGRAM, "pieces", "join", work)
    check(done.returncode == 1 and "6 of 6 pieces are not finished yet" in done.stderr, "join", done.stderr)
    check(run(PROGRAM, "pieces", "improve", work, "6").returncode == 1, "a piece that is not there")
    for wrong in (["--share", "2/2"], ["--share", "x"], ["one"], ["--pieces", "3"]):
        check(run(PROGRAM, "pieces", "improve", work, *wrong).returncode == 2, "wrong usage", wrong)
    done = run(PROGRAM, "pieces", "improve", work, "--trace", folder / "run.trace", "-q")
    check(done.returncode == 1 and "which must be named" in done.stderr, "a trace of all pieces", done.stderr)
    done = run(PROGRAM, "pieces", "improve", work, "5", "--trace", folder / "run.trace", "-q")
    check(done.returncode == 0 and run(PROGRAM, "trace", folder / "run.trace").returncode == 0, "a trace by a task",
          done.stderr)
    (folder / "run.trace").unlink(missing_ok=True)
    victim = subprocess.Popen([PROGRAM, "pieces", "improve", str(work), "-q"])
    while not list(work.glob("step-1/outcome-*")) and victim.poll() is None:
        time.sleep(0.002)
    victim.kill()
    victim.wait()
    rounds = 0
    while not json.loads((work / "plan.json").read_text())["finished"]:
        both = [subprocess.Popen([PROGRAM, "pieces", "improve", str(work), "-q", "--share", f"{i}/2"]) for i in (0, 1)]
        check([each.wait() for each in both] == [0, 0], "a share")
        done = run(PROGRAM, "pieces", "join", work, "-v")
        check(done.returncode == 0, "join", done.stderr)
        rounds += 1
    check(3 <= rounds <= 6 and "worse than before    nothing" in done.stdout, "rounds", rounds, done.stdout)
    check(taken(folder) == expected, "other bytes by tasks")
    for step in ("improve", "join"):
        check(run(PROGRAM, "pieces", step, work).returncode == 0, "a round too many", step)


def regions_and_arrays(folder):
    """Tasks leave what is protected, and carry what a file holds, as one process does."""
    mesh = folder / "data.vtu"
    run(PROGRAM, "convert", MESHES / "two_materials.mesh", mesh)
    out = folder / "regions.vtu"
    more = [mesh, "-o", out, "--pieces", "3", "--protect", "label:1", "--only", "label:1,2"]
    done = run(PROGRAM, "improve", *more, "-q")
    check(done.returncode == 0, "improve with regions", done.stderr)
    expected = out.read_bytes()
    out.unlink()
    work = folder / "regions"
    done = run(PROGRAM, "pieces", "split", work, *more)
    check(done.returncode == 0, "split with regions", done.stderr)
    while done.returncode == 0 and not json.loads((work / "plan.json").read_text())["finished"]:
        done = run(PROGRAM, "pieces", "improve", work, "-q")
        check(done.returncode == 0, "improve with regions by tasks", done.stderr)
        done = run(PROGRAM, "pieces", "join", work)
        check(done.returncode == 0, "join with regions", done.stderr)
    check(out.exists() and out.read_bytes() == expected, "other bytes with regions by tasks")
    check("protected" in done.stdout, "the report of tasks has no protected tets", done.stdout)


def main() -> int:
    has_mpi = MPI_PROGRAM != "none" and shutil.which("mpirun") is not None
    with tempfile.TemporaryDirectory(prefix="tetmend-") as name:
        folder = Path(name)
        done = run(PROGRAM, "improve", *improve(folder, "-q"))
        expected = taken(folder)
        check(done.returncode == 0 and expected is not None, "improve", done.stderr)
        tasks(folder, expected)
        regions_and_arrays(folder)
        adapts(folder)
        traces(folder)
        if has_mpi:
            any_number_of_ranks(folder, expected)
            mistakes(folder)
            killed_rank(folder, expected)
            files_of_hdf5(folder, expected)
            if (folder / "whole.h5").exists():
                arrays_of_hdf5(folder)
            meshes_in_parts(folder)
        else:
            print("tetmend-mpi or mpirun is not there: processes of MPI were not tried")
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
