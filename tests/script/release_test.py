# SPDX-License-Identifier: MIT
"""script/release and script/address in a fresh clone: the steps that compile nothing, and what they refuse.

release_test.py SOURCE_FOLDER
"""

import hashlib
import json
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
FILES = ["script/release", "script/address", "packaging", "README.md", "CITATION.cff", "docs/install.md", "CHANGELOG.md", "pyproject.toml",
         "bindings/python/backend", ".github"]
STEPS = ["source", "sdist", "changelog", "recipes", "sbom", "checksums"]


def git(folder: Path, *words: str) -> None:
    subprocess.run(["git", "-C", folder, "-c", "user.name=test", "-c", "user.email=test@test.invalid", *words], check=True, capture_output=True)


class Release(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        """A clone with the files as they are here."""
        cls.folder = Path(tempfile.mkdtemp(prefix="tetmend-release-"))
        cls.clone = cls.folder / "tetmend"
        subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{SOURCE}", cls.clone], check=True)
        for name in FILES:
            if (SOURCE / name).is_dir():
                shutil.copytree(SOURCE / name, cls.clone / name, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(SOURCE / name, cls.clone / name)
        git(cls.clone, "add", "-A")
        git(cls.clone, "commit", "-q", "--allow-empty", "-m", "as it is here")
        cls.done = cls.release(*STEPS)
        cls.dist = cls.clone / "build/dist"
        cls.version = re.search(r"project\(tetmend VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        cls.address = (SOURCE / "packaging/address").read_text().strip()

    @classmethod
    def tearDownClass(cls) -> None:
        shutil.rmtree(cls.folder)

    @classmethod
    def release(cls, *steps: str) -> subprocess.CompletedProcess:
        return subprocess.run([cls.clone / "script/release", "--only", *steps], capture_output=True, text=True, timeout=300)

    def test_one_run_makes_source_sdist_changelog_recipes_and_sbom_with_checksums(self) -> None:
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        wanted = {f"tetmend-{self.version}{end}" for end in ("-source.tar.gz", ".tar.gz", "-changes.md", "-recipes.tar.gz", ".spdx.json")}
        self.assertEqual({file.name for file in self.dist.iterdir()}, wanted | {"SHA256SUMS"})
        told = dict(reversed(line.split()) for line in (self.dist / "SHA256SUMS").read_text().splitlines())
        self.assertEqual(told, {name: hashlib.sha256((self.dist / name).read_bytes()).hexdigest() for name in wanted})

    def test_the_source_has_all_files_of_the_commit(self) -> None:
        listed = subprocess.run(["git", "-C", self.clone, "ls-files", "-z"], check=True, capture_output=True, text=True).stdout
        with tarfile.open(self.dist / f"tetmend-{self.version}-source.tar.gz") as archive:
            files = {each.name.partition("/")[2] for each in archive.getmembers() if not each.isdir()}
        self.assertEqual(files, set(filter(None, listed.split("\0"))))

    def test_recipes_of_a_release_have_its_address_and_the_checksum_of_the_source(self) -> None:
        source = self.dist / f"tetmend-{self.version}-source.tar.gz"
        with tarfile.open(self.dist / f"tetmend-{self.version}-recipes.tar.gz") as archive:
            texts = {each.name.partition("/")[2]: archive.extractfile(each).read().decode() for each in archive.getmembers() if each.isfile()}
        for name in ("conda/meta.yaml", "homebrew/tetmend.rb", "spack/package.py"):
            self.assertIn(f"{self.address}/{source.name}", texts[name])
            self.assertIn(hashlib.sha256(source.read_bytes()).hexdigest(), texts[name])
        self.assertIn(hashlib.sha512(source.read_bytes()).hexdigest(), texts["vcpkg/tetmend/portfile.cmake"])

    def test_the_changelog_is_that_of_the_version(self) -> None:
        text = (self.dist / f"tetmend-{self.version}-changes.md").read_text()
        self.assertTrue(text.startswith(f"## [{self.version}]"))
        self.assertNotIn("\n## [", text)

    def test_the_sbom_relates_only_what_it_describes(self) -> None:
        made = json.loads((self.dist / f"tetmend-{self.version}.spdx.json").read_text())
        self.assertEqual(made["spdxVersion"], "SPDX-2.3")
        known = {each["SPDXID"] for each in made["packages"]} | {"SPDXRef-DOCUMENT"}
        self.assertEqual(len(known), len(made["packages"]) + 1)
        for each in made["relationships"]:
            self.assertLessEqual({each["spdxElementId"], each["relatedSpdxElement"]}, known)
        self.assertTrue(all(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", each) for each in known))

    def test_changes_that_are_not_committed_end_it(self) -> None:
        with (self.clone / "README.md").open("a") as file:
            file.write("more\n")
        try:
            done = self.release("changelog")
        finally:
            git(self.clone, "checkout", "-q", "README.md")
        self.assertEqual(done.returncode, 1)
        self.assertIn("not committed", done.stderr)

    def test_another_address_is_written_into_each_text_that_quotes_it(self) -> None:
        new = "https://example.org/mesh/tetmend"
        subprocess.run([self.clone / "script/address", new], check=True, capture_output=True)
        try:
            found = subprocess.run(["git", "-C", self.clone, "grep", "-lF", self.address, "--", ":!tests"], capture_output=True, text=True).stdout
            told = subprocess.run([self.clone / "script/address"], check=True, capture_output=True, text=True).stdout.split()
            quoting = [name for name in told[1:] if new in (self.clone / name).read_text()]
        finally:
            git(self.clone, "checkout", "-q", ".")
        self.assertEqual(found, "")
        self.assertEqual(told[0], new)
        self.assertEqual(quoting, told[1:])

    def test_what_is_no_address_is_refused(self) -> None:
        for word in ("http://example.org", "https://example.org/", "tetmend", "--chek"):
            done = subprocess.run([self.clone / "script/address", word], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, word)
        self.assertEqual((self.clone / "packaging/address").read_text().strip(), self.address)

    def test_the_workflow_runs_scripts_that_exist_with_options_they_have(self) -> None:
        text = (SOURCE / ".github/workflows/release.yml").read_text()
        commands = re.findall(r"(script/\w+)((?: --\w+)*)", text)
        self.assertGreaterEqual(len(commands), 4)
        for script, options in commands:
            told = subprocess.run([SOURCE / script, "--help"], check=True, capture_output=True, text=True).stdout
            for option in options.split():
                self.assertIn(option, told, script)


if __name__ == "__main__":
    if not (SOURCE / ".git").exists() or shutil.which("git") is None:
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
