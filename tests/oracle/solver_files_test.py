# SPDX-License-Identifier: MIT
"""Files of Gmsh (SU2, Nastran) and Netgen go through `tetmend convert`, and they find what they wrote.

    solver_files_test.py SOURCE TETMEND FORMAT

FORMAT is su2, bdf or vol. Exit status 77: the module of the program is not there.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
MODULES = {"su2": "gmsh", "bdf": "gmsh", "vol": "netgen"}


def start_with(module: str) -> None:
    """Goes on in the Python that has the module."""
    sys.path.insert(0, str(Path(sys.argv[1]) / "bench"))
    import competitors
    python = competitors.module(module)
    if python is None:
        print(f"skipped: install the package python3-{module}")
        sys.exit(SKIPPED)
    if os.environ.get("TETMEND_TEST_SOLVER") is None:  # not started again yet
        os.environ["TETMEND_TEST_SOLVER"] = "1"
        sys.stdout.flush()
        os.execv(python, [str(python), "-B", *sys.argv])


def convert(source: Path, target: Path) -> None:
    subprocess.run([sys.argv[2], "convert", source, target], check=True, stdout=subprocess.DEVNULL)


def write_with_gmsh(gmsh, folder: Path, extension: str) -> list[Path]:
    """Two glued boxes, of first and second order, in each form of fields."""
    geometry = gmsh.model.occ
    left, right = geometry.addBox(0, 0, 0, 1, 1, 1), geometry.addBox(1, 0, 0, 1, 1, 1)
    geometry.fragment([(3, left)], [(3, right)])
    geometry.synchronize()
    for dimension, entities, number, name in ((3, [left], 10, "left"), (3, [right], 20, "right"),
                                              (2, [1], 30, "inlet"), (2, [8], 40, "outlet")):
        gmsh.model.addPhysicalGroup(dimension, entities, number)
        gmsh.model.setPhysicalName(dimension, number, name)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.4)
    gmsh.option.setNumber("Mesh.RandomFactor", 1e-3)
    gmsh.model.mesh.generate(3)
    files = []
    for order in (1, 2):
        gmsh.model.mesh.setOrder(order)
        for form in (0, 1, 2) if extension == "bdf" else (0,):
            gmsh.option.setNumber("Mesh.BdfFieldFormat", form)
            files.append(folder / f"boxes-{order}-{form}.{extension}")
            gmsh.write(str(files[-1]))
    return files


def rows_of_su2(file: Path) -> dict:
    """The rows under each keyword or marker, as numbers."""
    content: dict = {}
    section = ""
    for line in file.read_text().splitlines():
        if "=" not in line:
            content[section].append([float(word) for word in line.split()])
        elif "MARKER_ELEMS" not in line:
            section = line
            content[section] = []
    return content


def elements_of_gmsh(gmsh, file: Path) -> dict:
    gmsh.model.add(file.name)
    gmsh.merge(str(file))
    tags, places, _ = gmsh.model.mesh.getNodes()
    content = {"points": {int(tag): tuple(places[3 * i:3 * i + 3]) for i, tag in enumerate(tags)}}
    for dimension, tag in gmsh.model.getEntities():
        for kind, numbers, nodes in zip(*gmsh.model.mesh.getElements(dimension, tag)):
            content[dimension, tag, int(kind)] = ([int(n) for n in numbers], [int(n) for n in nodes])
    return content


def check_gmsh(folder: Path, extension: str) -> list[str]:
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Verbosity", 1)
    gmsh.model.add("boxes")
    wrong = []
    for file in write_with_gmsh(gmsh, folder, extension):
        converted, again = file.with_suffix(f".1.{extension}"), file.with_suffix(f".2.{extension}")
        convert(file, converted)
        convert(converted, again)
        if converted.read_bytes() != again.read_bytes():
            wrong.append(f"{file.name}: the second conversion has other bytes")
        if extension == "su2":
            same = rows_of_su2(file) == rows_of_su2(converted)
        elif file.name == "boxes-2-2.bdf":
            # Gmsh does not read its own continued cards beside large fields: see the small ones.
            same = elements_of_gmsh(gmsh, converted).keys() == elements_of_gmsh(
                gmsh, folder / "boxes-2-1.bdf").keys()
        else:
            same = elements_of_gmsh(gmsh, file) == elements_of_gmsh(gmsh, converted)
        if not same:
            wrong.append(f"{file.name}: Gmsh finds something else")
    gmsh.finalize()
    return wrong


def check_netgen(folder: Path) -> list[str]:
    from netgen.csg import CSGeometry, OrthoBrick, Pnt, Sphere
    from netgen.meshing import Mesh, SetMessageImportance
    SetMessageImportance(0)
    geometry = CSGeometry()
    box = OrthoBrick(Pnt(0, 0, 0), Pnt(1, 1, 1)).mat("steel").bc("outer")
    ball = Sphere(Pnt(0.5, 0.5, 0.5), 0.3).mat("copper").bc("ball")
    geometry.Add(box - ball)
    geometry.Add(ball)
    mesh = geometry.GenerateMesh(maxh=0.5)
    mesh.SetCD2Name(1, "rim")
    wrong = []
    for order in (1, 2):
        if order == 2:
            mesh.SecondOrder()
        file = folder / f"ball-{order}.vol"
        mesh.Save(str(file))
        converted, improved = file.with_suffix(".1.vol"), file.with_suffix(".2.vol")
        convert(file, converted)
        saved = []
        for each in (file, converted):
            loaded = Mesh(3)
            loaded.Load(str(each))
            target = each.with_suffix(".saved.vol")
            loaded.Save(str(target))
            saved.append(sorted(target.read_text().split("\n")))
        if saved[0] != saved[1]:
            wrong.append(f"{file.name}: Netgen finds something else")
        if order == 1:
            subprocess.run([sys.argv[2], "improve", file, "-o", improved, "--quiet"], check=True)
            loaded = Mesh(3)
            loaded.Load(str(improved))
            loaded.Save(str(improved.with_suffix(".saved.vol")))
            text = improved.with_suffix(".saved.vol").read_text()
            before = file.with_suffix(".saved.vol").read_text()
            # Surfaces keep the numbers of their points, for these come first.
            if text.split("volumeelements")[0] != before.split("volumeelements")[0]:
                wrong.append("improved: Netgen finds other surfaces")
            if text.split("volumeelements")[1] == before.split("volumeelements")[1]:
                wrong.append("nothing was improved")
            for name in ("1 steel", "2 copper", "ball", "rim", "csgsurfaces"):
                if name not in text:
                    wrong.append(f"improved: {name} is missing")
    return wrong


def main() -> int:
    extension = sys.argv[3]
    start_with(MODULES[extension])
    with tempfile.TemporaryDirectory() as folder:
        wrong = (check_netgen(Path(folder)) if extension == "vol"
                 else check_gmsh(Path(folder), extension))
    print("\n".join(wrong) or f"{extension}: the same", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    os._exit(status)  # Netgen may abort when its module is unloaded
