# SPDX-License-Identifier: MIT
"""Prints as JSON what CalculiX (ccx) does with a mesh of linear tets.

    ccx_solve.py INPUT.mesh

A body of modulus and density 1 without lateral contraction, so that waves have a speed of 1, is held
at one end of its longest side and hangs under its weight: steps of ccx's iterative solver with
diagonal scaling. The step of explicit dynamics that ccx would take is its stable time increment. It is
in proportion to the least altitude of a tet; one tet tells the factor.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import medit  # noqa: E402

STATIC = "*STATIC,SOLVER=ITERATIVE SCALING"
EXPLICIT = "*DYNAMIC,EXPLICIT\n1e-30,1e-30"
ONE_TET = medit.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2, 3)])
ALTITUDE_OF_ONE = 3 ** -0.5


def turned(mesh: medit.Mesh, tet: medit.Tet) -> medit.Tet:
    """As ccx wants it: of positive volume. Some formats list vertices the other way round."""
    a, b, c, d = (mesh.points[v] for v in tet)
    u, v, w = ([q - p for p, q in zip(a, end, strict=True)] for end in (b, c, d))
    volume = (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2])
              + u[2] * (v[0] * w[1] - v[1] * w[0]))
    return tet if volume >= 0 else (tet[0], tet[2], tet[1], tet[3])


def deck(mesh: medit.Mesh, procedure: str) -> str:
    used = sorted({v for tet in mesh.tets for v in tet})
    sides = [max(p[i] for p in mesh.points) - min(p[i] for p in mesh.points) for i in range(3)]
    axis = sides.index(max(sides))
    low = min(mesh.points[v][axis] for v in used)
    held = [v for v in used if mesh.points[v][axis] <= low + 0.05 * sides[axis]]
    weight = ",".join("1." if i == axis else "0." for i in range(3))
    rows = ["*NODE,NSET=ALL"]
    rows += ["{},{!r},{!r},{!r}".format(v + 1, *map(float, mesh.points[v])) for v in used]
    rows += ["*ELEMENT,TYPE=C3D4,ELSET=BODY"]
    rows += [",".join(str(n) for n in (i + 1, *(v + 1 for v in turned(mesh, tet))))
             for i, tet in enumerate(mesh.tets)]
    rows += ["*NSET,NSET=HELD", *(f"{v + 1}," for v in held), "*MATERIAL,NAME=M", "*ELASTIC",
             "1.,0.", "*DENSITY", "1.", "*SOLID SECTION,ELSET=BODY,MATERIAL=M", "*BOUNDARY",
             "HELD,1,3", "*STEP", procedure, "*DLOAD", f"BODY,GRAV,1.,{weight}", "*END STEP"]
    return "\n".join(rows) + "\n"


def ran(mesh: medit.Mesh, procedure: str) -> str:
    """What ccx prints."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "job.inp").write_text(deck(mesh, procedure))
        return subprocess.run(["ccx", "job"], cwd=folder, check=False, capture_output=True,
                              text=True).stdout


def increment(mesh: medit.Mesh) -> float:
    found = re.search(r"COURANT initial stable time increment: *([\d.eE+-]+)", ran(mesh, EXPLICIT))
    if found is None:
        sys.exit("ccx tells no stable time increment")
    return float(found[1])


def main() -> None:
    mesh = medit.read(Path(sys.argv[-1]), leave_out_unknown=True)
    step = increment(mesh)
    told = {"explicit": step, "tolerance": 1e-5,
            "figures": {"least_altitude": {"worst": step / increment(ONE_TET) * ALTITUDE_OF_ONE}}}
    version = subprocess.run(["ccx", "-v"], check=False, capture_output=True, text=True).stdout
    told["version"] = next(iter(re.findall(r"Version *([\d.]+)", version)), "")
    if sys.argv[1] != "--values":
        steps = re.findall(r"iteration= *(\d+), error", ran(mesh, STATIC))
        told["iterations"] = max(map(int, steps)) if steps else None
    print(json.dumps(told))


main()
