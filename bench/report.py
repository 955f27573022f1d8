# SPDX-License-Identifier: MIT
"""Results of a comparison as tables: aligned text for the terminal, Markdown for documents."""

from collections.abc import Callable

import paper

Table = list[list[str]]  # the first row is the heading

QUALITY = ["theta_min", "theta_max", "lambda %", "bad"]
ELSEWHERE = "paper: its mesh, its machine"
PHASES = ["reading", "building", "improving", "measuring", "writing"]  # of tetmend
WORDS = ["improver", "one pass of", "default schedule of", "surface", "measured"]  # aligned left


# --- cells


def angle(degrees: float) -> str:
    return f"{degrees:.2f}" if degrees >= 0.01 else f"{degrees:.2g}"


def percent(value: float) -> str:
    return "0" if value == 0 else f"{value:#.3g}"


def seconds(value: float) -> str:
    return f"{value:.3f}" if value < 1 else f"{value:.2f}" if value < 10 else f"{value:,.0f}"


def with_spread(times: dict | None) -> str:
    """Median of the runs, and half their range in percent of it."""
    if times is None:
        return ""
    median = times["median"]
    if times["min"] == times["max"]:
        return seconds(median)
    return f"{seconds(median)} ±{50 * (times['max'] - times['min']) / median:.0f} %"


def bad(measured: dict) -> str:
    broken = measured["inverted"] + measured["flat"]
    return f"{measured['n_bad']:,}" + (f", {broken:,} inverted or flat" if broken else "")


def quality(measured: dict) -> list[str]:
    angles = [angle(measured["theta_min"]), angle(measured["theta_max"])]
    return [*angles, percent(measured["lambda"]), bad(measured)]


def surface(compared: dict) -> str:
    if compared["surface"] == "identical":
        return "kept"
    if compared["surface"] == "moved":
        return f"rounded ({compared['distance']:.0e})"
    return f"changed ({compared['lost']:,} lost)"


# --- tables


def comparison(mesh: dict) -> Table:
    heading = ["improver", "tets after", *QUALITY, "surface"]
    heading += ["improving s", "whole run s", "peak MB"]
    before = mesh["before"]
    table = [heading, ["(input)", f"{before['tets']:,}", *quality(before), "", "", "", ""]]
    for row in mesh["rows"]:
        if "after" not in row or row["status"] != "ok":
            table.append([row["improver"], *[""] * 5, row["status"], "", "", ""])
            continue
        table.append(
            [
                row["improver"],
                f"{row['after']['tets']:,}",
                *quality(row["after"]),
                surface(row["surface"]),
                with_spread(row["phases"].get("improving")),
                with_spread(row["whole_seconds"]),
                f"{row['peak_bytes'] / 1e6:,.0f}",
            ]
        )
    return table


def own_schedule(results: dict) -> Table:
    """tetmend alone, all meshes in one table."""
    change = ["theta_min", "theta_max", "lambda %", "bad"]
    table = [["mesh", "improver", "tets before", "after", *change]]
    table[0] += ["surface", *[f"{phase} s" for phase in PHASES], "tets a second", "peak MB"]
    for mesh in results["meshes"]:
        before = mesh["before"]
        for row in mesh["rows"]:
            if not row["ours"] or "after" not in row:
                continue
            after, phases = row["after"], row["phases"]
            pairs = zip(quality(before), quality(after), strict=True)
            cells = [mesh["mesh"], row["improver"], f"{before['tets']:,}", f"{after['tets']:,}"]
            cells += [f"{old} -> {new}" for old, new in pairs]
            cells += [surface(row["surface"]), *[with_spread(phases.get(p)) for p in PHASES]]
            cells += [f"{before['tets'] / phases['improving']['median']:,.0f}"]
            table.append([*cells, f"{row['peak_bytes'] / 1e6:,.0f}"])
    return table


def paper_rows(rows: list[paper.PaperRow]) -> Table:
    return [
        [
            row.mesh,
            row.scheme,
            f"{row.tets:,}",
            f"{row.theta_min:g}",
            f"{row.theta_max:g}",
            f"{row.lambda_percent:g}",
            "",
            f"{row.seconds:,g}",
            ELSEWHERE,
        ]
        for row in rows
    ]


def table_2(results: dict) -> Table:
    table = [["mesh", "one pass of", "tets", *QUALITY, "seconds", "measured"]]
    for mesh in results["table2"]:
        for row in mesh["rows"]:
            name, time = row["scheme"], row["seconds"]
            cells = [angle(row["theta_min"]), angle(row["theta_max"]), percent(row["lambda"])]
            cells += [f"{row['n_bad']:,}", seconds(time) if time else "", "here"]
            table.append([mesh["mesh"], name, f"{row['tets']:,}", *cells])
    return table + paper_rows(paper.TABLE_2)


def table_3(results: dict) -> Table:
    table = [["mesh", "default schedule of", "tets", *QUALITY, "seconds", "measured"]]
    for mesh in results["meshes"]:
        for row in mesh["rows"]:
            if not row["ours"] or "after" not in row:
                continue
            after, time = row["after"], row["phases"]["improving"]["median"]
            cells = [f"{after['tets']:,}", *quality(after), seconds(time), "here"]
            table.append([mesh["mesh"], row["improver"], *cells])
    return table + paper_rows(paper.TABLE_3)


# --- documents


def markdown_table(table: Table) -> str:
    lines = ["| " + " | ".join(row) + " |" for row in table]
    return "\n".join([lines[0], "|" + "---|" * len(table[0]), *lines[1:]])


def text_table(table: Table) -> str:
    widths = [max(len(row[i]) for row in table) for i in range(len(table[0]))]

    def line(row: list[str]) -> str:
        cells = [
            cell.ljust(width) if i == 0 or table[0][i] in WORDS else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        return "  ".join(cells).rstrip()

    rule = "-" * (sum(widths) + 2 * len(widths) - 2)
    return "\n".join([line(table[0]), rule, *map(line, table[1:])])


def machine_line(results: dict) -> str:
    machine, count = results["machine"], results["repetitions"]
    memory = machine["memory_bytes"] / 1e9
    runs = f"Median of {count} runs in turns, with half their range in percent."
    return (
        f"{results['date']}, {machine['processor']}, {machine['cores']} cores, {memory:.0f} GB, "
        f"load {machine['load_before']:.1f} at the start. " + (runs if count > 1 else "One run.")
    )


def sections(results: dict, heading: str, render: Callable[[Table], str]) -> list[str]:
    parts = []
    if len(own_schedule(results)) > 1:
        parts += [heading + "The default schedule", render(own_schedule(results))]
    for mesh in results["meshes"]:
        parts += [heading + mesh["mesh"], render(comparison(mesh))]
    if results["table2"]:
        parts += [heading + "One reconnection pass [chen, Table 2]", render(table_2(results))]
        parts += [heading + "Default schedules [chen, Table 3]", render(table_3(results))]
    return parts


def missing_lines(results: dict) -> list[str]:
    names: dict[str, list[str]] = {}
    for row in results["missing"]:
        names.setdefault(row["hint"], []).append(row["improver"])
    return [f"- not run: {'; '.join(rows)}. {hint}" for hint, rows in names.items()]


def text(results: dict) -> str:
    parts = [machine_line(results), *sections(results, "\n", text_table)]
    if results["missing"]:
        parts += ["", *missing_lines(results)]
    return "\n".join(parts)


def commands_table(results: dict) -> Table:
    table = [["improver", "command", "version"]]
    for row in results["meshes"][0]["rows"] if results["meshes"] else []:
        table.append([row["improver"], f"`{row['command']}`", row["version"]])
    return table


def markdown(results: dict) -> str:
    parts = [f"`{results['command']}`: {machine_line(results)}"]
    parts += [
        "*improving s* is what the program itself says about its work without reading and writing; "
        "*whole run s* and *peak MB* are those of the process, with Python for Gmsh and Netgen. "
        "Angles in degrees; lambda in percent of the dihedral angles outside 30 to 150 degrees; a "
        "bad tet has a minimum sine below 0.5. "
        "*surface*: kept means the same triangles bit for bit; rounded means the same triangles "
        "with coordinates changed by at most the number given."
    ]
    parts += sections(results, "### ", markdown_table)
    parts += ["### Commands", markdown_table(commands_table(results))]
    if results["missing"]:
        parts.append("\n".join(missing_lines(results)))
    return "\n\n".join(parts) + "\n"
