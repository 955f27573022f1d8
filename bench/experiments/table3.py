# SPDX-License-Identifier: MIT
"""The default schedules of Grummp, of Stellar and of the paper [chen, Table 3]."""

import common
import paper
import report


def main() -> None:
    options = common.parse("table3", __doc__)
    table = [["mesh", "default schedule of", "tets", *report.QUALITY, "seconds", "measured"]]
    results = []
    for mesh in common.meshes(options):
        rows = {name: common.improve(mesh, options, "--schedule", name)
                for name in common.SCHEDULES}
        before = rows["shell"]["before"]
        table.append([mesh.stem, "input", *common.cells(before, None), "here"])
        for name, row in rows.items():
            place = "here, stopped" if row["over_limit"] else "here"
            cells = common.cells(row["after"], row["seconds"])
            table.append([mesh.stem, common.TITLES[name], *cells, place])
        if mesh.stem == "tire":  # the only mesh of the paper among them
            table += report.paper_rows([row for row in paper.TABLE_3 if row.mesh == "Tire"])
        results.append({"mesh": mesh.stem, "rows": rows})
    common.save("table3", options, {"meshes": results}, table)


if __name__ == "__main__":
    main()
