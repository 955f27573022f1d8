# SPDX-License-Identifier: MIT
"""Distribution of the bad angles, and velocity against size, of three schedules [chen, Fig. 12]."""

import common
import curves
import report

TEXT = (
    "Shares of the dihedral angles in ten bands of 3 degrees at both ends, in percent, the worst "
    "first: band 0-3 has the angles of 0 to 3 and of 177 to 180 degrees [chen, Fig. 12]. The last "
    "column is the velocity index, tets of the input for each second of the processor. The "
    "pictures are the bands of the largest mesh, and the velocity."
)


def bands(measured: dict) -> list[float]:
    """Percent of the angles in ten bands of 3 degrees at both ends, the worst first."""
    percent = measured["angle_percent"]
    return [percent[i] + percent[59 - i] for i in range(10)]


def distribution(mesh: str, rows: dict[str, dict]) -> str | None:
    """Empty bands have no point, as in the paper."""
    lines = {common.TITLES[name]: [(i + 1, share) for i, share in enumerate(bands(row["after"]))
                                   if share > 0] for name, row in rows.items()}
    values = [value for line in lines.values() for _, value in line]
    if not values:
        return None
    return curves.draw(f"{mesh}: bad angles that remain",
                       ("band i: 3(i-1) to 3i degrees from 0 or 180",
                        "share of all dihedral angles, percent"),
                       curves.linear_axis(0, 11, 1, *curves.across()),
                       curves.log_axis(values, *curves.up()), lines)


def velocity(results: list[dict]) -> str:
    lines = {}
    for name in common.SCHEDULES:
        rows = [entry["rows"][name] for entry in results]
        lines[common.TITLES[name]] = sorted(
            (row["before"]["tets"], row["before"]["tets"] / row["user_seconds"]) for row in rows)
    points = [point for line in lines.values() for point in line]
    return curves.draw("Velocity of the schedules, one thread",
                       ("tets of the input", "tets a second"),
                       curves.log_axis([size for size, _ in points], *curves.across()),
                       curves.log_axis([speed for _, speed in points], *curves.up()), lines)


def main() -> None:
    options = common.parse("figure12", __doc__)
    table = [["mesh", "schedule", *[f"{3 * i}-{3 * i + 3} %" for i in range(10)], "tets a second"]]
    results, drawings = [], {}
    for mesh in common.meshes(options):
        rows = {name: common.improve(mesh, options, "--schedule", name)
                for name in common.SCHEDULES}
        for name, row in rows.items():
            speed = row["before"]["tets"] / row["user_seconds"]
            shares = [report.percent(share) for share in bands(row["after"])]
            table.append([mesh.stem, common.TITLES[name], *shares, f"{speed:,.0f}"])
        drawing = distribution(mesh.stem, rows)
        if drawing:
            drawings[rows["shell"]["before"]["tets"]] = (f"figure12a-{mesh.stem}.svg", drawing)
            (options.output / f"figure12a-{mesh.stem}.svg").write_text(drawing)
        results.append({"mesh": mesh.stem, "rows": rows})
    pictures = dict([drawings[max(drawings)]] if drawings else [])
    pictures["figure12b.svg"] = velocity(results)
    (options.output / "figure12b.svg").write_text(pictures["figure12b.svg"])
    common.save("figure12", options, {"meshes": results}, table, "Bad angles and velocity", TEXT,
                pictures)


if __name__ == "__main__":
    main()
