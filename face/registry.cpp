// SPDX-License-Identifier: MIT
// The operators that a run works with.
#include "face/registry.h"

#include <algorithm>
#include <system_error>

#include "face/kernel/own_operator.h"
#include "kernel/error.h"
#include "ops/plugin.h"

namespace tetmend::face {

Registry load_registry(const std::vector<std::filesystem::path>& plugins,
                       const kernel::Operators* own) {
  Registry registry = Registry::builtin();
  std::vector<std::filesystem::path> known;
  for (const std::filesystem::path& file : plugins) {
    if (file.empty()) throw Error("a plugin is to be loaded, but no file is named");
    std::error_code error;  // of a name that is none, say: load_plugin() tells
    std::filesystem::path real = std::filesystem::weakly_canonical(file, error);
    if (error) real = file;
    if (std::find(known.begin(), known.end(), real) != known.end()) continue;
    known.push_back(real);
    load_plugin(file, registry);
  }
  if (own != nullptr) kernel::add_to(registry, *own, nullptr);
  return registry;
}

}  // namespace tetmend::face
