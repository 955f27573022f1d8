# SPDX-License-Identifier: MIT
"""Meshes of Gmsh with prisms beside tets and with curved tets go through `tetmend improve`.

    gmsh_elements_test.py SOURCE TETMEND

Gmsh finds every prism with the same bits, every node of the curved surface in its place, and no
Jacobian of a tet of second order that is not positive. Exit status 77: Gmsh's Python module is not
there.
"""

import json
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from with_gmsh import start_with_gmsh

TET, PRISM, TET10, TRIANGLE6, PRISM15 = 4, 6, 11, 9, 18
WIDTH = {TET: 4, PRISM: 6, TET10: 10, TRIANGLE6: 6, PRISM15: 15}
failures = 0


def check(condition: bool, text: str) -> None:
    global failures
    print(("ok    " if condition else "FAIL  ") + text)
    failures += not condition


def begin(gmsh, name: str) -> None:
    gmsh.model.add(name)
    gmsh.option.setNumber("Mesh.Optimize", 0)


def prisms_on_tets(gmsh, file: Path, order: int) -> None:
    begin(gmsh, f"mixed{order}")
    occ = gmsh.model.occ
    box = occ.addBox(0, 0, 0, 1, 1, 1)
    occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [box], 1)
    gmsh.model.setPhysicalName(3, 1, "tets")
    (_, top), = gmsh.model.getEntitiesInBoundingBox(-1, -1, 0.9, 2, 2, 1.1, 2)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.2)
    made = occ.extrude([(2, top)], 0, 0, 0.3, numElements=[4], recombine=True)
    occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [tag for dim, tag in made if dim == 3], 2)
    gmsh.model.setPhysicalName(3, 2, "prisms")
    # Triangles on the prisms, which no tet has.
    far = gmsh.model.getEntitiesInBoundingBox(-1, -1, 1.2, 2, 2, 1.4, 2)
    gmsh.model.addPhysicalGroup(2, [tag for _, tag in far], 3)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)
    gmsh.write(str(file))


def curved_ball(gmsh, file: Path) -> None:
    begin(gmsh, "ball")
    gmsh.model.occ.addSphere(0, 0, 0, 1)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.3)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
    gmsh.model.addPhysicalGroup(3, [1], 7)
    gmsh.model.addPhysicalGroup(2, [1], 8)
    gmsh.model.setPhysicalName(2, 8, "skin")
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    gmsh.write(str(file))


def elements(gmsh, file: Path) -> dict:
    """By type: each element as the bits of its nodes; and the Jacobian ratio of each curved tet."""
    gmsh.model.add(file.name)
    gmsh.merge(str(file))
    tags, places, _ = gmsh.model.mesh.getNodes()
    bits = {tag: struct.pack("3d", *places[3 * i:3 * i + 3]) for i, tag in enumerate(tags)}
    found = {}
    for kind, width in WIDTH.items():
        _, nodes = gmsh.model.mesh.getElementsByType(kind)
        found[kind] = [tuple(bits[n] for n in nodes[i:i + width]) for i in range(0, len(nodes), width)]
    found["ratios"] = []
    if found[TET10]:
        local = gmsh.model.mesh.getElementProperties(TET10)[4]
        _, determinants, _ = gmsh.model.mesh.getJacobians(TET10, local)
        for i in range(0, len(determinants), 10):
            ten = determinants[i:i + 10]
            found["ratios"].append(min(ten) / max(ten))
    return found


def improve(tetmend: str, source: Path, target: Path) -> dict:
    report = target.with_suffix(".json")
    subprocess.run([tetmend, "improve", source, "-o", target, "--report", report, "--quiet"], check=True)
    return json.loads(report.read_text())


def main() -> int:
    start_with_gmsh()
    import gmsh
    tetmend = sys.argv[2]
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        mixed, better = folder / "mixed.msh", folder / "mixed2.msh"
        prisms_on_tets(gmsh, mixed, 1)
        report = improve(tetmend, mixed, better)
        before, after = elements(gmsh, mixed), elements(gmsh, better)
        check(len(before[PRISM]) > 200 and before[PRISM] == after[PRISM],
              f"{len(before[PRISM])} prisms with the same bits")
        check(report["before"]["n_bad"] > 0 and report["after"]["n_bad"] == 0,
              f"{len(before[TET])} tets: {report['before']['n_bad']} bad ones, then {report['after']['n_bad']}")

        for format in ("msh", "vtu"):
            there, better = folder / f"mixed_there.{format}", folder / f"mixed_better.{format}"
            back = folder / f"mixed_{format}.msh"
            prisms_on_tets(gmsh, mixed, 2)
            subprocess.run([tetmend, "convert", mixed, there], check=True, capture_output=True)
            report = improve(tetmend, there, better)
            subprocess.run([tetmend, "convert", better, back], check=True, capture_output=True)
            before, after = elements(gmsh, mixed), elements(gmsh, back)
            check(len(before[PRISM15]) > 200 and sorted(before[PRISM15]) == sorted(after[PRISM15]),
                  f"{format}: {len(before[PRISM15])} prisms of second order with the same bits")
            check(len(before[TRIANGLE6]) > 50 and sorted(before[TRIANGLE6]) == sorted(after[TRIANGLE6]),
                  f"{format}: {len(before[TRIANGLE6])} triangles of second order with the same bits")
            check(report["after"]["n_bad"] == 0 and min(after["ratios"]) > 0,
                  f"{format}: {report['before']['n_bad']} bad tets of second order, then none")

        ball = folder / "ball.msh"
        curved_ball(gmsh, ball)
        before = elements(gmsh, ball)
        skin = set(sum(before[TRIANGLE6], ()))
        # Every format with second order hands the same mesh back.
        for format in ("msh", "vtu", "vtk", "mesh", "meshb"):
            there, back = folder / f"ball_there.{format}", folder / f"ball_{format}.msh"
            subprocess.run([tetmend, "convert", ball, there], check=True, capture_output=True)
            improved = folder / f"ball_better.{format}"
            report = improve(tetmend, there, improved)
            subprocess.run([tetmend, "convert", improved, back], check=True, capture_output=True)
            after = elements(gmsh, back)
            check(skin == set(sum(after[TRIANGLE6], ())), f"{format}: {len(skin)} nodes of the curved surface stay")
            check(report["after"]["n_bad"] == 0, f"{format}: {report['before']['n_bad']} bad tets, then none")
            check(min(after["ratios"]) > max(0, min(before["ratios"])),
                  f"{format}: worst Jacobian ratio {min(before['ratios']):.3f}, then {min(after['ratios']):.3f}")
            told = report["after"]["second_order"]["worst_jacobian_ratio"]
            check(abs(told - min(after["ratios"])) < 1e-9, f"{format}: tetmend measures {told:.3f}, as Gmsh does")
    gmsh.finalize()
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
