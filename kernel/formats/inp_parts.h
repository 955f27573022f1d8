// SPDX-License-Identifier: MIT
// What elements of an Abaqus deck have in common: the block that they are written in, and their sets.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/formats/inp_mesh.h"
#include "kernel/formats/inp_sets.h"
#include "kernel/formats/set_chains.h"

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
  /// Behind all sets, uses of faces. Of parts that no element has, none.
  std::vector<std::uint32_t> sets;
};

/// Parts while sets are added one by one.
class InpParts {
 public:
  std::vector<InpPart> all;

  std::uint32_t of_home(std::uint32_t home, int dimension) {
    all.push_back({home, dimension, {}});
    return chains_.begin();
  }
  std::uint32_t with(std::uint32_t part, std::uint32_t set) {
    const std::uint32_t next = chains_.with(part, set);
    if (next == all.size()) all.push_back({all[part].home, all[part].dimension, {}});
    return next;
  }
  /// Lists the sets of the parts that are used.
  void list_sets(const std::vector<char>& used) {
    for (std::uint32_t part = 0; part < all.size(); ++part) {
      if (used[part] != 0) all[part].sets = chains_.sets(part);
    }
  }

 private:
  SetChains chains_;
};

}  // namespace tetmend::formats
