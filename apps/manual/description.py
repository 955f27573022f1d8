# SPDX-License-Identifier: MIT
"""What a program says about itself with --help-json."""

import json
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path


class Failure(Exception):
    """One line for the user."""


@dataclass
class Option:
    """An option, a flag (it has no value), or a positional argument (it has no names)."""

    names: list[str]
    positional: str
    value: str
    required: bool
    group: str  # the heading under which help lists it
    place: int  # in help
    repeatable: bool
    alone: bool  # of those that are, a command takes one at most
    text: str

    def sentence(self) -> str:
        """The text in one line: help breaks its lines by hand."""
        return " ".join(self.text.split())

    def label(self) -> str:
        """By what a table names it."""
        return self.positional or self.names[-1]


@dataclass
class Command:
    """A program, or one of its commands."""

    name: str
    purpose: str
    options: list[Option]
    commands: list["Command"]
    text: str
    version: str = ""
    words: dict[str, list[str]] = field(default_factory=dict)

    def purpose_line(self) -> str:
        return " ".join(self.purpose.split())

    def flags(self) -> list[Option]:
        return [option for option in self.options if option.names]

    def groups(self) -> dict[str, list[Option]]:
        """The flags by the headings of help, in its order: the usual ones, then others."""
        found: dict[str, list[Option]] = {"Options": []}
        for option in sorted(self.flags(), key=lambda option: option.place):
            found.setdefault(option.group, []).append(option)
        return found

    def positionals(self) -> list[Option]:
        return [option for option in self.options if not option.names]

    def usage(self) -> list[str]:
        """What stands behind the name: IN, -o OUT, [OPTIONS]."""
        words = [option.positional if option.required else f"[{option.positional}]" for option in self.positionals()]
        words += [f"{option.names[0]} {option.value}" for option in self.flags() if option.required]
        return words + ["COMMAND ..." if self.commands else "[OPTIONS]"]

    def blocks(self) -> list[list[str]]:
        """The text behind the options, split at empty lines."""
        return [block.split("\n") for block in re.split(r"\n\s*\n", self.text.strip("\n")) if block]


def to_command(data: dict) -> Command:
    data["options"] = [Option(**option) for option in data["options"]]
    data["commands"] = [to_command(command) for command in data["commands"]]
    return Command(**data)


def describe(program: Path) -> Command:
    done = subprocess.run([program, "--help-json"], capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(f"{program} --help-json ended with status {done.returncode}")
    return to_command(json.loads(done.stdout))
