#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes inputs of cases_test.cpp as other programs write them: the box of make.py in the keywords, cards and
orders of Abaqus/CAE, HyperMesh, PrePoMax, FreeCAD, NX, Femap, ANSA, Patran, Gmsh, ParaView.
Usage: make_writers.py, in this folder."""
import itertools
import math
import struct

from make import box, msh2, halves, second_order, squeezed, vtu, write

POINTS, TETS = box()
NODES, CURVED = second_order(POINTS, TETS)
FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # S1 to S4 of Abaqus


def sides(axis, place):
    """{number, face} of the tets that have a face there."""
    found = []
    for (i, tet), (k, face) in itertools.product(enumerate(TETS, 1), enumerate(FACES, 1)):
        if all(POINTS[tet[v]][axis] == place for v in face):
            found.append((i, k))
    return found


def nodes(points=POINTS, text="{:>7d}, {:>12.9g}, {:>12.9g}, {:>12.9g}"):
    return [text.format(i, *p) for i, p in enumerate(points, 1)]


def elements(tets=TETS, first=1):
    return [f"{i}, " + ", ".join(str(v + 1) for v in tet) for i, tet in enumerate(tets, first)]


def rows(numbers, width=16):
    return [", ".join(f"{n:>3}" for n in numbers[i:i + width]) for i in range(0, len(numbers), width)]


def mesh_of_part(name, first=1, more=()):
    return [f"*Part, name={name}", "*Node", *nodes(), "*Element, type=C3D4", *elements(first=first),
            "*Nset, nset=Set-1, generate", "  1,  27,   1", "*Elset, elset=Set-1, generate", f"  {first}, {first + 47},  1",
            "** Section: Section-1", "*Solid Section, elset=Set-1, material=M", ",", *more, "*End Part"]


def abaqus_cae():
    top = sides(2, 2)
    bottom = [i for i, p in enumerate(POINTS, 1) if p[2] == 0]
    side_sets = [line for k in sorted({k for _, k in top}) for line in
                 (f"*Elset, elset=_Top_S{k}, internal, instance=Part-1-1", *rows([i for i, s in top if s == k]))]
    write("cae-coupling.inp", [
        "*Heading", "** Job name: Job-1 Model name: Model-1", "*Preprint, echo=NO, model=NO", "**", "** PARTS", "**",
        "*Part, name=Part-1", "*End Part", "**", "** ASSEMBLY", "**", "*Assembly, name=Assembly", "**",
        "*Instance, name=Part-1-1, part=Part-1", "*Node", *nodes(), "*Element, type=C3D4", *elements(),
        "*Nset, nset=Set-1, generate", "  1,  27,   1", "*Elset, elset=Set-1, generate", "  1,  48,   1",
        "*Solid Section, elset=Set-1, material=M", ",", "*End Instance", "**", "*Node", "      1, 1., 1., 5.",
        "*Nset, nset=_PickedSet5, internal", " 1,", "*Nset, nset=fix, instance=Part-1-1", *rows(bottom), *side_sets,
        "*Surface, type=ELEMENT, name=Top", *[f"_Top_S{k}, S{k}" for k in sorted({k for _, k in top})],
        "** Constraint: Constraint-1", "*Coupling, constraint name=Constraint-1, ref node=_PickedSet5, surface=Top",
        "*Kinematic", "*End Assembly", "*Material, name=M", "*Elastic", "210000., 0.3", "*Step, name=Step-1, nlgeom=NO",
        "*Static", "1., 1., 1e-05, 1.", "*Boundary", "fix, ENCASTRE", "*Cload", "_PickedSet5, 3, -1.", "*Dsload",
        "Top, P, 3.", "*Output, field, variable=PRESELECT", "*End Step"])
    write("cae-same-names.inp", [
        "*Heading", *mesh_of_part("P1", more=["*Elset, elset=_PickedSet2, internal", " 1,  2"]),
        *mesh_of_part("\"P 2\"", 201, ["*Elset, elset=_PickedSet2, internal", " 203,  204", "*Surface, name=Surf-1", "_PickedSet2, S1"]),
        "*Assembly, name=A", "*Instance, name=P1-1, part=P1", "*End Instance", "*Instance, name=\"P 2-1\", part=\"P 2\"",
        "7., 0., 0.", "7., 0., 0., 7., 0., 1., 90.", "*End Instance", "*Nset, nset=Set-1, instance=\"P 2-1\"", " 1,  3",
        "*Elset, elset=All", "P1-1.Set-1, \"P 2-1\".Set-1", "*Tie, name=T, adjust=yes", "\"P 2-1\".Surf-1, P1-1.Set-1",
        "*End Assembly", "*Material, name=M", "*Elastic", "1., .3", "*Step", "*Static", "*Boundary", "Set-1, 1, 3",
        "\"P 2-1\".27, 1", "*Dload", "All, GRAV, 1., 0., 0., -1.", "*End Step"])
    write("cae-other-elements.inp", [
        "*Part, name=solid", "*Node", *nodes(), "*Element, type=C3D4, elset=solid", *elements(),
        "*Element, type=MASS, elset=m", "101, 1", "*Mass, elset=m", "1.,", "*Element, type=SPRINGA, elset=sp", "301, 1, 27",
        "*Spring, elset=sp", "", "10.", "*Solid Section, elset=solid, material=M", ",", "*End Part",
        "*Part, name=beam", "*Node", "1, 0., 0., 0.", "2, 1., 0., 0.", "*Element, type=B31, elset=b", "1, 1, 2",
        "*Beam Section, elset=b, material=M, section=CIRC", "0.1", "0.,0.,-1.", "*End Part", "*Part, name=rigid", "*End Part",
        "*Assembly, name=Assembly", "*Instance, name=solid-1, part=solid", " 0., 0., 1.", "*End Instance",
        "*Instance, name=beam-1, part=beam", "*End Instance", "*Instance, name=rigid-1, part=rigid", "*Node", "1, 3., 3., 3.",
        "*Nset, nset=RefPt_, internal", "1,", "*Surface, type=REVOLUTION, name=rs, internal", "START, 0.,0.", "LINE, 1., 0.",
        "*Rigid Body, ref node=RefPt_, analytical surface=rs", "*End Instance", "*Element, type=CONN3D2, elset=_Conn",
        "1, solid-1.13, beam-1.1", "*Connector Section, elset=_Conn", "Beam,", "*MPC", "BEAM, solid-1.27, beam-1.2",
        "*End Assembly", "*Material, name=M", "*Elastic", "1., .3"])


def other_decks():
    top = sides(2, 2)
    bottom = [i for i, p in enumerate(POINTS, 1) if p[2] == 0]
    write("hypermesh.inp", [
        "**", " ** ABAQUS Input Deck Generated by HyperMesh", "**   Template:  ABAQUS/STANDARD 3D", "*NODE", *nodes(),
        "**HWCOLOR COMP          1    11", "*ELEMENT,TYPE=C3D4,ELSET=solid_1", *elements(), "*NSET, NSET=supp",
        *[f"{i}," for i in bottom], "*SURFACE, NAME = press, TYPE = ELEMENT", *[f"{i:>10},     S{k}" for i, k in top],
        "*SOLID SECTION, ELSET=solid_1, MATERIAL=mat1", "*MATERIAL, NAME=mat1", "*ELASTIC, TYPE = ISOTROPIC",
        "210000.0  ,0.3       ,0.0", "**HMNAME LOADSTEP       1 load", "*STEP, INC =       100, PERTURBATION", "*STATIC",
        "*BOUNDARY", "supp, 1,3,0.0", "*DSLOAD", "press, P, 1.0", "*NODE FILE, NSET=supp", "RF,", "*END STEP"])
    write("prepomax.inp", [
        "** Heading +++++++++++", "*Heading", "Hash: abcDEF12, Date: 01/01/2024, Unit system: MM_TON_S_C", "*Node",
        *nodes(NODES, "{}, {:.8E}, {:.8E}, {:.8E}"), "*Element, Type=C3D10, Elset=Solid_part-1", *elements(CURVED),
        "*Nset, Nset=Internal_Selection-1_Fixed-1", *rows(bottom), "*Elset, Elset=Section-1-All", "Solid_part-1",
        "*Surface, Name=Surf, Type=Element", *[f"{i}, S{k}" for i, k in top], "*Material, Name=S235", "*Elastic",
        "210000, 0.28", "*Solid section, Elset=Section-1-All, Material=S235", "*Step", "*Static, Solver=Pardiso", "*Boundary",
        "Internal_Selection-1_Fixed-1, 1, 1, 0", "*Output, Frequency=1", "*El file", "S, E, NOE", "*End step"])
    write("freecad.inp", [
        "** written by FreeCAD inp file writer for CalculiX,Abaqus meshes", "** Nodes", "*Node, NSET=Nall",
        *nodes(NODES, "{}, {:.17g}, {:.17g}, {:.17g}"), "** Volume elements", "*Element, TYPE=C3D10, ELSET=Evolumes",
        *elements(CURVED, 201), "*ELSET, ELSET=Eall", "Evolumes", "*ELSET,ELSET=MaterialSolidSolid", "Evolumes",
        "*NSET,NSET=ConstraintFixed", *[f"{i}," for i in bottom], "*MATERIAL, NAME=MechanicalMaterial", "*ELASTIC",
        "210000,0.3,", "*SOLID SECTION, ELSET=MaterialSolidSolid, MATERIAL=MechanicalMaterial", "*STEP", "*STATIC", "*BOUNDARY",
        "ConstraintFixed,1", "*CLOAD", "** node loads on shape: Box:Face2", "27,3,-1.5", "*DLOAD",
        *[f"{200 + i},P{k},10.0" for i, k in top], "*EL FILE", "S, E", "*END STEP"])
    write("gmsh.inp", [
        "*Heading", " box.inp", "*NODE", *nodes(text="{}, {:.16g}, {:.16g}, {:.16g}"),
        "******* E L E M E N T S *************", "*ELEMENT, type=T3D2, ELSET=Line1", "1, 1, 2", "2, 2, 3",
        "*ELEMENT, type=CPS3, ELSET=Surface1", "3, 1, 2, 5", "4, 1, 5, 4", "*ELEMENT, type=C3D4, ELSET=Volume1",
        *elements(first=5), "*ELSET,ELSET=wall", "3, 4, ", "*ELSET,ELSET=solid", *[row + ", " for row in rows(range(5, 53), 10)],
        "*NSET,NSET=wall", "1, 2, 4, 5, "])


def fixed(words, width=8):
    return "".join(f"{word:>{width}}" for word in words)


def femap(x):
    if x == 0:
        return "0."
    mantissa, exponent = f"{x:.4E}".split("E")
    return mantissa.rstrip("0") + (f"{int(exponent):+d}" if int(exponent) else "")


def nastran():
    plain = [f"GRID    {i:>8}        " + fixed(f"{x:.4f}" for x in p) for i, p in enumerate(POINTS, 1)]
    tets = ["CTETRA  " + fixed([i, 1] + [v + 1 for v in tet]) for i, tet in enumerate(TETS, 1)]
    large = [f"GRID*   {i:>16}{0:>16}{p[0]:>16.9E}{p[1]:>16.9E}+\n*       {p[2]:>16.9E}{0:>16}" for i, p in enumerate(NODES, 1)]
    curved = lambda mark: [f"CTETRA  {fixed([i, 1] + [v + 1 for v in tet[:6]])}{mark(i)}\n{mark(i):<8}{fixed(v + 1 for v in tet[6:])}"
                           for i, tet in enumerate(CURVED, 1)]
    write("simcenter.bdf", [
        "$*", "$*  SIMCENTER NASTRAN DECK", "NASTRAN SYSTEM(442)=-1,SYSTEM(319)=1", "ID,NASTRAN,sim1", "SOL 101", "CEND",
        "TITLE = GRID 14 test", "SET 1 = 1 THRU 14,", "  20", "SUBCASE 1", "  SPC = 1", "BEGIN BULK", "$* $$$$ MODEL DATA",
        "PARAM   AUTOSPC YES", *large, *curved(lambda i: "+"), "PSOLID         1       1       0",
        "MAT1           1210000.            .3", "SPC1           1  123456       1    THRU       9", "ENDDATA 3f2a"])
    write("femap.bdf", [
        "$ Generated by FEMAP", "INIT MASTER(S)", "ID tet,Femap", "SOL SESTATIC", "CEND", "BEGIN BULK",
        "CORD2C         1       0      0.      0.      0.      0.      0.      1.+FEMAPC1", "+FEMAPC1      1.      0.      1.",
        "PSOLID         1       1       0", "MAT1           1 2.1+11              .3   7850. 1.2-5",
        *[f"GRID    {i:>8}{0:>8}" + fixed(femap(x) for x in p) + f"{0:>8}" for i, p in enumerate(NODES, 1)],
        *curved(lambda i: f"+EL{i:>5}"), "ENDDATA"])
    write("ansa.bdf", [
        "$ANSA_VERSION;19", "BEGIN BULK",
        *[f"GRID*   {i:>16}{'':16}{p[0]:>16.10f}{p[1]:>16.10f}*N{i:<6}\n*N{i:<6}{p[2]:>16.10f}" for i, p in enumerate(POINTS, 1)],
        *[f"CTETRA* {fixed([i, 1, t[0] + 1, t[1] + 1], 16)}\n*       {fixed([t[2] + 1, t[3] + 1], 16)}" for i, t in enumerate(TETS, 1)],
        "$ANSA_NAME_COMMENT;1;PSOLID;steel;", "PSOLID  1       1", "ENDDATA"])
    write("lower-case.bdf", [
        "cend", "begin bulk", *[f"grid,{i},,{p[0]},{p[1]},{p[2]} $ point {i}" for i, p in enumerate(NODES, 1)],
        *[f"ctetra,{i},1," + ",".join(str(v + 1) for v in t[:6]) + ",\n+," + ",".join(str(v + 1) for v in t[6:])
          for i, t in enumerate(CURVED, 1)], "psolid,1,1", "mat1,1,2.1e5,,.3", "enddata"])
    write("constrained-by-default.bdf", [
        "BEGIN BULK", "GRDSET                 7                              345",
        "CORD2R         7              0.      0.      1.      0.      0.      2.", "              1.      0.      1.",
        *plain, *tets, "PSOLID         1       1", "ENDDATA"])

    def cylinder(p):
        return math.hypot(p[0], p[1]), math.degrees(math.atan2(p[1], p[0])), p[2]

    def sphere(p):
        r = math.hypot(*p)
        return r, math.degrees(math.acos(p[2] / r)) if r else 0, math.degrees(math.atan2(p[1], p[0]))

    ways = ((3, tuple), (4, cylinder), (6, sphere))
    write("systems-of-systems.bdf", [
        "BEGIN BULK", "GRID,901,,5.,5.,5.", "GRID,902,,5.,5.,6.", "GRID,903,,6.,5.,5.", "CORD1R,3,901,902,903",
        "CORD2C,4,3,0.,0.,0.,0.,0.,1.", "+,1.,0.,0.", "CORD2S,6,4,0.,0.,0.,0.,0.,1.", ",1.,0.,0.",
        *[f"GRID,{i},{ways[i % 3][0]}," + ",".join(f"{x:.9f}" for x in ways[i % 3][1](p)) for i, p in enumerate(POINTS, 1)],
        *[f"CTETRA,{i},1," + ",".join(str(v + 1) for v in t) for i, t in enumerate(TETS, 1)], "PSOLID,1,1", "ENDDATA"])


def gmsh():
    msh2("with-parameters.msh", POINTS, [(2, 1, (0, 1, 4))] + [(4, 1, t) for t in TETS])
    with open("with-parameters.msh", encoding="ascii") as file:
        lines = file.read().split("\n")
    more = ("0 7", "1 3 0.25", "2 5 0.25 0.5", "3 1")
    first = lines.index("$Nodes") + 2
    for i in range(len(POINTS)):
        lines[first + i] += " " + more[i % 4]
    write("with-parameters.msh", [line.replace("Nodes", "ParametricNodes") for line in lines[:-1]])
    pack = lambda kind, *values: struct.pack("<" + kind * len(values), *values)
    text = b"$MeshFormat\n4.1 1 4\n" + pack("i", 1) + b"\n$EndMeshFormat\n$Nodes\n" + pack("I", 1, 27, 1, 27) + pack("i", 3, 1, 0)
    text += pack("I", 27, *range(1, 28)) + b"".join(pack("d", *p) for p in POINTS) + b"\n$EndNodes\n$Elements\n"
    text += pack("I", 1, 48, 1, 48) + pack("i", 3, 1, 4) + pack("I", 48)
    text += b"".join(pack("I", i, *(v + 1 for v in t)) for i, t in enumerate(TETS, 1)) + b"\n$EndElements\n"
    with open("four-bytes.msh", "wb") as file:
        file.write(text)


def arrays():
    points, tets = squeezed()
    n, t = len(points), len(tets)
    shuffled = [(37 * i) % t for i in range(t)]
    vtu("ids-in-any-order.vtu", points, tets, [("GlobalElementID", "Int32", [3 * i + 100 for i in shuffled])],
        [("GlobalNodeID", "Int64", range(n - 1, -1, -1))])
    vtu("ids-of-paraview.vtu", points, tets, [("vtkOriginalCellIds", "Int64", range(t))], [("vtkOriginalPointIds", "Int64", range(n))])
    vtu("ids-beyond-32-bits.vtu", points, tets, [("ElementId", "Int64", range(2 ** 40, 2 ** 40 + t))])
    vtu("ids-without-a-name-for-them.vtu", points, tets, [("cells", "UInt32", range(1, t + 1))])
    x, y, z = (halves(POINTS, TETS, axis) for axis in range(3))
    vtu("three-arrays.vtu", POINTS, TETS, [("a", "Int32", x), ("b", "Float64", [float(v) for v in y]), ("c", "UInt8", z)])
    vtu("labels-of-faces-too.vtu", POINTS, TETS + [(0, 1, 4), (0, 4, 3)],
        [("attribute", "Int32", x + [11, 12]), ("ElementBlockIds", "Int32", y + [0, 0])])
    vtu("negative-labels.vtu", POINTS, TETS, [("attribute", "Int32", [-v for v in x])])
    vtu("single-precision-labels.vtu", POINTS, TETS, [("regionId", "Float32", [float(v) for v in x]), ("rank", "Int32", y)])


if __name__ == "__main__":
    abaqus_cae()
    other_decks()
    nastran()
    gmsh()
    arrays()
