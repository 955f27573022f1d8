# SPDX-License-Identifier: MIT
"""Chains that people have: what one program made goes through tetmend and on to the next.

    chains_test.py TETMEND     status 77: none of the programs is here
"""

import contextlib
import importlib.util
import io
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

PROGRAM = sys.argv[1]
GEOMETRY = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.MeshSizeMin = 0.3;
Mesh.MeshSizeMax = 0.4;
Mesh.ElementOrder = %d;
Physical Volume("left") = {1};
Physical Volume("right") = {2};
Physical Surface("inlet") = {1};
Physical Surface("outlet") = {%s};
"""


def tetmend(*words) -> str:
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"tetmend {' '.join(map(str, words))}: {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


def has(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


def gmsh_mesh(folder: Path, ending: str, order: int = 1) -> Path:
    (folder / "box.geo").write_text(GEOMETRY % (order, "7"))
    out = folder / f"box.{ending}"
    subprocess.run(["gmsh", "-3", "-nopopup", folder / "box.geo", "-o", out], check=True, capture_output=True)
    return out


def improved(file: Path, ending: str = "") -> Path:
    """Improved, and found good by check where the format is the same."""
    out = file.with_name("better." + (ending or file.suffix[1:]))
    tetmend("improve", file, "-o", out, "-q")
    tetmend("check", file, out)
    return out


def volume(points, tets) -> float:
    a, b, c, d = (np.asarray(points)[np.asarray(tets)[:, k]] for k in range(4))
    return np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)).sum() / 6


def quietly(read, file):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return read(file)


# ---- the chains: each fails by an exception


def gmsh_to_calculix(folder: Path) -> None:
    """Gmsh -> .inp -> tetmend -> ccx, with sections by the sets of Gmsh."""
    deck = gmsh_mesh(folder, "inp")
    text = deck.read_text()
    sets = re.findall(r"\*ELSET,ELSET=(\w+)", text)
    volumes = [name for name in sets if name in ("left", "right")]
    if len(volumes) != 2:
        raise AssertionError(f"Gmsh wrote other sets: {sets}")
    better = improved(deck)
    rest = "*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n*DENSITY\n1.\n"
    rest += "".join(f"*SOLID SECTION, ELSET={name}, MATERIAL=M\n" for name in volumes)
    # Gmsh writes triangles as elements of plane stress: they go.
    text = better.read_text()
    text = re.sub(r"\*ELEMENT, *TYPE=(CPS3|T3D2).*?(?=\*)", "", text, flags=re.S | re.I)
    text = re.sub(r"\*ELSET, *ELSET=(inlet|outlet|Surface\w*|Line\w*).*?(?=\*|\Z)", "", text, flags=re.S | re.I)
    (folder / "run.inp").write_text(text + rest + "*STEP\n*NO ANALYSIS\n*END STEP\n")
    done = subprocess.run(["ccx", "run"], cwd=folder, capture_output=True, text=True)
    if "*ERROR" in done.stdout:
        raise AssertionError(done.stdout[done.stdout.index("*ERROR"):][:300])


def gmsh_to_meshio(folder: Path) -> None:
    """Gmsh -> .inp -> tetmend -> meshio: all sets."""
    import meshio
    mesh = quietly(meshio.read, improved(gmsh_mesh(folder, "inp")))
    tets = np.concatenate([block.data for block in mesh.cells if block.type == "tetra"])
    if abs(volume(mesh.points, tets) - 2) > 1e-9:
        raise AssertionError("the volume is another")


def med_round_trip(folder: Path) -> None:
    """MED as h5py reads it: groups before and after; written by meshio, as Salome users do."""
    import h5py
    source = folder / "part.med"
    tetmend("convert", gmsh_mesh(folder, "msh"), source)
    better = improved(source)

    def groups(file):
        names = set()
        with h5py.File(file) as tree:
            for kind in ("ELEME", "NOEUD"):
                for mesh in tree["FAS"].values():
                    for family in mesh.get(kind, {}).values():
                        if "GRO" in family:
                            names |= {bytes(row).rstrip(b"\0 ") for row in family["GRO"]["NOM"][()].astype(np.uint8)}
        return names

    if groups(source) != groups(better) or b"left" not in groups(better):
        raise AssertionError(f"groups {groups(source)} became {groups(better)}")


def meshio_med(folder: Path) -> None:
    """A MED file of meshio -> tetmend -> MED -> meshio."""
    import meshio
    mesh = quietly(meshio.read, gmsh_mesh(folder, "msh"))
    tets = np.concatenate([block.data for block in mesh.cells if block.type == "tetra"])
    meshio.write(folder / "plain.med", meshio.Mesh(mesh.points, [("tetra", tets)]))
    again = quietly(meshio.read, improved(folder / "plain.med"))
    if abs(volume(again.points, again.cells[0].data) - 2) > 1e-9:
        raise AssertionError("the volume is another")


def run(folder: Path, *words) -> str:
    done = subprocess.run(list(map(str, words)), cwd=folder, capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        raise AssertionError(f"{words[0]}: {done.returncode}: {done.stdout[-300:]}{done.stderr[-300:]}")
    return done.stdout


def med_by_its_library(folder: Path) -> None:
    """A file that MED's own library has written anew -> tetmend -> MED's program, which reads all of it."""
    tetmend("convert", gmsh_mesh(folder, "msh"), folder / "part.med")
    run(folder, "medimport", "part.med", "theirs.med")
    better = improved(folder / "theirs.med")
    told = run(folder, "mdump", "--structure", better, "NODALE", "FULL_INTERLACE", "1")
    count = int(re.search(r"MED_TETRA4 : (\d+)", told).group(1))
    if f"{count:,} tets" not in tetmend("convert", better, folder / "again.med") or "ERREUR" in told:
        raise AssertionError(f"MED's library reads {count} tets")
    conform = run(folder, "medconforme", better)
    if "non conforme" in conform:
        raise AssertionError(conform)


def cgns_by_its_library(folder: Path) -> None:
    """A file that CGNS's own library has written -> tetmend -> CGNS's programs: one checks it, one reads the mesh."""
    tetmend("convert", gmsh_mesh(folder, "msh"), folder / "part.cgns")
    run(folder, "cgnsconvert", "-a", "part.cgns", "theirs.adf")
    run(folder, "cgnsconvert", "-h", "theirs.adf", "theirs.cgns")
    better = improved(folder / "theirs.cgns")
    told = run(folder, "cgnscheck", better)
    if "ERROR" in told or not all(f'"{name}"' in told for name in ("left", "right", "inlet", "outlet")):
        raise AssertionError(told[-500:])
    (folder / "out").mkdir()
    run(folder, "cgns_to_vtk", "-a", better.name, "out")
    words = next((folder / "out").glob("*.vtk")).read_text().split()
    at = words.index("POINTS")
    points = np.array(words[at + 3:at + 3 + 3 * int(words[at + 1])], dtype=float).reshape(-1, 3)
    at, tets = words.index("CELLS"), []
    cells, at = int(words[at + 1]), at + 3
    for _ in range(cells):
        width = int(words[at])
        if width == 4:
            tets.append([int(word) for word in words[at + 1:at + 5]])
        at += 1 + width
    if abs(volume(points, tets) - 2) > 1e-6:  # it writes single precision
        raise AssertionError("the volume is another")


def unv_of_gmsh(folder: Path) -> None:
    """Gmsh -> .unv with groups -> tetmend -> Gmsh: the volumes of the groups by their names."""
    import gmsh
    better = improved(gmsh_mesh(folder, "unv"))
    gmsh.initialize(["-noenv", "-v", "0"])
    try:
        gmsh.open(str(better))
        found = {}
        for dimension, tag in gmsh.model.getPhysicalGroups():
            found[gmsh.model.getPhysicalName(dimension, tag)] = dimension
        numbers, places, _ = gmsh.model.mesh.getNodes()
        row = dict(zip(numbers, range(len(numbers))))
        _, nodes = gmsh.model.mesh.getElementsByType(4)
        tets = np.array([row[node] for node in nodes]).reshape(-1, 4)
        if abs(volume(places.reshape(-1, 3), tets) - 2) > 1e-9:
            raise AssertionError("the volume is another")
    finally:
        gmsh.finalize()
    if found != {"left": 3, "right": 3, "inlet": 2, "outlet": 2}:
        raise AssertionError(f"groups {found}")


def keys_of_gmsh(folder: Path) -> None:
    """Gmsh's .key for LS-DYNA -> tetmend -> .key, of which all but nodes and solids is as Gmsh wrote it."""
    for order in (1, 2):
        source = gmsh_mesh(folder, "key", order)
        better = improved(source)

        def rest(file):
            parts = re.split(r"^(?=\*)", file.read_text(), flags=re.M)
            return [part for part in parts if not re.match(r"\*(NODE|ELEMENT_SOLID)\b", part)]

        if rest(source) != rest(better) or len(rest(better)) < 4:
            raise AssertionError("what is no mesh is another")
        tetmend("convert", better, folder / "read.msh", "--variant", "2.2 ASCII")
        counted = run(folder, "gmsh", "-nopopup", "-", "read.msh")
        if "Error" in counted:
            raise AssertionError(counted)


def paraview_to_mfem(folder: Path) -> None:
    """A .vtu of VTK's writer, regions and all -> tetmend -> MFEM, which PyMFEM reads where it is."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
    import meshio
    mesh = quietly(meshio.read, gmsh_mesh(folder, "msh"))
    blocks = [(i, block.data) for i, block in enumerate(mesh.cells) if block.type == "tetra"]
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    for point in mesh.points:
        points.InsertNextPoint(*point)
    grid.SetPoints(points)
    labels = []
    for i, tets in blocks:
        labels += mesh.cell_data["gmsh:physical"][i].tolist()
        for tet in tets:
            grid.InsertNextCell(10, 4, [int(v) for v in tet])
    array = numpy_to_vtk(np.array(labels, dtype=np.int32), deep=True)
    array.SetName("attribute")
    grid.GetCellData().AddArray(array)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(folder / "grid.vtu"))
    writer.SetInputData(grid)
    writer.Write()
    better = improved(folder / "grid.vtu", "mfem")
    words = iter(better.read_text().split("elements")[1].split())
    found = [[int(next(words)) for _ in range(6)][0] for _ in range(int(next(words)))]
    if sorted(set(found)) != sorted(set(labels)):
        raise AssertionError(f"attributes {set(labels)} became {set(found)}")
    if has("mfem"):
        from mfem.ser import Mesh
        if Mesh(str(better), 1, 0).GetNE() != len(found):
            raise AssertionError("MFEM reads another number of elements")


def fenics(folder: Path) -> None:
    """DOLFINx writes a mesh with tags -> tetmend -> DOLFINx: volumes by tag and areas by tag stay."""
    from dolfinx import fem
    from dolfinx.io import XDMFFile, gmshio
    from mpi4py import MPI
    import gmsh
    import ufl
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    gmsh.open(str(gmsh_mesh(folder, "msh")))
    mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0)
    gmsh.finalize()
    cells.name, facets.name = "parts", "walls"
    mesh.name = "mesh"
    with XDMFFile(MPI.COMM_WORLD, str(folder / "case.xdmf"), "w") as xdmf:
        xdmf.write_mesh(mesh)
        xdmf.write_meshtags(cells)
        mesh.topology.create_connectivity(2, 3)
        xdmf.write_meshtags(facets)
    better = improved(folder / "case.xdmf")
    with XDMFFile(MPI.COMM_WORLD, str(better), "r") as xdmf:
        after = xdmf.read_mesh(name="mesh")
        parts = xdmf.read_meshtags(after, name="parts")
        after.topology.create_connectivity(2, 3)
        walls = xdmf.read_meshtags(after, name="walls")

    def measures(of, tags, measure):
        integral = measure(domain=of, subdomain_data=tags)
        return {int(tag): fem.assemble_scalar(fem.form(fem.Constant(of, 1.0) * integral(int(tag))))
                for tag in np.unique(tags.values)}

    for name, before, now, measure in (("parts", cells, parts, ufl.dx), ("walls", facets, walls, ufl.ds)):
        old, new = measures(mesh, before, measure), measures(after, now, measure)
        if sorted(old) != sorted(new) or any(abs(old[tag] - new[tag]) > 1e-9 for tag in old):
            raise AssertionError(f"{name}: {old} became {new}")


def svfsi(folder: Path) -> None:
    """A volume with GlobalNodeID and GlobalElementID, and a face file that refers to both: its points
    are found in the improved volume by their numbers, at the same places."""
    import meshio
    mesh = quietly(meshio.read, gmsh_mesh(folder, "msh"))
    tets = np.concatenate([block.data for block in mesh.cells if block.type == "tetra"]).astype(np.int64)
    inlet = np.unique(np.concatenate([block.data for block in mesh.cells if block.type == "triangle"]))
    nodes = np.arange(1, len(mesh.points) + 1, dtype=np.int64)
    elements = np.arange(1, len(tets) + 1, dtype=np.int64)
    meshio.write(folder / "mesh-complete.vtu", meshio.Mesh(
        mesh.points, [("tetra", tets)], {"GlobalNodeID": nodes}, {"GlobalElementID": [elements]}))
    places = {int(nodes[v]): tuple(mesh.points[v]) for v in inlet}  # what the face files hold
    out = folder / "better.vtu"
    told = subprocess.run([PROGRAM, "improve", folder / "mesh-complete.vtu", "-o", out], capture_output=True, text=True)
    if told.returncode != 0:
        raise AssertionError(told.stdout + told.stderr)
    after = quietly(meshio.read, out)
    found = {int(number): tuple(point) for number, point in
             zip(np.ravel(after.point_data["GlobalNodeID"]), after.points)}
    if len(found) != len(after.points):
        raise AssertionError("a node number stands twice")
    if any(found.get(number) != place for number, place in places.items()):
        raise AssertionError("a point of the face files has another number or place")
    numbers = np.ravel(np.concatenate(after.cell_data["GlobalElementID"]))
    if len(np.unique(numbers)) != len(numbers):
        raise AssertionError("an element number stands twice")
    if "GlobalElementID" not in told.stdout + told.stderr:
        raise AssertionError("no word on files that refer to numbers that are gone")


def exodus_of_vtk(folder: Path) -> None:
    """Exodus of netCDF-4, as meshio and MOOSE write it -> tetmend -> Exodus -> VTK."""
    import meshio
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
    mesh = quietly(meshio.read, gmsh_mesh(folder, "msh"))
    tets = np.concatenate([block.data for block in mesh.cells if block.type == "tetra"])
    meshio.write(folder / "part.e", meshio.Mesh(mesh.points, [("tetra", tets)],
                                               point_data={"T": mesh.points[:, 0]}))
    better = improved(folder / "part.e")
    reader = vtkExodusIIReader()
    reader.SetFileName(str(better))
    reader.UpdateInformation()
    reader.SetAllArrayStatus(reader.NODAL, 1)
    reader.Update()
    grid = reader.GetOutput().GetBlock(0).GetBlock(0)
    values = grid.GetPointData().GetArray("T")
    if any(abs(values.GetValue(i) - grid.GetPoint(i)[0]) > 1e-6 for i in range(grid.GetNumberOfPoints())):
        raise AssertionError("a linear field did not stay exact")


CHAINS = [
    (gmsh_to_calculix, lambda: shutil.which("gmsh") and shutil.which("ccx")),
    (gmsh_to_meshio, lambda: shutil.which("gmsh") and has("meshio")),
    (med_round_trip, lambda: shutil.which("gmsh") and has("h5py")),
    (meshio_med, lambda: shutil.which("gmsh") and has("meshio") and has("h5py")),
    (med_by_its_library, lambda: all(map(shutil.which, ("gmsh", "medimport", "mdump", "medconforme")))),
    (cgns_by_its_library, lambda: all(map(shutil.which, ("gmsh", "cgnsconvert", "cgnscheck", "cgns_to_vtk")))),
    (unv_of_gmsh, lambda: shutil.which("gmsh") and has("gmsh")),
    (keys_of_gmsh, lambda: shutil.which("gmsh")),
    (paraview_to_mfem, lambda: shutil.which("gmsh") and has("meshio") and has("vtkmodules")),
    (fenics, lambda: shutil.which("gmsh") and has("dolfinx") and has("gmsh")),
    (svfsi, lambda: shutil.which("gmsh") and has("meshio")),
    (exodus_of_vtk, lambda: shutil.which("gmsh") and has("meshio") and has("netCDF4") and has("vtkmodules")),
]
OF_HDF5 = {med_round_trip, meshio_med, med_by_its_library, cgns_by_its_library, fenics, exodus_of_vtk}


def main() -> int:
    has_hdf5 = " .med" in tetmend("convert", "--help")
    ran, wrong, missing = [], [], []
    for chain, is_here in CHAINS:
        if not is_here() or (chain in OF_HDF5 and not has_hdf5):
            missing.append(chain.__name__)
            continue
        with tempfile.TemporaryDirectory() as folder:
            try:
                chain(Path(folder))
            except BaseException as error:  # meshio ends the program in some places
                wrong.append(f"{chain.__name__}: {type(error).__name__}: {error}")
        ran.append(chain.__name__)
    print("ran:", ", ".join(ran) or "none", "| their programs are missing:", ", ".join(missing) or "none")
    print("\n".join(wrong) or "all chains hold")
    return 1 if wrong else 0 if ran else 77


if __name__ == "__main__":
    sys.exit(main())
