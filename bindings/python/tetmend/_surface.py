# SPDX-License-Identifier: MIT
"""From a closed surface to a good mesh: a mesher that is installed fills it, and what it made is improved."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tetmend._arrays import array_of
from tetmend._core import Error
from tetmend._improve import Result, improve
from tetmend._mesh import PathLike, load, missing_file
from tetmend._options import refuse_own

Surface = tuple[NDArray[np.float64], NDArray[np.int64]]

_OWN = ("labels", "parts", "triangles", "triangle_labels", "triangle_data", "edges", "edge_labels", "edge_data", "point_labels", "required",
        "point_data", "cell_data", "groups")
_NUMBER = rb"[-+]?(?:[0-9]*\.)?[0-9]+(?:[eE][-+]?[0-9]+)?"
_VERTEX = re.compile(rb"vertex\s+(" + _NUMBER + rb")\s+(" + _NUMBER + rb")\s+(" + _NUMBER + rb")")


def _read_stl(file: PathLike) -> Surface:
    """Corners that are equal bit for bit are one point."""
    try:
        content = Path(file).read_bytes()
    except FileNotFoundError:
        raise missing_file(file, "a surface is wanted") from None
    count = int.from_bytes(content[80:84], "little")
    if len(content) >= 84 and len(content) == 84 + 50 * count:
        record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        corners = np.frombuffer(content, record, count, 84)["corners"].reshape(-1, 3).astype(np.float64)
    else:
        corners = np.array([[float(number) for number in found] for found in _VERTEX.findall(content)]).reshape(-1, 3)
    if len(corners) == 0 or len(corners) % 3:
        raise Error(f"{os.fspath(file)}: no STL file: {len(corners)} corners of triangles are found")
    points, numbers = np.unique(corners, axis=0, return_inverse=True)
    return points, numbers.reshape(-1, 3).astype(np.int64)


def _surface_of(given: Any) -> Surface:
    if isinstance(given, (str, os.PathLike)):
        if not os.fspath(given).lower().endswith(".stl"):
            raise Error(f"{os.fspath(given)}: of files from_surface() reads .stl: give points and triangles of another")
        return _read_stl(given)
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise TypeError("from_surface() takes the name of an .stl file, or (points, triangles)")
    points = array_of("points", given[0]).astype(np.float64)
    triangles = array_of("triangles", given[1])
    if points.ndim != 2 or points.shape[1] != 3:
        raise Error(f"points has shape {points.shape}, but (n, 3) is wanted")
    if triangles.ndim != 2 or triangles.shape[1] != 3 or triangles.dtype.kind not in "iu":
        raise Error(f"triangles has shape {triangles.shape} and type {triangles.dtype}, but (k, 3) integers are wanted")
    for i, k in np.argwhere((triangles < 0) | (triangles >= len(points)))[:1]:
        raise Error(f"triangles[{i}, {k}] is {triangles[i, k]}, but there are {len(points)} points, numbered from 0")
    return points, triangles.astype(np.int64)


def _check_closed(triangles: NDArray[np.int64]) -> None:
    """Each edge belongs to an even number of triangles."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    rows, counts = np.unique(edges, axis=0, return_counts=True)
    for (a, b), count in zip(rows[counts % 2 == 1][:1], counts[counts % 2 == 1][:1]):
        raise Error(f"the surface is not closed: the edge of points {a} and {b} has {count} triangle{'s' if count > 1 else ''}, and "
                    f"{int((counts % 2 == 1).sum())} edges are like it")


def _run(*command: str, folder: Path) -> None:
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    if done.returncode != 0:
        told = [line.strip() for line in done.stdout.splitlines() if line.strip()]
        errors = [line for line in told if "rror" in line] or told[-3:]
        raise Error(f"{command[0]} could not fill the surface: {'; '.join(errors[-3:])}")


def _by_gmsh(surface: Surface, size: float | None, folder: Path) -> tuple[NDArray[Any], NDArray[Any]]:
    points, triangles = surface
    with (folder / "surface.msh").open("w") as out:
        out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}\n")
        out.writelines(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points.tolist(), 1))
        out.write(f"$EndNodes\n$Elements\n{len(triangles)}\n")
        out.writelines(f"{i} 2 2 0 1 {a + 1} {b + 1} {c + 1}\n" for i, (a, b, c) in enumerate(triangles.tolist(), 1))
        out.write("$EndElements\n")
    sizes = "" if size is None else f"Mesh.MeshSizeMax = {size!r};\n"
    (folder / "solid.geo").write_text(f'Merge "surface.msh";\nSurface Loop(1) = {{1}};\nVolume(1) = {{1}};\nMesh.Optimize = 0;\n{sizes}')
    _run("gmsh", "-3", "solid.geo", "-format", "msh41", "-bin", "-o", "solid.msh", folder=folder)
    mesh = load(folder / "solid.msh")
    return mesh.points, mesh.tets


def _by_tetgen(surface: Surface, size: float | None, folder: Path) -> tuple[NDArray[Any], NDArray[Any]]:
    points, triangles = surface
    with (folder / "surface.off").open("w") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles.tolist())
    volume = "" if size is None else f"a{size**3 / (6 * 2**0.5)!r}"  # of the regular tet with such edges
    _run("tetgen", f"-pqY{volume}Q", "surface.off", folder=folder)
    mesh = load(folder / "surface.1.ele")
    made = np.array(mesh.points)
    # It prints 16 digits, and keeps the order of the points that it got.
    close = 1e-13 * np.abs(points).max(initial=0)
    if len(made) >= len(points) and np.abs(made[: len(points)] - points).max() <= close:
        made[: len(points)] = points
    return made, mesh.tets


_MESHERS = {"gmsh": _by_gmsh, "tetgen": _by_tetgen}


def from_surface(surface: PathLike | tuple[ArrayLike, ArrayLike], mesher: str | None = None, *, size: float | None = None,
                 **options: Any) -> Result:
    """Fills a closed surface with tets, and improves them. The triangles stay as they are, bit for bit.

    surface  the name of an .stl file, or (points, triangles): (n, 3) real numbers, (k, 3) integers, numbered from 0
    mesher   "gmsh" or "tetgen", a program that is found in PATH; left out, the first of them that is installed
    size     how long edges inside may be; left out, the mesher decides

    All else is as for improve(). The programs have licences of their own, GPL and AGPL; they run as processes, in a folder that is gone
    afterwards. Raises Error where the surface is not closed, or the mesher is not installed, fails or changes the surface;
    FileNotFoundError.

    >>> corners = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    >>> from_surface((corners, [[0, 1, 2]]))
    Traceback (most recent call last):
    tetmend._core.Error: the surface is not closed: the edge of points 0 and 1 has 1 triangle, and 3 edges are like it
    """
    refuse_own(options, _OWN, "the surface")
    if mesher is not None and mesher not in _MESHERS:
        raise Error(f"mesher is {mesher!r}: expected one of {list(_MESHERS)}")
    if size is not None and not size > 0:
        raise Error(f"size is {size!r}, but a length is wanted")
    points, triangles = _surface_of(surface)
    _check_closed(triangles)
    installed = [name for name in ([mesher] if mesher else _MESHERS) if shutil.which(name)]
    if not installed:
        raise Error(f"mesher: {' and '.join([mesher] if mesher else _MESHERS)} {'is' if mesher else 'are'} not installed, or not in PATH")
    used, numbers = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], numbers.reshape(-1, 3)
    with tempfile.TemporaryDirectory(prefix="tetmend-") as folder:
        made, tets = _MESHERS[installed[0]]((points, triangles), None if size is None else float(size), Path(folder))
    _check_kept(installed[0], points, triangles, made, tets)
    return improve(made, tets, **options)


def _check_kept(mesher: str, points: NDArray[Any], triangles: NDArray[Any], made: NDArray[Any], tets: NDArray[Any]) -> None:
    """Each triangle is a face of the mesh, of the same coordinates."""
    faces = np.concatenate([tets[:, k] for k in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])])
    rows, counts = np.unique(np.sort(faces, axis=1), axis=0, return_counts=True)
    found = {tuple(sorted(map(tuple, face))) for face in made[rows[counts == 1]].tolist()}
    wanted = {tuple(sorted(map(tuple, face))) for face in points[triangles].tolist()}
    if found != wanted:
        raise Error(f"{mesher} did not keep the surface: {len(wanted - found)} of {len(wanted)} triangles are no face of its mesh")
