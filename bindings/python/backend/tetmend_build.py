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
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}", f"Summary: {project['description']}",
             f"License: {project['license']['text']}", f"Requires-Python: {project['requires-python']}",
             *(f"Requires-Dist: {each}" for each in project["dependencies"]), "Description-Content-Type: text/markdown", "",
             (SOURCE / project["readme"]).read_text()]
    return "\n".join(lines)


def _tag() -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


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


def _bundle_libraries(package: Path) -> None:
    """Copies of the libraries of the system that libtetmend.so needs, found beside it by its run path."""
    listed = subprocess.run(["ldd", package / "libtetmend.so.0"], check=True, capture_output=True, text=True).stdout
    for name, file in re.findall(r"^\s*(\S+) => (/\S+)", listed, re.M):
        if not OF_THE_SYSTEM.match(name):
            shutil.copyfile(file, package / name)


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


def _write_info(root: Path, info: str) -> None:
    folder = root / info
    (folder / "licenses").mkdir(parents=True)
    (folder / "METADATA").write_text(_metadata())
    (folder / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: tetmend_build\nRoot-Is-Purelib: false\nTag: {_tag()}\n")
    for name in ("LICENSE", "THIRD-PARTY.md"):
        shutil.copyfile(SOURCE / name, folder / "licenses" / name)


def get_requires_for_build_wheel(config_settings=None) -> list[str]:
    return []


def get_requires_for_build_sdist(config_settings=None) -> list[str]:
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None) -> str:
    info = f"tetmend-{_version()}.dist-info"
    _write_info(Path(metadata_directory), info)
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None) -> str:
    settings = config_settings or {}
    name = f"tetmend-{_version()}"
    wheel = f"{name}-{_tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        _install(settings, root)
        if settings.get("system-libs") != "true":
            _bundle_libraries(root / "tetmend")
        _write_info(root, f"{name}.dist-info")
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
