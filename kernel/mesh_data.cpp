// SPDX-License-Identifier: MIT
#include "kernel/mesh_data.h"

#include <variant>

namespace tetmend {

// Not in the header: every program that includes it would pay for the visit.
std::size_t DataArray::size() const {
  return std::visit([](const auto& numbers) { return numbers.size(); }, values);
}

}  // namespace tetmend
