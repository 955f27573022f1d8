// SPDX-License-Identifier: MIT
// A vertex on its way from one rank to another.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/mesh_data.h"

namespace tetmend::pieces {

struct SentVertex {
  std::uint64_t number;  ///< in the whole mesh
  std::array<double, 3> point;
  Label label;
  std::uint32_t is_required;
};

}  // namespace tetmend::pieces
