# SPDX-License-Identifier: MIT
"""Prints as JSON what Gmsh says about each tet of a mesh: gamma, SICN, SIGE.

    gmsh_rulers.py INPUT.mesh

Gmsh before 4.9 tells gamma only in a file, with six digits.
"""

import json
import re
import sys
import tempfile
from pathlib import Path

import gmsh

DIGITS = {"radius_ratio": 1e-5}  # of what comes from a file; all else is exact


def from_plugin() -> dict[str, list[float]]:
    plugin = "AnalyseMeshQuality"
    for option in ("ICNMeasure", "IGEMeasure", "CreateView"):
        gmsh.plugin.setNumber(plugin, option, 1)
    gmsh.plugin.setNumber(plugin, "DimensionOfElements", 3)
    gmsh.plugin.run(plugin)
    sige, sicn = (gmsh.view.getModelData(tag, 0)[2] for tag in gmsh.view.getTags())
    return {"sicn": [value for [value] in sicn], "sige": [value for [value] in sige]}


def from_file() -> dict[str, list[float]]:
    names = ["SICN", "SIGE", "Gamma"]
    for name in ["Elementary", "Element", "Eta", "Disto"]:
        gmsh.option.setNumber(f"Print.Post{name}", 0)
    for name in names:
        gmsh.option.setNumber(f"Print.Post{name}", 1)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "mesh.pos"
        gmsh.write(str(file))
        rows = re.findall(r"^SS\(.*\)\{(.*)\};", file.read_text(), re.M)
    place = 4 * names.index("Gamma")  # each value stands at all four vertices
    return {"radius_ratio": [float(row.split(",")[place]) for row in rows]}


def main() -> None:
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    gmsh.open(sys.argv[1])
    values = from_file() | from_plugin()
    print(json.dumps({"version": gmsh.option.getString("General.Version"), "digits": DIGITS,
                      "values": values}))
    gmsh.finalize()


main()
