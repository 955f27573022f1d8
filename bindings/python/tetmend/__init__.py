# SPDX-License-Identifier: MIT
"""Better tetrahedral meshes, with the same surface.

    import tetmend
    result = tetmend.improve(points, tets, labels=materials, threads=4)
    result.points, result.tets, result.labels

Points are an array (n, 3) of real numbers, tets an array (m, 4) of numbers of points, from 0. The surface, the faces between
two labels and all other constraints stay bit for bit. The same input gives the same output, for every number of threads, and
the same as the command line.

`tetmend.gmsh`, `tetmend.meshio`, `tetmend.vtk`, `tetmend.pyvista` and `tetmend.dolfinx` improve meshes of these programs where they are.
"""

from tetmend._catalogue import Operator, Parameter, Schedule, formats, operators, schedules
from tetmend._check import Check, Fact, check
from tetmend._core import Error, OptionError, Progress, __version__
from tetmend._figures import Pass, Statistics
from tetmend._improve import Result, adapt, improve
from tetmend._kernel import Call, Edit, Look, PassDone, Ring, TetMesh
from tetmend._mesh import Group, Mesh, MissingFile, load, save
from tetmend._options import Options
from tetmend._quality import BadTet, Quality, quality
from tetmend._surface import from_surface
from tetmend._trace import Trace, TracePage

__all__ = [
    "BadTet", "Call", "Check", "Edit", "Error", "Fact", "Group", "Look", "Mesh", "MissingFile", "Operator", "OptionError", "Options", "Parameter", "Pass",
    "PassDone", "Progress", "Quality", "Result", "Ring", "Schedule", "Statistics", "TetMesh", "Trace", "TracePage", "__version__", "adapt",
    "check", "formats", "from_surface", "improve", "load", "operators", "quality", "save", "schedules",
]
