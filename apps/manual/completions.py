# SPDX-License-Identifier: MIT
"""Completions for bash, zsh and fish from what the programs say about themselves."""

import re
import shlex
from dataclasses import dataclass, field
from pathlib import Path

from description import Command, Failure, Option


@dataclass
class Values:
    """What may stand for a value: words, or files with one of these endings. Nothing of both: anything."""

    words: list[str] = field(default_factory=list)
    endings: list[str] = field(default_factory=list)
    any_file: bool = False


LESSONS = Path(__file__).resolve().parent.parent.parent / "assets" / "lessons"
# What an option or argument takes, where a command has its own meaning for it "COMMAND NAME". "mesh": a file that
# tetmend reads; ".x": a file of that ending; "file": any; "<word>": a list that the program names; "": nothing to offer.
TAKES = {
    "IN": "mesh", "OUT": "mesh", "FILE": "mesh", "--output": "mesh", "--cells": "mesh", "--mesh": "mesh",
    "--before": "mesh", "--against": ".trace", "--reference": "mesh", "--tolerance": "", "surface OUT": ".off .obj .ply .stl", "trace FILE": ".trace", "trace --output": "file", "lesson --output": "file",
    "lesson NAME": "<lesson>", "lesson --make": ".trace", "lesson --call": "", "lesson --title": "", "trace --html": "",
    "check-plugin FILE": ".so", "tetmend-view FILE": "mesh .trace", "operators NAME": "<operator>",
    "schedules NAME": "<schedule> .lua", "--schedule": "<schedule> .lua", "--set": "<setting>=",
    "check --measure": "<ruler>=", "improve --measure": "<objective>", "adapt --measure": "<objective>", "pieces --measure": "<objective>", "quality --measure": "<figure>",
    "--for": "<preset>", "improve --for": "<purpose>", "adapt --for": "<purpose>", "pieces --for": "<purpose>", "--purpose": "<purpose>", "--variant": "<variant>", "--format": "<format>", "--plugin": ".so", "--trace": ".trace",
    "--trace-operator": "<operator>", "--report": ".json", "improve --report": ".json .html", "adapt --report": ".json .html", "--render": ".png", "--script": ".lua", "--layers": "<layers>", "--surface": "<surface>", "--feature-angle": "",
    "--goal": "", "--time-limit": "", "--attempt-limit": "", "--threads": "", "--protect": "", "--only": "", "--tets": "",
    "--conserve": "", "--trace-piece": "", "--trace-around": "", "--trace-depth": "", "--trace-limit": "", "--label-array": "",
    "--min-dihedral": "", "--max-dihedral": "", "--list": "", "--tree": "", "--dot": "", "--at": "", "--extract": "",
    "--pieces": "", "--memory": "", "--scratch": "file", "--checkpoint": "file", "STEP": "<step>", "--to": "<format>", "--into": "file", "FOLDER": "file", "MORE": "mesh", "--share": "",
    "--history": "<subject>", "--figure": "<drawing>", "--call": "", "--look": "", "--size": "", "adapt --size": ".sol .solb", "--gradation": "", "--smallest": "", "--largest": "", "--view": "", "--video": ".mp4", "--frames": "", "--title": "", "--background": "<background>", "--scale": "",
}


def with_derived_words(words: dict[str, list[str]]) -> dict[str, list[str]]:
    formats = [ending.removeprefix(".") for ending in words["extension"] if ending.startswith(".")]
    return {**words, "format": formats, "layers": ["keep", "improve"], "purpose": ["explicit", "implicit", "volumes", "angles"], "surface": ["fixed", "flat", "1%"], "figure": [*words["measure"], "all"],
            "subject": ["tet:worst"], "background": ["gradient", "white", "transparent"], "drawing": ["ring", "tree", "timeline", "shell"], "step": ["split", "improve", "join"], "lesson": sorted(file.stem for file in LESSONS.glob("*.json"))}


def values_of(command: str, option: Option, words: dict[str, list[str]]) -> Values:
    takes = TAKES.get(f"{command} {option.label()}", TAKES.get(option.label()))
    if takes is None:
        raise Failure(f"{command} {option.label()}: completions.py does not know what it takes")
    values = Values()
    for word in takes.split():
        if word == "mesh":
            values.endings += [each + end for each in words["extension"] for end in ("", ".gz")]
        elif word == "file":
            values.any_file = True
        elif word.startswith("<"):
            name, _, sign = word.removeprefix("<").partition(">")
            values.words += [each + sign for each in words[name]]
        else:
            values.endings.append(word)
    return values


@dataclass
class Entry:
    """A program or one of its commands, with what its options and arguments take."""

    name: str
    command: Command
    takes: dict[str, Values]  # by label


def entries(program: Command, words: dict[str, list[str]]) -> list[Entry]:
    made = []
    for command in program.commands or [program]:
        takes = {option.label(): values_of(command.name, option, words)
                 for option in command.options if option.value or option.positional}
        made.append(Entry(command.name, command, takes))
    return made


def quoted(words: list[str]) -> str:
    return " ".join(shlex.quote(word) for word in words)


# --- bash

BASH_HELPERS = """# Words, one an argument, that begin with what is there.
_tetmend_words() {
  local word
  for word; do
    [[ $word == "$cur"* ]] && COMPREPLY+=("$(printf %q "$word")")
  done
  [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace
}

# Files with one of these endings, and folders.
_tetmend_files() {
  local ending found
  compopt -o filenames
  mapfile -t found < <(compgen -d -- "$cur"; for ending; do compgen -f -X "!*$ending" -- "$cur"; done)
  COMPREPLY+=("${found[@]}")
}
"""

BASH_FRAME = """
_FUNCTION() {
  local IFS=$' \\t\\n' cur=${COMP_WORDS[COMP_CWORD]} option='' command='FIRST' count=0 i word
  COMPREPLY=()
  # --option=value comes as three words.
  if [[ $cur == = ]]; then
    cur='' option=${COMP_WORDS[COMP_CWORD - 1]}
  elif [[ $COMP_CWORD -gt 1 && ${COMP_WORDS[COMP_CWORD - 1]} == = ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == -* ]]; then
    option=${COMP_WORDS[COMP_CWORD - 1]}
  fi
  # The command, and how many arguments stand before the word.
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [[ $word == = ]]; then
      ((++i))
    elif [[ -z $command ]]; then
      [[ $word == -* ]] || command=$word
    elif [[ $word == -?* ]]; then
      case "$command $word" in
        WITH_VALUE) [[ ${COMP_WORDS[i + 1]} == = ]] || ((++i)) ;;
      esac
    else
      ((++count))
    fi
  done
  case "$command $option" in
VALUES
  esac
  if [[ $cur == -* ]]; then
    case "$command" in
OPTIONS
    esac
    return
  fi
  case "$command $count" in
ARGUMENTS
  esac
}
complete -F _FUNCTION PROGRAM
"""


def bash_action(values: Values) -> str:
    actions = []
    if values.words:
        actions.append(f"_tetmend_words {quoted(values.words)}")
    if values.endings:
        actions.append(f"_tetmend_files {quoted(values.endings)}")
    if values.any_file:
        actions.append("_tetmend_files ''")
    return "; ".join(actions) or ":"


def bash(program: Command, words: dict[str, list[str]]) -> str:
    first = "" if program.commands else program.name
    values, options, arguments, with_value = [], [], [], []
    if program.commands:
        names = [name for option in program.flags() for name in option.names]
        options.append(f"      '') _tetmend_words {quoted(names)} ;;")
        arguments.append(f"    ' 0') _tetmend_words {quoted([each.name for each in program.commands])} ;;")
    for entry in entries(program, words):
        for option in entry.command.flags():
            if option.value:
                patterns = "|".join(f"'{entry.name} {name}'" for name in option.names)
                with_value.append(patterns)
                values.append(f"    {patterns}) {bash_action(entry.takes[option.label()])}; return ;;")
        names = [name for option in entry.command.flags() for name in option.names]
        options.append(f"      {entry.name}) _tetmend_words {quoted(names)} ;;")
        for i, option in enumerate(entry.command.positionals()):
            arguments.append(f"    '{entry.name} {i}') {bash_action(entry.takes[option.label()])} ;;")
    text = BASH_FRAME.replace("_FUNCTION", "_" + program.name.replace("-", "_")).replace("FIRST", first)
    for mark, lines in [("VALUES", values), ("OPTIONS", options), ("ARGUMENTS", arguments)]:
        text = re.sub(rf"^{mark}$", lambda _: "\n".join(lines), text, flags=re.M)
    text = text.replace("WITH_VALUE", "|".join(with_value)).replace("PROGRAM", program.name)
    return f"# bash completion for {program.name}; made from its --help by apps/manual. SPDX-License-Identifier: MIT\n{BASH_HELPERS}{text}"


# --- zsh


def zsh_text(text: str) -> str:
    """Inside of single quotes and brackets of a specification."""
    return text.replace("\\", "\\\\").replace("'", "'\\''").replace("[", "\\[").replace("]", "\\]").replace(":", "\\:")


def zsh_action(values: Values) -> str:
    """What stands behind the second colon; in single quotes."""
    pattern = "|".join(ending for ending in values.endings)
    files = f'_files -g "*({pattern})"' if values.endings else ""
    if values.any_file:
        return "_files"
    if not values.words:
        return files or " "
    inside = " ".join('"' + word + '"' for word in values.words)
    words = f'{{compadd -S "" -- {inside}}}' if values.words[0].endswith("=") else f"{{compadd -- {inside}}}"
    if not files:
        return words
    return words[:-1] + "; " + files + "}"


def zsh_specs(entry: Entry) -> list[str]:
    specs = []
    for option in entry.command.flags():
        again = "*" if option.repeatable else ""
        value = f":{zsh_text(option.value)}:{zsh_action(entry.takes[option.label()])}" if option.value else ""
        others = [name for each in entry.command.flags() if each.alone and option.alone for name in each.names]
        excluded = "" if again else f"({' '.join(others or option.names)})"
        for name in option.names:
            equals = "=" if value and name.startswith("--") else ""
            specs.append(f"'{excluded}{again}{name}{equals}[{zsh_text(option.sentence())}]{value}'")
    for i, option in enumerate(entry.command.positionals()):
        optional = "" if option.required else ":"
        specs.append(f"'{i + 1}:{optional}{option.positional}:{zsh_action(entry.takes[option.label()])}'")
    return specs


def zsh(program: Command, words: dict[str, list[str]]) -> str:
    head = f"#compdef {program.name}\n# Made from its --help by apps/manual. SPDX-License-Identifier: MIT\n"
    made = entries(program, words)
    if not program.commands:
        return head + "_arguments -s \\\n  " + " \\\n  ".join(zsh_specs(made[0])) + "\n"
    lines = [head, "local context state state_descr line", "typeset -A opt_args", "_arguments -C \\"]
    for option in program.flags():
        lines += [f"  '({' '.join(option.names)}){name}[{zsh_text(option.sentence())}]' \\" for name in option.names]
    lines += ["  '1:command:->command' '*::argument:->argument'", "case $state in", "  command)", "    local -a commands=("]
    lines += [f"      '{entry.name}:{zsh_text(entry.command.purpose_line())}'" for entry in made]
    lines += ["    )", "    _describe command commands ;;", "  argument)", "    case $line[1] in"]
    for entry in made:
        lines += [f"      {entry.name})", "        _arguments -s \\\n          " + " \\\n          ".join(zsh_specs(entry)) + " ;;"]
    return "\n".join([*lines, "    esac ;;", "esac"]) + "\n"


# --- fish

FISH_HELPERS = """# Files with one of these endings, and folders.
function __tetmend_files
    for path in (__fish_complete_path (commandline --current-token))
        set -l name (string split \\t -- $path)[1]
        for ending in / $argv
            string match --quiet -- "*$ending" $name; and echo $path; and break
        end
    end
end
"""


def fish_quoted(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def fish_action(values: Values) -> str:
    if values.any_file:
        return "-r -F"
    parts = [word.replace(" ", "\\ ") for word in values.words]
    if values.endings:
        parts.append(f"(__tetmend_files {' '.join(values.endings)})")
    return f"-x -a {fish_quoted(' '.join(parts))}" if parts else "-x"


def fish_option(program: str, condition: str, option: Option, values: Values | None) -> str:
    names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)
    action = "" if values is None else " " + fish_action(values)
    return f"complete -c {program}{condition} {names}{action} -d {fish_quoted(option.sentence())}"


def fish(program: Command, words: dict[str, list[str]]) -> str:
    lines = [f"# fish completion for {program.name}; made from its --help by apps/manual. SPDX-License-Identifier: MIT",
             FISH_HELPERS, f"complete -c {program.name} -f"]
    if program.commands:
        lines += [fish_option(program.name, " -n __fish_use_subcommand", option, None) for option in program.flags()]
    for entry in entries(program, words):
        condition = ""
        if program.commands:
            lines.append(f"complete -c {program.name} -n __fish_use_subcommand -a {entry.name} "
                         f"-d {fish_quoted(entry.command.purpose_line())}")
            condition = f" -n '__fish_seen_subcommand_from {entry.name}'"
        for option in entry.command.flags():
            lines.append(fish_option(program.name, condition, option, entry.takes.get(option.label())))
        for option in entry.command.positionals():
            action = fish_action(entry.takes[option.label()]).removeprefix("-x").strip()
            lines.append(f"complete -c {program.name}{condition} {action}")
    return "\n".join(dict.fromkeys(lines)) + "\n"


def completions(programs: list[Command]) -> dict[str, str]:
    """Files and their content, in folders as systems have them."""
    words = with_derived_words(programs[0].words)
    made: dict[str, str] = {}
    for program in programs:
        made[f"bash-completion/completions/{program.name}"] = bash(program, words)
        made[f"zsh/site-functions/_{program.name}"] = zsh(program, words)
        made[f"fish/vendor_completions.d/{program.name}.fish"] = fish(program, words)
    return made
