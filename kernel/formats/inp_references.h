// SPDX-License-Identifier: MIT
// What the lines of an Abaqus deck that are kept word for word say of its mesh.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_mesh.h"

namespace tetmend::formats {

/// A point that a block names by its number.
struct InpReference {
  std::uint32_t point = 0;
  const InpBlock* block = nullptr;
};

struct InpReferences {
  std::vector<InpReference> points;  ///< in the order of the deck
  std::set<std::string> names;       ///< all words, as inp_key() has them
};

/// Of each keyword only the fields that are nodes count; of an unknown one all that could be.
InpReferences find_references(const InpLines& lines, const std::vector<const InpBlock*>& kept,
                              const InpMesh& mesh);

/// False for a keyword whose fields are not known: all that could be nodes counts.
bool inp_knows_nodes_of(const InpBlock& block);

}  // namespace tetmend::formats
