// SPDX-License-Identifier: MIT
// Reading and writing of tetrahedral mesh files; the format follows from the extension.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend {

/// One row for each file format, for `--help` and for error messages.
struct MeshFormat {
  std::string_view name;       ///< "MEDIT ASCII"
  std::string_view extension;  ///< ".mesh"
};

/// All formats of this build, in the order in which help lists them. Those that a build may lack, .med, .cgns
/// and .xdmf, are known by their extensions all the same, and the error of reading or writing says so.
std::span<const MeshFormat> mesh_formats();

/// Reads a mesh. `.mesh` and `.meshb` are MEDIT, `.node` or `.ele` a TetGen pair (with `.face` and
/// `.edge` beside it when present), `.vtk` legacy VTK, ASCII or binary, of version 1.0 to 5.1,
/// `.vtu` VTK XML, `.msh` Gmsh, ASCII or binary, of version 2.2 or 4.1, `.inp` a deck of Abaqus or
/// CalculiX, `.su2` SU2, `.vol` Netgen, `.bdf` or `.nas` Nastran, `.header` a folder of Elmer,
/// `.unv` I-DEAS universal, `.mfem` MFEM, as `.mesh` may be, `.k` or `.key` LS-DYNA, `.feb` FEBio,
/// `.med` MED of Salome, `.e`, `.exo` or `.g` Exodus II, `.cgns` CGNS, `.xdmf` XDMF with its tables beside it.
/// What the file holds beyond MeshData is named in its `notes`, and so are degenerate elements, see
/// formats/degenerate.h. Volume elements that cannot be kept are an error.
/// @param label_array the array of cells that holds the labels; empty: the one with a name that
/// mesh tools use, else the only one of integers if it has few different ones
/// @throws Error for a missing, empty or truncated file and for an unknown extension (with the
/// valid ones). Also for wrong content: a wrong count, or one that cannot fit into the file (before
/// memory is taken for it); a vertex number out of range; text in a number; a coordinate that is not
/// finite; a label beyond 32 bits. The message begins with
/// "FILE:LINE: " (ASCII) or "FILE: byte N: " (binary) when it is about the content, and has the
/// offending word and what was expected.
/// Cost: linear in the size of the file, which is held in memory while it is read.
MeshData read_mesh(const std::filesystem::path& file, const std::string& label_array = {});

/// Where in the file tet number `tet` (from 0, as in MeshData) stands: "FILE:LINE" (ASCII) or
/// "FILE: byte N" (binary), for a message about what BuildError found. Reads the file again.
/// @throws Error as read_mesh().
std::string locate_tet(const std::filesystem::path& file, std::size_t tet);

/// What of `mesh` the format of `file` cannot hold, one sentence each; empty: it holds all.
/// @param variant one of mesh_variants(), or empty
/// @throws Error for an unknown extension
std::vector<std::string> not_written(const std::filesystem::path& file, const MeshData& mesh,
                                     std::string_view variant = {});

/// What is not lost, but which programs cannot read, one sentence each. @throws Error likewise
std::vector<std::string> remarks_on_writing(const std::filesystem::path& file, const MeshData& mesh,
                                            std::string_view variant = {});

/// The names of the ways in which the format of `file` can be written, MeshView::variant(); empty if
/// there is only one.
std::span<const std::string_view> mesh_variants(const std::filesystem::path& file);

/// The files that a mesh under this name is, `file` first; only that one if the extension is unknown.
/// Not all of them need be there.
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& file);

/// The files that read_mesh() opens: mesh_files(), and what a deck includes. Nothing is said where
/// they cannot be read. Cost: that of reading a deck; else none.
std::vector<std::filesystem::path> source_files(const std::filesystem::path& file);

/// The name of the format of `file` in mesh_formats(), with ".gz" if it is packed; empty: none.
std::string format_name(const std::filesystem::path& file);

/// Writes a mesh in the format of the extension. A TetGen path (`.node` or `.ele`) writes `.node`,
/// `.ele` and `.face`, and `.edge` if there are edges or an older such file; that of Elmer (`.header`) its
/// folder. Doubles are written so
/// that reading gives the same bits. Required vertices: see docs/formats.md. A mesh of MFEM
/// stays one as `.mesh`. `.msh` has the version and coding that `variant` of the data names, else 4.1 binary. A file appears
/// under its name only when complete, see PendingFile, so a failure leaves an older file untouched,
/// and of several files all.
/// Precondition: vertex numbers are in range, coordinates finite, and `point_labels` is empty or
/// has one for each point.
/// @throws Error when the file cannot be written, with the reason of the operating system, or when
/// the extension is unknown.
void write_mesh(const std::filesystem::path& file, const MeshData& mesh);
/// The same for what a view shows: write_mesh(file, MeshView(tet_mesh)) needs no copy of the mesh.
void write_mesh(const std::filesystem::path& file, const MeshView& mesh);

}  // namespace tetmend
