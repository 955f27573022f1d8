// SPDX-License-Identifier: MIT
// From the blocks of an Abaqus deck to the pieces of MeshData::deck.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/formats/inp_faces.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_mesh.h"
#include "kernel/formats/inp_parts.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {

/// Nodes, elements of the mesh and sets: a writer lists them anew.
bool is_listed_anew(const InpBlock& block);

struct InpContent {
  const std::filesystem::path& file;
  const InpLines& lines;
  const InpMesh& mesh;
  InpSets& sets;
  const InpFaces& faces;
  const InpParts& parts;
  const std::vector<InpHome>& homes;
  const std::vector<std::uint32_t>& home_of_block;  ///< from 1
  const std::string& remarks;
};

/// Groups of the sets and uses have their numbers.
std::vector<std::string> make_inp_deck(const InpContent& content);

}  // namespace tetmend::formats
