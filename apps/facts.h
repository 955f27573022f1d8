// SPDX-License-Identifier: MIT
// Facts about one mesh or two, as `tetmend check` prints them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "kernel/mesh_data.h"

namespace tetmend::apps {

/// What was looked at, and whether it holds.
struct Fact {
  std::string name;  ///< for programs
  bool holds = true;
  std::string text;  ///< for people
  nlohmann::json value;
  nlohmann::json wanted;
};

Fact at_least(std::string name, std::string_view what, double value, double wanted);
Fact at_most(std::string name, std::string_view what, double value, double wanted);
/// In exact arithmetic. `allowed`: so many there were before.
Fact no_inverted(const MeshData& mesh, std::size_t allowed = 0);

/// Faces of one tet only that no triangle of the file has: solvers want a boundary condition on each.
Fact no_bare_boundary(const MeshData& mesh);

/// What an improved mesh must have in common with the mesh that it came from, and that it is no
/// worse. Looks at the files alone: it knows nothing of the run.
/// @throws Error when one of them cannot be read or is no mesh
std::vector<Fact> compare_meshes(const std::filesystem::path& file,
                                 const std::filesystem::path& improved, int threads);

}  // namespace tetmend::apps
