# SPDX-License-Identifier: MIT
"""One reconnection pass over the bad tets with each scheme [chen, Table 2]."""

import common
import documents
import paper
import report

SCHEMES = {  # as the schedule table2 calls them
    "grummp": "2-3 flip + edge removal",
    "stellar": "edge removal + multi-face",
    "shell_flat": "shell transformation, l_max 0",
    "shell": "shell transformation, l_max 5",
}
TEXT = "One pass over the bad tets with the reconnection of each scheme [chen, Table 2]."
ELSEWHERE = "Table 2 of the paper: its own meshes and its own machine."


def main() -> None:
    options = common.parse("table2", __doc__)
    table = [["mesh", "one pass of", "tets", *report.QUALITY, common.SECONDS]]
    results = []
    for mesh in common.meshes(options):
        rows = {scheme: common.improve(mesh, options, "--schedule", "table2", "--set",
                                       f"scheme={scheme}") for scheme in SCHEMES}
        before = rows["shell"]["before"]
        table.append([mesh.stem, "(input)", *common.cells(before, None)])
        for scheme, row in rows.items():
            cells = common.cells(row["after"], row["user_seconds"])
            table.append([mesh.stem, SCHEMES[scheme], *cells])
        results.append({"mesh": mesh.stem, "rows": rows})
    of_paper = documents.markdown_table([report.PAPER_HEADING, *report.paper_rows(paper.TABLE_2)])
    common.save("table2", options, {"meshes": results}, table,
                "One pass of local reconnection", TEXT,
                more=["## What the paper measured", ELSEWHERE, of_paper])


if __name__ == "__main__":
    main()
