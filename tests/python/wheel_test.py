# SPDX-License-Identifier: MIT
"""The wheel and the source archive, made and installed without a network. Uses the objects of the build."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

import pytest
from conftest import BUILD, MATERIALS, SOURCE

# A user's environment: nothing of this test's.
CLEAN = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "LD_LIBRARY_PATH")}
SETTINGS = [f"--config-settings=build-dir={BUILD}", "--config-settings=jobs=2"]


@pytest.fixture(scope="module")
def venv(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("venv")
    done = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", folder], capture_output=True, text=True)
    if done.returncode != 0:
        pytest.skip("no virtual environments: python3-venv is not installed")
    return folder


def run(*words, **more) -> str:
    done = subprocess.run(list(map(str, words)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=CLEAN, **more)
    assert done.returncode == 0, done.stdout
    return done.stdout


def test_pip_installs_without_a_network_and_the_package_runs(venv, tmp_path):
    run(venv / "bin/python", "-m", "pip", "install", "--no-index", "--no-build-isolation", *SETTINGS, SOURCE)
    program = (f"import tetmend; r = tetmend.improve(tetmend.load({str(MATERIALS)!r})); print(tetmend.__file__, r.after.n_bad)\n"
               "print([l.split()[-1] for l in open('/proc/self/maps') if 'libtetmend' in l or 'libtbb' in l])")
    told = run(venv / "bin/python", "-c", program, cwd=tmp_path)
    assert str(venv) in told.splitlines()[0] and told.splitlines()[0].endswith(" 0")
    loaded = set(re.findall(r"'([^']+)'", told))
    assert len(loaded) == 2 and all(file.startswith(str(venv)) for file in loaded), loaded
    run(venv / "bin/python", "-m", "pip", "uninstall", "-y", "tetmend")
    assert not list(venv.rglob("tetmend*"))


def test_the_wheel_is_tagged_and_lists_its_files(tmp_path):
    sys.path.insert(0, str(SOURCE / "bindings/python/backend"))
    import tetmend_build
    name = tetmend_build.build_wheel(tmp_path, {"build-dir": str(BUILD), "jobs": "2"})
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    machine = sysconfig.get_platform().replace("linux-", "").replace("-", "_")
    assert re.fullmatch(rf"tetmend-{tetmend_build._version()}-{version}-{version}-manylinux_2_\d\d_{machine}.whl", name)
    with zipfile.ZipFile(tmp_path / name) as archive:
        names = set(archive.namelist())
        record = next(each for each in names if each.endswith("RECORD"))
        assert {line.split(",")[0] for line in archive.read(record).decode().splitlines()} == names
        metadata = archive.read(next(each for each in names if each.endswith("METADATA"))).decode()
        points = archive.read(next(each for each in names if each.endswith("entry_points.txt"))).decode()
    for line in ("Home-page: https://", "Author: ", "Classifier: ", "Keywords: ", "Project-URL: Source, https://"):
        assert f"\n{line}" in metadata
    assert "[pyvista.accessors]\ntetmend = tetmend.pyvista\n" in points
    modules = {f"tetmend/{path.name}" for path in (SOURCE / "bindings/python/tetmend").iterdir() if path.is_file()}
    assert modules <= names and "tetmend/libtetmend.so.0.1" in names
    assert any(each.endswith("licenses/LICENSE") for each in names) and any(each.endswith("THIRD-PARTY.md") for each in names)


def test_each_bundled_library_has_a_name_of_its_own_and_its_licence(tmp_path):
    if shutil.which("patchelf") is None:
        pytest.skip("patchelf is not installed")
    sys.path.insert(0, str(SOURCE / "bindings/python/backend"))
    import tetmend_build
    name = tetmend_build.build_wheel(tmp_path, {"build-dir": str(BUILD), "jobs": "2"})
    with zipfile.ZipFile(tmp_path / name) as archive:
        archive.extractall(tmp_path / "wheel")
    package = tmp_path / "wheel/tetmend"
    bundled = {file.name for file in package.glob("*.so*")} - {"libtetmend.so.0.1"} - {file.name for file in package.glob("_core*")}
    assert len(bundled) >= 4 and all(re.fullmatch(r"lib[\w+.-]+-[0-9a-f]{8}\.so[.\d]*", each) for each in bundled), bundled
    needed = {each for file in package.glob("*.so*") for each in re.findall(r"NEEDED.*\[(.*)\]", run("readelf", "-d", file))}
    assert {each for each in needed if not tetmend_build.OF_THE_SYSTEM.match(each)} == bundled | {"libtetmend.so.0.1"}
    licences = {file.name for file in (tmp_path / "wheel").glob("*.dist-info/licenses/*.so*.txt")}
    assert licences == {f"{each}.txt" for each in bundled}


def test_the_source_archive_has_what_a_build_needs(tmp_path):
    sys.path.insert(0, str(SOURCE / "bindings/python/backend"))
    import tetmend_build
    name = tetmend_build.build_sdist(tmp_path)
    with tarfile.open(tmp_path / name) as archive:
        files = {each.name.partition("/")[2] for each in archive.getmembers()}
    assert {"PKG-INFO", "pyproject.toml", "CMakeLists.txt", "bindings/python/backend/tetmend_build.py",
            "bindings/python/tetmend/gmsh.py", "kernel/tet_mesh.cpp"} <= files
    assert not any(file.startswith("build/") for file in files)


def test_the_module_build_makes_the_same(tmp_path):
    pytest.importorskip("build")
    run(sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", tmp_path, f"-Cbuild-dir={BUILD}", "-Cjobs=2", SOURCE)
    assert len(list(tmp_path.glob("*.whl"))) == 1
