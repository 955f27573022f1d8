# SPDX-License-Identifier: MIT
"""Prints as JSON what Gmsh says about each tet of a mesh: gamma, SICN, SIGE.

    gmsh_rulers.py INPUT.mesh

Gmsh tells them in a file only, with six digits.
"""

import json
import re
import sys
import tempfile
from pathlib import Path

import gmsh

TOLERANCE = 1e-5
NAMES = {"sicn": "SICN", "sige": "SIGE", "radius_ratio": "Gamma"}  # in the order of the file


def values() -> dict[str, list[float]]:
    for name in ["Elementary", "Element", "Eta", "Disto"]:
        gmsh.option.setNumber(f"Print.Post{name}", 0)
    for name in NAMES.values():
        gmsh.option.setNumber(f"Print.Post{name}", 1)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "mesh.pos"
        gmsh.write(str(file))
        tets = re.findall(r"^SS\(.*\)\{(.*)\};", file.read_text(), re.M)
    rows = [[float(word) for word in tet.split(",")] for tet in tets]
    # Each value stands at all four vertices.
    return {ruler: [row[4 * place] for row in rows] for place, ruler in enumerate(NAMES)}


def main() -> None:
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    gmsh.open(sys.argv[1])
    print(json.dumps({"version": gmsh.option.getString("General.Version"),
                      "tolerance": TOLERANCE, "values": values()}))
    gmsh.finalize()


main()
