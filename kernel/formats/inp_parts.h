// SPDX-License-Identifier: MIT
// What elements of an Abaqus deck have in common: the block that they are written in, and their sets.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "kernel/formats/inp_mesh.h"
#include "kernel/formats/inp_sets.h"

namespace tetmend::formats {

/// A block of the elements that are written together.
struct InpHome {
  const InpElements* first = nullptr;
  InpSet* set = nullptr;
};

/// What elements have in common that are of one part. Faces are of no block.
struct InpPart {
  std::uint32_t home = 0;  ///< from 1
  int dimension = 2;
  std::vector<std::uint32_t> sets;  ///< and, behind all sets, uses of faces
};

/// Parts while sets are added one by one.
class InpParts {
 public:
  std::vector<InpPart> all;

  std::uint32_t of_home(std::uint32_t home, int dimension) {
    all.push_back({home, dimension, {}});
    return static_cast<std::uint32_t>(all.size() - 1);
  }
  std::uint32_t with(std::uint32_t part, std::uint32_t set) {
    const auto [at, is_new] = next_.try_emplace({part, set}, 0);
    if (is_new) {
      InpPart next = all[part];
      next.sets.push_back(set);
      at->second = static_cast<std::uint32_t>(all.size());
      all.push_back(std::move(next));
    }
    return at->second;
  }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> next_;
};

}  // namespace tetmend::formats
