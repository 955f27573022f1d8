#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes the meshes of assets/meshes: shapes of tetmend's own, with a good surface and a poor inside.

Needs the Debian packages python3-gmsh (made with 4.8.4) and python3-numpy.

    /usr/bin/python3 assets/recipes/make_meshes.py OUTDIR

Each shape is modelled with Gmsh's OpenCASCADE kernel. Its surface is triangulated with care, and its inside is filled
by a Delaunay mesher whose optimisation is switched off, so that flat tets (slivers) stay in it. The same machine and
package versions give the same bytes on every run. Before a file is written, its mesh is checked.
"""
import math
import os
import struct
import sys

import gmsh
import numpy as np

FRONTAL_DELAUNAY = 6  # value of Mesh.Algorithm
DELAUNAY = 1          # value of Mesh.Algorithm3D; HXT (10) gives another mesh on every run
INSIDE_COARSER = 1.2  # edge lengths inside, relative to those asked for on the surface: more slivers
TRIANGLE, TET = 2, 4  # Gmsh's element types

occ = gmsh.model.occ


# ---- The shapes -----------------------------------------------------------------------------------------------------
# Each function builds a model and returns (regions, faces): lists of (Gmsh tag, label).

def bracket():
    """A floor and a wall with holes, a thin rib between them, a pipe with a rounded foot, and a ring to lift it by."""
    floor = occ.addBox(0, 0, 0, 72, 44, 8)
    wall = occ.addBox(0, 0, 0, 7, 44, 40)
    pipe = occ.addCylinder(48, 22, 0, 0, 0, 24, 9)
    rib = extruded([(3, 3), (32, 3), (32, 13), (13, 32), (3, 32)], y=20.7, thickness=2.6)

    ring = occ.addTorus(0, 0, 0, 9, 2.4)
    occ.rotate([(3, ring)], 0, 0, 0, 1, 0, 0, math.pi / 2)
    occ.translate([(3, ring)], 22, 9, 8)
    above = occ.addBox(0, -20, 4, 80, 80, 40)
    half_ring, _ = occ.intersect([(3, ring)], [(3, above)])

    solid, _ = occ.fuse([(3, floor)], [(3, wall), (3, pipe), (3, rib)] + half_ring)
    foot = [edge for _, edge in occ.getEntities(1) if is_circle_at(edge, (48, 22, 8), 9)]
    solid = occ.fillet([solid[0][1]], foot, [2.5])

    bore = [occ.addCylinder(48, 22, -1, 0, 0, 30, 5.5)]
    floor_holes = [occ.addCylinder(x, y, -1, 0, 0, 12, 3.2) for x, y in ((65, 7), (65, 37), (28, 36))]
    wall_holes = [occ.addCylinder(-1, y, 29, 12, 0, 0, 5) for y in (10, 34)]
    occ.cut(solid, [(3, hole) for hole in bore + floor_holes + wall_holes])
    occ.synchronize()

    finer_inside([
        # size, x from and to, y from and to, z from and to
        (1.1, 7, 32, 20.7, 23.3, 8, 32),   # rib
        (1.05, 10, 34, 6.6, 11.4, 8, 20),   # ring
        (1.3, 36, 60, 10, 34, 8, 24),     # pipe
        (1.4, 43, 53, 17, 27, 0, 8),      # bore
        (1.4, 61, 69, 3, 11, 0, 8),
        (1.4, 61, 69, 33, 41, 0, 8),
        (1.4, 24, 32, 32, 40, 0, 8),
    ], elsewhere=2.05, transition=5)
    return [(tag, 1) for tag in tags(3)], numbered(tags(2))


def two_materials():
    """A block (region 1) with a round-headed core (region 2) that reaches its bottom. Label 10: between the two."""
    block = occ.addBox(0, 0, 0, 13, 11, 11)
    trunk = occ.addCylinder(6.5, 5.5, 0, 0, 0, 4.5, 3.6)
    head = occ.addSphere(6.5, 5.5, 4.5, 3.6)
    upper = occ.addBox(0, 0, 4.5, 14, 12, 11)
    dome, _ = occ.intersect([(3, head)], [(3, upper)])
    core, _ = occ.fuse([(3, trunk)], dome)
    _, pieces = occ.fragment([(3, block)], core)
    occ.synchronize()

    core = pieces[1][0][1]
    regions = [(tag, 2 if tag == core else 1) for tag in tags(3)]
    between = [tag for tag in tags(2) if len(gmsh.model.getAdjacencies(2, tag)[0]) == 2]
    outside = [tag for tag in tags(2) if tag not in between]
    size_everywhere(1.2)
    return regions, numbered(outside) + [(tag, 10) for tag in between]


def sheet():
    """A block with a bent sheet that stands free inside it. Label 10: the sheet."""
    block = occ.addBox(0, 0, 0, 13, 11, 10)
    centre = occ.addPoint(6.5, 2.5, 2)
    ends = [occ.addPoint(6.5 + 4 * math.cos(a), 2.5, 2 + 4 * math.sin(a)) for a in (math.radians(25), math.radians(155))]
    arc = occ.addCircleArc(ends[0], centre, ends[1])
    swept = occ.extrude([(1, arc)], 0, 6, 0)
    bent = next(tag for dim, tag in swept if dim == 2)
    occ.synchronize()

    gmsh.model.mesh.embed(2, [bent], 3, block)
    size_everywhere(1.25)
    return [(block, 1)], numbered([tag for tag in tags(2) if tag != bent]) + [(bent, 10)]


def folded_sheet():
    """A block with a sheet folded sharply, free-standing: tets in the fold cannot be good. Labels 10, 11: its halves."""
    block = occ.addBox(0, 0, 0, 15, 12, 10)
    half_angle = math.radians(9)
    halves = []
    fold = [occ.addPoint(3, y, 5) for y in (3, 9)]
    crease = occ.addLine(*fold)
    for side in (-1, 1):
        x, z = 3 + 9 * math.cos(half_angle), 5 + side * 9 * math.sin(half_angle)
        ends = [occ.addPoint(x, y, z) for y in (3, 9)]
        rim = [occ.addLine(fold[1], ends[1]), occ.addLine(ends[1], ends[0]), occ.addLine(ends[0], fold[0])]
        halves.append(occ.addPlaneSurface([occ.addCurveLoop([crease] + rim)]))
    occ.synchronize()

    gmsh.model.mesh.embed(2, halves, 3, block)
    size_everywhere(1.1)
    outside = [tag for tag in tags(2) if tag not in halves]
    return [(block, 1)], numbered(outside) + [(tag, label) for label, tag in enumerate(halves, start=10)]


# ---- Help for building ----------------------------------------------------------------------------------------------

def tags(dim):
    return [tag for _, tag in gmsh.model.getEntities(dim)]


def numbered(some_tags):
    return [(tag, label) for label, tag in enumerate(some_tags, start=1)]


def extruded(profile, y, thickness):
    """A plate parallel to the xz plane, of the given outline."""
    points = [occ.addPoint(x, y, z) for x, z in profile]
    lines = [occ.addLine(p, q) for p, q in zip(points, points[1:] + points[:1])]
    face = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    return next(tag for dim, tag in occ.extrude([(2, face)], 0, thickness, 0) if dim == 3)


def is_circle_at(edge, centre, radius):
    x0, y0, z0, x1, y1, z1 = occ.getBoundingBox(1, edge)
    x, y, z = centre
    wanted = (x - radius, y - radius, z, x + radius, y + radius, z)
    return np.allclose((x0, y0, z0, x1, y1, z1), wanted, atol=1e-5)


def finer_inside(boxes, elsewhere, transition):
    """Edge lengths: the smallest of what the boxes ask for, growing to `elsewhere` over the length `transition`."""
    field = gmsh.model.mesh.field
    ids = []
    for size, *bounds in boxes:
        ids.append(field.add("Box"))
        values = [size, elsewhere, *bounds, transition]
        for name, value in zip(("VIn", "VOut", "XMin", "XMax", "YMin", "YMax", "ZMin", "ZMax", "Thickness"), values):
            field.setNumber(ids[-1], name, value)
    smallest = field.add("Min")
    field.setNumbers(smallest, "FieldsList", ids)
    field.setAsBackgroundMesh(smallest)


def size_everywhere(size):
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)


# ---- Meshing --------------------------------------------------------------------------------------------------------

def make(shape):
    """Points, triangles with labels and tets with labels; point numbers start at 0."""
    gmsh.initialize(["make_meshes", "-nt", "1"])
    for name, value in (("General.Terminal", 0),
                        ("General.NumThreads", 1),
                        ("Mesh.Algorithm", FRONTAL_DELAUNAY),
                        ("Mesh.Smoothing", 10),  # moves surface points only; the inside is left as it comes
                        ("Mesh.Algorithm3D", DELAUNAY),
                        ("Mesh.Optimize", 0),
                        ("Mesh.OptimizeNetgen", 0),
                        ("Mesh.MeshSizeFromPoints", 0),
                        ("Mesh.MeshSizeExtendFromBoundary", 0)):
        gmsh.option.setNumber(name, value)
    gmsh.model.add(shape.__name__)
    regions, faces = shape()
    gmsh.model.mesh.generate(2)
    gmsh.option.setNumber("Mesh.MeshSizeFactor", INSIDE_COARSER)
    gmsh.model.mesh.generate(3)

    node_tags, coordinates, _ = gmsh.model.mesh.getNodes()
    triangles = collect(TRIANGLE, faces)
    tets = collect(TET, regions)
    gmsh.finalize()

    # Gmsh's tags to row numbers; points that no tet uses (such as the centre of an arc) are left out.
    order = np.argsort(node_tags)
    used = np.unique(tets[:, :4])
    rows = order[np.searchsorted(node_tags[order], used)]
    points = coordinates.reshape(-1, 3)[rows]
    triangles[:, :3] = np.searchsorted(used, triangles[:, :3])
    tets[:, :4] = np.searchsorted(used, tets[:, :4])
    turn_positive(points, tets)
    turn_outwards(triangles, tets)
    return points, triangles, tets


def collect(element_type, entities):
    """One row per element: its points and its label."""
    corners = 3 if element_type == TRIANGLE else 4
    blocks = []
    for tag, label in entities:
        nodes = gmsh.model.mesh.getElementsByType(element_type, tag)[1].astype(np.int64).reshape(-1, corners)
        blocks.append(np.column_stack([nodes, np.full(len(nodes), label)]))
    return np.vstack(blocks)


def six_volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a))


def turn_positive(points, tets):
    wrong = six_volumes(points, tets) < 0
    tets[wrong, 2:4] = tets[wrong, 3:1:-1]


def turn_outwards(triangles, tets):
    """The normals of the triangles point out of the mesh, and from region 1 into region 2."""
    sides = faces_of(tets)
    for row in triangles:
        face = tuple(row[:3])
        here, opposite = sides.get(cyclic(face)), sides.get(cyclic(face[::-1]))
        if here is None or (opposite is not None and opposite < here):
            row[1], row[2] = row[2], row[1]


def faces_of(tets):
    """Each side of each tet, seen from outside of the tet, and the label of the tet."""
    sides = {}
    for a, b, c, d, label in tets.tolist():
        for face in ((b, c, d), (a, d, c), (a, b, d), (a, c, b)):
            sides[cyclic(face)] = label
    return sides


def cyclic(face):
    first = face.index(min(face))
    return tuple(int(p) for p in face[first:] + face[:first])


# ---- Checks and numbers ---------------------------------------------------------------------------------------------

def check(points, triangles, tets):
    assert six_volumes(points, tets).min() > 0
    assert len(np.unique(tets[:, :4])) == len(points)
    assert triangles[:, 3].min() >= 1 and tets[:, 4].min() >= 1
    sides = faces_of(tets)
    assert len(sides) == 4 * len(tets), "two tets lie on the same side of a face"
    listed = {cyclic(tuple(row[:3])) for row in triangles}
    assert len(listed) == len(triangles)
    assert listed <= sides.keys(), "a triangle is no side of a tet, or looks inwards"
    for side, label in sides.items():
        opposite = cyclic(side[::-1])
        if sides.get(opposite) != label:
            assert side in listed or opposite in listed, "a boundary face has no triangle"


def dihedral_angles(points, tets):
    """Degrees, six a tet."""
    corner = [points[tets[:, i]] for i in range(4)]
    angles = []
    for i, j, k, l in ((0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1)):
        edge = corner[j] - corner[i]
        m, n = np.cross(edge, corner[k] - corner[i]), np.cross(edge, corner[l] - corner[i])
        angles.append(np.arctan2(np.linalg.norm(np.cross(m, n), axis=1), np.einsum("ij,ij->i", m, n)))
    return np.degrees(np.stack(angles, axis=1))


def triangle_angles(points, triangles):
    corner = [points[triangles[:, i]] for i in range(3)]
    angles = []
    for i in range(3):
        u, v = corner[(i + 1) % 3] - corner[i], corner[(i + 2) % 3] - corner[i]
        angles.append(np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v)))
    return np.degrees(np.stack(angles, axis=1))


def describe(points, triangles, tets):
    angles = dihedral_angles(points, tets)
    poor = (angles < 30) | (angles > 150)
    return (f"{len(points)} points, {len(triangles)} triangles (smallest angle "
            f"{triangle_angles(points, triangles).min():.1f}), {len(tets)} tets; dihedral angles {angles.min():.4f} to "
            f"{angles.max():.4f}, {100 * poor.mean():.2f} % bad; {poor.any(axis=1).sum()} bad tets")


# ---- Files ----------------------------------------------------------------------------------------------------------

def write_ascii(path, points, triangles, tets):
    """MEDIT's text format. Python's repr of a float reads back to the same float."""
    with open(path, "w", newline="\n") as out:
        out.write(f"MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n{len(points)}\n")
        out.writelines(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in points.tolist())
        for name, rows in (("Triangles", triangles), ("Tetrahedra", tets)):
            out.write(f"\n{name}\n{len(rows)}\n")
            out.writelines(" ".join(str(p + 1) for p in row[:-1]) + f" {row[-1]}\n" for row in rows.tolist())
        out.write("\nEnd\n")


def write_binary(path, points, triangles, tets):
    """MEDIT's binary format, version 2: 32-bit integers, 64-bit floats, each section with the place of the next."""
    def one_based(rows):
        shifted = rows.astype("<i4")
        shifted[:, :-1] += 1
        return shifted.tobytes()

    vertices = np.zeros(len(points), dtype=[("position", "<f8", 3), ("label", "<i4")])
    vertices["position"] = points
    data = bytearray(struct.pack("<ii", 1, 2))                       # byte order mark, version
    data += struct.pack("<iii", 3, len(data) + 12, 3)                # Dimension
    for keyword, count, body in ((4, len(points), vertices.tobytes()),  # Vertices
                                 (6, len(triangles), one_based(triangles)),  # Triangles
                                 (8, len(tets), one_based(tets))):   # Tetrahedra
        data += struct.pack("<iii", keyword, len(data) + 12 + len(body), count) + body
    data += struct.pack("<ii", 54, 0)                                # End
    with open(path, "wb") as out:
        out.write(data)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: make_meshes.py OUTDIR")
    os.makedirs(sys.argv[1], exist_ok=True)
    for name, shape, write in (("bracket.meshb", bracket, write_binary),
                               ("two_materials.mesh", two_materials, write_ascii),
                               ("sheet.mesh", sheet, write_ascii),
                               ("folded_sheet.mesh", folded_sheet, write_ascii)):
        mesh = make(shape)
        check(*mesh)
        write(os.path.join(sys.argv[1], name), *mesh)
        print(f"{name}: {describe(*mesh)}")


if __name__ == "__main__":
    main()
