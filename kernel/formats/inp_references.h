// SPDX-License-Identifier: MIT
// What the lines of an Abaqus deck that are kept word for word say of its mesh.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "kernel/formats/inp_mesh.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {

struct InpReferences {
  std::vector<std::uint32_t> points;  ///< that are named by number, in ascending order
  std::set<std::string> names;        ///< all words, as inp_key() has them
};

InpReferences find_references(const std::vector<const InpBlock*>& kept, const InpMesh& mesh);

/// Of these points and of those of the sets, the ones that must be kept: points inside the mesh that
/// are named by number, or that are in a set which holds no tet around them wholly.
std::vector<std::uint32_t> points_to_keep(const InpMesh& mesh, const InpSets& sets,
                                          const std::vector<std::uint32_t>& points);

}  // namespace tetmend::formats
