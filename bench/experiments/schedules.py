# SPDX-License-Identifier: MIT
"""All schedules that come with tetmend, over all meshes."""

import subprocess

import common
import compare
import report


def names() -> list[str]:
    """What `tetmend schedules` lists; table2 is an experiment of its own."""
    program = str(compare.BUILD / "bin" / "tetmend")
    listing = subprocess.run([program, "schedules"], check=True, capture_output=True, text=True)
    lines = [line for line in listing.stdout.splitlines() if not line.startswith(" ")]
    return [line.split()[0] for line in lines if line.split()[0] != "table2"]


def main() -> None:
    options = common.parse("schedules", __doc__)
    table = [["mesh", "schedule", "tets", *report.QUALITY, "seconds"]]
    results = []
    for mesh in common.meshes(options):
        rows = {name: common.improve(mesh, options, "--schedule", name) for name in names()}
        before = next(iter(rows.values()))["before"]
        table.append([mesh.stem, "(input)", *common.cells(before, None)])
        for name, row in rows.items():
            cells = common.cells(row["after"], row["seconds"])
            cells[-1] += ", stopped" if row["over_limit"] else ""
            table.append([mesh.stem, name, *cells])
        results.append({"mesh": mesh.stem, "rows": rows})
    common.save("schedules", options, {"meshes": results}, table)


if __name__ == "__main__":
    main()
