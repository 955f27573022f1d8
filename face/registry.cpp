// SPDX-License-Identifier: MIT
// The operators that a run works with.
#include "face/registry.h"

#include <algorithm>

#include "ops/plugin.h"

namespace tetmend::face {

Registry load_registry(const std::vector<std::filesystem::path>& plugins) {
  Registry registry = Registry::builtin();
  std::vector<std::filesystem::path> known;
  for (const std::filesystem::path& file : plugins) {
    const std::filesystem::path real = std::filesystem::weakly_canonical(file);
    if (std::find(known.begin(), known.end(), real) != known.end()) continue;
    known.push_back(real);
    load_plugin(file, registry);
  }
  return registry;
}

}  // namespace tetmend::face
