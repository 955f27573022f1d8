# SPDX-License-Identifier: MIT
"""Interior constraints respected or ignored [chen, Fig. 13]."""

import common
import compare
import curves
import report

NAMES = ["sheet", "folded_sheet", "two_materials"]
TEXT = (
    "The default schedule with the interior triangles, edges and required vertices of the file, "
    "and with `--ignore-interior` [chen, Fig. 13]. Faces between regions stay in any case, because "
    "the labels of the tets stay. The pictures are of the meshes on which constraints leave bad "
    "tets."
)


def distribution(mesh: str, rows: dict[str, dict]) -> str:
    measured = {"input": rows["respected"]["before"],
                "respected": rows["respected"]["after"], "ignored": rows["ignored"]["after"]}
    lines = {name: [(3 * i + 1.5, share) for i, share in enumerate(figures["angle_percent"])]
             for name, figures in measured.items()}
    top = max(share for line in lines.values() for _, share in line)
    return curves.draw(f"{mesh}: interior constraints respected and ignored",
                       ("dihedral angle, degrees", "share of all angles in 3 degrees, percent"),
                       curves.linear_axis(0, 180, 30, *curves.across()),
                       curves.linear_axis(0, top * 1.05, 1, *curves.up()), lines, marks=False)


def main() -> None:
    options = common.parse("figure13", __doc__)
    assets = compare.ROOT / "assets" / "meshes"
    inputs = common.meshes(options) if options.meshes else [assets / f"{n}.mesh" for n in NAMES]
    table = [["mesh", "interior constraints", "tets", *report.QUALITY, common.SECONDS]]
    results, pictures = [], {}
    for mesh in inputs:
        rows = {"respected": common.improve(mesh, options),
                "ignored": common.improve(mesh, options, "--ignore-interior")}
        table.append([mesh.stem, "(input)", *common.cells(rows["respected"]["before"], None)])
        for name, row in rows.items():
            table.append([mesh.stem, name, *common.cells(row["after"], row["user_seconds"])])
        if rows["respected"]["after"]["n_bad"] > 0:
            pictures[f"figure13-{mesh.stem}.svg"] = distribution(mesh.stem, rows)
        results.append({"mesh": mesh.stem, "rows": rows})
    common.save("figure13", options, {"meshes": results}, table,
                "Interior constraints respected or ignored", TEXT, pictures)


if __name__ == "__main__":
    main()
