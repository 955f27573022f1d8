# SPDX-License-Identifier: MIT
"""Man pages and completions say what the programs say, and shells and readers of man pages take them.

    manual_test.py SHARE PROGRAM...    SHARE: the folder that apps/manual/manual.py wrote

A shell or reader that is not installed is named and passed over.
"""

import functools
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SHARE = Path(sys.argv[1]).resolve()
PROGRAMS = [Path(name).resolve() for name in sys.argv[2:]]


def output(*command: str | Path, cwd: Path | None = None) -> str:
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def needs(tool: str):
    return unittest.skipUnless(shutil.which(tool), f"{tool} is not installed")


def commands_of(program: Path) -> list[str]:
    listed = output(program, "--help").partition("Subcommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"^  ([a-z-]+)", listed, re.M)


@functools.cache
def helps() -> dict[str, tuple[Path, str, str]]:
    """For each page of man: the program, the command or nothing, and what --help says."""
    found = {}
    for program in PROGRAMS:
        found[program.name] = (program, "", output(program, "--help"))
        for command in commands_of(program):
            found[f"{program.name}-{command}"] = (program, command, output(program, command, "--help"))
    return found


def options_of(text: str) -> set[str]:
    """The long options of a help text's lists."""
    return set(re.findall(r"^ {2,4}(?:-\w,)?(--[a-z-]+)", text, re.M))


def page(name: str) -> Path:
    [file] = SHARE.glob(f"*/man/man1/{name}.1")
    return file


class ManPages(unittest.TestCase):
    def test_there_is_one_for_each_program_and_command(self) -> None:
        self.assertEqual({file.stem for file in SHARE.glob("*/man/man1/*.1")}, set(helps()))
        self.assertGreater(len(helps()), 8)

    def test_each_has_the_options_of_its_help_and_no_other(self) -> None:
        for name, (_, _, text) in helps().items():
            written = re.findall(r"^\.TP\n(.*\\fB\\-.*)$", page(name).read_text(), re.M)
            names = {found.replace("\\", "") for line in written for found in re.findall(r"\\fB(\\-\\-[^ ]*?)\\fR", line)}
            self.assertEqual(names, options_of(text), name)
            self.assertIn("--help", names)

    def test_each_has_the_usual_sections_and_the_words_of_help(self) -> None:
        for name, (_, _, text) in helps().items():
            source = page(name).read_text()
            for title in ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "SEE ALSO"]:
                self.assertIn(f"\n.SH {title}\n", source, name)
            self.assertEqual("\n.SH EXIT STATUS\n" in source, "Exit status: " in text, name)
            self.assertEqual("\n.SH EXAMPLES\n" in source, "\nExamples:\n" in text, name)

    @needs("man")
    def test_a_reader_finds_the_words_of_help_in_them(self) -> None:
        for name, (_, _, text) in helps().items():
            read = subprocess.run(["man", "-l", page(name)], capture_output=True, text=True,
                                  env={"LC_ALL": "C.UTF-8", "MANWIDTH": "400", "PATH": "/usr/bin:/bin"}).stdout
            read = re.sub(r".\x08|\u2010\n *", "", read)  # bold letters; words that were parted
            words = set(re.findall(r"[a-z_]{4,}", read.lower()))
            said = text.partition("Options:")[2].replace("of the following options are allowed", "")
            self.assertEqual(set(re.findall(r"\b[a-z_]{4,}\b", said)) - words, set(), name)

    @needs("mandoc")
    def test_mandoc_has_nothing_to_say_of_them(self) -> None:
        for name in helps():
            self.assertEqual(output("mandoc", "-T", "lint", "-W", "warning", page(name)), "")

    @needs("man")
    def test_groff_has_no_warnings(self) -> None:
        for name in helps():
            done = subprocess.run(["man", "--warnings", "-l", page(name)], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)

    @needs("lexgrog")
    def test_whatis_understands_their_first_line(self) -> None:
        for name in helps():
            self.assertIn(f"{name} - ", output("lexgrog", page(name)))


class Bash(unittest.TestCase):
    """Completion as bash calls it: words, with the last to be completed."""

    def complete(self, *words: str, folder: Path | None = None) -> list[str]:
        [file] = SHARE.glob(f"*/bash-completion/completions/{words[0]}")
        script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
                  'function=$(complete -p "$1" | sed "s/.*-F \\([^ ]*\\).*/\\1/"); compopt() { :; }; "$function"; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        return output("bash", "--norc", "-c", script, "-", file, *words, cwd=folder).split("\n")[:-1]

    def test_syntax(self) -> None:
        for file in SHARE.glob("*/bash-completion/completions/*"):
            output("bash", "-n", file)

    def test_every_command_and_option_is_offered(self) -> None:
        for name, (program, command, text) in helps().items():
            if command:
                self.assertIn(command, self.complete(program.name, ""))
            before = [command] if command else []
            offered = self.complete(program.name, *before, "--")
            self.assertEqual(set(offered), options_of(text), name)

    def test_words_and_files_are_offered_where_they_fit(self) -> None:
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "deeper").mkdir()
        for name in ["part.mesh", "part.mesh.gz", "a b.vtk", "notes.txt", "run.trace", "my.lua"]:
            (folder / name).touch()

        def complete(*words: str) -> set[str]:
            return set(self.complete(*words, folder=folder))

        self.assertEqual(complete("tetmend", "improve", ""), {"deeper", "part.mesh", "part.mesh.gz", "a b.vtk"})
        self.assertEqual(complete("tetmend", "trace", "r"), {"run.trace"})
        self.assertEqual(complete("tetmend", "improve", "--schedule", "th"), {"thorough"})
        self.assertEqual(complete("tetmend", "improve", "--schedule", "=", "my"), {"my.lua"})
        self.assertEqual(complete("tetmend", "improve", "--set", "max_r"), {"max_rounds="})
        self.assertEqual(complete("tetmend", "improve", "--layers", ""), {"keep", "improve"})
        self.assertEqual(complete("tetmend", "improve", "--threads", "4", "part.mesh."), {"part.mesh.gz"})
        self.assertEqual(complete("tetmend", "check", "--for", "o"), {"openfoam"})
        self.assertEqual(complete("tetmend", "operators", "flip_2"), {"flip_2_3"})
        self.assertEqual(complete("tetmend", "improve", "--goal", ""), {""})

    @needs("shellcheck")
    def test_shellcheck_has_nothing_to_say(self) -> None:
        for file in SHARE.glob("*/bash-completion/completions/*"):
            output("shellcheck", "-s", "bash", "--severity=warning", file)


@needs("zsh")
class Zsh(unittest.TestCase):
    def test_syntax(self) -> None:
        for file in SHARE.glob("*/zsh/site-functions/_*"):
            output("zsh", "-n", file)

    def test_every_option_is_there(self) -> None:
        for name, (program, command, text) in helps().items():
            [file] = SHARE.glob(f"*/zsh/site-functions/_{program.name}")
            source = file.read_text()
            if command:
                source = re.split(r"^      [a-z-]+\)$", source.partition(f"      {command})\n")[2], flags=re.M)[0]
            for option in options_of(text):
                self.assertRegex(source, rf"'(\([^)]*\))?\*?{option}=?\[", name)

    def test_zsh_itself_completes(self) -> None:
        """A terminal of its own, with the key Tab; what it offers is read off the screen."""
        [folder] = SHARE.glob("tetmend/zsh/site-functions")
        script = (f"zmodload zsh/zpty; zpty z zsh -f -i; "
                  f"zpty -w z 'PS1=; fpath=({folder} $fpath); autoload -U compinit; compinit -u -D; cd /; echo rea\"\"dy'; "
                  f"zpty -r -m z line '*ready*' ; "
                  f"zpty -w -n z $'tetmend check --for o\\t\\t'; sleep 2; zpty -w -n z $'\\C-a'; "
                  f"zpty -r -m z line '*openfoam*' && print -r -- \"$line\"")
        try:
            done = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, timeout=60,
                                  errors="replace", env={"TERM": "dumb", "PATH": "/usr/bin:/bin", "HOME": "/nonexistent"})
        except subprocess.TimeoutExpired:
            self.fail("zsh offers nothing")
        self.assertIn("openfoam", done.stdout, done.stderr)


@needs("fish")
class Fish(unittest.TestCase):
    def complete(self, line: str) -> set[str]:
        program = line.split()[0]
        [file] = SHARE.glob(f"*/fish/vendor_completions.d/{program}.fish")
        text = output("fish", "--no-config", "-c", f"source {file}; complete -C '{line}'", cwd=SHARE)
        return {offer.partition("\t")[0] for offer in text.splitlines()}

    def test_syntax(self) -> None:
        for file in SHARE.glob("*/fish/vendor_completions.d/*.fish"):
            output("fish", "--no-config", "-n", file)

    def test_every_command_and_option_is_offered(self) -> None:
        for name, (program, command, text) in helps().items():
            if command:
                self.assertIn(command, self.complete(f"{program.name} "), name)
            offered = {word.rstrip("=") for word in self.complete(f"{program.name} {command} --".replace("  ", " "))}
            self.assertEqual(offered, options_of(text), name)

    def test_words_are_offered_where_they_fit(self) -> None:
        self.assertIn("thorough", self.complete("tetmend improve --schedule "))
        self.assertEqual(self.complete("tetmend check --for o"), {"openfoam"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
