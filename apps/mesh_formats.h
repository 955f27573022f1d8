// SPDX-License-Identifier: MIT
// Meshes that one file is, and those that several are or that all ranks read together.
#pragma once

#include <filesystem>
#include <string>

#include <tetmend/mesh.h>

#include "apps/files.h"
#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"
#include "pieces/rank_share.h"

namespace tetmend::apps {

/// What commands do with the names of IN and OUT before they read.
/// @param known formats that all ranks read and write together; null: none
/// @throws UsageError for an extension of no format, and a variant that OUT does not have; Error when
/// IN is not there or a trace, and when it is known already that OUT cannot be written
void check_formats(const std::filesystem::path& input, const std::filesystem::path& output,
                   const CarryOptions& carry, const pieces::ArrayFiles* known);

/// What commands do with the name of a mesh that they only read. @throws UsageError, Error likewise
void check_input_format(const std::filesystem::path& input, const pieces::ArrayFiles* known);

/// What is said of meshes in parts where formats are listed.
std::string parts_help();

/// A mesh of one file, or of all its parts: their points, tets and constraints one part after another.
/// What of parts is not kept is in its notes.
/// @throws Error as read_mesh(), and where parts do not fit
MeshData read_whole(const std::filesystem::path& file, const pieces::ArrayFiles* known);
/// The same for the library. A mesh in parts has no file(): see in_parts().
Mesh load_whole(const std::filesystem::path& file, int threads, const pieces::ArrayFiles* known);
/// build_tet_mesh() of what read_whole() gave, in the order of the file.
TetMesh build_whole(const std::filesystem::path& file, MeshData data, BuildReport* report,
                    const pieces::ArrayFiles* known);

/// What the library says of a mesh in parts names no file: calls `work`, and puts that name before what
/// it throws, unless it is about an option.
template <class Work>
auto in_parts(const std::filesystem::path& file, const pieces::ArrayFiles* known,
              const Work& work) {
  try {
    return work();
  } catch (const OptionError&) {
    throw;
  } catch (const Error& error) {
    if (known == nullptr || !known->is_one(file)) throw;
    throw Error(file.string() + ": " + error.what());
  }
}

}  // namespace tetmend::apps
