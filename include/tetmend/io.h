// SPDX-License-Identifier: MIT
// Meshes from files and to files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/mesh.h>

namespace tetmend {

/// Reads a mesh; the format follows from the extension, see file_formats(). Mesh::notes() names what
/// of the file is not kept. Volume elements that cannot be kept are an error. Topology is not looked
/// at.
/// @param threads 1 to 1024; the result is the same for every number
/// @throws Error "FILE:LINE: reason" (text) or "FILE: byte N: reason" (binary) for what is wrong in
/// the file; "FILE: reason" when it cannot be read or its extension is unknown.
/// Cost: linear in the size of the file, which is held in memory meanwhile.
/// @param label_array the array over cells that holds their labels; empty: the one with a name that
/// mesh tools use, else the only one of integers if few of them differ
TETMEND_API Mesh load(const std::filesystem::path& file, int threads = 1,
                      const std::string& label_array = {});

/// Writes a mesh; coordinates keep all their bits. The file appears under its name only when it is
/// complete: a failure leaves an older file as it was.
/// @param variant for `.msh`: "2.2 ASCII", "2.2 binary", "4.1 ASCII" or "4.1 binary"; empty: as the
/// mesh was read, else 4.1 binary
/// @throws Error "FILE: reason" when it cannot be written, or the extension or the variant is
/// unknown.
TETMEND_API void save(const std::filesystem::path& file, const Mesh& mesh, int threads = 1,
                      const std::string& variant = {});
/// The variants of the format of `file`; empty if there is only one.
TETMEND_API std::vector<std::string_view> file_variants(const std::filesystem::path& file);

/// What of the mesh the format of `file` cannot hold, one sentence each; empty: save() keeps all.
/// @throws Error "FILE: reason" when the extension is unknown
TETMEND_API std::vector<std::string> not_saved(const std::filesystem::path& file, const Mesh& mesh,
                                               const std::string& variant = {});

/// What save() keeps in a form that not all programs read, one sentence each; empty: nothing.
/// @throws Error likewise
TETMEND_API std::vector<std::string> remarks_on_saving(const std::filesystem::path& file,
                                                       const Mesh& mesh,
                                                       const std::string& variant = {});

/// A format, by one of its extensions.
struct FileFormat {
  std::string_view name;       ///< "MEDIT ASCII"
  std::string_view extension;  ///< ".mesh"
};

/// All that load() and save() know, one row for each extension.
TETMEND_API std::vector<FileFormat> file_formats();

}  // namespace tetmend
