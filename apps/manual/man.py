# SPDX-License-Identifier: MIT
"""Man pages from what the programs say about themselves."""

import re

from description import Command, Option

ENTRY = re.compile(r"^ {2}(\S.*?)(?: {2,}|\t)(\S.*)$")  # "  name    what it is"
LESSONS = "/usr/share/tetmend/lessons"
PLUGIN_PATH = ("Plugins, as with --plugin: shared libraries, or folders of them, with colons between.")


def escaped(text: str) -> str:
    """Text as roff prints it letter by letter; names such as theta_min stay in one line."""
    text = re.sub(r"(?<!\S)(?=[A-Za-z][A-Za-z]*[_-]\w)", "\0", text)
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("^", "\\(ha").replace("~", "\\(ti")
    text = text.replace("'", "\\(aq").replace("`", "\\(ga")
    return re.sub(r"^([.])", r"\\&\1", text.replace("\0", "\\%"))


def paragraph(text: str) -> list[str]:
    """A sentence begins a line, as roff wants it."""
    sentences = re.split(r"(?<=[.:?]) (?=[A-Z])", " ".join(text.split()))
    return [escaped(sentence) for sentence in sentences]


def verbatim(lines: list[str]) -> list[str]:
    indent = min(len(line) - len(line.lstrip()) for line in lines)
    return [".PP", ".RS 4", ".EX", *(escaped(line[indent:]) for line in lines), ".EE", ".RE"]


def entries(lines: list[str]) -> list[tuple[str, str]] | None:
    """Names and what they are, where the lines are such a list."""
    found: list[tuple[str, str]] = []
    for line in lines:
        entry = ENTRY.match(line)
        if entry:
            found.append((entry[1], entry[2]))
        elif found and line.startswith("    "):
            found[-1] = (found[-1][0], f"{found[-1][1]} {line.strip()}")
        else:
            return None
    return found


def listed(lines: list[str]) -> list[str]:
    """Indented lines: a list, or lines that stay as they are."""
    found = entries(lines)
    if found is None:
        return verbatim(lines)
    return [part for name, text in found for part in (".TP", f".B {escaped(name)}", *paragraph(text))]


def prose(lines: list[str]) -> list[str]:
    """A block of help: sentences, and what is indented among them."""
    out: list[str] = []
    while lines:
        is_indented = lines[0].startswith(" ")
        count = next((i for i, line in enumerate(lines) if line.startswith(" ") != is_indented), len(lines))
        run, lines = lines[:count], lines[count:]
        out += listed(run) if is_indented else [".PP", *paragraph(" ".join(run))]
    return out


def statuses(text: str) -> list[str]:
    """"Exit status: 0 success, 1 the work failed" as a list."""
    text = " ".join(text.split()).removeprefix("Exit status: ")
    out: list[str] = []
    for part in re.split(r", (?=\d )", text):
        number, _, meaning = part.partition(" ")
        out += [".TP", f".B {number}", escaped(meaning[0].upper() + meaning[1:] + ".")]
    return out


def synopsis(name: str, command: Command) -> list[str]:
    words = [re.sub(r"(-{1,2}[a-z-]+)", lambda found: f"\\fB{escaped(found[1])}\\fR", word) for word in command.usage()]
    words = [re.sub(r"\b([A-Z]{2,})\b", r"\\fI\1\\fR", word) for word in words]
    return [".SH SYNOPSIS", f".B {escaped(name)}", " ".join(words)]


def option_entry(option: Option) -> list[str]:
    value = f" \\fI{escaped(option.value)}\\fR" if option.value else ""
    names = ", ".join(f"\\fB{escaped(name)}\\fR{value}" for name in option.names)
    text = paragraph(option.sentence())
    return [".TP", names or f"\\fI{option.positional}\\fR", *text]


def headed(title: str, lines: list[str]) -> list[str]:
    return [f".SH {title}", *lines] if lines else []


def page(name: str, command: Command, version: str, date: str, others: list[str]) -> str:
    """`name` as it is called: 'tetmend improve'; `others`: the pages to see also."""
    title = name.replace(" ", "-")
    description: list[str] = []
    examples: list[str] = []
    status: list[str] = []
    for block in command.blocks():
        if block[0] == "Examples:":
            examples = verbatim(block[1:])[1:]
        elif block[0].startswith("Exit status: "):
            status = statuses(" ".join(block))
        else:
            description += prose(block)
    purpose = command.purpose_line().removeprefix(f"{name} ").partition(":")[0].rstrip(".")
    out = [f'.\\" SPDX-License-Identifier: MIT\n.\\" Made from {name} --help by apps/manual.',
           f'.TH {title.upper()} 1 {date} "tetmend {version}" "User Commands"', ".ad l",
           ".SH NAME", f"{title} \\- {escaped(purpose[0].lower() + purpose[1:])}"]
    out += synopsis(name, command)
    lead = paragraph(command.purpose_line().rstrip(".") + ".")
    out += headed("DESCRIPTION", [*lead, *description])
    out += headed("COMMANDS", [part for each in command.commands for part in
                               (".TP", f".BR {escaped(f'{title}-{each.name}')} (1)", escaped(each.purpose_line() + "."))])
    out += headed("ARGUMENTS", [part for each in command.positionals() for part in option_entry(each)])
    for i, (group, options) in enumerate(command.groups().items()):
        out += [".SH OPTIONS" if i == 0 else f".SS {escaped(group)}"]
        out += [part for each in options for part in option_entry(each)]
    if alone := [each.label() for each in command.flags() if each.alone]:
        out += [".PP", f"At most one of {escaped(', '.join(alone))} is allowed."]
    out += headed("EXIT STATUS", status)
    if any("--plugin" in option.names for option in command.options):
        out += headed("ENVIRONMENT", [".TP", ".B TETMEND_PLUGIN_PATH", escaped(PLUGIN_PATH)])
    if title == "tetmend-view":
        out += headed("FILES", [".TP", f".I {LESSONS}", "Lessons: traces with a text that leads through them."])
    out += headed("EXAMPLES", examples)
    out += headed("SEE ALSO", [f".BR {escaped(other)} (1){',' if other != others[-1] else ''}" for other in others])
    return "\n".join(out) + "\n"


def pages(programs: list[Command], date: str) -> dict[str, str]:
    """Files and their content: a page for each program and each of its commands."""
    names = [program.name for program in programs]
    titles = names + [f"{program.name}-{command.name}" for program in programs for command in program.commands]
    made: dict[str, str] = {}
    for program in programs:
        for command in [program, *program.commands]:
            name = program.name if command is program else f"{program.name} {command.name}"
            title = name.replace(" ", "-")
            others = titles if title in names else [*names, f"{program.name}-schedules"]
            others = [other for other in dict.fromkeys(others) if other != title]
            made[f"{title}.1"] = page(name, command, program.version, date, others)
    return made
