# SPDX-License-Identifier: MIT
"""Results of a comparison as tables: aligned text for the terminal, Markdown for documents."""

from collections.abc import Callable

import charts
import documents
import dots
import paper
from documents import Stamp, Table, markdown_table
from measures import ANGLES, SHAPES, angle, percent

QUALITY = [measure.column for measure in ANGLES]
PAPER_HEADING = ["mesh", "scheme", "tets", "theta_min", "theta_max", "lambda %", "seconds"]
PHASES = ["reading", "building", "improving", "measuring", "writing"]  # of tetmend
WORDS = ["improver", "one pass of", "schedule", "surface"]  # aligned left


EXPLANATION = (
    "*improving s* is what a program says about its work without reading and writing; *whole run "
    "s*, *user s* (processor time) and *peak MB* are those of the process, with Python for Gmsh "
    "and Netgen. Other work on the machine changes *user s* least. TetGen's whole run includes "
    "that it takes the mesh in. Angles in degrees; lambda in percent of the dihedral angles "
    "outside 30 to 150 degrees; a bad tet has a minimum sine below 0.5. *surface*: kept means the "
    "same triangles bit for bit; rounded means the same triangles with coordinates changed by at "
    "most the number given. One program measures all results; it shares no formula "
    "with tetmend."
)
SHAPES_TITLE = "Shapes of tets, and faces:"
SHAPES_EXPLANATION = (
    "*mean ratio* and *radius ratio* are 1 for the regular tet and 0 for a flat one: "
    "12 (3 V)^(2/3) by the sum of the squared edges, and three times the radius of the inscribed "
    "sphere by that of the circumscribed one; of all tets the worst and the mean. *edge ratio* is "
    "that of the longest to the shortest edge of a tet, at worst. *faces above 70* are inner faces "
    "whose normal is more than 70 degrees from the line that joins the centroids of the two tets."
)


# --- cells


def seconds(value: float) -> str:
    return f"{value:.3f}" if value < 1 else f"{value:.2f}" if value < 10 else f"{value:,.0f}"


def least(times: dict | None) -> str:
    """Of the runs that with the least other work on the machine."""
    return "" if times is None else seconds(times["min"])


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
    heading += ["improving s", "whole run s", "user s", "peak MB"]
    before = mesh["before"]
    table = [heading, ["(input)", f"{before['tets']:,}", *quality(before), *[""] * 5]]
    for row in mesh["rows"]:
        if "after" not in row or row["status"] != "ok":
            table.append([row["improver"], *[""] * 5, row["status"], *[""] * 4])
            continue
        table.append(
            [
                row["improver"],
                f"{row['after']['tets']:,}",
                *quality(row["after"]),
                surface(row["surface"]),
                least(row["phases"].get("improving")),
                least(row["whole_seconds"]),
                least(row["user_seconds"]),
                f"{row['peak_bytes'] / 1e6:,.0f}",
            ]
        )
    return table


def shapes(mesh: dict) -> Table:
    """The measures beside angles."""
    rows = [("(input)", mesh["before"])]
    rows += [(row["improver"], row["after"]) for row in mesh["rows"] if "after" in row]
    table = [["improver", *(measure.column for measure in SHAPES)]]
    return table + [[name, *(measure.shown(measure.of(measured)) for measure in SHAPES)]
                    for name, measured in rows]


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
            cells += [surface(row["surface"]), *[least(phases.get(p)) for p in PHASES]]
            cells += [f"{before['tets'] / phases['improving']['min']:,.0f}"]
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
            f"{row.seconds:,g}",
        ]
        for row in rows
    ]


# --- documents


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


def made_line(results: dict) -> str:
    machine, count = results["machine"], results["repetitions"]
    runs = f"Times are the least of {count} runs in turns: other work on the machine adds to them."
    return (f"Load {machine['load_before']:.1f} at the start. "
            + (runs if count > 1 else "One run of each."))


def sections(results: dict, heading: str, render: Callable[[Table], str],
             after: Callable[[dict], list[str]]) -> list[str]:
    """@param after  what follows the tables of a mesh"""
    parts = []
    if len(own_schedule(results)) > 1:
        parts += [heading + "tetmend alone", render(own_schedule(results))]
    for mesh in results["meshes"]:
        parts += [heading + mesh["mesh"], render(comparison(mesh)), SHAPES_TITLE,
                  render(shapes(mesh)), *after(mesh)]
    return parts


def missing_lines(results: dict) -> list[str]:
    names: dict[str, list[str]] = {}
    for row in results["missing"]:
        names.setdefault(row["hint"], []).append(row["improver"])
    return [f"- not run: {'; '.join(rows)}. {hint}" for hint, rows in names.items()]


def text(results: dict) -> str:
    machine = documents.machine_text(results["machine"])
    parts = [f"{results['date']}, {machine}. {made_line(results)}"]
    parts += sections(results, "\n", text_table, lambda _: [])
    if results["missing"]:
        parts += ["", *missing_lines(results)]
    return "\n".join(parts)


def commands_table(results: dict) -> Table:
    table = [["improver", "command", "version"]]
    for row in results["meshes"][0]["rows"] if results["meshes"] else []:
        table.append([row["improver"], f"`{row['command']}`", row["version"]])
    return table


def charts_of(mesh: dict) -> list[str]:
    return [documents.picture(kind.file_name(mesh), kind.heading(mesh))
            for kind in (dots, charts) if kind.chart(mesh)]


def page(results: dict) -> str:
    """The comparison as a document."""
    made = Stamp(results["command"], results["commit"], results["date"],
                 documents.machine_text(results["machine"]))
    parts = [made_line(results), EXPLANATION, SHAPES_EXPLANATION]
    parts += sections(results, "## ", markdown_table, charts_of)
    parts += ["## Commands", markdown_table(commands_table(results))]
    if results["missing"]:
        parts.append("\n".join(missing_lines(results)))
    return documents.document("tetmend and other improvers", made, parts)
