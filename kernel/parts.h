// SPDX-License-Identifier: MIT
// Parts of a mesh: what groups and entities of a file tell apart, which labels may not.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// True if elements of one label are in different parts. `parts` has one for each element, or none.
template <class Element>
bool are_finer_than_labels(const std::vector<Element>& elements, const std::vector<Label>& parts) {
  std::map<Label, Label> part_of;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (part_of.emplace(elements[i].label, parts[i]).first->second != parts[i]) return true;
  }
  return false;
}

}  // namespace tetmend
