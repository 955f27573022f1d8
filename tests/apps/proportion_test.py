# SPDX-License-Identifier: MIT
"""Time and memory of a run are in proportion to the files that it reads.

Each count that a format has (sets, surfaces, arrays, groups, pieces, includes, ...) is made ten times as large. Then a
run may take no more than three times ten times as long, in seconds of the processor, and no more bytes of memory for
each byte of the files than SECURITY.md says. Something quadratic takes a hundred times as long.

usage: proportion_test.py PROGRAM SOURCE_FOLDER [NAME...]      those whose name has one of these words
"""

import gzip
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, SOURCE, ONLY = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
SMALL = 2500
MOST_BYTES = 100  # of memory for each byte of the files, see SECURITY.md
FREE_BYTES = 64 << 20
MOST_GROWTH = 30
MOST_SECONDS = 60
CASES = {}


def case(function):
    CASES[function.__name__] = function
    return function


def rows(pattern, n, first=1):
    return "".join(pattern % {"i": i} for i in range(first, first + n))


# ---- Abaqus -------------------------------------------------------------------------------------

INP = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=S0\n1,1,2,3,4\n"


def many_nodes(n):
    """Points on a line beside the tet, which no tet uses."""
    return "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n" + rows("%(i)d,0,0,5\n", n, 5) + INP[INP.index("*ELEMENT"):]


def strip(n):
    """n tets apart from each other."""
    nodes = "".join(f"{4*i+1},{2*i},0,0\n{4*i+2},{2*i+1},0,0\n{4*i+3},{2*i},1,0\n{4*i+4},{2*i},0,1\n" for i in range(n))
    tets = "".join(f"{i+1},{4*i+1},{4*i+2},{4*i+3},{4*i+4}\n" for i in range(n))
    return f"*NODE\n{nodes}*ELEMENT,TYPE=C3D4,ELSET=S0\n{tets}"


@case
def inp_elset_around_one_element(n):
    return {"a.inp": INP + rows("*ELSET,ELSET=E%(i)d\n1\n", n)}


@case
def inp_elset_of_one_name(n):
    return {"a.inp": INP + "*ELSET,ELSET=E\n1\n" * n}


@case
def inp_elset_each_of_another_element(n):
    return {"a.inp": strip(n) + rows("*ELSET,ELSET=E%(i)d\n%(i)d\n", n)}


@case
def inp_elset_generate(n):
    return {"a.inp": INP + rows("*ELSET,ELSET=E%(i)d,GENERATE\n1,1,1\n", n)}


@case
def inp_elset_names_the_one_before(n):
    return {"a.inp": INP + rows("*ELSET,ELSET=E%(i)d\n1\n*ELSET,ELSET=F%(i)d\nE%(i)d\n", n)}


@case
def inp_nset_around_one_node(n):
    return {"a.inp": INP + rows("*NSET,NSET=N%(i)d\n1\n", n)}


@case
def inp_nset_of_one_name(n):
    return {"a.inp": many_nodes(n) + rows("*NSET,NSET=N\n%(i)d\n", n)}


@case
def inp_nset_each_of_another_node(n):
    return {"a.inp": strip(n) + rows("*NSET,NSET=N%(i)d\n%(i)d\n", n)}


@case
def inp_surface_around_one_face(n):
    return {"a.inp": INP + rows("*SURFACE,NAME=F%(i)d\n1,S1\n", n)}


@case
def inp_surface_of_sets(n):
    return {"a.inp": INP + rows("*ELSET,ELSET=E%(i)d\n1\n*SURFACE,NAME=F%(i)d\nE%(i)d,S1\n", n)}


@case
def inp_surface_each_of_another_face(n):
    return {"a.inp": strip(n) + rows("*SURFACE,NAME=F%(i)d\n%(i)d,S1\n", n)}


@case
def inp_loads_on_one_face(n):
    return {"a.inp": INP + "*STEP\n*STATIC\n*DLOAD\n" + rows("1,P1,%(i)d.\n", n) + "*END STEP\n"}


@case
def inp_load_blocks(n):
    return {"a.inp": INP + "*STEP\n*STATIC\n" + rows("*DLOAD\n1,P1,%(i)d.\n", n) + "*END STEP\n"}


@case
def inp_element_blocks(n):
    blocks = "".join(f"*NODE\n{4*i+1},{2*i},0,0\n{4*i+2},{2*i+1},0,0\n{4*i+3},{2*i},1,0\n{4*i+4},{2*i},0,1\n"
                     f"*ELEMENT,TYPE=C3D4,ELSET=S{i}\n{i+1},{4*i+1},{4*i+2},{4*i+3},{4*i+4}\n" for i in range(n))
    return {"a.inp": blocks}


@case
def inp_node_blocks_with_sets(n):
    return {"a.inp": INP + rows("*NODE,NSET=N%(i)d\n%(i)d,0,0,5\n", n, 5)}


@case
def inp_parts_with_instances(n):
    parts = rows("*PART,NAME=P%(i)d\n*NODE\n1,0,0,0,0,0,1\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=S\n"
                 "1,1,2,3,4\n*END PART\n", n)
    instances = rows("*INSTANCE,NAME=I%(i)d,PART=P%(i)d\n%(i)d.,0.,0.\n*END INSTANCE\n", n)
    sets = rows("*NSET,NSET=all,INSTANCE=I%(i)d\n1,2\n*ELSET,ELSET=E%(i)d,INSTANCE=I%(i)d\n1\n", n)
    surfaces = rows("*SURFACE,NAME=F%(i)d\nE%(i)d,S1\n", n)
    return {"a.inp": parts + "*ASSEMBLY,NAME=A\n" + instances + sets + surfaces + "*END ASSEMBLY\n"}


@case
def inp_instances_of_one_part(n):
    instances = rows("*INSTANCE,NAME=I%(i)d,PART=P\n%(i)d.,0.,0.\n*END INSTANCE\n", n)
    sets = rows("*ELSET,ELSET=E,INSTANCE=I%(i)d\n1\n", n)
    return {"a.inp": "*PART,NAME=P\n" + INP + "*END PART\n*ASSEMBLY,NAME=A\n" + instances + sets +
                     "*SURFACE,NAME=F\nE,S1\n*END ASSEMBLY\n"}


@case
def inp_sections(n):
    return {"a.inp": INP + rows("*SOLID SECTION,ELSET=S0,MATERIAL=M%(i)d\n", n)}


@case
def inp_sections_of_sets(n):
    return {"a.inp": INP + rows("*ELSET,ELSET=E%(i)d\n1\n*SOLID SECTION,ELSET=E%(i)d,MATERIAL=M\n", n)}


@case
def inp_boundary(n):
    return {"a.inp": many_nodes(n) + "*BOUNDARY\n" + rows("%(i)d,1,3\n", n)}


@case
def inp_springs_with_sets(n):
    return {"a.inp": INP + rows("*ELEMENT,TYPE=SPRINGA,ELSET=P%(i)d\n%(i)d,1,2\n", n, 2)}


@case
def inp_mpc_and_materials(n):
    return {"a.inp": INP + rows("*MATERIAL,NAME=M%(i)d\n*ELASTIC\n1.,.3\n*MPC\nTIE,1,2\n", n)}


@case
def inp_parameters_of_a_line(n):
    return {"a.inp": INP + "*STEP" + rows(",\nP%(i)d=%(i)d", n) + "\n*END STEP\n"}


@case
def inp_blank_lines_behind_a_comma(n):
    return {"a.inp": INP + "*STEP,\n" + 20 * n * " \n" + "INC=1\n*END STEP\n"}


@case
def inp_fields_of_a_line(n):
    return {"a.inp": INP + "*NSET,NSET=A\n" + n * "1,2,3,4," + "1\n"}


@case
def inp_includes(n):
    n = n // 10
    return {"a.inp": INP + rows("*INCLUDE,INPUT=i%(i)d.inp\n", n)} | {f"i{i}.inp": f"*ELSET,ELSET=E{i}\n1\n" for i in
                                                                      range(1, n + 1)}


@case
def inp_includes_within_another(n):
    n = n // 25
    chain = {f"i{i}.inp": f"** x\n*INCLUDE,INPUT=i{i+1}.inp\n" for i in range(1, n + 1)}
    return {"a.inp": INP + "*INCLUDE,INPUT=i1.inp\n"} | chain | {f"i{n+1}.inp": "*NSET,NSET=A\n1\n"}


# ---- Nastran ------------------------------------------------------------------------------------

BDF = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n"


def bdf(more):
    return {"a.bdf": "BEGIN BULK\n" + BDF + more + "ENDDATA\n"}


@case
def bdf_cards(n):
    return bdf(rows("FORCE,%(i)d,1,,1.,1.,0.,0.\n", n))


@case
def bdf_ranges(n):
    return bdf(rows("GRID,%(i)d,,5.,0.,0.\n", n, 5) + f"SPC1,1,123,1,THRU,{n}\n" * n)


@case
def bdf_continuations(n):
    return bdf("SPC1,1,123,1" + n * "\n+,1,2,3,4" + "\n")


@case
def bdf_points_with_more_fields(n):
    return bdf(rows("GRID,%(i)d,,5.,0.,0.,,123\n", n, 5))


@case
def bdf_properties(n):
    grids = "".join(f"GRID,{4*i+5},,{2*i+3}.,0.,0.\nGRID,{4*i+6},,{2*i+4}.,0.,0.\nGRID,{4*i+7},,{2*i+3}.,1.,0.\n"
                    f"GRID,{4*i+8},,{2*i+3}.,0.,1.\nCTETRA,{i+2},{i+2},{4*i+5},{4*i+6},{4*i+7},{4*i+8}\n" for i in range(n))
    return bdf(grids + rows("PSOLID,%(i)d,1\n", n))


@case
def bdf_includes(n):
    return bdf(rows("INCLUDE 'i%(i)d.bdf'\n", n))


@case
def bdf_comments(n):
    return bdf(n * "$ a comment\n")


# ---- Gmsh ---------------------------------------------------------------------------------------

MSH2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
NODES2 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
TET2 = "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n"
MSH4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
NODES4 = "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
TET4 = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n"


def msh_names(n):
    return f"$PhysicalNames\n{n}\n" + rows('3 %(i)d "g%(i)d"\n', n) + "$EndPhysicalNames\n"


def msh_strip(n, label="%(i)d", entity="%(i)d"):
    """n tets apart from each other, of groups and entities of their own."""
    nodes = "".join(f"{4*i+1} {2*i} 0 0\n{4*i+2} {2*i+1} 0 0\n{4*i+3} {2*i} 1 0\n{4*i+4} {2*i} 0 1\n" for i in range(n))
    tets = "".join(f"{i+1} 4 2 {label % {'i': i + 1}} {entity % {'i': i + 1}} {4*i+1} {4*i+2} {4*i+3} {4*i+4}\n"
                   for i in range(n))
    return f"$Nodes\n{4*n}\n{nodes}$EndNodes\n$Elements\n{n}\n{tets}$EndElements\n"


@case
def msh_names_without_elements(n):
    return {"a.msh": MSH2 + msh_names(n) + NODES2 + TET2}


@case
def msh_names_with_elements(n):
    return {"a.msh": MSH2 + msh_names(n) + msh_strip(n)}


@case
def msh_groups_of_one_entity(n):
    return {"a.msh": MSH2 + msh_names(n) + msh_strip(n, entity="1")}


@case
def msh_groups_of_one_tet(n):
    tets = rows("%(i)d 4 2 %(i)d 1 1 2 3 4\n", n)
    return {"a.msh": MSH2 + msh_names(n) + NODES2 + f"$Elements\n{n}\n{tets}$EndElements\n"}


@case
def msh_groups_of_one_point(n):
    points = rows("%(i)d 15 2 %(i)d 1 1\n", n, 2)
    return {"a.msh": MSH2 + NODES2 + f"$Elements\n{n+1}\n1 4 2 1 1 1 2 3 4\n{points}$EndElements\n"}


@case
def msh_tags(n):
    return {"a.msh": MSH2 + NODES2 + f"$Elements\n1\n1 4 {n} 1 1 " + "1 " * (n - 2) + "1 2 3 4\n$EndElements\n"}


@case
def msh_views_of_points(n):
    views = rows('$NodeData\n1\n"v%(i)d"\n1\n0\n3\n0\n1\n4\n1 1\n2 1\n3 1\n4 1\n$EndNodeData\n', n)
    return {"a.msh": MSH2 + NODES2 + TET2 + views}


@case
def msh_views_of_tets(n):
    views = rows('$ElementData\n1\n"v%(i)d"\n1\n0\n3\n0\n1\n1\n1 %(i)d\n$EndElementData\n', n)
    return {"a.msh": MSH2 + NODES2 + TET2 + views}


@case
def msh_views_without_all_values(n):
    views = rows('$NodeData\n1\n"v%(i)d"\n1\n0\n3\n0\n1\n1\n1 1\n$EndNodeData\n', n)
    return {"a.msh": MSH2 + NODES2 + TET2 + views}


@case
def msh_unknown_sections(n):
    return {"a.msh": MSH2 + NODES2 + TET2 + rows("$A%(i)d\n$EndA%(i)d\n", n)}


@case
def msh_periodic_2(n):
    links = rows("0 %(i)d 1\n1\n1 2\n", n)
    return {"a.msh": MSH2 + NODES2 + TET2 + f"$Periodic\n{n}\n{links}$EndPeriodic\n"}


@case
def msh_entities(n):
    entities = rows("%(i)d 0 0 0 1 1 1 1 %(i)d 0\n", n)
    return {"a.msh": MSH4 + msh_names(n) + f"$Entities\n0 0 0 {n}\n{entities}$EndEntities\n" + NODES4 + TET4}


@case
def msh_groups_of_an_entity(n):
    groups = " ".join(str(i) for i in range(1, n + 1))
    return {"a.msh": MSH4 + f"$Entities\n0 0 0 1\n1 0 0 0 1 1 1 {n} {groups} 0\n$EndEntities\n" + NODES4 + TET4}


@case
def msh_bounds_of_an_entity(n):
    bounds = " ".join(str(i) for i in range(1, n + 1))
    return {"a.msh": MSH4 + f"$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 1 {n} {bounds}\n$EndEntities\n" + NODES4 + TET4}


@case
def msh_blocks(n):
    nodes = "".join(f"3 {i+1} 0 4\n" + "".join(f"{4*i+k}\n" for k in (1, 2, 3, 4)) +
                    f"{2*i} 0 0\n{2*i+1} 0 0\n{2*i} 1 0\n{2*i} 0 1\n" for i in range(n))
    tets = "".join(f"3 {i+1} 4 1\n{i+1} {4*i+1} {4*i+2} {4*i+3} {4*i+4}\n" for i in range(n))
    return {"a.msh": MSH4 + f"$Nodes\n{n} {4*n} 1 {4*n}\n{nodes}$EndNodes\n$Elements\n{n} {n} 1 {n}\n{tets}$EndElements\n"}


@case
def msh_partitioned_entities(n):
    entities = rows("%(i)d 3 1 1 1 0 0 0 1 1 1 0 0\n", n, 2)
    return {"a.msh": MSH4 + "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n"
            f"$PartitionedEntities\n2\n0\n0 0 0 {n}\n{entities}$EndPartitionedEntities\n" + NODES4 + TET4}


@case
def msh_parts(n):
    n = n // 10
    part = lambda i: (MSH4 + f"$Nodes\n1 4 {4*i+1} {4*i+4}\n3 1 0 4\n" + "".join(f"{4*i+k}\n" for k in (1, 2, 3, 4)) +
                      f"{2*i} 0 0\n{2*i+1} 0 0\n{2*i} 1 0\n{2*i} 0 1\n$EndNodes\n"
                      f"$Elements\n1 1 {i+1} {i+1}\n3 1 4 1\n{i+1} {4*i+1} {4*i+2} {4*i+3} {4*i+4}\n$EndElements\n")
    return {"p_%d.msh": None} | {f"p_{i+1}.msh": part(i) for i in range(n)}


# ---- MEDIT --------------------------------------------------------------------------------------

MESH = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 1\n"


@case
def mesh_unknown_sections(n):
    return {"a.mesh": MESH + rows("Own%(i)d\n1\n1\n", n) + "End\n"}


@case
def mesh_labels(n):
    points = "".join(f"{2*i} 0 0 {i}\n{2*i+1} 0 0 {i}\n{2*i} 1 0 {i}\n{2*i} 0 1 {i}\n" for i in range(n))
    tets = "".join(f"{4*i+1} {4*i+2} {4*i+3} {4*i+4} {i+1}\n" for i in range(n))
    faces = "".join(f"{4*i+1} {4*i+2} {4*i+3} {i+1}\n" for i in range(n))
    return {"a.mesh": f"MeshVersionFormatted 2\nDimension 3\nVertices\n{4*n}\n{points}Tetrahedra\n{n}\n{tets}"
                      f"Triangles\n{n}\n{faces}End\n"}


@case
def mesh_edges_and_triangles_repeated(n):
    return {"a.mesh": MESH + f"Edges\n{n}\n" + "1 2 1\n" * n + f"Triangles\n{n}\n" + "1 2 3 1\n" * n + "End\n"}


@case
def mesh_required_vertices(n):
    return {"a.mesh": MESH + f"RequiredVertices\n{n}\n" + "1\n" * n + f"Corners\n{n}\n" + "2\n" * n + "End\n"}


@case
def mesh_normals(n):
    return {"a.mesh": MESH + f"Normals\n{n}\n" + "1 0 0\n" * n + f"NormalAtVertices\n{n}\n" + rows("1 %(i)d\n", n) + "End\n"}


# ---- VTK ----------------------------------------------------------------------------------------

VTU = ('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>%s'
       "</UnstructuredGrid></VTKFile>\n")
PIECE = ('<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" '
         'format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells><DataArray type="Int64" '
         'Name="connectivity" format="ascii">0 1 2 3</DataArray><DataArray type="Int64" Name="offsets" format="ascii">4'
         '</DataArray><DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>%s</Piece>')


@case
def vtu_arrays_of_tets(n):
    arrays = rows('<DataArray type="Float64" Name="x%(i)d" format="ascii">1.5</DataArray>\n', n)
    return {"a.vtu": VTU % (PIECE % f"<CellData>{arrays}</CellData>")}


@case
def vtu_arrays_of_integers(n):
    arrays = rows('<DataArray type="Int32" Name="x%(i)d" format="ascii">1</DataArray>\n', n)
    return {"a.vtu": VTU % (PIECE % f"<CellData>{arrays}</CellData>")}


@case
def vtu_arrays_of_points(n):
    arrays = rows('<DataArray type="Float64" Name="x%(i)d" format="ascii">1 2 3 4.5</DataArray>\n', n)
    return {"a.vtu": VTU % (PIECE % f"<PointData>{arrays}</PointData>")}


@case
def vtu_arrays_of_one_name(n):
    arrays = n * '<DataArray type="Float64" Name="x" format="ascii">1.5</DataArray>\n'
    return {"a.vtu": VTU % (PIECE % f"<CellData>{arrays}</CellData>")}


@case
def vtu_arrays_of_words(n):
    arrays = rows('<DataArray type="String" Name="x%(i)d" format="ascii">1</DataArray>\n', n)
    return {"a.vtu": VTU % (PIECE % f"<CellData>{arrays}</CellData>")}


@case
def vtu_pieces(n):
    return {"a.vtu": VTU % (n // 5 * (PIECE % "<PointData/><CellData/>"))}


@case
def vtu_pieces_with_arrays_of_their_own(n):
    piece = PIECE % '<CellData><DataArray type="Float64" Name="x%(i)d" format="ascii">1</DataArray></CellData>'
    return {"a.vtu": VTU % rows(piece, n // 5)}


@case
def vtu_empty_pieces(n):
    return {"a.vtu": VTU % (PIECE % "" + n * '<Piece NumberOfPoints="0" NumberOfCells="0"/>')}


@case
def vtu_elements_of_xml(n):
    return {"a.vtu": VTU % (PIECE % "" + 20 * n * "<a/>")}


@case
def vtu_elements_within_another(n):
    return {"a.vtu": VTU % (PIECE % "" + 5 * n * "<a>" + 5 * n * "</a>")}


@case
def vtu_attributes(n):
    return {"a.vtu": (VTU % (PIECE % "")).replace("<UnstructuredGrid>", "<UnstructuredGrid" + rows(' a%(i)d="1"', n) + ">")}


@case
def vtu_comments(n):
    return {"a.vtu": VTU % (PIECE % "" + n * "<!-- x -->")}


@case
def vtu_packed_elements_of_xml(n):
    return {"a.vtu.gz": gzip.compress((VTU % (PIECE % "" + 300 * n * "<a/>")).encode(), 9)}


@case
def pvtu_parts(n):
    n = n // 20
    place = lambda i: f"{2*i} 0 0 {2*i+1} 0 0 {2*i} 1 0 {2*i} 0 1"
    parts = {f"p{i}.vtu": VTU % (PIECE % "").replace("0 0 0 1 0 0 0 1 0 0 0 1", place(i)) for i in range(1, n + 1)}
    return {"a.pvtu": '<VTKFile type="PUnstructuredGrid" version="0.1"><PUnstructuredGrid GhostLevel="0">' +
            rows('<Piece Source="p%(i)d.vtu"/>', n) + "</PUnstructuredGrid></VTKFile>\n"} | parts


VTK = ("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n"
       "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n")


@case
def vtk_scalars(n):
    return {"a.vtk": VTK + "CELL_DATA 1\n" + rows("SCALARS x%(i)d double 1\nLOOKUP_TABLE default\n1.5\n", n)}


@case
def vtk_fields(n):
    return {"a.vtk": VTK + f"POINT_DATA 4\nFIELD FieldData {n}\n" + rows("x%(i)d 1 4 double\n1 2 3 4.5\n", n)}


@case
def vtk_field_blocks(n):
    return {"a.vtk": VTK + "CELL_DATA 1\n" + rows("FIELD f%(i)d 1\nx%(i)d 1 1 double\n1.5\n", n)}


@case
def vtk_arrays_not_kept(n):
    return {"a.vtk": VTK + f"CELL_DATA 1\nFIELD FieldData {n}\n" + rows("x%(i)d 1 2 double\n1 2\n", n)}


@case
def vtk_tables(n):
    return {"a.vtk": VTK + "CELL_DATA 1\n" + rows("LOOKUP_TABLE t%(i)d 1\n0 0 0 0\n", n)}


# ---- Other solvers ------------------------------------------------------------------------------

SU2 = "NDIME= 3\nNELEM= 1\n10 0 1 2 3 0\nNPOIN= 4\n0 0 0 0\n1 0 0 1\n0 1 0 2\n0 0 1 3\n"


@case
def su2_markers(n):
    return {"a.su2": SU2 + f"NMARK= {n}\n" + rows("MARKER_TAG= m%(i)d\nMARKER_ELEMS= 1\n5 0 1 2\n", n)}


@case
def su2_markers_of_a_name_alike(n):
    return {"a.su2": SU2 + f"NMARK= {n}\n" + "".join(f"MARKER_TAG= m{' ' * (i % 40)}{i}\nMARKER_ELEMS= 1\n5 0 1 2\n"
                                                   for i in range(n))}


@case
def su2_keywords(n):
    return {"a.su2": SU2 + "NMARK= 0\n" + rows("K%(i)d= 1\n", n)}


VOL = ("mesh3d\ndimension\n3\n\nsurfaceelements\n%d\n%s\nvolumeelements\n1\n1 4 1 2 3 4\n\npoints\n4\n0 0 0\n1 0 0\n"
       "0 1 0\n0 0 1\n%s\nendmesh\n")


@case
def vol_names(n):
    return {"a.vol": VOL % (n, rows("%(i)d %(i)d 1 0 3 1 2 3\n", n), f"\nbcnames\n{n}\n" + rows("%(i)d b%(i)d\n", n))}


@case
def vol_unknown_sections(n):
    return {"a.vol": VOL % (0, "", rows("s%(i)d\n1\n", n))}


@case
def vol_edges(n):
    return {"a.vol": VOL % (0, "", f"edgesegmentsgi2\n{n}\n" + n * "1 0 1 2 0 0 1 1 1 0 1 0\n")}


@case
def vol_point_elements(n):
    return {"a.vol": VOL % (0, "", f"pointelements\n{n}\n" + rows("1 %(i)d\n", n) +
                            f"identifications\n{n}\n" + rows("1 2 %(i)d\n", n))}


@case
def elmer_names(n):
    return {"mesh.header": "4 1 %d\n2\n504 1\n303 %d\n" % (n, n),
            "mesh.nodes": "1 -1 0 0 0\n2 -1 1 0 0\n3 -1 0 1 0\n4 -1 0 0 1\n", "mesh.elements": "1 1 504 1 2 3 4\n",
            "mesh.boundary": rows("%(i)d %(i)d 1 0 303 1 2 3\n", n),
            "mesh.names": "! ----- names for boundaries -----\n" + rows("$ b%(i)d = %(i)d\n", n)}


@case
def tetgen_attributes(n):
    corners = "".join(f"{i} {x} {y} {z}" + " 1" * 9 + "\n" for i, (x, y, z) in
                      enumerate(((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))))
    return {"a.ele": "1 4 0\n0 0 1 2 3\n",
            "a.node": f"{n + 4} 3 9 0\n{corners}" + rows("%(i)d 0 0 5" + " 1" * 9 + "\n", n, 4)}


@case
def tetgen_markers(n):
    return {"a.ele": "1 4 0\n0 0 1 2 3\n", "a.node": "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n",
            "a.face": f"{n} 1\n" + rows("%(i)d 0 1 2 %(i)d\n", n), "a.edge": f"{n} 1\n" + rows("%(i)d 0 1 %(i)d\n", n)}


# ---- Other formats get what one had -------------------------------------------------------------

def converted(source, extension):
    def files(n):
        return CASES[source](n)
    files.output = extension
    return files


for extension in (".mesh", ".vtk", ".vtu", ".inp", ".bdf", ".su2", ".vol", ".header", ".ele"):
    CASES["msh_names_with_elements to " + extension] = converted("msh_names_with_elements", extension)
for extension in (".msh", ".vol", ".header", ".inp"):
    CASES["mesh_edges_and_triangles_repeated to " + extension] = converted("mesh_edges_and_triangles_repeated", extension)
for extension in (".msh", ".vtu", ".bdf", ".su2", ".header"):
    CASES["inp_elset_each_of_another_element to " + extension] = converted("inp_elset_each_of_another_element", extension)
    CASES["inp_elset_around_one_element to " + extension] = converted("inp_elset_around_one_element", extension)
    CASES["inp_nset_each_of_another_node to " + extension] = converted("inp_nset_each_of_another_node", extension)
for extension in (".msh", ".mesh", ".vtk", ".inp"):
    CASES["vtu_arrays_of_tets to " + extension] = converted("vtu_arrays_of_tets", extension)


# ---- Runs ---------------------------------------------------------------------------------------

def run(folder, command):
    """Seconds of the processor, bytes of memory at most, status, what it said."""
    with open(folder / ".said", "w+") as said:
        process = subprocess.Popen([PROGRAM, *command], cwd=folder, stdout=subprocess.DEVNULL, stderr=said,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS)))
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, process.returncode, said.read(300)


def write(folder, files):
    size = 0
    for name, content in files.items():
        if content is None:
            continue
        content = content.encode() if isinstance(content, str) else content
        (folder / name).write_bytes(content)
        size += len(content)
    return size


def commands_of(first, make):
    if first.startswith("p_"):
        return [["quality", first], ["convert", first, "o_%d.msh", "--pieces", "2"]]
    extension = getattr(make, "output", None)
    output = "o" + extension if extension else re.sub(r"^(a|mesh)(?=\.)", "o", first)
    if first.endswith(".pvtu"):
        output = "o.vtu"
    return [["convert", first, output], ["improve", first, "-o", output, "-q"]]


def trial(name):
    """What is wrong; empty: nothing."""
    folder = Path(tempfile.mkdtemp(prefix="tetmend-proportion-"))
    wrong = []
    try:
        for command_number in range(2):
            measured = []
            for n in (SMALL, 10 * SMALL):
                inside = folder / f"{n}-{command_number}"
                inside.mkdir()
                files = CASES[name](n)
                size = write(inside, files)
                command = commands_of(next(iter(files)), CASES[name])[command_number]
                measured.append((*run(inside, command), size))
            (time1, memory1, status1, _, size1), (time2, memory2, status2, said, size2) = measured
            what = f"{name}: {command[0]}: "
            print(f"{what:70}{size2 / 1e6:6.2f} MB {time1:6.2f} s {time2:6.2f} s {memory2 / 1e6:6.0f} MB "
                  f"{(memory2 - BASE[1]) / size2:6.1f} bytes a byte, status {status2}", flush=True)
            if status2 < 0 or status1 != status2:
                wrong.append(f"{what}status {status1} and {status2}: {said}")
            if status2 not in (0, 3) and not name.endswith("packed_elements_of_xml"):
                wrong.append(f"{what}status {status2}: {said}")
            most_time = MOST_GROWTH * max(time1 - BASE[0], 0.02)
            if time2 - BASE[0] > most_time:
                wrong.append(f"{what}{time1:.2f} s, and for ten times as much {time2:.2f} s")
            # What is packed is unpacked to 8 MB at most, or 200 times the file.
            size2 = max(size2, 8 << 20) if ".gz" in command[1] else size2
            if memory2 - BASE[1] > FREE_BYTES + MOST_BYTES * size2:
                wrong.append(f"{what}{(memory2 - BASE[1]) / size2:.0f} bytes of memory for each byte of the files")
        return wrong
    finally:
        shutil.rmtree(folder)


def base():
    folder = Path(tempfile.mkdtemp(prefix="tetmend-proportion-"))
    write(folder, {"a.mesh": MESH + "End\n"})
    measured = [run(folder, ["improve", "a.mesh", "-o", "o.mesh", "-q"]) for _ in range(3)]
    shutil.rmtree(folder)
    return min(each[0] for each in measured), min(each[1] for each in measured)


BASE = base()
failures = []
for name in CASES:
    if ONLY and not any(word in name for word in ONLY):
        continue
    wrong = trial(name)
    # Another program may have slowed this one down: what is wrong is wrong twice.
    if wrong:
        wrong = trial(name)
    for what in wrong:
        print("FAIL:", what, flush=True)
    failures += wrong
sys.exit(1 if failures else 0)
