# SPDX-License-Identifier: MIT
"""Ends runs in every bad way, many times: kill, signals, full disk, system calls and allocations that fail.

After each, the user's file is the old one or the new one, whole; nothing else stays in the folder.

usage: faults.py PROGRAM SOURCE_FOLDER PRELOAD ROUNDS [--library FAULT_TESTS] [--write FILE]
"""

import argparse
import dataclasses
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("program")
parser.add_argument("source", type=Path)
parser.add_argument("preload")
parser.add_argument("rounds", type=int)
parser.add_argument("--library", help="the program of tests/faults: its runs of the library whose n-th allocation fails")
parser.add_argument("--write", type=Path, help="a document of how often all was tried")
arguments = parser.parse_args()
PROGRAM, SOURCE, PRELOAD, ROUNDS = arguments.program, arguments.source, arguments.preload, arguments.rounds
MESHES = SOURCE / "assets" / "meshes"
counts = {}
failures = []
sys.path.insert(0, str(SOURCE.resolve() / "bench"))
import documents  # noqa: E402


def check(holds, what, *details):
    if not holds:
        failures.append(what)
        print("FAIL:", what, *details, flush=True)


def count(what, times=1):
    counts[what] = counts.get(what, 0) + times


class Work:
    """A folder with a mesh that is improved over itself."""

    def __init__(self, mesh, name):
        self.folder = Path(tempfile.mkdtemp(prefix="tetmend-faults-"))
        self.mesh = self.folder / name
        self.old = mesh.read_bytes()
        self.restore()
        subprocess.run([PROGRAM, "improve", self.mesh, "-o", self.mesh, "-q"], check=True)
        self.new = self.mesh.read_bytes()
        self.restore()
        self.command = [PROGRAM, "improve", str(self.mesh), "-o", str(self.mesh), "-q"]

    def restore(self):
        self.mesh.write_bytes(self.old)

    def settle(self, what, new_allowed=True, improved=None):
        """Looks at what a fault left, and begins anew."""
        content = self.mesh.read_bytes() if self.mesh.exists() else b""
        whole = content == self.old or (new_allowed and (content == self.new or improved is not None and improved(content)))
        check(whole, "the file is the old or the new one: " + what, len(content))
        extra = [entry.name for entry in self.folder.iterdir() if entry != self.mesh]
        check(not extra, "nothing else stays: " + what, extra)
        for name in extra:
            os.remove(self.folder / name)
        self.restore()

    def close(self):
        shutil.rmtree(self.folder)


def is_mesh(content):
    """Written by a run that was stopped: as sound as any."""
    with tempfile.NamedTemporaryFile(suffix=".meshb") as file:
        file.write(content)
        file.flush()
        return subprocess.run([PROGRAM, "quality", file.name], capture_output=True).returncode == 0


def kills_and_signals():
    """At any time of a run."""
    work = Work(MESHES / "bracket.meshb", "a.meshb")
    begin = time.monotonic()
    subprocess.run(work.command, check=True)
    whole = time.monotonic() - begin
    work.restore()
    chance = random.Random(7)
    for number in (signal.SIGKILL, signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        for _ in range(ROUNDS):
            process = subprocess.Popen(work.command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(whole * chance.random() ** 0.5)
            process.send_signal(number)
            status = process.wait(timeout=60)
            known = {0, 4, -number, 128 + number}
            check(status in known, "a known end", number, status)
            if number == signal.SIGKILL:  # a process that is killed while it writes cannot tidy up
                for entry in work.folder.iterdir():
                    if entry != work.mesh:
                        count("temporaries of killed processes")
                        entry.unlink()
            work.settle(f"{number.name} ({status})", improved=is_mesh)
            count(f"{number.name} at any time")
    work.close()


CALLS = ["openat", "write", "pwrite64", "fsync", "rename", "fchmod", "fchown", "close", "unlink", "ftruncate", "lseek", "fstat"]


def failing_system_calls():
    """The n-th of each kind, in the last part of a run, with errors that disks and networks give."""
    if shutil.which("strace") is None or subprocess.run(["strace", "-qq", "-o", "/dev/null", "true"]).returncode != 0:
        print("no strace here: system calls that fail are not tried")
        return
    work = Work(MESHES / "two_materials.mesh", "a.mesh")
    for call in CALLS:
        log = subprocess.run(["strace", "-f", "-qq", "-e", f"trace={call}", *work.command], capture_output=True, text=True)
        made = sum(f"{call}(" in line for line in log.stderr.splitlines())
        work.restore()
        for back in range(min(made, 2 + ROUNDS // 10)):
            for error in ("ENOSPC", "EIO", "EINTR") if call in ("write", "fsync", "rename", "openat") else ("EIO",):
                if error == "EINTR" and call != "write":
                    continue
                fault = f"inject={call}:error={error}:when={made - back}"
                done = subprocess.run(["strace", "-f", "-qq", "-o", "/dev/null", "-e", fault, *work.command],
                                      capture_output=True, text=True, timeout=60)
                what = f"{call} {error} {back} from the end"
                check(done.returncode in (0, 1, 127), what, done.returncode, done.stderr)
                check(done.returncode != 1 or done.stderr.count("\n") <= 1, "one line: " + what, done.stderr)
                content = work.mesh.read_bytes()
                check(done.returncode == 0 or content in (work.old, work.new), "whole: " + what)
                check(done.returncode != 0 or content == work.new, "a status of 0 means written: " + what)
                check(call != "fsync" or done.returncode != 0, "what is not on the disk is said: " + what)
                left = [entry.name for entry in work.folder.iterdir() if entry != work.mesh]
                check(not left or call == "unlink", "nothing else stays: " + what, left)
                for name in left:
                    os.remove(work.folder / name)
                work.restore()
                count("failing system calls")
    work.close()


def full_disk():
    """A file system of a few kilobytes, where that may be mounted."""
    folder = Path(tempfile.mkdtemp(prefix="tetmend-full-"))
    mount = ["mount", "-t", "tmpfs", "-o", "size=200k", "tmpfs", str(folder)]
    if os.geteuid() != 0 or subprocess.run(mount, capture_output=True).returncode != 0:
        print("no file system can be mounted here: a full disk is not tried")
        folder.rmdir()
        return
    try:
        mesh = folder / "a.mesh"
        for kilobytes in range(0, 190, max(1, 190 // ROUNDS)):
            shutil.copy(MESHES / "two_materials.mesh", mesh)
            (folder / "ballast").write_bytes(b"x" * max(0, (180 - kilobytes) * 1024 - mesh.stat().st_size))
            old = mesh.read_bytes()
            done = subprocess.run([PROGRAM, "improve", mesh, "-o", mesh, "-q"], capture_output=True, text=True)
            check(done.returncode in (0, 1), "a full disk is an error", done)
            check(done.returncode == 0 or mesh.read_bytes() == old, "a full disk leaves the old file")
            check(sorted(e.name for e in folder.iterdir()) == ["a.mesh", "ballast"], "a full disk leaves nothing else")
            (folder / "ballast").unlink()
            count("full disks")
    finally:
        subprocess.run(["umount", folder], check=True)
        folder.rmdir()


def failing_allocations():
    """The n-th allocation of the program: evenly over a run, and densely at its beginning."""
    work = Work(MESHES / "two_materials.mesh", "a.mesh")
    # Until nothing fails any more, the run has fewer allocations.
    most = 1
    while most < 1 << 24 and fails_at(work, most):
        most *= 4
    chance = random.Random(11)
    numbers = [chance.randrange(most) for _ in range(ROUNDS * 4)] + [int(1.3 ** k) for k in range(ROUNDS // 4)]
    for number in numbers:
        fails_at(work, number)
    work.close()


def fails_at(work, number):
    """Whether the run failed."""
    environment = dict(os.environ, LD_PRELOAD=PRELOAD, TETMEND_FAIL_AT=str(number))
    done = subprocess.run(work.command, capture_output=True, text=True, env=environment, timeout=60)
    # Before main() and in the loader, a program without memory can only end.
    before_main = done.returncode in (-6, 127) and number < 2000 or "error while loading" in done.stderr
    check(done.returncode in (0, 1) or before_main, "a known end without memory", number, done.returncode, done.stderr)
    content = work.mesh.read_bytes()
    check(done.returncode == 0 or content == work.old, "without memory the old file stays", number)
    left = [entry.name for entry in work.folder.iterdir() if entry != work.mesh]
    check(not left, "without memory nothing else stays", number, left)
    count("failing allocations" + (", before main" if before_main else ""))
    work.restore()
    return done.returncode != 0


def other_user():
    """A program with the rights of another user does not load what its caller names."""
    if os.geteuid() != 0:
        print("not root: no program with the rights of another user is made")
        return
    folder = Path(tempfile.mkdtemp(prefix="tetmend-setuid-"))
    os.chmod(folder, 0o755)
    copy = folder / "tetmend"
    shutil.copy(PROGRAM, copy)
    os.chown(copy, 61234, 61234)
    os.chmod(copy, 0o4755)
    environment = dict(os.environ, TETMEND_PLUGIN_PATH=str(folder / "nowhere.so"))
    plain = subprocess.run([PROGRAM, "operators"], capture_output=True, text=True, env=environment)
    check(plain.returncode == 1, "the variable is looked at", plain)
    other = subprocess.run([copy, "operators"], capture_output=True, text=True, env=environment)
    check(other.returncode == 0, "a setuid program does not look at the variable", other)
    shutil.rmtree(folder)
    count("setuid programs")


def failing_allocations_of_the_library():
    """n = 1, 2, 3, ... of runs in this and that form."""
    for schedule in ("shell", "thorough"):
        for mesh in ("tangled", "lattice"):
            done = subprocess.run([arguments.library, "1", str(50 * ROUNDS), "1", schedule, mesh], capture_output=True, text=True)
            print(done.stdout, end="", flush=True)
            check(done.returncode == 0, "an allocation of the library fails", schedule, mesh, done.stderr)
            for form, runs in re.findall(r"^\S+ \S+ (\S+): (\d+) runs", done.stdout, re.MULTILINE):
                count(f"failing allocations of the library, {form}", int(runs))


def page():
    table = [["What was done to a run", "Times"], *([what, f"{number:,}"] for what, number in counts.items())]
    verdict = "Nothing was lost and nothing stayed." if not failures else "Failed: " + "; ".join(sorted(set(failures))) + "."
    made = dataclasses.replace(documents.stamp("script/faults"), command=f"script/faults {ROUNDS}")
    return documents.document("Faults", made, [
        "After each the file of the user was the old one or the new one, whole, and nothing else lay in its folder; after a "
        "failed allocation of the library the mesh was what it was when the last attempt was kept. " + verdict,
        documents.markdown_table(table)])


kills_and_signals()
failing_system_calls()
full_disk()
failing_allocations()
other_user()
if arguments.library:
    failing_allocations_of_the_library()
print("faults: " + ", ".join(f"{number} {what}" for what, number in counts.items()))
if arguments.write:
    documents.write(arguments.write, page())
sys.exit(f"{len(failures)} checks failed" if failures else 0)
