# SPDX-License-Identifier: MIT
"""One reconnection pass over the bad tets with each scheme [chen, Table 2]."""

import common
import compare
import paper
import report


def main() -> None:
    options = common.parse("table2", __doc__)
    table = [["mesh", "one pass of", "tets", *report.QUALITY, "seconds", "measured"]]
    results = []
    for mesh in common.meshes(options):
        rows = {scheme: common.improve(mesh, options, "--schedule", "table2", "--set",
                                       f"scheme={scheme}") for scheme in compare.SCHEMES}
        before = rows["shell"]["before"]
        table.append([mesh.stem, "input", *common.cells(before, None), "here"])
        for scheme, row in rows.items():
            cells = common.cells(row["after"], row["seconds"])
            table.append([mesh.stem, compare.SCHEMES[scheme], *cells, "here"])
        results.append({"mesh": mesh.stem, "rows": rows})
    common.save("table2", options, {"meshes": results}, table + report.paper_rows(paper.TABLE_2))


if __name__ == "__main__":
    main()
