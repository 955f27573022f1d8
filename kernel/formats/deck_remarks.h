// SPDX-License-Identifier: MIT
// What a deck makes of the mesh in it.
#pragma once

#include <string>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// What the user should know of a deck though nothing of it is lost, one sentence each: which of
/// its lines keep how many points of the mesh where they are. Empty for a mesh of no deck.
std::vector<std::string> deck_remarks(const MeshData& mesh);

}  // namespace tetmend
