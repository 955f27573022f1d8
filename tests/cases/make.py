#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the inputs of cases_test.cpp whose rows say "made": small boxes of 48 tets, each with one
thing that people's files have. Usage: make.py, in this folder."""
import itertools
import math


def box(n=2, inner=(1.31, 1.27, 0.78), at=(0, 0, 0), size=2.0):
    """Points and tets of n x n x n cubes of six tets each. For n = 2 point 14, from 1, is inside."""
    step = size / n
    points = [tuple(at[k] + step * v[k] for k in range(3)) for v in itertools.product(range(n + 1), repeat=3)]
    number = lambda i, j, k: (i * (n + 1) + j) * (n + 1) + k
    tets = []
    for corner in itertools.product(range(n), repeat=3):
        for order in itertools.permutations(range(3)):
            path, at_ = [number(*corner)], list(corner)
            for axis in order:
                at_[axis] += 1
                path.append(number(*at_))
            odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
            tets.append(tuple(path[i] for i in ((0, 2, 1, 3) if odd else (0, 1, 2, 3))))
    if inner is not None and n == 2:
        points[13] = tuple(at[k] + inner[k] * size / 2 for k in range(3))
    return points, tets


def join(*parts):
    points, tets, labels = [], [], []
    for label, (more_points, more_tets) in enumerate(parts, 1):
        tets += [tuple(v + len(points) for v in tet) for tet in more_tets]
        labels += [label] * len(more_tets)
        points += more_points
    return points, tets, labels


def mirrored(tet):
    return (tet[1], tet[0], *tet[2:])


def ascending(tets):
    return [tuple(sorted(tet)) for tet in tets]


def write(name, lines):
    with open(name, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def row(values):
    return " ".join(f"{v:.10g}" for v in values)


def mesh(name, points, tets, labels=None, edges=(), triangles=()):
    labels = labels or [0] * len(tets)
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(points))]
    lines += [row(p) + " 0" for p in points]
    lines += ["Tetrahedra", str(len(tets))]
    lines += [" ".join(str(v + 1) for v in tet) + f" {label}" for tet, label in zip(tets, labels)]
    for title, elements in (("Edges", edges), ("Triangles", triangles)):
        if elements:
            lines += [title, str(len(elements))]
            lines += [" ".join(str(v + 1) for v in element) + " 0" for element in elements]
    write(name, lines + ["End"])


def vtk(name, points, cells):
    size = {2: 3, 3: 5, 4: 10, 10: 24}
    lines = ["# vtk DataFile Version 3.0", "made", "ASCII", "DATASET UNSTRUCTURED_GRID",
             f"POINTS {len(points)} double"] + [row(p) for p in points]
    lines += [f"CELLS {len(cells)} {sum(len(c) + 1 for c in cells)}"]
    lines += [f"{len(c)} " + " ".join(map(str, c)) for c in cells]
    write(name, lines + [f"CELL_TYPES {len(cells)}"] + [str(size[len(c)]) for c in cells])


def msh2(name, points, elements, names=()):
    """elements: (type, physical, vertices)"""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    if names:
        lines += ["$PhysicalNames", str(len(names))]
        lines += [f'{dimension} {number} "{text}"' for dimension, number, text in names]
        lines += ["$EndPhysicalNames"]
    lines += ["$Nodes", str(len(points))] + [f"{i} {row(p)}" for i, p in enumerate(points, 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    for i, (kind, physical, vertices) in enumerate(elements, 1):
        lines.append(f"{i} {kind} 2 {physical} {physical} " + " ".join(str(v + 1) for v in vertices))
    write(name, lines + ["$EndElements"])


def bdf(name, points, tets, cards=(), tail=lambda i: "", more=()):
    lines = ["BEGIN BULK"]
    lines += [f"GRID,{i},,{','.join(f'{x:.6f}' for x in p)}{tail(i)}" for i, p in enumerate(points, 1)]
    lines += [f"CTETRA,{i},1," + ",".join(str(v + 1) for v in tet) for i, tet in enumerate(tets, 1)]
    write(name, lines + list(more) + ["PSOLID,1,1", "MAT1,1,210000.,,.3"] + list(cards) + ["ENDDATA"])


def inp(name, points, tets, lines=(), kind="C3D4", before=()):
    text = ["*NODE"] + [f"{i}, {', '.join(f'{x:.10g}' for x in p)}" for i, p in enumerate(points, 1)]
    text += [f"*ELEMENT, TYPE={kind}, ELSET=body"]
    text += [f"{i}, " + ", ".join(str(v + 1) for v in tet) for i, tet in enumerate(tets, 1)]
    text += list(before) + ["*SOLID SECTION, ELSET=body, MATERIAL=steel", ",", "*MATERIAL, NAME=steel",
                            "*ELASTIC", "210000., 0.3"]
    write(name, text + list(lines))


def second_order(points, tets):
    """Nodes as Abaqus and VTK list them."""
    points, middle, made = list(points), {}, []
    for tet in tets:
        nodes = list(tet)
        for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)):
            key = tuple(sorted((tet[a], tet[b])))
            if key not in middle:
                middle[key] = len(points)
                points.append(tuple((points[key[0]][k] + points[key[1]][k]) / 2 for k in range(3)))
            nodes.append(middle[key])
        made.append(tuple(nodes))
    return points, made


def numbers():
    points, tets = box()
    bdf("numbers-of-sets.bdf", points, tets, [
        "SPCADD,14,1,14", "MPCADD,14,14", "TEMPD,14,20.", "DLOAD,14,1.,1.,14", "TLOAD1,14,14,,,14",
        "TABLED1,14,,,,,,,,+", "+,0.,0.,1.,1.,ENDT", "EIGRL,14,,,14", "FREQ1,14,1.,14.,14",
        "PCOMP,14,,,,,,,,+", "+,14,1.,0.,YES", "DVPREL1,14,PSHELL,14,4,,,,,+", "+,14,1.",
        "DRESP1,14,STR,STRESS,PSOLID,,9,,14", "SET3,14,ELEM,14", "PLOAD4,14,13,1.,,,,THRU,14",
        "TEMPD,30,14.", "QVOL,14,1.,,14", "DEFORM,14,14,1.", "NLPARM,14,14", "DCONSTR,14,14,1."])
    bdf("numbers-of-springs.bdf", points, tets, [
        "RBE3,14,,1,123,1.,123,2,3", "RBE2,114,2,123,3,4", "CBUSH,14,14,1,2", "PBUSH,14,K,14.",
        "CONM2,214,1,,14.", "CELAS2,314,14.,1,1,2,14", "MPC,14,1,14,1.,2,14,-1.",
        "SPC1,14,14,1,THRU,3", "FORCE,14,5,,14.,0.,0.,1.", "ASET1,14,7,8", "CORD2R,14,,0.,0.,0.,0.,0.,1.,+",
        "+,1.,0.,0."])
    bdf("point-in-a-long-list.bdf", points, tets,
        ["SPC1,1,123,1,1,1,1,1,1,+"] + ["+,1,1,1,1,1,1,1,1,+"] * 40 + ["+,14"])
    bdf("grid-with-constraints.bdf", points, tets, tail=lambda i: ",0,123" if i == 14 else ",0,,0")
    bdf("unknown-card.bdf", points, tets, ["NOSUCH,7,14"])
    inp("numbers-of-elements.inp", points, tets, [
        "*AMPLITUDE, NAME=a", "0, 0, 14, 14", "*TIME POINTS, NAME=t", "14, 14", "*SURFACE, NAME=s",
        "1, S2", "14, S1", "*STEP, INC=14", "*STATIC", "14, 14", "*DLOAD", "14, P1, 5.", "14, GRAV, 9.81, 0, 0, -1",
        "*EL PRINT, ELSET=body", "S", "*END STEP"])
    inp("conditions-of-elements.inp", points, tets, [
        "*INITIAL CONDITIONS, TYPE=STRESS", "13, 14, 14, 14, 14, 14, 14, 14", "*STEP", "*MODAL DYNAMIC", "14, 14",
        "*MODAL DAMPING", "14, 14, 14", "*CHANGE FRICTION, INTERACTION=i", "*FRICTION", "14", "*END STEP"])
    inp("terms-of-an-equation.inp", points, tets,
        ["*EQUATION", "3", "1, 1, 14, 2, 1, 14, 3, 1, 14", "14"] +
        ["1, 1, 14, 2, 1, 14, 3, 1, 14, 4, 1, 14"] * 3 + ["5, 1, 14, 6, 1, 14"])
    inp("node-in-an-equation.inp", points, tets,
        ["*EQUATION", "2", "1, 1, 1., 14, 1, -1.", "*ORIENTATION, NAME=o", "1, 0, 0, 0, 1, 0", "3, 14"])
    inp("set-of-one-node.inp", points, tets, ["*STEP", "*STATIC", "*CLOAD", "probe, 1, 1.", "*END STEP"],
        before=["*NSET, NSET=probe", "14"])


def listings():
    points, tets = box()
    mesh("listed-both-ways.mesh", points, [t if i % 3 else mirrored(t) for i, t in enumerate(tets)])
    vtk("listed-ascending.vtk", points, ascending(tets))
    apart = join(box(), box(at=(5, 0, 0)))
    mesh("one-part-mirrored.mesh", apart[0],
         [mirrored(t) if label == 2 else t for t, label in zip(apart[1], apart[2])], apart[2])
    elements = [(2, 7, (0, 1, 4)), (2, 9, (0, 4, 3))] + [(4, 3, mirrored(t)) for t in tets]
    msh2("names-and-mirrored.msh", points, elements, [(2, 7, "left"), (2, 9, "right"), (3, 3, "solid")])
    quadratic, nodes = second_order(points, [mirrored(t) for t in tets])
    inp("second-order-mirrored.inp", quadratic, nodes, kind="C3D10")
    inp("sets-and-loads.inp", points, tets, [
        "*ELSET, ELSET=_s_S1, INTERNAL", "1, 5", "*ELSET, ELSET=some", "2, 6, 9", "*NSET, NSET=corner", "1",
        "*SURFACE, NAME=first", "_s_S1, S2", "*SURFACE, NAME=second", "some, S2", "7, S1", "*STEP", "*STATIC",
        "*BOUNDARY", "corner, 1, 3", "*DLOAD", "3, P1, 5.", "some, P3, 2.", "*END STEP"])

    inverted, _ = box(inner=(0.6, 0.2, -0.2))
    mesh("ascending-and-inverted.mesh", inverted, ascending(tets))
    vtk("mirrored-and-inverted.vtk", inverted, [mirrored(t) for t in tets])
    apart = join((inverted, tets), box(inner=(0.6, 0.2, -0.2), at=(5, 0, 0)))
    mesh("parts-mirrored-and-inverted.mesh", apart[0],
         [mirrored(t) if label == 2 else t for t, label in zip(apart[1], apart[2])], apart[2])
    worst = min(range(len(tets)), key=lambda t: volume(inverted, tets[t]))
    order = [worst] + [t for t in range(len(tets)) if t != worst]
    bdf("first-is-inverted.bdf", inverted, [ascending(tets)[t] for t in order])
    flat, _ = box(inner=(1, 1, 0))
    mesh("mixed-and-flat.mesh", flat, ascending(tets))


def volume(points, tet):
    a, b, c, d = (points[v] for v in tet)
    x, y, z = ([p[k] - a[k] for k in range(3)] for p in (b, c, d))
    return (x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
            x[2] * (y[0] * z[1] - y[1] * z[0]))


def degenerate():
    points, tets = box()
    vtk("tet-twice.vtk", points, tets + [mirrored(tets[7])] + [(0, 0, 1), (2, 2)])
    quadratic, nodes = second_order(points, tets)
    bad = (nodes[3][0], nodes[3][0], *nodes[3][2:])
    inp("corner-twice-second-order.inp", quadratic, nodes + [bad], kind="C3D10")
    bdf("elements-twice.bdf", points, tets + [tets[2], tets[2], (4, 4, 5, 6)],
        more=["CTRIA3,90,1,1,1,2", "CTRIA3,91,1,1,2,5"])
    msh2("degenerate.msh", points,
         [(1, 1, (3, 3)), (2, 1, (0, 1, 1)), (2, 1, (0, 1, 4))] + [(4, 1, t) for t in tets] + [(4, 1, (0, 1, 1, 2))])
    mesh("label-of-the-second.mesh", points, tets + [tets[0]], [1] * 48 + [2])
    mesh("twice-and-mixed.mesh", points, ascending(tets) + [tets[9]], edges=[(0, 0), (0, 1)],
         triangles=[(0, 0, 1), (0, 1, 4)])


def touching():
    coarse = box(n=1)
    mesh("fine-beside-coarse.mesh", *join(box(inner=None), box(n=1, at=(2, 0, 0))))
    mesh("two-boxes-not-joined.mesh", *join(box(), box(at=(2, 0, 0))))
    mesh("edge-beside-an-edge.mesh", *join(box(inner=None), box(n=1, at=(2, 2, 0))))
    mesh("slanted-and-hanging.mesh", *turned(join(box(inner=None), box(n=1, at=(2, 0, 0)))))
    mesh("apart.mesh", *join(box(), box(at=(2.001, 0, 0))))
    msh_points, msh_tets, labels = join(box(inner=None), coarse)
    msh2("within-each-other.msh", msh_points, [(4, label, t) for t, label in zip(msh_tets, labels)])


def in_cylinder(p):
    return (math.hypot(p[0], p[1]), math.degrees(math.atan2(p[1], p[0])), p[2])


def nastran_flavours():
    points, tets = box()
    lines = ["SOL 101", "CEND", " BEGIN BULK", "GRDSET\t\t7", "$ in a cylinder"]
    for i, p in enumerate(points, 1):
        lines += [f"GRID\t{i}\t\t" + "\t".join(f"{x:.5f}"[:8] for x in in_cylinder(p)), ""]
    lines += ["CORD2C\t7\t0\t0.\t0.\t0.\t0.\t0.\t1.", "$ and", "\t1.\t0.\t0."]
    lines += [f"  ctetra, {i}, , " + ", ".join(str(v + 1) for v in tet) for i, tet in enumerate(tets, 1)]
    write("tabs-and-cylinder.bdf", lines + ["ENDDATA"])
    quadratic, nodes = second_order(points, tets)
    lines = ["BEGIN BULK"] + [f"GRID,{i},,{','.join(f'{x:.6f}' for x in p)}" for i, p in enumerate(quadratic, 1)]
    for i, tet in enumerate(nodes, 1):
        words = [str(v + 1) for v in tet]
        if i == 48:
            words[9] = ""
        lines += ["$ on one line" if i % 2 else "", f"CTETRA,{i},1," + ",".join(words)]
    write("a-node-left-out.bdf", lines + ["PSOLID,1,1", "MAT1,1,210000.,,.3", "ENDDATA"])


def nastran_continued():
    """Continuations far from their cards, those of superelements, zeros, a name over two lines."""
    points, tets = box()
    quadratic, nodes = second_order(points, tets)
    grid = [f"GRID,{i},,{','.join(f'{x:.6f}' for x in p)}" for i, p in enumerate(quadratic, 1)]
    fixed = lambda words: "".join(f"{word:>8}" for word in words)
    cards, rest = [], []
    for i, tet in enumerate(nodes, 1):
        words = [i, 1] + [v + 1 for v in tet]
        mark = f"+E{i}" if i % 2 else f"E{i}"
        cards.append(f"CTETRA  {fixed(words[:8])}{mark:<8}")
        rest.append(f"{'+' + mark.lstrip('+'):<8}{fixed(words[8:])}")
    write("continued-elsewhere.bdf", ["BEGIN BULK"] + grid + cards + ["PSOLID,1,1"] + rest[::-1] + ["ENDDATA"])
    plain = [f"GRID,{i},,{','.join(f'{x:.6f}' for x in p)}" for i, p in enumerate(points, 1)]
    zeros = [f"CTETRA,{i},1," + ",".join(str(v + 1) for v in tet) + ",0,0,+" + "\n+,0,0,0,0" for i, tet in enumerate(tets, 1)]
    write("superelement.bdf", ["SOL 101", "CEND", "BEGIN BULK"] + plain + zeros +
          ["PSOLID,1,1", "BEGIN SUPER=1", "GRID,14,,0.,0.,9.", "CTETRA,1,1,1,2,3,14", "ENDDATA"])
    write("name-over-two-lines.bdf", ["BEGIN BULK", "INCLUDE 'included-", "         mesh-bulk.bdf'", "ENDDATA"])


def decks_of_windows():
    points, tets = box()
    middle = ["*NSET, NSET=order, UNSORTED", "14, 1", "*ELSET,", "** of all", "ELSET=all,", "  GENERATE", "1, 100"]
    inp("ordered-and-beyond.inp", points, tets, ["*STEP", "*STATIC", "*END STEP"], before=middle)
    with open("ordered-and-beyond.inp", encoding="ascii") as file:
        text = file.read().replace("ELSET=body\n1,", "ELSET=body,\n1,")
    with open("ordered-and-beyond.inp", "w", encoding="ascii", newline="") as file:
        file.write(text.replace("\n", "\r\n"))


def comments_first():
    points, tets = box()
    msh2("comments-first.msh", points, [(4, 1, t) for t in tets])
    with open("comments-first.msh", encoding="ascii") as file:
        text = file.read()
    with open("comments-first.msh", "w", encoding="ascii") as file:
        file.write("$Comments\n$MeshFormat of a box\n$EndComments\n" + text)


def parts_of_abaqus():
    points, tets = box()
    mesh = ["*Node"] + [f"{i}, {', '.join(f'{x:.10g}' for x in p)}" for i, p in enumerate(points, 1)]
    mesh += ["*Element, type=C3D4"] + [f"{i}, " + ", ".join(str(v + 1) for v in t) for i, t in enumerate(tets, 1)]
    mesh += ["*Elset, elset=Set-1, generate", "1, 48, 1", "*Solid Section, elset=Set-1, material=steel", ","]
    material = ["*Material, name=steel", "*Elastic", "210000., 0.3"]
    def faces(z):
        for name, corners in (("S1", (0, 1, 2)), ("S2", (0, 3, 1)), ("S3", (1, 3, 2)), ("S4", (2, 3, 0))):
            there = [str(i) for i, t in enumerate(tets, 1) if all(points[t[c]][2] == z for c in corners)]
            if there:
                yield name, ", ".join(there)

    assembly = ["*Assembly, name=Assembly", "*Instance, name=Block-1, part=Block", "*End Instance",
                "*Instance, name=Block-2, part=Block", "0., 0., 2.", "0., 0., 2., 0., 0., 3., 90.", "*End Instance"]
    for number, side, z in ((1, "top", 2), (2, "bottom", 0)):
        for face, elements in faces(z):
            assembly += [f"*Elset, elset=_{side}_{face}, internal, instance=Block-{number}", elements]
        assembly += [f"*Surface, type=ELEMENT, name={side}"] + [f"_{side}_{face}, {face}" for face, _ in faces(z)]
    assembly += ["*Tie, name=both, adjust=no", "bottom, top", "*End Assembly"]
    write("one-part-twice.inp", ["*Heading", "*Part, name=Block", *mesh, "*End Part", *assembly, *material])
    shell = ["*Part, name=Plate", "*Node", "1, 0., 0., 5.", "2, 1., 0., 5.", "3, 0., 1., 5., 0., 0., 1.",
             "*Element, type=S3", "1, 1, 2, 3", "*End Part"]
    write("plate-beside.inp", ["*Heading", *shell, "*Part, name=Block", *mesh, "*End Part", "*Assembly, name=A",
                               "*Instance, name=Plate-1, part=Plate", "*End Instance",
                               "*Instance, name=Block-1, part=Block", "*End Instance",
                               "*Nset, nset=Set-2, instance=Plate-1", "1, 3", "*Nset, nset=Set-2, instance=Block-1",
                               "1, 3", "*End Assembly", *material, "*Step", "*Static", "*Boundary", "Set-2, 1, 3",
                               "*End Step"])


def turned(made):
    points, tets, labels = made
    return [(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z + 0.1 * x) for x, y, z in points], tets, labels


def vtk_of_arrays(name, points, cells, cell_data=(), point_data=()):
    """Arrays: (keyword, name, type, values); of FIELD if the keyword is empty."""
    vtk(name, points, cells)
    with open(name, "a", encoding="ascii") as file:
        for title, count, arrays in (("CELL_DATA", len(cells), cell_data), ("POINT_DATA", len(points), point_data)):
            if not arrays:
                continue
            file.write(f"{title} {count}\n")
            for keyword, array, kind, values in arrays:
                if keyword == "SCALARS":
                    file.write(f"SCALARS {array} {kind} 1\nLOOKUP_TABLE default\n")
                elif keyword:
                    file.write(f"{keyword} {array} {kind}\n")
                else:
                    file.write(f"FIELD FieldData 1\n{array} 1 {count} {kind}\n")
                file.write("\n".join(str(v) for v in values) + "\n")


def vtu(name, points, cells, cell_data=(), point_data=(), cell_roles="", point_roles=""):
    """Arrays: (name, type, values)."""
    size = {2: 3, 3: 5, 4: 10, 10: 24}
    lines = ['<?xml version="1.0"?>', '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">',
             "<UnstructuredGrid>", f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">']

    def array(label, kind, values, components=1):
        return [f'<DataArray type="{kind}" Name="{label}" NumberOfComponents="{components}" format="ascii">',
                " ".join(str(v) for v in values), "</DataArray>"]

    for title, roles, arrays in (("PointData", point_roles, point_data), ("CellData", cell_roles, cell_data)):
        lines += [f"<{title}{roles}>"]
        for label, kind, values in arrays:
            lines += array(label, kind, values, 1 if len(values) in (len(points), len(cells)) else 3)
        lines += [f"</{title}>"]
    lines += ["<Points>"] + array("Points", "Float64", [row(p) for p in points], 3) + ["</Points>", "<Cells>"]
    lines += array("connectivity", "Int64", [" ".join(map(str, c)) for c in cells])
    ends = [sum(len(c) for c in cells[:i + 1]) for i in range(len(cells))]
    lines += array("offsets", "Int64", ends) + array("types", "UInt8", [size[len(c)] for c in cells])
    write(name, lines + ["</Cells>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>"])


def squeezed():
    """A box with a bad vertex inside that is often replaced, so that tets and points are new."""
    points, tets = box(n=3, inner=None)
    points = [tuple(0.92 * x if 0 < x < 2 and 0 < y < 2 and 0 < z < 2 and i % 2 else x for x in (x, y, z))
              for i, (x, y, z) in enumerate(points)]
    k = points.index(min((p for p in points if all(0.1 < x < 1.9 for x in p)), key=sum))
    points[k] = (0.3, 1.1, 0.35)
    return points, tets


def identifiers():
    points, tets = squeezed()
    n, t = len(points), len(tets)
    vtk_of_arrays("ids-by-keyword.vtk", points, tets, [("GLOBAL_IDS", "cells", "vtkIdType", range(t)),
                                                       ("SCALARS", "heat", "double", [0.5 * i for i in range(t)])],
                  [("PEDIGREE_IDS", "nodes", "vtkIdType", range(1000, 1000 + n))])
    vtu("ids-as-reals.vtu", points, tets, [("GlobalElementID", "Float64", [float(i) for i in range(1, t + 1)])],
        [("GlobalNodeID", "Int32", range(1, n + 1))], ' GlobalIds="GlobalElementID"', ' GlobalIds="GlobalNodeID"')
    faces = [(0, 1, 5), (0, 5, 4)]
    vtk_of_arrays("ids-of-tets-and-faces.vtk", points, tets + faces,
                  [("", "element_id", "int", [*range(101, 101 + t), 900, 901])])
    vtu("ids-in-single-precision.vtu", points, tets, [("Element ID", "Float32", [float(i) for i in range(7, 7 + t)])])
    vtu("ids-near-the-end.vtu", points, tets, [("PedigreeElementId", "Int32", range(2147483647 - t + 1, 2147483648))])


def halves(points, tets, axis):
    return [1 if sum(points[v][axis] for v in tet) / 4 < 1 else 2 for tet in tets]


def regions():
    points, tets = box()
    x, y = halves(points, tets, 0), halves(points, tets, 1)
    vtk_of_arrays("blocks-beside-ghosts.vtk", points, tets, [("", "ElementBlockIds", "int", x),
                                                             ("", "vtkGhostType", "int", [0] * 48)])
    vtk_of_arrays("markers-as-doubles.vtk", points, tets, [("", "cell_markers", "double", [float(v) for v in x])])
    vtk_of_arrays("two-unknown-arrays.vtk", points, tets, [("", "zebra", "int", x), ("", "crossing", "int", y)])
    vtu("name-with-a-blank.vtu", points, tets, [("Region ID", "Int32", x), ("colour", "Int32", y)])
    vtu("body-and-object.vtu", points, tets, [("ObjectId", "Int32", y), ("body_id", "Int64", x)])
    vtu("one-unknown-double.vtu", points, tets, [("zebra", "Float64", [float(v) for v in x]),
                                                 ("vtkGhostType", "UInt8", [0] * 48)])
    vtu("divided.vtu", points, tets, [("zebra", "Int32", x), ("vtkProcessId", "Int32", y)])


if __name__ == "__main__":
    identifiers()
    regions()
    numbers()
    listings()
    degenerate()
    touching()
    nastran_flavours()
    nastran_continued()
    decks_of_windows()
    comments_first()
    parts_of_abaqus()
