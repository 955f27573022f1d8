# SPDX-License-Identifier: MIT
"""Improvers that move the surface, with the same tolerance, in the same run.

The tolerance is 1 % of the mean edge length of the surface, the same everywhere, for MMG is told a
length. CGAL's remeshing takes none. How far the surface went is measured by bench/surfaces, which
shares no code with what proves it.
"""

import argparse
import math
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import compare
import competitors
import documents
import report
from competitors import Competitor

SHARE = 0.01
TEXT = (
    "*Distance*: the largest of samples of either surface from the other, in parts of the tolerance, "
    "1 % of the mean edge length of the surface: result to input, input to result. 1 is what was "
    "allowed, and less than 1e-9 is shown as 0. *Seconds* of the processor on one thread, reading "
    "and writing included. With `flat` tetmend keeps the shape. CGAL's remeshing takes no tolerance: five rounds "
    "with the mean edge length for a target, no features given."
)
HEADING = ["mesh", "program", "tets", "angles", "below 30 or above 150", "distance", "volume",
           "seconds"]


@dataclass
class Result:
    program: str
    status: str
    tets: int = 0
    angles: tuple[float, float] = (0, 0)
    bad: int = 0
    distance: tuple[float, float] = (0, 0)  # in tolerances
    volume: float = 0  # change, in parts of the whole
    seconds: float = 0

    def cells(self) -> list[str]:
        if self.status != "ok":
            return [self.program, self.status] + [""] * 5
        return [self.program, f"{self.tets:,}", "{:.1f}, {:.1f}".format(*self.angles),
                f"{self.bad:,}", ", ".join(map(shown, self.distance)),
                f"{100 * self.volume:+.2g} %" if abs(self.volume) > 1e-11 else "same",
                f"{self.seconds:.1f}"]


def shown(distance: float) -> str:
    return "0" if distance < 1e-9 else f"{distance:.2g}" if distance < 10 else f"{distance:.0f}"


def rows(tetmend: Path, tolerance: float) -> list[Competitor]:
    def own(surface: str, name: str, schedule: str) -> Competitor:
        options = f"--quiet --threads 1 --schedule {schedule} --surface {surface}"
        return Competitor(name=f"tetmend {schedule}, {name}", short=f"{schedule} {name}",
                          found=str(tetmend), hint="", output="output.mesh",
                          command=(str(tetmend), "improve", "input.mesh", "-o", "output.mesh",
                                   *options.split()), phases=competitors.untold, ours=True)

    mmg = competitors.variable("TETMEND_BENCH_MMG3D")
    files = ("input.mesh", "output.mesh")
    return [
        own("fixed", "surface fixed", "thorough"),
        own("flat", "`flat`", "thorough"),
        own(f"{tolerance:.6g}", "tolerance", "shell"),
        own(f"{tolerance:.6g}", "tolerance", "thorough"),
        Competitor(name="MMG -optim -hausd tolerance", short="MMG", found=mmg,
                   hint="Needs TETMEND_BENCH_MMG3D=PROGRAM: mmg3d (www.mmgtools.org)",
                   command=(mmg or "mmg3d", "-optim", "-hausd", f"{tolerance:.6g}", "-in", files[0],
                            "-out", files[1]), output=files[1], phases=competitors.mmg_phases),
        competitors.cgal_row("CGAL, tetrahedral_isotropic_remeshing"),
    ]


def run(row: Competitor, mesh: Path, tolerance: float, limit: float, side: int) -> Result:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "input.mesh").symlink_to(mesh)
        outcome = compare.run(row.command, folder, limit)
        if outcome.status == "ok" and not (folder / row.output).exists():
            outcome.status = "no result"
        if outcome.status != "ok":
            return Result(row.name, outcome.status)
        try:
            judged = compare.program_json("measure", str(mesh), str(folder / row.output))["after"]
            moved = compare.program_json("surfaces", str(mesh), str(folder / row.output), str(side))
        except subprocess.CalledProcessError:
            return Result(row.name, "unreadable result")
    was, now = moved["volume"]
    return Result(row.name, "ok", judged["tets"], (judged["theta_min"], judged["theta_max"]),
                  judged["n_bad"],
                  (moved["after_to_before"] / tolerance, moved["before_to_after"] / tolerance),
                  now / was - 1, outcome.user)


def chart(mesh: str, results: list[Result]) -> str:
    """How far each went, on a logarithmic scale; the line is the tolerance."""
    good = [one for one in results if one.status == "ok"]
    low, high, left, width, step = -4, 3, 330, 430, 26

    def place(value: float) -> float:
        power = max(low, min(high, math.log10(value) if value > 0 else low))
        return left + width * (power - low) / (high - low)

    parts = [f'<text x="{left}" y="18" font-weight="bold">{mesh}: distance of the surfaces, in '
             "tolerances</text>"]
    bottom = 34 + step * len(good)
    for power in range(low, high + 1):
        x = place(10.0 ** power)
        weight = 'stroke="#b00" stroke-width="2"' if power == 0 else 'stroke="#ccc"'
        label = "0" if power == low else f"{10.0 ** power:g}"
        parts.append(f'<line x1="{x:.1f}" y1="28" x2="{x:.1f}" y2="{bottom}" {weight}/>')
        parts.append(f'<text x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{label}</text>')
    for i, one in enumerate(good):
        y = 44 + step * i
        name = one.program.replace("`", "")
        parts.append(f'<text x="{left - 12}" y="{y + 4}" text-anchor="end">{name}</text>')
        for distance, colour in zip(one.distance, ("#06c", "#e80"), strict=True):
            parts.append(f'<circle cx="{place(distance):.1f}" cy="{y}" r="5" fill="{colour}"/>')
    y = bottom + 36
    for x, colour, text in ((left, "#06c", "result to input"), (left + 160, "#e80",
                                                                "input to result")):
        parts.append(f'<circle cx="{x}" cy="{y - 4}" r="5" fill="{colour}"/>')
        parts.append(f'<text x="{x + 12}" y="{y}">{text}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="800" height="{y + 14}" '
            f'font-family="sans-serif" font-size="13">\n<rect width="100%" height="100%" '
            'fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n")


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --surface", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("meshes", nargs="*", metavar="MESH", help="file, or name of a default mesh "
        "(default: the default meshes)")
    add("--limit", type=float, default=600, metavar="SECONDS",
        help="of the processor, for each run (default: 600)")
    add("--side", type=int, default=13, metavar="N",
        help="(N + 1) (N + 2) / 2 samples of each triangle (default: 13, which makes 105)")
    add("--build", type=Path, default=compare.BUILD, help="build folder")
    documents.add_option(parser)
    options = parser.parse_args()
    compare.BUILD = options.build.resolve()
    table, pictures, parts = [HEADING], {}, [TEXT]
    meshes = [compare.named_mesh(name) for name in options.meshes]
    for mesh in meshes or compare.default_meshes(quick=True):
        mesh = mesh.resolve()
        with tempfile.TemporaryDirectory() as name:
            plain = Path(name) / "input.mesh"
            subprocess.run([compare.BUILD / "bench" / "prepare", mesh, plain], check=True)
            itself = compare.program_json("surfaces", str(plain), str(plain), "1")
            tolerance = SHARE * itself["mean_edge"]
            results = []
            for row in rows(compare.BUILD / "bin" / "tetmend", tolerance):
                if row.found is None:
                    compare.progress(f"{row.name}: {row.hint}")
                    continue
                result = run(row, plain, tolerance, options.limit, options.side)
                compare.progress(f"{mesh.stem}: {result}")
                results.append(result)
        table += [[mesh.stem, *one.cells()] for one in results]
        pictures[f"surface_{mesh.stem}.svg"] = chart(mesh.stem, results)
    print(report.text_table(table))
    if options.write:
        parts += [documents.markdown_table(table)]
        parts += [documents.picture(name, "Distance of the surfaces in parts of the tolerance")
                  for name in pictures]
        made = documents.stamp("script/bench --surface")
        documents.write(options.write, documents.document("Surfaces that move", made, parts),
                        pictures)


if __name__ == "__main__":
    main()
