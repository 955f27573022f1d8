// SPDX-License-Identifier: MIT
// The part of a mesh that a command works on, and the constraints inside it that it ignores.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "kernel/tet_mesh.h"

namespace CLI {
class App;
}

namespace tetmend::apps {

/// What the user asked for. A SPEC is `label:1,4` or `box:x0,y0,z0,x1,y1,z1`; see --help.
struct RegionOptions {
  std::vector<std::string> protect;  ///< SPECs of tets that stay as they are
  std::vector<std::string> only;     ///< if there are any: SPECs of all others
  bool ignore_interior = false;

  InteriorConstraints interior() const {
    return ignore_interior ? InteriorConstraints::dropped : InteriorConstraints::kept;
  }
};

/// Adds --protect, --only and --ignore-interior.
void add_region_options(CLI::App& command, RegionOptions& options);

/// What the help says of a SPEC, for the end of a command's help.
std::string region_help();

/// @throws UsageError with the valid forms when a SPEC has none of them.
void check_regions(const RegionOptions& options);

/// What protect_regions() did.
struct ProtectedPart {
  bool asked_for = false;
  std::size_t tets = 0;
  std::size_t bad_tets = 0;  ///< of them
};

/// Freezes what the options protect.
/// @throws Error that names the SPEC when no tet has one of its labels or lies in its box.
ProtectedPart protect_regions(TetMesh& mesh, const RegionOptions& options);

nlohmann::json to_json(const ProtectedPart& part);

}  // namespace tetmend::apps
