// SPDX-License-Identifier: MIT
// Which points of an Abaqus deck must be kept, and who says so.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kernel/formats/inp_faces.h"
#include "kernel/formats/inp_lines.h"
#include "kernel/formats/inp_mesh.h"
#include "kernel/formats/inp_references.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {

/// Points that must be kept, and who says so.
struct InpPins {
  std::vector<std::uint32_t> points;  ///< ascending
  std::string remarks;                ///< see deck_remarks(), each with a line break
};

/// Of the points that are named by number, and of those in a set which holds no tet around them
/// wholly, the ones that would not stay anyhow: those on no face that stays.
/// @param part_of of each element of the mesh: faces between two parts stay, and so do `faces`
InpPins find_pins(const InpLines& lines, const InpMesh& mesh, InpSets& sets, const InpFaces& faces,
                  const InpReferences& references, std::span<const std::uint32_t> part_of);

}  // namespace tetmend::formats
