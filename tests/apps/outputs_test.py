# SPDX-License-Identifier: MIT
"""Files, streams, signals and limits that go wrong: nothing is lost, nothing stays behind.

usage: outputs_test.py PROGRAM SOURCE_FOLDER
"""

import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAM = sys.argv[1]
MESHES = Path(sys.argv[2]) / "assets" / "meshes"
MESH = MESHES / "bracket.meshb"
SMALL = MESHES / "two_materials.mesh"
failures = []


def can_trace() -> bool:
    """strace is there, and may trace."""
    if shutil.which("strace") is None:
        return False
    return subprocess.run(["strace", "-qq", "-o", "/dev/null", "true"], capture_output=True).returncode == 0


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details)


def run(*arguments, shell_tail=None, limits=None, **options):
    """Status as in a shell and what was said; `shell_tail` is what follows the command there."""
    words = [PROGRAM, *map(str, arguments)]
    if shell_tail is not None:
        words = ["bash", "-c", 'exec "$@" ' + shell_tail, "bash", *words]
    done = subprocess.run(words, capture_output=True, text=True, preexec_fn=limits, timeout=120, **options)
    status = done.returncode if done.returncode >= 0 else 128 - done.returncode
    return status, done.stdout, done.stderr


def entries(folder):
    return sorted(entry.name for entry in Path(folder).iterdir())


class Folder:
    """A new folder with a copy of a mesh in it."""

    def __enter__(self):
        self.path = Path(tempfile.mkdtemp(prefix="tetmend-"))
        shutil.copy(SMALL, self.path / "in.mesh")
        return self.path

    def __exit__(self, *_):
        shutil.rmtree(self.path)


def one_line(text):
    return text.count("\n") == 1 and text.startswith("tetmend: ")


def same_files_are_refused():
    with Folder() as folder:
        mesh = folder / "in.mesh"
        before = mesh.read_bytes()
        run("convert", mesh, folder / "z.ele")
        run("improve", mesh, "-o", folder / "o.mesh", "--trace", folder / "run.trace", "-q")
        (folder / "my.lua").write_text("smooth{}\n")
        os.link(mesh, folder / "hard.mesh")
        os.symlink(mesh, folder / "soft.trace")
        os.mkdir(folder / "d")
        kept = entries(folder)
        cases = [
            ("improve", mesh, "-o", folder / "b.mesh", "--trace", mesh),
            ("improve", mesh, "-o", folder / "b.mesh", "--trace", folder / "d" / ".." / "in.mesh"),
            ("improve", mesh, "-o", folder / "b.mesh", "--trace", folder / "hard.mesh"),
            ("improve", mesh, "-o", folder / "b.mesh", "--trace", folder / "soft.trace"),
            ("improve", mesh, "-o", folder / "b.mesh", "--trace", folder / "b.mesh"),
            ("improve", mesh, "-o", folder / "b.mesh", "--trace", folder / "d" / ".." / "b.mesh"),
            ("improve", mesh, "-o", folder / "b.node", "--trace", folder / "b.ele"),
            ("improve", folder / "z.ele", "-o", folder / "b.mesh", "--trace", folder / "z.node"),
            ("improve", mesh, "-o", folder / "b.mesh", "--trace", folder / "q.json", "--report", folder / "q.json"),
            ("improve", mesh, "-o", folder / "b.mesh", "--schedule", folder / "my.lua", "--trace", folder / "my.lua"),
            ("trace", folder / "run.trace", "-o", folder / "run.trace"),
            ("quality", mesh, "--cells", mesh),
        ]
        for case in cases:
            status, out, err = run(*case)
            check(status == 2 and one_line(err) and "the same file" in err, "one file twice is wrong usage", case, err)
        check(entries(folder) == kept and mesh.read_bytes() == before, "what was refused left all as it was")
        # Refused before anything is read: the input need not even be a mesh.
        (folder / "bad.mesh").write_text("no mesh")
        status, _, err = run("improve", folder / "bad.mesh", "-o", folder / "b.mesh", "--trace", folder / "b.mesh")
        check(status == 2, "one file twice is found before the mesh is read", err)
        check(run("improve", folder / "z.ele", "-o", folder / "z.node", "-q")[0] == 0, "a set is improved in place")
        check(run("improve", mesh, "-o", mesh, "-q")[0] == 0, "a mesh is improved in place")


def files_of_meshes_are_not_outputs():
    """Parts, included files, meshes of a question, files of a run in pieces: also those that are not named."""
    with Folder() as folder:
        mesh = folder / "in.mesh"
        run("convert", mesh, folder / "p.pvtu", "--pieces", "2")
        run("convert", mesh, folder / "g_%d.msh", "--pieces", "3")
        (folder / "m").mkdir()
        run("convert", mesh, folder / "m" / "m_0.vtu")
        run("convert", mesh, folder / "nodes.inp")
        (folder / "deck.inp").write_text("*INCLUDE, INPUT=nodes.inp\n")
        run("convert", mesh, folder / "nodes.k")
        (folder / "deck.k").write_text("*KEYWORD\n*INCLUDE\nnodes.k\n*END\n")
        (folder / "l.vtk").symlink_to("in.mesh")
        (folder / "q").symlink_to("p")
        shutil.copy(folder / "p.pvtu", folder / "q.pvtu")
        os.link(folder / "g_2.msh", folder / "hard.trace")
        shutil.copy(mesh, folder / "c.mesh")
        run("improve", folder / "c.mesh", "-o", folder / "o.mesh", "-q", "--trace", folder / "run.trace",
            "--schedule", "conservative")
        (folder / "lesson.json").write_text('{"title": "T", "mesh": "c.mesh", "trace": "lesson.trace", "steps": []}')
        shutil.copy(folder / "run.trace", folder / "lesson.trace")
        run("pieces", "split", folder / "work", folder / "c.mesh", "-o", folder / "better.mesh", "--pieces", "2", "-q")
        (folder / "better.json").symlink_to("better.mesh")
        (folder / "c.json").symlink_to("c.mesh")
        (folder / "ck").mkdir()
        kept = {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
        other = folder / "other.mesh"
        cases = [
            ("convert", mesh, mesh),
            ("convert", mesh, folder / "l.vtk"),
            ("convert", folder / "l.vtk", mesh),
            ("improve", mesh, "-o", folder / "l.vtk"),
            ("convert", folder / "p.pvtu", folder / "p" / "p_0.vtu"),
            ("convert", folder / "p.pvtu", folder / "p.pvtu"),
            ("quality", folder / "p.pvtu", "--cells", folder / "p" / "p_1.vtu"),
            ("improve", folder / "p.pvtu", "-o", other, "--trace", folder / "p" / "p_0.vtu"),
            ("improve", folder / "p.pvtu", "-o", folder / "p" / "p_0.vtu"),
            ("improve", folder / "q.pvtu", "-o", folder / "p.pvtu"),  # the parts of one are those of the other
            ("improve", folder / "m" / "m_0.vtu", "-o", folder / "m.pvtu", "--pieces", "2"),
            ("improve", mesh, "-o", folder / "m.pvtu", "--pieces", "2", "--trace", folder / "m" / "m_1.vtu"),
            ("convert", folder / "g_%d.msh", folder / "g_2.msh"),
            ("convert", folder / "g_3.msh", folder / "g_%d.msh", "--pieces", "2"),
            ("improve", folder / "g_%d.msh", "-o", other, "--trace", folder / "g_2.msh"),
            ("improve", folder / "g_%d.msh", "-o", other, "--trace", folder / "hard.trace"),
            ("quality", folder / "g_%d.msh", "--cells", folder / "g_2.msh"),
            ("surface", folder / "g_%d.msh", folder / "g_1.msh", "--features"),
            ("improve", folder / "deck.inp", "-o", folder / "o.inp", "--trace", folder / "nodes.inp"),
            ("improve", folder / "deck.inp", "-o", folder / "nodes.inp"),
            ("convert", folder / "deck.inp", folder / "nodes.inp"),
            ("improve", folder / "deck.k", "-o", folder / "nodes.k"),
            ("trace", folder / "run.trace", "--history", f"tet:1@{folder / 'c.mesh'}", "-o", folder / "c.mesh"),
            ("trace", folder / "run.trace", "--history", f"tet:1@{folder / 'deck.inp'}", "-o", folder / "nodes.inp"),
            ("trace", folder / "lesson.trace", "--html", "-o", folder / "lesson.json"),
            ("improve", mesh, "-o", folder / "ck" / "run.mesh", "--trace", folder / "ck" / "run", "--checkpoint", folder / "ck"),
            ("improve", mesh, "-o", folder / "ck" / "step-1" / "out.mesh", "--checkpoint", folder / "ck"),
            ("pieces", "join", folder / "work", "--report", folder / "better.json"),
            ("pieces", "join", folder / "work", "--report", folder / "c.json"),
            ("pieces", "improve", folder / "work", "0", "--trace", folder / "work" / "plan.json"),
            ("pieces", "improve", folder / "work", "0", "--trace", folder / "work" / "step-1" / "x"),
        ]
        for case in cases:
            status, _, err = run(*case)
            check(status == 2 and one_line(err) and "the same file" in err, "an input is no output", case, status, err)
            now = {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
            check(now == kept, "what was refused left all as it was", case)
        for name in ("p.pvtu", "g_%d.msh", "deck.inp"):
            check(run("improve", folder / name, "-o", folder / name, "-q")[0] == 0, "a mesh is improved in place", name)
        check(run("quality", folder / "p.pvtu")[0] == 0 and run("quality", folder / "g_%d.msh")[0] == 0, "parts fit")
        check(run("convert", folder / "m" / "m_0.vtu", folder / "n.pvtu", "--pieces", "2")[0] == 0, "other parts")


def a_set_is_all_new_or_all_old():
    if not can_trace():
        print("no strace: faults of single renames are not tried here")
        return
    with Folder() as folder:
        mesh = folder / "in.mesh"
        run("improve", mesh, "-o", folder / "new.ele", "-q")
        run("convert", mesh, folder / "a.ele")
        old = {name: (folder / name).read_bytes() for name in entries(folder)}
        for number in range(1, 6):
            strace = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"inject=rename:error=ENOSPC:when={number}"]
            done = subprocess.run([*strace, PROGRAM, "improve", folder / "a.ele", "-o", folder / "a.ele", "-q"],
                                  capture_output=True, text=True)
            now = {name: (folder / name).read_bytes() for name in entries(folder)}
            if number <= 3:
                check(done.returncode == 1 and now == old, "a fault at a rename leaves the old set", number, done)
            else:
                check(done.returncode == 0, "no fault, no error", number, done)
        check(entries(folder) == sorted(old), "a set that was replaced leaves nothing else")
        check((folder / "a.node").read_bytes() == (folder / "new.node").read_bytes(), "the set is new")


def a_failed_trace_leaves_nothing():
    with Folder() as folder:
        (folder / "run.trace").write_text("older")
        (folder / "bad.lua").write_text("smooth{}\nerror('no')\n")
        kept = entries(folder)
        status, _, err = run("improve", folder / "in.mesh", "-o", folder / "o.mesh", "--trace", folder / "run.trace",
                             "--schedule", folder / "bad.lua")
        check(status == 1, "the script fails", err)
        check(entries(folder) == kept, "a failed run leaves no part of a trace", entries(folder))
        check((folder / "run.trace").read_text() == "older", "a failed run keeps the older trace")


def what_is_said_does_not_change_the_status():
    with Folder() as folder:
        mesh, out = folder / "in.mesh", folder / "o.mesh"
        run("improve", mesh, "-o", folder / "good.mesh", "-q")
        good = (folder / "good.mesh").read_bytes()
        has_surface = "(not in this build)" not in run("--help")[1]  # it needs OpenMesh
        for tail in (">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-", ">/dev/full", "2>/dev/full", ">/dev/full 2>/dev/full"):
            commands = [("improve", mesh, "-o", out), ("convert", mesh, out)]
            if has_surface:
                commands.append(("surface", mesh, folder / "o.off"))
            for command in commands:
                product = Path(command[-1])
                product.unlink(missing_ok=True)
                status, _, err = run(*command, shell_tail=tail)
                check(status == 0 and product.exists(), "work done is status 0", command[0], tail, status, err)
                if command[0] == "improve":
                    check(product.read_bytes() == good, "what is said goes to no file", tail)
                if tail in (">&-", ">/dev/full"):
                    check(one_line(err) and "standard output" in err, "lost output is said once", tail, err)
            # Trouble is no success, whether it can be said or not.
            status, _, _ = run("improve", folder / "none.mesh", "-o", out, shell_tail=tail)
            check(status == 1, "a missing input is status 1", tail, status)
        for tail in (">&-", ">/dev/full"):
            status, _, err = run("operators", shell_tail=tail)
            check(status == 1 and one_line(err), "where only standard output was asked for, it counts", tail, err)
            status, _, err = run("convert", mesh, "-", "--format", "mesh", shell_tail=tail)
            check(status == 1 and one_line(err.split("note:")[0]), "a mesh for standard output counts", tail, err)
        status, text, _ = run("convert", mesh, "-", "--format", "mesh")
        check(status == 0 and text.startswith("MeshVersionFormatted"), "a mesh goes to standard output")
        # A reader that has gone.
        read, write = os.pipe()
        os.close(read)
        status = subprocess.run([PROGRAM, "improve", mesh, "-o", out], stdout=write, stderr=write).returncode
        os.close(write)
        check(status == 0, "a reader that goes away does not end the work", status)


def wait_for(condition, process):
    end = time.time() + 60
    while time.time() < end and process.poll() is None:
        if condition():
            return True
        time.sleep(0.002)
    return False


def signals_stop_in_order():
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
        with Folder() as folder:
            (folder / "long.lua").write_text("while true do smooth{} end\n")
            process = subprocess.Popen([PROGRAM, "improve", MESH, "-o", folder / "o.meshb", "-q", "--trace",
                                        folder / "run.trace", "--schedule", folder / "long.lua"],
                                       stderr=subprocess.PIPE, text=True, preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))
            check(wait_for((folder / "run.trace.part").exists, process), "the schedule begins", number)
            time.sleep(0.3)
            process.send_signal(number)
            _, err = process.communicate(timeout=60)
            check(process.returncode == 4, "a signal stops the work in order", number, process.returncode, err)
            check(entries(folder) == ["in.mesh", "long.lua", "o.meshb", "run.trace"], "all is written", entries(folder))
            check(run("quality", folder / "o.meshb")[0] == 0, "what was written is whole")
    with Folder() as folder:
        process = subprocess.Popen(["nohup", PROGRAM, "improve", SMALL, "-o", folder / "o.mesh"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        process.send_signal(signal.SIGHUP)
        check(process.wait() in (0, -signal.SIGHUP), "nohup is respected")


def signals_leave_no_temporaries():
    """At many moments of a conversion, which is mostly writing."""
    with Folder() as folder:
        run("convert", MESH, folder / "old.vtu")
        old = (folder / "old.vtu").read_bytes()
        begin = time.time()
        run("convert", MESH, folder / "a.vtu")
        length = time.time() - begin
        kept = entries(folder)
        ended = 0
        for i in range(40):
            (folder / "a.vtu").write_bytes(b"older")
            process = subprocess.Popen([PROGRAM, "convert", MESH, folder / "a.vtu"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            time.sleep(length * i / 40)
            process.send_signal((signal.SIGTERM, signal.SIGHUP)[i % 2])
            ended += process.wait() < 0
            check(entries(folder) == kept, "a signal leaves no temporary", entries(folder))
            check((folder / "a.vtu").read_bytes() in (b"older", old), "a file is old or new")
        check(ended > 0, "some signal came in time")
    if not can_trace():
        return
    with Folder() as folder:
        # While the trace is being written, and the second signal right after the first.
        (folder / "long.lua").write_text("while true do smooth{} end\n")
        process = subprocess.Popen([PROGRAM, "improve", MESH, "-o", folder / "o.meshb", "-q", "--trace", folder / "run.trace",
                                    "--schedule", folder / "long.lua"], stderr=subprocess.DEVNULL)
        wait_for((folder / "run.trace.part").exists, process)
        process.send_signal(signal.SIGTERM)
        process.send_signal(signal.SIGHUP)
        process.wait()
        check(process.returncode in (-signal.SIGTERM, -signal.SIGHUP, 4), "a second signal ends the work", process.returncode)
        check(process.returncode == 4 or entries(folder) == ["in.mesh", "long.lua"], "and leaves nothing", entries(folder))


def signal_at_a_rename():
    """Between the renames of a set the program cannot be ended."""
    if not can_trace():
        return
    with Folder() as folder:
        run("convert", folder / "in.mesh", folder / "a.ele")
        run("improve", folder / "in.mesh", "-o", folder / "new.ele", "-q")
        kept = entries(folder)
        for call in ("rename", "link"):
            for number in (1, 2, 3):
                run("convert", folder / "in.mesh", folder / "a.ele")
                strace = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"inject={call}:signal=TERM:when={number}"]
                done = subprocess.run([*strace, PROGRAM, "convert", folder / "new.ele", folder / "a.ele"], capture_output=True)
                check(done.returncode in (-15, 143), "the signal ends the program", done)
                check(entries(folder) == kept, "a signal at a rename leaves nothing", call, number, entries(folder))
                for end in (".node", ".ele", ".face"):
                    check((folder / ("a" + end)).read_bytes() == (folder / ("new" + end)).read_bytes(),
                          "a signal at a rename lets the set be finished", call, number, end)


def signal_while_writing():
    if not can_trace():
        return
    with Folder() as folder:
        (folder / "o.vtu").write_text("older")
        kept = entries(folder)
        for call in ("fsync:when=1", "write:when=1"):
            name, when = call.split(":")
            done = subprocess.run(["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"inject={name}:signal=TERM:{when}",
                                   PROGRAM, "convert", folder / "in.mesh", folder / "o.vtu"], capture_output=True)
            check(done.returncode in (-15, 143), "a signal while writing ends the program", call, done)
            check(entries(folder) == kept, "a signal while writing leaves no temporary", call, entries(folder))
            check((folder / "o.vtu").read_text() == "older", "a signal while writing leaves the older file", call)


def strace(folder, what, *command):
    """Status, and the lines of the trace."""
    log = folder / "strace.log"
    done = subprocess.run(["strace", "-f", "-y", "-o", str(log), "-e", what, PROGRAM, *map(str, command)], capture_output=True)
    lines = log.read_text().splitlines()
    log.unlink()
    return done.returncode, lines


def writing_outlives_signals_and_loss_of_power():
    if not can_trace():
        return
    with Folder() as folder:
        run("improve", folder / "in.mesh", "-o", folder / "good.mesh", "-q")
        status, _ = strace(folder, "inject=rename:signal=HUP:when=1", "improve", folder / "in.mesh", "-o", folder / "o.mesh", "-q")
        check(status == 0, "a signal while all is written does not change the status", status)
        check((folder / "o.mesh").read_bytes() == (folder / "good.mesh").read_bytes(), "nor the mesh")
        for command, name in ((("-o", folder / "o.mesh"), "o.mesh"),
                              (("-o", folder / "o.mesh", "--trace", folder / "run.trace"), "run.trace")):
            _, lines = strace(folder, "trace=fsync,rename", "improve", folder / "in.mesh", *command, "-q")
            renamed = next(i for i, line in enumerate(lines) if "rename(" in line and f'{name}"' in line)
            source = Path(lines[renamed].split('"')[1]).name
            check(any("fsync(" in line and source in line for line in lines[:renamed]), "on the disk before the name", lines)
            check("fsync(" in lines[renamed + 1] and f"{folder.name}>" in lines[renamed + 1], "and the name, too", lines)


def limits_are_errors():
    with Folder() as folder:
        kept = entries(folder)
        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        status, _, err = run("improve", folder / "in.mesh", "-o", folder / "o.mesh", "-q", limits=small_files)
        check(status == 1 and one_line(err) and "File too large" in err, "a limit of files is an error", status, err)
        status, _, err = run("improve", folder / "in.mesh", "-o", folder / "o.mesh", "-q", "--trace", folder / "t",
                             limits=small_files)
        check(status == 1 and one_line(err), "a limit of files is an error for a trace", status, err)
        check(entries(folder) == kept, "a limit of files leaves nothing", entries(folder))
        shutil.copy(MESH, folder / "b.meshb")
        def room_for_the_mesh():
            resource.setrlimit(resource.RLIMIT_FSIZE, (MESH.stat().st_size * 11 // 10,) * 2)
        status, _, err = run("improve", folder / "b.meshb", "-o", folder / "o.meshb", "-q", "--trace", folder / "t",
                             limits=room_for_the_mesh)
        check(status == 1 and one_line(err) and "/t: " in err, "a trace does not fit", status, err)
        check(entries(folder) == sorted([*kept, "b.meshb"]), "nothing is written then", entries(folder))
        (folder / "b.meshb").unlink()
        # The least that a program needs differs: all from hardly anything to enough.
        failed = 0
        for megabytes in range(24, 160, 8):
            def little_memory():
                resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
            status, _, err = run("improve", MESH, "-o", folder / "o.meshb", "-q", "--threads", "2", limits=little_memory)
            if status == 127 or "error while loading shared libraries" in err:
                continue
            failed += status == 1
            check(status == 0 or status == 1 and one_line(err), "a limit of memory is an error", megabytes, status, err)
            check(status == 0 or entries(folder) == kept, "a limit of memory leaves nothing", entries(folder))
            (folder / "o.meshb").unlink(missing_ok=True)
        check(failed > 0, "some limit of memory was too low")
        if os.geteuid() == 0:
            os.chmod(folder, 0o777)
            nobody = 61234
            shutil.copy(MESH, folder / "b.meshb")
            kept = entries(folder)
            def no_threads():
                os.setgid(nobody)
                os.setuid(nobody)
                resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
            for threads in ("1", "4"):
                status, _, err = run("improve", folder / "b.meshb", "-o", folder / "o.meshb", "-q", "--threads", threads,
                                     limits=no_threads)
                check(status == 0 or status == 1 and one_line(err), "no thread is an error", threads, status, err)
                check(status == 0 or entries(folder) == kept, "no thread leaves nothing", entries(folder))
                (folder / "o.meshb").unlink(missing_ok=True)


def what_is_written_beside_the_mesh_is_there_with_it_or_nothing_is():
    """Status 1 means that OUT is old, whatever could not be written."""
    with Folder() as folder:
        shutil.copy(MESHES.parent / "lessons" / "1-core.mesh", folder / "core.mesh")
        (folder / "r.json").write_text("older")
        def room_for_the_mesh():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
        for out in ("o.mesh", "o.ele", "o.vtu"):
            for reports in (["r.json"], ["r.html"], ["s.json", "r.html"], ["r.json", "s.json"]):
                for name in ("o.mesh", "o.ele", "o.node", "o.face", "o.vtu"):
                    (folder / name).write_text("older")
                kept = entries(folder)
                told = [word for report in reports for word in ("--report", folder / report)]
                status, _, err = run("improve", folder / "core.mesh", "-o", folder / out, "-q", *told, limits=room_for_the_mesh)
                check(status == 1 and one_line(err) and ".json: " in err or ".html: " in err, "a report does not fit", status, err)
                check(entries(folder) == kept, "then nothing is written", out, reports, entries(folder))
                check(all((folder / name).read_text() == "older" for name in kept if name not in ("in.mesh", "core.mesh")),
                      "and what was there is as it was", out, reports)
                status, _, err = run("improve", folder / "core.mesh", "-o", folder / out, "-q", *told)
                check(status == 0 and (folder / out).read_text() != "older" and
                      all((folder / report).read_text() != "older" for report in reports), "with room all is written", err)
                for report in reports:
                    (folder / report).unlink()
                (folder / "r.json").write_text("older")
        status, _, _ = run("improve", folder / "core.mesh", "-o", folder / "plain.mesh", "-q", limits=room_for_the_mesh)
        check(status == 0, "the mesh alone fits")


same_files_are_refused()
files_of_meshes_are_not_outputs()
a_set_is_all_new_or_all_old()
a_failed_trace_leaves_nothing()
what_is_said_does_not_change_the_status()
signals_stop_in_order()
signals_leave_no_temporaries()
signal_at_a_rename()
signal_while_writing()
writing_outlives_signals_and_loss_of_power()
limits_are_errors()
what_is_written_beside_the_mesh_is_there_with_it_or_nothing_is()
sys.exit(f"{len(failures)} checks failed" if failures else 0)
