// SPDX-License-Identifier: MIT
// Which fields of the cards of Nastran's bulk data are numbers of points.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/formats/nastran_card.h"

namespace tetmend::formats {

/// What a card says of points.
struct NastranReferences {
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges;  ///< {from, to}, both included
  bool is_known = true;  ///< false: of an unknown card every integer may be a point
};

/// The points that a card names, which is no GRID and no element of the mesh. There need not be
/// such points.
NastranReferences nastran_references(const NastranCardText& card);

/// True of SET3, and of SET in the bulk data of OptiStruct, whose type is that of elements.
bool is_nastran_set_of_elements(const NastranCardText& card);

}  // namespace tetmend::formats
