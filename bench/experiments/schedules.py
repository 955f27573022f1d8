# SPDX-License-Identifier: MIT
"""All schedules that come with tetmend, over all meshes."""

import subprocess

import common
import compare
import documents
import paper
import report

TEXT = (
    "What each schedule does is in [schedules.md](../schedules.md). `grummp` and `stellar` are the "
    "paper's description of these schedules in tetmend's operators, not the programs; `shell` is "
    "Algorithm 6, the default. `surface` is made to follow another one where `--surface` lets the "
    "surface move; here it is alone, and the surface stays."
)
ELSEWHERE = (
    "Table 3 of the paper: its own meshes, its own machine, the programs of others as they were "
    "then. Of these meshes only the tire is among those above."
)


def names() -> list[str]:
    """What `tetmend schedules` lists; table2 is an experiment of its own, adapt is told lengths, best takes the time it is given."""
    program = str(compare.BUILD / "bin" / "tetmend")
    listing = subprocess.run([program, "schedules"], check=True, capture_output=True, text=True)
    lines = [line for line in listing.stdout.splitlines() if not line.startswith(" ")]
    return [line.split()[0] for line in lines if line.split()[0] not in ("table2", "adapt", "best")]


def main() -> None:
    options = common.parse("schedules", __doc__)
    table = [["mesh", "schedule", "tets", *report.QUALITY, common.SECONDS]]
    results = []
    for mesh in common.meshes(options):
        rows = {name: common.improve(mesh, options, "--schedule", name) for name in names()}
        before = next(iter(rows.values()))["before"]
        table.append([mesh.stem, "(input)", *common.cells(before, None)])
        for name, row in rows.items():
            cells = common.cells(row["after"], row["user_seconds"])
            cells[-1] += ", stopped" if row["over_limit"] else ""
            table.append([mesh.stem, name, *cells])
        results.append({"mesh": mesh.stem, "rows": rows})
    of_paper = documents.markdown_table([report.PAPER_HEADING, *report.paper_rows(paper.TABLE_3)])
    common.save("schedules", options, {"meshes": results}, table, "All schedules on all meshes",
                TEXT, more=["## What the paper measured", ELSEWHERE, of_paper])


if __name__ == "__main__":
    main()
