// SPDX-License-Identifier: MIT
// What a transaction keeps of the properties of tets and vertices.
#pragma once

#include <any>
#include <utility>
#include <vector>

#include "kernel/transaction.h"

namespace tetmend {

/// Values of properties, copied before the first write: copies may need memory.
struct Transaction::PropertyValues {
  using Values = std::vector<std::any>;
  std::vector<Values> removed;                            // of the old tets
  std::vector<Values> created;                            // what new tets begin with
  std::vector<std::pair<VertexHandle, Values>> vertices;  // of the old tets: they may vanish
};

}  // namespace tetmend
