# SPDX-License-Identifier: MIT
"""Where fuzzing begins: small sound inputs for each target, made from what the repository has."""

import random
import re
import struct
import subprocess
import tempfile
from pathlib import Path

# Two tets of two regions with named triangles, an edge, a required vertex.
TINY = """MeshVersionFormatted 2
Dimension 3
Vertices 5
0 0 0 1
1 0 0 2
0 1 0 0
0 0 1 0
1 1 1.25 7
Tetrahedra 2
1 2 3 4 3
2 3 4 5 4
Triangles 2
2 3 4 9
1 2 3 8
Edges 1
1 2 5
RequiredVertices 1
5
End
"""
# The same with edges that have nodes in their middle.
CURVED = """MeshVersionFormatted 2
Dimension 3
Vertices 10
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
0.5 0 0 0
0.5 0.55 0 0
0 0.5 0 0
0 0 0.5 0
0.5 0 0.5 0
0 0.5 0.5 0
TetrahedraP2 1
1 2 3 4 5 6 7 8 9 10 1
End
"""

OPTIONS = [
    "protect label:1\nonly label:2,3\n", "protect box:0,0,0,1,1,1\ntets 10%\n", "tets 500\nkeep_size\n",
    "min 35\nmax 145\nmeasure sine\n", "schedule thorough\nset cycles=2\nthreads 2\n", "schedule polish\nignore_interior\n",
    "trace_around 3,2\ntrace_operator smoothing\ntrace_depth 2\ntrace_limit 5000\n", "trace_around 0.5,0.5,1,2\nconserve T\n",
]

PLUGIN = b"\0\1my_operator\nwhat it does\nsteps 0 1 100 8 number of steps\nflag 2 0 1 0 on or off\nshare 1 0 1 0.5 of it\n"

SCRIPTS = [
    "smooth{}\n", "local rounds = parameter{'rounds', default = 3, low = 1, high = 9, help = 'so many'}\n"
    "for i = 1, rounds do begin_round(i); local_reconnection{} if not is_progress() then break end end\n",
    "apply{'edge_split', on = {below = 0.4}}\nlog(quality().bad)\n", "insert_points{} suppress_points{} polish{}\n",
    "local t = {3, 1, 2} table.sort(t) log(string.format('%d %s', t[1], 'x'))\n",
    "compose = first{'smoothing', sequence{'edge_split', 'smoothing'}}\napply(compose)\n",
    "run_schedule('shell')\n", "while true do end\n", "local s = 'x' while true do s = s .. s end\n",
]


# Whose files of HDF5 are text here: build/checked/fuzz/write_tree writes them.
OF_HDF5 = ["med", "cgns", "xdmf"]


def formats(build, extension, folder):
    """Files of an extension, one for each variant."""
    program = build / "bin" / "tetmend"
    help_text = subprocess.run([program, "convert", "--help"], capture_output=True, text=True).stdout
    meshes = []
    for name, text in (("tiny", TINY), ("curved", CURVED)):
        (folder / f"{name}.mesh").write_text(text)
        out = folder / name / f"in.{extension}"  # an XDMF file says what its tables are called
        out.parent.mkdir()
        variants = [None]
        if extension == "msh":
            variants = re.findall(r"'([24]\.[12] \w+)'", help_text)
        elif extension in ("vtk", "vtu"):
            variants = ["ASCII", "binary"]
        for variant in variants:
            command = [build / "fuzz" / "write_tree"] if extension in OF_HDF5 else [program, "convert"]
            command += [folder / f"{name}.mesh", out]
            command += ["--variant", variant] if variant else []
            if subprocess.run(command, capture_output=True).returncode == 0:
                meshes.append(collect(out, name))
    return meshes


# What a format of several files is made of, by the ending of each.
PARTS = {"node": ["node", "ele", "face", "edge"], "header": ["header", "nodes", "elements", "boundary", "names"],
         "xdmf": ["xdmf", "h5"]}


def collect(out, name):
    """One input of the files of a mesh: before each a line "==== NAME"."""
    kinds = PARTS.get(out.suffix[1:])
    if kinds is None:
        return out.read_bytes()
    whole = b""
    for kind in kinds:
        part = out.with_suffix("." + kind) if kind != "names" else out.with_suffix(".names")
        if part.exists():
            whole += f"==== in.{kind}\n".encode() + part.read_bytes()
            part.unlink()
    return whole


def seeds(target, build, source):
    """The contents of the first inputs of a target."""
    lessons = source / "assets" / "lessons"
    chance = random.Random(1)
    if target == "trace":
        return [file.read_bytes() for file in sorted(lessons.glob("*.trace"))]
    if target == "trace_events":
        return [subprocess.run([build / "fuzz" / "unpack_trace", file], capture_output=True, check=True).stdout
                for file in sorted(lessons.glob("*.trace"))]
    if target == "lesson":
        return [file.read_bytes() for file in sorted(lessons.glob("*.json"))]
    if target == "schedule":
        shipped = [file.read_bytes() for file in sorted((source / "assets" / "schedules").glob("*.lua"))]
        return shipped + [script.encode() for script in SCRIPTS]
    if target == "options":
        return [text.encode() for text in OPTIONS]
    if target == "plugin":
        return [PLUGIN]
    if target == "parameters":
        return [bytes([mesh, op, 0]) + struct.pack("<d", value)
                for mesh in range(0, 40, 5) for op in range(12) for value in (0, 0.5, 3)]
    if target == "checkpoint":  # file, how, where it is cut, changes
        return [bytes([file, how]) + bytes(chance.randrange(256) for _ in range(2 + 3 * changes))
                for file in range(7) for how in range(4) for changes in (0, 1, 5)]
    if target == "improve":
        return [bytes(chance.randrange(256) for _ in range(size)) for size in range(8, 200, 4)]
    with tempfile.TemporaryDirectory() as folder:
        return formats(build, target, Path(folder))


WORDS = {
    "schedule": "smooth local_reconnection insert_points suppress_points polish apply attempt first sequence quality measure goal "
                "judge_by limit is_progress operators log parameter description begin_round run_schedule on below above "
                "smoothing edge_split edge_contraction table.sort table.concat string.format string.rep pairs ipairs "
                "math.huge while do end for function return local if then error tostring select",
    "options": "protect only tets conserve measure schedule min max keep_size ignore_interior threads trace_around "
               "trace_operator trace_depth trace_limit trace_piece set label: box: shell thorough quick stellar grummp polish "
               "conservative table2 nan inf 1e308 -1 18446744073709551616",
    "lesson": "title mesh trace steps at text",
    "mesh": "MeshVersionFormatted Dimension Vertices Tetrahedra Triangles Edges RequiredVertices Corners Ridges End Prisms "
            "Hexahedra Pyramids Quadrilaterals TetrahedraP2 TrianglesP2 EdgesP2 Normals NormalAtVertices Tangents 4294967297",
    "vtk": "DATASET UNSTRUCTURED_GRID POINTS CELLS CELL_TYPES POINT_DATA CELL_DATA SCALARS LOOKUP_TABLE FIELD VECTORS OFFSETS "
           "CONNECTIVITY METADATA vtktypeint64 float double int ASCII BINARY",
    "vtu": "VTKFile UnstructuredGrid Piece NumberOfPoints NumberOfCells DataArray Points Cells PointData CellData type format ascii "
           "appended binary offset encoding base64 raw compressor vtkZLibDataCompressor vtkLZ4DataCompressor UInt64 header_type Float64 Int64",
    "msh": "$MeshFormat $EndMeshFormat $PhysicalNames $Entities $Nodes $Elements $Periodic $NodeData $ElementData "
           "$PartitionedEntities $ParametricNodes 2.2 4.1",
    "inp": "*NODE *ELEMENT *NSET *ELSET *SURFACE *INCLUDE *END *PART *ASSEMBLY *INSTANCE INSTANCE= PART= TYPE=C3D4 TYPE=C3D10 TYPE=C3D6 GENERATE "
           "ELSET= NSET= NAME= TYPE=ELEMENT S1 S2",
    "su2": "NDIME= NELEM= NPOIN= NMARK= MARKER_TAG= MARKER_ELEMS= NZONE= NCHUNK=",
    "vol": "mesh3d dimension geomtype surfaceelements volumeelements points edgesegmentsgi2 pointelements materials bcnames "
           "cd2names identifications endmesh",
    "bdf": "GRID GRID* CTETRA CTETRA* CTRIA3 CPENTA CHEXA CPYRAM PSOLID SET BEGIN BULK ENDDATA CORD2R CORD1C GRDSET INCLUDE PLOAD4",
    "unv": "-1 2411 781 15 2412 780 2467 2477 2452 2435 2430 164 2420 111 118 91 92 21 24 11 1.0D+00",
    "mfem": "MFEM mesh v1.0 v1.3 dimension elements attribute_sets boundary bdr_attribute_sets vertices nodes mfem_mesh_end "
            "FiniteElementSpace FiniteElementCollection: H1_3D_P2 H1_3D_P1 VDim: Ordering:",
    "k": "*KEYWORD LONG=Y I10=Y *NODE *ELEMENT_SOLID *ELEMENT_SHELL *PART *SET_SOLID _TITLE _GENERATE *SET_NODE_LIST "
         "*SET_SEGMENT *BOUNDARY_SPC_NODE *INCLUDE *END",
    "e": "CDF num_nodes num_elem num_el_blk num_dim len_name connect1 elem_type TETRA coordx eb_prop1 ss_prop1 side_ss1 elem_ss1 "
         "node_ns1 ns_names eb_names elem_num_map node_num_map vals_nod_var1 name_nod_var vals_elem_var1eb1 time_step",
    "med": "ENS_MAA FAS CHA NOE MAI TE4 T10 TR3 SE2 NOD FAM NUM COO NOM GRO MED_NO_PROFILE_INTERNAL PFL NGA NCO TYP i32 i64 f64",
    "cgns": "CGNSBase_t Zone_t ZoneType_t Unstructured GridCoordinates_t CoordinateX DataArray_t Elements_t ElementRange "
            "ElementConnectivity ZoneBC_t BC_t PointList PointRange GridLocation_t FaceCenter Vertex FlowSolution_t Family_t "
            "Ordinal_t i32 i64 f64",
    "xdmf": "Xdmf Domain Grid Topology Geometry Attribute DataItem TopologyType Tetrahedron Triangle Mixed GeometryType XYZ X_Y_Z "
            "Format HDF XML Binary Dimensions NumberType Center Cell Node Collection Temporal in.h5:/",
    "feb": "febio_spec Mesh Geometry Nodes node Elements elem type= name= id= mat= tet4 tet10 hex8 tri3 tri6 quad4 Surface "
           "NodeSet ElementSet MeshDomains MeshData ElementData",
}


def words(target):
    """The dictionary of a target, as libFuzzer wants it."""
    return "".join(f'"{word}"\n' for word in WORDS.get(target, "").split())
