# SPDX-License-Identifier: MIT
"""Makes the wheel and the source archive (PEP 517). Runs CMake; needs nothing but Python's own library.

Settings (pip install --config-settings=NAME=VALUE .):
    build-dir    folder of the build, kept and used again; with an own one: build/python
    jobs         compilations at once
    system-libs  "true": leave the libraries of the system (oneTBB, Lua, ...) out of the wheel
"""

from __future__ import annotations

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[3]
# What every Linux has. The rest of what libtetmend.so needs goes into the wheel.
OF_THE_SYSTEM = re.compile(r"^(ld-linux.*|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+)\.so.*)$")


def _version() -> str:
    found = re.search(r"project\(tetmend VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())
    return found[1]


def _metadata() -> str:
    project = tomllib.loads((SOURCE / "pyproject.toml").read_text())["project"]
    address = (SOURCE / "packaging/address").read_text().strip()
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}", f"Summary: {project['description']}",
             f"Home-page: {address}", *(f"Author: {each['name']}" for each in project["authors"]),
             f"License: {project['license']['text']}", f"Keywords: {','.join(project['keywords'])}",
             *(f"Classifier: {each}" for each in project["classifiers"]), f"Project-URL: Source, {address}",
             f"Requires-Python: {project['requires-python']}",
             *(f"Requires-Dist: {each}" for each in project["dependencies"]), "Description-Content-Type: text/markdown", "",
             (SOURCE / project["readme"]).read_text()]
    return "\n".join(lines)


def _entry_points() -> str:
    groups = tomllib.loads((SOURCE / "pyproject.toml").read_text())["project"]["entry-points"]
    return "\n".join(f"[{group}]\n" + "".join(f"{name} = {value}\n" for name, value in names.items()) for group, names in groups.items())


def _glibc(package: Path) -> int:
    """The lowest N of glibc 2.N that has all functions which the binaries of a package ask for."""
    wanted = {17}
    for file in package.glob("*.so*"):
        listed = subprocess.run(["objdump", "-T", file], check=True, capture_output=True, text=True).stdout
        wanted |= {int(minor) for minor in re.findall(r"\*UND\*.*\(GLIBC_2\.(\d+)", listed)}
    return max(wanted)


def _tag(package: Path | None = None) -> str:
    """For this Python and machine; of a package that has all its libraries inside, for each Linux with its glibc (PEP 600)."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    machine = re.sub("[-.]", "_", sysconfig.get_platform())
    if package is not None:
        machine = machine.replace("linux_", f"manylinux_2_{_glibc(package)}_")
    return f"{python}-{python}-{machine}"


def _install(settings: dict, prefix: Path) -> None:
    build = Path(settings.get("build-dir", SOURCE / "build/python")).resolve()
    jobs = str(settings.get("jobs", len(os.sched_getaffinity(0))))
    options = ["-DTETMEND_BUILD_PYTHON=ON"]
    if not (build / "CMakeCache.txt").exists():
        # Not the link in a virtual environment, which may vanish.
        options += [f"-DPYTHON_EXECUTABLE={os.path.realpath(sys.executable)}"]
        options += ["-GNinja"] if shutil.which("ninja") else []
        options += [f"-DTETMEND_BUILD_{part}=OFF" for part in ("PROGRAMS", "VIEWER", "TESTS")]
    subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-DCMAKE_BUILD_TYPE=Release", *options], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "tetmend_python", "--parallel", jobs], check=True)
    subprocess.run(["cmake", "--install", build, "--component", "wheel", "--prefix", prefix], check=True)
    extension = f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not (prefix / "tetmend" / extension).exists():
        raise RuntimeError(f"{build} is for another Python: there is no {extension}")


def _bundle_libraries(package: Path) -> dict[str, Path]:
    """Copies of the libraries of the system that libtetmend.so needs, found beside it by its run path: names, and where each is from.

    Another package may bring the same library of another version, and a process keeps the first of a name: with patchelf each gets a
    name of its own.
    """
    listed = subprocess.run(["ldd", package / "libtetmend.so.0.1"], check=True, capture_output=True, text=True).stdout
    needed = {name: Path(file) for name, file in re.findall(r"^\s*(\S+) => (/\S+)", listed, re.M) if not OF_THE_SYSTEM.match(name)}
    patchelf = shutil.which("patchelf")
    new_names = {}
    for name, file in needed.items():
        stem, _, rest = name.partition(".so")
        digest = hashlib.sha256(file.read_bytes()).hexdigest()[:8]
        new_names[name] = f"{stem}-{digest}.so{rest}" if patchelf else name
        shutil.copyfile(file, package / new_names[name])
    if patchelf:
        renamings = [word for old, new in new_names.items() for word in ("--replace-needed", old, new)]
        for binary in package.glob("*.so*"):
            own = ["--set-soname", binary.name] if binary.name in new_names.values() else []
            subprocess.run([patchelf, *own, *renamings, binary], check=True)
    return {new_names[name]: file for name, file in needed.items()}


def _copy_licences(libraries: dict[str, Path], folder: Path) -> None:
    """Of the packages of Debian that they are from; of another system THIRD-PARTY.md has to do."""
    for name, file in libraries.items():
        for candidate in (file, file.resolve(), Path(str(file).removeprefix("/usr")), Path(str(file.resolve()).removeprefix("/usr"))):
            found = subprocess.run(["dpkg-query", "-S", candidate], capture_output=True, text=True) if shutil.which("dpkg-query") else None
            if found is not None and found.returncode == 0:
                copyright_file = Path("/usr/share/doc") / found.stdout.partition(":")[0] / "copyright"
                if copyright_file.exists():
                    shutil.copyfile(copyright_file, folder / f"{name}.txt")
                break


def _pack(root: Path, wheel: Path, info: str) -> None:
    """With the list of all files and their hashes."""
    record = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(path for path in root.rglob("*") if path.is_file()):
            name = file.relative_to(root).as_posix()
            digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{file.stat().st_size}")
            archive.write(file, name)
        archive.writestr(f"{info}/RECORD", "\n".join([*record, f"{info}/RECORD,,", ""]))


def _write_info(root: Path, info: str, tag: str) -> None:
    folder = root / info
    (folder / "licenses").mkdir(parents=True)
    (folder / "METADATA").write_text(_metadata())
    (folder / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: tetmend_build\nRoot-Is-Purelib: false\nTag: {tag}\n")
    (folder / "entry_points.txt").write_text(_entry_points())
    for name in ("LICENSE", "THIRD-PARTY.md"):
        shutil.copyfile(SOURCE / name, folder / "licenses" / name)


def get_requires_for_build_wheel(config_settings=None) -> list[str]:
    return []


def get_requires_for_build_sdist(config_settings=None) -> list[str]:
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None) -> str:
    info = f"tetmend-{_version()}.dist-info"
    _write_info(Path(metadata_directory), info, _tag())
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None) -> str:
    settings = config_settings or {}
    name = f"tetmend-{_version()}"
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        _install(settings, root)
        has_all = settings.get("system-libs") != "true"
        libraries = _bundle_libraries(root / "tetmend") if has_all else {}
        tag = _tag(root / "tetmend" if has_all else None)
        _write_info(root, f"{name}.dist-info", tag)
        _copy_licences(libraries, root / f"{name}.dist-info" / "licenses")
        wheel = f"{name}-{tag}.whl"
        _pack(root, Path(wheel_directory) / wheel, f"{name}.dist-info")
    return wheel


def build_sdist(sdist_directory, config_settings=None) -> str:
    """All files that git does not ignore; of an unpacked source archive, all but what was built."""
    name = f"tetmend-{_version()}"
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=SOURCE, capture_output=True, text=True)
    if listed.returncode == 0:
        files = [file for file in listed.stdout.split("\0") if file and (SOURCE / file).is_file()]
    else:
        files = [path.relative_to(SOURCE).as_posix() for path in SOURCE.rglob("*")
                 if path.is_file() and path.relative_to(SOURCE).parts[0] not in ("build", "demo-out", "PKG-INFO")]
    with tempfile.NamedTemporaryFile("w", suffix="PKG-INFO") as info, \
            tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        info.write(_metadata())
        info.flush()
        archive.add(info.name, f"{name}/PKG-INFO")
        for file in sorted(files):
            archive.add(SOURCE / file, f"{name}/{file}", recursive=False)
    return f"{name}.tar.gz"
