// SPDX-License-Identifier: MIT
// Faces and edges by what they have in common from both sides: their vertices in ascending order.
#pragma once

#include <algorithm>
#include <array>

#include "kernel/handles.h"

namespace tetmend {

using FaceKey = std::array<VertexHandle, 3>;
using EdgeKey = std::array<VertexHandle, 2>;

/// The values in ascending order.
template <class Values>
Values in_order(Values values) {
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace tetmend
