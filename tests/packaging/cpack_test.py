# SPDX-License-Identifier: MIT
"""cpack makes Debian packages of what is built: each file in its place and its package, and what each depends on.

    cpack_test.py SOURCE BUILD

Folders are those of the build; script/package has Debian's, and looks at the packages more closely.
"""

import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
SKIPPED = 77
FOLDER = BUILD / "cpack_test"
NEEDED = ["cpack", "dpkg-deb", "dpkg-shlibdeps", "file"]


def output(*command: str | Path) -> str:
    done = subprocess.run(command, capture_output=True, text=True, cwd=BUILD)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def is_on(option: str) -> bool:
    return re.search(rf"^{option}:BOOL=ON$", (BUILD / "CMakeCache.txt").read_text(), re.M) is not None


EXPECTED = {"tetmend", "libtetmend0.1", "libtetmend-dev"}
EXPECTED |= {"tetmend-viewer"} if is_on("TETMEND_BUILD_VIEWER") else set()
EXPECTED |= {"python3-tetmend"} if is_on("TETMEND_BUILD_PYTHON") else set()
EXPECTED |= {"tetmend-mpi"} if (BUILD / "bin/tetmend-mpi").exists() else set()


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        shutil.rmtree(FOLDER, ignore_errors=True)
        output("cpack", "-C", "Release", "-B", FOLDER)
        cls.files = {file.name.partition("_")[0]: file for file in FOLDER.glob("*.deb")}

    @classmethod
    def tearDownClass(cls) -> None:
        shutil.rmtree(FOLDER, ignore_errors=True)

    def field(self, package: str, name: str) -> str:
        return output("dpkg-deb", "-f", self.files[package], name).strip()

    def depends(self, package: str) -> set[str]:
        return {each.split()[0] for each in self.field(package, "Depends").split(", ")}

    def content(self, package: str) -> dict[str, str]:
        """Names, from the root, and permissions with owner."""
        lines = output("dpkg-deb", "-c", self.files[package]).splitlines()
        return {line.split()[5].removeprefix("."): " ".join(line.split()[:2]) for line in lines}

    def test_all_are_there(self) -> None:
        self.assertEqual(set(self.files), EXPECTED)

    def test_no_file_is_in_two_of_them(self) -> None:
        seen: dict[str, str] = {}
        for package in self.files:
            for name in self.content(package):
                if not name.endswith("/"):
                    self.assertNotIn(name, seen)
                    seen[name] = package

    def test_each_has_its_files(self) -> None:
        wanted = {
            "tetmend": ["/usr/bin/tetmend", "/usr/share/man/man1/tetmend-improve.1.gz", "/usr/share/man/man1/tetmend.1.gz",
                        "/usr/share/bash-completion/completions/tetmend", "/usr/share/zsh/vendor-completions/_tetmend",
                        "/usr/share/fish/vendor_completions.d/tetmend.fish",
                        "/usr/share/tetmend/lessons/1-core.trace"],
            "tetmend-viewer": ["/usr/bin/tetmend-view", "/usr/share/man/man1/tetmend-view.1.gz",
                               "/usr/share/applications/tetmend-view.desktop", "/usr/share/mime/packages/tetmend.xml",
                               "/usr/share/icons/hicolor/scalable/apps/tetmend-view.svg"],
            "tetmend-mpi": ["/usr/bin/tetmend-mpi", "/usr/share/man/man1/tetmend-mpi.1.gz"],
            "libtetmend0.1": ["/libtetmend.so.0.1", "/libtetmend.so.0.1.0"],
            "libtetmend-dev": ["/libtetmend.so", "/usr/include/tetmend/improve.h", "/usr/include/tetmend/plugin.h",
                               "/cmake/tetmend/tetmendConfig.cmake", "/pkgconfig/tetmend.pc"],
            "python3-tetmend": ["/usr/lib/python3/dist-packages/tetmend/__init__.py"],
        }
        for package in EXPECTED:
            names = self.content(package)
            for name in [*wanted[package], f"/usr/share/doc/{package}/copyright", f"/usr/share/doc/{package}/changelog.gz"]:
                self.assertTrue(any(each.endswith(name) for each in names), f"{package}: {name}")
            for name, mode in names.items():
                self.assertTrue(mode.endswith(" root/root"), f"{name}: {mode}")
                if name.endswith("/"):
                    self.assertEqual(mode, "drwxr-xr-x root/root", name)

    def test_the_library_has_no_links_for_the_linker(self) -> None:
        self.assertFalse([name for name in self.content("libtetmend0.1") if name.endswith((".so", ".h", ".pc"))])

    def test_each_depends_on_what_it_is_linked_with(self) -> None:
        for package in EXPECTED - {"libtetmend-dev", "python3-tetmend"}:
            self.assertLessEqual({"libc6", "libtbb12", "libfmt9", "libzstd1", "liblua5.4-0"}, self.depends(package), package)
        itself = f"libtetmend0.1 (= {self.field('libtetmend0.1', 'Version')})"
        for package in EXPECTED & {"libtetmend-dev", "python3-tetmend"}:
            self.assertIn(itself, self.field(package, "Depends"))

    def test_the_program_depends_on_hdf5_which_it_opens_for_its_files(self) -> None:
        self.assertNotIn("libhdf5", output("readelf", "-d", BUILD / "bin" / "tetmend"))
        self.assertTrue(any(each.startswith("libhdf5-") for each in self.depends("tetmend")))

    @unittest.skipUnless("tetmend-viewer" in EXPECTED, "the viewer is not built")
    def test_the_viewer_depends_on_what_it_opens_as_it_runs(self) -> None:
        """The names that epoxy and GLFW give to dlopen; the font that the panels ask for."""
        self.assertLessEqual({"libgl1", "libegl1", "libopengl0", "libgl1-mesa-dri", "libx11-xcb1", "libxi6", "libxrandr2",
                              "libxcursor1", "libxinerama1", "libxrender1", "libxxf86vm1", "fonts-dejavu-core"},
                             self.depends("tetmend-viewer"))

    @unittest.skipUnless("python3-tetmend" in EXPECTED, "the Python package is not built")
    def test_the_python_package_is_for_its_python_and_has_no_path_of_the_build(self) -> None:
        depends = self.field("python3-tetmend", "Depends")
        self.assertRegex(depends, r"python3 \(>= 3\.\d+\), python3 \(<< 3\.\d+\), python3-numpy")
        folder = FOLDER / "python"
        output("dpkg-deb", "-x", self.files["python3-tetmend"], folder)
        [module] = folder.rglob("_core*.so")
        self.assertNotRegex(output("readelf", "-d", module), "RPATH|RUNPATH")

    def test_the_headers_of_operators_bring_eigen(self) -> None:
        self.assertEqual(self.field("libtetmend-dev", "Recommends"), "libeigen3-dev")

    def test_each_names_the_address_of_the_project(self) -> None:
        address = (SOURCE / "packaging/address").read_text().strip()
        for package in EXPECTED:
            self.assertEqual(self.field(package, "Homepage"), address)

    def test_apt_shows_what_each_is(self) -> None:
        for package in EXPECTED:
            first, *rest = self.field(package, "Description").splitlines()
            self.assertRegex(first, "^improvement of tetrahedral meshes - ")
            self.assertGreater(len(rest), 2)


if __name__ == "__main__":
    missing = [tool for tool in NEEDED if shutil.which(tool) is None]
    if missing:
        print(f"tetmend: skipped, not installed: {', '.join(missing)}")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
