// SPDX-License-Identifier: MIT
// Throws when it is to register its operators.
#include <stdexcept>

#include <tetmend/plugin.h>

TETMEND_PLUGIN(registry) {
  static_cast<void>(registry);
  throw std::runtime_error("no licence found");
}
