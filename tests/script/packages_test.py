# SPDX-License-Identifier: MIT
"""What script/demo installs on a bare Debian 12 is at most 135 packages.

packages_test.py SOURCE_FOLDER

Nothing is installed: apt simulates it for a system that it believes to be empty. It counts twice.
"from nothing" has all packages that those of script/bootstrap depend on, libc and dpkg among them.
"on a minimal system" leaves out those of a system as debootstrap --variant=minbase makes it: the
packages that Debian calls required or essential, apt, and what these depend on.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(sys.argv[1])
MOST = 135
SKIPPED = 77


def output(*command: str | Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def group(name: str) -> list[str]:
    """Packages of one group of script/bootstrap."""
    words: list[str] = []
    is_wanted = False
    for line in output(SOURCE / "script" / "bootstrap", "--list").splitlines():
        if not line.startswith(" "):
            is_wanted = line.split()[0] == name
            line = line.removeprefix(line.split()[0])
        words += line.split() if is_wanted else []
    return words


def minimal_system() -> list[str]:
    paragraphs = output("apt-cache", "dumpavail").split("\n\n")
    is_there = re.compile(r"^(Priority: required|Essential: yes)$", re.M)
    names = {re.match(r"Package: (\S+)", paragraph)[1] for paragraph in paragraphs
             if is_there.search(paragraph)}
    # The last is the one of two packages that Debian 12 makes a new system with.
    return sorted(names | {"apt", "usr-is-merged"})


def installed(packages: list[str]) -> set[str]:
    """What apt would install on an empty system, as script/bootstrap calls it."""
    with tempfile.TemporaryDirectory() as folder:
        status = Path(folder) / "status"
        status.touch()
        said = output("apt-get", "--simulate", "-o", f"Dir::State::status={status}", "install",
                      "--no-install-recommends", *packages)
    return set(re.findall(r"^Inst (\S+)", said, re.M))


def main() -> int:
    try:
        release = Path("/etc/os-release").read_text()
        if "VERSION_CODENAME=bookworm" not in release:
            print("tetmend: skipped, this is not Debian 12")
            return SKIPPED
        required = minimal_system()
        from_nothing = installed([*group("build"), "usr-is-merged"])
        minimal = installed(required)
        on_minimal = installed(group("build") + required) - minimal
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"tetmend: skipped, apt has no lists of packages here: {error}")
        return SKIPPED
    print(f"packages: {len(from_nothing)} from nothing, {len(on_minimal)} on a minimal system of "
          f"{len(minimal)}; at most {MOST} are allowed")
    print(*sorted(on_minimal))
    if len(required) < 20 or not set(group("build")) <= from_nothing:
        print("packages: the simulation does not install what it should")
        return 1
    return 0 if max(len(from_nothing), len(on_minimal)) <= MOST else 1


if __name__ == "__main__":
    sys.exit(main())
